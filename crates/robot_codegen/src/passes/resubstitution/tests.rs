use robot_symbolic::Function;

use super::*;
use crate::counts::Counts;
use crate::passes::testing::assert_same_values;
use crate::program::Source;

fn with(effort: Resubstitution) -> impl Fn(&Program) -> Program {
    move |program| run(program, &Samples::unrelated(), effort)
}

#[test]
fn values_stay() {
    assert_same_values("multiples", with(Resubstitution::Multiples));
    assert_same_values("pairs", with(Resubstitution::Pairs));
}

#[test]
fn a_length_is_the_same_after_a_turn() {
    let mut b = Builder::new();
    let [x, y] = [0, 1].map(|index| b.load(Source::Input(index)));
    let (s, c) = (b.load(Source::Sin(0)), b.load(Source::Cos(0)));
    let (cx, sy, sx, cy) = (b.mul(c, x), b.mul(s, y), b.mul(s, x), b.mul(c, y));
    let (u, v) = (b.sub(cx, sy), b.add(sx, cy));
    let (xx, yy, uu, vv) = (b.mul(x, x), b.mul(y, y), b.mul(u, u), b.mul(v, v));
    let (before, after) = (b.add(xx, yy), b.add(uu, vv));
    let program = b.finish(vec![u, v, before, after]);
    let found = run(&program, &Samples::unrelated(), Resubstitution::Multiples);
    assert_eq!(Counts::of(&program).operations() - Counts::of(&found).operations(), 3);
    assert_eq!(found.results()[2], found.results()[3]);
}

#[test]
fn multiples_need_one_multiplication() {
    let mut b = Builder::new();
    let [x, y] = [0, 1].map(|index| b.load(Source::Input(index)));
    let p = b.load(Source::Parameter(0));
    let [two, three, six] = [2.0, 3.0, 6.0].map(|value| b.constant(value));
    let [twice, thrice, sixfold, whole] =
        [b.mul(two, x), b.mul(three, y), b.mul(six, y), b.mul(x, x)];
    // 2 x + 3 y, and p (4 x + 6 y) in another form
    let first = b.add(twice, thrice);
    let (four_x, px) = (b.add(twice, twice), b.mul(p, x));
    let other = b.add(four_x, sixfold);
    let second = b.mul(p, other);
    let program = b.finish(vec![first, second, whole, px]);
    let found = with(Resubstitution::Multiples)(&program);
    assert_eq!(Counts::of_calls(&found).operations(), Counts::of_calls(&program).operations() - 2);
}

/// 3 x + 3 y beside x + y and 3 x: a product in place of a product and a sum.
#[test]
fn two_operations_become_one_multiplication() {
    let mut b = Builder::new();
    let [x, y] = [0, 1].map(|index| b.load(Source::Input(index)));
    let three = b.constant(3.0);
    let (sum, first, second) = (b.add(x, y), b.mul(three, x), b.mul(three, y));
    let thrice = b.add(first, second);
    let found = with(Resubstitution::Multiples)(&b.finish(vec![sum, first, thrice]));
    assert_eq!(Counts::of(&found).operations(), 3);
}

/// The operations that are left of what `build` makes of five inputs.
fn left(build: impl Fn(&mut Builder, [Value; 5]) -> Vec<Value>) -> usize {
    let mut b = Builder::new();
    let loads = [0, 1, 2, 3, 4].map(|index| b.load(Source::Input(index)));
    let results = build(&mut b, loads);
    Counts::of(&with(Resubstitution::Pairs)(&b.finish(results))).operations()
}

/// x w, y w and (x ± y) w are two products and a sum.
#[test]
fn sums_of_two_values_are_found() {
    let sum = left(|b, [x, y, w, ..]| {
        let sum = b.add(x, y);
        vec![b.mul(x, w), b.mul(y, w), b.mul(sum, w)]
    });
    let difference = left(|b, [x, y, w, ..]| {
        let difference = b.sub(x, y);
        vec![b.mul(x, w), b.mul(y, w), b.mul(difference, w)]
    });
    assert_eq!((sum, difference), (3, 3));
}

/// y − x and (x − y) w, the second by the product −w (y − x).
#[test]
fn products_are_found_with_their_sign() {
    let operations = left(|b, [x, y, w, ..]| {
        let (there, back) = (b.sub(y, x), b.sub(x, y));
        vec![there, b.mul(back, w)]
    });
    assert_eq!(operations, 2);
}

