//! The paper's iterations with sums that keep the order in which they are written. [`robot_dynamics::newton_euler`] has
//! them with expressions, whose operands have no order.

use robot_dynamics::mechanism::{Mechanism, MechanismLink};
use robot_dynamics::quantity::Kind;
use robot_dynamics::vector::{Matrix, Vector};
use robot_model::robot::JointKind;
use robot_symbolic::{Expr, Polynomial, PolynomialError};

use super::sums::Sum;
use crate::layout::Order;

/// Three sums.
#[derive(Clone, Debug, Default)]
pub(super) struct Column<'g>(pub(super) [Sum<'g>; 3]);

/// The vectors of all links, by their kinds.
#[derive(Debug, Default)]
pub(super) struct Iterations<'g> {
    rotations: Vec<[Column<'g>; 3]>,
    origins: Vec<Column<'g>>,
    angular_velocities: Vec<Column<'g>>,
    angular_accelerations: Vec<Column<'g>>,
    accelerations: Vec<Column<'g>>,
    of_centers: Vec<Column<'g>>,
    forces: Vec<Column<'g>>,
    moments: Vec<Column<'g>>,
    joint_forces: Vec<Column<'g>>,
    joint_moments: Vec<Column<'g>>,
}

/// Converts expressions of the mechanism to sums, with lengths after coordinates, as in (12).
pub(super) struct Reader<'o, 'r>(pub(super) &'o Order<'r>);

impl Reader<'_, '_> {
    pub(super) fn sum<'g>(&self, value: Expr<'g>) -> Result<Sum<'g>, PolynomialError> {
        let polynomial = Polynomial::of(value, &super::super::expanded::LIMITS)?;
        Ok(Sum::of_terms(&polynomial.arranged(|atom| (!self.0.is_motion(atom), self.0.rank(atom)))))
    }

    fn column<'g>(&self, Vector([x, y, z]): Vector<'g>) -> Result<Column<'g>, PolynomialError> {
        Ok(Column([self.sum(x)?, self.sum(y)?, self.sum(z)?]))
    }

    fn rows<'g>(&self, Matrix([x, y, z]): Matrix<'g>) -> Result<[Column<'g>; 3], PolynomialError> {
        Ok([self.column(Vector(x))?, self.column(Vector(y))?, self.column(Vector(z))?])
    }
}

