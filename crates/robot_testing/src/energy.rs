//! Kinetic and potential energy in symbols, derived only from the poses of the links.

use robot_dynamics::mechanism::Mechanism;
use robot_dynamics::vector::{Matrix, Vector};
use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, walk};

/// The coordinates and their time derivatives.
pub struct Motion<'g> {
    /// The positions q.
    pub q: Vec<Expr<'g>>,
    /// The velocities q̇.
    pub qd: Vec<Expr<'g>>,
    /// The accelerations q̈.
    pub qdd: Vec<Expr<'g>>,
}

impl<'g> Motion<'g> {
    /// Creates the symbols `q1`, `qd1`, `qdd1` and so on.
    pub fn new(mechanism: &Mechanism<'g>) -> Motion<'g> {
        let symbols = |variable: JointVariable| {
            let names = variable.symbols(mechanism.degrees_of_freedom);
            names.iter().map(|name| mechanism.graph.symbol(name)).collect()
        };
        Motion {
            q: symbols(JointVariable::Position),
            qd: symbols(JointVariable::Velocity),
            qdd: symbols(JointVariable::Acceleration),
        }
    }

    /// The time derivatives of functions of q and q̇.
    pub fn rate(&self, values: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let mut rates = vec![values[0].graph().zero(); values.len()];
        let pairs = self.q.iter().zip(&self.qd).chain(self.qd.iter().zip(&self.qdd));
        for (symbol, rate) in pairs {
            for (sum, slope) in rates.iter_mut().zip(walk::derivatives(values, *symbol)) {
                *sum += slope * *rate;
            }
        }
        rates
    }
}

/// The kinetic energy T and the potential energy V, from the poses of the links in the base frame.
pub fn energies<'g>(mechanism: &Mechanism<'g>, motion: &Motion<'g>) -> (Expr<'g>, Expr<'g>) {
    let graph = mechanism.graph;
    let mut poses: Vec<(Matrix<'g>, Vector<'g>)> = vec![];
    let (mut kinetic, mut potential) = (graph.zero(), graph.zero());
    for link in &mechanism.links {
        let (rotation, origin) = (link.joint_rotation(), link.joint_translation());
        let (rotation, origin) = match link.parent.map(|parent| poses[parent]) {
            Some((outer, place)) => (outer * rotation, place + outer * origin),
            None => (rotation, origin),
        };
        poses.push((rotation, origin));
        let center = origin + rotation * link.center_of_mass;
        let velocity = motion.rate(&center.0);
        let velocity = Vector([velocity[0], velocity[1], velocity[2]]);
        // Rᵀ Ṙ = [ω]× in the link's axes.
        let entries: Vec<_> = rotation.0.iter().flatten().copied().collect();
        let rates = motion.rate(&entries);
        let spin = rotation.transpose() * Matrix::from_fn(|row, column| rates[3 * row + column]);
        let omega = Vector([spin.0[2][1], spin.0[0][2], spin.0[1][0]]);
        let squares = link.mass * velocity.dot(velocity)
            + omega.dot(link.inertia * omega)
            + link.reflected_inertia * link.velocity * link.velocity;
        kinetic += squares / 2;
        potential -= link.mass * mechanism.gravity.dot(center);
    }
    (kinetic, potential)
}
