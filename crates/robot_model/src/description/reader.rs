//! The state that all parts of a reader share: the diagnostics, and the parameters that expressions may contain.

use std::collections::{BTreeMap, BTreeSet};

use robot_symbolic::{Formula, Graph, Id, Number, Rational, nearest_word, walk};

use super::defined::{LARGE_ANGLE, undefined};
use super::locations::AngleLocation;
use super::names::{self, Registry, is_coordinate};
use super::options::Options;
use crate::diagnostic::{Diagnostic, Severity, Span, code, quote};
use crate::unit::Unit;

/// The number of errors after which no corrections of misspelled words are suggested. At most this many unknown names
/// are reported for one formula.
const ENOUGH: usize = 40;

/// A parameter that expressions may contain.
pub(super) struct Known {
    pub(super) name: String,
    pub(super) span: Span,
    pub(super) value: Option<Rational>,
    pub(super) unit: Option<Unit>,
    pub(super) used: bool,
}

/// A name with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Named {
    pub(super) name: String,
    pub(super) span: Span,
}

/// The state of reading one file.
pub(super) struct Reader<'a> {
    pub(super) text: &'a str,
    pub(super) options: &'a Options,
    pub(super) found: Vec<Diagnostic>,
    /// The angles in the file.
    pub(super) angles: Vec<AngleLocation>,
    /// Descriptions of content that affects the dynamics but is not part of the robot.
    pub(super) left_out: Vec<String>,
    parameters: Vec<Known>,
    by_name: BTreeMap<String, usize>,
    /// The names of parameters and wrench components, which equations and code use.
    pub(super) symbols: Registry,
}

