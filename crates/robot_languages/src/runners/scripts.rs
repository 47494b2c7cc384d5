//! Languages without a compiler: Python with and without NumPy, Octave, and JavaScript in Node.js.

use std::path::Path;

use robot_build::languages::Language;
use robot_codegen::backend::flat::{FlatOptions, Tree};
use robot_codegen::backend::{javascript, matlab, python};
use robot_codegen::{Scalar, Trigonometry};

use super::{Found, Runner, read, results, write_package};
use crate::files;
use crate::work::Work;

/// The runner of an interpreter, with its program.
struct Script {
    name: &'static str,
    language: Language,
    interpreter: &'static str,
    /// Arguments with which the interpreter only shows whether it and its packages are installed.
    probe: &'static [&'static str],
    arguments: &'static [&'static str],
    /// The name of the program's file.
    file: &'static str,
    program: fn(&Work) -> String,
    /// The ways in which it calls the functions.
    ways: &'static [&'static str],
}

/// All these runners.
pub(super) fn all() -> Vec<Box<dyn Runner>> {
    let scripts = [
        Script {
            name: "python",
            language: Language::Python,
            interpreter: "python3",
            probe: &["--version"],
            arguments: &["calls.py"],
            file: "calls.py",
            program: plain_python,
            ways: &["single"],
        },
        Script {
            name: "numpy",
            language: Language::Python,
            interpreter: "python3",
            probe: &["-c", "import numpy"],
            arguments: &["calls.py"],
            file: "calls.py",
            program: numpy,
            ways: &["single", "batch"],
        },
        Script {
            name: "octave",
            language: Language::Matlab,
            interpreter: "octave",
            probe: &["--version"],
            arguments: &["--no-gui", "--quiet", "--norc", "calls.m"],
            file: "calls.m",
            program: octave,
            ways: &["batch"],
        },
        Script {
            name: "node",
            language: Language::JavaScript,
            interpreter: "node",
            probe: &["--version"],
            arguments: &["calls.mjs"],
            file: "calls.mjs",
            program: node,
            ways: &["single"],
        },
    ];
    scripts.into_iter().map(|script| Box::new(script) as Box<dyn Runner>).collect()
}

impl Runner for Script {
    fn name(&self) -> &'static str {
        self.name
    }

    fn missing(&self) -> Option<String> {
        let is_there = files::is_there(self.interpreter, self.probe);
        let probe = self.probe.join(" ");
        (!is_there).then(|| format!("`{} {probe}` fails", self.interpreter))
    }

    fn has(&self, scalar: Scalar) -> bool {
        scalar == Scalar::F64
    }

    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String> {
        write_package(work, self.language, folder)?;
        files::write(folder, self.file, (self.program)(work).as_bytes())?;
        files::run(folder, self.interpreter, self.arguments)?;
        let found = self.ways.iter().map(|way| {
            let bytes = read(folder, &format!("{way}.bin"))?;
            Ok(Found { way, results: results(work, &bytes, |_| true)? })
        });
        let found = found.collect::<Result<_, String>>()?;
        let has_own_sines = self.language == Language::JavaScript;
        if has_own_sines && work.options.trigonometry == Trigonometry::Standard {
            self.run_with_sines_of_the_system(work, folder)?;
        }
        Ok(found)
    }
}

impl Script {
    /// Runs again with sines and cosines of the system's library, which the interpreter uses; then all bits must be the
    /// same. So differences in the first run come only from the sines of the language.
    fn run_with_sines_of_the_system(&self, work: &Work, folder: &Path) -> Result<(), String> {
        let angles = read(folder, "angles.bin")?;
        let angles = angles.as_chunks::<8>().0.iter().map(|angle| f64::from_le_bytes(*angle));
        let table = angles.flat_map(|angle| [angle, angle.sin(), angle.cos()]);
        let table: Vec<u8> = table.flat_map(f64::to_le_bytes).collect();
        files::write(folder, "sines.bin", &table)?;
        files::run(folder, self.interpreter, self.arguments)?;
        let found = results(work, &read(folder, "single.bin")?, |_| true)?;
        for (calls, found) in work.functions.iter().zip(found) {
            let bits =
                |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
            if found.is_none_or(|found| bits(&found) != bits(&calls.expected)) {
                let (name, function) = (self.name, &calls.name);
                return Err(format!(
                    "{name}, {}, {function}: other bits with the sines of the system's library",
                    work.source.name
                ));
            }
        }
        Ok(())
    }
}

