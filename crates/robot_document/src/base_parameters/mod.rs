//! The base parameters of a robot: the combinations of its inertial parameters that the joint torques determine.

mod coefficients;

use robot_dynamics::base_parameters::{BaseParameter, BaseParameters, Quantity, inseparable};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::robot::Robot;
use robot_model::signs::Font;
use robot_model::snap;
use robot_symbolic::collected::{Collector, length};
use robot_symbolic::print::{ArrangedFactor, ArrangedTerm, arranged_text};
use robot_symbolic::{Expr, Function, Graph, Polynomial, View};

use self::coefficients::{coefficients, too_long};
pub(crate) use self::coefficients::{expanded_values, found, polynomials};
use crate::error::Error;
use crate::forms::{Equation, Group, MAX_NODES};
use crate::latex;
use crate::layout::{BRACKETS, Order, SymbolTable, Trigonometry, has_longer, tidied, tidied_text};
use crate::math::{Fence, Math};

/// The remedy for formulas of base parameters that are too long.
const SHORTER: &str = "their formulas are too long to read, but the function `base_parameters` computes their values; if \
    angles between frames are nearly multiples of π/2, snapping them (the option `snap`) makes the formulas shorter, and \
    if no joint axis depends on parameters, formulas in other frames (`base_frames = \"denavit_hartenberg\"`) can be \
    shorter";

/// The explanation of the names of standard and base parameters.
pub(crate) const NAMES: &str = "XX to ZZ are the entries of a link's inertia tensor about the \
    origin of its frame, in its axes and with their signs, MX, MY, MZ its first moment, M its \
    mass; IA is a drive's reflected inertia (armature), FV, FP, FN its viscous, forward and \
    backward friction, FO its friction offset, IC the coupling of its rotor. The number of the \
    link follows; an R marks a parameter that others are regrouped with.";

/// The base parameters of a robot, as text and formulas.
#[derive(Clone, Debug)]
pub struct BaseSet {
    /// The names of the standard parameters, in the order of the full regressor's columns.
    pub standard: Vec<String>,
    /// The base parameters, in the order of their columns.
    pub list: Vec<BaseEntry>,
    /// Whether coefficients are rounded: because joints share a coordinate (see [`BaseParameters::rounded`]), or because
    /// exact ones would be long expressions in sines and roots of numbers.
    pub rounded: bool,
    /// Base parameters that rows with all joints in motion do not separate, as places in the list (see [`inseparable`]).
    pub inseparable: Vec<Vec<usize>>,
}

/// A base parameter, as text and formulas.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BaseEntry {
    /// The name as text, for example `ZZR_2`.
    pub name: String,
    /// The layout of the name.
    pub left: Math,
    /// The column of the full regressor that belongs to this parameter, if there is one.
    pub column: Option<usize>,
    /// The formula in standard parameters; those with the same coefficient are in one term.
    pub formula: Written,
    /// The places of the standard parameters and their coefficients, as text that can be parsed again.
    pub coefficients: Vec<(usize, String)>,
    /// The value, in terms of the parameters of the robot file.
    pub value: Written,
}

/// A formula as text and as a layout.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Written {
    /// Infix text that can be parsed again.
    pub text: String,
    /// The layout.
    pub math: Math,
}

/// Finds the base parameters of a robot and writes their formulas; for `snap` see
/// [`EquationOptions::snap`](crate::EquationOptions::snap).
///
/// # Errors
///
/// If the base parameters of the robot cannot be computed, if the formulas are too long to be useful, or if two symbols
/// would look the same.
pub fn base(robot: &Robot, snap: Option<f64>) -> Result<BaseSet, Error> {
    snap.map(snap::check).transpose()?;
    let graph = Graph::limited(MAX_NODES);
    let set = written(robot, snap, &graph);
    if graph.is_full() {
        // If the graph is full, the formulas that have been written are meaningless.
        let reason = format!("they need more than {MAX_NODES} expressions; {SHORTER}");
        return Err(Error::Base { reason });
    }
    set
}

