//! CUDA C++: the functions of C for host and device, and for each a kernel over columns of states.

use super::batch::{column_parameters, has_batch, iteration, one, place, unread};
use super::comment;
use super::function::{model_argument, used_by};
use super::{BATCH, Dialect, Header, LANGUAGE as C, names, tree_of};
use crate::backend::common::check_range;
use crate::backend::flat::{FlatOptions, Function, Tree};
use crate::backend::{Language, SourceFile, Target};
use crate::error::Errors;
use crate::module::Module;

/// CUDA C++, as a language of printed code.
pub(super) const LANGUAGE: Language = Language { name: "CUDA C++", extension: "cuh", ..C };

/// Names of CUDA in addition to those of C++.
const WORDS: &[&str] =
    &["blockDim", "blockIdx", "dim3", "gridDim", "threadIdx", "warpSize", "step"];

/// The printer of CUDA C++.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cuda {
    /// The options.
    pub options: FlatOptions,
}

impl Target for Cuda {
    fn language(&self) -> &'static Language {
        &LANGUAGE
    }

    /// Prints one header.
    fn files(&self, module: &Module) -> Result<Vec<SourceFile>, Errors> {
        check_range(module, self.options.scalar)?;
        let tree = cuda_tree(module, &self.options);
        let text = Header::new(&tree, &self.options, Dialect::Cuda).text();
        Ok(vec![SourceFile::text(format!("{}.{}", tree.name, LANGUAGE.extension), text)])
    }
}

/// The tree that is printed as CUDA C++. The kernel of a function is its additional form with the index [`BATCH`].
#[must_use]
pub fn cuda_tree<'m>(module: &'m Module, options: &FlatOptions) -> Tree<'m> {
    let taken = [names::TAKEN, WORDS].concat();
    tree_of(module, &LANGUAGE, options, &taken, &["sc", "kernel"])
}

/// The includes. NVRTC, the compiler at run time, has no headers, but has their functions built in.
pub(super) const INCLUDES: &str = "#if defined(__CUDACC_RTC__)
#if !defined(UINT64_C)
typedef unsigned int uint32_t;
typedef unsigned long long uint64_t;
#define UINT32_C(x) x##U
#define UINT64_C(x) x##ULL
#endif
#else
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#endif";

/// Prints the macros for functions, parts of functions, pointers, and kernels.
pub(super) fn macros([inline, part, restrict]: [&str; 3], kernel: &str) -> String {
    format!(
        "#define {inline} [[maybe_unused]] static __host__ __device__ __forceinline__
#define {part} [[maybe_unused]] static __host__ __device__ __noinline__
#define {restrict} __restrict__
#if defined(__CUDACC_RTC__)
#define {kernel} extern \"C\" __global__
#else
#define {kernel} [[maybe_unused]] static __global__
#endif
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif
"
    )
}

/// Prints the kernel of a function, if the function has inputs.
pub(super) fn kernel(header: &Header<'_>, function: &Function<'_>) -> Vec<String> {
    if function.inputs.is_empty() {
        return vec![];
    }
    let plain = header.names.item(&function.name);
    let mut lines = comment::of_paragraphs(&[
        format!("`{plain}` of `n` states, on a grid of any size of one dimension."),
        String::new(),
        "Entry j of state i is at `[j * stride + i]`: a column for each entry, `stride` apart; `stride` is at \
         least `n`. Arrays are in the memory of the device."
            .to_owned(),
    ]);
    let has_model = header.tree.has_parameters();
    let model = has_model.then(|| format!("const {} model_", header.names.item("model")));
    let mut parameters: Vec<String> = model.into_iter().collect();
    parameters.extend(column_parameters(header, function));
    lines.push(format!(
        "{} void {}({})",
        header.names.private_upper("kernel"),
        header.names.item(function.form(BATCH)),
        parameters.join(", ")
    ));
    lines.push("{".to_owned());
    if has_model {
        lines.push(format!("    const {} *model = &model_;", header.names.item("model")));
    }
    lines.push("    const size_t step = (size_t)gridDim.x * blockDim.x;".to_owned());
    lines.push("    size_t i = (size_t)blockIdx.x * blockDim.x + threadIdx.x;".to_owned());
    lines.extend(unread(function));
    lines.push("    for (; i < n; i += step) {".to_owned());
    let state = if has_batch(function) { iteration } else { call };
    lines.extend(state(header, function).into_iter().map(|line| format!("    {line}")));
    lines.extend(["    }", "}", ""].map(str::to_owned));
    lines
}

/// Prints the computation of one state as a call of the function, for functions that are cut into parts.
fn call(header: &Header<'_>, function: &Function<'_>) -> Vec<String> {
    let real = header.real();
    let in_core = used_by(function, &function.core);
    let in_angles = used_by(function, &function.angles);
    let mut lines = vec![];
    for (array, used) in function.inputs.iter().zip(in_core.iter().zip(&in_angles)) {
        let entry = |entry: usize| match used {
            (false, false) => "0".to_owned(),
            _ => format!("{}[{}]", array.name, place(entry)),
        };
        let entries: Vec<String> = (0..array.length).map(entry).collect();
        let (name, length) = (one(array), array.length);
        lines.push(format!("    const {real} {name}[{length}] = {{{}}};", entries.join(", ")));
    }
    let mut arguments = model_argument(header);
    for array in &function.outputs {
        lines.push(format!("    {real} {}[{}];", one(array), array.length));
    }
    arguments.extend(function.inputs.iter().chain(&function.outputs).map(one));
    lines.push(format!("    {}({});", header.names.item(&function.name), arguments.join(", ")));
    for array in &function.outputs {
        for entry in 0..array.length {
            lines.push(format!("    {}[{}] = {}[{entry}];", array.name, place(entry), one(array)));
        }
    }
    lines
}
