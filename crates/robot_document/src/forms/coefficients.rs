//! Coefficients with names, and the joint torques as sums of their products.

use robot_model::variable::JointVariable;
use robot_symbolic::collected::length;
use robot_symbolic::print::ArrangedTerm;
use robot_symbolic::{AngleSums, Expr, Graph, Polynomial, PolynomialOptions, walk};

use super::compact::definitions;
use super::definitions::Root;
use super::naming::{Named, named_length};
use super::uses::{Attempt, without_unused};
use super::{
    Equation, Group, Writer, aliases, arranged, joint_torque, letters, numbers, references,
    residues, shapes,
};
use crate::error::Error;
use crate::math::Math;

/// The limits within which a coefficient is expanded to be written out; beyond them, it is written by named parts.
pub(super) const LIMITS: PolynomialOptions =
    PolynomialOptions { angle_sums: AngleSums::Expand, max_terms: 20_000, max_products: 200_000 };
/// The number of coefficients that may exceed these limits. A robot with more of them has thousands, and finding this out
/// for each would take minutes; the others of it are expanded within [`LOWER_LIMITS`].
const MAX_LONG: usize = 100;
const LOWER_LIMITS: PolynomialOptions =
    PolynomialOptions { max_terms: 2_000, max_products: 10_000, ..LIMITS };
/// The largest number of terms of an expansion that is collected.
pub(super) const MAX_TERMS: usize = 160;
/// The largest number of printed symbols of an entry of a matrix, about six lines.
pub(super) const MAX_LENGTH: usize = 200;
/// The possible limits for the printed symbols of a coefficient that is written out, if others need named parts. The
/// one that makes the coefficients and the named parts shortest in total is used.
const LENGTHS: [usize; 4] = [300, 200, 130, 80];
/// Lower limits, which leave few coefficients written out. They are used only if the total with the limit above exceeds
/// the total with named parts for every coefficient by more than a tenth.
const SHORTER: [usize; 2] = [50, 30];
/// The smallest number of printed symbols of a coefficient that is written by another one.
pub(super) const MIN_LENGTH: usize = 3;

/// The coefficients of one kind.
pub(super) struct Section<'g> {
    pub(super) title: &'static str,
    /// Whether the coefficients are short expressions in defined symbols.
    pub(super) by_symbols: bool,
    pub(super) coefficients: Vec<Coefficient<'g>>,
}

/// A coefficient with its name, layout and value.
pub(super) struct Coefficient<'g> {
    pub(super) name: String,
    pub(super) shape: Math,
    pub(super) value: Expr<'g>,
}

impl<'g> Coefficient<'g> {
    pub(super) fn new(letter: &str, numbers: &[usize], value: Expr<'g>) -> Coefficient<'g> {
        let shape = shapes::indexed(letters::character(letter), numbers);
        Coefficient { name: shapes::indexed_name(letter, numbers), shape, value }
    }

    fn root(&self, value: Expr<'g>) -> Root<'g> {
        Root { name: self.name.clone(), look: self.shape.clone(), value }
    }
}

/// The way in which a coefficient is printed.
#[derive(Clone)]
pub(super) enum Shown<'g> {
    /// It is not printed because it is 0, possibly only after expansion.
    Zero,
    /// It is printed as terms that are equal to its value.
    Short {
        /// The value.
        value: Polynomial<'g>,
        /// The terms.
        terms: Vec<ArrangedTerm<'g>>,
    },
    /// It is printed by names of its parts.
    Long {
        /// The value; `None` if the expansion is too long.
        value: Option<Polynomial<'g>>,
    },
    /// It is not printed because an earlier coefficient of its section replaces it.
    Earlier,
}

impl<'g> Shown<'g> {
    /// The value of a printed coefficient if it is long enough to be compared with others. One with a long number, such
    /// as 0.01713647315 cos q₅, is long, because a reader would compare it digit by digit.
    pub(super) fn comparable(&self) -> Option<&Polynomial<'g>> {
        match self {
            Shown::Short { value, terms } => {
                let is_number_times_symbol =
                    length(terms) + 1 == MIN_LENGTH && numbers::has_long(value);
                (length(terms) >= MIN_LENGTH || is_number_times_symbol).then_some(value)
            }
            Shown::Long { value } => value.as_ref(),
            Shown::Zero | Shown::Earlier => None,
        }
    }
}