fn written(robot: &Robot, snap: Option<f64>, graph: &Graph) -> Result<BaseSet, Error> {
    let options = MechanismOptions::EXACT.with_snap(snap, robot);
    let derivation = Derivation::new(robot, graph, &options, None);
    let found = found(&derivation)?;
    let symbols = SymbolTable::new(robot, Trigonometry::Named)?;
    let formulas = Formulas { robot, symbols: &symbols, order: &Order::new(robot) };
    let values = found.nominal();
    check_names(robot, &symbols, &found, &values)?;
    let standard: Vec<Option<Written>> = found
        .standard
        .iter()
        .map(|(parameter, _)| {
            let math = shape(parameter.quantity, "", parameter.link);
            Some(Written { text: parameter.name(), math })
        })
        .collect();
    let mut list = vec![];
    for (parameter, value) in found.base.iter().zip(&expanded_values(&found, robot)?) {
        let coefficients = coefficients(parameter, robot)?;
        let places = parameter.terms.iter().map(|(place, _)| *place);
        let texts: Result<Vec<_>, Error> = places
            .zip(&coefficients)
            .map(|(place, coefficient)| Ok((place, coefficient.to_text()?)))
            .collect();
        list.push(BaseEntry {
            name: parameter.name(),
            left: look(parameter),
            column: parameter.full_column(),
            formula: formulas.of_parameter(parameter, &standard)?,
            coefficients: texts?,
            value: formulas.of_polynomial(value)?,
        });
    }
    let standard = standard.into_iter().flatten().map(|one| one.text).collect();
    let inseparable = inseparable(&derivation, &found);
    Ok(BaseSet { standard, list, rounded: found.rounded, inseparable })
}

/// Returns an error if a symbol of the robot has the name or the layout of a standard or base parameter without being
/// the value of this parameter. `values` are those of the base parameters.
fn check_names(
    robot: &Robot,
    symbols: &SymbolTable,
    found: &BaseParameters<'_>,
    values: &[Expr<'_>],
) -> Result<(), Error> {
    let standard = found
        .standard
        .iter()
        .map(|(one, value)| (one.name(), shape(one.quantity, "", one.link), *value));
    let base = found.base.iter().zip(values).map(|(one, value)| (one.name(), look(one), *value));
    for (name, shape, value) in standard.chain(base) {
        let printed = symbols.printed_as(&latex::formula(&shape)).map(str::to_owned);
        let named = symbols.has(&name).then(|| name.clone());
        for other in [printed, named].into_iter().flatten() {
            let value = polynomials(&[value], robot)?.first().map(Polynomial::to_expr);
            let symbol =
                value.and_then(|value| Some(value.graph().symbol_name(value.as_symbol()?)));
            if symbol.as_ref() != Some(&other) {
                return Err(Error::TakenParameter { name });
            }
        }
    }
    Ok(())
}

impl BaseSet {
    /// Rounds decimals to at most `digits` significant digits for readers. The second result tells whether any decimal
    /// had more.
    #[must_use]
    pub fn readable(&self, digits: usize) -> (BaseSet, bool) {
        let (mut set, mut is_rounded) = (self.clone(), false);
        for written in set.list.iter_mut().flat_map(|one| [&mut one.formula, &mut one.value]) {
            is_rounded |= has_longer(&written.math, digits);
            written.math = tidied(&written.math, Some(digits));
            written.text = tidied_text(&written.text, Some(digits));
        }
        (set, is_rounded)
    }

    /// The formulas as displayed equations, each followed by its value.
    #[must_use]
    pub fn group(&self) -> Group {
        let equations = self.list.iter().map(BaseEntry::equation).collect();
        let group = Group::of_definitions("Base parameters", equations);
        Group { introduction: NAMES.to_owned(), ..group }
    }
}

impl BaseEntry {
    /// `ZZR_1 = ZZ_1 + 0.2 M_2 = 0.35`, or `MY_2 = 0.1` if nothing is regrouped. If the right side looks like the name,
    /// as for a mass M_3 in the robot file, only the name is written.
    fn equation(&self) -> Equation {
        let formula = if self.coefficients.len() > 1 { &self.formula } else { &self.value };
        let right = chained(formula, &self.value);
        let is_same = latex::formula(&right) == latex::formula(&self.left);
        let right = if is_same { Math::default() } else { right };
        Equation {
            name: self.name.clone(),
            text: self.value.text.clone(),
            left: self.left.clone(),
            right,
        }
    }
}

/// `formula = value`, or only one of them if they look the same, as sums of masses do.
pub(crate) fn chained(formula: &Written, value: &Written) -> Math {
    let mut right = formula.math.pieces().to_vec();
    if latex::formula(&formula.math) != latex::formula(&value.math) {
        right.push(Math::Sign('='));
        right.extend_from_slice(value.math.pieces());
    }
    Math::row(right)
}

/// The layout of the name of a base parameter.
pub(crate) fn look(parameter: &BaseParameter<'_>) -> Math {
    shape(parameter.kept.quantity, parameter.mark(), parameter.kept.link)
}

/// The layout of the name of a parameter: italic letters, with the number of the link as a lower index.
pub(crate) fn shape(quantity: Quantity, mark: &str, link: usize) -> Math {
    word(&[quantity.symbol(), mark].concat(), link)
}

/// The layout of a name of several letters with the number of a link.
pub(crate) fn word(letters: &str, link: usize) -> Math {
    let letters = Math::row(letters.chars().map(Math::Letter).collect());
    let base = match letters {
        letter @ Math::Letter(_) => letter,
        word => Math::Styled(Font::Italic, Box::new(word)),
    };
    base.with_lower(Math::integer(link + 1))
}

/// Writes formulas of base parameters.
pub(crate) struct Formulas<'w> {
    pub(crate) robot: &'w Robot,
    pub(crate) symbols: &'w SymbolTable,
    pub(crate) order: &'w Order<'w>,
}

