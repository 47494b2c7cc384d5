//! Spatial vectors in Plücker coordinates: R. Featherstone, "Rigid Body Dynamics Algorithms",
//! Springer 2008, chapter 2.
//!
//! A motion vector is (angular; linear), and a force vector is (moment; force). Both are about the origin and in the
//! axes of the frame in which they are expressed.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use super::{
    mechanism::Link,
    pose::{Pose, skew},
    scalar::Number,
};

/// The spatial vector with the given angular (moment) and linear (force) halves.
pub(super) fn spatial<T: Number>(angular: &Vector3<T>, linear: &Vector3<T>) -> Vector6<T> {
    Vector6::new(angular.x, angular.y, angular.z, linear.x, linear.y, linear.z)
}

/// The angular half of a motion vector, or the moment of a force vector.
pub(super) fn angular<T: Number>(vector: &Vector6<T>) -> Vector3<T> {
    Vector3::new(vector[0], vector[1], vector[2])
}

/// The linear half of a motion vector, or the force of a force vector.
pub(super) fn linear<T: Number>(vector: &Vector6<T>) -> Vector3<T> {
    Vector3::new(vector[3], vector[4], vector[5])
}

fn blocks<T: Number>(
    [top_left, top_right]: [&Matrix3<T>; 2],
    [bottom_left, bottom_right]: [&Matrix3<T>; 2],
) -> Matrix6<T> {
    let mut matrix = Matrix6::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(top_left);
    matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(top_right);
    matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(bottom_left);
    matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(bottom_right);
    matrix
}

/// The Plücker transform X of motion vectors from A to B coordinates, for a given placement of B in A (section 2.8).
/// Its transpose transforms force vectors from B to A.
pub(super) fn motion_transform<T: Number>(pose: &Pose<T>) -> Matrix6<T> {
    let e = pose.rotation.transpose();
    let moved = -(e * skew(&pose.translation));
    blocks([&e, &Matrix3::zeros()], [&moved, &e])
}

/// v×: the cross product of a motion vector with motion vectors (2.31).
pub(super) fn cross_motion<T: Number>(v: &Vector6<T>) -> Matrix6<T> {
    let turning = skew(&angular(v));
    blocks([&turning, &Matrix3::zeros()], [&skew(&linear(v)), &turning])
}

/// v×*: the cross product of a motion vector with force vectors (2.32).
pub(super) fn cross_force<T: Number>(v: &Vector6<T>) -> Matrix6<T> {
    -cross_motion(v).transpose()
}

/// The cross product v×* f as a linear map of v: `cross_force(v) * f` = `cross_on(f) * v`.
pub(super) fn cross_on<T: Number>(f: &Vector6<T>) -> Matrix6<T> {
    let force = -skew(&linear(f));
    blocks([&-skew(&angular(f)), &force], [&force, &Matrix3::zeros()])
}

/// The spatial inertia of a link about the origin of its frame (2.63).
pub(super) fn rigid_body_inertia<T: Number>(link: &Link) -> Matrix6<T> {
    let c = skew(&link.center_of_mass);
    let first_moment = c * link.mass;
    let about_origin = link.inertia + first_moment * c.transpose();
    let mass = Matrix3::identity() * link.mass;
    blocks([&about_origin, &first_moment], [&first_moment.transpose(), &mass]).map(T::from_real)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn vector(random: &mut Random) -> Vector6<f64> {
        Vector6::from_fn(|_, _| random.uniform(-1.0, 1.0))
    }

    #[test]
    fn cross_products_agree_with_their_definitions() {
        let mut random = Random::new(1);
        let (v, f) = (vector(&mut random), vector(&mut random));
        let expected = spatial(
            &(angular(&v).cross(&angular(&f)) + linear(&v).cross(&linear(&f))),
            &angular(&v).cross(&linear(&f)),
        );
        assert!((cross_force(&v) * f - expected).norm() < 1e-15);
        assert!((cross_on(&f) * v - expected).norm() < 1e-15);
        assert!((cross_motion(&v) * v).norm() < 1e-15);
    }

    #[test]
    fn transforms_compose_and_keep_power() {
        let mut random = Random::new(2);
        let (a, b) = (random.pose(), random.pose());
        let both = motion_transform(&b) * motion_transform(&a);
        assert!((motion_transform(&a.then(&b)) - both).norm() < 1e-14);
        let undone = motion_transform(&a.inverse()) * motion_transform(&a);
        assert!((undone - Matrix6::identity()).norm() < 1e-14);
        let (v, f) = (vector(&mut random), vector(&mut random));
        let x = motion_transform(&a);
        assert!(((x * v).dot(&f) - v.dot(&(x.transpose() * f))).abs() < 1e-14);
    }
}
