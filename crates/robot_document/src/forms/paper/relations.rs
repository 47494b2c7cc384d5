//! The vector relations from which the paper's equations follow: (8), (14), (20), (26), (36) and (52).

use robot_dynamics::mechanism::{Mechanism, MechanismLink};
use robot_dynamics::quantity::{Kind, Symbol};
use robot_model::robot::JointKind;
use robot_symbolic::Expr;

use super::super::{Equation, Writer};
use crate::error::Error;
use crate::math::{Fence, Math, Script};

/// A vector relation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Relation {
    /// The name of the quantity that follows from it: `a_c4`, with the components `a_c4.x` …, or `Q1`.
    pub of: String,
    /// The relation as an equation, whose text is the name of that quantity.
    pub equation: Equation,
}

impl Relation {
    /// The beginning of the names of relations.
    pub(crate) const NAME: &'static str = "relation_";

    /// Whether the equation with this name follows from the relation.
    pub(crate) fn yields(&self, name: &str) -> bool {
        name.strip_prefix(&self.of).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    }
}

/// The relations that hold for the robot as the paper states them. Joints with drives of their own or with friction
/// have additional terms, so their relations are omitted.
pub(in crate::forms) fn relations(writer: &Writer<'_, '_>) -> Result<Vec<Relation>, Error> {
    let derivation = writer.derivation();
    let mechanism = &derivation.mechanism;
    let mut all = vec![];
    for (index, link) in mechanism.links.iter().enumerate() {
        let number = index + 1;
        all.push(of_vector(Kind::CenterOfMassAcceleration, number, acceleration(number)));
        let mut force = factor(writer, link.mass)?;
        force.push(Math::vector_in_paper(Kind::CenterOfMassAcceleration, number));
        all.push(of_vector(Kind::Force, number, force));
        all.push(of_vector(Kind::Moment, number, moment(number)));
        let carried = carried(mechanism, index);
        all.push(of_vector(Kind::LinkForce, number, joint_force(number, &carried)));
        if mechanism.links.iter().all(|link| link.rotor_coupling.is_zero()) {
            all.push(of_vector(Kind::LinkMoment, number, joint_moment(number, &carried)));
            let is_plain = link.ratio.is_one() && link.reflected_inertia.is_zero();
            if is_plain && !writer.options.friction {
                all.push(of_torque(number, link));
            }
        }
    }
    Ok(all)
}

/// The symbols that occur only in relations, with their meanings, for a link i and a link j that it carries.
pub(crate) fn vectors() -> Vec<(Math, &'static str)> {
    let i = || Math::Letter('i');
    let own = |letter| with(Math::Letter(letter).with_bar(), i(), i());
    let inertia = Math::row(vec![sign('*'), i()]);
    let rotation = Math::Fenced(Fence::Brackets, Box::new(Math::Letter('R')));
    let lever = |lower| with(Math::Letter('r').with_bar(), lower, i());
    vec![
        (own('ω'), "angular velocity of link i, rad/s"),
        (own('ε'), "angular acceleration of link i, rad/s²"),
        (own('a'), "acceleration of the origin of frame i, m/s²"),
        (lever(Math::Letter('c').with_lower(i())), "center of mass of link i, m"),
        (lever(Math::Letter('j')), "origin of frame j in frame i, m"),
        (
            with(rotation, Math::Letter('j'), i()),
            "rotation from the axes of frame j to those of frame i",
        ),
        (
            with(Math::Letter('J'), i(), inertia),
            "inertia tensor of link i about its center of mass, kg m²",
        ),
    ]
}

fn with(base: Math, lower: Math, upper: Math) -> Math {
    Math::Script(Box::new(Script { base, lower: Some(lower), upper: Some(upper) }))
}

fn of_vector(kind: Kind, number: usize, right: Vec<Math>) -> Relation {
    let of = format!("{}{number}", kind.name());
    relation(of, Math::vector_in_paper(kind, number), right)
}

fn relation(of: String, left: Math, right: Vec<Math>) -> Relation {
    let (name, text) = (format!("{}{of}", Relation::NAME), of.clone());
    Relation { of, equation: Equation { name, text, left, right: Math::row(right) } }
}

/// A scalar factor of a vector, in parentheses if it is a sum.
fn factor(writer: &Writer<'_, '_>, value: Expr<'_>) -> Result<Vec<Math>, Error> {
    let shown = writer.symbols.expression(value)?;
    let is_sum = shown.pieces().iter().any(|piece| matches!(piece, Math::Sign('+' | '-')));
    Ok(vec![match is_sum {
        true => Math::Fenced(Fence::Parentheses, Box::new(shown)),
        false => shown,
    }])
}

/// A letter with a bar, such as `\bar{r}_{c_5}^5`, with a lower index and the frame of its axes as the upper one.
fn bar(letter: char, lower: Math, axes: usize) -> Math {
    with(Math::Letter(letter).with_bar(), lower, Math::integer(axes))
}

