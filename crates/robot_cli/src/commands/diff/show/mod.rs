//! Printing of a difference as text and JSON.

mod rounded;

use std::fmt::Write as _;

use robot_check::difference::{
    Change, Difference, Equation, Item, ItemKind, Property, State, Term, Torque, Torques,
};
use robot_model::diagnostic::significant;
use robot_model::robot::JointKind;
use robot_model::variable::JointVariable;
use serde_json::{Map, Value, json};

use crate::screen::{ADDED, CHANGED, REMOVED, TITLE, styled_lines};

/// Prints a part for each kind of difference.
pub(super) fn text(found: &Difference, most: usize) -> String {
    let [a, b] = &found.names;
    let mut shown = format!("{a} -> {b}\n");
    let torques = match &found.torques {
        Ok(found) => torques(found),
        Err(reason) => refused(reason),
    };
    for (title, lines) in parts(found, most).into_iter().chain([(TORQUES, torques)]) {
        let lines = if lines.is_empty() { "  no differences\n".to_owned() } else { lines };
        // Writing to a string does not fail.
        let _ = write!(shown, "\n{title}\n{lines}");
    }
    shown
}

/// Colors added, removed and changed lines.
pub(crate) fn colored(text: &str) -> String {
    styled_lines(text, |line| match line.trim_start().get(..2) {
        _ if !line.is_empty() && !line.starts_with([' ', '+', '-', '~']) => Some(TITLE),
        Some("+ ") => Some(ADDED),
        Some("- ") => Some(REMOVED),
        Some("~ ") => Some(CHANGED),
        _ => None,
    })
}

const TORQUES: &str = "largest differences of the joint torques";

