//! Resubstitution: a value that equals a multiple of another computed value, or the sum or product of two of them,
//! is computed from these.
//!
//! The other passes use the operations of a program; this one uses its values at sample points, in twice the precision
//! of `f64`. So it finds relations that do not follow from any rule: terms that vanish, moments that are parallel,
//! squares of a vector's length before and after a rotation. The technique comes from logic synthesis (Brayton, Hachtel
//! and Sangiovanni-Vincentelli 1990) and is applied to numbers here.
//!
//! A replacement must agree with the replaced value at every point, to within the rounding error of the
//! replaced evaluation. That is evidence, not a proof. Two unrelated numbers near 1 agree to within such a
//! tolerance with a probability of about 10⁻¹⁵. There are six points, in pairs with the same values of the
//! parameters, so that three are left even for values that depend only on parameters: 10⁻⁴⁵, times the millions
//! of pairs that are compared. If the rounding error can be large, as in long recursions, where its bound grows with
//! each joint, agreement is not evidence, and nothing is replaced. This estimate is not a bound: the points are the
//! same for every program, and the values of one program are not unrelated. The results are therefore compared
//! again at other points, and tests compare the results of generated code with independent solvers.
//!
//! A term far below the rounding error of the sum that it is in would not be noticed, but counts if the other terms can
//! be as small: τ − 2·10⁻¹⁷ cos q for a robot of micrograms. So values are also compared as polynomials in the inputs
//! and parameters, coefficient by coefficient (`parts`).
//!
//! A replacement divides by nothing but the divisors of the replaced value, and factors of them: z a is not computed
//! as (z/x) (x a), which is NaN where x is 0 (`divisors`).
//!
//! Absolute values, signs and roots are treated as unrelated numbers, so that nothing is concluded from the
//! sign that an argument happens to have at the points.

mod cones;
mod divisors;
mod parts;
mod samples;
#[cfg(test)]
mod tests;

use rustc_hash::FxHashMap;

use self::cones::{Cones, Operands};
use self::divisors::Divisors;
use self::parts::Parts;
use self::samples::Sample;
pub(crate) use self::samples::Samples;
use super::Resubstitution;
use crate::program::{Builder, Operation, Program, Value};

/// The most rounds of the search.
const ROUNDS: usize = 8;
/// The largest rounding error of a term of a sum, relative to that of the value that the sum replaces.
const GROWTH: f64 = 4.0;

/// Replaces values with multiples of others, and with [`Resubstitution::Pairs`] also with sums and products
/// of two others, if that saves operations. This pass reassociates.
#[must_use]
pub(crate) fn run(program: &Program, samples: &Samples, effort: Resubstitution) -> Program {
    let mut found = super::dead_code::run(program);
    let rounds = if effort == Resubstitution::Off { 0 } else { ROUNDS };
    for _ in 0..rounds {
        let mut search = Search::new(&found, samples);
        if !search.sweep(effort) {
            break;
        }
        found = search.program();
    }
    if samples.agree(program, &found) { found } else { program.clone() }
}

/// A form in which a value can be computed.
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
    /// ± the product of two values.
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
    parts: Parts,
    divisors: Divisors,
    /// The values that forms may use.
    operands: Vec<Value>,
    /// The operands by their absolute value at the first point.
    by_size: FxHashMap<u64, Vec<Value>>,
    /// The operands known at a call, by the quotient of their values at the first two points, which is the same for
    /// multiples.
    by_direction: FxHashMap<u64, Vec<Value>>,
}

impl<'p> Search<'p> {
    fn new(program: &'p Program, samples: &Samples) -> Search<'p> {
        let parts = samples.parts(program);
        let samples = samples.of(program);
        let cones = Cones::new(program);
        let divisors = Divisors::new(program);
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
        Search { program, cones, forms, samples, parts, divisors, operands, by_size, by_direction }
    }

    /// Visits the values, first those whose removal would remove the most operations; returns whether any was replaced.
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

    /// Tries constants, equal values, and multiples by constants or by values that depend only on parameters.
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

    /// Tries sums and products of two values.
    fn try_pairs(&self, value: Value, room: usize, best: &mut Best) {
        let sample = &self.samples[value.index()];
        if !sample.is_regular() {
            return;
        }
        for first in self.operands.iter().copied().filter(|first| *first != value) {
            let other = &self.samples[first.index()];
            // Most values have no partner, which the first two points show quickly.
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

    /// Tries sums of one value and another, or a multiple of another.
    fn try_sums(&self, value: Value, first: (Value, bool), room: usize, best: &mut Best) {
        let sample = &self.samples[value.index()];
        let rest = sample.minus(&self.samples[first.0.index()], first.1);
        // A sum of much larger values would round more than the value that it replaces.
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

    /// Returns the values that equal a sample or its negative.
    fn equal_to(&self, sample: &Sample) -> impl Iterator<Item = (Value, bool)> {
        near(&self.by_size, key(sample.value(0))).filter_map(|value| {
            let negative = sample.equals(&self.samples[value.index()])?;
            Some((value, negative))
        })
    }

    /// Takes a form as the best one if it saves more than the best so far and does not depend on the value itself.
    fn offer(&self, value: Value, form: Form, best: &mut Best) {
        let operands = form.operands();
        let gain = self.cones.gain(value, &operands, form.cost());
        if gain > best.gain
            && !self.cones.depend_on(&operands, value)
            && self.has_the_divisors(value, &operands)
            && self.parts.agree(value, form)
        {
            *best = Best { gain, form: Some(form) };
        }
    }

    /// Whether a value is divided by every divisor of these operands, or by a multiple of it.
    fn has_the_divisors(&self, value: Value, operands: &[Value]) -> bool {
        let is_multiple = |own: Value, divisor: Value| {
            let factor = self.samples[own.index()].over(&self.samples[divisor.index()]);
            let mut factors = self.equal_to(&factor);
            factor.is_constant()
                || factors.any(|(factor, _)| self.divisors.added(value, &[factor]).is_empty())
        };
        let has = |divisor: Value| {
            self.divisors.of(value).into_iter().any(|own| is_multiple(own, divisor))
        };
        self.divisors.added(value, operands).into_iter().all(has)
    }

    /// Builds the program in which the values are replaced with their forms.
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

/// Returns the leading 30 bits of a number, without its sign.
fn key(value: f64) -> u64 {
    value.abs().to_bits() >> 22
}

fn has_near(table: &FxHashMap<u64, Vec<Value>>, key: u64) -> bool {
    near(table, key).next().is_some()
}

/// Returns the entries of a table with this key and the two next to it, because rounding can change the key by one.
fn near(table: &FxHashMap<u64, Vec<Value>>, key: u64) -> impl Iterator<Item = Value> + '_ {
    let keys = [key, key.wrapping_sub(1), key.wrapping_add(1)];
    keys.into_iter().filter_map(|key| table.get(&key)).flatten().copied()
}
