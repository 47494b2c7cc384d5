//! Coefficients with names, and the joint torques as sums of their products.

use robot_model::variable::JointVariable;
use robot_symbolic::collected::length;
use robot_symbolic::print::ArrangedTerm;
use robot_symbolic::{AngleSums, Expr, Graph, Polynomial, PolynomialOptions};

use super::compact::definitions;
use super::definitions::Root;
use super::{Equation, Group, Writer, aliases, generalized_force, letters, references, shapes};
use crate::error::Error;
use crate::math::Math;

/// A coefficient is written out if its expansion takes no more than this; else what it has in common with others
/// gets names.
pub(super) const LIMITS: PolynomialOptions =
    PolynomialOptions { angle_sums: AngleSums::Expand, max_terms: 20_000, max_products: 200_000 };
/// The most terms of an expansion that is collected.
pub(super) const MAX_TERMS: usize = 160;
/// The most printed symbols of a coefficient, some six lines; names make longer ones shorter.
pub(super) const MAX_LENGTH: usize = 200;
/// The printed symbols of the shortest coefficient that is written by another one.
pub(super) const MIN_LENGTH: usize = 3;

/// Coefficients of a kind.
pub(super) struct Section<'g> {
    pub(super) title: &'static str,
    /// Whether the coefficients are by defined symbols, and short.
    pub(super) by_symbols: bool,
    pub(super) coefficients: Vec<Coefficient<'g>>,
}

/// A coefficient: its name, its look and its value.
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

    fn root(&self) -> Root<'g> {
        Root { name: self.name.clone(), look: self.shape.clone(), value: self.value }
    }
}

/// How a coefficient is printed.
pub(super) enum Shown<'g> {
    /// Not at all: what is 0 only once it is expanded is left out as well.
    Zero,
    /// By terms that are equal to its value.
    Short {
        /// The value.
        value: Polynomial<'g>,
        /// The terms.
        terms: Vec<ArrangedTerm<'g>>,
    },
    /// By names of parts.
    Long,
    /// Not at all: an earlier coefficient of its section stands in its place.
    Earlier,
}

/// How the coefficients are printed, by section.
pub(super) fn shown<'g>(writer: &Writer<'_, 'g>, sections: &[Section<'g>]) -> Vec<Vec<Shown<'g>>> {
    let coefficient =
        |coefficient: &Coefficient<'g>| match Polynomial::of(coefficient.value, &LIMITS) {
            Ok(value) if value.is_zero() => Shown::Zero,
            Ok(value) if value.len() <= MAX_TERMS => {
                let terms = writer.collected(&value);
                match length(&terms) <= MAX_LENGTH {
                    true => Shown::Short { value, terms },
                    false => Shown::Long,
                }
            }
            _ => Shown::Long,
        };
    sections.iter().map(|section| section.coefficients.iter().map(coefficient).collect()).collect()
}

/// The joint torques as sums of products of coefficients that have names, and the coefficients: written out if
/// they are short, else what they have in common gets names too.
pub(super) fn by_name<'g>(
    writer: &mut Writer<'_, 'g>,
    title: &str,
    introduction: String,
    sections: &[Section<'g>],
    mut shown: Vec<Vec<Shown<'g>>>,
    sums: Vec<Sum<'g>>,
) -> Result<Vec<Group>, Error> {
    if writer.options.references {
        references::refer(writer, sections, &mut shown);
    }
    let zeros = define_all(writer, sections, &shown)?;
    let forces = generalized_forces(writer, sums, &zeros)?;
    let mut groups = vec![Group::of_quantities(title, introduction, forces)];
    groups.extend(definitions_of(writer, sections, &shown)?);
    Ok(groups)
}

/// Defines the coefficients but those that are 0. Gives the names of these.
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

/// The summands of a joint torque: a coefficient's name and its multiplier.
pub(super) type Sum<'g> = Vec<(String, Expr<'g>)>;

fn generalized_forces<'g>(
    writer: &Writer<'_, 'g>,
    sums: Vec<Sum<'g>>,
    zeros: &[String],
) -> Result<Vec<Equation>, Error> {
    let mut equations = vec![];
    for (index, sum) in sums.into_iter().enumerate() {
        let kept = sum.into_iter().filter(|(name, _)| !zeros.contains(name));
        let terms = aliases::terms(writer, &kept.collect::<Vec<_>>())?;
        let symbol = generalized_force(index);
        let (name, left) = (symbol.to_string(), Math::quantity(symbol));
        equations.push(writer.of_terms(name, left, &terms)?);
    }
    Ok(equations)
}

/// The symbols of a variable of the joints.
pub(super) fn motions<'g>(writer: &Writer<'_, 'g>, variable: JointVariable) -> Vec<Expr<'g>> {
    let symbols = writer.robot.symbols(variable);
    symbols.iter().map(|symbol| writer.graph.symbol(symbol)).collect()
}

fn all<'s, 'g>(sections: &'s [Section<'g>]) -> impl Iterator<Item = &'s Coefficient<'g>> {
    sections.iter().flat_map(|section| &section.coefficients)
}

/// The definitions of coefficients, and of the names that the long ones need.
pub(super) fn definitions_of<'g>(
    writer: &mut Writer<'_, 'g>,
    sections: &[Section<'g>],
    shown: &[Vec<Shown<'g>>],
) -> Result<Vec<Group>, Error> {
    let is_long = |(section, shown): (&Section<'g>, &Vec<Shown<'g>>)| {
        let long = section.coefficients.iter().zip(shown);
        let long = long.filter(|(_, shown)| !section.by_symbols && matches!(shown, Shown::Long));
        long.map(|(coefficient, _)| coefficient.root()).collect::<Vec<_>>()
    };
    let long: Vec<Root<'g>> = sections.iter().zip(shown).flat_map(is_long).collect();
    let target = Graph::new();
    let (mut groups, named) = definitions(writer, long, &target)?;
    let defined = groups.iter().flat_map(|group| &group.equations);
    let defined: Vec<String> = defined.map(|equation| equation.name.clone()).collect();
    for (section, shown) in sections.iter().zip(shown) {
        let mut equations = vec![];
        for (coefficient, shown) in section.coefficients.iter().zip(shown) {
            let (name, left) = (coefficient.name.clone(), coefficient.shape.clone());
            equations.push(match shown {
                Shown::Zero | Shown::Earlier => continue,
                Shown::Long if defined.contains(&name) => continue,
                Shown::Short { terms, .. } => writer.of_terms(name, left, terms)?,
                Shown::Long if section.by_symbols => {
                    writer.of_expression(name, left, coefficient.value)?
                }
                Shown::Long => {
                    writer.of_expression(name, left, named.rewritten(coefficient.value))?
                }
            });
        }
        groups.push(Group::of_definitions(section.title, equations));
    }
    Ok(groups)
}
