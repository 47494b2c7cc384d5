//! The grouped form: Q = M(q) q̈ + C(q, q̇) q̇ + g(q), a function for each coefficient.

use robot_dynamics::newton_euler::{Effects, LinkWrench, friction};
use robot_dynamics::quantity::{Kind, Symbol};
use robot_dynamics::vector::Vector;
use robot_symbolic::{AngleSums, Expr, Graph, Polynomial, PolynomialOptions, Rational, walk};

use super::compact::definitions;
use super::{Equation, Group, Writer, driving_force, shapes};
use crate::error::Error;
use crate::math::Math;
use crate::order::is_rate;

/// Coefficients are expanded where that takes no more than this; else what they have in common gets
/// names.
const LIMITS: PolynomialOptions =
    PolynomialOptions { angle_sums: AngleSums::Expand, max_terms: 60_000, max_products: 600_000 };
/// The terms of all coefficients together, beyond which names make them shorter.
const MAX_TERMS: usize = 1_500;

/// The most coordinates: the coefficients grow with their third power, and each with the chain.
const MAX_COORDINATES: usize = 12;

/// Letters of the mass matrix, of the coefficients of velocities, of Christoffel symbols, of gravity
/// and of the wrenches' shares.
const MASS: [&str; 6] = ["M", "H", "A", "D", "B", "W"];
const VELOCITY: [&str; 5] = ["b", "h", "v", "n", "B"];
const CHRISTOFFEL: [&str; 5] = ["c", "C", "e", "f", "E"];
const GRAVITY: [&str; 4] = ["g", "G", "f", "P"];
const WRENCH: [&str; 4] = ["w", "r", "e", "R"];

/// Coefficients of a kind.
struct Section<'g> {
    title: &'static str,
    /// Whether the coefficients are by defined symbols, and short.
    by_symbols: bool,
    coefficients: Vec<Coefficient<'g>>,
}

/// A coefficient: its name, its look and its value.
struct Coefficient<'g> {
    name: String,
    shape: Math,
    value: Expr<'g>,
}

impl<'g> Coefficient<'g> {
    fn new(letter: &str, numbers: &[usize], value: Expr<'g>) -> Coefficient<'g> {
        let shape = shapes::indexed(letter.chars().next().unwrap_or('x'), numbers);
        Coefficient { name: shapes::indexed_name(letter, numbers), shape, value }
    }
}

pub(super) fn groups(writer: &mut Writer<'_, '_>) -> Result<Vec<Group>, Error> {
    let coordinates = writer.robot.degrees_of_freedom();
    if coordinates > MAX_COORDINATES {
        return Err(Error::TooMany { coordinates, limit: MAX_COORDINATES });
    }
    let forces = writer.economical_forces(false);
    // Per driving force: its coefficients with what they are multiplied by.
    let mut sums: Vec<Sum<'_>> = forces.iter().map(|_| vec![]).collect();
    let mut sections = vec![
        masses(writer, &forces, &mut sums),
        velocities(writer, &forces, &mut sums),
        gravity(writer, &forces, &mut sums),
        wrenches(writer, &forces, &mut sums),
    ];
    sections.extend(frictions(writer, &mut sums));
    // What is 0 only once it is expanded is left out as well.
    let expanded = expanded(writer, &sections);
    let zeros = expanded.as_ref().map_or_else(Vec::new, |all| zeros(&sections, all));
    for coefficient in all(&sections) {
        if !zeros.contains(&coefficient.name) {
            writer.define(&coefficient.name, coefficient.shape.clone())?;
        }
    }
    let mut groups = vec![Group {
        title: "Equations of motion, grouped".to_owned(),
        introduction: introduction(writer),
        definitions: false,
        equations: driving_forces(writer, sums, &zeros)?,
    }];
    match expanded {
        Some(polynomials) => groups.extend(as_polynomials(writer, &sections, &polynomials)?),
        None => groups.extend(as_expressions(writer, &sections)?),
    }
    Ok(groups)
}

fn introduction(writer: &Writer<'_, '_>) -> String {
    let rates = match writer.options.christoffel {
        true => "Christoffel symbols of the first kind",
        false => "coefficients of products of velocities",
    };
    format!(
        "Coefficients of accelerations, which are the entries of the symmetric mass matrix, {rates}, \
         and the share of gravity, each a function of the coordinates alone. Those that are 0 are \
         left out."
    )
}

/// The coefficients whose polynomials are 0.
fn zeros(sections: &[Section<'_>], polynomials: &[Vec<Polynomial<'_>>]) -> Vec<String> {
    let zero = all(sections).zip(polynomials.iter().flatten()).filter(|(_, value)| value.is_zero());
    zero.map(|(coefficient, _)| coefficient.name.clone()).collect()
}

/// The summands of a driving force: a coefficient's name and its multiplier.
type Sum<'g> = Vec<(String, Expr<'g>)>;