/// Prints for each function a line that calls a procedure of the script with the function's name, the lengths of its
/// inputs and outputs, and the number of states.
fn lines(work: &Work, tree: &Tree<'_>, line: impl Fn(&str, &str, &str, usize) -> String) -> String {
    let functions = tree.functions.iter().zip(&work.functions);
    let lines = functions.map(|(function, calls)| {
        let lengths = |arrays: &[robot_codegen::backend::flat::Array]| {
            let lengths = arrays.iter().map(|array| array.length.to_string());
            lengths.collect::<Vec<_>>().join(", ")
        };
        let states = calls.expected.len() / calls.given;
        line(&function.name, &lengths(&function.inputs), &lengths(&function.outputs), states)
    });
    lines.collect()
}

/// The names and values of all parameters, with a separator such as `: ` between them.
fn parameters(work: &Work, tree: &Tree<'_>, between: &str) -> Vec<String> {
    let fields = tree.parameters.iter().zip(&work.parameters);
    fields.map(|(field, value)| format!("{field}{between}{value:?}")).collect()
}

fn python_of(work: &Work, shared: &str) -> String {
    let tree = python::tree(&work.programs.module, &FlatOptions::default());
    let name = &tree.name;
    let model = match tree.has_parameters() {
        true => {
            let parameters = parameters(work, &tree, "=").join(", ");
            format!("MODEL = [{name}.Model({name}.Parameters({parameters}))]\n")
        }
        false => "MODEL = []\n".to_owned(),
    };
    let calls = lines(work, &tree, |function, taken, given, states| {
        format!(
            "calls({name}.{function}, [{taken}], [{given}], {states})\nrefuses({name}.{function}, [{taken}])\n"
        )
    });
    format!("import {name}\n{model}{shared}{REFUSES}\n{calls}finish()\n")
}

/// Code that fails if a function of a module in Python accepts an input that is too long.
const REFUSES: &str = "

def refuses(function, taken):
    for place in range(len(taken)):
        try:
            function(*MODEL, *([0.0] * (length + (i == place)) for i, length in enumerate(taken)))
        except ValueError as error:
            assert 'entries, not' in str(error), error
        else:
            raise SystemExit(f'{function.__name__} accepts input {place} with an entry too many')
";

fn plain_python(work: &Work) -> String {
    python_of(
        work,
        "import struct

DATA = open('states.bin', 'rb').read()
PLACE = 0
FOUND = []


def flat(value):
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, (list, tuple)):
        return [entry for part in value for entry in flat(part)]
    return [value]


def calls(function, taken, given, states):
    global PLACE
    for _ in range(states):
        inputs = []
        for length in taken:
            inputs.append(list(struct.unpack_from(f'<{length}d', DATA, PLACE)))
            PLACE += 8 * length
        FOUND.extend(flat(function(*MODEL, *inputs)))


def finish():
    open('single.bin', 'wb').write(struct.pack(f'<{len(FOUND)}d', *FOUND))
",
    )
}

fn numpy(work: &Work) -> String {
    python_of(
        work,
        "import numpy

DATA = numpy.fromfile('states.bin')
PLACE = 0
SINGLE, BATCH = open('single.bin', 'wb'), open('batch.bin', 'wb')


def parts(value):
    return list(value.values()) if isinstance(value, dict) else [value]


def calls(function, taken, given, states):
    global PLACE
    width = sum(taken)
    block = DATA[PLACE : PLACE + width * states].reshape(states, width)
    PLACE += width * states
    starts = numpy.cumsum([0] + taken)
    for row in block:
        inputs = [row[a : a + length] for a, length in zip(starts, taken)]
        for part in parts(function(*MODEL, *inputs)):
            numpy.asarray(part, dtype=float).ravel().tofile(SINGLE)
    inputs = [numpy.ascontiguousarray(block[:, a : a + length].T) for a, length in zip(starts, taken)]
    found = [numpy.asarray(part, dtype=float) for part in parts(function(*MODEL, *inputs))]
    found = [part.reshape(length, states) for part, length in zip(found, given)]
    numpy.concatenate(found).T.copy().tofile(BATCH)


def finish():
    SINGLE.close()
    BATCH.close()
",
    )
}

