//! The grouped form Q = M(q) q̈ + C(q, q̇) q̇ + g(q), with a function for each coefficient.

use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, Rational, walk};

use super::coefficients::{
    Coefficient, Section, Shown, Sum, by_name, define_all, limit, motions, shown,
};
use super::independent::Joints;
use super::letters::candidates;
use super::loads::{frictions, gravity, whole, wrenches};
use super::matrices::{Known, Term, attach};
use super::{Equation, Group, Writer, aliases};
use crate::error::Error;

/// The largest number of coordinates. The number of coefficients grows with its third power, and each becomes longer
/// too.
pub(super) const MAX_COORDINATES: usize = 12;

pub(super) fn groups(writer: &mut Writer<'_, '_>) -> Result<Vec<Group>, Error> {
    let coordinates = writer.robot.degrees_of_freedom();
    if coordinates > MAX_COORDINATES {
        return Err(Error::TooMany { coordinates, limit: MAX_COORDINATES });
    }
    let forces = writer.exact_forces();
    // For each joint torque, its coefficients and their factors.
    let mut sums: Vec<Sum<'_>> = forces.iter().map(|_| vec![]).collect();
    let mut sections = vec![
        masses(writer, &forces, &mut sums),
        velocities(writer, &forces, &mut sums),
        gravity(writer, &forces, &mut sums),
        wrenches(writer, &forces, &mut sums),
    ];
    sections.extend(frictions(writer, "Friction", whole, &mut sums));
    let mut shown = shown(writer, &sections);
    if writer.options.references {
        aliases::replace(&sections, &mut shown, &mut sums);
    }
    limit(writer, &sections, &mut shown);
    let is_united = shown.iter().flatten().any(|shown| matches!(shown, Shown::Earlier));
    let introduction = introduction(writer, is_united);
    // The values that are known below are printed with these symbols.
    let zeros = define_all(writer, &sections, &shown)?;
    let known = Known::new(writer, &sections, &shown, &sums)?;
    let title = "Equations of motion, grouped";
    let mut groups = by_name(writer, title, introduction, &sections, shown, sums, &zeros)?;
    let terms: Vec<(Term, &Section<'_>)> =
        terms(&sections).filter(|(_, section)| !known.is_empty(section)).collect();
    attach(writer, &mut groups, &terms, &known)?;
    Ok(groups)
}

/// The titles of the group of the Christoffel symbols. It has the matrix of the Coriolis and centrifugal terms, the
/// symbols in its entries, or both.
pub(crate) mod titles {
    pub(crate) const SYMBOLS: &str = "Christoffel symbols";
    pub(crate) const MATRIX: &str = "Matrix of the Coriolis and centrifugal terms";
    pub(crate) const BOTH: &str =
        "Matrix of the Coriolis and centrifugal terms, Christoffel symbols";
}

/// The title of a group with this title whose equations are shown if its arrays are in `equations`.
pub(super) fn arranged_title(group: &Group, equations: &[Equation]) -> String {
    let is_symbol = |one: &Equation| group.equations.iter().any(|own| own.name == one.name);
    let has_symbols = equations.iter().any(is_symbol);
    match group.title == titles::SYMBOLS && !equations.iter().all(is_symbol) {
        false => group.title.clone(),
        true if has_symbols => titles::BOTH.to_owned(),
        true => titles::MATRIX.to_owned(),
    }
}

/// The sections that are terms of the joint torques. Among those of friction, this is only the last one, which has the
/// contributions; the joint forces that these need come before it.
fn terms<'s, 'g>(sections: &'s [Section<'g>]) -> impl Iterator<Item = (Term, &'s Section<'g>)> {
    let terms = [Term::Accelerations, Term::Velocities, Term::Positions, Term::Other];
    let last = sections.get(terms.len()..).and_then(<[_]>::last).map(|last| (Term::Other, last));
    terms.into_iter().zip(sections).chain(last)
}

fn introduction(writer: &Writer<'_, '_>, is_united: bool) -> String {
    let rates = match writer.options.has_christoffel() {
        true => "Christoffel symbols of the first kind for the Coriolis and centrifugal terms",
        false => {
            "Coriolis and centrifugal terms or the coefficients of the velocity products in them"
        }
    };
    let equal = match is_united {
        true => ", and those that equal an earlier one, perhaps with the opposite sign,",
        false => "",
    };
    format!(
        "These are the entries of the symmetric mass matrix, which multiply the accelerations, the {rates}, and the \
         gravity terms. Entries and coefficients depend only on the coordinates; those that are zero{equal} have no \
         equation of their own."
    )
}

