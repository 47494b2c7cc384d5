//! List scheduling (R. L. Graham, "Bounds on multiprocessing timing anomalies", SIAM J. Appl. Math. 17(2), 1969): the
//! order in which a simple processor would start the steps.
//!
//! A processor looks a few hundred instructions ahead. Here the step whose results are waited for longest starts first,
//! sines among the rest, and so does, while more values than registers are alive, one that ends the lives of others.
//! The model starts two products, two sums and four other steps a cycle. Latencies are those of Zen 4 and Zen 5 divided
//! by a number: calls, and even more so the states of lanes, overlap with the next ones, so that waiting costs less
//! than it takes.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use super::order::{needed, operands};
use super::{Binary, Id, Instruction, List, Step};

/// What starts a step: the units for products, for sums, and for all else.
const UNITS: [u8; 3] = [2, 2, 4];
const PRODUCTS: usize = 0;
const SUMS: usize = 1;
const OTHERS: usize = 2;

/// How many steps of each unit are looked at for one that ends lives: the time to compile goes with them.
const LOOKED_AT: usize = 48;

/// Cycles until the result is there, and the unit.
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

/// How a list is scheduled.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Model {
    /// Values alive, from which on those that end lives go first.
    pub(crate) registers: usize,
    /// What latencies are divided by.
    pub(crate) overlap: u32,
}

/// A step by the cycles that are waited for it.
type Ready = (Reverse<u32>, u32);

struct Scheduler<'l> {
    list: &'l List,
    model: Model,
    /// Cycles from the start of each step to the last store that waits for it.
    height: Vec<u32>,
    /// The steps that use each value, each once.
    users: Vec<Vec<u32>>,
    /// For each step, the operands that have not started.
    missing: Vec<u32>,
    /// For each value, the steps that still need it.
    uses: Vec<u32>,
    /// The cycle in which the operands of each step are there.
    start: Vec<u32>,
    /// For each unit the steps whose operands are there, the one waited for longest first.
    ready: [BTreeSet<Ready>; 3],
    /// Steps whose operands have started, by the cycle in which they are there.
    waiting: BTreeMap<u32, Vec<u32>>,
    now: u32,
    alive: usize,
    order: Vec<usize>,
}

impl List {
    /// The steps as a processor would start them.
    pub(crate) fn scheduled(&self, model: Model) -> List {
        let mut scheduler = Scheduler::new(self, model);
        while !scheduler.is_done() {
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
            users: vec![vec![]; count],
            missing: vec![0; count],
            uses: vec![0; count],
            start: vec![0; count],
            ready: [const { BTreeSet::new() }; 3],
            waiting: BTreeMap::new(),
            now: 0,
            alive: 0,
            order: order.collect(),
        };
        for (position, step) in list.steps.iter().enumerate().rev() {
            if !needed[position] || is_home(position) {
                continue;
            }
            scheduler.height[position] += scheduler.latency(*step);
            for value in operands(*step).filter(|value| !list.is_home(*value)) {
                let index = value.index();
                let height = scheduler.height[position];
                scheduler.height[index] = scheduler.height[index].max(height);
                scheduler.users[index].push(position as u32);
                scheduler.uses[index] += 1;
                scheduler.missing[position] += 1;
            }
        }
        for position in (0..count).filter(|position| needed[*position] && !is_home(*position)) {
            if scheduler.missing[position] == 0 {
                scheduler.make_ready(position);
            }
        }
        scheduler
    }

    fn latency(&self, step: Step) -> u32 {
        cost(step).0.div_ceil(self.model.overlap)
    }

    /// Starts what can start in a cycle.
    fn cycle(&mut self) {
        if self.ready.iter().all(BTreeSet::is_empty) {
            self.now = self.waiting.first_key_value().map_or(self.now, |(cycle, _)| *cycle);
        }
        while let Some(entry) = self.waiting.first_entry().filter(|entry| *entry.key() <= self.now)
        {
            for position in entry.remove() {
                self.make_ready(position as usize);
            }
        }
        let mut units = UNITS;
        while let Some(position) = self.next(units) {
            units[cost(self.list.steps[position]).1] -= 1;
            self.begin(position);
        }
        self.now += 1;
    }

    /// The step to start next, if a unit is free for one.
    fn next(&self, units: [u8; 3]) -> Option<usize> {
        let free = || self.ready.iter().zip(units).filter(|(_, free)| *free > 0);
        let first = free().filter_map(|(ready, _)| ready.first()).min()?;
        if self.alive < self.model.registers {
            return Some(first.1 as usize);
        }
        let looked_at = free().flat_map(|(ready, _)| ready.iter().take(LOOKED_AT));
        let best = looked_at.min_by_key(|(height, position)| {
            (Reverse(self.ended(*position as usize)), *height, *position)
        });
        best.map(|(_, position)| *position as usize)
    }

    fn make_ready(&mut self, position: usize) {
        let unit = cost(self.list.steps[position]).1;
        self.ready[unit].insert((Reverse(self.height[position]), position as u32));
    }

    fn is_done(&self) -> bool {
        self.ready.iter().all(BTreeSet::is_empty) && self.waiting.is_empty()
    }

    /// The values whose lives a step ends, less the one that it begins.
    fn ended(&self, position: usize) -> isize {
        let step = self.list.steps[position];
        let ended = operands(step).filter(|value| self.uses[value.index()] == 1).count();
        ended as isize - isize::from(matches!(step, Step::Value(_)))
    }

    fn begin(&mut self, position: usize) {
        let step = self.list.steps[position];
        self.ready[cost(step).1].remove(&(Reverse(self.height[position]), position as u32));
        self.order.push(position);
        self.alive = self.alive.saturating_add_signed(-self.ended(position));
        for value in operands(step).filter(|value| !self.list.is_home(*value)) {
            self.uses[value.index()] -= 1;
        }
        let done = self.now + self.latency(step);
        for user in std::mem::take(&mut self.users[position]) {
            let index = user as usize;
            self.start[index] = self.start[index].max(done);
            self.missing[index] -= 1;
            if self.missing[index] == 0 {
                self.waiting.entry(self.start[index]).or_default().push(user);
            }
        }
    }
}
