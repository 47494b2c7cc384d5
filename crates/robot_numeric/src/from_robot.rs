//! Conversion of the checked robot to numbers: every formula is evaluated in floating point at once.

use nalgebra::{Matrix3, Vector3};
use robot_model::robot;
use robot_symbolic::Formula;

use super::error::NumericError;
use super::friction::{Friction, Sign};
use super::mechanism::{Frame, Joint, JointKind, Link, Mechanism};
use super::pose::{Pose, rotation_about};

impl Mechanism {
    /// Evaluates the robot with the values of parameters that `value` returns for their names.
    ///
    /// Links and frames keep the order of [`robot::Robot`]. They are followed by the gyroscopic rotors, each of which
    /// is a separate link without mass that turns with the coordinate of its joint.
    ///
    /// # Errors
    ///
    /// [`NumericError::Mechanism`] with all faults; a parameter without a value (NaN) is a fault wherever it is used.
    pub fn from_robot(
        robot: &robot::Robot,
        value: &dyn Fn(&str) -> f64,
    ) -> Result<Self, NumericError> {
        let at = Evaluation { value };
        let mut links: Vec<Link> = robot.links.iter().map(|link| at.link(link)).collect();
        for link in &robot.links {
            if let (true, Some(carrier)) = (link.drive.gyroscopic, link.parent) {
                let rotor = at.rotor(link, carrier);
                take_from(&mut links[carrier], &rotor);
                links.push(rotor);
            }
        }
        Mechanism::new(
            at.vector(&robot.gravity),
            links,
            robot.frames.iter().map(|frame| at.frame(frame)).collect(),
        )
    }

    /// Evaluates the robot at the nominal values of its parameters.
    ///
    /// # Errors
    ///
    /// The errors of [`Mechanism::from_robot`], or [`NumericError::WithoutValues`] instead if parameters have no
    /// nominal value.
    pub fn nominal(robot: &robot::Robot) -> Result<Self, NumericError> {
        Mechanism::from_robot(robot, &|name| robot.nominal_value(name)).map_err(|error| {
            let without = robot.parameters.iter().filter(|parameter| parameter.value.is_none());
            let names: Vec<String> = without.map(|parameter| parameter.name.clone()).collect();
            if names.is_empty() { error } else { NumericError::WithoutValues(names) }
        })
    }
}

/// Subtracts the inertia of the locked rotor from that of its carrier, which includes it in the robot file.
fn take_from(carrier: &mut Link, rotor: &Link) {
    let rotation = rotor.placement.rotation;
    carrier.inertia -= rotation * rotor.inertia * rotation.transpose();
}

/// The unit vector in the direction of a vector. A very long or short vector is scaled first, so that no square
/// overflows or underflows.
#[must_use]
pub fn direction(vector: Vector3<f64>) -> Vector3<f64> {
    let largest = vector.amax();
    let vector = if (1e-100..=1e100).contains(&largest) { vector } else { vector / largest };
    vector.normalize()
}

/// Evaluates formulas.
#[derive(Clone, Copy)]
pub struct Evaluation<'v> {
    /// The values of parameters by name.
    pub value: &'v dyn Fn(&str) -> f64,
}

