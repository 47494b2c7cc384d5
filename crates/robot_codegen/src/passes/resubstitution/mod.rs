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
//! which pairs share the values of parameters, so that even if parameters alone decide, three are
//! left: 10⁻⁴⁵, times the millions of pairs that are compared. If that rounding may be large, as in
//! long recursions, whose bounds grow with each joint, agreement is not evidence, and nothing is replaced.
//! But the points are fixed, the same for every program, and values of one program are not unrelated; no
//! bound follows for them. The results are therefore compared once more at other points, and what code
//! computes is held against independent solvers by the tests.
//!
//! Absolute values, signs and roots are taken for unrelated numbers, so that nothing follows from the
//! sign that an argument happens to have at the points.

mod cones;
mod samples;
#[cfg(test)]
mod tests;

use rustc_hash::FxHashMap;

use self::cones::{Cones, Operands};
use self::samples::Sample;
pub(crate) use self::samples::Samples;
use super::Resubstitution;
use crate::program::{Builder, Operation, Program, Value};

/// Rounds after which the search ends, improved or not.
const ROUNDS: usize = 8;
/// The largest rounding of a sum relative to that of the value it replaces.
const GROWTH: f64 = 4.0;

/// Replaces values by multiples of others, and with [`Resubstitution::Pairs`] by sums and products
/// of two, if that saves operations. Reassociates.
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

/// A form that a value can be computed in.
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
    /// The values known at calls, by the quotient of their first two points, which multiples have in common.
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

    /// Takes a form if it saves more than the best so far and does not need the value itself.
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

/// The entries of a table under a key and its neighbors, because rounding may cross the border.
fn near(table: &FxHashMap<u64, Vec<Value>>, key: u64) -> impl Iterator<Item = Value> + '_ {
    let keys = [key, key.wrapping_sub(1), key.wrapping_add(1)];
    keys.into_iter().filter_map(|key| table.get(&key)).flatten().copied()
}
