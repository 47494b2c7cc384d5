//! List scheduling (R. L. Graham, "Bounds on multiprocessing timing anomalies", SIAM J. Appl. Math. 17(2), 1969): the
//! order in which a simple processor would start the steps.
//!
//! A processor looks only a few hundred instructions ahead. Here, the step for which results wait longest starts first,
//! including the steps of sines; while more values are live than there are registers, steps that end the live ranges of
//! others start first. The model starts two products, two sums and four other steps in each cycle. Latencies are those
//! of Zen 4 and Zen 5, divided by a number, because calls, and even more the states of lanes, overlap with the next
//! ones.

use std::cmp::Reverse;

use super::order::{needed, operands};
use super::{Binary, Id, Instruction, List, Step};

/// The number of units that start steps: for products, for sums, and for all others.
const UNITS: [u8; 3] = [2, 2, 4];
const PRODUCTS: usize = 0;
const SUMS: usize = 1;
const OTHERS: usize = 2;

/// The number of steps of each unit that are searched for one that ends a live range. The time to compile grows with
/// it.
const LOOKED_AT: usize = 48;

/// The cycles until the result of a step is known, and its unit.
fn cost(step: Step) -> (u32, usize) {
    let Step::Value(instruction) = step else { return (1, OTHERS) };
    match instruction {
        Instruction::Binary(Binary::Add | Binary::Sub, ..) => (3, SUMS),
        Instruction::Binary(Binary::Mul, ..) => (3, PRODUCTS),
        Instruction::Binary(Binary::Div, ..) => (13, PRODUCTS),
        Instruction::MulAdd(..) => (4, PRODUCTS),
        Instruction::Sqrt(_) => (20, PRODUCTS),
        Instruction::Join(..) | Instruction::Upper(_) => (3, OTHERS),
        _ => (1, OTHERS),
    }
}

/// The model of a processor for scheduling.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Model {
    /// The number of live values from which on steps that end live ranges go first.
    pub(crate) registers: usize,
    /// The number by which latencies are divided.
    pub(crate) overlap: u32,
}

/// A step that is ready. Steps are ordered by their height, the cycles of the longest path from them to a result; among
/// equals, the earlier step is greater.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Ready {
    height: u32,
    position: Reverse<u32>,
}

/// Stands for no operand.
const NONE: u32 = u32::MAX;

/// A number of cycles larger than the latency of any step.
const CYCLES: usize = 32;

struct Scheduler<'l> {
    list: &'l List,
    model: Model,
    /// Cycles from the start of each step to the last store that waits for it.
    height: Vec<u32>,
    /// For each step, its computed operands, followed by `NONE`.
    operands: Vec<[u32; 3]>,
    /// The users of all values, value by value; each user occurs once for a value.
    users: Vec<u32>,
    /// For each value, the index of its first user in `users`; the last entry is the end of all users.
    first_user: Vec<u32>,
    /// For each step, the number of operands that have not started.
    missing: Vec<u32>,
    /// For each value, the number of steps that still need it.
    uses: Vec<u32>,
    /// For each step, the number of values whose live ranges it would end now, minus one if it starts a value.
    ended: Vec<i8>,
    /// For each step, the cycle in which its operands are known.
    start: Vec<u32>,
    /// For each unit, the steps whose operands are known, in order.
    ready: [Vec<Ready>; 3],
    /// Steps whose operands have started, by the cycle in which the operands are known, modulo `CYCLES`.
    waiting: [Vec<u32>; CYCLES],
    now: u32,
    alive: usize,
    order: Vec<usize>,
    is_started: Vec<bool>,
    /// The number of steps that have not started.
    left: usize,
}

impl List {
    /// Orders the steps as a processor would start them.
    pub(crate) fn scheduled(&self, model: Model) -> List {
        let mut scheduler = Scheduler::new(self, model);
        while scheduler.left > 0 {
            scheduler.cycle();
        }
        self.in_order(&scheduler.order)
    }
}