/// The ways in which the coefficients are printed, section by section.
pub(super) fn shown<'g>(writer: &Writer<'_, 'g>, sections: &[Section<'g>]) -> Vec<Vec<Shown<'g>>> {
    let mut long = 0;
    let mut coefficient = |coefficient: &Coefficient<'g>| {
        // The equations of a full graph are refused.
        if writer.graph.is_full() {
            return Shown::Zero;
        }
        let limits = if long < MAX_LONG { &LIMITS } else { &LOWER_LIMITS };
        let value = residues::polynomial(coefficient.value, limits);
        long += usize::from(value.is_err());
        match value {
            Ok(value) if value.is_zero() => Shown::Zero,
            Ok(value) if value.len() <= MAX_TERMS => {
                let terms = writer.collected(&value);
                match length(&terms) <= LENGTHS[0] {
                    true => Shown::Short { value, terms },
                    false => Shown::Long { value: Some(value) },
                }
            }
            value => Shown::Long { value: value.ok() },
        }
    };
    sections
        .iter()
        .map(|section| section.coefficients.iter().map(&mut coefficient).collect())
        .collect()
}

/// Chooses the length above which coefficients are written by named parts so that everything is shortest in total. Does
/// nothing if no coefficient needs named parts.
pub(super) fn limit<'g>(
    writer: &Writer<'_, 'g>,
    sections: &[Section<'g>],
    shown: &mut [Vec<Shown<'g>>],
) {
    if !shown.iter().flatten().any(|shown| matches!(shown, Shown::Long { .. })) {
        return;
    }
    // The lengths are those with references to earlier coefficients.
    let mut printed = shown.to_vec();
    if writer.options.references {
        references::refer(writer, sections, &mut printed);
    }
    let values = with_decimals(writer, sections);
    let total = |most: usize| {
        let (mut written, mut named) = (0, vec![]);
        for (value, shown) in values.iter().zip(printed.iter().flatten()) {
            match shown {
                Shown::Short { terms, .. } if length(terms) <= most => written += length(terms),
                Shown::Short { .. } | Shown::Long { .. } => named.push(*value),
                Shown::Zero | Shown::Earlier => {}
            }
        }
        written + named_length(&named, writer.options.digits)
    };
    let Some(most) = LENGTHS.into_iter().min_by_key(|most| total(*most)) else { return };
    let longest = total(0) * 11 / 10;
    let chosen = std::iter::once(most).chain(SHORTER).find(|most| total(*most) <= longest);
    let most = chosen.unwrap_or(most);
    for (shown, printed) in shown.iter_mut().flatten().zip(printed.iter().flatten()) {
        if let (Shown::Short { value, .. }, Shown::Short { terms, .. }) = (&*shown, printed)
            && length(terms) > most
        {
            *shown = Shown::Long { value: Some(value.clone()) };
        }
    }
}

/// The values of all coefficients as they are divided into named parts: long numbers with roots are decimals.
fn with_decimals<'g>(writer: &Writer<'_, 'g>, sections: &[Section<'g>]) -> Vec<Expr<'g>> {
    let values: Vec<Expr<'g>> = all(sections).map(|coefficient| coefficient.value).collect();
    numbers::rounded(writer, &values)
}

/// The joint torques as sums of products of named coefficients, and the definitions of these. Short coefficients are
/// written out; common parts of long ones are named too. The coefficients are defined before, by [`define_all`], which
/// names the `zeros`.
pub(super) fn by_name<'g>(
    writer: &mut Writer<'_, 'g>,
    title: &str,
    introduction: String,
    sections: &[Section<'g>],
    mut shown: Vec<Vec<Shown<'g>>>,
    sums: Vec<Sum<'g>>,
    zeros: &[String],
) -> Result<Vec<Group>, Error> {
    if writer.options.references {
        references::refer(writer, sections, &mut shown);
    }
    let forces = joint_torques(writer, sums, zeros)?;
    let mut groups = vec![Group::of_quantities(title, introduction, forces)];
    groups.extend(definitions_of(writer, sections, &shown)?);
    Ok(groups)
}

