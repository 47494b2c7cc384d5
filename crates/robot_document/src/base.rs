//! The base parameters of a robot: what of its inertias and drives the driving forces tell.

use robot_dynamics::base_parameters::{
    BaseParameter, BaseParameters, Quantity, base_parameters, out_of_reach,
};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_dynamics::model::Robot;
use robot_symbolic::print::latex::Trigonometry;
use robot_symbolic::{AngleSums, Expr, Graph, Polynomial, PolynomialOptions};

use crate::error::Error;
use crate::forms::{Equation, Group};
use crate::latex;
use crate::math::{Fence, Math, Style};
use crate::notation::Notation;
use crate::order::Order;

/// What expansions may cost: more terms than anybody reads.
const LIMITS: PolynomialOptions =
    PolynomialOptions { angle_sums: AngleSums::Expand, max_terms: 20_000, max_products: 1_000_000 };

/// The base parameters of a robot, written.
#[derive(Clone, Debug)]
pub struct BaseSet {
    /// The names of the standard parameters, in the order of the full regressor's columns.
    pub standard: Vec<String>,
    /// The base parameters, in the order of their columns.
    pub list: Vec<BaseEntry>,
    /// Whether figures are rounded, see [`BaseParameters::rounded`].
    pub rounded: bool,
}

/// A base parameter, written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BaseEntry {
    /// The name in text, `ZZR_2`.
    pub name: String,
    /// The name in print.
    pub left: Math,
    /// The column of the full regressor that is this one's.
    pub column: usize,
    /// The formula in standard parameters: those with one figure stand in one term.
    pub formula: Written,
    /// The figure of each standard parameter by its place, as text that reads back.
    pub figures: Vec<(usize, String)>,
    /// The value in the file's parameters.
    pub value: Written,
}

/// A formula in both notations that a reader may want.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Infix text that reads back.
    pub text: String,
    /// What it looks like.
    pub math: Math,
}

/// Finds the base parameters of a robot and writes their formulas; `snap` as in
/// [`EquationOptions::snap`](crate::EquationOptions::snap).
///
/// # Errors
///
/// A robot whose base parameters are out of reach; formulas that are too long to be of use; symbols
/// that would look alike.
pub fn base(robot: &Robot, snap: Option<f64>) -> Result<BaseSet, Error> {
    let graph = Graph::new();
    let options = MechanismOptions::EXACT.with_snap(snap, robot);
    let derivation = Derivation::new(robot, &graph, &options, None);
    let found = found(&derivation)?;
    let notation = Notation::new(robot, Trigonometry::Named)?;
    let formulas = Formulas { notation: &notation, order: &Order::new(robot) };
    let standard: Vec<Written> = found
        .standard
        .iter()
        .map(|(parameter, _)| Written {
            text: parameter.name(),
            math: shape(parameter.quantity, "", parameter.link),
        })
        .collect();
    let mut list = vec![];
    for (parameter, value) in found.base.iter().zip(&polynomials(&found.nominal())?) {
        let figures: Vec<Expr<'_>> = parameter.terms.iter().map(|(_, figure)| *figure).collect();
        let figures = polynomials(&figures)?;
        let places = parameter.terms.iter().map(|(place, _)| *place);
        let texts: Result<Vec<_>, Error> =
            places.zip(&figures).map(|(place, figure)| Ok((place, figure.to_text()?))).collect();
        list.push(BaseEntry {
            name: parameter.name(),
            left: look(parameter),
            column: parameter.column,
            formula: formulas.of_parameter(parameter, &figures, &standard)?,
            figures: texts?,
            value: formulas.of_polynomial(value)?,
        });
    }
    let standard = standard.into_iter().map(|one| one.text).collect();
    Ok(BaseSet { standard, list, rounded: found.rounded })
}

impl BaseSet {
    /// The formulas as displayed equations, each with the value behind the formula.
    #[must_use]
    pub fn group(&self) -> Group {
        Group {
            title: "Base parameters".to_owned(),
            introduction: String::new(),
            definitions: true,
            equations: self.list.iter().map(BaseEntry::equation).collect(),
        }
    }
}

impl BaseEntry {
    /// `ZZR_1 = ZZ_1 + 0.2 M_2 = 0.35`; where nothing is regrouped, `MY_2 = 0.1`, and where both look
    /// alike, as with masses, one of them.
    fn equation(&self) -> Equation {
        let mut right = vec![];
        let is_alike = latex::formula(&self.formula.math) == latex::formula(&self.value.math);
        if self.figures.len() > 1 && !is_alike {
            right.extend_from_slice(self.formula.math.pieces());
            right.push(Math::Sign('='));
        }
        right.extend_from_slice(self.value.math.pieces());
        Equation {
            name: self.name.clone(),
            text: self.value.text.clone(),
            left: self.left.clone(),
            right: Math::row(right),
        }
    }
}

/// The base parameters, or why there are none.
pub(crate) fn found<'g>(derivation: &Derivation<'_, 'g>) -> Result<BaseParameters<'g>, Error> {
    base_parameters(derivation).ok_or_else(|| Error::Base {
        reason: out_of_reach(derivation.robot).unwrap_or_default().to_owned(),
    })
}

