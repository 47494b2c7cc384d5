//! The meanings of the symbols that equations define. Symbols of one kind are explained together, with letters as
//! indices.

use robot_dynamics::quantity::Kind;

use crate::document::{Cell, Inline};
use crate::forms::{Equation, Equations, Form, Group, LINK_MASS, Letters, Relation, paper, titles};
use crate::math::{Math, Script};

/// Symbols of one kind.
pub(super) struct Family {
    /// The layout of the symbols, with letters in place of numbers.
    pub(super) shape: Math,
    /// The meaning of the symbols.
    pub(super) meaning: Cell,
}

/// The letters that replace indices.
const INDICES: [char; 3] = ['i', 'j', 'k'];

/// The kinds of symbols on the left sides of equations, in order. The names of standard and base parameters are
/// omitted, because they are explained with their definitions.
pub(super) fn families(parts: &[(Form, Equations)], letters: &Letters) -> Vec<Family> {
    let mut known: Vec<(String, usize, Math)> = vec![];
    let mut families = vec![];
    let groups = parts.iter().flat_map(|(_, part)| part.groups.iter().map(move |one| (part, one)));
    for (part, group) in groups {
        let is_relation = |one: &&Equation| one.name.starts_with(Relation::NAME);
        if group.equations.iter().any(|one| is_relation(&one)) {
            let vectors = paper::vectors().into_iter();
            families.extend(
                vectors
                    .map(|(shape, meaning)| Family { shape, meaning: vec![Inline::text(meaning)] }),
            );
        }
        for equation in group.equations.iter().filter(|one| !is_relation(one)) {
            let count = numbers(&equation.name);
            let shape = general(&equation.left, count);
            let family = family(&equation.name).to_owned();
            let is_one = |(name, numbers, look): &(String, usize, Math)| {
                *name == family && *numbers == count && same(look, &shape)
            };
            if known.iter().any(is_one) {
                continue;
            }
            known.push((family.clone(), count, shape.clone()));
            let meaning = match &equation.right {
                Math::Matrix(_) => of_array(group, part, &equation.name, letters),
                _ if equation.name == letters.torque() => {
                    of_name("joint torques (N m) and joint forces (N)")
                }
                _ => meaning(group, &family, count, letters),
            };
            if let Some(meaning) = meaning {
                families.push(Family { shape, meaning });
            }
        }
    }
    families
}

/// Whether one explanation serves for both members of a family, as it does for components of one vector.
fn same(first: &Math, other: &Math) -> bool {
    base(first) == base(other)
}

fn base(shape: &Math) -> Option<&Math> {
    match shape {
        Math::Symbol(symbol) => base(&symbol.shape),
        Math::Script(script) => Some(&script.base),
        _ => None,
    }
}

/// The family of a symbol: `M` for `M_1_2`, `F_l` for `F_l5.x` and `F_l5_x`, `omega` for `omega1.x`.
fn family(name: &str) -> &str {
    let name = name.split_once('.').map_or(name, |(name, _)| name);
    let bare = ["_x", "_y", "_z"].iter().find_map(|end| name.strip_suffix(end));
    let bare = bare.filter(|bare| bare.ends_with(|c: char| c.is_ascii_digit()));
    bare.unwrap_or(name).trim_end_matches(|c: char| c.is_ascii_digit() || c == '_')
}

/// The number of indices of a symbol such as `M_1_2` or `Q1`.
fn numbers(name: &str) -> usize {
    let is_number = |part: &&str| part.bytes().all(|byte| byte.is_ascii_digit());
    name.split('_').skip(1).filter(is_number).count().max(1)
}

/// The layout of a symbol with letters in place of its numbers; a single number can stand for several indices.
pub(super) fn general(shape: &Math, indices: usize) -> Math {
    let mut letters = INDICES.into_iter().map(Math::Letter);
    let all = count(shape);
    replaced(shape, &mut |_| match all {
        // The lower and the upper index of a vector are the same link.
        _ if indices == 1 => Math::Letter('i'),
        1 => Math::row(letters.by_ref().take(indices).collect()),
        _ => letters.next().unwrap_or(Math::Letter('n')),
    })
}

fn count(shape: &Math) -> usize {
    let mut numbers = 0;
    let _ = replaced(shape, &mut |digits| {
        numbers += 1;
        Math::Number(digits.to_owned())
    });
    numbers
}

/// Replaces the numbers in a layout.
fn replaced(shape: &Math, number: &mut dyn FnMut(&str) -> Math) -> Math {
    match shape {
        Math::Symbol(symbol) => replaced(&symbol.shape, number),
        Math::Number(digits) => number(digits),
        Math::Row(pieces) => {
            Math::Row(pieces.iter().map(|piece| replaced(piece, number)).collect())
        }
        Math::Script(script) => {
            let [lower, upper] = [&script.lower, &script.upper]
                .map(|index| index.as_ref().map(|index| replaced(index, number)));
            Math::Script(Box::new(Script { base: script.base.clone(), lower, upper }))
        }
        other => other.clone(),
    }
}

fn of_name(text: &str) -> Option<Cell> {
    Some(vec![Inline::text(text)])
}

