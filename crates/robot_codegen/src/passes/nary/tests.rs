use super::*;
use crate::counts::Counts;
use crate::interpreter::evaluate;
use crate::passes::testing::{assert_same_values, operations_left};
use crate::trigonometry::Trigonometry;

#[test]
fn there_and_back_keeps_the_values() {
    assert_same_values("n-ary view", |program| Nary::new(program).program());
}

#[test]
fn sums_used_once_are_one_sum() {
    let mut b = Builder::new();
    let [x, y, z] = [0, 1, 2].map(|index| b.load(Source::Input(index)));
    let sum = b.add(x, y);
    let all = b.sub(z, sum);
    let back = b.add(all, y);
    let view = Nary::new(&b.finish(vec![back]));
    let Node::Sum(terms) = view.node(view.results[0].node) else {
        panic!("no sum");
    };
    assert_eq!(terms.len(), 2, "z − (x + y) + y = z − x");
}

/// The terms of the sum that is the single result of a program.
fn sum_of(build: impl Fn(&mut Builder, [Value; 4]) -> Value) -> Vec<(Node, bool)> {
    let mut b = Builder::new();
    let loads = [0, 1, 2, 3].map(|index| b.load(Source::Input(index)));
    let result = build(&mut b, loads);
    let view = Nary::new(&b.finish(vec![result]));
    match view.node(view.results[0].node) {
        Node::Sum(terms) => {
            assert!(terms.len() > 1, "{terms:?}");
            terms.iter().map(|term| (view.node(term.node).clone(), term.negative)).collect()
        }
        other => vec![(other.clone(), view.results[0].negative)],
    }
}

fn input(index: u32) -> Node {
    Node::Leaf(Operation::Load(Source::Input(index)))
}

#[test]
fn like_terms_are_merged() {
    // (x − z) + (x + y) = 2 x + y − z
    let found = sum_of(|b, [x, y, z, _]| {
        let (first, second) = (b.sub(x, z), b.add(x, y));
        b.add(first, second)
    });
    assert_eq!(found.len(), 3);
    assert!(found.contains(&(input(2), true)) && found.contains(&(input(1), false)));
    let doubled = |(node, negative): &(Node, bool)| {
        matches!(node, Node::Product(factors) if factors.len() == 2) && !negative
    };
    assert!(found.iter().any(doubled));
    // (x + y) − (x + z) − (x + y) = −x − z
    let found = sum_of(|b, [x, y, z, _]| {
        let (first, second) = (b.add(x, y), b.add(x, z));
        let difference = b.sub(first, second);
        let sum = b.sub(difference, x);
        b.sub(sum, y)
    });
    assert_eq!(found.len(), 2);
    // (x + y) − (y + x), in other words
    let nothing = sum_of(|b, [x, y, z, _]| {
        let (first, second) = (b.add(x, y), b.sub(x, z));
        let difference = b.sub(first, second);
        let less = b.sub(difference, y);
        b.sub(less, z)
    });
    assert_eq!(nothing, [(Node::Leaf(Operation::Constant(Constant::new(0.0))), false)]);
    let one = sum_of(|b, [x, y, ..]| {
        let sum = b.add(x, y);
        b.sub(sum, x)
    });
    assert_eq!(one, [(input(1), false)]);
}

#[test]
fn what_is_used_twice_or_known_early_is_a_node() {
    let mut b = Builder::new();
    let [x, y] = [0, 1].map(|index| b.load(Source::Input(index)));
    let [p, r] = [0, 1].map(|index| b.load(Source::Parameter(index)));
    let (shared, early) = (b.add(x, y), b.add(p, r));
    let (first, second) = (b.add(shared, early), b.sub(x, shared));
    let view = Nary::new(&b.finish(vec![first, second]));
    for result in &view.results {
        let Node::Sum(terms) = view.node(result.node) else { panic!("no sum") };
        assert_eq!(terms.len(), 2);
        assert!(!view.is_early(result.node));
    }
    let early = view.operands(view.results[0].node).filter(|id| view.is_early(*id));
    let early: Vec<Stage> = early.map(|id| view.stage(id)).collect();
    assert_eq!(early, [Stage::Parameters]);
}

#[test]
fn a_negative_is_a_use_of_what_it_negates() {
    let mut b = Builder::new();
    let [x, y, z] = [0, 1, 2].map(|index| b.load(Source::Input(index)));
    let sum = b.add(x, y);
    let negative = b.push(Operation::Neg(sum));
    let twice = b.push(Operation::Neg(negative));
    let values = [b.mul(negative, z), b.push(Operation::Call(Function::Sqrt, twice))];
    let program = b.finish(values.to_vec());
    // −sum by its product (the builder takes the sign outward) and by −(−sum).
    let uses = uses_through_signs(&program);
    assert_eq!((uses[sum.index()], uses[twice.index()]), (2, 1));
}

/// Only uses by needed nodes count, and a node that uses another twice counts twice.
#[test]
fn uses_are_counted() {
    let mut b = Builder::new();
    let [x, y] = [0, 1].map(|index| b.load(Source::Input(index)));
    let square = b.mul(x, x);
    let (quotient, unused) = (b.div(square, y), b.mul(y, y));
    let root = b.call(Function::Sqrt, quotient);
    let program = b.finish(vec![root, root, quotient]);
    let view = Nary::new(&program);
    // The square uses x twice, the quotient the square once; the root and the results use the quotient, the results the
    // root twice.
    assert_eq!(view.uses(), [2, 1, 1, 2, 0, 2], "{unused:?}");
}

/// The signs of factors, of a quotient's operands and of a function's argument.
#[test]
fn signs_multiply() {
    for bits in 0..16_u32 {
        let mut b = Builder::new();
        let mut signed = |index: u32| {
            let load = b.push(Operation::Load(Source::Input(index)));
            if bits >> index & 1 == 1 { b.push(Operation::Neg(load)) } else { load }
        };
        let [x, y, z, w] = [0, 1, 2, 3].map(&mut signed);
        let product = b.push(Operation::Mul(x, y));
        let quotient = b.push(Operation::Div(product, z));
        let difference = b.push(Operation::Sub(quotient, w));
        let root = b.push(Operation::Call(Function::Tanh, difference));
        let program = b.finish(vec![product, quotient, difference, root]);
        let found = Nary::new(&program).program();
        let load = |source| match source {
            Source::Input(index) => [3.0, 5.0, 7.0, 0.25][index as usize],
            other => panic!("{other:?}"),
        };
        let values = |program| evaluate(program, Trigonometry::Standard, load);
        assert_eq!(values(&found), values(&program), "{bits:b}");
    }
}

/// Converting to the view and back adds no operation, and sums begin with the terms that are known early.
#[test]
fn there_and_back_costs_nothing() {
    let (before, after) = operations_left(|program| Nary::new(program).program());
    assert!(after <= before, "{before} became {after}");
    let mut b = Builder::new();
    let [x, y] = [0, 1].map(|index| b.load(Source::Input(index)));
    let [p, r] = [0, 1].map(|index| b.load(Source::Parameter(index)));
    let sums = [b.add(x, p), b.add(y, r)];
    let products = [b.mul(x, p), b.mul(y, r)];
    let results = vec![b.add(sums[0], sums[1]), b.mul(products[0], products[1])];
    let counts = Counts::of_calls(&Nary::new(&b.finish(results)).program());
    assert_eq!((counts.add, counts.mul), (2, 2));
}