fn own(letter: char, number: usize) -> Math {
    bar(letter, Math::integer(number), number)
}

fn center(number: usize) -> Math {
    bar('r', Math::Letter('c').with_lower(Math::integer(number)), number)
}

const fn sign(sign: char) -> Math {
    Math::Sign(sign)
}

/// (8): ā + ε̄ × r̄_c + ω̄ × (ω̄ × r̄_c)
fn acceleration(number: usize) -> Vec<Math> {
    let spin = vec![own('ω', number), sign('×'), center(number)];
    let spin = Math::Fenced(Fence::Parentheses, Box::new(Math::row(spin)));
    let turning = [own('ε', number), sign('×'), center(number)];
    let mut right = vec![own('a', number), sign('+')];
    right.extend(turning);
    right.extend([sign('+'), own('ω', number), sign('×'), spin]);
    right
}

/// (20): J ε̄ + ω̄ × J ω̄
fn moment(number: usize) -> Vec<Math> {
    let upper = Math::row(vec![sign('*'), Math::integer(number)]);
    let inertia = with(Math::Letter('J'), Math::integer(number), upper);
    let spin = [own('ω', number), sign('×'), inertia.clone(), own('ω', number)];
    let mut right = vec![inertia, own('ε', number), sign('+')];
    right.extend(spin);
    right
}

/// The numbers of the tips and children of a link, in the order in which their wrenches are added.
fn carried(mechanism: &Mechanism<'_>, link: usize) -> Vec<usize> {
    let tips = mechanism.frames.iter().filter(|frame| frame.wrench.is_some());
    let tips = tips.enumerate().filter(|(_, frame)| frame.link == Some(link));
    let tips = tips.map(|(place, _)| mechanism.links.len() + 1 + place);
    let links = mechanism.links.iter().enumerate().rev();
    let children =
        links.filter(|(_, child)| child.parent == Some(link)).map(|(index, _)| index + 1);
    tips.chain(children).collect()
}

/// A rotation times a vector, such as `[R]_6^5 ·` and the vector.
fn turned(from: usize, to: usize, vector: Math) -> [Math; 3] {
    let base = Math::Fenced(Fence::Brackets, Box::new(Math::Letter('R')));
    [with(base, Math::integer(from), Math::integer(to)), sign('·'), vector]
}

/// (26): the forces of the carried links, and the link's own force.
fn joint_force(number: usize, carried: &[usize]) -> Vec<Math> {
    let mut right = vec![];
    for one in carried {
        right.extend(turned(*one, number, Math::vector_in_paper(Kind::LinkForce, *one)));
        right.push(sign('+'));
    }
    right.push(Math::vector_in_paper(Kind::Force, number));
    right
}

/// (36): the moments and forces of the carried links, and the link's own moment and force.
fn joint_moment(number: usize, carried: &[usize]) -> Vec<Math> {
    let mut right = vec![];
    for one in carried {
        right.extend(turned(*one, number, Math::vector_in_paper(Kind::LinkMoment, *one)));
        right.push(sign('+'));
    }
    let lever = [center(number), sign('×'), Math::vector_in_paper(Kind::Force, number), sign('+')];
    right.extend(lever);
    for one in carried {
        right.extend([bar('r', Math::integer(*one), number), sign('×')]);
        right.extend(turned(*one, number, Math::vector_in_paper(Kind::LinkForce, *one)));
        right.push(sign('+'));
    }
    right.push(Math::vector_in_paper(Kind::Moment, number));
    right
}

/// (52): the projection on the joint axis, with components if the axis is an axis of the frame.
fn of_torque(number: usize, link: &MechanismLink<'_>) -> Relation {
    let kind = match link.kind {
        JointKind::Revolute => Kind::LinkMoment,
        JointKind::Prismatic => Kind::LinkForce,
    };
    let axes: Vec<usize> = (0..3).filter(|axis| !link.axis.0[*axis].is_zero()).collect();
    let along = match axes.as_slice() {
        [axis] if link.axis.0[*axis].is_one() => Some(*axis),
        _ => None,
    };
    let vector = Math::vector_in_paper(kind, number);
    let vector = Math::Fenced(Fence::Brackets, Box::new(vector)).with_upper(Math::Letter('T'));
    let unit = along.map_or('k', |axis| ['i', 'j', 'k'][axis.min(2)]);
    let mut right = vec![vector, sign('·'), own(unit, number)];
    if let Some(axis) = along {
        let component = |axis| Math::quantity(Symbol { kind, number, component: Some(axis) });
        let row = Math::Matrix(vec![[0, 1, 2].map(component).to_vec()]);
        let column = [0, 1, 2].map(|one| vec![Math::integer(usize::from(one == axis))]);
        right.extend([sign('='), row, sign('·'), Math::Matrix(column.to_vec())]);
        right.extend([sign('='), component(axis)]);
    }
    let symbol = Symbol { kind: Kind::JointTorque, number, component: None };
    relation(symbol.to_string(), Math::in_paper(symbol), right)
}
