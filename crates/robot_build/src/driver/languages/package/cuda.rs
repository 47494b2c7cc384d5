//! A package in CUDA C++: the header, an example that is also the test, and a file for CMake.

use robot_codegen::Scalar;
use robot_codegen::backend::SourceFile;
use robot_codegen::backend::c::{self, BATCH, Names};
use robot_codegen::backend::flat::{Array, Function};

use super::c::Printer;
use super::{Parts, description, file, of_sources};
use crate::driver::check::CheckValue;
use crate::driver::file::File;
use crate::driver::generate::unnamed_header;

/// Makes the files of the package.
pub(super) fn files(parts: &Parts<'_>, sources: Vec<SourceFile>) -> Vec<File> {
    let tree = c::cuda_tree(parts.module, parts.flat);
    let printer = Printer { parts, tree: &tree, names: Names::new(&tree.name), casadi: None };
    let mut files = vec![
        file("README.md", readme(&printer)),
        file("CMakeLists.txt", cmake(&tree.name)),
        file("robot.json", description::json(parts, &tree)),
    ];
    files.extend(of_sources(sources));
    files.push(file("example.cu", example(&printer)));
    files
}

fn cmake(name: &str) -> String {
    format!(
        "# {}
cmake_minimum_required(VERSION 3.18)
project({name} LANGUAGES CXX CUDA)

add_library({name} INTERFACE)
target_include_directories({name} INTERFACE ${{CMAKE_CURRENT_SOURCE_DIR}})
target_compile_features({name} INTERFACE cuda_std_17)
# Products and sums are not fused, so that results have the same bits on every machine. Without these lines they are
# fused, which is faster but changes the last bits.
target_compile_options({name} INTERFACE $<$<COMPILE_LANG_AND_ID:CUDA,NVIDIA>:-fmad=false>)
target_compile_options({name} INTERFACE $<$<COMPILE_LANG_AND_ID:CUDA,Clang>:-ffp-contract=off>)
target_compile_options({name} INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-ffp-contract=off>)

enable_testing()
add_executable({name}_example example.cu)
target_link_libraries({name}_example PRIVATE {name})
add_test(NAME {name} COMMAND {name}_example)
",
        unnamed_header()
    )
}

/// Returns the address of each array of a function in memory in which they follow each other, and the size of all.
fn places<'f>(function: &'f Function<'_>) -> (Vec<(&'f Array, String)>, usize) {
    let mut size = 0;
    let arrays = function.inputs.iter().chain(&function.outputs).map(|array| {
        let place = format!("memory + {size}");
        size += array.length;
        (array, place)
    });
    (arrays.collect(), size)
}

/// Prints the call of a function's kernel for one state in this memory.
fn launch(printer: &Printer<'_>, function: &Function<'_>) -> String {
    let model = printer.tree.has_parameters().then(|| "model".to_owned());
    let size = ["1", "1"].map(str::to_owned);
    let places = places(function).0.into_iter().map(|(_, place)| place);
    let arguments: Vec<String> = model.into_iter().chain(size).chain(places).collect();
    let kernel = printer.names.item(function.form(BATCH));
    format!("{kernel}<<<1, 32>>>({});", arguments.join(", "))
}

fn readme(printer: &Printer<'_>) -> String {
    let (name, real) = (&printer.tree.name, printer.real());
    let mut usage = format!("```cuda\n#include \"{name}.cuh\"\n\n");
    for line in printer.model() {
        usage.push_str(&format!("{line}\n"));
    }
    let function = printer.tree.functions.iter().find(|function| !function.inputs.is_empty());
    if let Some(function) = function {
        let model = printer.tree.has_parameters().then_some("model");
        let arrays = function.inputs.iter().chain(&function.outputs);
        let arguments = model.into_iter().chain(["n", "n"]);
        let arguments = arguments.chain(arrays.map(|array| array.name.as_str()));
        usage.push_str(&format!(
            "{}<<<(n + 127) / 128, 128>>>({});\n",
            printer.names.item(function.form(BATCH)),
            arguments.collect::<Vec<_>>().join(", ")
        ));
    }
    usage.push_str(&format!(
        "```\n\nEvery function is in the header `{name}.cuh`, for host and device. Each one with inputs also has a kernel \
         `…_kernel` over `n` states, on a one-dimensional grid of any size: entry j of state i is at `[j * stride + i]` in an array in \
         device memory, so neighboring threads read neighboring numbers. Arrays have elements of type `{real}`; a matrix is \
         an array, row by row.{} To test it:\n\n```sh\nnvcc -std=c++17 -O3 -fmad=false example.cu -o example && ./example\n```\n\nor with \
         CMake: `cmake -B build && cmake --build build && ctest --test-dir build`. Without `-fmad=false` the compiler fuses products and \
         sums: this is faster, but last bits differ{}. {} The header can also be compiled at run time (NVRTC, CuPy's \
         `RawModule`): kernels then have their plain names.\n",
        if printer.tree.has_parameters() {
            " A kernel takes the model by value; the host computes it once."
        } else {
            ""
        },
        if printer.has_bits() { ", and the test says so" } else { "" },
        match printer.parts.options.scalar {
            Scalar::F64 => "`-use_fast_math` implies `-fmad=true`.",
            Scalar::F32 => "With `-use_fast_math` divisions and roots are also approximate.",
        }
    ));
    let constructor = printer.names.item("model_init");
    let what = "CUDA C++: straight-line code without branches or allocation";
    printer.parts.readme(printer.tree, what, &usage, &constructor)
}

