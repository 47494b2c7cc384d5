//! The regrouped form Q = Y(q, q̇, q̈) β, which is linear in the base parameters.

use robot_dynamics::base_parameters::{BaseParameter, BaseParameters, Quantity, StandardParameter};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismFriction;
use robot_model::robot::{BaseFrames, Robot};
use robot_symbolic::collected::length;
use robot_symbolic::print::{ArrangedFactor, ArrangedTerm};
use robot_symbolic::{Expr, Formula, Number, Polynomial, Rational};

use super::coefficients::{
    Coefficient, Section, Shown, Sum, by_name, define_all, definitions_of, limit, shown,
};
use super::letters::candidates;
use super::loads::{frictions, wrenches};
use super::{Equation, Group, Writer, aliases, joint_torque, shapes};
use crate::base_parameters::{self as base, Formulas, Written};
use crate::error::Error;
use crate::math::Math;

/// The largest number of printed symbols of all coefficients if they are written into the joint torques.
const MAX_LENGTH: usize = 4000;

pub(super) fn groups(writer: &mut Writer<'_, '_>) -> Result<Vec<Group>, Error> {
    let robot = considered(writer);
    let derivation = Derivation::new(&robot, writer.graph, &writer.mechanism_options(), None);
    let found = base::found(&derivation)?;
    let outputs = derivation.regressor_over(&found).outputs;
    let mut columns: Vec<Expr<'_>> = outputs.into_iter().flat_map(|output| output.values).collect();
    let values = base::expanded_values(&found, &robot)?;
    let equal = equal_frictions(&found, &values);
    for row in columns.chunks_mut(values.len().max(1)) {
        for (forward, backward) in &equal {
            row[*forward] += row[*backward];
        }
    }
    let (mut groups, parameters) = definitions(writer, &found, &values, &equal)?;
    let forces = writer.exact_forces();
    let mut sums: Vec<Sum<'_>> = forces.iter().map(|_| vec![]).collect();
    let mut sections = vec![
        coefficients(writer, &columns, &parameters, &mut sums),
        wrenches(writer, &forces, &mut sums),
    ];
    if writer.options.friction {
        sections.extend(frictions(writer, "Load-dependent friction", load_dependent, &mut sums));
    }
    writer.check_size()?;
    let introduction = introduction(&found);
    let mut shown = shown(writer, &sections);
    let lengths: Option<Vec<usize>> = shown.first().into_iter().flatten().map(length_of).collect();
    groups.extend(match lengths.filter(|lengths| lengths.iter().sum::<usize>() <= MAX_LENGTH) {
        Some(_) => inline(writer, introduction, &sections, &shown, sums)?,
        None => {
            if writer.options.references {
                aliases::replace_symbols(sections.first(), shown.first_mut(), &mut sums);
                aliases::replace(&sections, &mut shown, &mut sums);
            }
            limit(writer, &sections, &mut shown);
            let zeros = define_all(writer, &sections, &shown)?;
            by_name(writer, TITLE, introduction, &sections, shown, sums, &zeros)?
        }
    });
    Ok(groups)
}

/// The robot, without the constant friction offsets if friction is not printed: a reflected inertia that acts against
/// gravity is regrouped with an offset, and would be lost with it.
fn considered(writer: &Writer<'_, '_>) -> Robot {
    let mut robot = writer.robot.clone();
    if !writer.options.friction {
        for link in &mut robot.links {
            link.friction.offset = Formula::number(&Rational::ZERO);
        }
    }
    robot
}

/// The number of printed symbols of a coefficient; `None` if it needs names.
fn length_of(shown: &Shown<'_>) -> Option<usize> {
    match shown {
        Shown::Zero => Some(0),
        Shown::Short { terms, .. } => Some(length(terms)),
        Shown::Long { .. } | Shown::Earlier => None,
    }
}

const TITLE: &str = "Equations of motion, regrouped";

fn introduction(found: &BaseParameters<'_>) -> String {
    format!(
        "The joint torques are linear in the base parameters, the smallest set of combinations \
         of link and drive parameters that determines them: {} of {}. Zeros are omitted.",
        found.base.len(),
        found.standard.len()
    )
}

