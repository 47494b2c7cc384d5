//! Computes outputs at states while these are read, block by block.

use std::ops::ControlFlow;

use robot_build::Trigonometry;
use robot_codegen::Errors;
use robot_codegen::module::Function;
use robot_jit::Handle;
use robot_model::robot::Robot;
use robot_model::variable::{JointVariable, WRENCH};

use super::digits::Digits;
use super::infinite;
use super::output::Printer;
use crate::complaints::Complaints;
use crate::failure::Failure;
use crate::limits::Outside;
use crate::outgoing::Outgoing;
use crate::states::{Layout, Sink, State};

/// The number of states in memory.
const BLOCK: usize = 128;

/// The computation at every state.
pub(super) struct Task<'e> {
    pub(super) robot: &'e Robot,
    pub(super) settings: &'e [(&'e str, f64)],
    pub(super) trigonometry: Trigonometry,
    pub(super) digits: &'e Digits,
    pub(super) function: &'e Function,
    /// The compiled function; `None` if the states are only checked.
    pub(super) handle: Option<Handle<'e>>,
    /// The reason why states must not have a wrench, if there is one.
    pub(super) no_wrench: Option<String>,
    /// Whether the chosen function takes a wrench, so that a note is printed if no state has one.
    pub(super) takes_wrench: bool,
    pub(super) printer: Printer,
    /// The name of the robot file.
    pub(super) file: &'e str,
    /// The name of the file of states, if they come from a file.
    pub(super) source: Option<String>,
}

/// Computes and prints the outputs at the states that it receives, unless one of them has an error.
pub(super) struct Evaluation<'e, 'l, 't> {
    task: Task<'e>,
    inputs: Vec<Input<'e>>,
    block: Vec<State<'l>>,
    /// The number of states in the block that have not been computed.
    waiting: usize,
    /// Columns for the entries of the inputs and of the outputs, with a row for each state of the block.
    columns: [Vec<Vec<f64>>; 2],
    wrong: Wrong,
    outgoing: Outgoing<'t>,
    /// Whether no state has been printed yet.
    is_empty: bool,
    /// Whether the chosen function takes a wrench and no state has one.
    lack_wrenches: bool,
    outside: Outside<'e>,
    failure: Option<Failure>,
}

/// An input of the function, and its array in the layout of states.
struct Input<'e> {
    name: &'e str,
    array: Option<usize>,
    size: usize,
}

/// The errors, in the order in which they are reported.
#[derive(Default)]
struct Wrong {
    before: Complaints,
    read: Complaints,
    with_wrench: Complaints,
    missing: Complaints,
    infinite: Complaints,
}

impl Wrong {
    /// Whether there are no errors, so that the states can be computed.
    fn is_none(&self) -> bool {
        let Wrong { before, read, with_wrench, missing, .. } = self;
        [before, read, with_wrench, missing].iter().all(|complaints| complaints.is_empty())
    }

    /// The errors, which are those of the command line if `of_arguments`.
    fn result(self, of_arguments: bool) -> Result<(), Failure> {
        let computed = self.is_none();
        let Wrong { before, read, with_wrench, missing, infinite } = self;
        if computed {
            return if infinite.is_empty() { Ok(()) } else { Err(Failure::Inputs(infinite)) };
        }
        let all = before.and(read).and(with_wrench).and(missing);
        let failure = Failure::Inputs(all);
        Err(if of_arguments { failure.refused() } else { failure })
    }
}

impl<'e, 'l, 't> Evaluation<'e, 'l, 't> {
    /// Starts an evaluation; `before` are errors that have already been found.
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
            lack_wrenches: task.takes_wrench,
            outside: Outside::new(task.robot),
            failure: None,
            task,
        }
    }

    /// Ends the output, or returns the errors. No states have no outputs.
    pub(super) fn end(mut self) -> Result<(), Failure> {
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        self.compute()?;
        std::mem::take(&mut self.wrong).result(self.task.source.is_none())?;
        self.note_wrench();
        let note = self.task.source.as_deref().and_then(|source| self.outside.note(source));
        note.iter().for_each(|note| self.outgoing.warn(note));
        if let (true, Some(source)) = (self.is_empty, &self.task.source) {
            self.outgoing.warn(&format!("note: {source} has no states\n"));
        }
        let Evaluation { mut outgoing, is_empty, task, .. } = self;
        outgoing.push(|text| task.printer.end(is_empty, text))?;
        outgoing.end(|_| Ok(()))
    }

    /// Prints a note if the chosen function takes a wrench and no state has one.
    fn note_wrench(&mut self) {
        if self.lack_wrenches {
            let name = &self.task.function.name;
            let note = format!("note: no wrench is given, so {name} is computed with 0\n");
            self.outgoing.warn(&note);
        }
    }

    /// Records inputs that a state does not have, and a wrench that it must not have.
    fn check(&mut self, state: &State<'_>) {
        let Evaluation { task, wrong, .. } = self;
        let place = state.place;
        let file = task.source.as_ref().map_or(String::new(), |source| format!("{source}: "));
        if let Some(why) = task.no_wrench.as_ref().filter(|_| state.has_wrench()) {
            wrong.with_wrench.push(format!("{file}{place}: has a wrench, but {why}"));
        }
        for Input { name, array, size } in &self.inputs {
            let is_given = array.is_some_and(|array| state.at(array).is_some());
            // A missing wrench is 0.
            if name.starts_with(WRENCH) {
                self.lack_wrenches &= !is_given;
            } else if !is_given {
                let function = &task.function.name;
                let remedy = match task.source {
                    Some(_) => String::new(),
                    None => format!("; add --{name} {}", vec!["0"; *size].join(",")),
                };
                wrong.missing.push(format!(
                    "{file}{place}: `{name}` is missing; {function} needs it{remedy}"
                ));
            }
        }
    }

    /// Computes the waiting states and prints their outputs.
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

/// Copies the inputs of states into columns.
fn gather(inputs: &[Input<'_>], states: &[State<'_>], columns: &mut [Vec<f64>]) {
    let entries = inputs.iter().flat_map(|input| (0..input.size).map(|entry| (input.array, entry)));
    for ((array, entry), column) in entries.zip(columns) {
        let of = |state: &State<'_>| array.and_then(|array| state.at(array)?.get(entry).copied());
        column.clear();
        column.extend(states.iter().map(|state| of(state).unwrap_or_default()));
    }
}

/// Converts errors of a program made from a robot file.
pub(super) fn failed(file: &str, errors: &Errors) -> Failure {
    Failure::Input(errors.as_slice().iter().map(|error| format!("{file}: {error}")).collect())
}

impl<'l> Sink<'l> for Evaluation<'_, 'l, '_> {
    fn header(&mut self, state: &State<'l>) {
        self.check(state);
    }

    fn state(&mut self, state: &mut State<'l>) -> ControlFlow<()> {
        self.check(state);
        if !self.wrong.is_none() {
            return ControlFlow::Continue(());
        }
        let positions = state.array(JointVariable::Position.name());
        self.outside.add(state.place, positions.unwrap_or_default());
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

    fn error(&mut self, message: String) {
        let source = self.task.source.as_deref();
        let message = source.map(|source| format!("{source}: {message}")).unwrap_or(message);
        self.wrong.read.push(message);
    }

    fn no_states(&mut self, message: String) {
        let before = std::mem::take(&mut self.wrong.before);
        self.wrong = Wrong { before, ..Wrong::default() };
        self.error(message);
    }
}