fn driving_forces<'g>(
    writer: &Writer<'_, 'g>,
    sums: Vec<Sum<'g>>,
    zeros: &[String],
) -> Result<Vec<Equation>, Error> {
    let graph = writer.graph;
    let mut equations = vec![];
    for (index, sum) in sums.into_iter().enumerate() {
        let kept = sum.into_iter().filter(|(name, _)| !zeros.contains(name));
        let value = kept.fold(graph.zero(), |sum, (name, rates)| sum + graph.symbol(&name) * rates);
        let symbol = driving_force(index);
        let polynomial = Polynomial::of(value, &PolynomialOptions::default())
            .map_err(|error| Error::TooLong { reason: error.to_string() })?;
        let (name, left) = (symbol.to_string(), shapes::quantity(symbol));
        equations.push(writer.of_polynomial(name, left, &polynomial)?);
    }
    Ok(equations)
}

/// The entries of the mass matrix on and above its diagonal, row by row: Mᵢⱼ = ∂Qᵢ/∂q̈ⱼ.
fn masses<'g>(writer: &Writer<'_, 'g>, forces: &[Expr<'g>], sums: &mut [Sum<'g>]) -> Section<'g> {
    let letter = writer.notation.free_letter(&MASS);
    let rates = symbols(writer, "qdd");
    let columns: Vec<_> = rates.iter().map(|rate| walk::derivatives(forces, *rate)).collect();
    let mut coefficients = vec![];
    for row in 0..sums.len() {
        for column in row..sums.len() {
            let value = columns[column][row];
            if value.is_zero() {
                continue;
            }
            let entry = Coefficient::new(letter, &[row + 1, column + 1], value);
            sums[row].push((entry.name.clone(), rates[column]));
            if row != column {
                sums[column].push((entry.name.clone(), rates[row]));
            }
            coefficients.push(entry);
        }
    }
    Section { title: "Mass matrix", by_symbols: false, coefficients }
}

/// The coefficients of q̇ⱼ q̇ₖ, j ≤ k: of the driving force i it is ∂²Qᵢ/∂q̇ⱼ∂q̇ₖ, half of that where
/// j = k. The Christoffel symbol is half of the derivative in either case.
fn velocities<'g>(
    writer: &Writer<'_, 'g>,
    forces: &[Expr<'g>],
    sums: &mut [Sum<'g>],
) -> Section<'g> {
    let christoffel = writer.options.christoffel;
    let (letters, title) = match christoffel {
        true => (&CHRISTOFFEL, "Christoffel symbols"),
        false => (&VELOCITY, "Coefficients of velocities"),
    };
    let letter = writer.notation.free_letter(letters);
    let graph = writer.graph;
    let half = graph.number(Rational::new(1, 2).unwrap_or(Rational::ONE));
    let rates = symbols(writer, "qd");
    let second = |first: &Expr<'g>| -> Vec<Vec<Expr<'g>>> {
        let slopes = walk::derivatives(forces, *first);
        rates.iter().map(|rate| walk::derivatives(&slopes, *rate)).collect()
    };
    let slopes: Vec<Vec<Vec<Expr<'g>>>> = rates.iter().map(second).collect();
    let mut coefficients = vec![];
    for (index, sum) in sums.iter_mut().enumerate() {
        for first in 0..rates.len() {
            for other in first..rates.len() {
                let slope = slopes[first][other][index];
                if slope.is_zero() {
                    continue;
                }
                let (value, factor) = match (christoffel, first == other) {
                    (_, true) => (slope * half, 1),
                    (true, false) => (slope * half, 2),
                    (false, false) => (slope, 1),
                };
                let numbers = [index + 1, first + 1, other + 1];
                let coefficient = Coefficient::new(letter, &numbers, value);
                let rates = rates[first] * rates[other] * graph.integer(factor);
                sum.push((coefficient.name.clone(), rates));
                coefficients.push(coefficient);
            }
        }
    }
    Section { title, by_symbols: false, coefficients }
}

/// The driving forces at rest, without wrenches.
fn gravity<'g>(writer: &Writer<'_, 'g>, forces: &[Expr<'g>], sums: &mut [Sum<'g>]) -> Section<'g> {
    let wrenches = wrench_names(writer);
    let values = at_rest(writer, forces, &|name| wrenches.iter().any(|known| known == name));
    single(writer, "Gravity", writer.notation.free_letter(&GRAVITY), values, sums)
}

/// The shares of the wrenches of the tips, Jᵀ times the wrench.
fn wrenches<'g>(writer: &Writer<'_, 'g>, forces: &[Expr<'g>], sums: &mut [Sum<'g>]) -> Section<'g> {
    let still = at_rest(writer, forces, &|_| false);
    let mut values = vec![writer.graph.zero(); forces.len()];
    for name in wrench_names(writer) {
        let component = writer.graph.symbol(&name);
        for (value, slope) in values.iter_mut().zip(walk::derivatives(&still, component)) {
            *value += slope * component;
        }
    }
    single(writer, "Wrenches of the tips", writer.notation.free_letter(&WRENCH), values, sums)
}

/// A coefficient for each driving force.
fn single<'g>(
    writer: &Writer<'_, 'g>,
    title: &'static str,
    letter: &str,
    values: Vec<Expr<'g>>,
    sums: &mut [Sum<'g>],
) -> Section<'g> {
    let mut coefficients = vec![];
    for (index, (value, sum)) in values.into_iter().zip(sums).enumerate() {
        if !value.is_zero() {
            let coefficient = Coefficient::new(letter, &[index + 1], value);
            sum.push((coefficient.name.clone(), writer.graph.one()));
            coefficients.push(coefficient);
        }
    }
    Section { title, by_symbols: false, coefficients }
}

