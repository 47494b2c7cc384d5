//! States at which functions are computed, from the command line, JSON or CSV.

mod arguments;
mod csv;
mod json;
mod node;

pub(crate) use arguments::StateArguments;

use robot_model::robot::Robot;
use robot_model::variable::{JointVariable, WRENCH, WRENCH_COMPONENTS};

/// The arrays that a state of a robot can have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    arrays: Vec<Array>,
}

/// An array of a state.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Array {
    /// The key in JSON, the name of the functions' input.
    name: String,
    /// The columns in CSV.
    columns: Vec<String>,
}

/// A state: the arrays that are given, right or wrong.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct State {
    /// Its place, for messages: `state 3`, `line 4`.
    pub(crate) place: String,
    arrays: Vec<(String, Vec<f64>)>,
}

impl State {
    /// The array of that name if it is given.
    pub(crate) fn array(&self, name: &str) -> Option<&[f64]> {
        let found = self.arrays.iter().find(|(known, _)| known == name);
        found.map(|(_, entries)| entries.as_slice())
    }

    /// The wrenches that are given and are not 0 in every component.
    pub(crate) fn wrenches(&self) -> impl Iterator<Item = &str> {
        let wrenches = self.arrays.iter().filter(|(name, entries)| {
            name.starts_with(WRENCH) && entries.iter().any(|entry| *entry != 0.0)
        });
        wrenches.map(|(name, _)| name.as_str())
    }
}

impl Layout {
    /// The arrays of a robot's states: `q`, `qd`, `qdd`, `tau`, and `wrench` or one for each tip.
    pub(crate) fn of(robot: &Robot) -> Layout {
        let mut arrays: Vec<Array> = JointVariable::ALL
            .map(|variable| Array {
                name: variable.name().to_owned(),
                columns: robot.symbols(variable),
            })
            .into();
        arrays.extend(robot.tips().map(|(tip, _)| wrench(&robot.wrench_suffix(tip))));
        if robot.tips().next().is_none() {
            // A robot without a tip takes a wrench of 0, so that one file of states suits all.
            arrays.push(wrench(""));
        }
        Layout { arrays }
    }

    fn names(&self) -> Vec<&str> {
        self.arrays.iter().map(|array| array.name.as_str()).collect()
    }

    fn columns(&self) -> Vec<&str> {
        let columns = self.arrays.iter().flat_map(|array| &array.columns);
        columns.map(String::as_str).collect()
    }

    /// Reads states, a JSON array of objects or CSV with a header, and says everything that is
    /// wrong, a message each. The states are of use for further checks in any case.
    pub(crate) fn read(&self, text: &str) -> (Vec<State>, Vec<String>) {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        match text.trim_start().chars().next() {
            None => (vec![], vec!["there are no states".to_owned()]),
            Some('[' | '{') => json::read(text, self),
            Some(_) => csv::read(text, self),
        }
    }
}

fn wrench(suffix: &str) -> Array {
    Array {
        name: format!("{WRENCH}{suffix}"),
        columns: WRENCH_COMPONENTS.map(|name| format!("{name}{suffix}")).into(),
    }
}

#[cfg(test)]
mod tests;