impl Formulas<'_> {
    /// Writes a value in terms of the parameters of the robot file.
    pub(crate) fn of_polynomial(&self, value: &Polynomial<'_>) -> Result<Written, Error> {
        self.of_terms(&self.terms(value))
    }

    fn of_terms(&self, terms: &[ArrangedTerm<'_>]) -> Result<Written, Error> {
        Ok(Written { text: arranged_text(terms)?, math: self.symbols.terms(terms)? })
    }

    /// The terms of a polynomial, multiplied out. With squares of cosines they are collected if that is shorter:
    /// 1 - cos² β is sin² β.
    fn terms<'g>(&self, value: &Polynomial<'g>) -> Vec<ArrangedTerm<'g>> {
        let rank = |atom: Expr<'g>| self.order.rank(atom);
        let terms = value.arranged(rank);
        let is_square = |(factor, exponent): &(ArrangedFactor<'_>, i32)| {
            let atom = factor.as_atom();
            let is_cosine = |atom: Expr<'_>| matches!(atom.view(), View::Call(Function::Cos, _));
            *exponent > 1 && atom.is_some_and(is_cosine)
        };
        if !terms.iter().any(|term| term.factors.iter().any(is_square)) {
            return terms;
        }
        let collector = Collector { angles: &[], factors: true, double_angles: false };
        let collected = collector.collect(value, rank, &BRACKETS);
        if length(&collected) < length(&terms) { collected } else { terms }
    }

    /// Writes the formula of a base parameter in standard parameters, whose names are given by `standard`; a parameter
    /// with `None` is omitted. The parameter that is kept comes first, and those with the same coefficient are grouped.
    pub(crate) fn of_parameter(
        &self,
        parameter: &BaseParameter<'_>,
        standard: &[Option<Written>],
    ) -> Result<Written, Error> {
        let coefficients = coefficients(parameter, self.robot)?;
        let mut terms: Vec<_> = parameter.terms.iter().zip(coefficients).collect();
        terms.sort_by_key(|((place, _), _)| *place != parameter.column);
        // Different parameters can be the same symbol of the robot file, such as the mass of links that are alike.
        let mut by_name: Vec<(&Written, Polynomial<'_>)> = vec![];
        for ((place, _), coefficient) in terms {
            let Some(Some(name)) = standard.get(*place) else { continue };
            match by_name.iter_mut().find(|(known, _)| known.text == name.text) {
                Some((_, sum)) => *sum = sum.add(&coefficient).map_err(too_long)?,
                None => by_name.push((name, coefficient)),
            }
        }
        by_name.retain(|(_, coefficient)| !coefficient.is_zero());
        let mut groups: Vec<(Term, Vec<&Written>)> = vec![];
        for (name, coefficient) in &by_name {
            let factor = self.factor(coefficient)?;
            match groups.iter_mut().find(|(known, _)| *known == factor) {
                Some((_, names)) => names.push(name),
                None => groups.push((factor, vec![name])),
            }
        }
        let terms: Vec<Term> =
            groups.iter().map(|(factor, names)| product(factor, names)).collect();
        Ok(sum(&terms))
    }

    /// Writes a coefficient as a factor: a coefficient 1 is empty, and sums are in parentheses.
    fn factor(&self, coefficient: &Polynomial<'_>) -> Result<Term, Error> {
        let terms = self.terms(coefficient);
        let written = self.of_terms(&terms)?;
        if terms.len() > 1 {
            let math = Math::Fenced(Fence::Parentheses, Box::new(written.math));
            let written = Written { text: format!("({})", written.text), math };
            return Ok(Term { negative: false, written });
        }
        let factor = Term::of(written);
        match factor.written.text.as_str() {
            "1" => Ok(Term { written: Written::default(), ..factor }),
            _ => Ok(factor),
        }
    }
}