impl Evaluation<'_> {
    /// The value of a formula.
    #[must_use]
    pub fn number(&self, formula: &Formula) -> f64 {
        formula.evaluate(self.value)
    }

    /// The vector of three formulas.
    #[must_use]
    pub fn vector(&self, [x, y, z]: &[Formula; 3]) -> Vector3<f64> {
        Vector3::new(self.number(x), self.number(y), self.number(z))
    }

    /// The pose that results from the moves of a placement.
    #[must_use]
    pub fn pose(&self, placement: &robot::Placement) -> Pose {
        placement.0.iter().fold(Pose::identity(), |pose, step| {
            let mut next = Pose::identity();
            match step {
                robot::Move::Translate(by) => next.translation = self.vector(by),
                robot::Move::Rotate(axis, angle) => {
                    let axis = match axis {
                        robot::Axis::X => Vector3::x(),
                        robot::Axis::Y => Vector3::y(),
                        robot::Axis::Z => Vector3::z(),
                    };
                    next.rotation = rotation_about(&axis, self.number(angle));
                }
            }
            pose.then(&next)
        })
    }

    fn link(&self, link: &robot::Link) -> Link {
        let joint = &link.joint;
        let joint = Joint {
            kind: match joint.kind {
                robot::JointKind::Revolute => JointKind::Revolute,
                robot::JointKind::Prismatic => JointKind::Prismatic,
            },
            axis: direction(self.vector(&joint.axis)),
            coordinate: joint.coordinate,
            ratio: self.number(&joint.ratio),
            offset: self.number(&joint.offset),
        };
        let (mass, center, inertia) = self.bodies(&link.bodies);
        let drive = &link.drive;
        let turns = self.number(&drive.gear_ratio);
        // A gyroscopic rotor on a moving carrier becomes a separate link.
        let locked = drive.gyroscopic && link.parent.is_some();
        let reflected =
            if locked { 0.0 } else { turns * turns * self.number(&drive.rotor_inertia) };
        Link {
            rotor_inertia: self.number(&drive.armature) + reflected,
            friction: self.friction(&link.friction),
            ..Link::new(link.parent, self.pose(&link.placement), joint, mass, center, inertia)
        }
    }

    /// The rotor of a joint as a link: it turns about the joint axis N times as fast as the joint, and only has an
    /// inertia about this axis.
    fn rotor(&self, link: &robot::Link, carrier: usize) -> Link {
        let (joint, drive) = (&link.joint, &link.drive);
        let turns = self.number(&drive.gear_ratio);
        let axis = direction(self.vector(&joint.axis));
        let motion = Joint {
            kind: JointKind::Revolute,
            axis,
            coordinate: joint.coordinate,
            ratio: turns * self.number(&joint.ratio),
            offset: 0.0,
        };
        let inertia = axis * axis.transpose() * self.number(&drive.rotor_inertia);
        let placement = self.pose(&link.placement);
        Link::new(Some(carrier), placement, motion, 0.0, Vector3::zeros(), inertia)
    }

    /// The mass, center of mass and inertia tensor about the center of mass of rigidly connected bodies.
    fn bodies(&self, bodies: &[robot::Body]) -> (f64, Vector3<f64>, Matrix3<f64>) {
        let parts: Vec<_> = bodies
            .iter()
            .map(|body| {
                let pose = self.pose(&body.placement);
                let turned = pose.rotation * self.tensor(&body.inertia) * pose.rotation.transpose();
                (self.number(&body.mass), pose.translation, turned)
            })
            .collect();
        let mass: f64 = parts.iter().map(|part| part.0).sum();
        let moment: Vector3<f64> = parts.iter().map(|part| part.1 * part.0).sum();
        let center = match (parts.as_slice(), mass == 0.0) {
            ([single], _) => single.1,
            (_, true) => Vector3::zeros(),
            (_, false) => moment / mass,
        };
        let inertia = parts.iter().map(|(mass, own_center, inertia)| {
            let arm = own_center - center;
            inertia + (Matrix3::identity() * arm.norm_squared() - arm * arm.transpose()) * *mass
        });
        (mass, center, inertia.sum())
    }

    /// The inertia tensor in its own axes.
    #[must_use]
    pub fn tensor(&self, inertia: &robot::Inertia) -> Matrix3<f64> {
        let robot::Inertia { xx, yy, zz, xy, xz, yz } = inertia;
        let [xx, yy, zz, xy, xz, yz] = [xx, yy, zz, xy, xz, yz].map(|entry| self.number(entry));
        Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    }

    fn friction(&self, friction: &robot::Friction) -> Friction {
        Friction {
            viscous: self.number(&friction.viscous),
            coulomb: self.number(&friction.coulomb),
            spindle_diameter: self.number(&friction.spindle_diameter),
            constant: [
                self.number(&friction.coulomb_positive),
                self.number(&friction.coulomb_negative),
            ],
            offset: self.number(&friction.offset),
            sign: match &friction.smoothing {
                Some(width) => Sign::Smooth(self.number(width)),
                None => Sign::Exact,
            },
        }
    }

    fn frame(&self, frame: &robot::Frame) -> Frame {
        Frame { link: frame.link, placement: self.pose(&frame.placement) }
    }
}
