//! Placements of frames.

use nalgebra::{Matrix3, Vector3};

use super::scalar::Number;

/// The placement of a frame B in a frame A.
///
/// A point with coordinates p in B has the coordinates `rotation * p + translation` in A.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose<T = f64> {
    /// The rotation matrix, whose columns are the axes of B in the axes of A.
    pub rotation: Matrix3<T>,
    /// The origin of B in A, m.
    pub translation: Vector3<T>,
}

impl<T: Number> Pose<T> {
    /// The identity: B coincides with A.
    pub fn identity() -> Self {
        Self { rotation: Matrix3::identity(), translation: Vector3::zeros() }
    }

    /// The placement of C in A, for the placement `self` of B in A and `next` of C in B.
    pub fn then(&self, next: &Self) -> Self {
        Self {
            rotation: self.rotation * next.rotation,
            translation: self.rotation * next.translation + self.translation,
        }
    }

    /// The placement of A in B.
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        Self { rotation, translation: -(rotation * self.translation) }
    }
}

impl Pose {
    /// The placement of a frame that is translated by `xyz` (m) and rotated by roll, pitch and yaw (rad) about fixed
    /// axes: R = Rz(yaw) Ry(pitch) Rx(roll).
    pub fn from_xyz_rpy(xyz: [f64; 3], rpy: [f64; 3]) -> Self {
        let [roll, pitch, yaw] = rpy;
        let turn = |axis, angle| rotation_about(&axis, angle);
        Self {
            rotation: turn(Vector3::z(), yaw)
                * turn(Vector3::y(), pitch)
                * turn(Vector3::x(), roll),
            translation: Vector3::from(xyz),
        }
    }

    /// Roll, pitch and yaw (rad) from which [`Pose::from_xyz_rpy`] computes this rotation to within rounding errors,
    /// with the pitch in −π/2 … π/2. At a pitch of ±π/2, only a combination of roll and yaw is determined, and the roll
    /// is set to zero.
    pub fn rpy(&self) -> [f64; 3] {
        let r = &self.rotation;
        let cos_pitch = r[(2, 1)].hypot(r[(2, 2)]);
        let roll = if cos_pitch < 1e-15 { 0.0 } else { r[(2, 1)].atan2(r[(2, 2)]) };
        // The yaw is computed from R Rx(roll)ᵀ = Rz Ry, whose second column never vanishes. It thus compensates for the
        // error of the roll at small cos(pitch).
        let second = r.column(1) * roll.cos() - r.column(2) * roll.sin();
        [roll, (-r[(2, 0)]).atan2(cos_pitch), (-second[0]).atan2(second[1])]
    }

    /// This placement in another kind of numbers.
    pub(super) fn cast<T: Number>(&self) -> Pose<T> {
        Pose {
            rotation: self.rotation.map(T::from_real),
            translation: self.translation.map(T::from_real),
        }
    }
}

/// The rotation by `angle` about the unit vector `axis` (Rodrigues' formula).
pub(super) fn rotation_about<T: Number>(axis: &Vector3<f64>, angle: T) -> Matrix3<T> {
    let (sin, cos) = angle.sin_cos();
    let along = (axis * axis.transpose()).map(T::from_real);
    let across = skew(&axis.map(T::from_real));
    Matrix3::identity() * cos + across * sin + along * (T::one() - cos)
}

/// The matrix of the cross product: `skew(a) * b` = a × b.
pub(super) fn skew<T: Number>(a: &Vector3<T>) -> Matrix3<T> {
    let o = T::zero();
    Matrix3::new(o, -a.z, a.y, a.z, o, -a.x, -a.y, a.x, o)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn rpy_gives_the_rotation_back_even_near_gimbal_lock() {
        let mut random = Random::new(3);
        for round in 0..200 {
            let tilt = 10f64.powi(-(round % 18));
            let pitch =
                [FRAC_PI_2 - tilt, tilt - FRAC_PI_2, FRAC_PI_2, tilt][round as usize / 18 % 4];
            let rpy = [random.uniform(-3.0, 3.0), pitch, random.uniform(-3.0, 3.0)];
            let pose = Pose::from_xyz_rpy([0.0; 3], rpy);
            let again = Pose::from_xyz_rpy([0.0; 3], pose.rpy());
            let error = (pose.rotation - again.rotation).abs().max();
            assert!(error < 4e-15, "{rpy:?}: {error:e}");
        }
    }

    #[test]
    fn rodrigues_keeps_the_axis_and_turns_right_handed() {
        let turned = rotation_about(&Vector3::z(), FRAC_PI_2) * Vector3::x();
        assert!((turned - Vector3::y()).norm() < 1e-15);
        let mut random = Random::new(4);
        let axis = random.unit_vector();
        let rotation = rotation_about(&axis, 0.7);
        assert!((rotation * axis - axis).norm() < 1e-15);
        assert!((rotation.transpose() * rotation - Matrix3::identity()).norm() < 1e-15);
        assert!((rotation.trace() - (1.0 + 2.0 * 0.7f64.cos())).abs() < 1e-15);
    }
}
