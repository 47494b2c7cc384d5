//! The functions of a module: for one state, and over columns of states.

use wasm_encoder::ValType;

use super::body::{Places, Writer, column, parts, slots};
use super::code::{Code, Kind, Local};
use super::helpers::Functions;
use super::module::{Assembly, GATHERED};
use crate::backend::common::Scalar;
use crate::backend::flat::{Body, Expression, Function, Tree};

/// Adds the constructor, which takes the address of the model and that of the parameters, which are in double
/// precision.
pub(super) fn constructor(
    tree: &Tree<'_>,
    scalar: Scalar,
    functions: &Functions,
    assembly: &mut Assembly,
) -> u32 {
    let kind = Kind { scalar: Scalar::F64, lanes: false };
    let body = &tree.constructor;
    let slots = slots(body, kind, assembly);
    let parts = parts(body, kind, functions, &slots, assembly);
    let places = Places { model: Some(Local(1)), inputs: &[], stride: None };
    let code = Code::new(kind, vec![ValType::I32; 2], vec![]);
    let mut writer = Writer::new(code, functions, &places, &slots);
    writer.statements(&body.statements, &body.results, &parts);
    for (index, value) in body.results.iter().enumerate() {
        writer.code.get(Local(0));
        writer.value(value);
        let stored = Kind { scalar, lanes: false };
        if scalar == Scalar::F32 {
            writer.code.sink().f32_demote_f64();
        }
        writer.code.kind = stored;
        writer.code.store(stored.size() * index as u32);
        writer.code.kind = kind;
    }
    assembly.add(writer.code)
}

/// The locals of a function's arguments: the model if there is one, numbers that precede the arrays, and the arrays.
struct Arguments {
    model: Option<Local>,
    before: Vec<Local>,
    inputs: Vec<Local>,
    outputs: Vec<Local>,
}

impl Arguments {
    fn new(tree: &Tree<'_>, function: &Function<'_>, before: usize) -> Arguments {
        let mut locals = (0..).map(Local);
        let model = tree.has_parameters().then(|| locals.next()).flatten();
        let mut take = |count: usize| locals.by_ref().take(count).collect::<Vec<_>>();
        let before = take(before);
        let inputs = take(function.inputs.len());
        let outputs = take(function.outputs.len());
        Arguments { model, before, inputs, outputs }
    }

    fn arrays(&self) -> impl Iterator<Item = Local> {
        self.inputs.iter().chain(&self.outputs).copied()
    }

    fn code(&self, kind: Kind) -> Code {
        let count = self.model.iter().chain(&self.before).count() + self.arrays().count();
        Code::new(kind, vec![ValType::I32; count], vec![])
    }
}

/// Adds the function of a kind: for one state, or for several whose entries are in columns. It takes the address of the
/// model, if there is one; for several states, the number of bytes from one column to the next; and the addresses of
/// all arrays.
pub(super) fn function(
    tree: &Tree<'_>,
    function: &Function<'_>,
    kind: Kind,
    functions: &Functions,
    assembly: &mut Assembly,
) -> u32 {
    let body = function.whole();
    let slots = slots(&body, kind, assembly);
    let parts = parts(&body, kind, functions, &slots, assembly);
    let arguments = Arguments::new(tree, function, usize::from(kind.lanes));
    let places = Places {
        model: arguments.model,
        inputs: &arguments.inputs,
        stride: arguments.before.first().copied(),
    };
    let mut writer = Writer::new(arguments.code(kind), functions, &places, &slots);
    let Body { statements, results, .. } = &body;
    writer.statements(statements, results, &parts);
    let mut results: std::slice::Iter<'_, Expression> = results.iter();
    for (array, local) in function.outputs.iter().zip(&arguments.outputs) {
        for (entry, value) in results.by_ref().take(array.length).enumerate() {
            let offset = writer.entry_address(*local, entry as u32);
            writer.value(value);
            writer.code.store(offset);
        }
    }
    assembly.add(writer.code)
}

/// Adds the function over `n` states. It calls `lanes` for several states at once, and `single` for each remaining
/// state, which it copies to and from arrays at [`GATHERED`]. It takes the address of the model, if there is one, the
/// number of states, the distance between columns in numbers, and the addresses of all arrays.
pub(super) fn batch(
    tree: &Tree<'_>,
    function: &Function<'_>,
    scalar: Scalar,
    [single, lanes]: [u32; 2],
    assembly: &mut Assembly,
) -> u32 {
    let kind = Kind { scalar, lanes: false };
    let arguments = Arguments::new(tree, function, 2);
    let mut code = arguments.code(kind);
    let [n, stride] = [arguments.before[0], arguments.before[1]];
    let width = 16 / kind.size();
    let advance = |code: &mut Code, states: u32| {
        for array in arguments.arrays() {
            code.get(array).whole(states * kind.size()).sink().i32_add();
            code.set(array);
        }
        code.get(n).whole(states).sink().i32_sub();
        code.set(n);
    };
    code.get(stride).whole(kind.size()).sink().i32_mul();
    code.set(stride);
    code.repeat(n, width, |code| {
        arguments.model.iter().for_each(|model| {
            code.get(*model);
        });
        code.get(stride);
        arguments.arrays().for_each(|array| {
            code.get(array);
        });
        code.call(lanes);
        advance(code, width);
    });
    let gathered = gathered(function, &arguments, kind);
    let (inputs, outputs) = gathered.split_at(arguments.inputs.len());
    code.repeat(n, 1, |code| {
        for (array, length, place) in inputs {
            for entry in 0..*length {
                code.whole(place + entry * kind.size()).get(*array);
                column(code, stride, entry);
                code.load(0).store(0);
            }
        }
        arguments.model.iter().for_each(|model| {
            code.get(*model);
        });
        gathered.iter().for_each(|(_, _, place)| {
            code.whole(*place);
        });
        code.call(single);
        for (array, length, place) in outputs {
            for entry in 0..*length {
                code.get(*array);
                column(code, stride, entry);
                code.whole(place + entry * kind.size()).load(0).store(0);
            }
        }
        advance(code, 1);
    });
    assembly.add(code)
}

/// The arrays with their lengths and the addresses to which one state of each is copied.
fn gathered(function: &Function<'_>, arguments: &Arguments, kind: Kind) -> Vec<(Local, u32, u32)> {
    let arrays = function.inputs.iter().chain(&function.outputs);
    let mut next = GATHERED;
    let places = arguments.arrays().zip(arrays).map(|(local, array)| {
        let (place, length) = (next, array.length as u32);
        next += length * kind.size();
        (local, length, place)
    });
    places.collect()
}
