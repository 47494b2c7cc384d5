//! Trajectories: motions that are given by samples or by expressions in time.

use std::collections::BTreeMap;

use robot_model::diagnostic::{number, quote};
use robot_model::robot::Robot;
use robot_model::variable::{JointVariable, WRENCH_COMPONENTS};
use robot_symbolic::{Expr, Formula, Graph, walk};

use crate::csv::unit;
use crate::error::Error;
use crate::kinks::{Kink, kinks, poles};
use crate::limits::replace_by_limits;
use crate::motion::is_energy;
use crate::table::{Table, check_times};
use crate::{expressions, grid};

/// A given motion with the wrenches of the tips, with one sample for each time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trajectory {
    /// The times t in s, in ascending order.
    pub t: Vec<f64>,
    /// The joint positions q, in rad or m.
    pub q: Vec<Vec<f64>>,
    /// The joint velocities q̇, in rad/s or m/s.
    pub qd: Vec<Vec<f64>>,
    /// The joint accelerations q̈, in rad/s² or m/s².
    pub qdd: Vec<Vec<f64>>,
    /// The wrenches that the tips exert on their surroundings: force (N), then moment (N m), in the frames of the tips,
    /// one tip after the other. `None` if no wrenches are given.
    pub wrenches: Option<Vec<Vec<f64>>>,
}

/// Whether a column belongs to a simulated motion but not to a trajectory.
fn is_result(name: &str, robot: &Robot) -> bool {
    let count = robot.degrees_of_freedom();
    is_energy(name)
        || matches!(JointVariable::parse(name), Some((JointVariable::Torque, joint)) if joint < count)
}

/// The names of the wrench components: `fx` … for a single tip, or `fx_NAME` … for each of several tips.
fn wrench_names(robot: &Robot) -> Vec<String> {
    let suffixes = robot.tips().map(|(tip, _)| robot.wrench_suffix(tip));
    let of_tip = |suffix: String| WRENCH_COMPONENTS.map(|component| format!("{component}{suffix}"));
    suffixes.flat_map(of_tip).collect()
}

/// Converts columns to rows, of which there are `count`.
fn rows(columns: &[&[f64]], count: usize) -> Vec<Vec<f64>> {
    let entry = |column: &&[f64], row: usize| column.get(row).copied();
    let row = |row: usize| columns.iter().filter_map(|column| entry(column, row)).collect();
    (0..count).map(row).collect()
}

impl Trajectory {
    /// Reads the samples of a table with the columns t (s), whose values must increase, q1 …, qd1 …, qdd1 …, and, if a
    /// tip exerts a wrench, fx, fy, fz, mx, my, mz, or fx_NAME … for each of several tips. The torques and energies of
    /// a simulated motion are ignored.
    ///
    /// # Errors
    ///
    /// All errors in the table; `source` is its name in messages.
    pub fn from_table(robot: &Robot, source: &str, table: &Table) -> Result<Trajectory, Error> {
        let mut wrong = check_times(source, table);
        let trajectory = Trajectory::from_columns(robot, source, table, &mut wrong);
        Error::check(wrong, trajectory)
    }

    /// Like [`Trajectory::from_table`], without the check of the times.
    pub(crate) fn from_columns(
        robot: &Robot,
        source: &str,
        table: &Table,
        wrong: &mut Vec<String>,
    ) -> Trajectory {
        let wrench_names = wrench_names(robot);
        let has_wrench = table.names().any(|name| wrench_names.iter().any(|known| known == name));
        let [q, qd, qdd] = JointVariable::MOTION.map(|variable| robot.symbols(variable));
        let needed = [&q, &qd, &qdd].into_iter().flatten();
        let wrenches = if has_wrench { &wrench_names[..] } else { &[] };
        let needed: Vec<&String> = needed.chain(wrenches).collect();
        for name in needed.iter().filter(|name| table.column(name).is_none()) {
            wrong.push(format!("{source}: there is no column `{name}`"));
        }
        for name in table.names() {
            if name != "t" && !is_result(name, robot) && needed.iter().all(|known| *known != name) {
                let remedy = match unit(name) {
                    "" => "; remove it, or correct its name",
                    unit => unit,
                };
                let name = quote(name);
                wrong.push(format!("{source}: the column `{name}` is unknown{remedy}"));
            }
        }
        let gather = |names: &[String]| {
            let columns: Vec<&[f64]> = names.iter().filter_map(|name| table.column(name)).collect();
            rows(&columns, table.rows())
        };
        Trajectory {
            t: table.column("t").unwrap_or_default().to_vec(),
            q: gather(&q),
            qd: gather(&qd),
            qdd: gather(&qdd),
            wrenches: has_wrench.then(|| gather(&wrench_names)),
        }
    }

