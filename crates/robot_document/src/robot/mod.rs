//! The document of a robot: its tables, its equations, its symbols and a check value.

mod check_value;
mod dh;
pub mod drives;
mod families;
mod numbers;
pub mod rows;
mod sections;
mod symbols;
mod tables;
pub mod words;

use robot_dynamics::mechanism::Snap;
use robot_model::robot::{JointKind, Robot};
use robot_model::snap;

use crate::breaking::number_width;
use crate::document::{Block, Document, Inline};
use crate::error::Error;
use crate::figure::Figure;
use crate::forms::{EquationOptions, Form, Group, Room, equations};
use crate::layout::Trigonometry;
use crate::math::Math;
pub use check_value::CheckValue;

/// The optional parts of a document.
#[derive(Clone, Debug, Default)]
pub struct Extras<'e> {
    /// The title; `None` for "Equations of motion of" and the robot's name.
    pub title: Option<&'e str>,
    /// A drawing of the robot.
    pub figure: Option<Figure>,
    /// The check value.
    pub check: Option<&'e CheckValue>,
    /// The constant angles of the robot file that were rounded to multiples of π/2.
    pub snaps: &'e [Snap],
    /// The line width in pt for matrices and columns, which are shown if they fit; `None` to write only equations of
    /// their entries.
    pub arrays: Option<f64>,
}

/// Makes the document of a robot with its equations in several forms.
///
/// # Errors
///
/// If the equations are too long, with the forms to use instead, or if two symbols would look the same.
pub fn document(
    robot: &Robot,
    options: &EquationOptions,
    forms: &[Form],
    extras: Extras<'_>,
) -> Result<Document, Error> {
    let mut parts = vec![];
    for form in forms {
        parts.push((*form, equations(robot, &EquationOptions { form: *form, ..options.clone() })?));
    }
    if let Some(width) = extras.arrays {
        parts.iter().try_for_each(|(_, part)| part.check_array_names(true))?;
        let groups = parts.iter().flat_map(|(_, part)| &part.groups);
        let numbers: usize = groups.map(Group::most).sum();
        let room = Room::Points(width - number_width(numbers));
        parts.iter_mut().for_each(|(_, part)| *part = part.arranged(room));
    } else {
        parts.iter_mut().for_each(|(_, part)| *part = part.listed());
    }
    let title = match extras.title {
        Some(title) => title.to_owned(),
        None => format!("Equations of motion of {}", robot.name),
    };
    let mut blocks = vec![];
    if let Some(description) = &robot.description {
        blocks.push(paragraph(description));
    }
    let Some((_, first)) = parts.first() else {
        return Ok(Document { title, blocks });
    };
    let tables = tables::blocks(robot, &first.symbols, options.digits, extras.figure)?;
    let masses = blocks.len() + tables.masses;
    blocks.extend(tables.blocks);
    let is_rounded = tables.is_rounded || parts.iter().any(|(_, part)| part.rounded);
    let rounded = options.digits.filter(|_| is_rounded);
    blocks.extend(conventions(robot, options, rounded, extras.snaps)?);
    for (form, part) in &parts {
        blocks.extend(sections::blocks(*form, part, options));
    }
    blocks.extend(symbols::blocks(robot, &parts, (&blocks, masses), &options.letters));
    if let Some(check) = extras.check {
        let has_tip = robot.tips().next().is_some();
        blocks.extend(check_value::blocks(check, has_tip, &first.symbols, &options.letters));
    }
    Ok(Document { title, blocks })
}

fn paragraph(text: &str) -> Block {
    Block::Paragraph(vec![Inline::text(text)])
}

fn heading(text: &str) -> Block {
    Block::Heading(1, text.to_owned())
}

