//! In what two robots differ: what their files say, the terms of their joint torques, the operations
//! of their functions, and the torques over a box of states.
//!
//! Links, joints, frames and parameters are matched by their names, joint torques by the numbers of
//! their coordinates, terms by their symbols. The names of the robots and remarks do not count.

mod equations;
mod items;
mod operations;
mod torques;

use robot_model::robot::Robot;

pub use equations::{Equation, Term};
pub use items::{Change, Item, ItemKind, Property};
pub use operations::Operations;
pub use torques::{State, StateBox, Torque, Torques};

/// The options of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The options of making code of either robot, for the operations: the plan, and the snapping of angles.
    /// The functions are all that the robot has, whatever is set here.
    pub code: [robot_build::Options; 2],
    /// The seed of the states.
    pub seed: u64,
    /// The number of states to draw.
    pub states: usize,
}

/// A comparison that failed: why, and the remedy if there is one.
pub type Refusal = String;

/// In what two robots differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The names of the robots.
    pub names: [String; 2],
    /// Parameters, links, joints and frames that came, went or changed, the first robot's in its order,
    /// then those that came.
    pub changes: Vec<Change>,
    /// The joint torques whose terms differ, or are too long to be expanded.
    pub equations: Vec<Equation>,
    /// The functions whose operations differ.
    pub operations: Result<Vec<Operations>, Refusal>,
    /// The largest change of the torque in each joint.
    pub torques: Result<Torques, Refusal>,
}

impl Difference {
    /// Whether nothing differs. Torques differ only if something else does.
    #[must_use]
    pub fn is_none(&self) -> bool {
        let operations = self.operations.as_ref().is_ok_and(|found| !found.is_empty());
        let equations = self.equations.iter().any(|equation| equation.terms.is_ok());
        self.changes.is_empty() && !equations && !operations
    }
}

/// Compares two robots.
///
/// A part that cannot be compared says why; the others are there all the same.
#[must_use]
pub fn difference(a: &Robot, b: &Robot, options: &Options) -> Difference {
    Difference {
        names: [a, b].map(|robot| robot.name.clone()),
        changes: items::changes(a, b),
        equations: equations::differing(a, b, options),
        operations: operations::differing(a, b, options),
        torques: torques::largest(a, b, options),
    }
}

#[cfg(test)]
mod tests;