/// The explanation of the names of base parameters that are moments in other frames.
const MOMENTS: &str = "In the names of base parameters, SXX is the second moment ∫ x² dm of a \
    link, SXY is ∫ x y dm and so on, and MX, MY, MZ are the first moments, in Denavit-Hartenberg \
    frames: z is the joint axis, and the origin is the point where the common normal with the \
    parent's joint axis meets it if both joints are revolute, and otherwise the file's origin; a D \
    marks a parameter that differs from the file's parameter of the same name.";

/// The explanation of the name of dry friction that is the same in both directions.
const UNITED: &str = "FC is constant dry friction that is the same in both directions.";

/// The places of the forward and backward friction of each joint at which these are equal, so that one term with the
/// sign of the velocity stands for both: ½ f (s² + s) + ½ f (s − s²) = f s.
fn equal_frictions(found: &BaseParameters<'_>, values: &[Polynomial<'_>]) -> Vec<(usize, usize)> {
    let of = |wanted: Quantity| {
        let all = found.base.iter().zip(values).enumerate();
        let is_own =
            move |one: &BaseParameter<'_>| one.kept.quantity == wanted && one.terms.len() == 1;
        all.filter(move |(_, (parameter, _))| is_own(parameter))
    };
    let mut equal = vec![];
    for (forward, (parameter, value)) in of(Quantity::ForwardFriction) {
        let backward = of(Quantity::BackwardFriction)
            .find(|(_, (other, same))| other.kept.link == parameter.kept.link && *same == value);
        equal.extend(backward.map(|(backward, _)| (forward, backward)));
    }
    equal
}

/// The symbol of dry friction that is the same in both directions. Its definition is added to `equations`, unless
/// the friction is itself a symbol of the robot file, which is then used.
fn united_friction<'g>(
    writer: &mut Writer<'_, 'g>,
    link: usize,
    value: &Polynomial<'g>,
    equations: &mut Vec<Equation>,
) -> Result<Expr<'g>, Error> {
    if let Some(name) = symbol_of(value) {
        return Ok(writer.graph.symbol(&name));
    }
    let formulas = Formulas { robot: writer.robot, symbols: &writer.symbols, order: &writer.order };
    let Written { text, math: right } = formulas.of_polynomial(&writer.with_decimals(value))?;
    let name = format!("FC_{}", link + 1);
    writer.define_parameter(&name, base::word("FC", link))?;
    let left = writer.symbols.look(&name);
    let symbol = writer.graph.symbol(&name);
    equations.push(Equation { name, text, left, right });
    Ok(symbol)
}

/// The definitions of the base parameters and of the standard parameters in them, and the symbols of the base
/// parameters by their columns.
///
/// Of each pair of `equal` friction parameters, only the first has a symbol, which stands for both.
fn definitions<'g>(
    writer: &mut Writer<'_, 'g>,
    found: &BaseParameters<'g>,
    values: &[Polynomial<'g>],
    equal: &[(usize, usize)],
) -> Result<(Vec<Group>, Vec<Option<Expr<'g>>>), Error> {
    let friction = writer.options.friction;
    let is_used = |(parameter, value): &(&BaseParameter<'g>, &Polynomial<'g>)| {
        !value.is_zero() && (friction || !is_friction(parameter.kept.quantity))
    };
    let used = || found.base.iter().zip(values).filter(is_used);
    let regrouped = used().filter(|(parameter, _)| parameter.terms.len() > 1);
    let places = regrouped.flat_map(|(parameter, _)| parameter.terms.iter().map(|term| term.0));
    let (standard, written) = standard(writer, found, &places.collect::<Vec<_>>())?;
    let mut equations = vec![];
    let mut symbols = vec![];
    let mut has_united = false;
    for (place, pair) in found.base.iter().zip(values).enumerate() {
        let is_backward = equal.iter().any(|(_, backward)| *backward == place);
        let stands_for_both = equal.iter().any(|(forward, _)| *forward == place);
        symbols.push(if !is_used(&pair) || is_backward {
            None
        } else if stands_for_both {
            let known = equations.len();
            let symbol = united_friction(writer, pair.0.kept.link, pair.1, &mut equations)?;
            has_united |= equations.len() > known;
            Some(symbol)
        } else {
            Some(parameter(writer, pair.0, pair.1, &written, &mut equations)?)
        });
    }
    let mut groups = vec![
        Group::of_definitions("Standard parameters", standard),
        Group::of_definitions("Base parameters", equations),
    ];
    if let Some(first) = groups.iter_mut().find(|group| !group.equations.is_empty()) {
        let moments = match found.frames {
            BaseFrames::File => String::new(),
            BaseFrames::DenavitHartenberg => format!(" {MOMENTS}"),
        };
        let united = if has_united { format!(" {UNITED}") } else { String::new() };
        first.introduction = format!(
            "{}{moments}{united} A base parameter that equals a parameter of the robot file keeps the symbol of that parameter.",
            base::NAMES
        );
    }
    Ok((groups, symbols))
}

