//! Geometric Jacobians of links and frames.

use nalgebra::{DVector, Matrix6xX, Vector3, Vector6};
use robot_model::variable::JointVariable::{Position, Velocity};

use super::{
    error::{NumericError, check_index, check_lengths},
    kinematics::Configuration,
    mechanism::{JointKind, Mechanism, Wrench},
    newton_euler::outward,
    pose::Pose,
    spatial::{angular, linear, motion_transform},
};

/// A column in the order of the rows of a Jacobian: the linear half, then the angular half (the force, then the
/// moment). The order of spatial vectors is the opposite.
fn rows(linear: &Vector3<f64>, angular: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}

impl Mechanism {
    /// The geometric Jacobian J of a frame, 6 × n: J q̇ is the velocity of the frame's origin (rows 0-2) and the
    /// angular velocity of the frame (rows 3-5), both in base axes.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if q has the wrong length, [`NumericError::NoSuchBody`] if the frame does not exist.
    pub fn frame_jacobian(&self, q: &[f64], frame: usize) -> Result<Matrix6xX<f64>, NumericError> {
        check_index("frame", frame, self.frames().len())?;
        let frame = &self.frames()[frame];
        self.jacobian(q, frame.link, &frame.placement.translation)
    }

    /// The geometric Jacobian of a link frame, 6 × n, with the rows of [`Mechanism::frame_jacobian`].
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if q has the wrong length, [`NumericError::NoSuchBody`] if the link does not exist.
    pub fn link_jacobian(&self, q: &[f64], link: usize) -> Result<Matrix6xX<f64>, NumericError> {
        check_index("link", link, self.links().len())?;
        self.jacobian(q, Some(link), &Vector3::zeros())
    }

    /// J̇ q̇ of a frame: the acceleration of its origin (rows 0-2, m/s²) and its angular acceleration (rows 3-5,
    /// rad/s²) at q̈ = 0, in base axes.
    ///
    /// # Errors
    ///
    /// The errors of [`Mechanism::frame_jacobian`].
    pub fn frame_jacobian_dot_qd(
        &self,
        q: &[f64],
        qd: &[f64],
        frame: usize,
    ) -> Result<Vector6<f64>, NumericError> {
        check_index("frame", frame, self.frames().len())?;
        let frame = &self.frames()[frame];
        self.jacobian_dot_qd(q, qd, frame.link, &frame.placement)
    }

    /// J̇ q̇ of a link frame, with the rows of [`Mechanism::frame_jacobian_dot_qd`].
    ///
    /// # Errors
    ///
    /// The errors of [`Mechanism::link_jacobian`].
    pub fn link_jacobian_dot_qd(
        &self,
        q: &[f64],
        qd: &[f64],
        link: usize,
    ) -> Result<Vector6<f64>, NumericError> {
        check_index("link", link, self.links().len())?;
        self.jacobian_dot_qd(q, qd, Some(link), &Pose::identity())
    }

    /// The Jacobian of a point: the column of a coordinate contains the axes of the joints that it moves between the
    /// link and the base, and their moments about the point.
    fn jacobian(
        &self,
        q: &[f64],
        carrier: Option<usize>,
        point: &Vector3<f64>,
    ) -> Result<Matrix6xX<f64>, NumericError> {
        check_lengths(&[(Position.name(), self.coordinates(), q.len())])?;
        let poses = Configuration::new(self, q).in_base(self);
        let mut jacobian = Matrix6xX::zeros(self.coordinates());
        let Some(carrier) = carrier else {
            return Ok(jacobian);
        };
        let point = poses[carrier].rotation * point + poses[carrier].translation;
        let mut next = Some(carrier);
        while let Some(index) = next {
            let (link, pose) = (&self.links()[index], &poses[index]);
            next = link.parent;
            let Some(coordinate) = link.joint.driver() else {
                continue;
            };
            let axis = pose.rotation * link.joint.axis * link.joint.ratio;
            let column = match link.joint.kind {
                JointKind::Fixed => continue,
                JointKind::Revolute => rows(&axis.cross(&(point - pose.translation)), &axis),
                JointKind::Prismatic => rows(&axis, &Vector3::zeros()),
            };
            let sum = jacobian.column(coordinate) + column;
            jacobian.set_column(coordinate, &sum);
        }
        Ok(jacobian)
    }

    /// The acceleration of a frame at q̈ = 0 without gravity.
    fn jacobian_dot_qd(
        &self,
        q: &[f64],
        qd: &[f64],
        carrier: Option<usize>,
        placement: &Pose,
    ) -> Result<Vector6<f64>, NumericError> {
        let n = self.coordinates();
        check_lengths(&[(Position.name(), n, q.len()), (Velocity.name(), n, qd.len())])?;
        let Some(carrier) = carrier else {
            return Ok(Vector6::zeros());
        };
        let configuration = Configuration::new(self, q);
        let motions = outward(self, &configuration, qd, &vec![0.0; n], &Vector3::zeros());
        let x = motion_transform(placement);
        let velocity = x * motions.velocities[carrier];
        let acceleration = x * motions.accelerations[carrier];
        // A spatial acceleration contains the acceleration of the point of the body that coincides with the origin; the
        // acceleration of the moving origin has the additional term ω × v.
        let of_origin = linear(&acceleration) + angular(&velocity).cross(&linear(&velocity));
        let rotation = configuration.in_base(self)[carrier].rotation * placement.rotation;
        Ok(rows(&(rotation * of_origin), &(rotation * angular(&acceleration))))
    }

    /// The joint torques that wrenches exerted by the frames (one for each frame) require at rest and without gravity:
    /// the sum of Jᵀ (F, M).
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if an argument has the wrong length.
    pub fn wrench_torques(
        &self,
        q: &[f64],
        wrenches: &[Wrench],
    ) -> Result<DVector<f64>, NumericError> {
        check_lengths(&[
            (Position.name(), self.coordinates(), q.len()),
            ("wrenches", self.frames().len(), wrenches.len()),
        ])?;
        let placements = self.forward_kinematics(q)?;
        let mut torques = DVector::zeros(self.coordinates());
        for (index, (pose, wrench)) in placements.frames.iter().zip(wrenches).enumerate() {
            let (force, moment) = (pose.rotation * wrench.force, pose.rotation * wrench.moment);
            torques += self.frame_jacobian(q, index)?.transpose() * rows(&force, &moment);
        }
        Ok(torques)
    }
}
