//! Register allocation.
//!
//! A list has no branches, so it is known when each value is needed next. If a register is needed, the value in
//! registers whose next use is farthest away is removed (L. A. Belady, "A study of replacement algorithms for a
//! virtual-storage computer", IBM Systems Journal 5(2), 1966); it is stored unless it is in memory already.

use super::encoder::{Bytes, Form, Memory, Operand};
use crate::list::{Binary, Home, Id, Instruction, List, Step, needed, operands};

const NEVER: u32 = u32::MAX;
const NOWHERE: u8 = u8::MAX;
/// A value whose last use is within this number of steps gets a low register, which has shorter encodings.
const SOON: u32 = 30;

/// The uses of values that are still to come while the list is emitted.
struct Uses {
    /// The positions of the steps that use the first value, in ascending order, then those that use the second, and so
    /// on.
    steps: Vec<u32>,
    /// For each value, the place in `steps` of its next use, and the place after its last use. They are equal if no use
    /// is to come.
    next: Vec<(u32, u32)>,
}

impl Uses {
    /// Finds the uses by steps on which a stored value depends, and for each step whether it is one of these.
    fn new(list: &List) -> (Uses, Vec<bool>) {
        let needed = needed(list);
        let mut next = vec![(0, 0); list.steps.len()];
        for (_, step) in list.steps.iter().enumerate().filter(|(at, _)| needed[*at]) {
            operands(*step).for_each(|value| next[value.index()].1 += 1);
        }
        let mut start = 0;
        for (first, end) in &mut next {
            let length = *end;
            (*first, *end) = (start, start);
            start += length;
        }
        let mut steps = vec![0; start as usize];
        for (position, step) in list.steps.iter().enumerate().filter(|(at, _)| needed[*at]) {
            for value in operands(*step) {
                let end = &mut next[value.index()].1;
                steps[*end as usize] = position as u32;
                *end += 1;
            }
        }
        (Uses { steps, next }, needed)
    }

    /// The position of the next step that uses a value, or [`NEVER`].
    fn next(&self, value: Id) -> u32 {
        let (at, end) = self.next[value.index()];
        if at < end { self.steps[at as usize] } else { NEVER }
    }

    /// The position of the last step that uses a value, or [`NEVER`] if no use is to come.
    fn last(&self, value: Id) -> u32 {
        let (at, end) = self.next[value.index()];
        if at < end { self.steps[end as usize - 1] } else { NEVER }
    }

    /// The position of the step that uses a value once more after its next use, or [`NEVER`]. While a step is emitted,
    /// the next use of its operands is this step itself.
    fn after(&self, value: Id) -> u32 {
        let (at, end) = self.next[value.index()];
        if at + 1 < end { self.steps[at as usize + 1] } else { NEVER }
    }
}

/// A place in the working memory that becomes free.
struct Freed {
    slot: u32,
    wide: bool,
}

struct Body<'a> {
    list: &'a List,
    bytes: &'a mut Bytes,
    uses: Uses,
    /// For each value, its register.
    register: Vec<u8>,
    /// For each value, its place in the working memory if it was spilled.
    slot: Vec<Option<u32>>,
    /// For each register, its value.
    value: Vec<Option<Id>>,
    /// The free places in the working memory: those for other values, and those for wide values.
    free_slots: [Vec<u32>; 2],
    /// The size of the working memory, in numbers.
    working: u32,
    /// The index of the current step.
    position: u32,
}

/// Appends the code of a list; returns the size of its working memory, in numbers.
pub(super) fn emit(list: &List, bytes: &mut Bytes) -> u32 {
    let (uses, needed) = Uses::new(list);
    let count = list.steps.len();
    let value = vec![None; bytes.shape.vectors.count()];
    let mut body = Body {
        list,
        bytes,
        uses,
        register: vec![NOWHERE; count],
        slot: vec![None; count],
        value,
        free_slots: [vec![], vec![]],
        working: 0,
        position: 0,
    };
    for (position, step) in list.steps.iter().enumerate() {
        body.bytes.widen(list.wide[position]);
        body.position = position as u32;
        match step {
            _ if !needed[position] => {}
            Step::Value(Instruction::Home(_)) => {}
            Step::Value(instruction) => body.compute(Id::at(position), *instruction),
            Step::Store(value, target) => {
                let from = body.loaded(*value, &[]);
                body.bytes.store(*target, from);
                let freed = body.release(&[*value]);
                body.free_slot(freed);
            }
            Step::StorePair(a, b, target) => {
                let (pair, freed) = body.paired(*a, *a, *b);
                body.bytes.store_pair(*target, pair);
                body.free_slot(freed);
            }
        }
    }
    body.working
}

