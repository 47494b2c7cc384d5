//! The coefficients of the grouped form as matrices and columns.

use robot_dynamics::quantity::Kind;
use robot_model::variable::JointVariable;
use robot_symbolic::collected::length;
use robot_symbolic::{Expr, Polynomial, Rational, walk};
use rustc_hash::FxHashMap;

use super::coefficients::{LIMITS, MAX_LENGTH, MAX_TERMS, Section, Shown, Sum, motions};
use super::letters::candidates;
use super::{Array, Cell, Equation, Group, Writer, Written, aliases, letters, shapes};
use crate::error::Error;
use crate::math::{Fence, Math};

/// The kind of term that a section is in the joint torques.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Term {
    /// A matrix times the joint accelerations.
    Accelerations,
    /// A column that depends on joint positions and velocities, or a matrix times the velocities.
    Velocities,
    /// A column that depends on joint positions.
    Positions,
    /// Another column.
    Other,
}

/// The values of the coefficients by their names.
pub(super) struct Known<'g> {
    values: FxHashMap<String, (Written, Expr<'g>)>,
    zeros: Vec<String>,
    sums: Vec<Sum<'g>>,
}

impl<'g> Known<'g> {
    /// Stores the coefficients as they are before some are written by others.
    pub(super) fn new(
        writer: &Writer<'_, 'g>,
        sections: &[Section<'g>],
        shown: &[Vec<Shown<'g>>],
        sums: &[Sum<'g>],
    ) -> Result<Known<'g>, Error> {
        let mut known = Known { values: FxHashMap::default(), zeros: vec![], sums: sums.to_vec() };
        let all = sections.iter().flat_map(|section| &section.coefficients);
        for (coefficient, shown) in all.zip(shown.iter().flatten()) {
            let name = coefficient.name.clone();
            match shown {
                Shown::Zero => known.zeros.push(name),
                Shown::Short { terms, .. } => {
                    let equation = writer.of_terms(String::new(), Math::default(), terms)?;
                    known.values.insert(name, (written(equation), coefficient.value));
                }
                Shown::Long { .. } | Shown::Earlier => {}
            }
        }
        Ok(known)
    }

    /// Whether all coefficients of a section are 0.
    pub(super) fn is_empty(&self, section: &Section<'g>) -> bool {
        section.coefficients.iter().all(|one| self.zeros.contains(&one.name))
    }

    /// The summands of a joint torque that belong to a section.
    fn row(&self, section: &Section<'g>, row: usize) -> Sum<'g> {
        let is_own = |name: &str| section.coefficients.iter().any(|one| one.name == *name);
        let sum = self.sums.get(row).into_iter().flatten();
        let own = sum.filter(|(name, _)| is_own(name) && !self.zeros.contains(name));
        own.cloned().collect()
    }

    /// A sum of coefficients times factors, as an entry of an array.
    fn entry(
        &self,
        writer: &mut Writer<'_, 'g>,
        name: String,
        look: Math,
        sum: &Sum<'g>,
    ) -> Result<Cell, Error> {
        let graph = writer.graph;
        if let [(only, factor)] = sum.as_slice()
            && *factor == graph.one()
        {
            let look = writer.symbols.look(only);
            let parts = Written { text: only.clone(), math: look.clone() };
            let whole = self.values.get(only).map(|(written, _)| written.clone());
            return Ok(Cell {
                name: only.clone(),
                look,
                whole,
                parts: Some(parts),
                is_plain: false,
                alias: None,
            });
        }
        let parts = aliases::terms(writer, sum)?;
        let parts = written(writer.of_terms(String::new(), Math::default(), &parts)?);
        let whole = self.whole(writer, sum)?;
        if let [(only, factor)] = sum.as_slice()
            && *factor == -graph.one()
        {
            let (name, look) = (only.clone(), writer.symbols.look(only));
            return Ok(Cell { name, look, whole, parts: Some(parts), is_plain: true, alias: None });
        }
        writer.define(&name, look)?;
        let (look, is_plain) = (writer.symbols.look(&name), sum.is_empty());
        Ok(Cell { name, look, whole, parts: Some(parts), is_plain, alias: None })
    }

    /// A sum of coefficients times factors, written out; `None` if that is too long.
    fn whole(&self, writer: &Writer<'_, 'g>, sum: &Sum<'g>) -> Result<Option<Written>, Error> {
        let value = sum.iter().try_fold(writer.graph.zero(), |all, (name, factor)| {
            self.values.get(name).map(|(_, value)| all + *value * *factor)
        });
        let Some(Ok(value)) = value.map(|value| Polynomial::of(value, &LIMITS)) else {
            return Ok(None);
        };
        if value.len() > MAX_TERMS {
            return Ok(None);
        }
        let terms = writer.collected(&value);
        match length(&terms) <= MAX_LENGTH {
            true => Ok(Some(written(writer.of_terms(String::new(), Math::default(), &terms)?))),
            false => Ok(None),
        }
    }
}

/// Adds the matrices and columns to the groups of the sections, and the joint torques as the sum of these.
pub(super) fn attach<'g>(
    writer: &mut Writer<'_, 'g>,
    groups: &mut [Group],
    sections: &[(Term, &Section<'g>)],
    known: &Known<'g>,
) -> Result<(), Error> {
    if known.sums.len() < 2 {
        return Ok(());
    }
    let (mut right, mut text) = (vec![], vec![]);
    for (term, section) in sections {
        let Some(group) = groups.iter_mut().find(|group| group.title == section.title) else {
            continue;
        };
        let (array, summand) = match (term, writer.options.has_christoffel()) {
            (Term::Accelerations, _) => masses(writer, section, known)?,
            (Term::Velocities, true) => christoffel(writer, section, known)?,
            (term, _) => column(writer, *term, section, known)?,
        };
        if !right.is_empty() {
            right.push(Math::Sign('+'));
        }
        right.extend(summand.math.pieces().iter().cloned());
        text.push(summand.text);
        group.arrays = Some(vec![array]);
    }
    if let Some(sums) = groups.first_mut() {
        let name = Kind::JointTorque.name().to_owned();
        let (text, left) = (text.join(" + "), Math::spelled(&name));
        sums.vector = Some(Equation { name, text, left, right: Math::row(right) });
    }
    Ok(())
}

/// The mass matrix and its product with the joint accelerations.
fn masses<'g>(
    writer: &mut Writer<'_, 'g>,
    section: &Section<'g>,
    known: &Known<'g>,
) -> Result<(Array, Written), Error> {
    let rates = motions(writer, JointVariable::Acceleration);
    let (mut rows, mut plain) = (vec![], 0..);
    for row in 0..known.sums.len() {
        let sum = known.row(section, row);
        let mut cells = vec![];
        for (column, rate) in rates.iter().enumerate() {
            let one = writer.graph.one();
            let mut own = sum.iter().filter_map(|(name, factor)| match () {
                () if factor == rate => Some((name, one)),
                () if *factor == -*rate => Some((name, -one)),
                () => None,
            });
            cells.push(match own.next() {
                Some((name, sign)) => {
                    let one = vec![(name.clone(), sign)];
                    let cell = known.entry(writer, String::new(), Math::default(), &one)?;
                    // Below the diagonal, the entry has the name of its equal.
                    if column < row { cell } else { aliased(cell, section, &[row + 1, column + 1]) }
                }
                None => zero(&format!("0_{}", plain.next().unwrap_or_default())),
            });
        }
        rows.push(cells);
    }
    let (name, left) = called(&base(section), &[positions()]);
    let product = times(&name, &left, JointVariable::Acceleration);
    Ok((Array { name: name.clone(), left, rows }, product))
}

/// The matrix of the Coriolis and centrifugal terms and its product with the joint velocities. Its entries Cᵢⱼ = Σ cᵢⱼₖ
/// q̇ₖ are half of the derivatives of these terms with respect to the velocities, so Ṁ − 2C is skew-symmetric.
fn christoffel<'g>(
    writer: &mut Writer<'_, 'g>,
    section: &Section<'g>,
    known: &Known<'g>,
) -> Result<(Array, Written), Error> {
    let letter =
        writer.letter(writer.options.letters.velocity.as_deref(), &candidates::VELOCITY_MATRIX);
    let rates = motions(writer, JointVariable::Velocity);
    let half = writer.graph.number(Rational::new(1, 2).unwrap_or(Rational::ONE));
    let mut rows = vec![];
    for row in 0..known.sums.len() {
        let sum = known.row(section, row);
        let factors: Vec<Expr<'g>> = sum.iter().map(|(_, factor)| *factor).collect();
        let mut cells = vec![];
        for (column, rate) in rates.iter().enumerate() {
            let slopes = walk::derivatives(&factors, *rate).into_iter().map(|slope| slope * half);
            let names = sum.iter().map(|(name, _)| name.clone());
            let own = names.zip(slopes).filter(|(_, slope)| !slope.is_zero()).collect();
            let numbers = [row + 1, column + 1];
            cells.push(indexed(writer, known, &letter, &numbers, &own)?);
        }
        rows.push(cells);
    }
    let (name, left) = called(&sign(&letter), &[positions(), state(JointVariable::Velocity)]);
    let product = times(&name, &left, JointVariable::Velocity);
    Ok((Array { name, left, rows }, product))
}

/// The column of the contributions of a section to the joint torques.
fn column<'g>(
    writer: &mut Writer<'_, 'g>,
    term: Term,
    section: &Section<'g>,
    known: &Known<'g>,
) -> Result<(Array, Written), Error> {
    let given = writer.options.letters.velocity.as_deref();
    let letter =
        writer.letter(given.filter(|_| term == Term::Velocities), &candidates::VELOCITY_COLUMN);
    let mut rows = vec![];
    for row in 0..known.sums.len() {
        let cell = indexed(writer, known, &letter, &[row + 1], &known.row(section, row))?;
        rows.push(vec![aliased(cell, section, &[row + 1])]);
    }
    let (name, left) = match term {
        Term::Velocities => called(&sign(&letter), &[positions(), state(JointVariable::Velocity)]),
        Term::Positions => called(&base(section), &[positions()]),
        _ => called(&base(section), &[]),
    };
    let summand = Written { text: name.clone(), math: left.clone() };
    Ok((Array { name, left, rows }, summand))
}

/// An entry with its own symbol, unless it is a single coefficient or 0.
fn indexed<'g>(
    writer: &mut Writer<'_, 'g>,
    known: &Known<'g>,
    letter: &str,
    numbers: &[usize],
    sum: &Sum<'g>,
) -> Result<Cell, Error> {
    let name = shapes::indexed_name(letter, numbers);
    if sum.is_empty() {
        return Ok(zero(&name));
    }
    let look = shapes::indexed(letters::character(letter), numbers);
    known.entry(writer, name, look, sum)
}