/// Figures and values, expanded.
pub(crate) fn polynomials<'g>(values: &[Expr<'g>]) -> Result<Vec<Polynomial<'g>>, Error> {
    Polynomial::of_all(values, &LIMITS).map_err(|error| Error::Base { reason: error.to_string() })
}

/// What the name of a base parameter looks like.
pub(crate) fn look(parameter: &BaseParameter<'_>) -> Math {
    shape(parameter.kept.quantity, parameter.mark(), parameter.kept.link)
}

/// What a name looks like: slanted letters that belong together, the number of the link below.
pub(crate) fn shape(quantity: Quantity, mark: &str, link: usize) -> Math {
    let letters = quantity.symbol().chars().chain(mark.chars());
    let letters = Math::row(letters.map(Math::Letter).collect());
    let base = match letters {
        letter @ Math::Letter(_) => letter,
        word => Math::Styled(Style::Italic, Box::new(word)),
    };
    base.with_lower(Math::integer(link + 1))
}

/// Writes formulas of base parameters.
pub(crate) struct Formulas<'w> {
    pub(crate) notation: &'w Notation,
    pub(crate) order: &'w Order<'w>,
}

impl Formulas<'_> {
    /// A value in the file's parameters.
    pub(crate) fn of_polynomial(&self, value: &Polynomial<'_>) -> Result<Written, Error> {
        let text = value.to_text_by(|atom| self.order.rank(atom))?;
        Ok(Written { text, math: self.notation.polynomial(value, self.order)? })
    }

    /// The formula of a base parameter in standard ones, which are written as `standard` has them: the
    /// kept one comes first, and those with one figure stand together.
    pub(crate) fn of_parameter(
        &self,
        parameter: &BaseParameter<'_>,
        figures: &[Polynomial<'_>],
        standard: &[Written],
    ) -> Result<Written, Error> {
        let mut groups: Vec<(Factor, Vec<&Written>)> = vec![];
        let mut terms: Vec<_> = parameter.terms.iter().zip(figures).collect();
        terms.sort_by_key(|((place, _), _)| *place != parameter.column);
        for ((place, _), figure) in terms {
            let factor = self.factor(figure)?;
            let Some(name) = standard.get(*place) else { continue };
            match groups.iter_mut().find(|(known, _)| *known == factor) {
                Some((_, names)) => names.push(name),
                None => groups.push((factor, vec![name])),
            }
        }
        let (mut text, mut pieces) = (String::new(), vec![]);
        for (place, (factor, names)) in groups.iter().enumerate() {
            let (sign, spaced) = if factor.negative { ('-', " - ") } else { ('+', " + ") };
            if place > 0 || factor.negative {
                text.push_str(if place > 0 { spaced } else { "-" });
                pieces.push(Math::Sign(sign));
            }
            let product = product(factor, names);
            text.push_str(&product.text);
            pieces.extend_from_slice(product.math.pieces());
        }
        Ok(Written { text, math: Math::row(pieces) })
    }

    /// A figure as a factor: nothing for 1, sums in parentheses.
    fn factor(&self, figure: &Polynomial<'_>) -> Result<Factor, Error> {
        let Written { text, math } = self.of_polynomial(figure)?;
        if figure.len() > 1 {
            let pieces = vec![Math::Fenced(Fence::Parentheses, Box::new(math))];
            return Ok(Factor { negative: false, text: format!("({text})"), pieces });
        }
        let (negative, text) = match text.strip_prefix('-') {
            Some(magnitude) => (true, magnitude.to_owned()),
            None => (false, text),
        };
        if text == "1" {
            return Ok(Factor { negative, text: String::new(), pieces: vec![] });
        }
        let pieces = match math.pieces() {
            [Math::Sign('-'), magnitude @ ..] => magnitude.to_vec(),
            all => all.to_vec(),
        };
        Ok(Factor { negative, text, pieces })
    }
}

/// What stands before a standard parameter.
#[derive(PartialEq)]
struct Factor {
    negative: bool,
    /// Empty for 1.
    text: String,
    pieces: Vec<Math>,
}

/// The figure, without its sign, times the sum of the names.
fn product(factor: &Factor, names: &[&Written]) -> Written {
    let text = names.iter().map(|name| name.text.as_str()).collect::<Vec<_>>().join(" + ");
    let mut sum = vec![];
    for name in names {
        if !sum.is_empty() {
            sum.push(Math::Sign('+'));
        }
        sum.extend_from_slice(name.math.pieces());
    }
    let is_one = factor.text.is_empty();
    let mut pieces = factor.pieces.clone();
    // What follows a sine would seem to be in its argument.
    if pieces.iter().any(Math::is_function) {
        pieces.push(Math::Sign('·'));
    }
    let text = if names.len() == 1 || (is_one && !factor.negative) {
        pieces.extend(sum);
        text
    } else {
        pieces.push(Math::Fenced(Fence::Parentheses, Box::new(Math::Row(sum))));
        format!("({text})")
    };
    let text = if is_one { text } else { format!("{}*{text}", factor.text) };
    Written { text, math: Math::row(pieces) }
}
