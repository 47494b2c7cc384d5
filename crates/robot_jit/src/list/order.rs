//! The order of the steps of a list, which does not affect the bits of results.

use super::{Id, Instruction, List, Step};

/// The values that a step uses, each once.
#[inline]
pub(crate) fn operands(step: Step) -> impl Iterator<Item = Id> {
    let (mut found, mut count) = ([Id::at(0); 3], 0);
    let mut add = |value: Id| {
        if !found[..count].contains(&value) {
            found[count] = value;
            count += 1;
        }
    };
    match step {
        Step::Store(value, _) => add(value),
        Step::StorePair(a, b, _) => [a, b].into_iter().for_each(add),
        Step::Value(instruction) => match instruction {
            Instruction::Home(_) => {}
            Instruction::Sqrt(a)
            | Instruction::ShiftLeft(a, _)
            | Instruction::SpreadSign(a)
            | Instruction::Second(a)
            | Instruction::Upper(a) => add(a),
            Instruction::Binary(_, a, b) | Instruction::Pair(a, b) | Instruction::Join(a, b) => {
                [a, b].into_iter().for_each(add);
            }
            Instruction::MulAdd(a, b, c) => [a, b, c].into_iter().for_each(add),
        },
    }
    found.into_iter().take(count)
}

/// For each step, whether a stored value depends on it.
pub(crate) fn needed(list: &List) -> Vec<bool> {
    let mut needed = vec![false; list.steps.len()];
    for (position, step) in list.steps.iter().enumerate().rev() {
        needed[position] |= step.is_store();
        if needed[position] {
            operands(*step).for_each(|value| needed[value.index()] = true);
        }
    }
    needed
}

impl List {
    /// Whether a value is in memory, so that it does not need a register before it is used.
    pub(super) fn is_home(&self, value: Id) -> bool {
        matches!(self.steps[value.index()], Step::Value(Instruction::Home(_)))
    }

    /// Returns the list of the steps at these positions, which must be ordered so that each is after its operands.
    pub(super) fn in_order(&self, order: &[usize]) -> List {
        let mut moved = vec![None; self.steps.len()];
        let mut list = List::default();
        for position in order {
            // Operands come first, so that all have been moved.
            let at = |id: Id| moved[id.index()].unwrap_or(id);
            let step = match self.steps[*position] {
                Step::Store(value, entry) => Step::Store(at(value), entry),
                Step::StorePair(a, b, entry) => Step::StorePair(at(a), at(b), entry),
                Step::Value(instruction) => Step::Value(instruction.map(at)),
            };
            moved[*position] = Some(list.push(step, self.wide[*position]));
        }
        list
    }

    /// Orders the steps depth first from the stores, so that values are alive for a short time. Of the operands, the
    /// one that needs more registers comes first (R. Sethi and J. D. Ullman, "The generation of optimal code for
    /// arithmetic expressions", J. ACM 17(4), 1970).
    pub(crate) fn depth_first(&self) -> List {
        let registers = self.registers();
        let mut done = vec![false; self.steps.len()];
        let (mut order, mut pending) = (vec![], vec![]);
        for (position, step) in self.steps.iter().enumerate() {
            if step.is_store() {
                pending.push(position);
            }
            while let Some(top) = pending.last().copied() {
                let waiting = pending.len();
                if !done[top] {
                    let missing = operands(self.steps[top]).map(Id::index);
                    pending.extend(missing.filter(|operand| !done[*operand]));
                }
                if pending.len() > waiting {
                    // The last of `pending` is taken first.
                    pending[waiting..].sort_by_key(|operand| registers[*operand]);
                } else {
                    pending.pop();
                    if !done[top] {
                        done[top] = true;
                        order.push(top);
                    }
                }
            }
        }
        self.in_order(&order)
    }

    /// Returns the number of registers that each value would need if no values were shared.
    fn registers(&self) -> Vec<u32> {
        let mut registers: Vec<u32> = Vec::with_capacity(self.steps.len());
        for (position, step) in self.steps.iter().enumerate() {
            let mut needs = [0; 3];
            for (need, value) in needs.iter_mut().zip(operands(*step)) {
                *need = registers[value.index()];
            }
            needs.sort_unstable_by(|a, b| b.cmp(a));
            let most = needs.iter().zip(0..).map(|(need, held)| need + held.min(*need)).max();
            let own = u32::from(!self.is_home(Id::at(position)));
            registers.push(most.unwrap_or_default().max(own));
        }
        registers
    }
}
