//! Factoring: a b + a c becomes a (b + c) if that saves operations.

use rustc_hash::FxHashMap;

use super::nary::{Id, Nary, Node, Term};
use crate::program::Program;

/// Takes common factors out of sums, first those that save most.
///
/// Terms that contain only parameters cost nothing at a call: x p + x r becomes x (p + r), and the
/// constructor computes the sum. This pass reassociates.
#[must_use]
pub(super) fn run(program: &Program) -> Program {
    let mut view = Nary::new(program);
    let mut uses = view.uses();
    let mut pending: Vec<Id> = (0..view.len() as Id).rev().collect();
    while let Some(id) = pending.pop() {
        while uses[id as usize] > 0
            && let Some(factoring) = best(&view, id, &uses)
        {
            let inner = factoring.apply(&mut view, id);
            uses.resize(view.len(), 1);
            pending.push(inner);
        }
    }
    view.program()
}

/// A factor and the terms of the sum that contain it.
struct Factoring {
    factor: Id,
    terms: Vec<usize>,
}

/// Returns the factoring of a sum that saves the most operations; of several, the one with the earliest node as factor.
fn best(view: &Nary, sum: Id, uses: &[u32]) -> Option<Factoring> {
    let Node::Sum(terms) = view.node(sum) else {
        return None;
    };
    let mut candidates: FxHashMap<Id, Vec<usize>> = FxHashMap::default();
    let mut order: Vec<Id> = vec![];
    for (place, term) in terms.iter().enumerate() {
        for factor in factors(view, term.node, uses) {
            let places = candidates.entry(factor).or_default();
            if places.is_empty() {
                order.push(factor);
            }
            if places.last() != Some(&place) {
                places.push(place);
            }
        }
    }
    let mut best: Option<(usize, Factoring)> = None;
    for factor in order {
        let places = candidates.remove(&factor).unwrap_or_default();
        if places.len() < 2 {
            continue;
        }
        let saving = saving(view, terms, factor, &places, uses);
        let better = best.as_ref().is_none_or(|(most, known)| {
            saving > *most || (saving == *most && factor < known.factor)
        });
        if saving > 0 && better {
            best = Some((saving, Factoring { factor, terms: places }));
        }
    }
    best.map(|(_, factoring)| factoring)
}

/// Returns the factors of a term if nothing else uses it; otherwise the term itself is the only factor.
fn factors(view: &Nary, node: Id, uses: &[u32]) -> Vec<Id> {
    match view.node(node) {
        Node::Product(factors) if uses[node as usize] == 1 => factors.clone(),
        _ => vec![node],
    }
}

/// Returns all factors except one.
fn without(mut factors: Vec<Id>, factor: Id) -> Vec<Id> {
    if let Some(place) = factors.iter().position(|known| *known == factor) {
        factors.remove(place);
    }
    factors
}

fn saving(view: &Nary, terms: &[Term], factor: Id, places: &[usize], uses: &[u32]) -> usize {
    let is_early = |factors: &[Id]| factors.iter().all(|factor| view.is_early(*factor));
    let all: Vec<Vec<Id>> = terms.iter().map(|term| factors(view, term.node, uses)).collect();
    let rests = places.iter().map(|place| without(all[*place].clone(), factor));
    let rests: Vec<Vec<Id>> = rests.collect();
    let inner_early = rests.iter().filter(|rest| is_early(rest)).count();
    let inner = operations(rests.len(), inner_early);
    // The product of the factor and the inner sum, which is early if all its terms are.
    let whole_early = inner_early == rests.len();
    let product = operations(2, usize::from(view.is_early(factor)) + usize::from(whole_early));
    let outside: Vec<usize> = (0..terms.len()).filter(|place| !places.contains(place)).collect();
    let outer_early = outside.iter().filter(|place| is_early(&all[**place])).count();
    let product_early = usize::from(view.is_early(factor) && whole_early);
    let outer = operations(outside.len() + 1, outer_early + product_early);
    let before_early = all.iter().filter(|factors| is_early(factors)).count();
    let before_sum = operations(terms.len(), before_early);
    let multiplications = |factors: &Vec<Id>| {
        let early = factors.iter().filter(|factor| view.is_early(**factor)).count();
        operations(factors.len(), early)
    };
    let before_products: usize = places.iter().map(|place| multiplications(&all[*place])).sum();
    let after_products: usize = rests.iter().map(multiplications).sum();
    let (before, after) = (before_sum + before_products, inner + product + outer + after_products);
    before.saturating_sub(after)
}

