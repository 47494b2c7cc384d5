//! The list of symbols with their units and values.

use robot_model::robot::{JointKind, Robot};
use robot_model::variable::JointVariable;

use super::heading;
use crate::document::{Block, Inline};
use crate::forms::{Equations, Form};
use crate::math::Math;
use crate::robot::rows::{self, ParameterRow};

/// The meaning of the robot's symbols.
pub(super) fn blocks(robot: &Robot, parts: &[(Form, Equations)]) -> Vec<Block> {
    let Some((_, first)) = parts.first() else { return vec![] };
    let symbols = &first.symbols;
    let mut items = vec![];
    for (index, coordinate) in robot.coordinates.iter().enumerate() {
        let position = match coordinate.kind {
            JointKind::Revolute => "angle",
            JointKind::Prismatic => "displacement",
        };
        let unit = JointVariable::Position.unit(coordinate.kind);
        let name = JointVariable::Position.symbol(index);
        items.push(vec![
            Inline::Math(symbols.look(&name)),
            Inline::text(format!(" \u{2014} {position} of the joint {}, {unit}", coordinate.joint)),
        ]);
    }
    for row in rows::parameters(robot) {
        items.push(parameter_item(symbols.look(&row.parameter.name), &row));
    }
    for (frame, wrench) in robot.tips() {
        let [force, moment] = [(&wrench.force, "force", "N"), (&wrench.moment, "moment", "N m")]
            .map(|(names, what, unit)| {
                let mut item = vec![];
                for (place, name) in names.iter().enumerate() {
                    item.push(Inline::text(if place == 0 { "" } else { ", " }));
                    item.push(Inline::Math(symbols.look(name)));
                }
                let text = format!(
                    " \u{2014} {what} that {} exerts on its surroundings, in its axes, \
                        {unit}",
                    frame.name
                );
                item.push(Inline::Text(text));
                item
            });
        items.extend([force, moment]);
    }
    vec![heading("Symbols"), Block::List(items)]
}

fn parameter_item(symbol: Math, row: &ParameterRow<'_>) -> Vec<Inline> {
    let mut item = vec![Inline::Math(symbol)];
    if let Some(meaning) = row.meaning {
        item.push(Inline::Text(format!(" \u{2014} {}", meaning.trim())));
    }
    let unit = row.unit.filter(|text| *text != "1");
    let gap = match &row.value {
        Some(value) => format!(": {value}"),
        None if unit.is_some() => ":".to_owned(),
        None => return item,
    };
    item.push(Inline::Text(gap));
    item.extend(unit.map(unit_shape));
    item
}

/// `kg m²`, powers raised.
fn unit_shape(unit: &str) -> Inline {
    let mut pieces = vec![Math::Word(" ".to_owned())];
    let mut rest = unit;
    while let Some((name, more)) = rest.split_once('^') {
        pieces.push(Math::Word(name.to_owned()));
        let digits = more.trim_start_matches('-');
        let length = digits.len() - digits.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let mut power = vec![];
        if digits.len() < more.len() {
            power.push(Math::Sign('-'));
        }
        power.push(Math::Number(digits.get(..length).unwrap_or_default().to_owned()));
        if let Some(word) = pieces.pop() {
            pieces.push(word.with_upper(Math::row(power)));
        }
        rest = digits.get(length..).unwrap_or_default();
    }
    if !rest.is_empty() {
        pieces.push(Math::Word(rest.to_owned()));
    }
    Inline::Math(Math::Row(pieces))
}
