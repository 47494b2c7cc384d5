//! Nested sums of products: factors are taken out recursively, by the best of a few candidates at each step.

use std::cmp::Ordering;
use std::rc::Rc;

use rustc_hash::{FxHashMap, FxHashSet};

use super::divisors::{Candidate, candidates};
use super::terms::{Powers, Term, Terms, Variable, is_unit};
use crate::rational::Rational;

/// The number of candidates that are tried at each depth; beyond these depths one is tried.
const WIDTHS: [usize; 3] = [4, 3, 2];

/// The deepest nesting of brackets.
const MAX_BRACKETS: usize = 3;

/// The deepest nesting of sums that are factored; deeper sums stay as they are.
const MAX_DEPTH: usize = 16;

/// The work, in squares of numbers of terms, after which only the best candidate is tried.
const MAX_WORK: usize = 400_000;

/// A sum of products.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Formula {
    pub(super) products: Vec<Product>,
}

/// A product of a coefficient, powers of variables, and powers of sums.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Product {
    pub(super) coefficient: Rational,
    pub(super) powers: Powers,
    pub(super) sums: Vec<(Rc<Formula>, u16)>,
}

impl Product {
    fn single(powers: Powers, coefficient: Rational) -> Product {
        Product { coefficient, powers, sums: vec![] }
    }

    fn times(&mut self, other: &Product) {
        self.coefficient = &self.coefficient * &other.coefficient;
        self.powers = self.powers.product(&other.powers);
        for (sum, exponent) in &other.sums {
            match self.sums.iter_mut().find(|known| known.0 == *sum) {
                Some(known) => known.1 += exponent,
                None => self.sums.push((Rc::clone(sum), *exponent)),
            }
        }
    }

    /// Multiplies out a parameter times a sum of two products with sines, cosines or motions, if the sum has brackets
    /// itself: both ways have the same length, and people write it without the outer brackets. Other products are
    /// returned unchanged.
    fn opened(self, early: usize) -> Vec<Product> {
        let is_early = |(variable, _): (Variable, u16)| usize::from(variable) < early;
        let variable = Product { sums: vec![], ..self.clone() };
        let is_parameter = variable.length() == 1 && variable.powers.iter().all(is_early);
        let is_late = |product: &Product| !product.powers.iter().all(is_early);
        match self.sums.as_slice() {
            [(sum, 1)]
                if is_parameter
                    && sum.products.len() == 2
                    && sum.depth() > 0
                    && sum.products.iter().all(is_late) =>
            {
                let multiplied = |product: &Product| {
                    let mut multiplied = product.clone();
                    multiplied.times(&variable);
                    multiplied
                };
                sum.products.iter().map(multiplied).collect()
            }
            _ => vec![self],
        }
    }

    /// The number of variables that stand both before and within brackets.
    fn split_powers(&self) -> usize {
        let within = |variable: Variable| {
            let products = self.sums.iter().flat_map(|(sum, _)| &sum.products);
            products.filter(|product| product.powers.exponent(variable) > 0).count()
        };
        let inside = self.sums.iter().flat_map(|(sum, _)| &sum.products).map(Product::split_powers);
        self.powers.iter().map(|(variable, _)| within(variable)).sum::<usize>()
            + inside.sum::<usize>()
    }

    /// The number of variables from `early` on that are within brackets.
    fn late_in_brackets(&self, early: usize) -> usize {
        let sums = self.sums.iter();
        sums.map(|(sum, _)| sum.products.iter().map(|it| it.late(early)).sum::<usize>()).sum()
    }

    fn late(&self, early: usize) -> usize {
        let own =
            self.powers.iter().filter(|(variable, _)| usize::from(*variable) >= early).count();
        own + self.late_in_brackets(early)
    }

    /// The number of printed symbols, without the sign.
    fn length(&self) -> usize {
        let alone = self.powers.is_one() && self.sums.is_empty();
        let number = usize::from(alone || !is_unit(&self.coefficient));
        let sums = self.sums.iter();
        let sums = sums.map(|(sum, exponent)| sum.length() + 1 + usize::from(*exponent > 1));
        number + self.powers.length() + sums.sum::<usize>()
    }

    fn depth(&self) -> usize {
        self.sums.iter().map(|(sum, _)| 1 + sum.depth()).max().unwrap_or_default()
    }

    /// The first term of the product when it is multiplied out; products are sorted by it.
    fn first(&self) -> Powers {
        self.sums.iter().fold(self.powers.clone(), |first, (sum, exponent)| {
            let own = sum.products.iter().map(Product::first).min().unwrap_or_default();
            (0..*exponent).fold(first, |first, _| first.product(&own))
        })
    }
}

impl Formula {
    /// The number of printed symbols.
    pub(super) fn length(&self) -> usize {
        let products: usize = self.products.iter().map(Product::length).sum();
        let leading = self.products.first().is_some_and(|first| first.coefficient.is_negative());
        products + self.products.len().saturating_sub(1) + usize::from(leading)
    }