impl<'g> Iterations<'g> {
    /// Carries out the outward and the inward iteration.
    pub(super) fn new(
        mechanism: &Mechanism<'g>,
        reader: &Reader<'_, '_>,
    ) -> Result<Iterations<'g>, PolynomialError> {
        let mut all = Iterations::default();
        for link in &mechanism.links {
            all.outward(link, mechanism, reader)?;
        }
        all.inward(mechanism, reader)?;
        Ok(all)
    }

    /// The vectors of a kind, link by link; none for joint torques.
    pub(super) fn vectors(&self, kind: Kind) -> &[Column<'g>] {
        match kind {
            Kind::CenterOfMassAcceleration => &self.of_centers,
            Kind::Force => &self.forces,
            Kind::Moment => &self.moments,
            Kind::LinkForce => &self.joint_forces,
            Kind::LinkMoment => &self.joint_moments,
            Kind::JointTorque => &[],
        }
    }

    fn outward(
        &mut self,
        link: &MechanismLink<'g>,
        mechanism: &Mechanism<'g>,
        reader: &Reader<'_, '_>,
    ) -> Result<(), PolynomialError> {
        let rotation = reader.rows(link.joint_rotation())?;
        let back = reader.rows(link.joint_rotation().transpose())?;
        let origin = reader.column(link.joint_translation())?;
        let (mut omega, mut epsilon, mut a) = match link.parent {
            Some(parent) => (
                self.angular_velocities[parent].clone(),
                self.angular_accelerations[parent].clone(),
                self.accelerations[parent].clone(),
            ),
            // Gravity enters as an opposite acceleration of the base.
            None => {
                let gravity = reader.column(mechanism.gravity)?;
                (Column::default(), Column::default(), gravity.negative())
            }
        };
        a = a.plus(epsilon.cross(&origin)).plus(omega.cross(&omega.cross(&origin)));
        (omega, epsilon, a) = (omega.turned(&back), epsilon.turned(&back), a.turned(&back));
        let axis = reader.column(link.axis)?;
        let (velocity, rate) = (reader.sum(link.velocity)?, reader.sum(link.acceleration)?);
        let coriolis = omega.cross(&axis).times(&velocity);
        match link.kind {
            JointKind::Revolute => {
                epsilon = epsilon.plus(coriolis).plus(axis.times(&rate));
                omega = omega.plus(axis.times(&velocity));
            }
            JointKind::Prismatic => {
                let two = reader.sum(mechanism.graph.integer(2))?;
                a = a.plus(coriolis.times(&two)).plus(axis.times(&rate));
            }
        }
        let r = reader.column(link.center_of_mass)?;
        let inertia = reader.rows(link.inertia)?;
        let of_center = a // (8)
            .clone()
            .plus(epsilon.cross(&r))
            .plus(omega.cross(&omega.cross(&r)));
        self.forces.push(of_center.times(&reader.sum(link.mass)?)); // (14)
        let spin = omega.cross(&omega.turned(&inertia));
        self.moments.push(epsilon.turned(&inertia).plus(spin)); // (20)
        self.of_centers.push(of_center);
        self.rotations.push(rotation);
        self.origins.push(origin);
        self.angular_velocities.push(omega);
        self.angular_accelerations.push(epsilon);
        self.accelerations.push(a);
        Ok(())
    }

    fn inward(
        &mut self,
        mechanism: &Mechanism<'g>,
        reader: &Reader<'_, '_>,
    ) -> Result<(), PolynomialError> {
        // The wrenches from tips and children, in the order of (26) and (36): the rotated moments, then the shifted
        // forces.
        let mut forces = vec![Column::default(); mechanism.links.len()];
        let mut turned = forces.clone();
        let mut shifted = forces.clone();
        let tips =
            mechanism.frames.iter().filter_map(|frame| Some((frame, frame.link?, frame.wrench?)));
        for (frame, link, (force, moment)) in tips {
            let rotation = reader.rows(frame.rotation)?;
            let force = reader.column(force)?.turned(&rotation);
            turned[link].add(reader.column(moment)?.turned(&rotation));
            shifted[link].add(reader.column(frame.translation)?.cross(&force));
            forces[link].add(force);
        }
        self.joint_forces = forces.clone();
        self.joint_moments = forces.clone();
        for (index, link) in mechanism.links.iter().enumerate().rev() {
            let r = reader.column(link.center_of_mass)?;
            let force = std::mem::take(&mut forces[index]).plus(self.forces[index].clone());
            let moment = std::mem::take(&mut turned[index])
                .plus(r.cross(&self.forces[index]))
                .plus(std::mem::take(&mut shifted[index]))
                .plus(self.moments[index].clone());
            if let Some(parent) = link.parent {
                let carried = force.turned(&self.rotations[index]);
                turned[parent].add(moment.turned(&self.rotations[index]));
                shifted[parent].add(self.origins[index].cross(&carried));
                forces[parent].add(carried);
            }
            self.joint_forces[index] = force;
            self.joint_moments[index] = moment;
        }
        Ok(())
    }
}

impl<'g> Column<'g> {
    fn plus(self, other: Column<'g>) -> Column<'g> {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Column([a.plus(x), b.plus(y), c.plus(z)])
    }

    fn add(&mut self, other: Column<'g>) {
        *self = std::mem::take(self).plus(other);
    }

    fn negative(self) -> Column<'g> {
        Column(self.0.map(Sum::negative))
    }

    /// The product of a scalar and the vector.
    fn times(&self, factor: &Sum<'g>) -> Column<'g> {
        Column(self.0.each_ref().map(|component| factor.times(component)))
    }

    /// The product of a matrix, given by its rows, and the vector.
    fn turned(&self, rows: &[Column<'g>; 3]) -> Column<'g> {
        Column(rows.each_ref().map(|row| row.dot(self)))
    }

    /// The scalar product.
    pub(super) fn dot(&self, other: &Column<'g>) -> Sum<'g> {
        let products = self.0.iter().zip(&other.0).map(|(a, b)| a.times(b));
        products.fold(Sum::default(), Sum::plus)
    }

    /// The cross product, computed row by row as the skew-symmetric matrix of the first vector times the second.
    fn cross(&self, other: &Column<'g>) -> Column<'g> {
        let ([a, b, c], [x, y, z]) = (&self.0, &other.0);
        Column([
            c.times(y).negative().plus(b.times(z)),
            c.times(x).plus(a.times(z).negative()),
            b.times(x).negative().plus(a.times(y)),
        ])
    }
}
