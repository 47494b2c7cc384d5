//! By what values are divided.

use std::rc::Rc;

use robot_symbolic::Function;

use crate::program::{Operation, Program, Value};

/// For each value of a program, the set of divisors that its computation has.
pub(super) struct Divisors {
    /// The divisors, in the order of the program.
    divisors: Vec<Value>,
    /// For each value, a bit for each divisor.
    sets: Vec<Rc<[u64]>>,
}

impl Divisors {
    pub(super) fn new(program: &Program) -> Divisors {
        let mut divisors: Vec<Value> = vec![];
        let mut numbers = vec![None; program.operations().len()];
        let mut sets: Vec<Rc<[u64]>> = Vec::with_capacity(numbers.len());
        for (_, operation) in program.values() {
            let mut set: Rc<[u64]> = Rc::from([]);
            for operand in operation.operands() {
                set = union(&set, &sets[operand.index()]);
            }
            if let Some(divisor) = divisor(program, operation) {
                let number = *numbers[divisor.index()].get_or_insert_with(|| {
                    divisors.push(divisor);
                    divisors.len() - 1
                });
                let mut bits = vec![0; number / 64 + 1];
                bits[number / 64] = 1 << (number % 64);
                set = union(&set, &Rc::from(bits));
            }
            sets.push(set);
        }
        Divisors { divisors, sets }
    }

    /// The divisors of a value.
    pub(super) fn of(&self, value: Value) -> Vec<Value> {
        self.chosen(|index| bits(&self.sets[value.index()], index))
    }

    /// The divisors of others that a value does not have.
    pub(super) fn added(&self, value: Value, others: &[Value]) -> Vec<Value> {
        let own = &self.sets[value.index()];
        if others.iter().all(|other| is_subset(&self.sets[other.index()], own)) {
            return vec![];
        }
        let all = |index| others.iter().fold(0, |all, a| all | bits(&self.sets[a.index()], index));
        self.chosen(|index| all(index) & !bits(own, index))
    }

    /// The divisors whose bits are set in the words that `word` returns.
    fn chosen(&self, word: impl Fn(usize) -> u64) -> Vec<Value> {
        let is_chosen = |number: usize| word(number / 64) >> (number % 64) & 1 == 1;
        let all = self.divisors.iter().copied().enumerate();
        all.filter(|(number, _)| is_chosen(*number)).map(|(_, divisor)| divisor).collect()
    }
}

/// Returns the value by which an operation divides, unless it is a number.
fn divisor(program: &Program, operation: Operation) -> Option<Value> {
    let divisor = match operation {
        Operation::Div(_, divisor) | Operation::Call(Function::RecipPositive, divisor) => divisor,
        _ => return None,
    };
    let is_number = matches!(program.operation(divisor), Operation::Constant(_));
    (!is_number).then_some(divisor)
}

fn bits(set: &[u64], index: usize) -> u64 {
    set.get(index).copied().unwrap_or(0)
}

fn is_subset(set: &[u64], of: &[u64]) -> bool {
    (0..set.len()).all(|index| bits(set, index) & !bits(of, index) == 0)
}

/// Returns the union of two sets; if one contains the other, without a copy.
fn union(a: &Rc<[u64]>, b: &Rc<[u64]>) -> Rc<[u64]> {
    if is_subset(b, a) {
        return a.clone();
    }
    if is_subset(a, b) {
        return b.clone();
    }
    (0..a.len().max(b.len())).map(|index| bits(a, index) | bits(b, index)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::{Builder, Source};

    /// With 70 divisors, sets have two words.
    #[test]
    fn sets_contain_the_divisors_of_their_operands() {
        let mut b = Builder::new();
        let x = b.load(Source::Input(0));
        let loads: Vec<Value> = (1..=70).map(|index| b.load(Source::Input(index))).collect();
        let quotients: Vec<Value> = loads.iter().map(|divisor| b.div(x, *divisor)).collect();
        let both = b.add(quotients[0], quotients[69]);
        let square = b.mul(both, quotients[0]);
        let three = b.constant(3.0);
        let third = b.div(x, three);
        let reciprocal = b.call(Function::RecipPositive, x);
        let mut results = quotients.clone();
        results.extend([square, third, reciprocal]);
        let divisors = Divisors::new(&b.finish(results));
        assert_eq!(divisors.of(square), [loads[0], loads[69]]);
        assert_eq!([divisors.of(third), divisors.of(loads[0])], [vec![], vec![]]);
        assert_eq!(divisors.added(square, &[quotients[0], quotients[69], both, x, third]), []);
        assert_eq!(divisors.added(both, &[square]), []);
        assert_eq!(divisors.added(square, &[quotients[1], x, reciprocal]), [loads[1], x]);
        assert_eq!(divisors.added(quotients[0], &[both]), [loads[69]]);
        assert_eq!(divisors.added(quotients[69], &[both, quotients[0]]), [loads[0]]);
        assert_eq!(divisors.added(third, &[]), []);
    }
}