impl Body<'_> {
    fn held(&self, value: Id) -> Option<u8> {
        let register = self.register[value.index()];
        (register != NOWHERE).then_some(register)
    }

    fn home(&self, value: Id) -> Option<Home> {
        match self.list.steps[value.index()] {
            Step::Value(Instruction::Home(home)) => Some(home),
            _ => None,
        }
    }

    /// The place in memory of a value that is not in a register.
    fn memory(&self, value: Id) -> Memory {
        match (self.home(value), self.slot[value.index()]) {
            (Some(home), _) => Memory::Home(home),
            // A value that was removed from its register has a slot.
            (None, slot) => Memory::Spill(slot.unwrap_or_default()),
        }
    }

    fn is_constant(&self, value: Id) -> bool {
        matches!(self.home(value), Some(Home::Constant(_)))
    }

    fn dies(&self, value: Id) -> bool {
        self.uses.after(value) == NEVER
    }

    fn bind(&mut self, value: Id, register: u8) {
        self.register[value.index()] = register;
        self.value[usize::from(register)] = Some(value);
    }

    /// Returns the register whose value has the farthest next use, and this use; registers of `kept` are excluded.
    fn farthest(&self, kept: &[Id]) -> (u8, u32) {
        let mut best = (0, 0);
        for (register, value) in self.value.iter().enumerate() {
            let next = match value {
                Some(value) if kept.contains(value) => continue,
                Some(value) => self.uses.next(*value),
                None => NEVER,
            };
            if next > best.1 {
                best = (register as u8, next);
            }
        }
        best
    }

    /// Returns a free register, if there is one: a low one for a value whose last use is near.
    fn free(&self, value: Id) -> Option<u8> {
        let mut free = (0..self.value.len()).filter(|register| self.value[*register].is_none());
        let is_soon = self.uses.last(value).saturating_sub(self.position) <= SOON;
        let register = if is_soon { free.next() } else { free.next_back() };
        register.map(|register| register as u8)
    }

    /// Returns a free register. If there is none, clears one, except those with values of `kept`.
    fn vacant(&mut self, value: Id, kept: &[Id]) -> u8 {
        if let Some(register) = self.free(value) {
            return register;
        }
        let (register, _) = self.farthest(kept);
        if let Some(value) = self.value[usize::from(register)].take() {
            self.register[value.index()] = NOWHERE;
            if self.home(value).is_none() && self.slot[value.index()].is_none() {
                let slot = self.new_slot(value);
                self.slot[value.index()] = Some(slot);
                self.for_value(value, |bytes| bytes.spill(slot, register));
            }
        }
        register
    }

    fn new_slot(&mut self, value: Id) -> u32 {
        let wide = self.list.wide[value.index()];
        self.free_slots[usize::from(wide)].pop().unwrap_or_else(|| {
            let numbers = self.bytes.numbers(wide);
            // Aligned, so that no stored register crosses a cache line.
            let slot = self.working.next_multiple_of(numbers);
            self.working = slot + numbers;
            slot
        })
    }

    /// Appends instructions on a value with its own width, which can differ from that of the current instruction.
    fn for_value(&mut self, value: Id, then: impl FnOnce(&mut Bytes)) {
        let shape = self.bytes.shape;
        self.bytes.widen(self.list.wide[value.index()]);
        then(self.bytes);
        self.bytes.shape = shape;
    }

    fn free_slot(&mut self, freed: [Option<Freed>; 3]) {
        for Freed { slot, wide } in freed.into_iter().flatten() {
            self.free_slots[usize::from(wide)].push(slot);
        }
    }

    /// Returns the register of a value, after loading it if necessary.
    fn loaded(&mut self, value: Id, kept: &[Id]) -> u8 {
        if let Some(register) = self.held(value) {
            return register;
        }
        let register = self.vacant(value, kept);
        let memory = self.memory(value);
        self.for_value(value, |bytes| bytes.load(register, memory));
        self.bind(value, register);
        register
    }

    /// Returns a value as an operand: in a register, or in memory if that is equally fast.
    fn operand(&mut self, value: Id, kept: &[Id], arithmetic: bool) -> Operand {
        if let Some(register) = self.held(value) {
            return Operand::Register(register);
        }
        let memory = self.memory(value);
        let later = || {
            self.value.iter().all(Option::is_some)
                && self.uses.after(value) >= self.farthest(kept).1
        };
        let stays = self.is_constant(value) || self.dies(value) || later();
        if stays && self.bytes.reads(memory, arithmetic) {
            return Operand::Memory(memory);
        }
        Operand::Register(self.loaded(value, kept))
    }

    /// Frees the registers of values that are not needed after this step; returns their slots, which are free after
    /// the step is encoded.
    fn release(&mut self, values: &[Id]) -> [Option<Freed>; 3] {
        let mut freed = [const { None }; 3];
        for (index, value) in values.iter().enumerate() {
            if values[..index].contains(value) {
                continue;
            }
            self.uses.next[value.index()].0 += 1;
            if self.uses.next(*value) == NEVER {
                if let Some(register) = self.held(*value) {
                    self.value[usize::from(register)] = None;
                    self.register[value.index()] = NOWHERE;
                }
                let wide = self.list.wide[value.index()];
                freed[index] = self.slot[value.index()].take().map(|slot| Freed { slot, wide });
            }
        }
        freed
    }

    /// Puts two values side by side in a register that suits `result`. Returns the register, which has no value yet,
    /// and the slots of operands that are not needed any more.
    fn paired(&mut self, result: Id, a: Id, b: Id) -> (u8, [Option<Freed>; 3]) {
        let kept = [a, b];
        let first = self.loaded(a, &kept);
        let second = self.operand(b, &kept, true);
        let freed = self.release(&kept);
        let to = self.vacant(result, &[]);
        self.bytes.pair(to, first, second);
        (to, freed)
    }

    fn compute(&mut self, result: Id, instruction: Instruction) {
        let freed = match instruction {
            Instruction::Home(_) => return,
            Instruction::Binary(binary, a, b) => self.binary(result, binary, a, b),
            Instruction::MulAdd(a, b, c) => self.multiply_add(result, a, b, c),
            Instruction::Pair(a, b) => {
                let (to, freed) = self.paired(result, a, b);
                self.bind(result, to);
                freed
            }
            Instruction::Join(a, b) => {
                let kept = [a, b];
                let [first, second] = kept.map(|value| self.loaded(value, &kept));
                let freed = self.release(&kept);
                let to = self.vacant(result, &[]);
                self.bytes.join(to, first, second);
                self.bind(result, to);
                freed
            }
            Instruction::Sqrt(a)
            | Instruction::ShiftLeft(a, _)
            | Instruction::SpreadSign(a)
            | Instruction::Second(a)
            | Instruction::Upper(a) => {
                let from = self.loaded(a, &[a]);
                let freed = self.release(&[a]);
                let to = self.vacant(result, &[]);
                match instruction {
                    Instruction::Sqrt(_) => self.bytes.sqrt(to, from),
                    Instruction::ShiftLeft(_, by) => self.bytes.shift_left(to, from, by),
                    Instruction::Second(_) => self.bytes.second(to, from),
                    Instruction::Upper(_) => self.bytes.upper(to, from),
                    _ => self.bytes.spread_sign(to, from),
                }
                self.bind(result, to);
                freed
            }
        };
        self.free_slot(freed);
    }

    /// Orders the operands of a sum or product so that the second can be read from memory.
    fn ordered(&self, a: Id, b: Id) -> (Id, Id) {
        let stays = |value| self.is_constant(value) || self.dies(value);
        match (self.held(a), self.held(b)) {
            (None, Some(_)) => (b, a),
            (None, None) if stays(a) && !self.is_constant(b) => (b, a),
            _ => (a, b),
        }
    }

    fn binary(&mut self, result: Id, binary: Binary, a: Id, b: Id) -> [Option<Freed>; 3] {
        let (a, b) = if binary.commutes() { self.ordered(a, b) } else { (a, b) };
        let kept = [a, b];
        let first = self.loaded(a, &kept);
        let second = self.operand(b, &kept, binary.is_arithmetic());
        let freed = self.release(&kept);
        let to = self.vacant(result, &[]);
        self.bytes.binary(binary, to, first, second);
        self.bind(result, to);
        freed
    }

    /// Appends a multiply-add. The result replaces an operand that is no longer needed, or else a copy of the addend.
    fn multiply_add(&mut self, result: Id, a: Id, b: Id, c: Id) -> [Option<Freed>; 3] {
        let (a, b) = self.ordered(a, b);
        let kept = [a, b, c];
        let goes = |body: &Self, value| body.held(value).filter(|_| body.dies(value));
        let (form, first, second, third) = if let Some(first) = goes(self, c) {
            let second = self.loaded(a, &kept);
            (Form::F231, first, second, self.operand(b, &kept, true))
        } else if let Some(first) = goes(self, a).filter(|_| self.held(b).is_none()) {
            let second = self.loaded(c, &kept);
            (Form::F132, first, second, self.operand(b, &kept, true))
        } else if let Some(first) = goes(self, a) {
            let second = self.loaded(b, &kept);
            (Form::F213, first, second, self.operand(c, &kept, true))
        } else if let Some(first) = goes(self, b) {
            let second = self.loaded(a, &kept);
            (Form::F213, first, second, self.operand(c, &kept, true))
        } else {
            let second = self.loaded(a, &kept);
            let third = self.operand(b, &kept, true);
            let first = self.vacant(result, &kept);
            match self.held(c) {
                Some(addend) => self.bytes.copy(first, addend),
                None => {
                    let memory = self.memory(c);
                    self.bytes.load(first, memory);
                }
            }
            (Form::F231, first, second, third)
        };
        self.bytes.multiply_add(form, first, second, third);
        let freed = self.release(&kept);
        self.bind(result, first);
        freed
    }
}