/// A term of a sum, or a factor of a term, without its sign. A factor 1 is empty.
#[derive(PartialEq)]
pub(crate) struct Term {
    pub(crate) negative: bool,
    pub(crate) written: Written,
}

impl Term {
    /// Separates the sign from a term; for a sum, the first sign is separated and stands for the whole.
    pub(crate) fn of(written: Written) -> Term {
        let text = written.text.strip_prefix('-').map(str::to_owned);
        let math = match written.math.pieces() {
            [Math::Sign('-'), magnitude @ ..] => Math::row(magnitude.to_vec()),
            _ => written.math.clone(),
        };
        let negative = text.is_some();
        Term { negative, written: Written { text: text.unwrap_or(written.text), math } }
    }
}

/// The sum of the terms, which is 0 if there are none.
pub(crate) fn sum(terms: &[Term]) -> Written {
    if terms.is_empty() {
        return Written { text: "0".to_owned(), math: Math::integer(0) };
    }
    let (mut text, mut pieces) = (String::new(), vec![]);
    for (place, Term { negative, written }) in terms.iter().enumerate() {
        let (sign, spaced) = if *negative { ('-', " - ") } else { ('+', " + ") };
        if place > 0 || *negative {
            text.push_str(if place > 0 { spaced } else { "-" });
            pieces.push(Math::Sign(sign));
        }
        text.push_str(&written.text);
        pieces.extend_from_slice(written.math.pieces());
    }
    Written { text, math: Math::row(pieces) }
}

/// The product of a coefficient and the sum of the names.
fn product(factor: &Term, names: &[&Written]) -> Term {
    let text = names.iter().map(|name| name.text.as_str()).collect::<Vec<_>>().join(" + ");
    let mut sum = vec![];
    for name in names {
        if !sum.is_empty() {
            sum.push(Math::Sign('+'));
        }
        sum.extend_from_slice(name.math.pieces());
    }
    let Term { negative, written } = factor;
    let is_one = written.text.is_empty();
    let mut pieces = written.math.pieces().to_vec();
    // Without the dot, a factor after a sine would look like a part of its argument.
    if pieces.iter().any(Math::is_function) {
        pieces.push(Math::Sign('·'));
    }
    let text = if names.len() == 1 || (is_one && !negative) {
        pieces.extend(sum);
        text
    } else {
        pieces.push(Math::Fenced(Fence::Parentheses, Box::new(Math::Row(sum))));
        format!("({text})")
    };
    let text = if is_one { text } else { format!("{}*{text}", written.text) };
    Term { negative: *negative, written: Written { text, math: Math::row(pieces) } }
}

#[cfg(test)]
mod tests {
    use robot_model::description::read_toml;

    use super::*;
    use crate::{EquationOptions, Form, equations};
    use robot_dynamics::base_parameters::base_parameters;

    /// Two links with skew axes; the first is turned and displaced by `origin`.
    fn skew(origin: &str) -> Robot {
        let rest = "mass = 1\ncenter_of_mass = [0.1, 0.2, 0.3]\ninertia = { xx = 0.05, yy = 0.055, zz = 0.045 }\n";
        let link = |name: &str, axis: &str, origin: &str| {
            format!(
                "[[link]]\nname = \"{name}\"\njoint = {{ type = \"revolute\", axis = {axis} }}\n{origin}\n{rest}"
            )
        };
        let second = link(
            "b",
            "[0.3, -0.2, 0.7]",
            "origin = { xyz = [0.3, 0.1, 0.2], rpy = [1.1, 0.4, 0.2] }",
        );
        let first = link("a", "[1, 2, 3]", origin);
        let text = format!("format = 1\n[robot]\nname = \"skew\"\n{first}{second}");
        read_toml("skew.toml", &text).unwrap().robot
    }

