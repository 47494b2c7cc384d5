//! The options of the economical recursion, as data.
//!
//! Every option yields the same torques; they differ in operations. Letters in brackets are those
//! of the ablation tables in `docs/performance.md`.

pub(super) mod mechanics;
pub mod pin;
pub mod search;

use robot_model::robot::Robot;

/// The options for a whole mechanism.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Plan {
    /// Per link, in the mechanism's order.
    pub links: Vec<LinkPlan>,
    /// \[l\] The unit of length in which the recursion works: that of the component (0, 1, 2) of
    /// this link's position in its parent, which thereby becomes ±1.
    pub unit_length: Option<(usize, usize)>,
}

/// The options for one link.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct LinkPlan {
    /// \[t\] Where the working frame's origin lies on the joint axis.
    pub origin: Origin,
    /// \[t, φ\] How the working frame is turned about the joint axis.
    pub turn: Turn,
    /// \[a\] Whether the joint joins the parallel group of its parent's joint: rotations then use the sum of the
    /// group's angles. This has no effect if the axes are not parallel.
    pub angle_sum: bool,
    /// \[c\] Whether the third column of U comes from the parent's U.
    pub column: bool,
    /// \[u\] Whether the third row of U then comes from doubled products, U₃₁ = ω_x 2ω_z − U₁₃, which
    /// saves an addition if the angular acceleration across the axis is not needed itself.
    pub doubled: bool,
    /// \[b\] Per component of the moment: whether products of angular velocities and accelerations replace entries of
    /// U.
    pub moment: [bool; 3],
    /// \[d\] Whether differences of squared angular velocities come from the diagonal of U, which
    /// saves a square if U's third column is known.
    pub diagonal: bool,
    /// \[m, z\] The parts of the link's mass, first moment and second moment along its joint axis that stay
    /// with the link so that an entry of the parent's inertia vanishes; in that order.
    pub residual: [Option<Entry>; 3],
    /// The acceleration assumed for the joint if it is free to choose.
    pub free: FreeRate,
    /// Whether composite inertias use the home axes of the parallel group, as motions do with
    /// `angle_sum`.
    pub composite_sum: bool,
    /// The place, on the way to the base, where this link's wrench for a unit acceleration of its joint is
    /// projected on the motions of the joints farther inward; `None` for each joint's own.
    pub projected_at: Option<Place>,
}

/// The acceleration assumed for a joint in forward dynamics, where the bias may be that of any
/// accelerations q̈*, since q̈ = q̈* + M⁻¹ (τ − τ(q̈*)).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FreeRate {
    /// 0.
    Zero,
    /// Makes the link's own acceleration along the joint axis vanish: ε_z of a rotation, a_z of
    /// a translation.
    Still,
    /// Makes U₁₂ vanish.
    Upper,
    /// Makes U₂₁ vanish.
    Lower,
    /// Makes the acceleration of the next link's origin vanish along x.
    NextX,
    /// Makes the acceleration of the next link's origin vanish along y.
    NextY,
}

impl FreeRate {
    /// All choices.
    pub const ALL: [FreeRate; 6] = [
        FreeRate::Zero,
        FreeRate::Still,
        FreeRate::Upper,
        FreeRate::Lower,
        FreeRate::NextX,
        FreeRate::NextY,
    ];
}

/// Axes about the origin of a link's working frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    /// The link.
    pub link: usize,
    /// The axes of the working frame; otherwise those before the joints of the link's parallel
    /// group turn it.
    pub turned: bool,
}

/// The position of a working frame's origin on its joint axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Origin {
    /// At the robot file's origin.
    File,
    /// At the foot of the common normal with the next joint's axis (modified Denavit–Hartenberg).
    NextNormal,
    /// At the foot of the common normal with the previous joint's axis (Denavit–Hartenberg).
    PreviousNormal,
    /// Where the regrouped Σxz vanishes.
    ZeroXz,
    /// Where the regrouped Σyz vanishes.
    ZeroYz,
    /// At the link's center of mass: for prismatic joints, whose axis has a direction only.
    CenterOfMass,
    /// At the parent's origin at joint position 0: for prismatic joints.
    Parent,
}

/// The turn of a working frame about its joint axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Turn {
    /// The x axis as close to the file's as the joint axis allows.
    File,
    /// The x axis along the common normal with the next joint's axis.
    NextNormal,
    /// The x axis along the regrouped first moment, so that its y component vanishes.
    FirstMoment,
}

/// An entry of a link's regrouped inertia that can be made to vanish, or a difference of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Entry {
    /// First moment, x.
    X,
    /// First moment, y.
    Y,
    /// Second moment Σxx.
    Xx,
    /// Second moment Σyy.
    Yy,
    /// Second moment Σxy.
    Xy,
    /// Second moment Σxz.
    Xz,
    /// Second moment Σyz.
    Yz,
    /// The difference Σxx − Σyy.
    XxYy,
}

impl Entry {
    /// All entries.
    pub const ALL: [Entry; 8] =
        [Entry::X, Entry::Y, Entry::Xx, Entry::Yy, Entry::Xy, Entry::Xz, Entry::Yz, Entry::XxYy];
}

impl LinkPlan {
    /// Modified Denavit–Hartenberg frames and full regrouping, without other options.
    pub const BASIC: LinkPlan = LinkPlan {
        origin: Origin::NextNormal,
        turn: Turn::NextNormal,
        angle_sum: false,
        column: false,
        doubled: false,
        moment: [false; 3],
        diagonal: false,
        residual: [None; 3],
        free: FreeRate::Zero,
        composite_sum: false,
        projected_at: None,
    };
}

impl LinkPlan {
    /// Options that suit most links, without a search: most links of searched plans have them.
    pub const DEFAULT: LinkPlan = LinkPlan {
        angle_sum: true,
        column: true,
        doubled: true,
        moment: [false, false, true],
        diagonal: true,
        ..LinkPlan::BASIC
    };
}

impl Plan {
    /// Whether the plan is for that many links and names no others.
    #[must_use]
    pub fn fits(&self, links: usize) -> bool {
        let projected_at = self.links.iter().filter_map(|link| link.projected_at);
        self.links.len() == links
            && self.unit_length.is_none_or(|(link, component)| link < links && component < 3)
            && projected_at.into_iter().all(|place| place.link < links)
    }

    /// Options that suit most arms, without a search: those of most links in the plans with the fewest operations.
    #[must_use]
    pub fn default_for(robot: &Robot) -> Plan {
        Plan::uniform(robot.links.len(), &LinkPlan::DEFAULT)
    }

    /// A plan with these options for every link.
    #[must_use]
    pub fn uniform(links: usize, plan: &LinkPlan) -> Plan {
        Plan { links: vec![plan.clone(); links], unit_length: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plan_fits_if_all_that_it_names_is_there() {
        let plan = Plan::uniform(3, &LinkPlan::BASIC);
        assert!(plan.fits(3) && !plan.fits(2) && !plan.fits(4));
        for (unit, fits) in [((2, 2), true), ((3, 0), false), ((0, 3), false)] {
            assert_eq!(Plan { unit_length: Some(unit), ..plan.clone() }.fits(3), fits, "{unit:?}");
        }
        for (link, fits) in [(0, true), (2, true), (3, false)] {
            let mut projected = plan.clone();
            projected.links[1].projected_at = Some(Place { link, turned: false });
            assert_eq!(projected.fits(3), fits, "{link}");
        }
    }
}
