//! How many operations depend on a value alone.

use std::cell::RefCell;

use crate::program::{Operation, Program, Stage, Value};

/// The operations of a program under replacement, with their uses.
pub(super) struct Cones {
    operands: Vec<Vec<Value>>,
    costs: Vec<usize>,
    early: Vec<bool>,
    /// How often what is needed uses each value. The queries change it and change it back.
    uses: RefCell<Vec<usize>>,
}

impl Cones {
    pub(super) fn new(program: &Program) -> Cones {
        let early: Vec<bool> = program.stages().iter().map(|stage| *stage < Stage::Call).collect();
        let cost = |(value, operation): (Value, Operation)| {
            let free = operation.is_leaf() || matches!(operation, Operation::Neg(_));
            usize::from(!free && !early[value.index()])
        };
        Cones {
            operands: program.values().map(|(_, op)| op.operands().collect()).collect(),
            costs: program.values().map(cost).collect(),
            uses: RefCell::new(program.uses().into_iter().map(|uses| uses as usize).collect()),
            early,
        }
    }

    /// Whether a value is known before the call.
    pub(super) fn is_early(&self, value: Value) -> bool {
        self.early[value.index()]
    }

    /// What a value is computed from.
    pub(super) fn operands(&self, value: Value) -> &[Value] {
        &self.operands[value.index()]
    }

    /// The operations that would go if the value were not needed.
    pub(super) fn size(&self, value: Value) -> usize {
        self.gain(value, &[], 0)
    }

    /// The operations that would go if the value were computed from other operands at a cost; 0
    /// where none would.
    pub(super) fn gain(&self, value: Value, operands: &[Value], cost: usize) -> usize {
        let mut uses = self.uses.borrow_mut();
        if uses[value.index()] == 0 {
            return 0;
        }
        let added: usize = operands.iter().map(|operand| self.hold(*operand, &mut uses)).sum();
        let inside = self.operands(value);
        let freed: usize = inside.iter().map(|operand| self.release(*operand, &mut uses)).sum();
        for operand in inside {
            self.hold(*operand, &mut uses);
        }
        for operand in operands {
            self.release(*operand, &mut uses);
        }
        (freed + self.costs[value.index()]).saturating_sub(added + cost)
    }

    /// Computes a value from other operands.
    pub(super) fn replace(&mut self, value: Value, operands: &[Value], cost: usize) {
        let mut uses = self.uses.borrow_mut();
        for operand in operands {
            self.hold(*operand, &mut uses);
        }
        for operand in self.operands(value) {
            self.release(*operand, &mut uses);
        }
        drop(uses);
        self.operands[value.index()] = operands.to_vec();
        self.costs[value.index()] = cost;
    }

    /// Whether any of some values depends on a value.
    pub(super) fn depend_on(&self, values: &[Value], value: Value) -> bool {
        let mut seen = vec![false; self.operands.len()];
        let mut pending = values.to_vec();
        while let Some(next) = pending.pop() {
            if next == value {
                return true;
            }
            if !std::mem::replace(&mut seen[next.index()], true) {
                pending.extend(self.operands(next));
            }
        }
        false
    }

    /// One use less; the cost of what nothing needs any more.
    fn release(&self, value: Value, uses: &mut [usize]) -> usize {
        let (mut pending, mut cost) = (vec![value], 0);
        while let Some(value) = pending.pop() {
            uses[value.index()] -= 1;
            if uses[value.index()] == 0 {
                cost += self.costs[value.index()];
                pending.extend(self.operands(value));
            }
        }
        cost
    }

    /// One use more; the cost of what was not needed before.
    fn hold(&self, value: Value, uses: &mut [usize]) -> usize {
        let (mut pending, mut cost) = (vec![value], 0);
        while let Some(value) = pending.pop() {
            uses[value.index()] += 1;
            if uses[value.index()] == 1 {
                cost += self.costs[value.index()];
                pending.extend(self.operands(value));
            }
        }
        cost
    }
}