/// Defines all coefficients that are not 0 and returns the names of those that are.
pub(super) fn define_all(
    writer: &mut Writer<'_, '_>,
    sections: &[Section<'_>],
    shown: &[Vec<Shown<'_>>],
) -> Result<Vec<String>, Error> {
    let mut zeros = vec![];
    for (coefficient, shown) in all(sections).zip(shown.iter().flatten()) {
        match shown {
            Shown::Zero => zeros.push(coefficient.name.clone()),
            Shown::Earlier => {}
            _ => writer.define(&coefficient.name, coefficient.shape.clone())?,
        }
    }
    Ok(zeros)
}

/// The summands of a joint torque: the names of coefficients and their factors.
pub(super) type Sum<'g> = Vec<(String, Expr<'g>)>;

fn joint_torques<'g>(
    writer: &Writer<'_, 'g>,
    sums: Vec<Sum<'g>>,
    zeros: &[String],
) -> Result<Vec<Equation>, Error> {
    let mut equations = vec![];
    for (index, sum) in sums.into_iter().enumerate() {
        let kept = sum.into_iter().filter(|(name, _)| !zeros.contains(name));
        let terms = aliases::terms(writer, &kept.collect::<Vec<_>>())?;
        let symbol = joint_torque(index);
        let (name, left) = (symbol.to_string(), Math::quantity(symbol));
        equations.push(writer.of_terms(name, left, &terms)?);
    }
    Ok(equations)
}

/// The symbols of a joint variable for all coordinates.
pub(super) fn motions<'g>(writer: &Writer<'_, 'g>, variable: JointVariable) -> Vec<Expr<'g>> {
    let symbols = writer.robot.symbols(variable);
    symbols.iter().map(|symbol| writer.graph.symbol(symbol)).collect()
}

fn all<'s, 'g>(sections: &'s [Section<'g>]) -> impl Iterator<Item = &'s Coefficient<'g>> {
    sections.iter().flat_map(|section| &section.coefficients)
}

/// The largest number of expressions of a value whose numbers and powers are collected; a larger one could share parts.
const MAX_ARRANGED: usize = 60;

/// An equation whose right side is an expression in the structure in which it was built, with collected numbers and
/// powers if it is short.
fn as_built(
    writer: &Writer<'_, '_>,
    name: String,
    left: Math,
    value: Expr<'_>,
) -> Result<Equation, Error> {
    match walk::is_longer_than(value, MAX_ARRANGED) {
        true => writer.of_expression(name, left, value),
        false => writer.of_terms(name, left, &arranged::terms(value, &writer.order)),
    }
}

/// The definitions of the coefficients and of the names that long ones need.
pub(super) fn definitions_of<'g>(
    writer: &mut Writer<'_, 'g>,
    sections: &[Section<'g>],
    shown: &[Vec<Shown<'g>>],
) -> Result<Vec<Group>, Error> {
    let values = with_decimals(writer, sections);
    let by_symbols = sections
        .iter()
        .flat_map(|section| std::iter::repeat_n(section.by_symbols, section.coefficients.len()));
    let long = all(sections).zip(&values).zip(shown.iter().flatten()).zip(by_symbols);
    let long =
        long.filter(|((_, shown), by_symbols)| !by_symbols && matches!(shown, Shown::Long { .. }));
    let long: Vec<Root<'g>> =
        long.map(|(((coefficient, value), _), _)| coefficient.root(*value)).collect();
    let (groups, ()) = without_unused(writer, |writer, unnamed| {
        let target = Graph::new();
        let (groups, list) = definitions(writer, long.clone(), &target, unnamed)?;
        let groups = with_coefficients(writer, groups, &list.named, (sections, shown, &values))?;
        let uses = list.uses(&groups);
        Ok(Attempt { groups, uses, more: () })
    })?;
    Ok(groups)
}

/// Adds the coefficients, whose values are `values`, to the definitions of names in `groups`.
fn with_coefficients<'g>(
    writer: &Writer<'_, 'g>,
    mut groups: Vec<Group>,
    named: &Named<'_>,
    (sections, shown, values): (&[Section<'g>], &[Vec<Shown<'g>>], &[Expr<'g>]),
) -> Result<Vec<Group>, Error> {
    let defined = groups.iter().flat_map(|group| &group.equations);
    let defined: Vec<String> = defined.map(|equation| equation.name.clone()).collect();
    let mut values = values.iter().copied();
    for (section, shown) in sections.iter().zip(shown) {
        let mut equations = vec![];
        for ((coefficient, shown), value) in section.coefficients.iter().zip(shown).zip(&mut values)
        {
            let (name, left) = (coefficient.name.clone(), coefficient.shape.clone());
            equations.push(match shown {
                Shown::Zero | Shown::Earlier => continue,
                Shown::Long { .. } if defined.contains(&name) => continue,
                Shown::Short { terms, .. } => writer.of_terms(name, left, terms)?,
                Shown::Long { .. } if section.by_symbols => {
                    writer.of_expression(name, left, coefficient.value)?
                }
                Shown::Long { .. } => as_built(writer, name, left, named.rewritten(value))?,
            });
        }
        groups.push(Group::of_definitions(section.title, equations));
    }
    Ok(groups)
}
