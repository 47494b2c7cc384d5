//! The options of the economical recursion, as data.
//!
//! All options give the same torques but different numbers of operations.

pub(super) mod mechanics;
pub mod pin;
pub mod search;

use robot_model::robot::Robot;

/// The options for a whole mechanism.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Plan {
    /// The options for each link, in the order of the mechanism.
    pub links: Vec<LinkPlan>,
    /// The unit of length in which the recursion works: the component (0, 1, 2) of this link's position relative
    /// to its parent, which thereby becomes ±1.
    pub unit_length: Option<(usize, usize)>,
}

/// The options for one link.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct LinkPlan {
    /// The position of the working frame's origin on the joint axis.
    pub origin: Origin,
    /// The rotation of the working frame about the joint axis.
    pub turn: Turn,
    /// Whether the joint joins the parallel group of its parent's joint; rotations then use the sum of the
    /// group's angles. This has no effect if the axes are not parallel.
    pub angle_sum: bool,
    /// Whether the third column of U is computed from the parent's U.
    pub column: bool,
    /// Whether, in that case, the third row of U is computed from doubled products, U₃₁ = ω_x 2ω_z − U₁₃. This
    /// saves an addition if the angular acceleration perpendicular to the axis is not needed otherwise.
    pub doubled: bool,
    /// For each component of the moment, whether products of angular velocities and accelerations are used
    /// instead of entries of U.
    pub moment: [bool; 3],
    /// Whether differences of squared angular velocities are computed from the diagonal of U, which saves a
    /// square if the third column of U is known.
    pub diagonal: bool,
    /// The entries of the parent's inertia that are made to vanish because a part of the link's mass, first
    /// moment and second moment along its joint axis, in this order, remains with the link.
    pub residual: [Option<Entry>; 3],
    /// The acceleration that is assumed for the joint if it can be chosen freely.
    pub free: FreeAcceleration,
    /// Whether composite inertias use the home axes of the parallel group, as motions do with `angle_sum`.
    pub composite_sum: bool,
    /// The place, on the way to the base, at which this link's wrench for a unit acceleration of its joint is projected
    /// on the motions of the joints farther inward. `None` if it is projected at each of these joints.
    pub projected_at: Option<Place>,
}

/// The acceleration that is assumed for a joint in forward dynamics. The recursion may be evaluated at any accelerations
/// q̈*, not only at 0, because q̈ = q̈* + M⁻¹ (τ − τ(q̈*)).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FreeAcceleration {
    /// The acceleration 0.
    Zero,
    /// The acceleration for which the link's own acceleration along the joint axis vanishes: ε_z for a revolute joint,
    /// a_z for a prismatic joint.
    Still,
    /// The acceleration for which U₁₂ vanishes.
    Upper,
    /// The acceleration for which U₂₁ vanishes.
    Lower,
    /// The acceleration for which the acceleration of the next link's origin vanishes along x.
    NextX,
    /// The acceleration for which the acceleration of the next link's origin vanishes along y.
    NextY,
}

impl FreeAcceleration {
    /// All choices.
    pub const ALL: [FreeAcceleration; 6] = [
        FreeAcceleration::Zero,
        FreeAcceleration::Still,
        FreeAcceleration::Upper,
        FreeAcceleration::Lower,
        FreeAcceleration::NextX,
        FreeAcceleration::NextY,
    ];
}

/// A set of axes at the origin of a link's working frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    /// The index of the link.
    pub link: usize,
    /// Whether these are the axes of the working frame; otherwise, they are the home axes, before the joints of the
    /// link's parallel group turn.
    pub turned: bool,
}

/// The position of a working frame's origin on its joint axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Origin {
    /// The origin of the link's frame in the robot file.
    File,
    /// The foot of the common normal with the next joint's axis (modified Denavit–Hartenberg).
    NextNormal,
    /// The foot of the common normal with the previous joint's axis (Denavit–Hartenberg).
    PreviousNormal,
    /// The point at which the regrouped Σxz vanishes.
    ZeroXz,
    /// The point at which the regrouped Σyz vanishes.
    ZeroYz,
    /// The link's center of mass. For prismatic joints, whose axis only has a direction.
    CenterOfMass,
    /// The parent's origin at joint position 0. For prismatic joints.
    Parent,
}

/// The rotation of a working frame about its joint axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Turn {
    /// The x axis is as close to the file's as the joint axis allows.
    File,
    /// The x axis is parallel to the common normal with the next joint's axis.
    NextNormal,
    /// The x axis is in the direction of the regrouped first moment perpendicular to the axis, so that its y component vanishes.
    FirstMoment,
}

/// An entry of a link's regrouped inertia, or a difference of two entries, that can be made to vanish.
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
    /// Modified Denavit–Hartenberg frames with full regrouping and no other options.
    pub const BASIC: LinkPlan = LinkPlan {
        origin: Origin::NextNormal,
        turn: Turn::NextNormal,
        angle_sum: false,
        column: false,
        doubled: false,
        moment: [false; 3],
        diagonal: false,
        residual: [None; 3],
        free: FreeAcceleration::Zero,
        composite_sum: false,
        projected_at: None,
    };
}

impl LinkPlan {
    /// Options that suit most links without a search: most links of searched plans have them.
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
    /// Whether the plan is for the given number of links and only refers to existing links.
    #[must_use]
    pub fn fits(&self, links: usize) -> bool {
        let projected_at = self.links.iter().filter_map(|link| link.projected_at);
        self.links.len() == links
            && self.unit_length.is_none_or(|(link, component)| link < links && component < 3)
            && projected_at.into_iter().all(|place| place.link < links)
    }

    /// Options that suit most arms without a search: except for the origin and the doubled products, most links of the
    /// plans that a search found for the project's robots have them.
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
