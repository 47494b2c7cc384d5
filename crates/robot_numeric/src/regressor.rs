//! Torques as linear functions of the inertial and drive parameters.

use nalgebra::{DMatrix, DVector, Matrix3, Matrix6xX, SMatrix, Vector3};
use robot_model::robot::LINK_PARAMETERS;
use robot_model::variable::JointVariable::{Acceleration, Velocity};

use super::{
    error::{NumericError, check_lengths},
    kinematics::Configuration,
    mechanism::{Link, Mechanism},
    newton_euler::LinkDynamics,
    pose::skew,
};

/// The number of drive parameters of a joint.
pub const DRIVE_PARAMETERS: usize = 5;

type LinkRegressor = SMatrix<f64, 6, LINK_PARAMETERS>;

impl Link {
    /// The ten inertial parameters m, m c_x, m c_y, m c_z, I_xx, I_xy, I_yy, I_xz, I_yz, I_zz. The inertia tensor is
    /// about the origin and in the axes of the link frame.
    pub fn parameters(&self) -> [f64; LINK_PARAMETERS] {
        let h = self.first_moment();
        let i = self.inertia_about_origin();
        let (xx, xy, yy) = (i[(0, 0)], i[(0, 1)], i[(1, 1)]);
        [self.mass, h.x, h.y, h.z, xx, xy, yy, i[(0, 2)], i[(1, 2)], i[(2, 2)]]
    }
}

/// The moment about the origin of the link frame (rows 0-2) and the force (rows 3-5) that the motion of a link requires
/// for a unit of each of its parameters.
fn of_link(motion: &LinkDynamics) -> LinkRegressor {
    let (omega, epsilon) = (&motion.angular_velocity, &motion.angular_acceleration);
    let acceleration = &motion.acceleration;
    let turning = skew(epsilon) + skew(omega) * skew(omega);
    let mut matrix = LinkRegressor::zeros();
    matrix.fixed_view_mut::<3, 1>(3, 0).copy_from(acceleration);
    matrix.fixed_view_mut::<3, 3>(3, 1).copy_from(&turning);
    matrix.fixed_view_mut::<3, 3>(0, 1).copy_from(&-skew(acceleration));
    let moment = tensor_columns(epsilon) + skew(omega) * tensor_columns(omega);
    matrix.fixed_view_mut::<3, 6>(0, 4).copy_from(&moment);
    matrix
}

/// The matrix L(v) with L(v) (I_xx, I_xy, I_yy, I_xz, I_yz, I_zz) = I v.
fn tensor_columns(v: &Vector3<f64>) -> SMatrix<f64, 3, 6> {
    let elements = [(0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)];
    let mut matrix = SMatrix::<f64, 3, 6>::zeros();
    for (column, (row, other)) in elements.into_iter().enumerate() {
        let mut unit = Matrix3::zeros();
        unit[(row, other)] = 1.0;
        unit[(other, row)] = 1.0;
        matrix.set_column(column, &(unit * v));
    }
    matrix
}

impl Mechanism {
    /// The inertial parameters π of all links in order, ten for each link ([`Link::parameters`]).
    pub fn parameters(&self) -> DVector<f64> {
        let all: Vec<f64> = self.links().iter().flat_map(Link::parameters).collect();
        DVector::from_vec(all)
    }

    /// The regressor Y(q, q̇, q̈), n × 10 links, with τ = Y π: inverse dynamics without rotors, wrenches and friction.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if an argument has the wrong length.
    pub fn regressor(
        &self,
        q: &[f64],
        qd: &[f64],
        qdd: &[f64],
    ) -> Result<DMatrix<f64>, NumericError> {
        let motions = self.link_dynamics(q, qd, qdd, &[])?;
        let configuration = Configuration::new(self, q);
        let mut regressor = DMatrix::zeros(self.coordinates(), LINK_PARAMETERS * motions.len());
        for (index, motion) in motions.iter().enumerate() {
            let first = LINK_PARAMETERS * index;
            let mut forces = Matrix6xX::from_column_slice(of_link(motion).as_slice());
            let mut next = Some(index);
            while let Some(here) = next {
                let link = &self.links()[here];
                if let Some(coordinate) = link.joint.driver() {
                    let row = link.joint.subspace::<f64>().transpose() * &forces;
                    let mut view = regressor.view_mut((coordinate, first), (1, LINK_PARAMETERS));
                    view += row;
                }
                forces = configuration.transforms[here].transpose() * forces;
                next = link.parent;
            }
        }
        Ok(regressor)
    }

    /// The drive parameters of all links in order, five for each link: rotor inertia, viscous friction, constant
    /// friction forward and backward, offset. Those of a fixed joint have no effect.
    pub fn drive_parameters(&self) -> DVector<f64> {
        let of_drive = |link: &Link| {
            let [forward, backward] = link.friction.constant;
            let friction = &link.friction;
            [link.rotor_inertia, friction.viscous, forward, backward, friction.offset]
        };
        DVector::from_vec(self.links().iter().flat_map(of_drive).collect())
    }

    /// The regressor of the drives, n × 5 links. Its product with [`Mechanism::drive_parameters`] is the contribution
    /// of rotors and friction to the torques, except for load-dependent dry friction.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if an argument has the wrong length.
    pub fn drive_regressor(&self, qd: &[f64], qdd: &[f64]) -> Result<DMatrix<f64>, NumericError> {
        let n = self.coordinates();
        check_lengths(&[(Velocity.name(), n, qd.len()), (Acceleration.name(), n, qdd.len())])?;
        let mut regressor = DMatrix::zeros(n, DRIVE_PARAMETERS * self.links().len());
        for (index, link) in self.links().iter().enumerate() {
            let Some(coordinate) = link.joint.driver() else {
                continue;
            };
            let ratio = link.joint.ratio;
            let (velocity, acceleration) = (ratio * qd[coordinate], ratio * qdd[coordinate]);
            let sign = link.friction.sign_of(velocity);
            let constant = [(sign + sign * sign) / 2.0, (sign - sign * sign) / 2.0];
            let columns = [acceleration, velocity, constant[0], constant[1], 1.0];
            for (place, column) in columns.into_iter().enumerate() {
                regressor[(coordinate, DRIVE_PARAMETERS * index + place)] = ratio * column;
            }
        }
        Ok(regressor)
    }
}