/// The entries of the mass matrix on and above the diagonal, row by row: Mᵢⱼ = ∂Qᵢ/∂q̈ⱼ.
fn masses<'g>(writer: &Writer<'_, 'g>, forces: &[Expr<'g>], sums: &mut [Sum<'g>]) -> Section<'g> {
    let letter = writer.letter(writer.options.letters.mass.as_deref(), &candidates::MASS_MATRIX);
    let rates = motions(writer, JointVariable::Acceleration);
    let columns: Vec<_> = rates.iter().map(|rate| walk::derivatives(forces, *rate)).collect();
    let mut coefficients = vec![];
    for row in 0..sums.len() {
        for column in row..sums.len() {
            let value = columns[column][row];
            if value.is_zero() {
                continue;
            }
            let entry = Coefficient::new(&letter, &[row + 1, column + 1], value);
            sums[row].push((entry.name.clone(), rates[column]));
            if row != column {
                sums[column].push((entry.name.clone(), rates[row]));
            }
            coefficients.push(entry);
        }
    }
    Section { title: "Mass matrix", by_symbols: false, coefficients }
}

/// The coefficients of q̇ⱼ q̇ₖ, j ≤ k, in the joint torque i: ∂²Qᵢ/∂q̇ⱼ∂q̇ₖ, or half of it if j = k. The Christoffel
/// symbol is half of this derivative in both cases.
fn velocities<'g>(
    writer: &Writer<'_, 'g>,
    forces: &[Expr<'g>],
    sums: &mut [Sum<'g>],
) -> Section<'g> {
    let christoffel = writer.options.has_christoffel();
    let (letters, title) = match christoffel {
        true => (&candidates::CHRISTOFFEL, titles::SYMBOLS),
        false => (&candidates::VELOCITY, "Coriolis and centrifugal terms"),
    };
    let letter = writer.letter(writer.options.letters.velocity.as_deref(), letters);
    let graph = writer.graph;
    let half = graph.number(Rational::new(1, 2).unwrap_or(Rational::ONE));
    let rates = motions(writer, JointVariable::Velocity);
    let second = |first: &Expr<'g>| -> Vec<Vec<Expr<'g>>> {
        let slopes = walk::derivatives(forces, *first);
        rates.iter().map(|rate| walk::derivatives(&slopes, *rate)).collect()
    };
    let slopes: Vec<Vec<Vec<Expr<'g>>>> = rates.iter().map(second).collect();
    let joints = Joints::new(writer.robot);
    let mut coefficients = vec![];
    for (index, sum) in sums.iter_mut().enumerate() {
        for first in 0..rates.len() {
            for other in first..rates.len() {
                let slope = slopes[first][other][index];
                if slope.is_zero() || joints.is_zero(index, first, other) {
                    continue;
                }
                let (value, factor) = match (christoffel, first == other) {
                    (_, true) => (slope * half, 1),
                    (true, false) => (slope * half, 2),
                    (false, false) => (slope, 1),
                };
                let numbers = [index + 1, first + 1, other + 1];
                let coefficient = Coefficient::new(&letter, &numbers, value);
                let rates = rates[first] * rates[other] * graph.integer(factor);
                sum.push((coefficient.name.clone(), rates));
                coefficients.push(coefficient);
            }
        }
    }
    Section { title, by_symbols: false, coefficients }
}

#[cfg(test)]
mod tests {
    use robot_model::description::read_toml;

    use crate::{EquationOptions, Form, equations};

    /// The frames of the code are turned to the line between the joints, by atan(0.05/0.4).
    #[test]
    fn coefficients_have_the_numbers_of_the_file() {
        let link = |name: &str, origin: &str, mass: f64, inertia: f64| {
            format!(
                "[[link]]\nname = \"{name}\"\njoint = {{ type = \"revolute\", axis = \"z\" }}\n{origin}mass = {mass}\n\
                 center_of_mass = [0.15, 0, 0]\ninertia = {{ zz = {inertia}, unchecked = true }}\n"
            )
        };
        let links =
            [link("1", "", 3.0, 0.05), link("2", "origin = { xyz = [0.4, 0.05, 0] }\n", 2.0, 0.03)];
        let text = format!("format = 1\n[robot]\nname = \"arm\"\n{}", links.concat());
        let robot = read_toml("arm.toml", &text).unwrap().robot;
        let options = EquationOptions { form: Form::Grouped, ..EquationOptions::default() };
        let found = equations(&robot, &options).unwrap();
        let mass = found.definitions().find(|one| one.name == "M_1_1").unwrap();
        assert_eq!(mass.text, "0.03*sin(q2) + 0.24*cos(q2) + 0.5175");
    }
}