/// Returns the number of operations at a call that combine so many operands; the constructor combines those that are
/// known early.
fn operations(operands: usize, early: usize) -> usize {
    if operands == early { 0 } else { operands - early - 1 + usize::from(early > 0) }
}

impl Factoring {
    /// Rewrites the sum; returns the new sum that is multiplied by the factor.
    fn apply(&self, view: &mut Nary, sum: Id) -> Id {
        let Node::Sum(terms) = view.node(sum).clone() else {
            return sum;
        };
        let inner: Vec<Term> = self
            .terms
            .iter()
            .map(|place| {
                let term = terms[*place];
                let rest = match view.node(term.node) {
                    Node::Product(factors) if term.node != self.factor => {
                        without(factors.clone(), self.factor)
                    }
                    _ => vec![],
                };
                let node = match rest.as_slice() {
                    [] => view.constant(1.0),
                    [single] => *single,
                    _ => view.push(Node::Product(rest)),
                };
                Term { node, negative: term.negative }
            })
            .collect();
        let inner = view.push(Node::Sum(inner));
        let product = Node::Product(vec![self.factor, inner]);
        let places = terms.iter().enumerate();
        let mut outer: Vec<Term> = places
            .filter(|(place, _)| !self.terms.contains(place))
            .map(|(_, term)| *term)
            .collect();
        if outer.is_empty() {
            view.replace(sum, product);
        } else {
            outer.push(Term::positive(view.push(product)));
            view.replace(sum, Node::Sum(outer));
        }
        inner
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counts::Counts;
    use crate::interpreter::evaluate;
    use crate::passes::testing::{assert_same_values, operations_left, random_polynomials};
    use crate::program::{Builder, Operation, Source};
    use crate::trigonometry::Trigonometry;

    #[test]
    fn values_stay() {
        assert_same_values("factoring", run);
    }

    #[test]
    fn common_factors_leave_sums() {
        let mut b = Builder::new();
        let [x, y, z, w] = [0, 1, 2, 3].map(|index| b.load(Source::Input(index)));
        let [xy, xz, yw] = [b.mul(x, y), b.mul(x, z), b.mul(y, w)];
        let (sum, rest) = (b.add(xy, xz), b.mul(xz, w));
        let sum = b.sub(sum, yw);
        // x y + x z − y w, if x z is needed again, becomes y (x − w) + x z.
        let factored = Counts::of(&run(&b.finish(vec![sum, rest])));
        assert_eq!((factored.mul, factored.add), (3, 2));
    }

    /// x y + x z − x = x (y + z − 1)
    #[test]
    fn a_factor_that_stands_alone_keeps_its_sign() {
        for negative in [false, true] {
            let mut b = Builder::new();
            let [x, y, z] = [0, 1, 2].map(|index| b.load(Source::Input(index)));
            let (xy, xz) = (b.mul(x, y), b.mul(x, z));
            let sum = b.add(xy, xz);
            let sum = if negative { b.sub(sum, x) } else { b.add(sum, x) };
            let factored = run(&b.finish(vec![sum]));
            assert_eq!(Counts::of(&factored).mul, 1);
            let load = |source| match source {
                Source::Input(index) => [3.0, 5.0, 7.0][index as usize],
                other => panic!("{other:?}"),
            };
            let expected = if negative { 33.0 } else { 39.0 };
            assert_eq!(evaluate(&factored, Trigonometry::Standard, load), [expected]);
        }
    }

    /// p r x + p s y: the constructor computes p r and p s, so two products and a sum remain; factoring out p does not
    /// save any.
    #[test]
    fn what_saves_nothing_stays() {
        let mut b = Builder::new();
        let [x, y] = [0, 1].map(|index| b.load(Source::Input(index)));
        let [p, r, s] = [0, 1, 2].map(|index| b.load(Source::Parameter(index)));
        let (pr, ps) = (b.mul(p, r), b.mul(p, s));
        let (prx, psy) = (b.mul(pr, x), b.mul(ps, y));
        let sum = b.add(prx, psy);
        let counts = Counts::of_calls(&run(&b.finish(vec![sum])));
        assert_eq!((counts.mul, counts.add), (2, 1));
    }

    /// p x + p: p is known before the call, and p (x + 1) has the same number of operations.
    #[test]
    fn a_parameter_is_not_taken_out_of_what_costs_as_much() {
        let mut b = Builder::new();
        let (x, p) = (b.load(Source::Input(0)), b.load(Source::Parameter(0)));
        let product = b.mul(p, x);
        let sum = b.add(p, product);
        let program = run(&b.finish(vec![sum]));
        let last = program.operation(program.results()[0]);
        assert!(matches!(last, Operation::Add(..)), "{program:?}");
    }

    #[test]
    fn sums_of_parameters_go_to_the_constructor() {
        let mut b = Builder::new();
        let x = b.load(Source::Input(0));
        let [p, r] = [0, 1].map(|index| b.load(Source::Parameter(index)));
        let (px, rx) = (b.mul(p, x), b.mul(r, x));
        let sum = b.add(px, rx);
        let counts = Counts::of_calls(&run(&b.finish(vec![sum])));
        assert_eq!((counts.mul, counts.add), (1, 0));
    }

    /// The operations at a call of the sums and products of a view; equal operations are each counted.
    fn operations_of(view: &Nary) -> usize {
        let uses = view.uses();
        let needed =
            (0..view.len() as Id).filter(|id| uses[*id as usize] > 0 && !view.is_early(*id));
        needed
            .map(|id| match view.node(id) {
                Node::Sum(_) | Node::Product(_) => {
                    let early = view.operands(id).any(|operand| view.is_early(operand));
                    let late = view.operands(id).filter(|operand| !view.is_early(*operand)).count();
                    late + usize::from(early) - 1
                }
                _ => 0,
            })
            .sum()
    }

    /// The predicted saving of a factoring is the difference of the operations before and after it.
    #[test]
    fn savings_are_as_predicted() {
        let mut counted = 0;
        for seed in 0..300 {
            let mut view = Nary::new(&random_polynomials(seed));
            for id in 0..view.len() as Id {
                let uses = view.uses();
                if uses[id as usize] == 0 {
                    continue;
                }
                let Some(factoring) = best(&view, id, &uses) else { continue };
                let Node::Sum(terms) = view.node(id).clone() else { panic!("no sum") };
                let places = &factoring.terms;
                let foretold = saving(&view, &terms, factoring.factor, places, &uses);
                let before = operations_of(&view);
                factoring.apply(&mut view, id);
                counted += 1;
                assert_eq!(before - operations_of(&view), foretold, "seed {seed}");
                for id in 0..view.len() as Id {
                    let products = matches!(view.node(id), Node::Product(all) if all.len() < 2);
                    assert!(!products, "seed {seed}: a product of one");
                }
            }
        }
        assert!(counted > 100, "{counted}");
    }

    /// The factor that saves more is taken; of two factors that save the same, the earlier node.
    #[test]
    fn the_factor_that_saves_most_is_taken() {
        let mut b = Builder::new();
        let [x, y, u, v, w] = [0, 1, 2, 3, 4].map(|index| b.load(Source::Input(index)));
        // y u + x u + x v + x w: x saves two products, u one.
        let products = [b.mul(y, u), b.mul(x, u), b.mul(x, v), b.mul(x, w)];
        let sum = products.into_iter().reduce(|sum, product| b.add(sum, product)).unwrap();
        let view = Nary::new(&b.finish(vec![sum]));
        let found = best(&view, view.results[0].node, &view.uses()).unwrap();
        assert_eq!(view.node(found.factor), &Node::Leaf(Operation::Load(Source::Input(0))));
        assert_eq!(found.terms, [0, 1, 3]);
        // y z + z x + x y: each saves one.
        let mut b = Builder::new();
        let [x, y, z] = [2, 1, 0].map(|index| b.load(Source::Input(index)));
        let products = [b.mul(y, z), b.mul(z, x), b.mul(x, y)];
        let sum = products.into_iter().reduce(|sum, product| b.add(sum, product)).unwrap();
        let view = Nary::new(&b.finish(vec![sum]));
        let found = best(&view, view.results[0].node, &view.uses()).unwrap();
        assert_eq!(found.factor, 0);
        assert_eq!(view.node(0), &Node::Leaf(Operation::Load(Source::Input(2))));
    }

    /// n operands, e of them early: a chain of n − 1, with the early ones as one operand.
    #[test]
    fn operands_known_early_are_one() {
        let counts = [(1, 0), (3, 0), (3, 1), (3, 2), (3, 3), (5, 2)];
        assert_eq!(counts.map(|(all, early)| operations(all, early)), [0, 2, 2, 1, 0, 3]);
    }

    #[test]
    fn no_program_costs_more_and_many_less() {
        let (before, after) = operations_left(run);
        assert!(before == 6338 && after <= 4876, "{before} became {after}");
        // A second run may save a little more: the result of one factoring can allow another.
        let (once, twice) = operations_left(|program| run(&run(program)));
        assert!(twice <= after && once == before, "{after} became {twice}");
    }
}
