//! The largest change of the torques over a box of states.

use std::f64::consts::PI;

use robot_model::robot::{Coordinate, JointKind, Robot};
use robot_numeric::robots::Random;
use robot_numeric::{Loads, Mechanism};

use crate::difference::{Options, Refusal};

/// The range that states are drawn from.
#[derive(Clone, Debug, PartialEq)]
pub struct StateBox {
    /// The seed.
    pub seed: u64,
    /// The number of states.
    pub states: usize,
    /// Lowest and highest position of each joint, rad or m: the limits that both robots keep; where
    /// neither has any, ±π and ±0.5 m.
    pub positions: Vec<[f64; 2]>,
    /// The largest velocity of either sign, rad/s or m/s.
    pub velocity: f64,
    /// The largest acceleration of either sign, rad/s² or m/s².
    pub acceleration: f64,
}

/// Positions, velocities and accelerations, in SI units and radians.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Positions.
    pub q: Vec<f64>,
    /// Velocities.
    pub qd: Vec<f64>,
    /// Accelerations.
    pub qdd: Vec<f64>,
}

/// The largest change in a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Torque {
    /// The joint of the first robot.
    pub joint: String,
    /// Rotation (N m) or translation (N).
    pub kind: JointKind,
    /// The joint torques of the two robots in that state, friction included, no wrench at the tips.
    pub torques: [f64; 2],
    /// The state.
    pub state: State,
}

/// The largest changes, and where they were sought.
#[derive(Clone, Debug, PartialEq)]
pub struct Torques {
    /// The box.
    pub drawn: StateBox,
    /// A change for each joint.
    pub joints: Vec<Torque>,
}

/// The largest change of the torque in each joint.
pub(crate) fn largest(a: &Robot, b: &Robot, options: &Options) -> Result<Torques, Refusal> {
    let drawn = StateBox {
        seed: options.seed,
        states: options.states,
        positions: positions(a, b)?,
        velocity: 2.0,
        acceleration: 5.0,
    };
    let solver = |robot: &Robot| {
        Mechanism::nominal(robot).map_err(|error| format!("{}: {error}", robot.name))
    };
    let (before, after) = (solver(a)?, solver(b)?);
    let loads = Loads { friction: true, ..Loads::default() };
    let mut random = Random::new(options.seed);
    let mut found: Vec<Option<Torque>> = vec![None; a.coordinates.len()];
    for _ in 0..options.states {
        let state = drawn.state(&mut random);
        let State { q, qd, qdd } = &state;
        let torques = |mechanism: &Mechanism| {
            let torques = mechanism.inverse_dynamics_with(q, qd, qdd, &loads);
            torques.map_err(|error| error.to_string())
        };
        let (first, second) = (torques(&before)?, torques(&after)?);
        let pairs = first.iter().zip(second.iter());
        for ((best, coordinate), (x, y)) in found.iter_mut().zip(&a.coordinates).zip(pairs) {
            let change = |torque: &Torque| (torque.torques[1] - torque.torques[0]).abs();
            if best.as_ref().is_none_or(|best| (y - x).abs() > change(best)) {
                *best = Some(Torque {
                    joint: coordinate.joint.clone(),
                    kind: coordinate.kind,
                    torques: [*x, *y],
                    state: state.clone(),
                });
            }
        }
    }
    Ok(Torques { drawn, joints: found.into_iter().flatten().collect() })
}

impl StateBox {
    fn state(&self, random: &mut Random) -> State {
        let q = self.positions.iter().map(|[low, high]| random.uniform(*low, *high)).collect();
        let mut within =
            |size: f64| self.positions.iter().map(|_| random.uniform(-size, size)).collect();
        State { q, qd: within(self.velocity), qdd: within(self.acceleration) }
    }
}

/// The positions of each joint that both robots have.
fn positions(a: &Robot, b: &Robot) -> Result<Vec<[f64; 2]>, Refusal> {
    let kinds = |robot: &Robot| robot.coordinates.iter().map(|one| one.kind).collect::<Vec<_>>();
    if kinds(a) != kinds(b) {
        return Err(
            "the robots have different coordinates, so they cannot be compared at the same states"
                .to_owned(),
        );
    }
    a.coordinates.iter().zip(&b.coordinates).map(|(one, other)| shared(one, other)).collect()
}

fn shared(one: &Coordinate, other: &Coordinate) -> Result<[f64; 2], Refusal> {
    let limits = |coordinate: &Coordinate| {
        coordinate
            .limits
            .as_ref()
            .map(|limits| limits.each_ref().map(robot_symbolic::Rational::to_f64))
    };
    let [low, high] = match (limits(one), limits(other)) {
        (Some([a, b]), Some([c, d])) => [a.max(c), b.min(d)],
        (Some(limits), None) | (None, Some(limits)) => limits,
        (None, None) => match one.kind {
            JointKind::Revolute => [-PI, PI],
            JointKind::Prismatic => [-0.5, 0.5],
        },
    };
    if low <= high {
        return Ok([low, high]);
    }
    Err(format!(
        "the limits of joint `{}` do not overlap, so the robots cannot be compared at the same \
         states",
        one.joint
    ))
}
