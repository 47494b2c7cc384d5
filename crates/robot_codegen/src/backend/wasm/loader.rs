//! The ES module that loads a WebAssembly module and copies arrays into its memory and out of it.

use super::Printer;
use crate::backend::flat::Function;
use crate::backend::javascript::{self, helpers};

/// Prints the ES module.
pub(super) fn text(printer: &Printer<'_>) -> String {
    let (tree, options) = (printer.tree, printer.options);
    let of_javascript = javascript::Printer { tree, options };
    let mut lines = of_javascript.header();
    lines.extend(options.constants.iter().flat_map(javascript::constant));
    lines.push(String::new());
    if tree.has_parameters() {
        lines.extend(of_javascript.parameters());
        lines.extend(helpers::PARAMETERS.lines().map(str::to_owned));
        if !options.setters.is_empty() {
            lines.extend(helpers::LENGTHS.lines().map(str::to_owned));
        }
        lines.extend(of_javascript.setters());
    }
    lines.extend([
        format!("const PARAMETERS = [{}];", of_javascript.parameter_names()),
        format!("const FIELDS = {};", tree.fields.len()),
        format!("const NUMBERS = {};", printer.array()),
        "// Of each function: its names, the lengths of its inputs, and of its outputs name, length and shape.".to_owned(),
        "const FUNCTIONS = [".to_owned(),
    ]);
    lines.extend(printer.functions().map(|(function, batch)| row(function, batch)));
    lines.extend(["];", ""].map(str::to_owned));
    let address = format!("./{}.wasm", tree.name);
    lines.extend(LOADER.replace("ADDRESS", &address).lines().map(str::to_owned));
    lines.push(String::new());
    lines.join("\n")
}

fn row(function: &Function<'_>, batch: Option<&str>) -> String {
    let inputs = function.inputs.iter().map(|array| array.length.to_string());
    let outputs = function.source.outputs.iter().zip(&function.outputs).map(|(output, array)| {
        format!("[\"{}\", {}, {}]", array.name, array.length, output.shape.len())
    });
    let batch = batch.map_or("null".to_owned(), |name| format!("\"{name}\""));
    format!(
        "    [\"{}\", {batch}, [{}], [{}]],",
        function.name,
        inputs.collect::<Vec<_>>().join(", "),
        outputs.collect::<Vec<_>>().join(", ")
    )
}

const LOADER: &str = r#"/**
 * Loads the module from its bytes, a compiled module, a response or a URL; by default from the file beside this
 * one.
 */
export async function load(source = new URL("ADDRESS", import.meta.url)) {
    const module = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(await bytes_of(source));
    return robot_of((await WebAssembly.instantiate(module)).exports);
}

async function bytes_of(source) {
    if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) {
        return source;
    }
    if (typeof Response === "function" && source instanceof Response) {
        return source.arrayBuffer();
    }
    const address = new URL(source, import.meta.url);
    if (address.protocol === "file:" && globalThis.process?.versions?.node) {
        return (await import("node:fs/promises")).readFile(address);
    }
    const response = await fetch(address);
    if (!response.ok) {
        throw new Error(`${address}: status ${response.status}`);
    }
    return response.arrayBuffer();
}

function robot_of(exports) {
    const { memory } = exports;
    let free = exports.heap_base.value;
    const reserve = (bytes) => {
        const [address, next] = [free, free + Math.ceil(bytes / 16) * 16];
        const missing = next - memory.buffer.byteLength;
        if (missing > 0) {
            memory.grow(Math.ceil(missing / 65536));
        }
        free = next;
        return address;
    };
    const numbers = (address, count) => new NUMBERS(memory.buffer, address, count);
    const allocate = (count) => reserve(count * NUMBERS.BYTES_PER_ELEMENT);
    const robot = { exports, memory, allocate, numbers };

    // Without a model, a call would read from the start of the memory.
    const check_model = (name, model) => {
        if (!Number.isInteger(model)) {
            throw new TypeError(`${name}: the first argument is not a model; make one with create_model`);
        }
    };

    if (PARAMETERS.length > 0) {
        const given = reserve(PARAMETERS.length * 8);
        robot.update_model = (model, parameters) => {
            check_model("update_model", model);
            _check_parameters(parameters, PARAMETERS);
            const values = PARAMETERS.map((name) => parameters[name]);
            new Float64Array(memory.buffer, given, PARAMETERS.length).set(values);
            exports.create_model(model, given);
        };
        robot.create_model = (parameters) => {
            const model = allocate(FIELDS);
            robot.update_model(model, parameters);
            return model;
        };
    }

    // Arrays of a call lie in memory that the next call uses again.
    let [space, size] = [free, 0];
    const workspace = (count) => {
        if (count > size) {
            const larger = Math.max(count, 2 * size);
            space = allocate(larger);
            size = larger;
        }
        return space;
    };
    const wrapped = (name, inputs, outputs, is_batch) => {
        const all = [...inputs, ...outputs.map(([, length]) => length)];
        const total = all.reduce((sum, length) => sum + length, 0);
        return (...given) => {
            const first = PARAMETERS.length > 0 ? [given.shift()] : [];
            first.forEach((model) => check_model(name, model));
            const n = is_batch ? given.shift() : 1;
            if (!Number.isInteger(n) || n < 0) {
                throw new RangeError(`${name}: the number of states is ${n}`);
            }
            inputs.forEach((length, i) => {
                if (given[i]?.length !== n * length) {
                    throw new RangeError(`${name}: input ${i + 1} has ${given[i]?.length} entries, not ${n * length}`);
                }
            });
            let next = workspace(n * total);
            const places = all.map((length) => {
                const place = next;
                next += n * length * NUMBERS.BYTES_PER_ELEMENT;
                return place;
            });
            inputs.forEach((length, i) => numbers(places[i], n * length).set(given[i]));
            exports[name](...first, ...(is_batch ? [n, n] : []), ...places);
            const found = outputs.map(([, length, shape], i) => {
                const values = numbers(places[inputs.length + i], n * length);
                if (shape === 0 && !is_batch) {
                    return values[0];
                }
                const result = given[inputs.length + i] ?? new NUMBERS(n * length);
                if (result.length !== n * length) {
                    throw new RangeError(`${name}: ${outputs[i][0]} has ${result.length} entries, not ${n * length}`);
                }
                values.forEach((value, j) => {
                    result[j] = value;
                });
                return result;
            });
            return found.length === 1 ? found[0] : Object.fromEntries(found.map((one, i) => [outputs[i][0], one]));
        };
    };
    for (const [name, batch, inputs, outputs] of FUNCTIONS) {
        robot[name] = wrapped(name, inputs, outputs, false);
        if (batch) {
            robot[batch] = wrapped(batch, inputs, outputs, true);
        }
    }
    return Object.freeze(robot);
}"#;
