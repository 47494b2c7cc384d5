//! Resubstitution: a value that is a multiple, or the sum or product of two, of values computed
//! anyway needs no operations of its own beyond that.
//!
//! The other passes look at how a program is written; this one looks at its values, at sample
//! points in twice the precision of `f64`, and so finds what no rule relates: terms that vanish,
//! moments parallel to each other, squares of a vector's length before and after a turn. The
//! technique is that of logic synthesis (Brayton, Hachtel and Sangiovanni-Vincentelli 1990), on
//! numbers.
//!
//! A replacement must agree with what it replaces, at every point, to within the rounding of the
//! evaluation that it replaces. That is evidence, no proof. Two numbers near 1 that have nothing to do
//! with each other agree to within such a tolerance by a chance of some 10⁻¹⁵; there are six points, of
//! which pairs share the values of parameters, so that even where parameters alone decide three are
//! left: 10⁻⁴⁵, times the millions of pairs that are compared. Where that rounding may be large, as in
//! long recursions, whose bounds grow with each joint, agreement is no evidence, and nothing is replaced.
//! But the points are fixed, the same for every program, and values of one program are not unrelated; no
//! bound follows for them. The results are therefore compared once more at other points, and what code
//! computes is held against independent solvers by the tests.
//!
//! Absolute values, signs and roots are taken for unrelated numbers, so that nothing follows from the
//! sign that an argument happens to have at the points.

mod cones;
mod samples;

use rustc_hash::FxHashMap;

use self::cones::{Cones, Operands};
use self::samples::Sample;
pub(crate) use self::samples::Samples;
use super::Resubstitution;
use crate::program::{Builder, Operation, Program, Value};

/// Rounds after which the search ends, improved or not.
const ROUNDS: usize = 8;
/// How much larger the rounding of a sum may be than that of what it replaces.
const GROWTH: f64 = 4.0;

/// Replaces values by multiples of others, and with [`Resubstitution::Pairs`] by sums and products
/// of two, where that saves operations. Reassociates.
#[must_use]
pub(crate) fn run(program: &Program, samples: &Samples, effort: Resubstitution) -> Program {
    let mut found = super::dead_code::run(program);
    for _ in 0..ROUNDS {
        let mut search = Search::new(&found, samples);
        if effort == Resubstitution::Off || !search.sweep(effort) {
            break;
        }
        found = search.program();
    }
    if samples.agree(program, &found) { found } else { program.clone() }
}

/// What a value can be computed as.
#[derive(Clone, Copy, Debug)]
enum Form {
    /// A constant.
    Constant(f64),
    /// ± a value.
    Equal(Value, bool),
    /// A constant times a value.
    Multiple(f64, Value),
    /// A value plus a constant times another.
    SumMultiple(Value, f64, Value),
    /// ± the first ± the second.
    Sum((Value, bool), (Value, bool)),
    /// ± the product.
    Product(Value, Value, bool),
}

impl Form {
    fn operands(self) -> Operands {
        match self {
            Form::Constant(_) => Operands::default(),
            Form::Equal(a, _) | Form::Multiple(_, a) => [a].into_iter().collect(),
            Form::Sum((a, _), (b, _)) | Form::Product(a, b, _) | Form::SumMultiple(a, _, b) => {
                [a, b].into_iter().collect()
            }
        }
    }

    fn cost(self) -> usize {
        match self {
            Form::Constant(_) | Form::Equal(..) => 0,
            Form::Multiple(..) | Form::Sum(..) | Form::Product(..) => 1,
            Form::SumMultiple(..) => 2,
        }
    }

    fn build(self, builder: &mut Builder, at: impl Fn(Value) -> Value) -> Value {
        let negate = |negative: bool, value: Value, builder: &mut Builder| {
            if negative { builder.neg(value) } else { value }
        };
        match self {
            Form::Constant(constant) => builder.constant(constant),
            Form::Equal(a, negative) => negate(negative, at(a), builder),
            Form::Multiple(constant, a) => {
                let constant = builder.constant(constant);
                builder.mul(constant, at(a))
            }
            Form::SumMultiple(a, constant, b) => {
                let constant = builder.constant(constant);
                let product = builder.mul(constant, at(b));
                builder.add(at(a), product)
            }
            Form::Sum((a, minus_a), (b, minus_b)) => {
                let (a, b) = (negate(minus_a, at(a), builder), negate(minus_b, at(b), builder));
                builder.add(a, b)
            }
            Form::Product(a, b, negative) => {
                let product = builder.mul(at(a), at(b));
                negate(negative, product, builder)
            }
        }
    }
}

