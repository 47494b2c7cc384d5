//! Plans of the economical recursion.

use robot_dynamics::economical::{
    Plan,
    plan::{Entry, FreeAcceleration, LinkPlan, Origin, Place, Turn},
};
use robot_model::robot::Robot;
use robot_numeric::random::Random;

/// A plan in which every option is chosen at random.
pub fn random_plan(random: &mut Random, robot: &Robot) -> Plan {
    let mut link = |index: usize| LinkPlan {
        origin: [
            Origin::File,
            Origin::NextNormal,
            Origin::PreviousNormal,
            Origin::ZeroXz,
            Origin::ZeroYz,
            Origin::CenterOfMass,
            Origin::Parent,
        ][random.index(7)],
        turn: [Turn::File, Turn::NextNormal, Turn::FirstMoment][random.index(3)],
        angle_sum: random.once_in(2),
        column: random.once_in(2),
        doubled: random.once_in(2),
        diagonal: random.once_in(2),
        moment: [0; 3].map(|_| random.once_in(2)),
        residual: [0; 3].map(|_| random.once_in(3).then(|| Entry::ALL[random.index(8)])),
        free: FreeAcceleration::ALL[random.index(6)],
        composite_sum: random.once_in(2),
        projected_at: random
            .once_in(2)
            .then(|| Place { link: random.index(index + 1), turned: random.once_in(2) }),
    };
    let links: Vec<LinkPlan> = (0..robot.links.len()).map(&mut link).collect();
    let unit_length = random.once_in(2).then(|| (random.index(links.len()), random.index(3)));
    Plan { links, unit_length }
}
