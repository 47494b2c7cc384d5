//! Expansion of expressions into terms, in one pass over the nodes in the order of their ids.

use std::collections::BTreeMap;
use std::rc::Rc;

use rustc_hash::{FxHashMap, FxHashSet};

use super::accumulator::{Budget, Part, Term, Terms, sum_of_products};
use super::monomial::Monomial;
use super::{PolynomialError, PolynomialOptions, terms};
use crate::expr::{Expr, View};
use crate::graph::{Function, Graph, Id};
use crate::number::Number;
use crate::walk;

/// The largest number of nodes of a denominator that are split into factors.
const MAX_FACTORS: usize = 256;

/// The canonical terms of each root.
pub(super) fn expand(
    roots: &[Expr<'_>],
    graph: &Graph,
    options: &PolynomialOptions,
) -> Result<Vec<Terms>, PolynomialError> {
    let mut expander = Expander::new(roots, graph, options);
    for expr in walk::reachable(roots) {
        let used = expander.uses.get(&expr.id()).is_some_and(|uses| *uses > 0);
        if used && !expander.inlined.contains(&expr.id()) {
            let terms = expander.node(expr)?;
            expander.store(expr.id(), terms)?;
        }
    }
    let one = |root: &Expr<'_>| {
        let terms = Rc::unwrap_or_clone(expander.take(root.id()));
        expander.without_denominators(terms)
    };
    roots.iter().map(one).collect()
}

pub(super) struct Expander<'g> {
    pub(super) graph: &'g Graph,
    pub(super) options: PolynomialOptions,
    pub(super) budget: Budget,
    /// The terms of finished nodes that are still needed.
    memo: FxHashMap<Id, Rc<Terms>>,
    /// The number of remaining uses of each node.
    uses: FxHashMap<Id, u32>,
    /// Sums and products that are used only once, as an operand of a sum: that sum adds their terms directly.
    inlined: FxHashSet<Id>,
    /// The reciprocals of denominators, most of which occur under many numerators.
    inverses: FxHashMap<Id, Rc<Terms>>,
    /// The sine and cosine of each expanded angle.
    pub(super) sines_and_cosines: FxHashMap<Id, [Rc<Terms>; 2]>,
}

impl<'g> Expander<'g> {
    fn new(roots: &[Expr<'_>], graph: &'g Graph, options: &PolynomialOptions) -> Expander<'g> {
        let order = walk::reachable(roots);
        let mut uses: FxHashMap<Id, u32> = FxHashMap::default();
        for root in roots {
            *uses.entry(root.id()).or_default() += 1;
        }
        // From results to operands. A product in a denominator need not be expanded itself, because its factors are.
        for expr in order.iter().rev() {
            if uses.contains_key(&expr.id()) {
                for operand in needs(*expr) {
                    *uses.entry(operand.id()).or_default() += 1;
                }
            }
        }
        let mut inlined = FxHashSet::default();
        let sums = order.iter().filter(|expr| is_sum(**expr));
        for sum in sums.filter(|sum| uses.contains_key(&sum.id())) {
            for part in sum.operands() {
                let additive = is_sum(part) || matches!(part.view(), View::Mul(..));
                if additive && uses.get(&part.id()) == Some(&1) {
                    inlined.insert(part.id());
                }
            }
        }
        Expander {
            graph,
            options: *options,
            budget: Budget::new(options),
            memo: FxHashMap::default(),
            uses,
            inlined,
            inverses: FxHashMap::default(),
            sines_and_cosines: FxHashMap::default(),
        }
    }

    fn store(&mut self, id: Id, terms: Terms) -> Result<(), PolynomialError> {
        self.budget.check_terms(terms.len())?;
        self.budget.live += terms.len();
        self.memo.insert(id, Rc::new(terms));
        Ok(())
    }

    /// The terms of a finished node, which are removed from the memo at the last use.
    fn take(&mut self, id: Id) -> Rc<Terms> {
        let left = self.uses.entry(id).or_default();
        *left = left.saturating_sub(1);
        if *left > 0 {
            return self.memo.get(&id).cloned().unwrap_or_default();
        }
        let terms = self.memo.remove(&id).unwrap_or_default();
        self.budget.live -= terms.len();
        terms
    }

    fn node(&mut self, expr: Expr<'_>) -> Result<Terms, PolynomialError> {
        Ok(match expr.view() {
            View::Number(number) => terms::constant(number),
            View::Pi | View::Symbol(_) => {
                let factor = self.graph.factor(expr.id());
                vec![(Monomial::from_factor(factor), Number::integer(1))]
            }
            View::Add(..) | View::Sub(..) | View::Neg(_) => self.sum(expr)?,
            View::Mul(a, b) => {
                let (a, b) = (self.take(a.id()), self.take(b.id()));
                self.product(&a, &b)?
            }
            View::Div(a, b) => {
                let mut quotient = self.take(a.id()).to_vec();
                for (factor, exponent) in denominator_factors(b) {
                    let terms = self.take(factor.id());
                    let inverse = match self.inverses.get(&factor.id()) {
                        Some(known) => Rc::clone(known),
                        None => Rc::new(self.reciprocal(&terms)?),
                    };
                    self.inverses.insert(factor.id(), Rc::clone(&inverse));
                    let power = self.power(&inverse, exponent)?;
                    quotient = self.product(&quotient, &power)?;
                }
                quotient
            }
            View::Call(function @ (Function::Sin | Function::Cos), angle) => {
                let terms = self.take(angle.id());
                self.circular(function, angle.id(), &terms)?
            }
            View::Call(function, argument) => {
                // As at the end of the expansion, so that the argument is the same if it is expanded again.
                let terms = self.take(argument.id()).to_vec();
                let terms = self.without_denominators(terms)?;
                self.call(function, &terms)
            }
        })
    }

