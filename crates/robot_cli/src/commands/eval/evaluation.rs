//! Outputs at states as these are read, a block of them at a time.

use std::ops::ControlFlow;

use robot_build::Trigonometry;
use robot_codegen::Errors;
use robot_codegen::module::Function;
use robot_jit::Handle;
use robot_model::robot::Robot;
use robot_model::variable::WRENCH;

use super::digits::Digits;
use super::infinite;
use super::output::Printer;
use crate::complaints::Complaints;
use crate::failure::Failure;
use crate::outgoing::Outgoing;
use crate::states::{Layout, Sink, State};

/// The states that are in memory.
const BLOCK: usize = 128;

/// What is computed at every state.
pub(super) struct Task<'e> {
    pub(super) robot: &'e Robot,
    pub(super) settings: &'e [(&'e str, f64)],
    pub(super) trigonometry: Trigonometry,
    pub(super) digits: &'e Digits,
    pub(super) function: &'e Function,
    /// None if the states are only checked.
    pub(super) handle: Option<Handle<'e>>,
    /// Why no state may have a wrench.
    pub(super) unloadable: Option<String>,
    pub(super) printer: Printer,
    /// The name of the robot file.
    pub(super) file: &'e str,
    /// The name of the file of states, if they have one.
    pub(super) source: Option<String>,
}

/// Computes and prints the outputs at the states that it is given, unless anything is wrong with one of them.
pub(super) struct Evaluation<'e, 'l, 't> {
    task: Task<'e>,
    inputs: Vec<Input<'e>>,
    block: Vec<State<'l>>,
    /// The states of the block that wait.
    waiting: usize,
    /// A column for each entry of the inputs and outputs, over the block.
    columns: [Vec<Vec<f64>>; 2],
    wrong: Wrong,
    outgoing: Outgoing<'t>,
    /// No state has been printed.
    is_empty: bool,
    failure: Option<Failure>,
}

/// An input of the function, and its array in the layout of states.
struct Input<'e> {
    name: &'e str,
    array: Option<usize>,
    size: usize,
}

/// What is wrong, in the order in which it is told.
#[derive(Default)]
struct Wrong {
    before: Complaints,
    read: Complaints,
    loaded: Complaints,
    missing: Complaints,
    infinite: Complaints,
}

impl Wrong {
    /// Whether the states can be computed.
    fn is_none(&self) -> bool {
        let Wrong { before, read, loaded, missing, .. } = self;
        [before, read, loaded, missing].iter().all(|complaints| complaints.is_empty())
    }

    fn result(self) -> Result<(), Failure> {
        let computed = self.is_none();
        let Wrong { before, read, loaded, missing, infinite } = self;
        let all = if computed { infinite } else { before.and(read).and(loaded).and(missing) };
        if all.is_empty() { Ok(()) } else { Err(Failure::Inputs(all)) }
    }
}

