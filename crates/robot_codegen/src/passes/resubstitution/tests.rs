use robot_symbolic::Function;

use super::*;
use crate::counts::Counts;
use crate::interpreter::evaluate;
use crate::passes::testing::{assert_same_values, operations_left};
use crate::program::Source;
use crate::trigonometry::Trigonometry;

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

/// 3 x + 3 y, if x + y and 3 x are computed too: one product replaces a product and a sum.
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

/// The operations that remain of the program that `build` makes from five inputs.
fn left(build: impl Fn(&mut Builder, [Value; 5]) -> Vec<Value>) -> usize {
    let mut b = Builder::new();
    let loads = [0, 1, 2, 3, 4].map(|index| b.load(Source::Input(index)));
    let results = build(&mut b, loads);
    Counts::of(&with(Resubstitution::Pairs)(&b.finish(results))).operations()
}

/// (z/x)(x u + x v) is z u + z v only if x is not 0; (z/x) u + (z/x) v is (z/x)(u + v) wherever it is finite.
#[test]
fn no_divisor_is_added() {
    let added = left(|b, [x, z, u, v, _]| {
        let [xu, xv, zu, zv] = [(x, u), (x, v), (z, u), (z, v)].map(|(a, c)| b.mul(a, c));
        vec![b.div(z, x), b.add(xu, xv), b.add(zu, zv)]
    });
    let same = left(|b, [x, z, u, v, _]| {
        let quotient = b.div(z, x);
        let (first, second) = (b.mul(quotient, u), b.mul(quotient, v));
        vec![quotient, b.add(u, v), b.add(first, second)]
    });
    assert_eq!([added, same], [7, 3]);
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

/// The pass keeps the term c x of y − c x even if c is far below the rounding error of y, because y may be as small as
/// c.
#[test]
fn a_term_stays_however_small_its_constant_is() {
    let operations = |constant: f64, small: fn(&mut Builder) -> Value| {
        let mut b = Builder::new();
        let y = small(&mut b);
        let (x, constant) = (b.load(Source::Cos(0)), b.constant(constant));
        let weight = b.mul(constant, x);
        let (rest, both) = (b.sub(y, weight), b.add(y, weight));
        let inertia = b.load(Source::Input(1));
        // Each has two uses, as in forward dynamics: a force minus a weight, divided by an inertia.
        let results = vec![b.div(rest, inertia), b.div(both, inertia), b.mul(rest, both)];
        let program = b.finish(results);
        let left = Counts::of(&with(Resubstitution::Multiples)(&program)).operations();
        (left, Counts::of(&program).operations())
    };
    let [force, parameter, friction] = [
        |b: &mut Builder| b.load(Source::Input(0)),
        |b: &mut Builder| b.load(Source::Parameter(0)),
        |b: &mut Builder| {
            let speed = b.load(Source::Input(0));
            b.call(Function::Tanh, speed)
        },
    ];
    for constant in [1.0, 1e-9, 2e-17, 3e-30, 4e-200, 5e-300] {
        for small in [force, parameter, friction] {
            let (left, all) = operations(constant, small);
            assert_eq!(left, all, "{constant:e}");
        }
    }
}

/// Whether the pass keeps all operations of a program, which `build` makes from the sine of an angle, a velocity, a
/// torque and a parameter.
fn keeps(build: impl Fn(&mut Builder, [Value; 4]) -> Vec<Value>) -> bool {
    let mut b = Builder::new();
    let loads = [Source::Sin(0), Source::Input(0), Source::Input(1), Source::Parameter(0)];
    let loads = loads.map(|source| b.load(source));
    let results = build(&mut b, loads);
    let program = b.finish(results);
    let found = with(Resubstitution::Pairs)(&program);
    Counts::of(&found).operations() == Counts::of(&program).operations()
}

/// The second term of 9.81 sin q + c q̇² counts at high velocities, also in values that are computed from the sum: its
/// product with another value, its quotient by a sum, and the difference of the torque.
#[test]
fn a_term_of_other_inputs_stays_however_small_it_is() {
    for constant in [1.5, 1e-9, 1e-17, 1e-30, 1e-100] {
        let sum = |b: &mut Builder, sine: Value, speed: Value| {
            let (g, c) = (b.constant(9.81), b.constant(constant));
            let (weight, square) = (b.mul(g, sine), b.mul(speed, speed));
            let centrifugal = b.mul(c, square);
            b.add(weight, centrifugal)
        };
        assert!(keeps(|b, [sine, speed, ..]| {
            let sum = sum(b, sine, speed);
            vec![sum, b.mul(sum, sine)]
        }));
        assert!(keeps(|b, [sine, speed, torque, mass]| {
            let sum = sum(b, sine, speed);
            let (one, rest) = (b.constant(1.5), b.sub(torque, sum));
            let inertia = b.add(one, mass);
            vec![b.div(sum, inertia), b.div(rest, inertia)]
        }));
    }
}

/// The parts of x/(x y) are those of 1/y, and x/(x + y) is compared with what has the same denominator.
#[test]
fn quotients_are_found_by_their_parts() {
    let quotient = left(|b, [x, y, z, ..]| {
        let (one, product) = (b.constant(1.0), b.mul(x, y));
        vec![b.div(one, y), b.div(x, product), z]
    });
    let of_sum = left(|b, [x, y, z, ..]| {
        let sum = b.add(x, y);
        let (xz, yz) = (b.mul(x, z), b.mul(y, z));
        let both = b.add(xz, yz);
        vec![b.div(x, sum), b.div(xz, both), z]
    });
    assert_eq!((quotient, of_sum), (1, 2));
}

/// A term that follows from rounding alone is still dropped: x − (x + y − y) is 0 at any size.
#[test]
fn a_term_that_is_rounding_is_dropped() {
    let operations = left(|b, [x, y, z, ..]| {
        let sum = b.add(x, y);
        let again = b.sub(sum, y);
        let nothing = b.sub(x, again);
        let result = b.add(z, nothing);
        vec![b.mul(result, z)]
    });
    assert_eq!(operations, 1);
}

/// cos kθ by its recursion: the bounds on rounding errors grow with each step, but the values do not.
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

/// A replacement that agrees only at the points of comparison is not taken.
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

/// cos kθ again: the values are below 1, and their bounds grow beyond any limit.
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
fn an_absolute_value_is_not_replaced_by_its_argument() {
    let mut b = Builder::new();
    let x = b.load(Source::Input(0));
    let square = b.mul(x, x);
    let (absolute, root) = (b.call(Function::Abs, x), b.call(Function::Sqrt, square));
    let program = b.finish(vec![x, absolute, root]);
    assert_eq!(run(&program, &Samples::unrelated(), Resubstitution::Pairs), program);
}

/// The stated cost and operands of each form agree with the value that it computes.
#[test]
fn forms_cost_and_compute_what_they_say() {
    let (x, y) = (Value(0), Value(1));
    let forms = [
        (Form::Constant(4.0), 0, 4.0),
        (Form::Equal(x, false), 0, 3.0),
        (Form::Equal(y, true), 0, -5.0),
        (Form::Multiple(7.0, y), 1, 35.0),
        (Form::SumMultiple(x, 7.0, y), 2, 38.0),
        (Form::Sum((x, false), (y, false)), 1, 8.0),
        (Form::Sum((x, true), (y, false)), 1, 2.0),
        (Form::Sum((x, false), (y, true)), 1, -2.0),
        (Form::Product(x, y, false), 1, 15.0),
        (Form::Product(x, y, true), 1, -15.0),
    ];
    for (form, cost, expected) in forms {
        let mut b = Builder::new();
        let loads = [0, 1].map(|index| b.load(Source::Input(index)));
        let result = form.build(&mut b, |value| loads[value.index()]);
        let program = b.finish(vec![result]);
        let load = |source| if source == Source::Input(0) { 3.0 } else { 5.0 };
        assert_eq!(evaluate(&program, Trigonometry::Standard, load), [expected], "{form:?}");
        assert_eq!((form.cost(), Counts::of(&program).operations()), (cost, cost), "{form:?}");
        let mut needed = form.operands().to_vec();
        needed.sort_unstable();
        let sources = crate::passes::dead_code::run(&program).sources();
        assert_eq!(needed.len(), sources.len(), "{form:?}");
        for (value, source) in needed.into_iter().zip(sources) {
            assert_eq!(Source::Input(value.0), source, "{form:?}");
        }
    }
}

/// Keys are 30 bits of a number without its sign. Numbers that differ by less have the same key or neighboring ones.
#[test]
fn numbers_that_agree_to_nine_digits_are_near() {
    for number in [1.0, 1.75, 3e-7, 6e8] {
        assert_eq!(key(number), key(-number));
        let step = number * 2f64.powi(-30);
        assert_ne!(key(number), key(number + 1.01 * step));
        let table = FxHashMap::from_iter([(key(number), vec![Value(3), Value(5)])]);
        for sign in [1.0, -1.0] {
            assert!(near(&table, key(number + 0.5 * sign * step)).eq([Value(3), Value(5)]));
            assert!(has_near(&table, key(-number - 0.5 * sign * step)));
            assert!(!has_near(&table, key(number + 4.0 * sign * step)));
        }
    }
}

/// The sums that a search finds directly: ways to compute the last result as a sum that contains one of the first
/// values.
fn sums_found(
    build: impl Fn(&mut Builder, [Value; 4]) -> (Value, Value),
    negative: bool,
) -> Option<Form> {
    let mut b = Builder::new();
    let loads = [0, 1, 2, 3].map(|index| b.load(Source::Input(index)));
    let (first, value) = build(&mut b, loads);
    let mut results = loads.to_vec();
    results.extend([first, value]);
    let program = b.finish(results);
    let search = Search::new(&program, &Samples::unrelated());
    let mut best = Best { gain: 0, form: None };
    search.try_sums(value, (first, negative), search.cones.size(value), &mut best);
    best.form
}

/// x + y as (x z + y z)/z, if x + c and c − y are computed too, whose difference is the same. If c is large, the
/// difference rounds more than four times as much as the quotient.
#[test]
fn sums_of_much_larger_values_are_not_taken() {
    let found = |size: f64| {
        let mut b = Builder::new();
        let [x, y, z] = [0, 1, 2].map(|index| b.load(Source::Input(index)));
        let large = b.constant(size);
        let (first, second) = (b.add(x, large), b.sub(large, y));
        let (xz, yz) = (b.mul(x, z), b.mul(y, z));
        let sum = b.add(xz, yz);
        let quotient = b.div(sum, z);
        let program = b.finish(vec![first, second, quotient]);
        let search = Search::new(&program, &Samples::unrelated());
        let room = search.cones.size(quotient);
        let mut forms = [None, None];
        for (form, negative, value) in [(0, false, first), (1, true, second)] {
            let mut best = Best { gain: 0, form: None };
            search.try_sums(quotient, (value, negative), room, &mut best);
            forms[form] = best.form;
        }
        forms
    };
    let [first, second] = found(1.0);
    assert!(matches!(first, Some(Form::Sum((Value(0..), false), (Value(0..), true)))), "{first:?}");
    assert!(
        matches!(second, Some(Form::Sum((Value(0..), true), (Value(0..), false)))),
        "{second:?}"
    );
    let none = found(1e4);
    assert!(none.iter().all(Option::is_none), "{none:?}");
}

/// (x z u + y z)/z is x u + y, but this form is not taken if x u is (x + c w) u − c w u with a large c, which rounds a
/// lot.
#[test]
fn values_that_round_much_more_are_not_terms() {
    let found = |size: f64| {
        let mut b = Builder::new();
        let [x, y, z, u, w] = [0, 1, 2, 3, 4].map(|index| b.load(Source::Input(index)));
        let constant = b.constant(size);
        let large = b.mul(constant, w);
        let (sum, rest) = (b.add(x, large), b.mul(large, u));
        let product = b.mul(sum, u);
        let first = b.sub(product, rest);
        let (xz, yz) = (b.mul(x, z), b.mul(y, z));
        let xzu = b.mul(xz, u);
        let both = b.add(xzu, yz);
        let value = b.div(both, z);
        let program = b.finish(vec![first, value]);
        let search = Search::new(&program, &Samples::unrelated());
        let mut best = Best { gain: 0, form: None };
        search.try_pairs(value, search.cones.size(value), &mut best);
        best.form.is_some_and(|form| form.operands().contains(&first))
    };
    assert!(found(0.25) && !found(1e4));
}

/// A sum of two negative terms is not a form, because it would be the negative of a sum.
#[test]
fn one_term_of_a_sum_is_positive() {
    let of_signs = |negative: bool| {
        sums_found(
            |b, [x, y, z, _]| {
                let (xz, yz) = (b.mul(x, z), b.mul(y, z));
                let sum = b.add(xz, yz);
                let quotient = b.div(sum, z);
                (x, if negative { b.neg(quotient) } else { quotient })
            },
            negative,
        )
    };
    assert!(matches!(of_signs(false), Some(Form::Sum((Value(0), false), (Value(1), false)))));
    assert!(of_signs(true).is_none());
}

/// (x z + c y z)/z minus x is c y. The form is taken only if it rounds no more than the quotient.
#[test]
fn multiples_that_are_much_larger_are_not_taken() {
    let found = |constant: f64, fourth: bool| {
        sums_found(
            move |b, [x, y, z, w]| {
                let factor = b.constant(constant);
                let (xz, yz) = (b.mul(x, z), b.mul(y, z));
                let multiple = b.mul(factor, yz);
                let sum = b.add(xz, multiple);
                let last = if fourth { b.mul(sum, w) } else { b.div(sum, z) };
                (x, last)
            },
            false,
        )
    };
    let Some(Form::SumMultiple(Value(0), factor, Value(1))) = found(5.0, false) else {
        panic!("no multiple")
    };
    assert!((factor - 5.0).abs() < 1e-14);
    assert!(found(5.0, true).is_none());
}

#[test]
fn no_program_costs_more_and_many_less() {
    for (effort, most) in [(Resubstitution::Multiples, 6337), (Resubstitution::Pairs, 5631)] {
        let (before, after) = operations_left(with(effort));
        assert!(after <= most, "{effort:?}: {before} became {after}");
    }
    let (before, after) = operations_left(with(Resubstitution::Off));
    assert_eq!(before, after);
}

#[test]
fn variables_are_told_apart() {
    let mut b = Builder::new();
    let [x, y] = [0, 1].map(|index| b.load(Source::Input(index)));
    let sum = b.add(x, y);
    let program = b.finish(vec![sum]);
    let parts = Parts::of(&program, |_, _| [1.5; parts::POINTS]);
    assert!(parts.agree(x, Form::Equal(x, false)));
    assert!(!parts.agree(x, Form::Equal(y, false)));
}