    /// Measures how hard a formula is to read, by the following numbers in this order: printed symbols, nested
    /// brackets, squares that are split as in x (x + y), sines, cosines and motions within brackets, and products.
    ///
    /// A common factor reads better before brackets than in every term, but not if it is within brackets itself.
    fn measure(&self, early: usize, is_within: bool) -> [usize; 5] {
        let late = match self.depth() {
            0 if is_within => 1,
            0 => usize::MAX,
            _ => self.products.iter().map(|product| product.late_in_brackets(early)).sum(),
        };
        let split = self.products.iter().map(Product::split_powers).sum();
        [self.length(), self.depth().saturating_sub(1), split, late, self.products.len()]
    }

    /// The depth of nested brackets.
    fn depth(&self) -> usize {
        self.products.iter().map(Product::depth).max().unwrap_or_default()
    }

    /// The terms without any brackets.
    pub(super) fn flat(terms: &Terms) -> Formula {
        let products = terms.as_slice().iter();
        let products =
            products.map(|(powers, number)| Product::single(powers.clone(), number.clone()));
        Formula::sorted(products.collect(), |_| false)
    }

    /// A sum with its products in the order in which they are listed, and with late ones after the others. The first
    /// positive product is moved to the beginning, so the sum begins with a minus sign only if all products have one.
    fn sorted(mut products: Vec<Product>, is_late: impl Fn(&Powers) -> bool) -> Formula {
        products.sort_by_cached_key(|product| {
            let first = product.first();
            (is_late(&first), first)
        });
        let positive = products.iter().position(|product| !product.coefficient.is_negative());
        if let Some(positive) = positive {
            products[..=positive].rotate_right(1);
        }
        Formula { products }
    }

    /// The sum times `sign`, 1 or −1, as it is written in brackets: products with sines, cosines and motions come last.
    fn in_brackets(&self, sign: &Rational, early: usize) -> Formula {
        let signed = |product: &Product| Product {
            coefficient: &product.coefficient * sign,
            ..product.clone()
        };
        let is_late =
            |first: &Powers| first.iter().any(|(variable, _)| usize::from(variable) >= early);
        Formula::sorted(self.products.iter().map(signed).collect(), is_late)
    }

    /// Removes the minus sign at the beginning if brackets can absorb it: `(b - a) c` for `-(a - b) c`. Otherwise
    /// `None`.
    fn without_leading_minus(&self, early: usize) -> Option<Formula> {
        if !self.products.first()?.coefficient.is_negative() {
            return None;
        }
        let has_minus = |sum: &Formula| sum.products.iter().any(|it| it.coefficient.is_negative());
        let place_in = |product: &Product| {
            product.sums.iter().position(|(sum, exponent)| *exponent == 1 && has_minus(sum))
        };
        let (place, within) = self
            .products
            .iter()
            .enumerate()
            .find_map(|(place, product)| Some((place, place_in(product)?)))?;
        let minus = Rational::integer(-1);
        let mut formula = self.clone();
        let product = formula.products.get_mut(place)?;
        let (sum, _) = product.sums.get_mut(within)?;
        *sum = Rc::new(sum.in_brackets(&minus, early));
        product.coefficient = &product.coefficient * &minus;
        formula.products[..=place].rotate_right(1);
        Some(formula)
    }

    /// Multiplies out the sums in brackets that do not become longer, if this reduces the nesting of brackets;
    /// otherwise `None`.
    fn unnested(&self, early: usize) -> Option<Formula> {
        if self.depth() < 2 {
            return None;
        }
        let mut formula = self.clone();
        for (sum, _) in formula.products.iter_mut().flat_map(|product| &mut product.sums) {
            let flat = Formula::flat(&sum.terms()).in_brackets(&Rational::ONE, early);
            if flat.length() <= sum.length() {
                *sum = Rc::new(flat);
            }
        }
        (formula.depth() < self.depth()).then_some(formula)
    }

    /// The terms of the sum when it is multiplied out.
    fn terms(&self) -> Terms {
        Terms::sum(self.products.iter().flat_map(|product| {
            let own = Terms::single(product.powers.clone(), product.coefficient.clone());
            let factors = product.sums.iter().flat_map(|(sum, exponent)| {
                let terms = sum.terms();
                (0..*exponent).map(move |_| terms.clone())
            });
            let all = factors.fold(own, |all, factor| {
                let products = factor.as_slice().iter().map(|term| all.times(term));
                Terms::sum(products.flat_map(|part| part.as_slice().to_vec()))
            });
            all.as_slice().to_vec()
        }))
    }

    /// Whether the sum reads better with its signs changed, because most of them are minus.
    fn is_rather_negative(&self) -> bool {
        let is_negative = |product: &&Product| product.coefficient.is_negative();
        let negative = self.products.iter().filter(is_negative).count();
        let first = self.products.iter().min_by_key(|product| product.first());
        match (2 * negative).cmp(&self.products.len()) {
            Ordering::Less => false,
            Ordering::Equal => first.is_some_and(|first| first.coefficient.is_negative()),
            Ordering::Greater => true,
        }
    }
}

