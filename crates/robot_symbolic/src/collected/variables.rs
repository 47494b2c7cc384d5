//! The variables of a polynomial: its atoms, the reciprocals of atoms, and the sines and cosines of all angles between
//! the links of its groups of parallel joints.

use rustc_hash::FxHashMap;

use super::angles::{Group, ParallelAngles};
use super::factoring::{Formula, Kinds, Product};
use super::terms::{Powers, Term, Terms, Variable};
use crate::expr::{Expr, View};
use crate::graph::{Function, Graph, Id};
use crate::number::Number;
use crate::polynomial::Polynomial;
use crate::print::{ArrangedFactor, ArrangedTerm};
use crate::walk;

/// The meaning of a variable: an atom of the polynomial, or its reciprocal if the second entry is true.
type Meaning = (Id, bool);

/// The variables of a polynomial, in the order in which they print.
pub(super) struct Variables<'g> {
    meanings: Vec<(Expr<'g>, bool)>,
    places: FxHashMap<Meaning, Variable>,
    /// For the sine or cosine of an angle, the variable of the cosine or sine of the same angle.
    partners: Vec<Option<Variable>>,
    groups: Vec<Group>,
}

/// The sort key of a variable: its rank, then the coordinates of its angle, with sines before cosines.
type Place<K> = (K, Vec<K>, bool, Id, bool);

