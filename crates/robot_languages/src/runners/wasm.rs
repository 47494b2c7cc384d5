//! WebAssembly in Node.js.

use std::path::Path;

use robot_build::languages::Language;
use robot_codegen::Scalar;
use robot_codegen::backend::flat::FlatOptions;
use robot_codegen::backend::wasm;

use super::{Found, Runner, read, results, write_package};
use crate::files;
use crate::work::Work;

/// The runner of the package, which is tested and called in Node.js.
pub(super) struct Wasm;

impl Runner for Wasm {
    fn name(&self) -> &'static str {
        "wasm"
    }

    fn missing(&self) -> Option<String> {
        let is_there = files::is_there("node", &["--version"]);
        (!is_there).then(|| "node is not installed".to_owned())
    }

    fn has(&self, _: Scalar) -> bool {
        true
    }

    fn has_standard_sines(&self) -> bool {
        false
    }

    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String> {
        write_package(work, Language::Wasm, folder)?;
        files::write(folder, "calls.mjs", program(work).as_bytes())?;
        files::run(folder, "node", &["test.mjs"])?;
        files::run(folder, "node", &["calls.mjs"])?;
        let has_batch = |index: usize| work.functions[index].taken > 0;
        Ok(vec![
            Found {
                way: "single",
                results: results(work, &read(folder, "single.bin")?, |_| true)?,
            },
            Found { way: "batch", results: results(work, &read(folder, "batch.bin")?, has_batch)? },
        ])
    }
}

/// Prints a program that reads states, calls every function in both ways and writes the results. Columns are read and
/// written in the module's memory, and their distance is the number of states plus one.
fn program(work: &Work) -> String {
    let options = FlatOptions { scalar: work.options.scalar, ..FlatOptions::default() };
    let tree = wasm::tree(&work.programs.module, &options);
    let name = &tree.name;
    let model = match tree.has_parameters() {
        true => {
            let fields = tree.parameters.iter().zip(&work.parameters);
            let fields: Vec<String> =
                fields.map(|(field, value)| format!("{field}: {value:?}")).collect();
            format!("[robot.create_model({{ {} }})]", fields.join(", "))
        }
        false => "[]".to_owned(),
    };
    let functions = tree.functions.iter().zip(wasm::batch_names(&tree)).zip(&work.functions);
    let calls = functions.map(|((function, batch), calls)| {
        let lengths = |arrays: &[robot_codegen::backend::flat::Array]| {
            arrays.iter().map(|array| array.length.to_string()).collect::<Vec<_>>().join(", ")
        };
        let states = calls.expected.len() / calls.given;
        format!(
            "calls(\"{}\", \"{}\", [{}], [{}], {states});\n",
            function.name,
            batch.unwrap_or_default(),
            lengths(&function.inputs),
            lengths(&function.outputs)
        )
    });
    let array = if work.options.scalar == Scalar::F64 { "Float64Array" } else { "Float32Array" };
    let calls: String = calls.collect();
    let words =
        [("NAME", name.as_str()), ("MODEL_OF", &model), ("ARRAY", array), ("CALLS", &calls)];
    words.into_iter().fold(PROGRAM.to_owned(), |text, (word, by)| text.replace(word, by))
}

const PROGRAM: &str = "import * as fs from \"node:fs\";
import { load } from \"./NAME.mjs\";

const robot = await load();
const MODEL = MODEL_OF;
const bytes = fs.readFileSync(\"states.bin\");
const data = new ARRAY(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
let place = 0;
const single = [], batch = [];
const flat = (value) =>
    typeof value === \"number\" ? [value] : ArrayBuffer.isView(value) ? [...value] : Object.values(value).flatMap(flat);
// The same memory for the columns of every function.
const most = 1 << 17;
const memory = robot.allocate(most);

function calls(one, many, taken, given, states) {
    const stride = states + 1;
    let next = memory;
    const columns = [...taken, ...given].map((length) => {
        const address = next;
        next += length * stride * data.BYTES_PER_ELEMENT;
        return address;
    });
    if (next > memory + most * data.BYTES_PER_ELEMENT) {
        throw new Error(\"there is no room for the columns\");
    }
    for (let i = 0; i < states; i++) {
        const inputs = taken.map((length) => data.subarray(place, (place += length)));
        single.push(...flat(robot[one](...MODEL, ...inputs)));
        inputs.forEach((values, k) => values.forEach((value, j) => {
            robot.numbers(columns[k] + (j * stride + i) * data.BYTES_PER_ELEMENT, 1)[0] = value;
        }));
    }
    if (!many) return;
    // One state fewer in lanes of each type than would leave nothing for the single form.
    const first = states - 1;
    robot.exports[many](...MODEL, first, stride, ...columns);
    const rest = columns.map((address) => address + first * data.BYTES_PER_ELEMENT);
    robot.exports[many](...MODEL, states - first, stride, ...rest);
    for (let i = 0; i < states; i++) {
        given.forEach((length, k) => {
            for (let j = 0; j < length; j++) {
                const address = columns[taken.length + k] + (j * stride + i) * data.BYTES_PER_ELEMENT;
                batch.push(robot.numbers(address, 1)[0]);
            }
        });
    }
}

CALLS
fs.writeFileSync(\"single.bin\", new Uint8Array(ARRAY.from(single).buffer));
fs.writeFileSync(\"batch.bin\", new Uint8Array(ARRAY.from(batch).buffer));
";