/// The place of a sum within the formula.
#[derive(Clone, Copy)]
struct Place {
    /// The number of sums that contain it.
    depth: usize,
    /// The number of nested brackets that are still allowed within it.
    brackets: usize,
}

/// The search for the short forms of one sum and its parts.
pub(super) struct Factoring {
    /// The absolute values of its coefficients; no other numbers are made, except small integers.
    figures: FxHashSet<Rational>,
    known: FxHashMap<(Terms, usize), Rc<Formula>>,
    work: usize,
    /// The number of variables that are written before brackets.
    early: usize,
}

impl Factoring {
    pub(super) fn new(terms: &Terms, early: usize) -> Factoring {
        let figures = terms.as_slice().iter().map(|(_, number)| number.abs()).collect();
        Factoring { figures, known: FxHashMap::default(), work: 0, early }
    }

    /// Returns the shortest form that is found.
    pub(super) fn formula(&mut self, terms: &Terms) -> Formula {
        let best = self.best(terms, Place { depth: 0, brackets: MAX_BRACKETS });
        best.without_leading_minus(self.early).unwrap_or_else(|| (*best).clone())
    }

    fn best(&mut self, terms: &Terms, place: Place) -> Rc<Formula> {
        if terms.len() < 2 || place.depth > MAX_DEPTH || place.brackets == 0 {
            return Rc::new(Formula::flat(terms));
        }
        if let Some(known) = self.known.get(&(terms.clone(), place.brackets)) {
            return Rc::clone(known);
        }
        let content = common_factor(terms);
        let formula = match &content {
            (powers, number) if powers.is_one() && number.is_one() => {
                self.without_content(terms, place)
            }
            (powers, number) => {
                let inner = divided(terms, &content);
                let factor = Terms::single(powers.clone(), number.clone());
                Formula { products: self.product(&[&factor, &inner], place).opened(self.early) }
            }
        };
        let formula = Rc::new(formula);
        self.known.insert((terms.clone(), place.brackets), Rc::clone(&formula));
        formula
    }

    /// The best form of terms that have no common factor.
    fn without_content(&mut self, terms: &Terms, place: Place) -> Formula {
        self.work += terms.len() * terms.len();
        let width = match self.work > MAX_WORK {
            true => 1,
            false => WIDTHS.get(place.depth).copied().unwrap_or(1),
        };
        let mut best = Formula::flat(terms);
        let mut least = best.measure(self.early, place.depth > 0);
        for candidate in candidates(terms, &self.figures).into_iter().take(width) {
            let formula = self.of_candidate(terms, &candidate, place);
            for formula in formula.unnested(self.early).into_iter().chain([formula]) {
                let measure = formula.measure(self.early, place.depth > 0);
                if measure < least {
                    (best, least) = (formula, measure);
                }
            }
        }
        best
    }

    fn of_candidate(&mut self, terms: &Terms, candidate: &Candidate, place: Place) -> Formula {
        let product = self.product(&[&candidate.factor, &candidate.quotient], place);
        let mut products = vec![product];
        let rest = candidate.rest(terms);
        products.extend(
            self.best(&rest, Place { depth: place.depth + 1, ..place }).products.iter().cloned(),
        );
        Formula::sorted(products, |_| false)
    }

    /// The product of sums, each in its best form and with the sign that gives fewer minus signs.
    fn product(&mut self, factors: &[&Terms], place: Place) -> Product {
        let mut product = Product::single(Powers::default(), Rational::ONE);
        let within = Place { depth: place.depth + 1, brackets: place.brackets.saturating_sub(1) };
        for factor in factors {
            let formula = self.best(factor, within);
            if let [single] = formula.products.as_slice() {
                product.times(single);
                continue;
            }
            let sign = Rational::integer(if formula.is_rather_negative() { -1 } else { 1 });
            product.coefficient = &product.coefficient * &sign;
            let sums = vec![(Rc::new(formula.in_brackets(&sign, self.early)), 1)];
            product.times(&Product { sums, ..Product::single(Powers::default(), Rational::ONE) });
        }
        product.sums.sort_by_cached_key(|(sum, _)| sum.products.iter().map(Product::first).min());
        product
    }
}

/// The powers that divide all terms, and the absolute value of their coefficients if all have the same, otherwise 1.
fn common_factor(terms: &Terms) -> Term {
    let mut numbers = terms.as_slice().iter().map(|(_, number)| number.abs());
    let first = numbers.next().unwrap_or(Rational::ONE);
    let is_common = numbers.all(|number| number == first);
    (terms.content(), if is_common { first } else { Rational::ONE })
}

/// Divides the terms by a product that divides all of them.
fn divided(terms: &Terms, (powers, number): &Term) -> Terms {
    let inverse = number.recip().unwrap_or(Rational::ONE);
    terms.over(powers).scaled(&inverse)
}
