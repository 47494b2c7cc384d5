//! The structure of M(q) and C(q, q̇): which entries are zero, which are constant, and on which coordinates the others
//! depend.
//!
//! The entries are exact derivatives of the paper's joint torques: M = ∂Q/∂q̈, and C = ½ ∂Q/∂q̇ at constant q and q̈.
//! The latter is C by Christoffel symbols, because C q̇ is a quadratic form in q̇. An entry counts as independent of a
//! coordinate if another value of the coordinate does not change it, at random values of all symbols.

use std::collections::BTreeMap;

use robot_document::markup::{Element, element, holding};
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_dynamics::newton_euler::newton_euler;
use robot_model::functions::Effects;
use robot_model::robot::Robot;
use robot_model::variable::JointVariable;
use robot_symbolic::walk::Evaluator;
use robot_symbolic::{Expr, Graph, Random, SymbolId, walk};

use crate::text;

/// The number of states at which entries are evaluated.
const STATES: usize = 4;
/// The largest change that counts as a rounding error; entries have the magnitude of the robot's values.
const ROUNDING: f64 = 1e-10;
/// The seed of the states.
const SEED: u64 = 6;

/// The dependence of an entry of a matrix on the coordinates.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Entry {
    /// The entry is 0.
    Zero,
    /// The entry depends on the coordinates with these indices; if there are none, only on parameters.
    Of(Vec<usize>),
}

/// The structures of M and C, row by row.
pub(crate) struct Structure {
    mass: Vec<Vec<Entry>>,
    coriolis: Vec<Vec<Entry>>,
}

impl Structure {
    /// Determines the structure for a robot.
    pub(crate) fn of(robot: &Robot) -> Structure {
        let graph = Graph::new();
        let exact = MechanismOptions::EXACT.with_snap(None, robot);
        let mechanism = Mechanism::new(robot, &graph, &exact);
        let effects = Effects { wrench: false, friction: false };
        let forces = newton_euler(&mechanism, effects).joint_torques;
        let count = forces.len();
        let symbol = |variable: JointVariable, index: usize| graph.symbol(&variable.symbol(index));
        let slopes = |variable| -> Vec<Expr<'_>> {
            let slopes = |index| walk::derivatives(&forces, symbol(variable, index));
            (0..count).flat_map(slopes).collect()
        };
        let columns =
            [slopes(JointVariable::Acceleration), slopes(JointVariable::Velocity)].concat();
        let positions: Vec<Option<SymbolId>> =
            (0..count).map(|index| symbol(JointVariable::Position, index).as_symbol()).collect();
        let entries = entries(&columns, &positions);
        // The derivatives are in columns; this collects a row.
        let row = |matrix: usize, row: usize| -> Vec<Entry> {
            let places = (0..count).map(|column| (matrix * count + column) * count + row);
            places.filter_map(|place| entries.get(place).cloned()).collect()
        };
        let matrix = |index| (0..count).map(|number| row(index, number)).collect();
        Structure { mass: matrix(0), coriolis: matrix(1) }
    }

    /// Makes a colored table of each matrix.
    pub(crate) fn build(&self) -> [Element; 2] {
        [
            grid("Mass matrix M(q): the coordinates that each entry depends on", &self.mass),
            grid(
                "Matrix of the Coriolis and centrifugal terms C(q, q̇): the coordinates that each entry depends on, in \
                 addition to q̇",
                &self.coriolis,
            ),
        ]
    }
}

