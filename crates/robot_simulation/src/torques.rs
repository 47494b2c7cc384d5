//! Joint torques over time: none, expressions, or tables.

use std::collections::BTreeMap;

use robot_model::diagnostic::{number, quote};
use robot_model::robot::Robot;
use robot_model::variable::JointVariable;
use robot_symbolic::Formula;

use crate::contributions::TorqueContributions;
use crate::csv::unit;
use crate::dynamics::{Features, State, TorqueLaw};
use crate::error::Error;
use crate::motion::is_energy;
use crate::table::{Table, check_times};
use crate::{expressions, features};

/// Joint torques over time, in N m or N.
#[derive(Clone, Debug)]
pub struct Torques(Law);

#[derive(Clone, Debug)]
enum Law {
    /// A formula for each coordinate, and the meanings of the names in them.
    Formulas { formulas: Vec<Formula>, meanings: BTreeMap<String, Meaning> },
    /// The samples of each coordinate over time.
    Samples { t: Vec<f64>, columns: Vec<Vec<f64>> },
}

/// The meaning of a name in a formula.
#[derive(Clone, Copy, Debug)]
enum Meaning {
    Time,
    Position(usize),
    Velocity(usize),
    Value(f64),
}

impl Torques {
    /// No joint torques for this many coordinates.
    #[must_use]
    pub fn none(degrees_of_freedom: usize) -> Torques {
        let zero = Formula::number(&robot_symbolic::Rational::ZERO);
        let formulas = vec![zero; degrees_of_freedom];
        Torques(Law::Formulas { formulas, meanings: BTreeMap::new() })
    }

    /// Reads expressions such as `2 = -5*qd2 + sin(t)`: a coordinate, given by its number (`2` or `tau2`) or the name
    /// of its joint, and a formula in t (s), q1 …, qd1 … and the robot's parameters. A coordinate without an expression
    /// is not driven. `parameters` are those with other than their nominal values.
    ///
    /// # Errors
    ///
    /// All errors in the texts.
    pub fn from_expressions(
        robot: &Robot,
        parameters: &[(&str, f64)],
        texts: &[impl AsRef<str>],
    ) -> Result<Torques, Error> {
        let count = robot.degrees_of_freedom();
        let meanings = meanings(robot, parameters);
        let mut formulas: Vec<Option<Formula>> = vec![None; count];
        let mut wrong = vec![];
        let known = "t, q1 …, qd1 … and the robot's parameters";
        for text in texts {
            let found =
                expressions::assignment(text.as_ref(), |name| meanings.contains_key(name), known);
            let (name, formula) = match found {
                Ok(found) => found,
                Err(message) => {
                    wrong.push(format!("torque {message}"));
                    continue;
                }
            };
            match coordinate(robot, name).map(|index| formulas.get_mut(index)) {
                Ok(Some(place @ None)) => *place = Some(formula),
                Ok(_) => {
                    wrong.push(format!("torque `{}` is given twice; leave one out", quote(name)));
                }
                Err(message) => wrong.push(message),
            }
        }
        let zero = Formula::number(&robot_symbolic::Rational::ZERO);
        let formulas = formulas.into_iter().map(|one| one.unwrap_or_else(|| zero.clone()));
        let formulas = formulas.collect();
        Error::check(wrong, Torques(Law::Formulas { formulas, meanings }))
    }

    /// Reads the samples of a table with the column t (s), whose values must increase, and a column `tau1` … for each
    /// coordinate; the other columns of a motion, and the contributions to
    /// torques, are ignored. Torques are linear in t between samples and constant
    /// outside them, but the samples must cover the `duration` (s).
    ///
    /// # Errors
    ///
    /// All errors in the table; `source` is its name in messages.
    pub fn from_table(
        robot: &Robot,
        source: &str,
        table: &Table,
        duration: f64,
    ) -> Result<Torques, Error> {
        let mut wrong = check_times(source, table);
        let t = table.column("t").unwrap_or_default();
        let first = t.iter().copied().reduce(f64::min);
        // Times can decrease, which is another error.
        let last = t.iter().copied().reduce(f64::max);
        if let (Some(first), Some(last)) = (first, last)
            && (first > 0.0 || last < duration)
        {
            wrong.push(format!(
                "{source}: the torques cover {} s to {} s, but the motion covers 0 s to {} s",
                number(first),
                number(last),
                number(duration)
            ));
        }
        let names = robot.symbols(JointVariable::Torque);
        let lacks: Vec<&str> =
            names.iter().map(String::as_str).filter(|name| table.column(name).is_none()).collect();
        if !lacks.is_empty() {
            wrong.push(format!(
                "{source}: there is no column {}; add a column of zeros for a joint that is not \
                 driven",
                lacks.join(", ")
            ));
        }
        let known = |name: &str| {
            names.iter().any(|known| known == name)
                || is_of_motion(name)
                || TorqueContributions::is_column(name)
        };
        for name in table.names().filter(|name| !known(name)) {
            let (name, unit) = (quote(name), unit(name));
            wrong.push(format!("{source}: the column `{name}` does not match a coordinate{unit}"));
        }
        let columns = names.iter().filter_map(|name| Some(table.column(name)?.to_vec())).collect();
        Error::check(wrong, Torques(Law::Samples { t: t.to_vec(), columns }))
    }

    /// Whether no coordinate is ever driven.
    #[must_use]
    pub fn are_zero(&self) -> bool {
        match &self.0 {
            Law::Formulas { formulas, .. } => formulas
                .iter()
                .all(|formula| formula.as_number().is_some_and(|number| number.to_f64() == 0.0)),
            Law::Samples { columns, .. } => columns.iter().flatten().all(|value| *value == 0.0),
        }
    }
}

