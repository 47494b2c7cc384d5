//! Evidence against a printed term or for a derived one. It does not depend on the derivation.

use std::collections::BTreeMap;
use std::collections::HashMap;
use std::fmt;

use robot_dynamics::quantity::Kind;
use robot_model::unit::Dimension;
use robot_symbolic::Number;

use super::term::{Key, Term};

/// Independent evidence about a difference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Evidence {
    /// The dimension of the printed term differs from that of its equation.
    Dimension {
        /// The dimension of the printed term.
        printed: Dimension,
        /// The dimension of the equation.
        expected: Dimension,
    },
    /// The derived term occurs unchanged in other printed equations.
    SameTerm(Vec<String>),
    /// The derived term occurs in other printed equations, except for one factor.
    RelatedTerm {
        /// The factor by which it differs.
        factor: String,
        /// The equations.
        equations: Vec<String>,
    },
    /// The printed term contains a symbol that the robot does not have.
    UnknownSymbol(String),
    /// The printed term contains the name of a quantity of the robot, such as `F_l5.x`, which is not a symbol.
    OtherQuantity(String),
    /// The printed term is one of friction, which the derived equations do not contain.
    Friction,
}

/// The text of the evidence, such as `has units kg m s^-1, but a force has kg m s^-2: a time derivative is missing`.
impl fmt::Display for Evidence {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Evidence::Dimension { printed, expected } => {
                let what = match *expected {
                    Dimension::ACCELERATION => "an acceleration",
                    Dimension::FORCE => "a force",
                    Dimension::MOMENT => "a torque",
                    _ => "its equation",
                };
                write!(formatter, "has units {printed}, but {what} has {expected}")?;
                let same = (printed.mass, printed.length) == (expected.mass, expected.length);
                match i16::from(expected.time) - i16::from(printed.time) {
                    -1 if same => write!(formatter, ": a time derivative is missing"),
                    1 if same => write!(formatter, ": one time derivative too many"),
                    time if same && time < 0 => write!(
                        formatter,
                        ": {} time derivatives are \
                        missing",
                        -time
                    ),
                    time if same => write!(formatter, ": {time} time derivatives too many"),
                    _ => Ok(()),
                }
            }
            Evidence::SameTerm(equations) => {
                write!(formatter, "the derived term appears in {}", equations.join(", "))
            }
            Evidence::RelatedTerm { factor, equations } => write!(
                formatter,
                "the derived term appears, except for the factor {factor}, in {}",
                equations.join(", ")
            ),
            Evidence::OtherQuantity(symbol) => {
                write!(formatter, "{symbol} is another quantity and not a symbol of the robot")
            }
            Evidence::UnknownSymbol(symbol) => {
                write!(formatter, "the robot does not have the symbol {symbol}")
            }
            Evidence::Friction => {
                write!(formatter, "friction is not compared: leave its terms out")
            }
        }
    }
}

/// Whether a name is that of a quantity, such as `Q1` or `F_l5.x`.
pub(super) fn is_quantity(name: &str) -> bool {
    let number = |kind: Kind| name.strip_prefix(kind.name());
    let mut numbers = Kind::ALL.into_iter().filter_map(number);
    numbers.any(|number| number.starts_with(|first: char| first.is_ascii_digit()))
}

/// The place at which a product of factors is printed: the index of the equation, and the coefficient.
type Place = (usize, Number);

/// The terms of all printed equations, for lookup.
#[derive(Default)]
pub(super) struct PrintedTerms {
    /// The names of the equations, such as `(31) F_l5.x`.
    names: Vec<String>,
    whole: HashMap<Key, Vec<Place>>,
    /// The products without one of their factors, with the text of this factor.
    without: HashMap<Key, Vec<(Place, String)>>,
}

impl PrintedTerms {
    /// Adds the terms of an equation.
    pub(super) fn insert(&mut self, name: String, terms: &[Term<'_>]) {
        let equation = self.names.len();
        self.names.push(name);
        for term in terms {
            let place = || (equation, term.coefficient.clone());
            self.whole.entry(term.key()).or_default().push(place());
            for (key, factor) in term.without_factor() {
                self.without.entry(key).or_default().push((place(), factor));
            }
        }
    }

    /// The other printed equations that contain a term, either unchanged or except for one factor.
    pub(super) fn support(&self, term: &Term<'_>, own: &str) -> Option<Evidence> {
        let name = |equation: usize| self.names.get(equation).filter(|name| *name != own);
        let mut same: Vec<&String> = vec![];
        for (equation, coefficient) in self.whole.get(&term.key()).into_iter().flatten() {
            if let Some(name) = name(*equation).filter(|_| *coefficient == term.coefficient)
                && same.last() != Some(&name)
            {
                same.push(name);
            }
        }
        if !same.is_empty() {
            return Some(Evidence::SameTerm(same.into_iter().cloned().collect()));
        }
        let sign = |coefficient: &Number| match coefficient {
            same if *same == term.coefficient => Some(""),
            other if *other == -&term.coefficient => Some("-"),
            _ => None,
        };
        let longer = self.without.get(&term.key()).into_iter().flatten();
        let mut found: Vec<(usize, String)> = longer
            .filter_map(|((equation, number), factor)| {
                Some((*equation, format!("{}{factor}", sign(number)?)))
            })
            .collect();
        for (key, factor) in term.without_factor() {
            let shorter = self.whole.get(&key).into_iter().flatten();
            found.extend(shorter.filter_map(|(equation, number)| {
                Some((*equation, format!("{}{factor}", sign(number)?)))
            }));
        }
        found.sort();
        let mut related: BTreeMap<String, Vec<String>> = BTreeMap::new();
        let mut last = None;
        for (equation, factor) in found {
            if let Some(name) = name(equation).filter(|_| last != Some(equation)) {
                related.entry(factor).or_default().push(name.clone());
                last = Some(equation);
            }
        }
        let most = related.into_iter().max_by_key(|(_, equations)| equations.len());
        most.map(|(factor, equations)| Evidence::RelatedTerm { factor, equations })
    }
}
