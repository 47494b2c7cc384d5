//! A second derivation, from energy: Lagrange's equations by symbolic differentiation of T − V
//! agree with the Newton–Euler iterations exactly, the difference zero after expansion.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

mod common;

use robot_dynamics::economical::{Plan, Recursion};
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_dynamics::model::Robot;
use robot_dynamics::newton_euler::{Effects, newton_euler};
use robot_dynamics::numeric::random::{Random, Recipe};
use robot_dynamics::random;
use robot_dynamics::vector::{Matrix, Vector};
use robot_symbolic::polynomial::expands_to_zero;
use robot_symbolic::{Expr, Graph, walk};

/// The coordinates and their derivatives by time.
struct Motion<'g> {
    q: Vec<Expr<'g>>,
    qd: Vec<Expr<'g>>,
    qdd: Vec<Expr<'g>>,
}

impl<'g> Motion<'g> {
    fn new(mechanism: &Mechanism<'g>) -> Motion<'g> {
        let symbols = |prefix: &str| {
            let numbers = 1..=mechanism.degrees_of_freedom;
            numbers.map(|n| mechanism.graph.symbol(&format!("{prefix}{n}"))).collect()
        };
        Motion { q: symbols("q"), qd: symbols("qd"), qdd: symbols("qdd") }
    }

    /// The derivative by time of functions of q and q̇.
    fn rate(&self, values: &[Expr<'g>]) -> Vec<Expr<'g>> {
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

/// T − V, from the poses of the links in the base frame alone.
fn lagrangian<'g>(mechanism: &Mechanism<'g>, motion: &Motion<'g>) -> Expr<'g> {
    let graph = mechanism.graph;
    let mut poses: Vec<(Matrix<'g>, Vector<'g>)> = vec![];
    let mut sum = graph.zero();
    for link in &mechanism.links {
        let (rotation, origin) = (link.joint_rotation(), link.joint_translation());
        let (rotation, origin) = match link.parent.map(|parent| poses[parent]) {
            Some((outer, place)) => (outer * rotation, place + outer * origin),
            None => (rotation, origin),
        };
        poses.push((rotation, origin));
        let centre = origin + rotation * link.center_of_mass;
        let velocity = motion.rate(&centre.0);
        let velocity = Vector([velocity[0], velocity[1], velocity[2]]);
        // Rᵀ Ṙ = [ω]× in the link's axes.
        let entries: Vec<_> = rotation.0.iter().flatten().copied().collect();
        let rates = motion.rate(&entries);
        let spin = rotation.transpose() * Matrix::from_fn(|row, column| rates[3 * row + column]);
        let omega = Vector([spin.0[2][1], spin.0[0][2], spin.0[1][0]]);
        let kinetic = (link.mass * velocity.dot(velocity) + omega.dot(link.inertia * omega)) / 2;
        let potential = -(link.mass * mechanism.gravity.dot(centre));
        sum += kinetic - potential + link.reflected_inertia * link.velocity * link.velocity / 2;
    }
    sum
}

/// Checks each coordinate's equation; the number of recursions that were compared.
fn check(robot: &Robot, name: &str) -> usize {
    let graph = Graph::new();
    let mechanism = Mechanism::new(robot, &graph, &MechanismOptions::EXACT);
    let motion = Motion::new(&mechanism);
    let lagrangian = lagrangian(&mechanism, &motion);
    let effects = Effects { wrench: false, friction: false };
    let mut torques = vec![("iterations", newton_euler(&mechanism, effects).driving_forces)];
    // With a skew axis of irrational exact components there are no working frames; the numeric
    // tests cover those.
    if let Some(recursion) = Recursion::new(&mechanism, &Plan::default_for(robot)) {
        torques.push(("economical recursion", recursion.inverse_dynamics(false)));
    }
    for (index, (q, qd)) in motion.q.iter().zip(&motion.qd).enumerate() {
        // d/dt ∂L/∂q̇ − ∂L/∂q
        let momentum = lagrangian.derivative(*qd);
        let force = motion.rate(&[momentum])[0] - lagrangian.derivative(*q);
        for (recursion, torques) in &torques {
            let difference = force - torques[index];
            let zero = expands_to_zero(difference)
                .unwrap_or_else(|error| panic!("{name}, Q{}: {error}", index + 1));
            assert!(zero, "{name}: Lagrange's Q{} is not that of the {recursion}", index + 1);
        }
    }
    torques.len()
}

#[test]
fn trttr1_and_the_planar_arms() {
    for name in ["trttr1", "planar_2r", "planar_3r"] {
        assert_eq!(check(&common::robot(name), name), 2);
    }
}

#[test]
fn random_robots_of_up_to_three_joints() {
    // Three joints about skew axes take seconds: their expansions have 10⁵ terms.
    let robots = [(0, 1), (1, 2), (2, 3), (3, 1), (4, 2), (6, 1), (7, 2), (10, 2), (13, 2)];
    for (seed, joints) in robots {
        let robot = random::robot(&mut Random::new(seed), &Recipe::serial(joints));
        check(&robot, &format!("seed {seed}, {joints} joints"));
    }
}

#[test]
fn random_parametrised_robots() {
    for seed in 100..106 {
        let joints = 1 + seed as usize % 2;
        let robot = random::robot(&mut Random::new(seed), &Recipe::serial(joints));
        check(&random::parametrised(&robot), &format!("seed {seed}, {joints} joints"));
    }
}