/// The parts except that of the torques, each with its title; empty if nothing differs.
pub(crate) fn parts(found: &Difference, most: usize) -> [(&'static str, String); 3] {
    let operations = match &found.operations {
        Ok(found) => found
            .iter()
            .map(|one| format!("  {}: {}\n", one.function, arrow(&one.counts)))
            .collect(),
        Err(reason) => refused(reason),
    };
    [
        ("robot files", found.changes.iter().map(change).collect()),
        (
            "terms of the joint torques",
            found.equations.iter().map(|one| equation(one, most)).collect(),
        ),
        ("operations per call", operations),
    ]
}

fn refused(reason: &str) -> String {
    format!("  not compared: {reason}\n")
}

/// Prints `5 -> 7` or `5 -> none`.
fn arrow<T: ToString>(sides: &[Option<T>; 2]) -> String {
    let [a, b] =
        sides.each_ref().map(|side| side.as_ref().map_or("none".to_owned(), ToString::to_string));
    format!("{a} -> {b}")
}

fn change(change: &Change) -> String {
    let whole = |sign: char, item: &Item| {
        let said = item.properties.iter().filter(|(name, value)| !is_usual(item.kind, name, value));
        let said: Vec<String> =
            said.map(|(name, value)| format!("{name} {}", rounded::one(value))).collect();
        format!("{sign} {} {}: {}\n", item.kind.name(), item.name, said.join("; "))
    };
    match change {
        Change::Added(item) => whole('+', item),
        Change::Removed(item) => whole('-', item),
        Change::Changed { kind, name, properties } => {
            let one =
                |one: &Property| format!("{} {}", one.name, arrow(&rounded::pair(&one.values)));
            let properties: Vec<String> = properties.iter().map(one).collect();
            let name = if name.is_empty() { String::new() } else { format!(" {name}") };
            format!("~ {}{name}: {}\n", kind.name(), properties.join("; "))
        }
    }
}

/// Whether an added or removed item has this property if a file does not mention it: it is not printed then.
fn is_usual(kind: ItemKind, name: &str, value: &str) -> bool {
    match kind {
        ItemKind::Joint => match name {
            "ratio" | "gear ratio" => value == "1",
            "gyroscopic rotor" => value == "false",
            _ => value == "0",
        },
        // Zeros of the inertia of a link or of a body that is fixed to it.
        ItemKind::Link => value == "0" && name != "mass" && !name.ends_with(": mass"),
        ItemKind::Robot | ItemKind::Parameter | ItemKind::Frame => false,
    }
}

fn equation(equation: &Equation, most: usize) -> String {
    let terms = match &equation.terms {
        Ok(terms) => terms,
        Err(reason) => return format!("  {}: not compared: {reason}\n", equation.name),
    };
    let mut shown = format!("  {}\n", equation.name);
    for Term { powers, coefficients } in terms.iter().take(most) {
        // Writing to a string does not fail.
        let _ = match &rounded::pair(coefficients) {
            [Some(gone), None] => writeln!(shown, "  - {}", product(gone, powers)),
            [None, Some(come)] => writeln!(shown, "  + {}", product(come, powers)),
            both => writeln!(shown, "  ~ ({}) {powers}", arrow(both)),
        };
    }
    if let Some(more @ 1..) = terms.len().checked_sub(most) {
        let _ = writeln!(shown, "    ({more} more)");
    }
    shown
}

/// Prints `g*m1`, `2 g*m1` or `(-1) g*m1`. Parentheses distinguish the sign of a coefficient from that of the line.
fn product(coefficient: &str, powers: &str) -> String {
    match (coefficient, powers) {
        ("1", powers) => powers.to_owned(),
        (coefficient, "1") => bracketed(coefficient),
        (coefficient, powers) => format!("{} {powers}", bracketed(coefficient)),
    }
}

fn bracketed(coefficient: &str) -> String {
    match coefficient.starts_with('-') {
        true => format!("({coefficient})"),
        false => coefficient.to_owned(),
    }
}

fn torques(found: &Torques) -> String {
    let drawn = &found.drawn;
    if !found.joints.iter().any(Torque::differs) {
        return format!("  none at {} random states, seed {}\n", drawn.states, drawn.seed);
    }
    let mut shown = format!(
        "  {} states, seed {}; velocities within {}, accelerations within {}, positions\n",
        drawn.states, drawn.seed, drawn.velocity, drawn.acceleration
    );
    for (found, [low, high]) in found.joints.iter().zip(&drawn.positions) {
        let Torque { joint, kind, torques: [a, b], state, .. } = found;
        if !found.differs() {
            // Writing to a string does not fail.
            let _ = writeln!(shown, "  joint {joint}: none");
            continue;
        }
        let (unit, length) = match kind {
            JointKind::Revolute => ("N m", "rad"),
            JointKind::Prismatic => ("N", "m"),
        };
        let decimals = decimals(b - a);
        let State { q, qd, qdd } = state;
        let list =
            |values: &[f64]| values.iter().copied().map(position).collect::<Vec<_>>().join(", ");
        let [low, high] = [*low, *high].map(position);
        let _ = writeln!(
            shown,
            "  joint {joint}, {low} to {high} {length}: {} {unit}, {a:.decimals$} -> {b:.decimals$}\n    \
             at q = ({}), qd = ({}), qdd = ({})",
            changed(b - a),
            list(q),
            list(qd),
            list(qdd)
        );
    }
    shown
}

/// A position, velocity or acceleration with three decimals, or with a power of ten if it is large or small.
fn position(value: f64) -> String {
    match value == 0.0 || (0.01..1e6).contains(&value.abs()) {
        true => format!("{value:.3}"),
        false => format!("{value:.3e}"),
    }
}

/// The number of decimals with which torques are shown so that their difference is visible.
fn decimals(change: f64) -> usize {
    let needed = 2.0 - change.abs().log10().floor();
    needed.clamp(4.0, 17.0) as usize
}

/// A difference of torques with four decimals, or with six digits if it is small.
fn changed(change: f64) -> String {
    if decimals(change) > 4 { significant(change) } else { format!("{change:.4}") }
}

/// Prints the whole difference as JSON; a part that was not compared is `{"not_compared": reason}`.
pub(super) fn json(found: &Difference) -> String {
    let refused = |reason: &String| json!({ "not_compared": reason });
    let equation = |one: &Equation| {
        let term = |one: &Term| json!({ "powers": one.powers, "coefficients": one.coefficients });
        let terms = one.terms.as_ref().map(|terms| terms.iter().map(term).collect::<Value>());
        json!({ "name": one.name, "terms": terms.unwrap_or_else(refused) })
    };
    let operations = found.operations.as_ref().map(|all| {
        all.iter().map(|one| json!({ "function": one.function, "counts": one.counts })).collect()
    });
    let shown = json!({
        "robots": found.names,
        "same": found.is_none(),
        "changes": found.changes.iter().map(change_json).collect::<Value>(),
        "equations": found.equations.iter().map(equation).collect::<Value>(),
        "operations": operations.unwrap_or_else(refused),
        "torques": found.torques.as_ref().map_or_else(refused, torques_json),
    });
    format!("{shown:#}\n")
}

fn change_json(change: &Change) -> Value {
    let whole = |what: &str, item: &Item| {
        let said: Map<String, Value> = item
            .properties
            .iter()
            .map(|(name, value)| (name.clone(), Value::from(value.as_str())))
            .collect();
        json!({ "change": what, "kind": item.kind.name(), "name": item.name, "properties": said })
    };
    match change {
        Change::Added(item) => whole("added", item),
        Change::Removed(item) => whole("removed", item),
        Change::Changed { kind, name, properties } => {
            let properties: Map<String, Value> =
                properties.iter().map(|one| (one.name.clone(), json!(one.values))).collect();
            let kind = kind.name();
            json!({ "change": "changed", "kind": kind, "name": name, "properties": properties })
        }
    }
}

fn torques_json(found: &Torques) -> Value {
    let drawn = &found.drawn;
    let joint = |one: &Torque| {
        let State { q, qd, qdd } = &one.state;
        let [a, b] = one.torques;
        let state: Map<String, Value> = JointVariable::MOTION
            .into_iter()
            .zip([q, qd, qdd])
            .map(|(variable, values)| (variable.name().to_owned(), json!(values)))
            .collect();
        json!({ "joint": one.joint, "torques": one.torques, "change": b - a, "state": state })
    };
    json!({
        "states": drawn.states,
        "seed": drawn.seed,
        "positions": drawn.positions,
        "velocity": drawn.velocity,
        "acceleration": drawn.acceleration,
        "joints": found.joints.iter().map(joint).collect::<Value>(),
    })
}

#[cfg(test)]
mod tests;