/// (x z + 5 y z)/z is x + 5 y.
#[test]
fn a_sum_with_a_multiple_is_found() {
    let operations = left(|b, [x, y, z, ..]| {
        let (five, xz, yz) = (b.constant(5.0), b.mul(x, z), b.mul(y, z));
        let multiple = b.mul(five, yz);
        let sum = b.add(xz, multiple);
        vec![b.div(sum, z)]
    });
    assert_eq!(operations, 2);
}

/// cos kθ by its recursion: bounds of rounding grow with each step, the values do not.
#[test]
fn a_long_recursion_is_not_taken_for_rounding() {
    let mut b = Builder::new();
    let (one, two, cosine) = (b.constant(1.0), b.constant(2.0), b.load(Source::Cos(0)));
    let twice = b.mul(two, cosine);
    let mut values = vec![one, cosine];
    for k in 1..400 {
        let product = b.mul(twice, values[k]);
        values.push(b.sub(product, values[k - 1]));
    }
    let program = b.finish(vec![values[400]]);
    let mut angles = Builder::new();
    let angle = angles.load(Source::Input(0));
    let samples = Samples::new(&angles.finish(vec![angle]));
    let last = samples.of(&program)[program.results()[0].index()];
    assert!(last.rounding() > 1.0 && !last.is_constant() && !last.is_regular());
    let found = run(&program, &samples, Resubstitution::Multiples);
    assert!(samples.agree(&program, &found));
    assert_eq!(Counts::of(&found).operations(), Counts::of(&program).operations());
}

#[test]
fn other_results_do_not_agree() {
    let program = |constant: f64| {
        let mut b = Builder::new();
        let (x, y) = (b.load(Source::Input(0)), b.load(Source::Input(1)));
        let (factor, difference) = (b.constant(constant), b.sub(x, y));
        let results = vec![b.mul(factor, x), b.call(Function::Sqrt, difference)];
        b.finish(results)
    };
    let samples = Samples::unrelated();
    assert!(samples.agree(&program(1.5), &program(1.5)));
    assert!(samples.agree(&program(1.5), &program(1.5 + 1e-15)));
    assert!(!samples.agree(&program(1.5), &program(1.5 + 1e-6)));
}

/// What agrees at the points that are compared alone is not taken.
#[test]
fn a_program_of_other_results_is_not_taken() {
    let mut b = Builder::new();
    let (x, y) = (b.load(Source::Input(0)), b.load(Source::Input(1)));
    let [first, second] = [0, 1].map(|index| b.load(Source::Sin(index)));
    let products = [b.mul(first, x), b.mul(second, x), b.mul(first, y)];
    let program = b.finish(products.to_vec());
    let lying = Samples::of_equal_angles(2);
    let mut search = Search::new(&program, &lying);
    assert!(search.sweep(Resubstitution::Multiples));
    assert_ne!(search.program(), program);
    assert_eq!(run(&program, &lying, Resubstitution::Multiples), program);
}

/// cos kθ again: the values are below 1, and their bounds grow past every limit.
#[test]
fn trust_ends_where_rounding_may_reach_a_part_in_a_billion() {
    let (mut b, mut cosines) = (Builder::new(), vec![]);
    let (two, cosine) = (b.constant(2.0), b.load(Source::Cos(0)));
    let twice = b.mul(two, cosine);
    let (mut before, mut last) = (b.constant(1.0), cosine);
    for _ in 0..60 {
        let product = b.mul(twice, last);
        (before, last) = (last, b.sub(product, before));
        cosines.push(last);
    }
    let program = b.finish(cosines);
    let mut angles = Builder::new();
    let angle = angles.load(Source::Input(0));
    let samples = Samples::new(&angles.finish(vec![angle])).of(&program);
    let results = program.results().iter().map(|value| &samples[value.index()]);
    let trusted: Vec<f64> =
        results.clone().filter(|one| one.is_regular()).map(Sample::rounding).collect();
    let most = trusted.iter().copied().fold(0.0, f64::max);
    assert!((1e-11..1e-8).contains(&most), "{most:e}");
    assert!(results.map(Sample::rounding).fold(0.0, f64::max) > 1e-3);
}

#[test]
fn an_absolute_value_is_no_argument() {
    let mut b = Builder::new();
    let x = b.load(Source::Input(0));
    let square = b.mul(x, x);
    let (absolute, root) = (b.call(Function::Abs, x), b.call(Function::Sqrt, square));
    let program = b.finish(vec![x, absolute, root]);
    assert_eq!(run(&program, &Samples::unrelated(), Resubstitution::Pairs), program);
}