/// The friction of the joints, and the joint forces that dry friction asks for.
fn frictions<'g>(writer: &Writer<'_, 'g>, sums: &mut [Sum<'g>]) -> Vec<Section<'g>> {
    if !writer.options.friction {
        return vec![];
    }
    let mechanism = writer.derivation().mechanism;
    let iterations = writer.iterations(Effects { wrench: true, friction: false });
    let mut joints =
        Section { title: "Forces in the joints", by_symbols: false, coefficients: vec![] };
    let mut shares = Section { title: "Friction", by_symbols: true, coefficients: vec![] };
    let mut values = vec![writer.graph.zero(); sums.len()];
    for (index, (link, LinkWrench { force, .. })) in
        mechanism.links.iter().zip(&iterations.wrenches).enumerate()
    {
        let mut named = *force;
        if !link.friction.coulomb.is_zero() {
            named = joint_force(writer, index, *force, &mut joints);
        }
        let share = friction(&link.friction, link.kind, link.axis, named, link.velocity);
        values[link.coordinate] += share * link.ratio;
    }
    for (index, (value, sum)) in values.into_iter().zip(sums).enumerate() {
        if !value.is_zero() {
            let name = format!("Q_f{}", index + 1);
            let lower =
                Math::Row(vec![Math::Letter('f'), Math::Sign(','), Math::integer(index + 1)]);
            let shape = Math::Letter('Q').with_lower(lower);
            sum.push((name.clone(), writer.graph.one()));
            shares.coefficients.push(Coefficient { name, shape, value });
        }
    }
    vec![joints, shares]
}

/// Symbols for the components of a joint force; components that are 0 stay so.
fn joint_force<'g>(
    writer: &Writer<'_, 'g>,
    index: usize,
    force: Vector<'g>,
    joints: &mut Section<'g>,
) -> Vector<'g> {
    let mut component = 0;
    force.map(|value| {
        let symbol =
            Symbol { kind: Kind::LinkForce, number: index + 1, component: Some(component) };
        component += 1;
        if value.is_zero() {
            return value;
        }
        let (name, shape) = (symbol.to_string(), shapes::quantity(symbol));
        let named = writer.graph.symbol(&name);
        joints.coefficients.push(Coefficient { name, shape, value });
        named
    })
}

fn symbols<'g>(writer: &Writer<'_, 'g>, prefix: &str) -> Vec<Expr<'g>> {
    let numbers = 1..=writer.robot.degrees_of_freedom();
    numbers.map(|number| writer.graph.symbol(&format!("{prefix}{number}"))).collect()
}

fn wrench_names(writer: &Writer<'_, '_>) -> Vec<String> {
    let names = |(_, wrench): (_, &robot_dynamics::model::Wrench)| {
        wrench.force.iter().chain(&wrench.moment).cloned().collect::<Vec<_>>()
    };
    writer.robot.tips().flat_map(names).collect()
}

/// Values with all velocities and accelerations 0, and further symbols of choice.
fn at_rest<'g>(
    writer: &Writer<'_, 'g>,
    values: &[Expr<'g>],
    zero: &dyn Fn(&str) -> bool,
) -> Vec<Expr<'g>> {
    walk::rebuild(values, writer.graph, |name| match is_rate(name) || zero(name) {
        true => writer.graph.zero(),
        false => writer.graph.symbol(name),
    })
}

/// The polynomials of all coefficients but those of friction, where they are short enough.
fn expanded<'g>(
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

fn all<'s, 'g>(sections: &'s [Section<'g>]) -> impl Iterator<Item = &'s Coefficient<'g>> {
    sections.iter().flat_map(|section| &section.coefficients)
}

fn as_polynomials<'g>(
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
        groups.push(group(section, equations));
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
        groups.push(group(section, equations));
    }
    Ok(groups)
}

fn group(section: &Section<'_>, equations: Vec<Equation>) -> Group {
    let title = section.title.to_owned();
    Group { title, introduction: String::new(), definitions: true, equations }
}