impl<'l> Scheduler<'l> {
    fn new(list: &'l List, model: Model) -> Scheduler<'l> {
        let count = list.steps.len();
        let needed = needed(list);
        let is_home = |position: usize| list.is_home(Id::at(position));
        let order = (0..count).filter(|position| needed[*position] && is_home(*position));
        let mut scheduler = Scheduler {
            list,
            model,
            height: vec![0; count],
            operands: vec![[NONE; 3]; count],
            users: vec![],
            first_user: vec![0; count + 1],
            missing: vec![0; count],
            uses: vec![0; count],
            ended: vec![0; count],
            start: vec![0; count],
            ready: [const { vec![] }; 3],
            waiting: [const { vec![] }; CYCLES],
            now: 0,
            alive: 0,
            order: order.collect(),
            is_started: vec![false; count],
            left: 0,
        };
        let steps = || (0..count).filter(|position| needed[*position] && !is_home(*position));
        for position in steps().rev() {
            let found = operands(list.steps[position]).filter(|value| !list.is_home(*value));
            for (operand, value) in scheduler.operands[position].iter_mut().zip(found) {
                *operand = value.index() as u32;
            }
            scheduler.left += 1;
            scheduler.height[position] += scheduler.latency(list.steps[position]);
            for value in scheduler.computed(position) {
                let height = scheduler.height[position];
                scheduler.height[value] = scheduler.height[value].max(height);
                scheduler.uses[value] += 1;
                scheduler.missing[position] += 1;
            }
        }
        scheduler.find_users(steps());
        for position in steps() {
            let ended = scheduler.computed(position).filter(|value| scheduler.uses[*value] == 1);
            let begun = i8::from(matches!(list.steps[position], Step::Value(_)));
            scheduler.ended[position] = ended.count() as i8 - begun;
            if scheduler.missing[position] == 0 {
                scheduler.make_ready(position);
            }
        }
        scheduler
    }

    /// Fills in the users of all values, in the order of the steps.
    fn find_users(&mut self, steps: impl Iterator<Item = usize>) {
        let mut end = 0;
        for (first, uses) in self.first_user.iter_mut().zip(&self.uses) {
            *first = end;
            end += uses;
        }
        self.users = vec![0; end as usize];
        let mut next = self.first_user.clone();
        for position in steps {
            for value in self.computed(position) {
                self.users[next[value] as usize] = position as u32;
                next[value] += 1;
            }
        }
        if let Some(last) = self.first_user.last_mut() {
            *last = end;
        }
    }

    /// The computed operands of a step.
    fn computed(&self, position: usize) -> impl Iterator<Item = usize> + use<> {
        let operands = self.operands[position].into_iter();
        operands.take_while(|operand| *operand != NONE).map(|operand| operand as usize)
    }

    fn latency(&self, step: Step) -> u32 {
        cost(step).0.div_ceil(self.model.overlap)
    }

    /// Starts the steps that can start in one cycle.
    fn cycle(&mut self) {
        let slot = self.now as usize % CYCLES;
        let mut due = std::mem::take(&mut self.waiting[slot]);
        due.drain(..).for_each(|position| self.make_ready(position as usize));
        self.waiting[slot] = due;
        let mut units = UNITS;
        while let Some(position) = self.next(units) {
            units[cost(self.list.steps[position]).1] -= 1;
            self.begin(position);
        }
        self.now += 1;
    }

    /// Returns the step to start next, if a unit is free for one.
    fn next(&self, units: [u8; 3]) -> Option<usize> {
        let free = || self.ready.iter().zip(units).filter(|(_, free)| *free > 0);
        let first = free().filter_map(|(ready, _)| ready.last()).max()?;
        if self.alive < self.model.registers {
            return Some(first.position.0 as usize);
        }
        let looked_at =
            free().flat_map(|(ready, _)| &ready[ready.len().saturating_sub(LOOKED_AT)..]);
        let best = looked_at.max_by_key(|ready| (self.ended[ready.position.0 as usize], **ready));
        best.map(|ready| ready.position.0 as usize)
    }

    /// The unit of a step, and its rank among the ready steps.
    fn place(&self, position: usize) -> (usize, Ready) {
        let unit = cost(self.list.steps[position]).1;
        (unit, Ready { height: self.height[position], position: Reverse(position as u32) })
    }

    fn make_ready(&mut self, position: usize) {
        let (unit, ready) = self.place(position);
        let at = self.ready[unit].partition_point(|other| *other < ready);
        self.ready[unit].insert(at, ready);
    }

    fn range_of_users(&self, value: usize) -> std::ops::Range<usize> {
        self.first_user[value] as usize..self.first_user[value + 1] as usize
    }

    fn begin(&mut self, position: usize) {
        let (unit, ready) = self.place(position);
        let at = self.ready[unit].partition_point(|other| *other < ready);
        self.ready[unit].remove(at);
        self.order.push(position);
        self.is_started[position] = true;
        self.left -= 1;
        self.alive = self.alive.saturating_add_signed(-isize::from(self.ended[position]));
        for value in self.computed(position) {
            self.uses[value] -= 1;
            if self.uses[value] == 1 {
                // Only one remaining step needs the value and would end its live range.
                let users =
                    self.users[self.range_of_users(value)].iter().map(|user| *user as usize);
                let last = users.into_iter().find(|user| !self.is_started[*user]);
                last.into_iter().for_each(|user| self.ended[user] += 1);
            }
        }
        let done = self.now + self.latency(self.list.steps[position]);
        for user in self.range_of_users(position) {
            let index = self.users[user] as usize;
            self.start[index] = self.start[index].max(done);
            self.missing[index] -= 1;
            if self.missing[index] == 0 {
                self.waiting[self.start[index] as usize % CYCLES].push(index as u32);
            }
        }
    }
}