/// The definitions of the standard parameters at `places`, and the way in which each standard parameter is written;
/// `None` for those that are 0 or not at `places`.
fn standard<'g>(
    writer: &mut Writer<'_, 'g>,
    found: &BaseParameters<'g>,
    places: &[usize],
) -> Result<(Vec<Equation>, Vec<Option<Written>>), Error> {
    let mut equations = vec![];
    let mut written = vec![];
    let values: Vec<Expr<'g>> = found.standard.iter().map(|(_, value)| *value).collect();
    for (place, value) in base::polynomials(&values, writer.robot)?.iter().enumerate() {
        let Some((parameter, _)) = found.standard.get(place) else { continue };
        if !places.contains(&place) || value.is_zero() {
            written.push(None);
            continue;
        }
        let mut text = parameter.name();
        if let Some(symbol) = symbol_of(value) {
            text = symbol;
        } else {
            writer.define_parameter(&text, base::shape(parameter.quantity, "", parameter.link))?;
            let left = writer.symbols.look(&text);
            equations.push(writer.of_polynomial(text.clone(), left, value)?);
        }
        written.push(Some(Written { math: writer.symbols.look(&text), text }));
    }
    Ok((equations, written))
}

/// The symbol of a base parameter. Its definition is added to `equations`, unless the robot file has this symbol.
fn parameter<'g>(
    writer: &mut Writer<'_, 'g>,
    parameter: &BaseParameter<'g>,
    value: &Polynomial<'g>,
    standard: &[Option<Written>],
    equations: &mut Vec<Equation>,
) -> Result<Expr<'g>, Error> {
    if let Some(name) = symbol_of(value) {
        return Ok(writer.graph.symbol(&name));
    }
    let formulas = Formulas { robot: writer.robot, symbols: &writer.symbols, order: &writer.order };
    let value = formulas.of_polynomial(&writer.with_decimals(value))?;
    // If all terms are symbols of the file, the formula would only repeat the value.
    let is_defined = |(place, _): &(usize, Expr<'g>)| {
        let written = standard.get(*place).and_then(Option::as_ref);
        written.is_some_and(|written| writer.symbols.is_defined(&written.text))
    };
    let formula = match parameter.terms.iter().any(is_defined) {
        true => formulas.of_parameter(parameter, standard)?,
        false => value.clone(),
    };
    if let Some(known) = standard.iter().flatten().find(|known| known.text == formula.text) {
        // The parameters with which it was regrouped are 0.
        return Ok(writer.graph.symbol(&known.text));
    }
    let (mut name, mut look) = (parameter.name(), base::look(parameter));
    if let Some(known) = standard.iter().flatten().find(|known| known.text == name) {
        if is_itself(parameter, known, standard) {
            return Ok(writer.graph.symbol(&name));
        }
        // The moment of a link in another frame has the same name as the parameter in the file's frame.
        let StandardParameter { link, quantity } = parameter.kept;
        name = format!("{}D_{}", quantity.symbol(), link + 1);
        look = base::shape(quantity, "D", link);
    }
    let right = base::chained(&formula, &value);
    writer.define_parameter(&name, look)?;
    let left = writer.symbols.look(&name);
    let symbol = writer.graph.symbol(&name);
    equations.push(Equation { name, text: formula.text, left, right });
    Ok(symbol)
}

/// Whether a base parameter is equal to the standard parameter of the same name.
fn is_itself(parameter: &BaseParameter<'_>, known: &Written, standard: &[Option<Written>]) -> bool {
    let [(place, coefficient)] = parameter.terms.as_slice() else { return false };
    coefficient.is_one() && standard.get(*place).is_some_and(|one| one.as_ref() == Some(known))
}