impl<'e, 'l, 't> Evaluation<'e, 'l, 't> {
    /// `before` is what is wrong already.
    pub(super) fn new(
        task: Task<'e>,
        layout: &'l Layout,
        before: Complaints,
        outgoing: Outgoing<'t>,
    ) -> Evaluation<'e, 'l, 't> {
        let inputs = task.function.inputs.iter().map(|input| Input {
            name: &input.name,
            array: layout.position(&input.name),
            size: input.symbols.len(),
        });
        let sizes = task.handle.map_or([0; 2], |one| [one.input_size(), one.output_size()]);
        Evaluation {
            inputs: inputs.collect(),
            block: vec![State::new(layout); BLOCK],
            waiting: 0,
            columns: sizes.map(|size| vec![Vec::with_capacity(BLOCK); size]),
            wrong: Wrong { before, ..Wrong::default() },
            outgoing,
            is_empty: true,
            failure: None,
            task,
        }
    }

    /// Ends the output, or says what was wrong.
    pub(super) fn end(mut self) -> Result<(), Failure> {
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        self.compute()?;
        std::mem::take(&mut self.wrong).result()?;
        let Evaluation { mut outgoing, is_empty, task, .. } = self;
        outgoing.push(|text| task.printer.end(is_empty, text))?;
        outgoing.end(|_| Ok(()))
    }

    /// Says what a state lacks, or has too much.
    fn check(&mut self, state: &State<'_>) {
        let Evaluation { task, wrong, .. } = self;
        let place = state.place;
        if let Some(why) = task.unloadable.as_ref().filter(|_| state.is_loaded()) {
            wrong.loaded.push(format!("{place}: has a wrench, but {why}"));
        }
        for Input { name, array, .. } in &self.inputs {
            let is_given = array.is_some_and(|array| state.at(array).is_some());
            // A wrench that is not given is 0.
            if !is_given && !name.starts_with(WRENCH) {
                let function = &task.function.name;
                wrong.missing.push(format!("{place}: `{name}` is missing; {function} needs it"));
            }
        }
    }

    /// Computes the states that wait, and prints their outputs.
    fn compute(&mut self) -> Result<(), Failure> {
        let states = &self.block[..std::mem::take(&mut self.waiting)];
        let Task { handle: Some(handle), digits, printer, .. } = &self.task else {
            return Ok(());
        };
        let [inputs, outputs] = &mut self.columns;
        gather(&self.inputs, states, inputs);
        outputs.iter_mut().for_each(|column| column.resize(states.len(), 0.0));
        let given: Vec<&[f64]> = inputs.iter().map(Vec::as_slice).collect();
        let mut found: Vec<&mut [f64]> = outputs.iter_mut().map(Vec::as_mut_slice).collect();
        handle.columns(&given, &mut found).map_err(|errors| failed(self.task.file, &errors))?;
        for (row, state) in states.iter().enumerate() {
            let values = || outputs.iter().map(|column| column[row]);
            if !values().all(f64::is_finite) {
                let Task { robot, settings, trigonometry, .. } = &self.task;
                let outputs = handle.named(values().collect());
                let messages =
                    infinite::messages(robot, settings, state, &outputs, digits, *trigonometry);
                self.wrong.infinite.extend(messages);
            } else if self.wrong.infinite.is_empty() {
                digits.warning(state).iter().for_each(|line| self.outgoing.warn(line));
                self.outgoing.push(|text| printer.state(self.is_empty, values(), text))?;
                self.is_empty = false;
            }
        }
        Ok(())
    }
}

/// Puts the inputs of states into columns.
fn gather(inputs: &[Input<'_>], states: &[State<'_>], columns: &mut [Vec<f64>]) {
    let entries = inputs.iter().flat_map(|input| (0..input.size).map(|entry| (input.array, entry)));
    for ((array, entry), column) in entries.zip(columns) {
        let of = |state: &State<'_>| array.and_then(|array| state.at(array)?.get(entry).copied());
        column.clear();
        column.extend(states.iter().map(|state| of(state).unwrap_or_default()));
    }
}

/// The errors of a program of a robot file.
pub(super) fn failed(file: &str, errors: &Errors) -> Failure {
    Failure::Input(errors.as_slice().iter().map(|error| format!("{file}: {error}")).collect())
}

impl<'l> Sink<'l> for Evaluation<'_, 'l, '_> {
    fn state(&mut self, state: &mut State<'l>) -> ControlFlow<()> {
        self.check(state);
        if !self.wrong.is_none() {
            return ControlFlow::Continue(());
        }
        std::mem::swap(&mut self.block[self.waiting], state);
        self.waiting += 1;
        if self.waiting == BLOCK
            && let Err(failure) = self.compute()
        {
            self.failure = Some(failure);
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    fn wrong(&mut self, message: String) {
        let source = self.task.source.as_deref();
        let message = source.map(|source| format!("{source}: {message}")).unwrap_or(message);
        self.wrong.read.push(message);
    }

    fn none(&mut self, message: String) {
        let before = std::mem::take(&mut self.wrong.before);
        self.wrong = Wrong { before, ..Wrong::default() };
        self.wrong(message);
    }
}
