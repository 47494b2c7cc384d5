//! Coefficients with names, and the joint torques as sums of their products.

use robot_model::variable::JointVariable;
use robot_symbolic::{AngleSums, Expr, Graph, Polynomial, PolynomialOptions};

use super::compact::definitions;
use super::{Equation, Group, Writer, generalized_force, shapes};
use crate::error::Error;
use crate::math::Math;

/// Coefficients are expanded if that takes no more than this; else what they have in common gets
/// names.
const LIMITS: PolynomialOptions =
    PolynomialOptions { angle_sums: AngleSums::Expand, max_terms: 60_000, max_products: 600_000 };
/// The terms of all coefficients together, beyond which names make them shorter.
const MAX_TERMS: usize = 1_500;

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
        let shape = shapes::indexed(letter.chars().next().unwrap_or('x'), numbers);
        Coefficient { name: shapes::indexed_name(letter, numbers), shape, value }
    }
}

/// The joint torques as sums of products of coefficients that have names, and the coefficients:
/// expanded if that is short, else what they have in common gets names too.
pub(super) fn by_name<'g>(
    writer: &mut Writer<'_, 'g>,
    title: &str,
    introduction: String,
    sections: &[Section<'g>],
    expanded: Option<Vec<Vec<Polynomial<'g>>>>,
    sums: Vec<Sum<'g>>,
) -> Result<Vec<Group>, Error> {
    let zeros = define_all(writer, sections, expanded.as_deref().unwrap_or_default())?;
    let mut groups = vec![Group {
        title: title.to_owned(),
        introduction,
        definitions: false,
        equations: generalized_forces(writer, sums, &zeros)?,
    }];
    match expanded {
        Some(polynomials) => groups.extend(as_polynomials(writer, sections, &polynomials)?),
        None => groups.extend(as_expressions(writer, sections)?),
    }
    Ok(groups)
}

/// Defines the coefficients but those whose polynomials are 0: what is 0 only once it is expanded is
/// left out as well. Gives the names of these.
pub(super) fn define_all(
    writer: &mut Writer<'_, '_>,
    sections: &[Section<'_>],
    polynomials: &[Vec<Polynomial<'_>>],
) -> Result<Vec<String>, Error> {
    let zeros = zeros(sections, polynomials);
    for coefficient in all(sections) {
        if !zeros.contains(&coefficient.name) {
            writer.define(&coefficient.name, coefficient.shape.clone())?;
        }
    }
    Ok(zeros)
}

/// The coefficients whose polynomials are 0.
fn zeros(sections: &[Section<'_>], polynomials: &[Vec<Polynomial<'_>>]) -> Vec<String> {
    let zero = all(sections).zip(polynomials.iter().flatten()).filter(|(_, value)| value.is_zero());
    zero.map(|(coefficient, _)| coefficient.name.clone()).collect()
}

/// The summands of a joint torque: a coefficient's name and its multiplier.
pub(super) type Sum<'g> = Vec<(String, Expr<'g>)>;

fn generalized_forces<'g>(
    writer: &Writer<'_, 'g>,
    sums: Vec<Sum<'g>>,
    zeros: &[String],
) -> Result<Vec<Equation>, Error> {
    let graph = writer.graph;
    let mut equations = vec![];
    for (index, sum) in sums.into_iter().enumerate() {
        let kept = sum.into_iter().filter(|(name, _)| !zeros.contains(name));
        let value = kept.fold(graph.zero(), |sum, (name, rates)| sum + graph.symbol(&name) * rates);
        let symbol = generalized_force(index);
        let polynomial = Polynomial::of(value, &PolynomialOptions::default())
            .map_err(|error| Error::TooLong { reason: error.to_string() })?;
        let (name, left) = (symbol.to_string(), Math::quantity(symbol));
        equations.push(writer.of_polynomial(name, left, &polynomial)?);
    }
    Ok(equations)
}

/// The symbols of a variable of the joints.
pub(super) fn motions<'g>(writer: &Writer<'_, 'g>, variable: JointVariable) -> Vec<Expr<'g>> {
    let symbols = writer.robot.symbols(variable);
    symbols.iter().map(|symbol| writer.graph.symbol(symbol)).collect()
}

/// The polynomials of all coefficients but those of friction, if they are short enough.
pub(super) fn expanded<'g>(
    writer: &Writer<'_, 'g>,
    sections: &[Section<'g>],
) -> Option<Vec<Vec<Polynomial<'g>>>> {
    let values: Vec<Expr<'g>> = all(sections).map(|coefficient| coefficient.value).collect();
    let polynomials = writer.polynomials(&values, &LIMITS).ok()?;
    let terms: usize = polynomials.iter().map(Polynomial::len).sum();
    if terms > MAX_TERMS {
        return None;
    }
    let mut polynomials = polynomials.into_iter();
    let of_section =
        |section: &Section<'g>| polynomials.by_ref().take(section.coefficients.len()).collect();
    Some(sections.iter().map(of_section).collect())
}

pub(super) fn all<'s, 'g>(
    sections: &'s [Section<'g>],
) -> impl Iterator<Item = &'s Coefficient<'g>> {
    sections.iter().flat_map(|section| &section.coefficients)
}

pub(super) fn as_polynomials<'g>(
    writer: &Writer<'_, 'g>,
    sections: &[Section<'g>],
    polynomials: &[Vec<Polynomial<'g>>],
) -> Result<Vec<Group>, Error> {
    let mut groups = vec![];
    for (section, polynomials) in sections.iter().zip(polynomials) {
        let mut equations = vec![];
        for (coefficient, polynomial) in section.coefficients.iter().zip(polynomials) {
            if !polynomial.is_zero() {
                let left = coefficient.shape.clone();
                equations.push(writer.of_polynomial(coefficient.name.clone(), left, polynomial)?);
            }
        }
        groups.push(Group::of_definitions(section.title, equations));
    }
    Ok(groups)
}

fn as_expressions(
    writer: &mut Writer<'_, '_>,
    sections: &[Section<'_>],
) -> Result<Vec<Group>, Error> {
    let others = sections.iter().filter(|section| !section.by_symbols);
    let roots: Vec<Expr<'_>> = others
        .flat_map(|section| &section.coefficients)
        .map(|coefficient| coefficient.value)
        .collect();
    let target = Graph::new();
    let (mut groups, named) = definitions(writer, &roots, &target)?;
    for section in sections {
        let mut equations = vec![];
        for coefficient in &section.coefficients {
            let (name, left) = (coefficient.name.clone(), coefficient.shape.clone());
            let value = match section.by_symbols {
                true => coefficient.value,
                false => named.rewritten(coefficient.value),
            };
            equations.push(writer.of_expression(name, left, value)?);
        }
        groups.push(Group::of_definitions(section.title, equations));
    }
    Ok(groups)
}