/// Returns the symbol if a value is only a symbol.
fn symbol_of(value: &Polynomial<'_>) -> Option<String> {
    let value = value.to_expr();
    value.as_symbol().map(|symbol| value.graph().symbol_name(symbol))
}

fn is_friction(quantity: Quantity) -> bool {
    use Quantity::{BackwardFriction, ForwardFriction, Offset, ViscousFriction};
    matches!(quantity, ViscousFriction | ForwardFriction | BackwardFriction | Offset)
}

/// The part of friction that grows with the joint force; it has no parameter as a single factor.
fn load_dependent<'g>(friction: &MechanismFriction<'g>) -> MechanismFriction<'g> {
    let zero = friction.viscous.graph().zero();
    MechanismFriction {
        viscous: zero,
        coulomb_positive: zero,
        coulomb_negative: zero,
        offset: zero,
        ..friction.clone()
    }
}

/// The entries of Y, row by row, without the columns of parameters that are left out.
fn coefficients<'g>(
    writer: &Writer<'_, 'g>,
    columns: &[Expr<'g>],
    parameters: &[Option<Expr<'g>>],
    sums: &mut [Sum<'g>],
) -> Section<'g> {
    let letter = writer.symbols.free_letter(&candidates::REGRESSOR);
    let mut coefficients = vec![];
    for ((row, values), sum) in (1..).zip(columns.chunks(parameters.len().max(1))).zip(sums) {
        let used =
            values.iter().zip(parameters).filter_map(|(value, name)| Some((*value, (*name)?)));
        for (column, (value, parameter)) in (1..).zip(used) {
            if value.is_zero() {
                continue;
            }
            let shape = Math::Row(vec![Math::integer(row), Math::Sign(','), Math::integer(column)]);
            let shape = Math::Letter(letter.chars().next().unwrap_or('Y')).with_lower(shape);
            let name = shapes::indexed_name(letter, &[row, column]);
            sum.push((name.clone(), parameter));
            coefficients.push(Coefficient { name, shape, value });
        }
    }
    Section { title: "Coefficients of the base parameters", by_symbols: false, coefficients }
}

/// The joint torques with the coefficients written out; their other parts have names.
fn inline<'g>(
    writer: &mut Writer<'_, 'g>,
    introduction: String,
    sections: &[Section<'g>],
    shown: &[Vec<Shown<'g>>],
    sums: Vec<Sum<'g>>,
) -> Result<Vec<Group>, Error> {
    let [own, others @ ..] = sections else { return Ok(vec![]) };
    let [own_shown, others_shown @ ..] = shown else { return Ok(vec![]) };
    let zeros = define_all(writer, others, others_shown)?;
    let mut equations = vec![];
    for (index, sum) in sums.into_iter().enumerate() {
        let mut terms = vec![];
        for (name, parameter) in sum.into_iter().filter(|(name, _)| !zeros.contains(name)) {
            let known = own.coefficients.iter().zip(own_shown);
            match known.filter(|(one, _)| one.name == name).map(|(_, value)| value).next() {
                Some(Shown::Zero) => {}
                Some(Shown::Short { terms: own, .. }) => {
                    terms.push(product(writer, parameter, own));
                }
                Some(Shown::Long { .. } | Shown::Earlier) | None => {
                    terms.push(product(writer, writer.graph.symbol(&name), &[unit()]));
                }
            }
        }
        let symbol = joint_torque(index);
        let (name, left) = (symbol.to_string(), Math::quantity(symbol));
        equations.push(writer.of_terms(name, left, &terms)?);
    }
    let mut groups = vec![Group::of_quantities(TITLE, introduction, equations)];
    groups.extend(definitions_of(writer, others, others_shown)?);
    Ok(groups)
}

fn unit<'g>() -> ArrangedTerm<'g> {
    ArrangedTerm { negative: false, coefficient: Number::integer(1), factors: vec![] }
}

/// The product of a symbol and its coefficient; a sum in parentheses does not begin with a minus sign.
fn product<'g>(
    writer: &Writer<'_, 'g>,
    symbol: Expr<'g>,
    coefficient: &[ArrangedTerm<'g>],
) -> ArrangedTerm<'g> {
    let factor = (ArrangedFactor::Atom(symbol), 1);
    if let [single] = coefficient {
        let rank = writer.order.rank(symbol);
        let is_after = |(factor, _): &(ArrangedFactor<'g>, i32)| match factor {
            ArrangedFactor::Atom(atom) => writer.order.rank(*atom) > rank,
            ArrangedFactor::Sum(_) => true,
        };
        let place = single.factors.iter().position(is_after).unwrap_or(single.factors.len());
        let mut product = single.clone();
        product.factors.insert(place, factor);
        return product;
    }
    let mut product = ArrangedTerm::product(coefficient, vec![]);
    product.factors.insert(0, factor);
    product
}

#[cfg(test)]
mod tests {
    use crate::{EquationOptions, Form, equations};

    /// The equations of the planar arm with the friction of one joint.
    fn printed(friction: &str) -> Vec<String> {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/planar_2r.toml");
        let text = std::fs::read_to_string(path).unwrap();
        let joint = r#"joint = { type = "revolute", axis = "z" }"#;
        let text = text.replacen(joint, &format!("{joint}\nfriction = {{ {friction} }}"), 1);
        let text =
            text.replacen("[parameters]", "[parameters]\nf1 = { value = 2, unit = \"N m\" }", 1);
        let robot = robot_model::description::read_toml(path, &text).unwrap().robot;
        let form = Form::Regrouped;
        let options = EquationOptions { form, friction: true, ..EquationOptions::default() };
        let found = equations(&robot, &options).unwrap();
        let all = found.groups.into_iter().flat_map(|group| group.equations);
        all.map(|equation| format!("{} = {}", equation.name, equation.text)).collect()
    }

    /// If lengths cancel each other at their values in the file, no digits are lost.
    #[test]
    fn nominal_values_may_cancel() {
        let text = r#"
            format = 1
            [robot]
            name = "slider"
            gravity = [0, 0, -9.81]
            [parameters]
            m = 1.895
            a = 0.218
            d = 0.1
            x = -0.1
            [[link]]
            name = "arm"
            joint = { type = "revolute" }
            dh = { convention = "standard", a = 0.2, alpha = 0, d = 0.1, theta = 0 }
            mass = 1.5
            center_of_mass = [0.2, 0, 0]
            inertia = { xx = 0.01, yy = 0.02, zz = 0.02 }
            [[link]]
            name = "slide"
            joint = { type = "prismatic" }
            dh = { convention = "standard", a = "d", alpha = "-pi/2", d = "a + d", theta = "-pi/2" }
            mass = "m"
            center_of_mass = ["x", 0, 0]
            inertia = { xx = 0.01, yy = 0.01, zz = 0.01 }"#;
        let robot = robot_model::description::read_toml("slider.toml", text).unwrap().robot;
        let options = EquationOptions { form: Form::Regrouped, ..EquationOptions::default() };
        let found = equations(&robot, &options).unwrap();
        let mut all = found.groups.into_iter().flat_map(|group| group.equations);
        let moment = all.find(|equation| equation.name == "ZZ_2").unwrap();
        assert_eq!(moment.text, "m*d^2 + 2*m*d*x + m*x^2 + 0.01");
    }

    fn assert_contains(equations: &[String], part: &str) {
        assert!(equations.iter().any(|one| one.contains(part)), "{part}: {equations:#?}");
    }

    #[test]
    fn friction_that_is_the_same_in_both_directions_is_one_term() {
        let constant = printed("coulomb_torque = 0.3");
        assert_contains(&constant, "FC_1 = 0.3");
        assert_contains(&constant, " + FC_1*sign(qd1) + ");
        assert!(!constant.iter().any(|one| one.contains("FP_1") || one.contains("FN_1")));
        let named = printed(r#"coulomb_torque = "f1", smoothing = 0.1"#);
        assert_contains(&named, " + f1*tanh(10*qd1) + ");
        assert!(!named.iter().any(|one| one.contains("FC_1")), "{named:#?}");
        let different = printed("coulomb_positive = 0.3, coulomb_negative = 0.4");
        assert_contains(&different, "0.5*FP_1*(1 + sign(qd1))*sign(qd1)");
        assert_contains(&different, "0.5*FN_1*(1 - sign(qd1))*sign(qd1)");
    }
}
