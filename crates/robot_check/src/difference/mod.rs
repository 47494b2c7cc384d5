//! Differences between two robots: in the contents of their files, the terms of their joint torques, the operations of
//! their functions, and the joint torques over a range of states.
//!
//! Links, joints, frames and parameters are matched by their names, joint torques by the numbers of their coordinates,
//! and terms by their symbols. The names of the robots and remarks are ignored.

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
    /// The options of generating code for each robot, of which the operations are counted: the plan, and the snapping
    /// of angles. All functions that the robot has are compared, whatever these options select.
    pub code: [robot_build::Options; 2],
    /// The seed of the states.
    pub seed: u64,
    /// The number of random states.
    pub states: usize,
}

/// The reason why a comparison failed, with the remedy if there is one.
pub type Refusal = String;

/// The differences between two robots.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The names of the robots.
    pub names: [String; 2],
    /// The parameters, links, joints and frames that were added, removed or changed: first those of the first robot, in
    /// its order, then those that were added.
    pub changes: Vec<Change>,
    /// The joint torques whose terms differ or that are too long to be expanded.
    pub equations: Vec<Equation>,
    /// The functions whose numbers of operations differ.
    pub operations: Result<Vec<Operations>, Refusal>,
    /// The largest change of the joint torque of each joint.
    pub torques: Result<Torques, Refusal>,
}

impl Difference {
    /// Whether there are no differences. Joint torques only differ if something else does.
    #[must_use]
    pub fn is_none(&self) -> bool {
        let operations = self.operations.as_ref().is_ok_and(|found| !found.is_empty());
        let equations = self.equations.iter().any(|equation| equation.terms.is_ok());
        self.changes.is_empty() && !equations && !operations
    }
}

/// Compares two robots.
///
/// If a part cannot be compared, its result is the reason; the other parts are compared nevertheless.
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