fn example(printer: &Printer<'_>) -> String {
    let (name, real) = (&printer.tree.name, printer.real());
    let sizes = printer.tree.functions.iter().map(|function| places(function).1);
    let size = sizes.max().unwrap_or(0).max(1);
    let mut text = format!(
        "/* {} */\n/* The check values of the README, on the host and on the device. */\n\n#include \"{name}.cuh\"\n\n#include \
         <cstdio>\n#include <cstring>\n\n",
        unnamed_header()
    );
    text.push_str(&printer.comparison("compile with -fmad=false and without -use_fast_math"));
    text.push_str(
        "/* Waits for the kernel. */
static void finish(const char *what)
{
    cudaError_t error = cudaGetLastError();
    if (error == cudaSuccess) {
        error = cudaDeviceSynchronize();
    }
    if (error != cudaSuccess) {
        printf(\"%s: %s\\n\", what, cudaGetErrorString(error));
        failures++;
    }
}

",
    );
    if printer.has_bits() {
        text.push_str(FLAGS);
    }
    text.push_str("int main()\n{\n");
    for line in printer.model() {
        text.push_str(&format!("    {line}\n"));
    }
    text.push_str(&format!(
        "    {real} *memory = nullptr;
    if (cudaMallocManaged(&memory, {size} * sizeof({real})) != cudaSuccess) {{
        printf(\"cannot allocate memory for a state on the device\\n\");
        return 2;
    }}
"
    ));
    if printer.has_bits() {
        text.push_str(
            "    fused<<<1, 1>>>(7.450580596923828e-9, (double *)memory);
    finish(\"fused\");
    if (*(double *)memory != 0.0) {
        printf(\"products and sums are fused: compile with -fmad=false\\n\");
    }
",
        );
    }
    for check in printer.parts.checks {
        text.push_str(&block(printer, check));
    }
    text.push_str(
        "    cudaFree(memory);
    printf(failures ? \"FAILED\\n\" : \"all results match the check values\\n\");
    return failures != 0;
}
",
    );
    text
}

/// A kernel that detects whether the compiler fuses products and sums.
const FLAGS: &str = "/* (1 + e)^2 - 1 - 2 e is e^2 if a product and a sum are fused, else 0. */
static __global__ void fused(double e, double *found)
{
    const double a = 1.0 + e, b = 1.0 + 2.0 * e;
    *found = a * a - b;
}

";

/// Prints the check of a function at its check state.
fn block(printer: &Printer<'_>, check: &CheckValue) -> String {
    let Some(function) = printer.function(&check.function) else { return String::new() };
    let (name, real) = (&function.name, printer.real());
    let mut lines = vec![];
    let mut arguments = vec![];
    if printer.tree.has_parameters() {
        arguments.push("&model".to_owned());
    }
    for (array, (_, values)) in function.inputs.iter().zip(&check.inputs) {
        let values = printer.numbers(values);
        lines.push(format!("const {real} {}[{}] = {{{values}}};", array.name, array.length));
        arguments.push(array.name.clone());
    }
    let mut compared = vec![];
    for (array, output) in function.outputs.iter().zip(&check.outputs) {
        let (length, values) = (array.length, printer.numbers(&output.values));
        let stated = format!("stated_{}_", array.name);
        lines.push(format!("{real} {}[{length}];", array.name));
        lines.push(format!("const {real} {stated}[{length}] = {{{values}}};"));
        arguments.push(array.name.clone());
        compared.push((array, stated));
    }
    lines.push(format!("{}({});", printer.names.item(name), arguments.join(", ")));
    for (array, stated) in &compared {
        let (found, length) = (&array.name, array.length);
        lines.push(format!("check(\"{name} on the host\", {found}, {stated}, {length});"));
    }
    if !function.inputs.is_empty() {
        let places = places(function).0;
        for (array, place) in places.iter().take(function.inputs.len()) {
            let array = &array.name;
            lines.push(format!("memcpy({place}, {array}, sizeof {array});"));
        }
        lines.push(launch(printer, function));
        lines.push(format!("finish(\"{name}\");"));
        let outputs = places.iter().skip(function.inputs.len()).zip(&compared);
        for ((array, place), (_, stated)) in outputs {
            let length = array.length;
            lines.push(format!("check(\"{name} on the device\", {place}, {stated}, {length});"));
        }
    }
    let lines: String = lines.iter().map(|line| format!("        {line}\n")).collect();
    format!("    {{\n{lines}    }}\n")
}
