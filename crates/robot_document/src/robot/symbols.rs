//! The list of symbols with their units and values.

use robot_dynamics::model::{JointKind, Parameter, Robot};
use robot_symbolic::print::exact_text;

use super::heading;
use crate::document::{Block, Inline};
use crate::error::Error;
use crate::forms::{Equations, Form};
use crate::math::Math;

/// What the symbols of the robot mean.
pub(super) fn blocks(robot: &Robot, parts: &[(Form, Equations)]) -> Result<Vec<Block>, Error> {
    let Some((_, first)) = parts.first() else { return Ok(vec![]) };
    let notation = &first.notation;
    let mut items = vec![];
    for (index, coordinate) in robot.coordinates.iter().enumerate() {
        let (position, unit) = match coordinate.kind {
            JointKind::Revolute => ("angle", "rad"),
            JointKind::Prismatic => ("displacement", "m"),
        };
        let name = format!("q{}", index + 1);
        items.push(vec![
            Inline::Math(notation.symbol(&name)?),
            Inline::text(format!(" \u{2014} {position} of the joint {}, {unit}", coordinate.joint)),
        ]);
    }
    for parameter in &robot.parameters {
        items.push(parameter_item(notation.symbol(&parameter.name)?, parameter));
    }
    for (frame, wrench) in robot.tips() {
        let [force, moment] = [(&wrench.force, "force", "N"), (&wrench.moment, "moment", "N m")]
            .map(|(names, what, unit)| {
                let symbols: Result<Vec<Math>, Error> =
                    names.iter().map(|name| notation.symbol(name)).collect();
                symbols.map(|symbols| {
                    let mut item = vec![];
                    for (place, symbol) in symbols.into_iter().enumerate() {
                        item.push(Inline::text(if place == 0 { "" } else { ", " }));
                        item.push(Inline::Math(symbol));
                    }
                    let text =
                        format!(" \u{2014} {what} that {} exerts, in its axes, {unit}", frame.name);
                    item.push(Inline::Text(text));
                    item
                })
            });
        items.extend([force?, moment?]);
    }
    Ok(vec![heading("Symbols"), Block::List(items)])
}

fn parameter_item(symbol: Math, parameter: &Parameter) -> Vec<Inline> {
    let mut text = String::new();
    if let Some(doc) = &parameter.doc {
        text = format!(" \u{2014} {}", doc.trim());
    }
    let unit = parameter.unit.as_ref().map_or("", |unit| match unit.text.as_str() {
        "1" => "",
        text => text,
    });
    match &parameter.value {
        Some(value) => text.push_str(&format!(": {} {unit}", exact_text(value))),
        None if unit.is_empty() => {}
        None => text.push_str(&format!(", {unit}")),
    }
    vec![Inline::Math(symbol), Inline::Text(text.trim_end().to_owned())]
}
