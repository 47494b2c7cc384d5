//! Nested sums of products: factors are taken out recursively, by the best of a few candidates at each step.

use std::cmp::Ordering;
use std::rc::Rc;

use rustc_hash::{FxHashMap, FxHashSet};

use super::divisors::{Candidate, candidates};
use super::terms::{Powers, Term, Terms, Variable, is_unit};
use crate::rational::Rational;

/// The number of candidates that are tried at each depth; beyond these depths one is tried.
const WIDTHS: [usize; 3] = [4, 3, 2];

/// The deepest nesting of parentheses.
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

    /// Multiplies out a parameter times a sum of two products with sines, cosines or motions, if the sum has
    /// parentheses itself: both ways have the same length, and people write it without the outer parentheses. Other
    /// products are returned unchanged.
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

    /// The number of variables that stand both before and within parentheses.
    fn split_powers(&self) -> usize {
        let within = |variable: Variable| {
            let products = self.sums.iter().flat_map(|(sum, _)| &sum.products);
            products.filter(|product| product.powers.exponent(variable) > 0).count()
        };
        let inside = self.sums.iter().flat_map(|(sum, _)| &sum.products).map(Product::split_powers);
        self.powers.iter().map(|(variable, _)| within(variable)).sum::<usize>()
            + inside.sum::<usize>()
    }

    /// The number of variables from `early` on that are within parentheses.
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
        let number = usize::from(self.is_number() || !is_unit(&self.coefficient));
        let sums = self.sums.iter();
        let sums = sums.map(|(sum, exponent)| sum.length() + 1 + usize::from(*exponent > 1));
        number + self.powers.length() + sums.sum::<usize>()
    }

    fn is_number(&self) -> bool {
        self.powers.is_one() && self.sums.is_empty()
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
        products + self.products.len().saturating_sub(1) + usize::from(self.has_leading_minus())
    }

    fn has_leading_minus(&self) -> bool {
        self.products.first().is_some_and(|first| first.coefficient.is_negative())
    }

    /// Measures how hard a formula is to read, by the following numbers in this order: printed symbols, nested
    /// parentheses with sines and cosines, squares that are split as in x (x + y), sines, cosines and motions within
    /// parentheses, and products.
    ///
    /// A common factor reads better before parentheses than in every term, but not if it is within parentheses itself.
    /// The 1 in k (x + 1) is not counted, because people write k x + k in this way.
    ///
    /// A minus sign at the beginning counts only in the whole sum: the sign before parentheses absorbs it otherwise.
    fn measure(&self, kinds: &Kinds, place: Place) -> [usize; 5] {
        let is_within = place.brackets < MAX_BRACKETS;
        let late = match self.depth() {
            0 if is_within => 1,
            0 => usize::MAX,
            _ => self.products.iter().map(|product| product.late_in_brackets(kinds.early)).sum(),
        };
        let split = self.products.iter().map(Product::split_powers).sum();
        let absorbed = usize::from(place.depth > 0 && self.has_leading_minus());
        let length = self.length() - absorbed - self.units_in_brackets(kinds);
        [length, self.nesting(kinds).saturating_sub(1), split, late, self.products.len()]
    }

    /// The number of sums in parentheses without sines and cosines in which one term is 1 or −1.
    fn units_in_brackets(&self, kinds: &Kinds) -> usize {
        let is_unit = |product: &Product| product.is_number() && is_unit(&product.coefficient);
        let of_sum = |sum: &Formula| {
            let own = sum.is_plain(kinds) && sum.products.iter().any(is_unit);
            usize::from(own) + sum.units_in_brackets(kinds)
        };
        let sums = self.products.iter().flat_map(|product| &product.sums);
        sums.map(|(sum, _)| of_sum(sum)).sum()
    }

    /// Whether the sum has neither parentheses nor sines and cosines, as m₂ + m₃ and l + q₃.
    fn is_plain(&self, kinds: &Kinds) -> bool {
        let is_plain = |product: &Product| {
            product.sums.is_empty() && !product.powers.iter().any(|(one, _)| kinds.is_circular(one))
        };
        self.products.iter().all(is_plain)
    }

    /// The depth of nested parentheses, in which plain sums do not count within others.
    fn nesting(&self, kinds: &Kinds) -> usize {
        let sums = self.products.iter().flat_map(|product| &product.sums);
        let of_sum = |sum: &Formula| match sum.nesting(kinds) {
            0 => 1,
            1 if sum.has_only_plain_sums(kinds) => 1,
            depth => 1 + depth,
        };
        sums.map(|(sum, _)| of_sum(sum)).max().unwrap_or_default()
    }

    fn has_only_plain_sums(&self, kinds: &Kinds) -> bool {
        self.products.iter().flat_map(|product| &product.sums).all(|(sum, _)| sum.is_plain(kinds))
    }

    /// The depth of nested parentheses.
    fn depth(&self) -> usize {
        self.products.iter().map(Product::depth).max().unwrap_or_default()
    }

    /// The terms without any parentheses.
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

    /// The sum times `sign`, 1 or −1, as it is written in parentheses: products with sines, cosines and motions come
    /// last.
    fn in_brackets(&self, sign: &Rational, early: usize) -> Formula {
        let signed = |product: &Product| Product {
            coefficient: &product.coefficient * sign,
            ..product.clone()
        };
        let is_late =
            |first: &Powers| first.iter().any(|(variable, _)| usize::from(variable) >= early);
        Formula::sorted(self.products.iter().map(signed).collect(), is_late)
    }

    /// Removes the minus sign at the beginning if parentheses can absorb it: `(b - a) c` for `-(a - b) c`. Otherwise
    /// `None`.
    fn without_leading_minus(&self, early: usize) -> Option<Formula> {
        if !self.has_leading_minus() {
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

    /// Multiplies out the sums in parentheses that do not become longer, if this reduces the nesting of parentheses;
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
    /// The number of levels of parentheses that may still be nested within it.
    brackets: usize,
}

/// The search for the short forms of one sum and its parts.
pub(super) struct Factoring {
    /// The absolute values of its coefficients; no other numbers are made, except small integers.
    coefficients: FxHashSet<Rational>,
    known: FxHashMap<(Terms, usize), Rc<Formula>>,
    work: usize,
    kinds: Kinds,
}

/// Properties of variables by which formulas of the same length are compared.
pub(super) struct Kinds {
    /// The number of variables that are written before parentheses; they are the first ones.
    pub(super) early: usize,
    /// Whether each variable is a sine or cosine.
    pub(super) circular: Vec<bool>,
}

impl Kinds {
    pub(super) fn is_circular(&self, variable: Variable) -> bool {
        self.circular.get(usize::from(variable)).copied().unwrap_or_default()
    }
}

impl Factoring {
    pub(super) fn new(terms: &Terms, kinds: Kinds) -> Factoring {
        let coefficients = terms.as_slice().iter().map(|(_, number)| number.abs()).collect();
        Factoring { coefficients, known: FxHashMap::default(), work: 0, kinds }
    }

    /// Returns the shortest form that is found.
    pub(super) fn formula(&mut self, terms: &Terms) -> Formula {
        let best = self.best(terms, Place { depth: 0, brackets: MAX_BRACKETS });
        best.without_leading_minus(self.kinds.early).unwrap_or_else(|| (*best).clone())
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
            _ if terms.as_slice().iter().all(|(_, number)| number.is_negative()) => {
                // Squares are found in the positive sum.
                let negative = |(powers, number): &Term| (powers.clone(), -number);
                let opposite = Terms::sum(terms.as_slice().iter().map(negative));
                let opposite = self.best(&opposite, place);
                let minus = |it: &Product| Product { coefficient: -&it.coefficient, ..it.clone() };
                Formula::sorted(opposite.products.iter().map(minus).collect(), |_| false)
            }
            (powers, number) if powers.is_one() && number.is_one() => {
                self.without_content(terms, place)
            }
            (powers, number) => {
                let inner = divided(terms, &content);
                let factor = Terms::single(powers.clone(), number.clone());
                Formula {
                    products: self.product(&[&factor, &inner], place).opened(self.kinds.early),
                }
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
        let mut least = best.measure(&self.kinds, place);
        for candidate in candidates(terms, &self.coefficients, &self.kinds).into_iter().take(width)
        {
            let formula = self.of_candidate(terms, &candidate, place);
            let unnested = formula.unnested(self.kinds.early);
            for formula in std::iter::once(formula).chain(unnested) {
                let measure = formula.measure(&self.kinds, place);
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
            let sums = vec![(Rc::new(formula.in_brackets(&sign, self.kinds.early)), 1)];
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