    /// The mass m of two links is one symbol, and 1 - cos² β is sin² β.
    #[test]
    fn equal_symbols_are_added_and_squares_are_short() {
        let inertia =
            "center_of_mass = [\"0.5*l\", 0, 0]\ninertia = { zz = 0.1, yy = 0.1, xx = 0.1 }\n";
        let link = |name: &str, joint: &str, mass: &str| {
            format!("[[link]]\nname = \"{name}\"\n{joint}\nmass = \"{mass}\"\n{inertia}")
        };
        let revolute = "joint = { type = \"revolute\", axis = \"z\" }";
        let along = format!("{revolute}\norigin = {{ xyz = [\"l\", 0, 0] }}");
        let oblique = format!("{revolute}\norigin = {{ rpy = [\"beta\", 0, 0] }}");
        let robot = |links: &[String]| {
            let text = format!(
                "format = 1\n[robot]\nname = \"two\"\n[parameters]\nl = 0.5\nm = 1\n\
                 beta = {{ value = 0.4, unit = \"rad\" }}\n{}",
                links.concat()
            );
            read_toml("two.toml", &text).unwrap().robot
        };
        let twins = [("1", revolute), ("2", &along), ("3", &along)];
        let options = EquationOptions { form: Form::Regrouped, ..EquationOptions::default() };
        let twins = robot(&twins.map(|(name, joint)| link(name, joint, "m")));
        let found = equations(&twins, &options).unwrap();
        let texts: Vec<&str> = found.definitions().map(|one| one.text.as_str()).collect();
        assert!(texts.contains(&"ZZ_1 + 2*l^2*m"), "{texts:?}");
        let skew = robot(&[link("1", revolute, "m"), link("2", &oblique, "m")]);
        let set = base(&skew, None).unwrap();
        let first = set.list.iter().find(|entry| entry.name == "ZZR_1").unwrap();
        assert_eq!(first.formula.text, "ZZ_1 + sin(beta)^2*YY_2");
    }

    /// Exact coefficients are quotients of thousands of terms here, most of which cancel.
    #[test]
    fn coefficients_of_skew_axes_are_numbers() {
        let robot = skew("origin = { xyz = [0, 0, 1], rpy = [0.1, 0.2, 0.3] }");
        let set = base(&robot, None).unwrap();
        assert!(set.rounded);
        let first = set.list.iter().find(|entry| entry.name == "MXR_1").unwrap();
        assert!(first.formula.text.starts_with("MX_1 - 1/3*MZ_1 "), "{}", first.formula.text);
        // The values are those of the exact coefficients.
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::EXACT, None);
        let exact = base_parameters(&derivation).unwrap().nominal();
        for (entry, exact) in set.list.iter().zip(exact) {
            let value = graph.parse(&entry.value.text).unwrap().evaluate(|_| f64::NAN);
            let exact = exact.evaluate(|_| f64::NAN);
            assert!((value - exact).abs() < 1e-12, "{}: {value}, {exact}", entry.name);
        }
    }

    /// Coefficients are long quotients in the length here, whose value does not depend on it. Multiplied out with
    /// rounded numbers, they would be noise.
    #[test]
    fn coefficients_that_do_not_depend_on_a_parameter_are_numbers() {
        let rest = "mass = 1\ncenter_of_mass = [1, 0, 0]\ninertia = { xx = 1, yy = 1, zz = 1 }\n";
        let text = format!(
            "format = 1\n[robot]\nname = \"rob\"\nbase_frames = \"denavit_hartenberg\"\n[parameters]\nb = 0.13\n\
             [[link]]\nname = \"1\"\njoint = {{ type = \"revolute\", axis = [0, 3, 4] }}\n{rest}\
             [[link]]\nname = \"2\"\njoint = {{ type = \"prismatic\", axis = [1, 1, 0] }}\n\
             origin = {{ xyz = [0.23, \"b\", 0] }}\n{rest}"
        );
        let robot = read_toml("rob.toml", &text).unwrap().robot;
        let set = base(&robot, None).unwrap();
        assert!(set.rounded);
        let value = |name: &str| {
            let entry = set.list.iter().find(|entry| entry.name == name).unwrap();
            robot_symbolic::Formula::parse(&entry.value.text).unwrap().evaluate(|_| f64::NAN)
        };
        assert!((value("MX_2") + 2.0_f64.sqrt()).abs() < 1e-9, "{}", value("MX_2"));
        assert!((value("MY_2") + 4.0 / 3.0).abs() < 1e-9, "{}", value("MY_2"));
    }
}