/// An entry with its equation under its own name, if it is an earlier coefficient of the section.
fn aliased(cell: Cell, section: &Section<'_>, numbers: &[usize]) -> Cell {
    let own = shapes::indexed_name(base(section).0, numbers);
    let coefficient = section.coefficients.iter().find(|one| one.name == own);
    let is_earlier = section.coefficients.iter().any(|one| one.name == cell.name);
    let alias = coefficient.zip(cell.parts.as_ref()).filter(|_| is_earlier && own != cell.name);
    let alias = alias.map(|(coefficient, parts)| Equation {
        name: own,
        text: parts.text.clone(),
        left: coefficient.shape.clone(),
        right: parts.math.clone(),
    });
    Cell { alias, ..cell }
}

fn zero(name: &str) -> Cell {
    let whole = Some(Written { text: "0".to_owned(), math: Math::integer(0) });
    let look = Math::default();
    Cell { name: name.to_owned(), look, whole, parts: None, is_plain: true, alias: None }
}

fn written(equation: Equation) -> Written {
    Written { text: equation.text, math: equation.right }
}

/// A letter as text and as layout.
fn sign(letter: &str) -> (&str, Math) {
    (letter, Math::Letter(letters::character(letter)))
}

/// The letter of a section's coefficients with its index that is not a number, as text and as layout.
fn base<'s>(section: &'s Section<'_>) -> (&'s str, Math) {
    let Some(first) = section.coefficients.first() else { return Default::default() };
    let name = first.name.trim_end_matches(|c: char| c.is_ascii_digit() || c == '_');
    let look = match &first.shape {
        Math::Script(script) => match script.lower.as_ref().map(Math::pieces) {
            Some([index @ Math::Letter(_), ..]) => script.base.clone().with_lower(index.clone()),
            _ => script.base.clone(),
        },
        other => other.clone(),
    };
    (name, look)
}

/// The symbol of an array with its arguments, as text and as layout.
fn called((name, base): &(&str, Math), arguments: &[(&str, Math)]) -> (String, Math) {
    let mut name = (*name).to_owned();
    let names: Vec<&str> = arguments.iter().map(|(name, _)| *name).collect();
    let looks: Vec<Vec<Math>> = arguments.iter().map(|(_, look)| vec![look.clone()]).collect();
    if names.is_empty() {
        return (name, base.clone());
    }
    name.push_str(&format!("({})", names.join(", ")));
    let inside = Math::row(looks.join(&Math::Sign(',')));
    (name, Math::Row(vec![base.clone(), Math::Fenced(Fence::Parentheses, Box::new(inside))]))
}

fn positions() -> (&'static str, Math) {
    state(JointVariable::Position)
}

/// The column of a joint variable.
fn state(variable: JointVariable) -> (&'static str, Math) {
    (variable.name(), Math::spelled(variable.name()))
}

/// The product of a matrix and a column.
fn times(name: &str, left: &Math, variable: JointVariable) -> Written {
    let (rate, look) = state(variable);
    let math = Math::Row(left.pieces().iter().cloned().chain([look]).collect());
    Written { text: format!("{name}*{rate}"), math }
}