/// The meaning of a matrix or column in a group.
fn of_array(group: &Group, part: &Equations, name: &str, letters: &Letters) -> Option<Cell> {
    let text = match group.title.as_str() {
        "Mass matrix" => "mass matrix",
        "Coriolis and centrifugal terms" => "Coriolis and centrifugal terms",
        titles::MATRIX | titles::BOTH => "matrix of the Coriolis and centrifugal terms",
        "Gravity" => "gravity terms",
        "Wrenches of the tips" => "contributions of the wrenches of the tips",
        "Friction" => "friction of the joints",
        _ => return of_vector(group, part, name, letters),
    };
    of_name(text)
}

/// The meaning of a vector of the links, and the layout of its components if equations use them.
fn of_vector(group: &Group, part: &Equations, name: &str, letters: &Letters) -> Option<Cell> {
    let mut cell = meaning(group, family(name), 1, letters)?;
    if let Some(Inline::Text(text)) = cell.first_mut() {
        *text = text.trim_start_matches("component of the ").to_owned();
        let component = format!("{name}.x");
        if part.symbols.is_defined(&component) {
            text.push_str("; its component along x: ");
            cell.push(Inline::Math(general(&part.symbols.look(&component), 1)));
        }
    }
    Some(cell)
}

/// The meaning of the symbols of a family in a group.
fn meaning(group: &Group, family: &str, numbers: usize, letters: &Letters) -> Option<Cell> {
    let text = match (group.title.as_str(), family) {
        ("Standard parameters" | "Base parameters", _) => return None,
        ("Coriolis and centrifugal terms", _) if numbers == 3 => {
            return Some(product(letters));
        }
        ("Coriolis and centrifugal terms", _) => "Coriolis and centrifugal term of joint i",
        ("Mass matrix", _) => "entry of the mass matrix",
        (titles::MATRIX | titles::BOTH, _) if numbers == 2 => {
            "entry of the matrix of the Coriolis and centrifugal terms"
        }
        (titles::SYMBOLS | titles::BOTH, _) => "Christoffel symbol of the first kind",
        ("Gravity", _) => "gravity term of joint i",
        ("Wrenches of the tips", _) => "contribution of the wrenches of the tips to joint i",
        ("Friction", _) => "friction of joint i",
        ("Load-dependent friction", _) => "load-dependent friction of joint i",
        ("Coefficients of the base parameters", _) => "coefficient of base parameter j in joint i",
        ("Combinations of parameters", _) => "combination of parameters",
        ("Expressions of the state", _) => "expression that occurs several times",
        ("Parameters of the links", "r") => "component of the center of mass of link i, m",
        ("Parameters of the links", "J") => "entry of the inertia tensor of link i, kg m²",
        ("Parameters of the links", letter) if LINK_MASS.contains(&letter) => "mass of link i, kg",
        ("Parameters of the links", _) => "combination of parameters",
        (_, "omega") => "component of the angular velocity of link i, rad/s",
        (_, "epsilon") => "component of the angular acceleration of link i, rad/s²",
        (_, "a") => "component of the acceleration of the origin of frame i, m/s²",
        (_, name) => {
            let torque = (!group.definitions).then_some(Kind::JointTorque);
            of_quantity(Kind::from_name(name).or(torque)?)
        }
    };
    Some(vec![Inline::text(text)])
}

const fn of_quantity(kind: Kind) -> &'static str {
    match kind {
        Kind::CenterOfMassAcceleration => {
            "component of the acceleration of the center of mass of link i, m/s²"
        }
        Kind::Force => "component of the force that moves link i, N",
        Kind::Moment => "component of the moment about the center of mass that moves link i, N m",
        Kind::LinkForce => "component of the force that link i receives through its joint, N",
        Kind::LinkMoment => "component of the moment that link i receives through its joint, N m",
        Kind::JointTorque => "joint torque (N m) or joint force (N) of joint i",
    }
}

/// The meaning of a coefficient of two velocities: it names their product.
fn product(letters: &Letters) -> Cell {
    let rate = |index| {
        let letter = Box::new(Math::Letter('q'));
        let rate = Math::Accent(robot_model::signs::Accent::Dot, letter);
        rate.with_lower(Math::Letter(index))
    };
    let force = letters.torque_sign().with_lower(Math::Letter('i'));
    vec![
        Inline::text("coefficient of "),
        Inline::Math(Math::Row(vec![rate('j'), rate('k')])),
        Inline::text(" in "),
        Inline::Math(force),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::{formula, read};

    #[test]
    fn members_of_a_family_have_letters_for_their_numbers() {
        for (name, look, general_look, family_name) in [
            ("M_1_2", "M_{12}", "M_{ij}", "M"),
            ("b_1_10_2", "b_{1,10,2}", "b_{i,j,k}", "b"),
            ("Q1", "Q_1", "Q_i", "Q"),
            ("omega2.x", r"\omega_{2,x}", r"\omega_{i,x}", "omega"),
            ("F_l5_x", "F_{l_x}^{5}", "F_{l_x}^i", "F_l"),
            ("F_l5.x", "F_{l_x}^{5}", "F_{l_x}^i", "F_l"),
            ("a_c4", r"\left[\bar{a}_c\right]_4^{4}", r"\left[\bar{a}_c\right]_i^i", "a_c"),
        ] {
            let shape = general(&read(look).unwrap(), numbers(name));
            assert_eq!((formula(&shape).as_str(), family(name)), (general_look, family_name));
        }
    }
}
