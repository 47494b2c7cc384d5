//! The largest changes of the joint torques over a range of states.

use std::f64::consts::PI;

use robot_model::robot::{Coordinate, JointKind, Robot};
use robot_numeric::robots::Random;
use robot_numeric::{Loads, Mechanism};

use crate::difference::{Options, Refusal};

/// The range from which states are drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct StateBox {
    /// The seed of the random states.
    pub seed: u64,
    /// The number of random states.
    pub states: usize,
    /// The lowest and highest position of each joint, rad or m: the range that is within the limits of both robots or,
    /// if neither has limits, ±π or ±0.5 m.
    pub positions: Vec<[f64; 2]>,
    /// The largest magnitude of a velocity, rad/s or m/s.
    pub velocity: f64,
    /// The largest magnitude of an acceleration, rad/s² or m/s².
    pub acceleration: f64,
}

/// A state: positions, velocities and accelerations.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// The joint positions, rad or m.
    pub q: Vec<f64>,
    /// The joint velocities, rad/s or m/s.
    pub qd: Vec<f64>,
    /// The joint accelerations, rad/s² or m/s².
    pub qdd: Vec<f64>,
}

/// The largest change of the joint torque of one joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Torque {
    /// The name of the joint in the first robot.
    pub joint: String,
    /// The kind of the joint: the torque is in N m for revolute and in N for prismatic joints.
    pub kind: JointKind,
    /// The joint torques of the two robots in this state, with friction and without wrenches at the tips.
    pub torques: [f64; 2],
    /// The state in which the change is largest.
    pub state: State,
    /// The largest magnitude of a joint torque in this state, of both robots, N m or N.
    pub largest: f64,
}

/// The errors of rounding in joint torques, relative to the largest of them.
const ROUNDING: f64 = 1e-13;

impl Torque {
    /// Whether the joint torques differ by more than rounding.
    #[must_use]
    pub fn differs(&self) -> bool {
        let [before, after] = self.torques;
        let change = (after - before).abs();
        change.is_nan() || change > ROUNDING * self.largest
    }
}

/// The largest changes, and the range of states from which they were found.
#[derive(Clone, Debug, PartialEq)]
pub struct Torques {
    /// The range of states.
    pub drawn: StateBox,
    /// The largest change for each joint.
    pub joints: Vec<Torque>,
}

/// The largest change of the joint torque of each joint.
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
        let magnitudes = first.iter().chain(second.iter()).map(|torque| torque.abs());
        let magnitude = magnitudes.fold(0.0, f64::max);
        let pairs = first.iter().zip(second.iter());
        for ((best, coordinate), (x, y)) in found.iter_mut().zip(&a.coordinates).zip(pairs) {
            let change = |torque: &Torque| (torque.torques[1] - torque.torques[0]).abs();
            if best.as_ref().is_none_or(|best| (y - x).abs() > change(best)) {
                *best = Some(Torque {
                    joint: coordinate.joint.clone(),
                    kind: coordinate.kind,
                    torques: [*x, *y],
                    state: state.clone(),
                    largest: magnitude,
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

/// The range of positions of each joint in both robots.
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