    /// The samples from the index `start` on, at most `size`.
    #[must_use]
    pub fn part(&self, start: usize, size: usize) -> Trajectory {
        let of = |samples: &Vec<Vec<f64>>| samples.iter().skip(start).take(size).cloned().collect();
        Trajectory {
            t: self.t.iter().skip(start).take(size).copied().collect(),
            q: of(&self.q),
            qd: of(&self.qd),
            qdd: of(&self.qdd),
            wrenches: self.wrenches.as_ref().map(of),
        }
    }

    /// Reads expressions such as `q1 = 0.5*sin(t)`, one for each coordinate, in t (s) and the robot's parameters, and
    /// expressions for the components of wrenches with the names of [`Trajectory::from_table`]; a component without one
    /// is 0. Velocities and accelerations are exact derivatives; where the argument of an `abs` or a `sign` is 0, the means
    /// of their limits from both sides. The samples are `step` apart over the `duration`, both
    /// in s. `parameters` are those with other than their nominal values.
    ///
    /// # Errors
    ///
    /// All errors in the texts, values that are not finite, positions or velocities that jump, because the acceleration
    /// would be an impulse there, and positions that are unbounded between two samples. Arguments of `abs` and `sign`
    /// and factors of divisors are evaluated at the samples and at three times between two of them. One that passes 0
    /// twice within a quarter of a step, or touches 0 and is not written as a square, is not noticed.
    pub fn from_expressions(
        robot: &Robot,
        parameters: &[(&str, f64)],
        texts: &[impl AsRef<str>],
        duration: f64,
        step: f64,
    ) -> Result<Trajectory, Error> {
        let times = grid::times(duration, step)?;
        let values = expressions::parameters(robot, parameters);
        let (formulas, wrong) = formulas(robot, &values, texts);
        Error::check(wrong, ())?;
        let graph = Graph::new();
        let time = graph.symbol("t");
        let lower = |name: &String| match formulas.get(name) {
            Some(formula) => formula.lower(&graph, &mut |name| graph.symbol(name)),
            None => graph.zero(),
        };
        let q: Vec<Expr<'_>> = robot.symbols(JointVariable::Position).iter().map(lower).collect();
        let qd = walk::derivatives(&q, time);
        let qdd = walk::derivatives(&qd, time);
        Error::check(kinked(&graph, [&q, &qd], &values, &times), ())?;
        let wrench_names = wrench_names(robot);
        let has_wrench = wrench_names.iter().any(|name| formulas.contains_key(name));
        let wrenches: Vec<Expr<'_>> = wrench_names.iter().map(lower).collect();
        let sample = |exprs: &[Expr<'_>]| -> Vec<Vec<f64>> {
            times.iter().map(|t| at(&graph, exprs, &values, *t)).collect()
        };
        let mut motion = [sample(&q), sample(&qd), sample(&qdd)];
        let value = |exprs: &[Expr<'_>], t: f64| at(&graph, exprs, &values, t);
        let [_, velocities, accelerations] = &mut motion;
        replace_by_limits(&q, time, &times, &value, [velocities, accelerations]);
        let wrenches = has_wrench.then(|| sample(&wrenches));
        let names = robot.symbols(JointVariable::Position);
        let mut wrong =
            infinite(&names, &times, &["position", "velocity", "acceleration"], &motion);
        wrong.extend(infinite(&wrench_names, &times, &["value"], wrenches.as_slice()));
        let [q, qd, qdd] = motion;
        Error::check(wrong, Trajectory { q, qd, qdd, wrenches, t: times })
    }
}

/// The formulas by their names, and messages about errors in their texts.
fn formulas(
    robot: &Robot,
    parameters: &BTreeMap<String, f64>,
    texts: &[impl AsRef<str>],
) -> (BTreeMap<String, Formula>, Vec<String>) {
    let (mut formulas, mut wrong) = (BTreeMap::new(), vec![]);
    let coordinates = robot.symbols(JointVariable::Position);
    let wrenches = wrench_names(robot);
    let is_known = |name: &str| name == "t" || parameters.contains_key(name);
    for text in texts {
        let known = "t and the robot's parameters";
        match expressions::assignment(text.as_ref(), is_known, known) {
            Err(message) => wrong.push(message),
            Ok((name, formula)) => {
                let shown = quote(name);
                if coordinates.iter().chain(&wrenches).all(|known| known != name) {
                    let names = [&coordinates[..], &wrenches].concat().join(", ");
                    wrong.push(format!(
                        "`{shown}` is not part of a trajectory; its parts are {names}"
                    ));
                } else if formulas.insert(name.to_owned(), formula).is_some() {
                    wrong.push(format!("`{shown}` is given twice; leave one out"));
                }
            }
        }
    }
    // An expression with an error is not missing.
    let is_given = |name: &String| {
        let mut lefts = texts.iter().filter_map(|text| text.as_ref().split_once('='));
        formulas.contains_key(name) || lefts.any(|(left, _)| left.trim() == name)
    };
    // A text that is not one assignment may stand for any coordinate.
    let are_assignments = texts.iter().all(|text| text.as_ref().matches('=').count() == 1);
    for name in coordinates.iter().filter(|name| are_assignments && !is_given(name)) {
        wrong.push(format!(
            "there is no expression for `{name}`; if it is at rest, write {name} = 0"
        ));
    }
    (formulas, wrong)
}

/// A message for each coordinate whose position or velocity jumps, or whose position is unbounded.
fn kinked<'g>(
    graph: &'g Graph,
    [q, qd]: [&[Expr<'g>]; 2],
    parameters: &BTreeMap<String, f64>,
    times: &[f64],
) -> Vec<String> {
    let value = |exprs: &[Expr<'g>], t: f64| at(graph, exprs, parameters, t);
    let message = |kink: Kink| {
        let Kink { coordinate, what, .. } = kink;
        let [t, left, right] = [kink.t, kink.sides[0], kink.sides[1]].map(number);
        format!(
            "`q{}`: the {what} jumps at t = {t} s, from {left} to {right}: the acceleration \
             there would be infinite, and so would the torque; write a smooth motion, for \
             example sqrt(x^2 + w^2) instead of abs(x) and tanh(x/w) instead of sign(x), with a \
             small w",
            coordinate + 1
        )
    };
    let unbounded = |(coordinate, t): (usize, f64)| {
        let t = number(t);
        format!(
            "`q{}`: the position has no bound at t = {t} s, where a divisor is 0; end the motion before it, or write one \
             whose divisors do not become 0",
            coordinate + 1
        )
    };
    let poles = poles(q, times, &value).into_iter().map(unbounded);
    kinks(q, qd, times, &value).into_iter().map(message).chain(poles).collect()
}

/// A message for each name at the first time at which one of `samples`, called `what`, is not finite.
fn infinite(
    names: &[String],
    times: &[f64],
    what: &[&str],
    samples: &[Vec<Vec<f64>>],
) -> Vec<String> {
    let message = |(place, name): (usize, &String)| {
        let is_infinite = |row: &Vec<f64>| row.get(place).is_some_and(|value| !value.is_finite());
        let first = |(what, rows): (&&str, &Vec<Vec<f64>>)| {
            rows.iter().position(is_infinite).map(|row| (row, what.to_string()))
        };
        let found = what.iter().zip(samples).filter_map(first);
        let (row, what) = found.min_by_key(|(row, _)| *row)?;
        let t = number(times.get(row).copied().unwrap_or_default());
        Some(format!(
            "`{name}`: the {what} is not finite at t = {t} s; look for a division by zero, for the square root of a \
             number that is negative or, in a derivative, 0, and for an overflow"
        ))
    };
    names.iter().enumerate().filter_map(message).collect()
}

/// The values of expressions at a time.
fn at(graph: &Graph, exprs: &[Expr<'_>], parameters: &BTreeMap<String, f64>, t: f64) -> Vec<f64> {
    walk::evaluate(exprs, |symbol| {
        let name = graph.symbol_name(symbol);
        if *name == *"t" { t } else { parameters.get(&*name).copied().unwrap_or(f64::NAN) }
    })
}