/// One sweep over the values of a program.
struct Search<'p> {
    program: &'p Program,
    cones: Cones,
    forms: Vec<Option<Form>>,
    samples: Vec<Sample>,
    /// The values that forms may use.
    operands: Vec<Value>,
    /// They by their size at the first point.
    by_size: FxHashMap<u64, Vec<Value>>,
    /// Those known at calls by the quotient of their first two points, which multiples share.
    by_direction: FxHashMap<u64, Vec<Value>>,
}

impl<'p> Search<'p> {
    fn new(program: &'p Program, samples: &Samples) -> Search<'p> {
        let samples = samples.of(program);
        let cones = Cones::new(program);
        let mut operands = vec![];
        let mut by_size: FxHashMap<u64, Vec<Value>> = FxHashMap::default();
        let mut by_direction: FxHashMap<u64, Vec<Value>> = FxHashMap::default();
        for (value, operation) in program.values() {
            let sample = &samples[value.index()];
            if matches!(operation, Operation::Constant(_) | Operation::Neg(_))
                || !sample.is_regular()
            {
                continue;
            }
            operands.push(value);
            by_size.entry(key(sample.value(0))).or_default().push(value);
            if !cones.is_early(value) {
                let direction = key(sample.value(1) / sample.value(0));
                by_direction.entry(direction).or_default().push(value);
            }
        }
        let forms = vec![None; samples.len()];
        Search { program, cones, forms, samples, operands, by_size, by_direction }
    }

    /// Visits the values, those that most depends on first; whether any was replaced.
    fn sweep(&mut self, effort: Resubstitution) -> bool {
        let mut order: Vec<(usize, Value)> =
            self.program.values().map(|(value, _)| (self.cones.size(value), value)).collect();
        order.sort_by_key(|(size, value)| std::cmp::Reverse((*size, *value)));
        let mut changed = false;
        for (_, value) in order {
            let room = self.cones.size(value);
            if room == 0 {
                continue;
            }
            let mut best = Best { gain: 0, form: None };
            self.try_multiples(value, room, &mut best);
            if room > 1 && best.form.is_none() && effort == Resubstitution::Pairs {
                self.try_pairs(value, room, &mut best);
            }
            if let Some(form) = best.form {
                self.cones.replace(value, form.operands(), form.cost());
                self.forms[value.index()] = Some(form);
                changed = true;
            }
        }
        changed
    }

    /// Constants, equal values, multiples by constants or by what parameters alone decide.
    fn try_multiples(&self, value: Value, room: usize, best: &mut Best) {
        let sample = &self.samples[value.index()];
        if sample.is_constant() {
            self.offer(value, Form::Constant(sample.mean()), best);
            return;
        }
        if !sample.is_regular() {
            return;
        }
        for (other, negative) in self.equal_to(sample) {
            self.offer(value, Form::Equal(other, negative), best);
        }
        if room < 2 || best.form.is_some() {
            return;
        }
        let direction = key(sample.value(1) / sample.value(0));
        for other in near(&self.by_direction, direction) {
            if let Some(ratio) = sample.ratio(&self.samples[other.index()]) {
                if ratio.is_constant() {
                    self.offer(value, Form::Multiple(ratio.mean(), other), best);
                } else {
                    for (factor, negative) in self.equal_to(&ratio) {
                        if self.cones.is_early(factor) {
                            self.offer(value, Form::Product(factor, other, negative), best);
                        }
                    }
                }
            }
        }
    }

    /// Sums and products of two.
    fn try_pairs(&self, value: Value, room: usize, best: &mut Best) {
        let sample = &self.samples[value.index()];
        if !sample.is_regular() {
            return;
        }
        for first in self.operands.iter().copied().filter(|first| *first != value) {
            let other = &self.samples[first.index()];
            // Most have no partner: the first points show that at once.
            let [x, y] = [0, 1].map(|point| (sample.value(point), other.value(point)));
            if other.rounding() <= GROWTH * sample.rounding() {
                for negative in [false, true] {
                    let rest = |(a, b): (f64, f64)| if negative { a + b } else { a - b };
                    let direction = key(rest(y) / rest(x));
                    if has_near(&self.by_size, key(rest(x)))
                        || (room > 2 && has_near(&self.by_direction, direction))
                    {
                        self.try_sums(value, (first, negative), room, best);
                    }
                }
            }
            if has_near(&self.by_size, key(x.0 / x.1)) {
                for (second, minus) in self.equal_to(&sample.over(other)) {
                    self.offer(value, Form::Product(first, second, minus), best);
                }
            }
        }
    }

    /// Sums of one value and another or its multiple.
    fn try_sums(&self, value: Value, first: (Value, bool), room: usize, best: &mut Best) {
        let sample = &self.samples[value.index()];
        let rest = sample.minus(&self.samples[first.0.index()], first.1);
        // A sum of much larger values would round more than what it replaces.
        let grows = |value: Value, factor: f64| {
            self.samples[value.index()].rounding() * factor > GROWTH * sample.rounding()
        };
        for (second, minus) in self.equal_to(&rest) {
            let both_negative = first.1 && minus;
            if !both_negative && !grows(second, 1.0) {
                self.offer(value, Form::Sum(first, (second, minus)), best);
            }
        }
        if room > 2 && !first.1 && rest.is_regular() {
            let direction = key(rest.value(1) / rest.value(0));
            for other in near(&self.by_direction, direction) {
                if let Some(ratio) = rest.ratio(&self.samples[other.index()])
                    && ratio.is_constant()
                    && !grows(other, ratio.mean().abs())
                {
                    let form = Form::SumMultiple(first.0, ratio.mean(), other);
                    self.offer(value, form, best);
                }
            }
        }
    }

    /// The values that equal ± a sample.
    fn equal_to(&self, sample: &Sample) -> impl Iterator<Item = (Value, bool)> {
        near(&self.by_size, key(sample.value(0))).filter_map(|value| {
            let negative = sample.equals(&self.samples[value.index()])?;
            Some((value, negative))
        })
    }

    /// Takes a form where it saves more than the best so far and does not need the value itself.
    fn offer(&self, value: Value, form: Form, best: &mut Best) {
        let operands = form.operands();
        let gain = self.cones.gain(value, &operands, form.cost());
        if gain > best.gain && !self.cones.depend_on(&operands, value) {
            *best = Best { gain, form: Some(form) };
        }
    }

    /// The program with the forms in the place of the values.
    fn program(&self) -> Program {
        let mut builder = Builder::new();
        let mut built: Vec<Option<Value>> = vec![None; self.forms.len()];
        let mut pending: Vec<Value> = self.program.results().to_vec();
        pending.reverse();
        while let Some(value) = pending.last().copied() {
            let operands = self.cones.operands(value);
            let missing: Vec<Value> =
                operands.iter().copied().filter(|a| built[a.index()].is_none()).collect();
            if built[value.index()].is_none() && !missing.is_empty() {
                pending.extend(missing.into_iter().rev());
                continue;
            }
            pending.pop();
            if built[value.index()].is_none() {
                let at = |operand: Value| built[operand.index()].unwrap_or(operand);
                let new = match self.forms[value.index()] {
                    Some(form) => form.build(&mut builder, at),
                    None => builder.apply(self.program.operation(value).map(at)),
                };
                built[value.index()] = Some(new);
            }
        }
        let results = self.program.results().iter();
        let results = results.map(|result| built[result.index()].unwrap_or(*result));
        super::dead_code::run(&builder.finish(results.collect()))
    }
}

/// The best form so far.
struct Best {
    gain: usize,
    form: Option<Form>,
}

/// The leading 30 bits of a number's size.
fn key(value: f64) -> u64 {
    value.abs().to_bits() >> 22
}

fn has_near(table: &FxHashMap<u64, Vec<Value>>, key: u64) -> bool {
    near(table, key).next().is_some()
}

/// What a table has under a key and its neighbours, for rounding may cross the border.
fn near(table: &FxHashMap<u64, Vec<Value>>, key: u64) -> impl Iterator<Item = Value> + '_ {
    let keys = [key, key.wrapping_sub(1), key.wrapping_add(1)];
    keys.into_iter().filter_map(|key| table.get(&key)).flatten().copied()
}

#[cfg(test)]
mod tests {
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
        assert_eq!(
            Counts::of_calls(&found).operations(),
            Counts::of_calls(&program).operations() - 2
        );
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
}