/// Determines the dependence of each expression.
fn entries(roots: &[Expr<'_>], positions: &[Option<SymbolId>]) -> Vec<Entry> {
    let mut largest = vec![0.0f64; roots.len()];
    let mut changes = vec![vec![0.0f64; positions.len()]; roots.len()];
    let evaluator = Evaluator::new(roots);
    let values =
        |state: &State| evaluator.values(|symbol| state.get(&symbol).copied().unwrap_or(f64::NAN));
    for mut state in states(roots) {
        let here = values(&state);
        for (size, value) in largest.iter_mut().zip(&here) {
            *size = larger(*size, *value);
        }
        for (index, position) in positions.iter().enumerate() {
            let Some(position) = position else { continue };
            let Some(before) = state.get(position).copied() else { continue };
            state.insert(*position, 1.9 - before);
            let there = values(&state);
            state.insert(*position, before);
            for (list, (here, there)) in changes.iter_mut().zip(here.iter().zip(there)) {
                if let Some(change) = list.get_mut(index) {
                    *change = larger(*change, here - there);
                }
            }
        }
    }
    let depends = |list: &[f64]| {
        let all = list.iter().enumerate().filter(|(_, change)| **change >= ROUNDING);
        Entry::Of(all.map(|(index, _)| index).collect())
    };
    let found = largest.iter().zip(&changes);
    found.map(|(size, list)| if *size < ROUNDING { Entry::Zero } else { depends(list) }).collect()
}

/// The larger absolute value; NaN counts as infinite, so that it is not taken for zero.
fn larger(size: f64, value: f64) -> f64 {
    if value.is_nan() { f64::INFINITY } else { size.max(value.abs()) }
}

type State = BTreeMap<SymbolId, f64>;

/// Random values of all symbols, for each of the states.
fn states(roots: &[Expr<'_>]) -> Vec<State> {
    let symbols = walk::symbols(roots);
    let mut random = Random::new(SEED);
    let mut state = || symbols.iter().map(|symbol| (*symbol, random.uniform(0.5, 1.5))).collect();
    (0..STATES).map(|_| state()).collect()
}

/// The number of shades for entries that depend on coordinates.
const SHADES: usize = 5;

fn grid(caption: &str, rows: &[Vec<Entry>]) -> Element {
    let heading = |index: usize, scope: &str| {
        holding("th", text::symbol(&JointVariable::Position.symbol(index)))
            .attribute("scope", scope)
    };
    let corner = element("td");
    let title =
        element("tr").with(corner).with_all((0..rows.len()).map(|index| heading(index, "col")));
    let rows = rows.iter().enumerate().map(|(index, row)| {
        let cells = row.iter().map(|entry| cell(entry, rows.len()));
        element("tr").with(heading(index, "row")).with_all(cells)
    });
    let table = element("table")
        .class("grid")
        .with(holding("caption", holding("span", caption)))
        .with(holding("thead", title))
        .with(element("tbody").with_all(rows));
    element("div")
        .class("wide")
        .attribute("tabindex", "0")
        .attribute("role", "region")
        .attribute("aria-label", caption)
        .with(table)
}

fn cell(entry: &Entry, count: usize) -> Element {
    let (class, words) = match entry {
        Entry::Zero => ("zero".to_owned(), "0".to_owned()),
        Entry::Of(list) if list.is_empty() => ("shade-0".to_owned(), "const".to_owned()),
        Entry::Of(list) => {
            // The strongest shade is for an entry that depends on all coordinates.
            let shade = (list.len() * SHADES).div_ceil(count.max(1));
            let names =
                list.iter().map(|index| text::symbol(&JointVariable::Position.symbol(*index)));
            (format!("shade-{shade}"), names.collect::<Vec<_>>().join(" "))
        }
    };
    holding("td", words).class(class)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn structure(file: &str) -> Structure {
        let path = format!("{}/../../robots/{file}.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        Structure::of(&robot_model::description::read_toml(file, &text).unwrap().robot)
    }

    #[test]
    fn the_planar_arm_is_as_in_every_book() {
        let found = structure("planar_2r");
        let elbow = || Entry::Of(vec![1]);
        let constant = Entry::Of(vec![]);
        assert_eq!(found.mass, [[elbow(), elbow()], [elbow(), constant]]);
        // C = h [q̇₂, q̇₁ + q̇₂; −q̇₁, 0], where h depends only on q₂.
        assert_eq!(found.coriolis, [[elbow(), elbow()], [elbow(), Entry::Zero]]);
    }

    #[test]
    fn the_paper_s_robot_has_the_paper_s_zeros() {
        // The axes of the translations 1 and 3 are perpendicular, and 3 moves mass along the axis of 2.
        let found = structure("trttr1");
        let entry = |row: usize, column: usize| found.mass[row - 1][column - 1].clone();
        assert_eq!(
            (entry(1, 3), entry(2, 3), entry(3, 4)),
            (Entry::Zero, Entry::Zero, Entry::Zero)
        );
        assert_eq!((entry(1, 1), entry(3, 3)), (Entry::Of(vec![]), Entry::Of(vec![])));
        assert_eq!(entry(1, 4), Entry::Of(vec![1]));
        for (row, entries) in found.mass.iter().enumerate() {
            for (column, entry) in entries.iter().enumerate() {
                assert_eq!(*entry, found.mass[column][row]);
            }
        }
    }
}