impl<'a> Reader<'a> {
    pub(super) fn new(text: &'a str, options: &'a Options) -> Reader<'a> {
        Reader {
            text,
            options,
            found: Vec::new(),
            angles: Vec::new(),
            left_out: Vec::new(),
            parameters: Vec::new(),
            by_name: BTreeMap::new(),
            symbols: Registry::new("symbol"),
        }
    }

    /// Defines a parameter for the expressions that follow.
    pub(super) fn define(&mut self, parameter: Known) {
        let index = self.parameters.len();
        self.by_name.entry(parameter.name.clone()).or_insert(index);
        self.parameters.push(parameter);
    }

    /// The parameter with the given name.
    pub(super) fn parameter(&self, name: &str) -> Option<&Known> {
        self.parameters.get(*self.by_name.get(name)?)
    }

    /// The parameters in the order of the file.
    pub(super) fn parameters(&self) -> &[Known] {
        &self.parameters
    }

    /// The candidate that a misspelled word most likely means. `None` if there are already so many errors that a
    /// suggestion would hardly be read.
    pub(super) fn nearest<'n>(
        &self,
        word: &str,
        candidates: impl Iterator<Item = &'n str>,
    ) -> Option<&'n str> {
        if self.found.len() > ENOUGH {
            return None;
        }
        nearest_word(word, candidates)
    }

    /// Whether an error has been reported.
    pub(super) fn failed(&self) -> bool {
        self.found.iter().any(|found| found.severity == Severity::Error)
    }

    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        self.found.push(diagnostic);
    }

    /// A placeholder for an invalid value; it passes all further checks.
    pub(super) fn unknown() -> Formula {
        Formula::symbol("_")
    }

    /// The value of a formula. `None` if it contains a name without a nominal value.
    pub(super) fn known(&self, formula: &Formula) -> Option<f64> {
        let nominal = |name: &str| self.parameter(name).and_then(|known| known.value.as_ref());
        if !formula.symbols().all(|(name, _)| nominal(name).is_some()) {
            return None;
        }
        let value = formula.evaluate(|name| nominal(name).map_or(f64::NAN, Rational::to_f64));
        if !value.is_finite() || !formula.text().contains(['+', '-']) {
            return Some(value);
        }
        // Terms that cancel leave what equations have, not a rounding error: 0.3 - 0.1 - 0.2 is 0.
        let graph = Graph::new();
        let exact = formula.lower(&graph, &mut |name| match nominal(name) {
            Some(value) => graph.number(Number::Rational(value.clone())),
            None => graph.zero(),
        });
        Some(exact.as_number().map_or(value, |exact| exact.to_f64()))
    }

    /// Whether a formula is the number 0, independently of the parameters.
    pub(super) fn is_zero(formula: &Formula) -> bool {
        matches!(formula.as_number(), Some(Number::Rational(value)) if value.is_zero())
    }

    /// Marks the parameters in a formula as used and reports unknown names. `place` maps a range of bytes of the
    /// formula's text to its place in the file. Returns whether all names are known.
    pub(super) fn resolve(&mut self, formula: &Formula, place: &dyn Fn(Span) -> Span) -> bool {
        let mut unknown = BTreeSet::new();
        for (name, span) in formula.symbols() {
            if let Some(index) = self.by_name.get(name) {
                if let Some(known) = self.parameters.get_mut(*index) {
                    known.used = true;
                }
            } else if unknown.insert(name) && unknown.len() <= ENOUGH {
                let diagnostic = self.unknown_symbol(name, &place(span));
                self.found.push(diagnostic);
            }
        }
        unknown.is_empty()
    }

    fn unknown_symbol(&self, name: &str, span: &Span) -> Diagnostic {
        let diagnostic = Diagnostic::error(
            code::UNKNOWN_SYMBOL,
            format!("`{}` is not a parameter of this robot", quote(name)),
        );
        if is_coordinate(name) {
            return diagnostic
                .at(span, "a joint variable")
                .because("the values in a robot file do not depend on the robot's motion")
                .help("describe anything that moves as a joint");
        }
        let names = self.parameters.iter().map(|known| known.name.as_str());
        match self.nearest(name, names) {
            Some(near) => {
                let known = self.parameter(near);
                let diagnostic = diagnostic.at(span, format!("did you mean `{near}`?"));
                match known {
                    Some(known) => diagnostic.and_at(&known.span, "defined here"),
                    None => diagnostic,
                }
            }
            None => diagnostic.at(span, "not in [parameters]"),
        }
        .help(match names::reserved(name) {
            Some(owner) => format!(
                "names in an expression are parameters, and no parameter can be called `{}` ({owner}): add one of \
                 another name to [parameters]",
                quote(name)
            ),
            None if matches!(name, "deg" | "degree" | "degrees") => {
                "write an angle of 30 degrees as `30*pi/180`".to_owned()
            }
            None if matches!(name, "rad" | "radian" | "radians") => {
                "angles are in radians: write the number alone".to_owned()
            }
            None => format!(
                "names in an expression are parameters: add `{}` to [parameters], or write `pi` or a \
                 function such as `sin(…)`",
                quote(name)
            ),
        })
    }

    /// Reports a formula whose value is not finite or not known; returns whether it is finite.
    pub(super) fn finite(&mut self, formula: &Formula, span: &Span) -> bool {
        let known = self.known(formula);
        let undefined = self.undefined(formula);
        let unbounded = without_value(formula);
        if undefined.is_none() && unbounded.is_none() && known.is_none_or(f64::is_finite) {
            return true;
        }
        let reason = match known {
            Some(value) if value.is_infinite() => "this is infinite",
            _ => undefined.or(unbounded).unwrap_or("this is not a number"),
        };
        let is_lost = reason == LARGE_ANGLE;
        let values = match unbounded {
            _ if formula.is_constant() => "",
            Some(_) => " for any values of the parameters",
            None => " at the nominal values of the parameters",
        };
        let message = match is_lost {
            true => format!("the value of the expression is not known{values}"),
            false => format!("the expression does not have a finite value{values}"),
        };
        let help = match is_lost {
            true => "write the angle without its multiples of 2π",
            false => {
                "look for a division by zero, the tangent of a right angle, the square root of a negative number, or \
                 an overflow"
            }
        };
        self.report(Diagnostic::error(code::NUMBER, message).at(span, reason).help(help));
        false
    }
}

/// The reason why a formula does not have a finite value for any values of its parameters, as `1/(x - x)`; `None` if it
/// may have one.
fn without_value(formula: &Formula) -> Option<&'static str> {
    if formula.is_constant() {
        return None;
    }
    let part = "division by 0, the square root of a negative number, or an overflow";
    undefined(formula).or_else(|| (!is_finite(formula)).then_some(part))
}

/// Whether every constant part of the formula is a finite number. In `1/(x - x)`, for example, the quotient is not.
#[must_use]
pub fn is_finite(formula: &Formula) -> bool {
    let graph = Graph::new();
    let expr = formula.lower(&graph, &mut |name| graph.symbol(name));
    let parts = walk::reachable(&[expr]);
    let values = walk::evaluate(&parts, |_| 1.0);
    // Operands precede the expressions that contain them.
    let mut constants: BTreeSet<Id> = BTreeSet::new();
    for (part, value) in parts.iter().zip(values) {
        let is_constant = part.as_symbol().is_none()
            && part.operands().iter().all(|operand| constants.contains(&operand.id()));
        if is_constant && !value.is_finite() {
            return false;
        }
        constants.extend(is_constant.then(|| part.id()));
    }
    true
}
