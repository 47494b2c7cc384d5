//! The values of a robot at its nominal parameters, with their places in the file. Unknown values are NaN, so that all
//! comparisons with them are false.

use nalgebra::{Matrix3, Vector3};

use robot_model::description::{BodyLocation, Described, LinkLocation, Locations};
use robot_model::diagnostic::Span;
use robot_model::robot::{Body, DhConvention, JointKind, Link, Robot};
use robot_numeric::Evaluation;

/// The robot in numbers.
pub(super) struct RobotFacts<'d> {
    pub(super) robot: &'d Robot,
    pub(super) locations: &'d Locations,
    /// The acceleration of gravity in base components, m/s².
    pub(super) gravity: Vector3<f64>,
    pub(super) links: Vec<LinkFacts<'d>>,
}

/// A moving link.
pub(super) struct LinkFacts<'d> {
    pub(super) link: &'d Link,
    pub(super) place: &'d LinkLocation,
    pub(super) bodies: Vec<BodyFacts<'d>>,
    /// The origins of children and of named frames, in link components, m.
    pub(super) points: Vec<Vector3<f64>>,
    /// The distance from the parent's origin to this link's at joint position 0, m.
    pub(super) arm: f64,
    /// The distance from this origin to that of the frame at the end of the link, if a standard Denavit-Hartenberg row
    /// places it, m, and the row.
    pub(super) end: Option<(f64, &'d Span)>,
    /// The distance by which a prismatic joint can move the link, m; 0 if it is not known.
    pub(super) travel: f64,
}

/// A rigid body.
pub(super) struct BodyFacts<'d> {
    pub(super) body: &'d Body,
    pub(super) place: &'d BodyLocation,
    /// The mass, kg.
    pub(super) mass: f64,
    /// The center of mass in link components, m.
    pub(super) center: Vector3<f64>,
    /// The inertia tensor about the center of mass in link axes, kg m².
    pub(super) tensor: Matrix3<f64>,
}

impl<'d> RobotFacts<'d> {
    pub(super) fn new(described: &'d Described) -> RobotFacts<'d> {
        let Described { robot, locations, .. } = described;
        let value = |name: &str| robot.nominal_value(name);
        let at = Evaluation { value: &value };
        let links = robot.links.iter().zip(&locations.links).enumerate();
        let links = links.map(|(index, (link, place))| LinkFacts {
            link,
            place,
            bodies: bodies(link, place, &at),
            points: points(robot, index, &at),
            arm: at.pose(&link.placement).translation.norm(),
            end: end(robot, index, place, &at),
            travel: travel(robot, link),
        });
        RobotFacts { robot, locations, gravity: at.vector(&robot.gravity), links: links.collect() }
    }

    /// The sum of the distances between consecutive origins, m.
    pub(super) fn reach(&self) -> f64 {
        self.links.iter().map(|link| link.arm).sum()
    }
}

fn bodies<'d>(link: &'d Link, place: &'d LinkLocation, at: &Evaluation<'_>) -> Vec<BodyFacts<'d>> {
    let bodies = link.bodies.iter().zip(&place.bodies).map(|(body, place)| {
        let pose = at.pose(&body.placement);
        BodyFacts {
            body,
            place,
            mass: at.number(&body.mass),
            center: pose.translation,
            tensor: pose.rotation * at.tensor(&body.inertia) * pose.rotation.transpose(),
        }
    });
    // Values may be unknown, such as those of a payload that is set at run time.
    bodies.filter(|body| body.mass != 0.0 || body.tensor.norm() != 0.0).collect()
}

fn points(robot: &Robot, index: usize, at: &Evaluation<'_>) -> Vec<Vector3<f64>> {
    let children = robot.links.iter().filter(|link| link.parent == Some(index));
    let frames = robot.frames.iter().filter(|frame| frame.link == Some(index));
    let placements = children.map(|link| &link.placement);
    let placements = placements.chain(frames.map(|frame| &frame.placement));
    placements.map(|placement| at.pose(placement).translation).collect()
}

fn end<'d>(
    robot: &Robot,
    index: usize,
    place: &'d LinkLocation,
    at: &Evaluation<'_>,
) -> Option<(f64, &'d Span)> {
    let standard = DhConvention::Standard;
    let row =
        robot.dh.iter().find(|row| row.moving == Some(index) && row.convention == standard)?;
    let along = [at.number(&row.a), at.number(&row.d)];
    Some((along[0].hypot(along[1]), place.origin.as_ref()?))
}

fn travel(robot: &Robot, link: &Link) -> f64 {
    let limits = robot.coordinates.get(link.joint.coordinate);
    match (link.joint.kind, limits.and_then(|coordinate| coordinate.limits.as_ref())) {
        (JointKind::Prismatic, Some([lower, upper])) => upper.to_f64() - lower.to_f64(),
        (JointKind::Revolute, _) | (JointKind::Prismatic, None) => 0.0,
    }
}

impl<'d> LinkFacts<'d> {
    /// The largest magnitude of the limits of its joint, in rad or m, and their place, if the joint is of this kind and
    /// has limits.
    pub(super) fn farthest_limit(&self, robot: &Robot, kind: JointKind) -> Option<(f64, &'d Span)> {
        let coordinate = robot.coordinates.get(self.link.joint.coordinate)?;
        let limits = coordinate.limits.as_ref().filter(|_| coordinate.kind == kind)?;
        let farthest = limits.iter().fold(0.0_f64, |most, limit| most.max(limit.to_f64().abs()));
        Some((farthest, self.place.limits.as_ref()?))
    }

    /// The largest distance of a point on the link, as marked by other parts of the robot, or of the parent's origin,
    /// plus the travel, m.
    pub(super) fn size(&self) -> f64 {
        let farthest = self.points.iter().map(Vector3::norm).fold(0.0, f64::max);
        farthest.max(self.arm) + self.travel
    }
}

impl BodyFacts<'_> {
    /// The radius of gyration √(∫r² dm / m) about the center of mass, m; ∫r² dm is half the trace of the tensor.
    pub(super) fn gyration(&self) -> f64 {
        (self.tensor.trace() / (2.0 * self.mass)).sqrt()
    }

    /// Whether the body has a tensor that can be judged: the file does not waive the check, and the tensor is not zero.
    pub(super) fn has_tensor(&self) -> bool {
        !self.place.unchecked && self.mass > 0.0 && self.tensor.trace() > 0.0
    }

    /// The place of the tensor.
    pub(super) fn of_tensor(&self) -> &Span {
        self.place.inertia.as_ref().unwrap_or(&self.place.name)
    }

    /// The place of the mass.
    pub(super) fn of_mass(&self) -> &Span {
        self.place.mass.as_ref().unwrap_or(&self.place.name)
    }

    /// The place of the center of mass.
    pub(super) fn of_center(&self) -> &Span {
        self.place.center_of_mass.as_ref().unwrap_or(&self.place.name)
    }

    /// Whether mass, center of mass and inertia are likely to be in the right units. If not, [`super::units`] reports
    /// them, and other checks skip the body.
    pub(super) fn is_in_units(&self) -> bool {
        !super::units::is_suspect(self)
    }
}