/// The paragraph on the conventions for frames and signs.
fn conventions(
    robot: &Robot,
    options: &EquationOptions,
    rounded: Option<usize>,
    snaps: &[Snap],
) -> Result<Vec<Block>, Error> {
    let indexed = |letter: char| Math::Letter(letter).with_lower(Math::Letter('i'));
    let friction = match options.friction {
        true => "Joint friction is included.",
        false => "Joint friction is not included.",
    };
    let tips = match robot.tips().next() {
        Some(_) => {
            " The wrench of a tip is the wrench that the tip exerts on its surroundings, in the axes of the tip's frame \
             and about its origin; the external wrench, which acts on the tip, is its negative."
        }
        None => "",
    };
    let mimics = match robot.links.iter().any(|link| rows::is_mimic(&link.joint)) {
        true => {
            " For a joint that mimics another, the position in the table of links takes the place of the coordinate."
        }
        false => "",
    };
    let rounded = match rounded {
        Some(1) => {
            " Decimals of equations and poses are rounded to 1 significant digit.".to_owned()
        }
        Some(digits) => {
            format!(" Decimals of equations and poses are rounded to {digits} significant digits.")
        }
        None => String::new(),
    };
    let mut words = vec![
        Inline::text("The frame of link "),
        Inline::Math(Math::Letter('i')),
        Inline::text(
            " is fixed to the link and right-handed, with its origin on the axis of the \
                 link's joint. It is the frame of the parent link (or of the base, if there is \
                 no parent), first displaced as given in the table of links and then moved by \
                 the joint: rotated about the axis by ",
        ),
        Inline::Math(indexed('q')),
        Inline::text(", or translated along it by "),
        Inline::Math(indexed('q')),
        Inline::text(format!(".{mimics} Vectors of a link are given in the axes of its frame. ")),
        Inline::Math(options.letters.torque_sign().with_lower(Math::Letter('i'))),
        Inline::text(format!(
            " is the joint torque of a revolute joint or the joint force of a prismatic joint, positive along the \
                 axis.{tips} Units are SI, with angles in radians. "
        )),
        Inline::text(format!("{friction}{rounded}{}", snapped(snaps))),
    ];
    if robot.links.iter().any(|link| link.joint.kind == JointKind::Revolute) {
        words.extend(sines(options));
    }
    Ok(vec![heading("Frames and signs"), Block::Paragraph(words)])
}

/// The sentence about the short forms of sines and cosines; empty if they are written by name.
fn sines(options: &EquationOptions) -> Vec<Inline> {
    let of = |letter: char, index: Math| Inline::Math(Math::Letter(letter).with_lower(index));
    let letter = Math::Letter;
    let position = || letter('q').with_lower(letter('i'));
    let after = |letter: char| Inline::Math(Math::Row(vec![Math::Letter(letter), position()]));
    let pair = match options.trigonometry {
        Trigonometry::Named => return vec![],
        Trigonometry::Short => [of('s', letter('i')), of('c', letter('i'))],
        Trigonometry::Paper => [after('s'), after('c')],
    };
    let [sine, cosine] = pair;
    let mut words = vec![
        Inline::text(" "),
        sine,
        Inline::text(" and "),
        cosine,
        Inline::text(" are the sine and the cosine of "),
        Inline::Math(position()),
    ];
    if options.trigonometry == Trigonometry::Short {
        words.extend([
            Inline::text("; "),
            of('s', Math::Row(vec![letter('i'), letter('j')])),
            Inline::text(" is the sine of "),
            Inline::Math(Math::Row(vec![
                position(),
                Math::Sign('+'),
                letter('q').with_lower(letter('j')),
            ])),
        ]);
    }
    words.push(Inline::text("."));
    words
}

/// The number of names in a sentence before the others are only counted.
const NAMED: usize = 4;

/// The sentence about constant angles that differ from those of the file.
fn snapped(snaps: &[Snap]) -> String {
    // A change within the default tolerance is only rounding and is not mentioned.
    let changed = || snaps.iter().filter(|snap| snap.change.abs() > snap::DEFAULT);
    let mut names: Vec<&str> = vec![];
    for snap in changed() {
        if !names.contains(&snap.name.as_str()) {
            names.push(&snap.name);
        }
    }
    let (count, most) = changed()
        .fold((0, 0.0_f64), |(count, most), snap| (count + 1, most.max(snap.change.abs())));
    let (subject, multiple) = match count {
        0 => return String::new(),
        1 => (
            "One constant angle of the robot file is".to_owned(),
            "the multiple of π/2, which differs",
        ),
        count => (
            format!("{count} constant angles of the robot file are"),
            "the multiples of π/2, which differ",
        ),
    };
    let more = match names.len().checked_sub(NAMED) {
        Some(more @ 1..) => format!(" and {more} more"),
        _ => String::new(),
    };
    names.truncate(NAMED);
    format!(
        " {subject} rounded: tables and equations have {multiple} by at most {most:.0e} rad ({}{more}).",
        names.join(", ")
    )
}