fn octave(work: &Work) -> String {
    let tree = matlab::tree(&work.programs.module, &FlatOptions::default());
    let name = &tree.name;
    let mut text =
        "1;\nglobal in out;\nin = fopen('states.bin', 'rb');\nout = fopen('batch.bin', 'wb');\n"
            .to_owned();
    text.push_str(
        "function calls(f, given, taken, lengths, states)
  global in out;
  block = fread(in, [sum(taken), states], 'double');
  inputs = {};
  start = 0;
  for length_ = taken
    inputs{end + 1} = block(start + (1:length_), :);
    start += length_;
  end
  [outputs{1:given}] = f(inputs{:});
  rows = [];
  for i = 1:given
    found = outputs{i};
    if ndims(found) == 3 || size(found, 1) != lengths(i)
      % A matrix for each state: by rows.
      found = permute(found, [2, 1, 3]);
    end
    rows = [rows; reshape(found, lengths(i), states)];
  end
  fwrite(out, rows, 'double');
  for i = 1:numel(inputs)
    wrong = inputs;
    wrong{i} = [wrong{i}; wrong{i}(end, :)];
    refused = '';
    try
      f(wrong{:});
    catch problem
      refused = problem.message;
    end
    assert(any(strfind(refused, 'rows, not')), 'input %d with a row too many is not refused', i);
  end
end
",
    );
    if tree.has_parameters() {
        text.push_str(&format!("parameters = {name}.nominal();\n"));
        for parameter in parameters(work, &tree, " = ") {
            text.push_str(&format!("parameters.{parameter};\n"));
        }
        text.push_str(&format!("model = {name}.create_model(parameters);\n"));
    }
    let model = if tree.has_parameters() { "model, " } else { "" };
    text.push_str(&lines(work, &tree, |function, taken, given, states| {
        let count = given.split(',').count();
        let model = if taken.is_empty() { model.trim_end_matches(", ") } else { model };
        let rest = if taken.is_empty() { "" } else { "varargin{:}" };
        format!(
            "calls(@(varargin) {name}.{function}({model}{rest}), {count}, [{taken}], [{given}], {states});\n"
        )
    }));
    text.push_str("fclose(in);\nfclose(out);\n");
    text
}

/// Code that takes sines and cosines from a table if there is one, and otherwise collects the angles.
const SINES: &str = "
const angles = new Set();
const table = new Map();
if (fs.existsSync(\"sines.bin\")) {
    const bytes = fs.readFileSync(\"sines.bin\");
    const rows = new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
    for (let i = 0; i < rows.length; i += 3) table.set(rows[i], [rows[i + 1], rows[i + 2]]);
    Math.sin = (angle) => table.get(angle)[0];
    Math.cos = (angle) => table.get(angle)[1];
} else {
    for (const name of [\"sin\", \"cos\"]) {
        const own = Math[name];
        Math[name] = (angle) => {
            angles.add(angle);
            return own(angle);
        };
    }
}
";

/// Code that writes the angles.
const ANGLES: &str =
    "fs.writeFileSync(\"angles.bin\", new Uint8Array(Float64Array.from(angles).buffer));
";

fn node(work: &Work) -> String {
    let tree = javascript::tree(&work.programs.module, &FlatOptions::default());
    let name = &tree.name;
    let model = match tree.has_parameters() {
        true => {
            let parameters = parameters(work, &tree, ": ").join(", ");
            format!("const MODEL = [robot.create_model({{ {parameters} }})];\n")
        }
        false => "const MODEL = [];\n".to_owned(),
    };
    let calls = lines(work, &tree, |function, taken, _, states| {
        format!("calls(robot.{function}, [{taken}], {states});\n")
    });
    let (sines, angles) = match work.options.trigonometry {
        Trigonometry::Standard => (SINES, ANGLES),
        Trigonometry::Polynomial => ("", ""),
    };
    format!(
        "import * as fs from \"node:fs\";
import * as robot from \"./{name}.mjs\";

{model}
const bytes = fs.readFileSync(\"states.bin\");
const data = new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
let place = 0;
const found = [];
{sines}
const flat = (value) =>
    typeof value === \"number\" ? [value] : value instanceof Float64Array ? [...value] : Object.values(value).flatMap(flat);

function calls(f, taken, states) {{
    for (let i = 0; i < states; i++) {{
        const inputs = taken.map((length) => data.subarray(place, (place += length)));
        found.push(...flat(f(...MODEL, ...inputs)));
    }}
    taken.forEach((_, wrong) => {{
        const inputs = taken.map((length, i) => new Float64Array(length + (i === wrong ? 1 : 0)));
        try {{
            f(...MODEL, ...inputs);
        }} catch (error) {{
            if (error instanceof RangeError) return;
            throw error;
        }}
        throw new Error(`${{f.name}} accepts input ${{wrong}} with an entry too many`);
    }});
}}

{calls}
fs.writeFileSync(\"single.bin\", new Uint8Array(Float64Array.from(found).buffer));
{angles}"
    )
}