    /// Expands a sum with all its inlined parts.
    fn sum(&mut self, root: Expr<'_>) -> Result<Terms, PolynomialError> {
        let mut parts = vec![];
        let mut pending = vec![(root, 1_i64)];
        while let Some((expr, sign)) = pending.pop() {
            let inside = expr == root || self.inlined.contains(&expr.id());
            match expr.view() {
                View::Add(a, b) if inside => pending.extend([(b, sign), (a, sign)]),
                View::Sub(a, b) if inside => pending.extend([(b, -sign), (a, sign)]),
                View::Neg(a) if inside => pending.push((a, -sign)),
                View::Mul(a, b) if inside => {
                    let (a, b) = (self.take(a.id()), self.take(b.id()));
                    parts.push((a, Some(b), Number::integer(sign)));
                }
                _ => parts.push((self.take(expr.id()), None, Number::integer(sign))),
            }
        }
        let parts: Vec<Part<'_>> = parts
            .iter()
            .map(|(a, b, factor)| Part { a, b: b.as_ref().map(|b| b.as_slice()), factor })
            .collect();
        self.sum_parts(&parts)
    }

    /// Computes a sum of products.
    pub(super) fn sum_parts(&mut self, parts: &[Part<'_>]) -> Result<Terms, PolynomialError> {
        sum_of_products(self.graph, &mut self.budget, parts)
    }

    pub(super) fn product(&mut self, a: &Terms, b: &Terms) -> Result<Terms, PolynomialError> {
        if let [(monomial, number)] = b.as_slice()
            && monomial.is_one()
        {
            return Ok(terms::scaled(a, number));
        }
        self.sum_parts(&[Part { a, b: Some(b), factor: &Number::integer(1) }])
    }

    /// Sorts and merges terms that are in any order.
    pub(super) fn collected(&mut self, terms: &[Term]) -> Result<Terms, PolynomialError> {
        self.sum_parts(&[Part { a: terms, b: None, factor: &Number::integer(1) }])
    }

    /// √, | |, sgn or tanh of a canonical argument. Signs and, if the function permits it, constant factors are moved
    /// out of the argument.
    fn call(&self, function: Function, argument: &Terms) -> Terms {
        let negative = terms::leads_negative(argument);
        let one = Number::integer(1);
        let leading = argument.first().map_or(&one, |(_, coefficient)| coefficient);
        let sign = Number::integer(if negative { -1 } else { 1 });
        let (inner, outer) = match function {
            Function::Abs if leading.as_rational().is_some() => (leading.recip(), leading * &sign),
            Function::Abs => (sign, one),
            Function::Sign if leading.as_rational().is_some() => (leading.recip(), sign),
            Function::Sign | Function::Tanh => (sign.clone(), sign),
            _ => (one.clone(), one),
        };
        let argument = terms::scaled(argument, &inner);
        let canonical = terms::to_expr(&argument, self.graph);
        let value = self.graph.call_terms(function, canonical, &argument);
        terms::scaled(&value, &outer)
    }
}

/// The nodes whose terms are needed to compute the terms of a node.
fn needs(expr: Expr<'_>) -> Vec<Expr<'_>> {
    match expr.view() {
        View::Div(a, b) => {
            let factors = denominator_factors(b).into_iter().map(|(factor, _)| factor);
            std::iter::once(a).chain(factors).collect()
        }
        _ => expr.operands(),
    }
}

/// The factors of a denominator with their exponents, so that 1/(x + y)^2 is the square of 1/(x + y). After
/// [`MAX_FACTORS`] nodes, products are not split any further.
fn denominator_factors(denominator: Expr<'_>) -> Vec<(Expr<'_>, u32)> {
    let mut exponents: BTreeMap<Id, (Expr<'_>, u32)> = BTreeMap::new();
    exponents.insert(denominator.id(), (denominator, 1));
    let mut factors = vec![];
    let mut visited = 0;
    // Nodes are taken in descending order of their ids, so the exponent of a node is complete when it is taken.
    while let Some((_, (expr, exponent))) = exponents.pop_last() {
        visited += 1;
        let operands = match expr.view() {
            View::Mul(a, b) if visited <= MAX_FACTORS => Some([a, b]),
            _ => None,
        };
        let known = |operand: &Expr<'_>| exponents.get(&operand.id()).map_or(0, |known| known.1);
        let doubled = operands.filter(|operands| {
            let sum = operands.iter().map(known).max().and_then(|most| most.checked_add(exponent));
            sum.is_some_and(|sum| sum.checked_add(exponent).is_some())
        });
        match doubled {
            None => factors.push((expr, exponent)),
            Some(operands) => {
                for operand in operands {
                    exponents.entry(operand.id()).or_insert((operand, 0)).1 += exponent;
                }
            }
        }
    }
    factors
}

fn is_sum(expr: Expr<'_>) -> bool {
    matches!(expr.view(), View::Add(..) | View::Sub(..) | View::Neg(_))
}
