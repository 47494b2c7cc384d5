//! Equations in the order and the form of the paper "The dynamic model of TRTTR1 modular serial robot".

mod iterations;
mod relations;
mod sums;

use robot_dynamics::quantity::{Kind, Quantity, Symbol};
use robot_model::robot::JointKind;
use robot_symbolic::print::{ArrangedFactor, ArrangedTerm, arranged_value};
use robot_symbolic::{Number, Polynomial, PolynomialError};

use super::Writer;
use super::expanded::LIMITS;
use iterations::{Column, Iterations, Reader};
use sums::Sum;

pub use relations::Relation;
pub(super) use relations::relations;
pub(crate) use relations::vectors;

impl<'g> Writer<'_, 'g> {
    /// The terms of quantities in the order in which the paper's relations yield them, with masses in front of
    /// parentheses; `None` for a quantity that these relations do not yield, such as a joint torque with friction.
    pub(super) fn in_paper_order(
        &self,
        quantities: &[Quantity<'g>],
        polynomials: &[Polynomial<'g>],
    ) -> Vec<Option<Vec<ArrangedTerm<'g>>>> {
        let found = self.paper_sums(quantities).unwrap_or_default();
        let proved = |(terms, polynomial): (Vec<ArrangedTerm<'g>>, &Polynomial<'g>)| {
            self.is_value(&terms, polynomial).then_some(terms)
        };
        let mut all: Vec<_> = found.into_iter().zip(polynomials).map(proved).collect();
        all.resize(quantities.len(), None);
        all
    }

    /// Whether terms add up to a polynomial.
    pub(super) fn is_value(&self, terms: &[ArrangedTerm<'g>], polynomial: &Polynomial<'g>) -> bool {
        let value = Polynomial::of(arranged_value(terms, self.graph), &LIMITS);
        value.is_ok_and(|value| value == *polynomial)
    }

    fn paper_sums(
        &self,
        quantities: &[Quantity<'g>],
    ) -> Result<Vec<Vec<ArrangedTerm<'g>>>, PolynomialError> {
        let derivation = self.derivation();
        let mechanism = &derivation.mechanism;
        let reader = Reader(&self.order);
        let iterations = Iterations::new(mechanism, &reader)?;
        let of = |symbol: Symbol| -> Result<Vec<ArrangedTerm<'g>>, PolynomialError> {
            let place = symbol.number.saturating_sub(1);
            let component = |kind, axis: usize| -> Option<&Sum<'g>> {
                iterations.vectors(kind).get(place).and_then(|Column(all)| all.get(axis))
            };
            Ok(match (symbol.kind, symbol.component) {
                (Kind::Force, Some(axis)) => {
                    let acceleration = component(Kind::CenterOfMassAcceleration, axis);
                    let mass = mechanism.links.get(place).map(|link| reader.sum(link.mass));
                    match (acceleration, mass.transpose()?) {
                        (Some(a), Some(mass)) => bracketed(&mass.arranged(), &a.arranged()),
                        _ => vec![],
                    }
                }
                (Kind::JointTorque, _) => {
                    let moved = mechanism.links.iter().enumerate();
                    let mut sum = Sum::default();
                    for (index, link) in moved.filter(|(_, link)| link.coordinate == place) {
                        let kind = match link.kind {
                            JointKind::Revolute => Kind::LinkMoment,
                            JointKind::Prismatic => Kind::LinkForce,
                        };
                        let axis = link.axis.0.map(|component| reader.sum(component * link.ratio));
                        let [x, y, z] = axis;
                        let axis = Column([x?, y?, z?]);
                        if let Some(contact) = iterations.vectors(kind).get(index) {
                            sum = sum.plus(axis.dot(contact));
                        }
                        let drive = link.reflected_inertia * link.acceleration * link.ratio;
                        sum = sum.plus(reader.sum(drive)?);
                    }
                    sum.arranged()
                }
                (kind, axis) => {
                    component(kind, axis.unwrap_or_default()).map(Sum::arranged).unwrap_or_default()
                }
            })
        };
        quantities.iter().map(|quantity| of(quantity.symbol)).collect()
    }
}

/// A mass times a sum in parentheses, as in (16) to (19). A minus sign is taken out of the parentheses if any term has
/// one.
fn bracketed<'g>(mass: &[ArrangedTerm<'g>], sum: &[ArrangedTerm<'g>]) -> Vec<ArrangedTerm<'g>> {
    let ([mass], [_, _, ..]) = (mass, sum) else {
        return Sum::of_terms(mass).times(&Sum::of_terms(sum)).arranged();
    };
    let negative = sum.iter().any(|term| term.negative);
    let signed = |term: &ArrangedTerm<'g>| ArrangedTerm {
        negative: term.negative != negative,
        ..term.clone()
    };
    let brackets = ArrangedFactor::Sum(sum.iter().map(signed).collect());
    let factors = mass.factors.iter().cloned().chain([(brackets, 1)]).collect();
    let coefficient: Number = mass.coefficient.clone();
    vec![ArrangedTerm { negative: mass.negative != negative, coefficient, factors }]
}