impl<'g> Variables<'g> {
    /// The variables of a polynomial and of all groups of angles of which at least two occur in it.
    pub(super) fn new<K: Ord>(
        polynomial: &Polynomial<'g>,
        angles: &[ParallelAngles<'g>],
        rank: &impl Fn(Expr<'g>) -> K,
    ) -> Variables<'g> {
        let graph = polynomial.graph();
        let mut meanings: Vec<(Expr<'g>, bool)> = vec![];
        for (monomial, _) in polynomial.terms() {
            let meaning = |factor: &crate::polynomial::Factor| {
                (graph.expr(factor.atom()), factor.exponent() < 0)
            };
            meanings.extend(monomial.factors().iter().map(meaning));
        }
        let circular: Vec<Expr<'g>> = meanings
            .iter()
            .filter_map(|(atom, inverse)| angle(*atom).filter(|_| !inverse))
            .collect();
        let occurs = |angle: &Expr<'g>| circular.contains(angle);
        let used: Vec<ParallelAngles<'g>> =
            angles.iter().filter_map(|group| group.restricted(occurs)).collect();
        let edges = used.iter().flat_map(|group| group.differences(graph));
        for angle in circular.iter().copied().chain(edges) {
            meanings.extend([(angle.sin(), false), (angle.cos(), false)]);
        }
        meanings.sort_by_cached_key(|(atom, inverse)| place(*atom, *inverse, rank));
        meanings.dedup();
        let mut variables = Variables {
            places: (0..)
                .zip(&meanings)
                .map(|(n, (atom, inverse))| ((atom.id(), *inverse), n))
                .collect(),
            partners: vec![],
            groups: vec![],
            meanings,
        };
        variables.partners = variables.meanings.iter().map(|it| variables.partner_of(it)).collect();
        variables.groups =
            used.iter().filter_map(|group| Group::new(group, graph, &variables)).collect();
        variables
    }

    fn partner_of(&self, (atom, inverse): &(Expr<'g>, bool)) -> Option<Variable> {
        let other = match atom.view() {
            View::Call(Function::Sin, angle) => angle.cos(),
            View::Call(Function::Cos, angle) => angle.sin(),
            _ => return None,
        };
        if *inverse { None } else { self.find(other) }
    }

    /// Returns the variable of an atom.
    pub(super) fn find(&self, atom: Expr<'g>) -> Option<Variable> {
        self.places.get(&(atom.id(), false)).copied()
    }

    /// Whether any variable is a reciprocal.
    pub(super) fn have_reciprocals(&self) -> bool {
        self.meanings.iter().any(|(_, inverse)| *inverse)
    }

    /// Returns the variable of the reciprocal of a variable; `None` if the variable is itself a reciprocal, or if its
    /// reciprocal does not occur.
    pub(super) fn reciprocal(&self, variable: Variable) -> Option<Variable> {
        let (atom, inverse) = self.meanings.get(usize::from(variable))?;
        self.places.get(&(atom.id(), true)).copied().filter(|_| !inverse)
    }

    /// The cosine of the same angle for a sine, and the sine for a cosine; `None` for other variables.
    pub(super) fn partner(&self, variable: Variable) -> Option<Variable> {
        self.partners.get(usize::from(variable)).copied().flatten()
    }

    /// The cosine of the same angle for a sine; `None` for other variables.
    pub(super) fn cosine_of(&self, sine: Variable) -> Option<Variable> {
        self.partner(sine).filter(|_| !self.is_cosine(sine))
    }

    /// Whether the variable is a cosine.
    pub(super) fn is_cosine(&self, variable: Variable) -> bool {
        let meaning = self.meanings.get(usize::from(variable));
        meaning.is_some_and(|(atom, _)| matches!(atom.view(), View::Call(Function::Cos, _)))
    }

    /// The groups of angles.
    pub(super) fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// Rewrites the polynomial in the variables; `None` if it has floating-point numbers or very large exponents.
    pub(super) fn read(&self, polynomial: &Polynomial<'g>) -> Option<Terms> {
        let term = |(monomial, number): (&crate::Monomial, &Number)| -> Option<Term> {
            let power = |factor: &crate::polynomial::Factor| {
                let meaning = (factor.atom(), factor.exponent() < 0);
                let exponent = u16::try_from(factor.exponent().unsigned_abs()).ok()?;
                Some((*self.places.get(&meaning)?, exponent))
            };
            let powers = monomial.factors().iter().map(power).collect::<Option<Vec<_>>>()?;
            Some((Powers::from_unsorted(powers.into_iter()), number.as_rational()?.clone()))
        };
        Some(Terms::sum(polynomial.terms().map(term).collect::<Option<Vec<_>>>()?))
    }

    /// The number of variables whose atoms are `early`; they are the first variables.
    pub(super) fn before(&self, early: impl Fn(Expr<'g>) -> bool) -> usize {
        self.meanings.partition_point(|(atom, _)| early(*atom))
    }

    /// The kinds of the variables, of which the first `early` are written before parentheses.
    pub(super) fn kinds(&self, early: usize) -> Kinds {
        let circular = self.meanings.iter().map(|(atom, _)| angle(*atom).is_some()).collect();
        Kinds { early, circular }
    }

    /// Converts a formula to terms for printing. Sums in parentheses stand after the factors among the first `early`
    /// variables.
    pub(super) fn written(&self, formula: &Formula, early: usize) -> Vec<ArrangedTerm<'g>> {
        formula.products.iter().map(|product| self.product(product, early)).collect()
    }

    fn product(&self, product: &Product, early: usize) -> ArrangedTerm<'g> {
        let atom = |(variable, exponent): (Variable, u16)| {
            let (atom, inverse) = self.meanings.get(usize::from(variable))?;
            let exponent = i32::from(exponent);
            Some((ArrangedFactor::Atom(*atom), if *inverse { -exponent } else { exponent }))
        };
        let is_early = |power: &(Variable, u16)| usize::from(power.0) < early;
        let first = product.powers.iter().filter(is_early).filter_map(atom);
        let last = product.powers.iter().filter(|power| !is_early(power)).filter_map(atom);
        let sums = product.sums.iter().map(|(sum, exponent)| {
            (ArrangedFactor::Sum(self.written(sum, early)), i32::from(*exponent))
        });
        let number = &product.coefficient;
        ArrangedTerm {
            negative: number.is_negative(),
            coefficient: Number::from(number.abs()),
            factors: first.chain(sums).chain(last).collect(),
        }
    }
}

/// The angle of a sine or cosine.
fn angle(atom: Expr<'_>) -> Option<Expr<'_>> {
    match atom.view() {
        View::Call(Function::Sin | Function::Cos, angle) => Some(angle),
        _ => None,
    }
}

fn place<'g, K: Ord>(atom: Expr<'g>, inverse: bool, rank: &impl Fn(Expr<'g>) -> K) -> Place<K> {
    let graph: &'g Graph = atom.graph();
    let named = |symbol| graph.find_symbol(&graph.symbol_name(symbol));
    let symbols = angle(atom).map(|angle| walk::symbols(&[angle])).unwrap_or_default();
    let mut coordinates: Vec<K> = symbols.into_iter().filter_map(named).map(rank).collect();
    coordinates.sort();
    let is_cosine = matches!(atom.view(), View::Call(Function::Cos, _));
    (rank(atom), coordinates, is_cosine, atom.id(), inverse)
}
