//! Errata: published equations against derived ones, term by term.
//!
//! Terms have no order and like terms may be printed apart, so equations are compared as sets of
//! canonical terms. What differs is paired, a printed term with the derived term that it most
//! resembles, and comes with evidence that does not lean on the derivation: the dimension of the
//! printed term, and the other printed equations in which the derived term stands.

mod dimension;
mod printed;
mod term;

use std::collections::BTreeMap;

use robot_symbolic::{Graph, PolynomialError};

use crate::mechanism::{Mechanism, MechanismOptions};
use crate::model::Robot;
use crate::newton_euler::{self, Effects};
use crate::quantity::Kind;
use crate::unit::Dimension;
use dimension::Dimensions;
pub use printed::{PrintedEquation, PrintedError, PrintedTerm, read_printed};
use term::{Term, terms_of};

/// A difference between print and derivation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The equation's number in print.
    pub number: String,
    /// The quantity: `M_l4.z`.
    pub quantity: String,
    /// The line of the file of printed equations.
    pub line: usize,
    /// The printed term, canonical; `None` where a derived term is not in print.
    pub printed: Option<String>,
    /// The derived term, canonical; `None` where a printed term has no counterpart.
    pub derived: Option<String>,
    /// What speaks against the printed term or for the derived one, without the derivation.
    pub evidence: Vec<Evidence>,
}

/// Independent evidence about a difference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Evidence {
    /// The printed term has a dimension other than its equation's.
    Dimension {
        /// The printed term's.
        printed: Dimension,
        /// The equation's.
        expected: Dimension,
    },
    /// The derived term stands in other printed equations, as it is.
    SameTerm(Vec<String>),
    /// The derived term stands in other printed equations, but for one factor.
    RelatedTerm {
        /// The factor by which it differs.
        factor: String,
        /// The equations.
        equations: Vec<String>,
    },
    /// The printed term holds a symbol that the robot does not have.
    UnknownSymbol(String),
}

/// What a comparison found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comparison {
    /// How many equations were compared.
    pub equations: usize,
    /// How many terms they have in print, brackets opened; equations that only name another
    /// quantity have none.
    pub terms: usize,
    /// Where they differ, in the order of the print.
    pub differences: Vec<Difference>,
}

/// Why equations cannot be compared.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ErrataError {
    /// The robot has no such quantity.
    #[error("line {line}: the robot has no quantity `{quantity}`; it has a_c1.x … Q{last}")]
    UnknownQuantity {
        /// The line of the file.
        line: usize,
        /// What was asked for.
        quantity: String,
        /// The number of the robot's last coordinate.
        last: usize,
    },
    /// An equation expands to more terms than can be held.
    #[error(transparent)]
    TooLarge(#[from] PolynomialError),
}

/// Compares printed equations with the paper's iterations for a robot, wrenches included and
/// friction left out.
///
/// # Errors
///
/// A quantity that the robot does not have, or an equation that is too large to expand.
pub fn compare(robot: &Robot, printed: &[PrintedEquation]) -> Result<Comparison, ErrataError> {
    let graph = Graph::new();
    let mechanism = Mechanism::new(robot, &graph, &MechanismOptions::EXACT);
    let effects = Effects { wrench: true, friction: false };
    let solution = newton_euler::newton_euler(&mechanism, effects);
    let quantities: BTreeMap<String, _> = Kind::ALL
        .iter()
        .flat_map(|kind| solution.quantities(*kind))
        .map(|quantity| (quantity.symbol.to_string(), quantity))
        .collect();
    let dimensions = Dimensions::of(robot);
    let mut compared: Vec<Compared<'_, '_>> = vec![];
    for equation in printed {
        let Some(quantity) = quantities.get(&equation.quantity) else {
            return Err(ErrataError::UnknownQuantity {
                line: equation.line,
                quantity: equation.quantity.clone(),
                last: robot.degrees_of_freedom(),
            });
        };
        // A right-hand side that is another quantity by name stands for that quantity.
        let alone = (equation.terms.len() == 1).then(|| equation.terms[0].formula.text());
        let named = alone.and_then(|name| quantities.get(name.trim()));
        let mut print = vec![];
        for term in &equation.terms {
            let symbols = &mut |name: &str| graph.symbol(name);
            let value = named.map_or_else(|| term.formula.lower(&graph, symbols), |q| q.value);
            print.extend(terms_of(value)?);
        }
        compared.push(Compared {
            equation,
            dimension: quantity.dimension,
            print,
            derived: terms_of(quantity.value)?,
            is_name: named.is_some(),
        });
    }
    let differences =
        compared.iter().flat_map(|one| one.differences(&compared, &dimensions)).collect();
    Ok(Comparison {
        equations: printed.len(),
        terms: compared.iter().filter(|one| !one.is_name).map(|one| one.print.len()).sum(),
        differences,
    })
}

