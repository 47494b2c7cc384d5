//! The potential energy of inertia that regrouping moves to the base.

use robot_dynamics::economical::{Plan, Recursion};
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_numeric::random::Random;
use robot_symbolic::Graph;

use robot_testing::plans::random_plan;
use robot_testing::read;

/// V = m g z of a post that turns about the vertical: the energy is constant and affects no joint.
#[test]
fn what_no_joint_feels_has_potential_energy() {
    let text = "format = 1\n[robot]\nname = \"a\"\n[[link]]\nname = \"1\"\n\
                joint = { type = \"revolute\", axis = \"z\" }\norigin = { xyz = [0, 0, 2] }\nmass = 5\n\
                center_of_mass = [0.1, 0, 0.25]\ninertia = { xx = 1, yy = 1, zz = 1 }\n";
    let robot = read("a.toml", text);
    let graph = Graph::new();
    let mechanism = Mechanism::new(&robot, &graph, &MechanismOptions::ROUNDED);
    let mut random = Random::new(1);
    let mut plans = vec![Plan::default_for(&robot)];
    plans.extend((0..20).map(|_| random_plan(&mut random, &robot)));
    for plan in plans {
        let recursion = Recursion::new(&mechanism, &plan).unwrap();
        let found = recursion.potential_energy().evaluate(|_| 0.7);
        let expected = 9.81 * 5.0 * 2.25;
        assert!((found - expected).abs() < 1e-9, "V is {found}, not {expected}\n{plan:?}");
    }
}
