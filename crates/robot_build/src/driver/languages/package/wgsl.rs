//! A package in WGSL: the module, and a test with the Python package `wgpu`.

use robot_codegen::Interpreter;
use robot_codegen::backend::SourceFile;
use robot_codegen::backend::flat::Tree;
use robot_codegen::backend::wgsl;
use serde_json::{Map, Value, json};

use super::{Parts, description, file, of_sources};
use crate::driver::file::File;
use crate::driver::generate::unnamed_header;
use crate::error::Errors;

/// Makes the files of the package.
///
/// # Errors
///
/// Parameters that the interpreter does not accept.
pub(super) fn files(parts: &Parts<'_>, sources: Vec<SourceFile>) -> Result<Vec<File>, Errors> {
    let tree = wgsl::tree(parts.module);
    let mut files = vec![
        file("README.md", readme(parts, &tree)),
        file("robot.json", description::text(&described(parts, &tree)?)),
    ];
    files.extend(of_sources(sources));
    files.push(file("test.py", format!("# {}\n{}", unnamed_header(), test())));
    Ok(files)
}

/// Makes the description, with the names of the kernels and the numbers of the model.
fn described(parts: &Parts<'_>, tree: &Tree<'_>) -> Result<Value, Errors> {
    let mut value = description::value(parts, tree);
    if let Some(Value::Array(functions)) = value.get_mut("functions") {
        for (described, function) in functions.iter_mut().zip(&tree.functions) {
            described["kernel"] = json!(wgsl::kernel_name(tree, function));
        }
    }
    let specs = parts.module.parameters.iter().map(|spec| spec.name.as_str());
    let given: Vec<(&str, f64)> = specs.zip(parts.stated_parameters()).collect();
    let interpreter = Interpreter::new(parts.module, &given)
        .map_err(|errors| Errors::of_code(&parts.source.name, &errors))?
        .with_trigonometry(parts.options.trigonometry);
    let fields = tree.fields.iter().cloned().zip(interpreter.fields());
    let fields: Map<String, Value> = fields.map(|(name, field)| (name, json!(field))).collect();
    value["model"] = Value::Object(if wgsl::has_model(tree) { fields } else { Map::new() });
    Ok(value)
}

fn readme(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    let name = &tree.name;
    let mut usage = format!(
        "`{name}.wgsl` has a function for each function of the robot and, for each one with inputs, an entry point `…_kernel` over `n` \
         states, in workgroups of {}, any number of them in x. All entry points share one group of bindings:\n\n| binding | \
         buffer | contents |\n|---|---|---|\n| 0 | storage, read | the inputs: entry j of state i is at `[j * stride + i]`, where j \
         counts the entries of all inputs together, in their order |\n| 1 | storage, read and write | the outputs, in the same way |\n| 2 | \
         uniform | `n` and `stride`, two `u32`; `stride` is at least `n` |\n",
        wgsl::WORKGROUP
    );
    if wgsl::has_model(tree) {
        usage.push_str(
            "| 3 | uniform | the model: the values that depend only on the parameters |\n",
        );
    }
    usage.push_str(
        "\nDeclare the group yourself: a layout derived from an entry point lacks the buffers that it does not read. WGSL does not \
         specify the rounding of sums of products: last bits differ from machine to machine, and NaN may become any number. ",
    );
    if wgsl::has_model(tree) {
        usage.push_str(
            "`robot.json` has the numbers of the model at the stated parameters, in their order; for other parameters `create_model` \
             in a JavaScript or Python package returns the same fields in double precision. ",
        );
    }
    usage.push_str(
        "`test.py` tests the check values, and is an example of a host:\n\n```sh\npip install wgpu numpy && python test.py\n```\n",
    );
    parts.readme(tree, "WGSL: compute kernels in single precision", &usage, "create_model")
}

/// The test, with the size of the workgroups.
fn test() -> String {
    TEST.replace("WORKGROUP", &wgsl::WORKGROUP.to_string())
}

/// The test, which reads all names from `robot.json`. `WORKGROUP` stands for the number.
const TEST: &str = r#""""The check values of the README, on the first device that wgpu finds."""

import json
import math
import pathlib
import sys

import numpy
import wgpu

FOLDER = pathlib.Path(__file__).parent


class Robot:
    """The kernels of a package on a device."""

    def __init__(self, folder=FOLDER):
        self.described = json.loads((folder / "robot.json").read_text())
        adapter = wgpu.gpu.request_adapter_sync(power_preference="high-performance")
        self.device = adapter.request_device_sync()
        self.name = adapter.info["device"]
        text = (folder / f"{self.described['module']}.wgsl").read_text()
        self.shader = self.device.create_shader_module(code=text)
        kinds = ["read-only-storage", "storage", "uniform"]
        self.model = numpy.array(list(self.described["model"].values()), "float32")
        if self.model.size:
            kinds.append("uniform")
        entries = [
            {"binding": index, "visibility": wgpu.ShaderStage.COMPUTE, "buffer": {"type": kind}}
            for index, kind in enumerate(kinds)
        ]
        self.group = self.device.create_bind_group_layout(entries=entries)
        self.layout = self.device.create_pipeline_layout(bind_group_layouts=[self.group])

    def call(self, function, inputs):
        """The outputs of a function, a row for each entry and a column for each state, from inputs of that kind."""
        inputs = numpy.ascontiguousarray(inputs, "float32")
        states = inputs.shape[1]
        rows = sum(math.prod(output["shape"]) for output in function["outputs"])
        use = wgpu.BufferUsage
        held = [
            self.device.create_buffer_with_data(data=inputs, usage=use.STORAGE),
            self.device.create_buffer(size=4 * rows * states, usage=use.STORAGE | use.COPY_SRC),
            self.device.create_buffer_with_data(data=numpy.array([states, states], "uint32"), usage=use.UNIFORM),
        ]
        if self.model.size:
            held.append(self.device.create_buffer_with_data(data=self.model, usage=use.UNIFORM))
        bindings = [{"binding": index, "resource": {"buffer": buffer}} for index, buffer in enumerate(held)]
        bound = self.device.create_bind_group(layout=self.group, entries=bindings)
        compute = {"module": self.shader, "entry_point": function["kernel"]}
        pipeline = self.device.create_compute_pipeline(layout=self.layout, compute=compute)
        encoder = self.device.create_command_encoder()
        kernel = encoder.begin_compute_pass()
        kernel.set_pipeline(pipeline)
        kernel.set_bind_group(0, bound)
        kernel.dispatch_workgroups(min(-(-states // WORKGROUP), 65535))
        kernel.end()
        self.device.queue.submit([encoder.finish()])
        found = numpy.frombuffer(self.device.queue.read_buffer(held[1]), "float32")
        return found.reshape(rows, states)


def main():
    robot = Robot()
    failed = 0
    for function in robot.described["functions"]:
        check = function.get("check")
        if check is None or function["kernel"] is None:
            continue
        found = robot.call(function, numpy.concatenate(check["inputs"]).reshape(-1, 1))
        stated = numpy.concatenate(check["outputs"]).reshape(-1, 1)
        meets = (abs(found - stated) <= 1e-4 * abs(stated).max()).all()
        if not meets:
            failed += 1
            print(f"{function['name']} gives {found.ravel()}, expected {stated.ravel()}")
    print("FAILED" if failed else f"all results match the check values ({robot.name})")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
"#;