struct Compared<'p, 'g> {
    equation: &'p PrintedEquation,
    dimension: Dimension,
    print: Vec<Term<'g>>,
    derived: Vec<Term<'g>>,
    /// Whether the print only names another quantity: its terms are then none of the print.
    is_name: bool,
}

impl<'g> Compared<'_, 'g> {
    fn differences(&self, all: &[Compared<'_, 'g>], dimensions: &Dimensions) -> Vec<Difference> {
        let (mut wrong, mut missing) = term::leftover(&self.print, &self.derived);
        let mut differences = vec![];
        for (printed, derived) in term::pair(&mut wrong, &mut missing) {
            differences.push(self.difference(printed.as_ref(), derived.as_ref(), all, dimensions));
        }
        differences
    }

    fn difference(
        &self,
        printed: Option<&Term<'g>>,
        derived: Option<&Term<'g>>,
        all: &[Compared<'_, 'g>],
        dimensions: &Dimensions,
    ) -> Difference {
        let mut evidence = vec![];
        if let Some(term) = printed {
            match dimensions.of_term(term) {
                Ok(dimension) if dimension != self.dimension => evidence
                    .push(Evidence::Dimension { printed: dimension, expected: self.dimension }),
                Ok(_) => {}
                Err(symbol) => evidence.push(Evidence::UnknownSymbol(symbol)),
            }
        }
        if let Some(term) = derived {
            evidence.extend(self.support(term, all));
        }
        Difference {
            number: self.equation.number.clone(),
            quantity: self.equation.quantity.clone(),
            line: self.equation.line,
            printed: printed.map(Term::to_string),
            derived: derived.map(Term::to_string),
            evidence,
        }
    }

    /// The other printed equations that hold a term, as it is or but for one factor.
    fn support(&self, term: &Term<'g>, all: &[Compared<'_, 'g>]) -> Option<Evidence> {
        let printed = |other: &&Compared<'_, 'g>| !other.is_name && !std::ptr::eq(*other, self);
        let others = || all.iter().filter(printed);
        let name = |other: &Compared<'_, 'g>| {
            let Compared { equation, .. } = other;
            match equation.number.as_str() {
                "" => equation.quantity.clone(),
                number => format!("({number}) {}", equation.quantity),
            }
        };
        let same: Vec<String> =
            others().filter(|other| other.print.contains(term)).map(name).collect();
        if !same.is_empty() {
            return Some(Evidence::SameTerm(same));
        }
        let mut related: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for other in others() {
            let factor = other.print.iter().find_map(|printed| printed.differs_by_factor(term));
            if let Some(factor) = factor {
                related.entry(factor).or_default().push(name(other));
            }
        }
        let most = related.into_iter().max_by_key(|(_, equations)| equations.len());
        most.map(|(factor, equations)| Evidence::RelatedTerm { factor, equations })
    }
}

impl std::fmt::Display for Evidence {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Evidence::Dimension { printed, expected } => {
                write!(formatter, "the printed term has the dimension {printed}, not {expected}")?;
                let (dots, power) = (expected.time - printed.time, expected.time < printed.time);
                match (printed.mass == expected.mass && printed.length == expected.length, power) {
                    (true, true) => write!(formatter, ": a dot is missing"),
                    (true, false) if dots > 0 => write!(formatter, ": a dot too many"),
                    _ => Ok(()),
                }
            }
            Evidence::SameTerm(equations) => {
                write!(formatter, "the derived term stands in {}", equations.join(", "))
            }
            Evidence::RelatedTerm { factor, equations } => write!(
                formatter,
                "the derived term stands, but for the factor {factor}, in {}",
                equations.join(", ")
            ),
            Evidence::UnknownSymbol(symbol) => {
                write!(formatter, "the robot has no symbol {symbol}")
            }
        }
    }
}
