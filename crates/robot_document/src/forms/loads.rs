//! Contributions to the joint torques that are not products with velocities or accelerations: gravity, the wrenches of
//! the tips, and friction.

use robot_dynamics::mechanism::MechanismFriction;
use robot_dynamics::newton_euler::{LinkWrench, friction};
use robot_dynamics::quantity::{Kind, Symbol};
use robot_dynamics::vector::Vector;
use robot_model::functions::Effects;
use robot_symbolic::{Expr, Polynomial, walk};

use super::Writer;
use super::coefficients::{Coefficient, LIMITS, Section, Sum};
use super::letters::candidates;
use crate::layout::is_rate;
use crate::math::Math;

/// The gravity terms: the joint torques at rest and without wrenches.
pub(super) fn gravity<'g>(
    writer: &Writer<'_, 'g>,
    forces: &[Expr<'g>],
    sums: &mut [Sum<'g>],
) -> Section<'g> {
    let wrenches = wrench_names(writer);
    let values = at_rest(writer, forces, &|name| wrenches.iter().any(|known| known == name));
    let letter = writer.letter(writer.options.letters.gravity.as_deref(), &candidates::GRAVITY);
    single(writer, "Gravity", &letter, values, sums)
}

/// The contributions of the wrenches of the tips: Jᵀ times the wrench.
pub(super) fn wrenches<'g>(
    writer: &Writer<'_, 'g>,
    forces: &[Expr<'g>],
    sums: &mut [Sum<'g>],
) -> Section<'g> {
    let still = at_rest(writer, forces, &|_| false);
    let mut values = vec![writer.graph.zero(); forces.len()];
    for name in wrench_names(writer) {
        let component = writer.graph.symbol(&name);
        for (value, slope) in values.iter_mut().zip(walk::derivatives(&still, component)) {
            *value += slope * component;
        }
    }
    single(writer, "Wrenches of the tips", &writer.letter(None, &candidates::WRENCH), values, sums)
}

/// One coefficient for each joint torque.
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

/// All friction parameters, as in the robot file.
pub(super) fn whole<'g>(friction: &MechanismFriction<'g>) -> MechanismFriction<'g> {
    friction.clone()
}

/// The friction of the joints with the parameters that `part` selects, and the joint forces that dry friction needs.
pub(super) fn frictions<'g>(
    writer: &Writer<'_, 'g>,
    title: &'static str,
    part: fn(&MechanismFriction<'g>) -> MechanismFriction<'g>,
    sums: &mut [Sum<'g>],
) -> Vec<Section<'g>> {
    if !writer.options.friction {
        return vec![];
    }
    let (mut joints, values) = friction_contributions(writer, part);
    let mut contributions = Section { title, by_symbols: true, coefficients: vec![] };
    for (index, (value, sum)) in values.into_iter().zip(sums).enumerate() {
        if !value.is_zero() {
            let letters = &writer.options.letters;
            let name = format!("{}_f{}", letters.torque(), index + 1);
            let lower =
                Math::Row(vec![Math::Letter('f'), Math::Sign(','), Math::integer(index + 1)]);
            let shape = letters.torque_sign().with_lower(lower);
            sum.push((name.clone(), writer.graph.one()));
            contributions.coefficients.push(Coefficient { name, shape, value });
        }
    }
    // Friction does not depend on all components of a joint force.
    let values: Vec<Expr<'g>> =
        contributions.coefficients.iter().map(|coefficient| coefficient.value).collect();
    let used = walk::symbols(&values);
    joints
        .coefficients
        .retain(|force| used.iter().any(|symbol| writer.graph.symbol_name(*symbol) == force.name));
    vec![joints, contributions]
}

/// The title of the contact forces and moments that dry friction needs.
pub(super) const CONTACT_FORCES: &str = "Contact forces and moments";

/// The joint forces that dry friction needs, and the contributions of friction to the joint torques in symbols for
/// these forces.
pub(super) fn friction_contributions<'g>(
    writer: &Writer<'_, 'g>,
    part: fn(&MechanismFriction<'g>) -> MechanismFriction<'g>,
) -> (Section<'g>, Vec<Expr<'g>>) {
    let mechanism = writer.derivation().mechanism;
    let iterations = writer.iterations(Effects { wrench: true, friction: false });
    let mut joints = Section { title: CONTACT_FORCES, by_symbols: false, coefficients: vec![] };
    let mut values = vec![writer.graph.zero(); mechanism.degrees_of_freedom];
    for (index, (link, LinkWrench { force, .. })) in
        mechanism.links.iter().zip(&iterations.wrenches).enumerate()
    {
        let mut named = *force;
        if !link.friction.coulomb.is_zero() {
            named = joint_force(writer, index, *force, &mut joints);
        }
        let contribution =
            friction(&part(&link.friction), link.kind, link.axis, named, link.velocity);
        values[link.coordinate] += contribution * link.ratio;
    }
    (joints, values)
}

/// Names the components of a joint force; components that are 0 stay 0.
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
        // A component that is 0 would not be printed as a joint force.
        if Polynomial::of(value, &LIMITS).is_ok_and(|value| value.is_zero()) {
            return writer.graph.zero();
        }
        // The dot in the name of a quantity is replaced, so that the text can be parsed.
        let name = symbol.to_string().replace('.', "_");
        let shape = Math::quantity(symbol);
        let named = writer.graph.symbol(&name);
        joints.coefficients.push(Coefficient { name, shape, value });
        named
    })
}

fn wrench_names(writer: &Writer<'_, '_>) -> Vec<String> {
    let names = |(_, wrench): (_, &robot_model::robot::Wrench)| {
        wrench.components().map(str::to_owned).collect::<Vec<_>>()
    };
    writer.robot.tips().flat_map(names).collect()
}

/// The values with all velocities, all accelerations and the symbols that `zero` selects set to 0.
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