impl TorqueLaw for Torques {
    fn torques(&self, t: f64, state: &State) -> Vec<f64> {
        match &self.0 {
            Law::Formulas { formulas, meanings } => {
                let value = |name: &str| match meanings.get(name) {
                    Some(Meaning::Time) => t,
                    Some(Meaning::Position(index)) => at(&state.q, *index),
                    Some(Meaning::Velocity(index)) => at(&state.qd, *index),
                    Some(Meaning::Value(value)) => *value,
                    None => f64::NAN,
                };
                formulas.iter().map(|formula| formula.evaluate(value)).collect()
            }
            Law::Samples { t: times, columns } => {
                columns.iter().map(|column| linear(times, column, t)).collect()
            }
        }
    }

    fn corners(&self) -> &[f64] {
        match &self.0 {
            Law::Formulas { .. } => &[],
            Law::Samples { t, .. } => t,
        }
    }

    fn features(&self, samples: &[f64]) -> Features {
        match &self.0 {
            Law::Formulas { formulas, meanings } => {
                let constant = |name: &str| match meanings.get(name) {
                    Some(Meaning::Value(value)) => Some(*value),
                    _ => None,
                };
                features::features(formulas, constant, samples)
            }
            Law::Samples { .. } => Features::default(),
        }
    }
}

fn at(values: &[f64], index: usize) -> f64 {
    values.get(index).copied().unwrap_or(f64::NAN)
}

/// The value at `t`, with linear interpolation between samples.
fn linear(times: &[f64], values: &[f64], t: f64) -> f64 {
    let after = times.partition_point(|time| *time <= t);
    let before = after.saturating_sub(1);
    match (times.get(before), times.get(after), values.get(before), values.get(after)) {
        (Some(t0), Some(t1), Some(v0), Some(v1)) if before < after => {
            // Differences of finite numbers can overflow; sums of their parts cannot.
            let share = match t1 - t0 {
                span if span.is_finite() => (t - t0) / span,
                _ => (t / 2.0 - t0 / 2.0) / (t1 / 2.0 - t0 / 2.0),
            };
            match v1 - v0 {
                step if step.is_finite() => v0 + step * share,
                _ => v0 * (1.0 - share) + v1 * share,
            }
        }
        (_, _, Some(value), _) => *value,
        _ => f64::NAN,
    }
}

/// Whether a column belongs to a motion, apart from its torques.
fn is_of_motion(name: &str) -> bool {
    let motion = |(variable, _)| JointVariable::MOTION.contains(&variable);
    name == "t" || is_energy(name) || JointVariable::parse(name).is_some_and(motion)
}

fn meanings(robot: &Robot, parameters: &[(&str, f64)]) -> BTreeMap<String, Meaning> {
    let values = expressions::parameters(robot, parameters).into_iter();
    let mut meanings: BTreeMap<String, Meaning> =
        values.map(|(name, value)| (name, Meaning::Value(value))).collect();
    meanings.insert("t".to_owned(), Meaning::Time);
    for index in 0..robot.degrees_of_freedom() {
        meanings.insert(JointVariable::Position.symbol(index), Meaning::Position(index));
        meanings.insert(JointVariable::Velocity.symbol(index), Meaning::Velocity(index));
    }
    meanings
}

/// The coordinate for the name of a joint, a number counted from 1, or `tau` with such a number.
fn coordinate(robot: &Robot, name: &str) -> Result<usize, String> {
    let by_joint = robot.coordinates.iter().position(|coordinate| coordinate.joint == name);
    let of_number = |text: &str| {
        let index = text.parse::<usize>().ok()?.checked_sub(1)?;
        (index < robot.degrees_of_freedom()).then_some(index)
    };
    let of_torque = |text: &str| {
        let (variable, index) = JointVariable::parse(text)?;
        let is_there = index < robot.degrees_of_freedom();
        (variable == JointVariable::Torque && is_there).then_some(index)
    };
    let shown = quote(name);
    match (by_joint, of_number(name)) {
        (Some(joint), Some(number)) if joint != number => Err(format!(
            "torque `{shown}`: the joint of this name has the number {}; write tau{} for it, or \
             tau{name} for the joint with this number",
            joint + 1,
            joint + 1
        )),
        (Some(index), _) | (None, Some(index)) => Ok(index),
        (None, None) => of_torque(name).ok_or_else(|| {
            let joints: Vec<&str> =
                robot.coordinates.iter().map(|coordinate| coordinate.joint.as_str()).collect();
            let mimic = robot.links.iter().map(|link| &link.joint).find(|joint| joint.name == name);
            let why = match mimic.and_then(|joint| joints.get(joint.coordinate)) {
                Some(other) => {
                    format!(": this joint mimics `{}` and has no torque of its own", quote(other))
                }
                None => " does not match a joint".to_owned(),
            };
            let (count, known) = (joints.len(), joints.join(", "));
            format!("torque `{shown}`{why}; the joints are 1 to {count}, by name {known}")
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolation_does_not_overflow() {
        assert_eq!(linear(&[0.0, 2.0], &[1.0, 5.0], 0.5), 2.0);
        assert_eq!(linear(&[-9e307, 9e307], &[1.0, 3.0], 0.0), 2.0);
        assert_eq!(linear(&[-1.0, 1.0], &[-1e308, 1e308], 0.5), 5e307);
        assert_eq!(linear(&[0.0, 1.0], &[1.0, 2.0], 7.0), 2.0);
    }
}
