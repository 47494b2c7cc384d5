//! States at which functions are computed, from the command line, JSON or CSV.

mod arguments;
mod csv;
mod exponents;
mod input;
mod json;
mod node;

use std::fmt;
use std::ops::ControlFlow;

pub(crate) use arguments::StateArguments;
pub(crate) use input::Input;

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
    /// The key in JSON, which is the name of the input of functions.
    name: String,
    /// The names of the columns in CSV.
    columns: Vec<String>,
}

/// A state: the given arrays, valid or not.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct State<'l> {
    layout: &'l Layout,
    /// The place of the state, for messages.
    pub(crate) place: Place,
    /// For each array of the layout, its entries if it is given.
    arrays: Vec<Entries>,
}

/// The entries of an array. An array that is not given keeps its memory for the next state.
#[derive(Clone, Debug, Default, PartialEq)]
struct Entries {
    are_given: bool,
    entries: Vec<f64>,
}

/// The place of a state in the input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    CommandLine,
    /// The header of a table.
    Header,
    /// The line of a file, from 1.
    Line(usize),
    /// The element of an array, from 1.
    Element(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::CommandLine => formatter.write_str("the command line"),
            Place::Header => formatter.write_str("the header"),
            Place::Line(number) => write!(formatter, "line {number}"),
            Place::Element(number) => write!(formatter, "state {number}"),
        }
    }
}

/// A receiver of states while they are read, and of messages about their errors.
pub(crate) trait Sink<'l> {
    /// Receives a state, valid or not, and can exchange it for another one, whose memory is then reused. Returns
    /// whether to continue.
    fn state(&mut self, state: &mut State<'l>) -> ControlFlow<()>;

    /// Receives a message about an error in the whole input, or in a state before that state is received.
    fn error(&mut self, message: String);

    /// Receives what each state of a table without states would have, at the place of the header.
    fn header(&mut self, _: &State<'l>) {}

    /// Receives the reason why there are no states at all; all earlier states and messages become invalid.
    fn no_states(&mut self, message: String);
}

impl<'l> State<'l> {
    /// A state without any given array.
    pub(crate) fn new(layout: &'l Layout) -> State<'l> {
        let arrays = vec![Entries::default(); layout.arrays.len()];
        State { layout, place: Place::CommandLine, arrays }
    }

    /// Turns it into a state at another place, without any given array.
    fn clear(&mut self, place: Place) {
        self.place = place;
        self.arrays.iter_mut().for_each(|array| array.are_given = false);
    }

    /// Marks an array as given, by its index in the layout, and returns it empty.
    fn begin_array(&mut self, index: usize) -> &mut Vec<f64> {
        let array = &mut self.arrays[index];
        array.are_given = true;
        array.entries.clear();
        &mut array.entries
    }

    /// The array with this name, if it is given.
    pub(crate) fn array(&self, name: &str) -> Option<&[f64]> {
        self.layout.position(name).and_then(|index| self.at(index))
    }

    /// The array with this index in the layout, if it is given.
    pub(crate) fn at(&self, index: usize) -> Option<&[f64]> {
        let array = self.arrays.get(index).filter(|array| array.are_given);
        array.map(|array| array.entries.as_slice())
    }

    /// Whether a wrench with a component other than 0 is given.
    pub(crate) fn has_wrench(&self) -> bool {
        let mut arrays = self.layout.arrays.iter().zip(&self.arrays);
        arrays.any(|(array, Entries { are_given, entries })| {
            *are_given && array.is_wrench() && entries.iter().any(|entry| *entry != 0.0)
        })
    }
}

impl Array {
    fn is_wrench(&self) -> bool {
        self.name.starts_with(WRENCH)
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
            // A robot without a tip accepts a wrench of 0, so that one file of states works for all robots.
            arrays.push(wrench(""));
        }
        Layout { arrays }
    }

    /// The index of the array with this name.
    pub(crate) fn position(&self, name: &str) -> Option<usize> {
        self.arrays.iter().position(|array| array.name == name)
    }

    fn names(&self) -> Vec<&str> {
        self.arrays.iter().map(|array| array.name.as_str()).collect()
    }

    fn columns(&self) -> Vec<&str> {
        let columns = self.arrays.iter().flat_map(|array| &array.columns);
        columns.map(String::as_str).collect()
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
