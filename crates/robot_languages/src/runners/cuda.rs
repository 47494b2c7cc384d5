//! CUDA C++: it is run on the processor as C++, compiled for a device by NVRTC, and run on a device if one is
//! available.

use std::path::Path;

use robot_build::languages::Language;
use robot_codegen::Scalar;
use robot_codegen::backend::c;
use robot_codegen::backend::flat::FlatOptions;

use super::c::{Calls, program, static_columns};
use super::{Found, Runner, read, results, write_package};
use crate::files;
use crate::work::Work;

/// The runner of the header as C++: keywords of CUDA are defined as empty, and a kernel is called for each thread of a
/// grid.
pub(super) struct Cuda;

/// Definitions of keywords and library functions of CUDA for g++.
const SHIMS: &str = "#pragma once
#include <cstdlib>
#define __host__
#define __device__
#define __global__
#define __noinline__ __attribute__((noinline))
#define __forceinline__ inline __attribute__((always_inline))
struct Index {
    unsigned x;
};
[[maybe_unused]] static Index gridDim = {1}, blockDim = {1}, blockIdx = {0}, threadIdx = {0};
enum cudaError_t { cudaSuccess };
template <class T> cudaError_t cudaMallocManaged(T **memory, std::size_t size)
{
    *memory = static_cast<T *>(std::malloc(size));
    return cudaSuccess;
}
inline cudaError_t cudaFree(void *memory)
{
    std::free(memory);
    return cudaSuccess;
}
inline cudaError_t cudaGetLastError() { return cudaSuccess; }
inline cudaError_t cudaDeviceSynchronize() { return cudaSuccess; }
inline const char *cudaGetErrorString(cudaError_t) { return \"\"; }
";

/// The loop over a grid with fewer threads than states, so that each thread computes several states, in several blocks.
const GRID: &str = "for (unsigned thread = 0; gridDim.x = 3, blockDim.x = 7, thread < 21; thread++) \
                    blockIdx.x = thread / 7, threadIdx.x = thread % 7, ";

const CALLS: Calls = Calls {
    ending: "cuh",
    top: "#include \"shims.h\"\n",
    model: "model, ",
    before: GRID,
    grid: "",
    after: "",
    columns: static_columns,
    has_batch: |function| !function.inputs.is_empty(),
};

impl Runner for Cuda {
    fn name(&self) -> &'static str {
        "cuda as C++"
    }

    fn missing(&self) -> Option<String> {
        (!files::is_there("g++", &["--version"])).then(|| "g++ is not installed".to_owned())
    }

    fn has(&self, _: Scalar) -> bool {
        true
    }

    /// Compiles without optimization, which takes a fifth of the time; the runner of g++ optimizes the same functions.
    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String> {
        write_package(work, Language::Cuda, folder)?;
        files::write(folder, "shims.h", SHIMS.as_bytes())?;
        let example = String::from_utf8_lossy(&read(folder, "example.cu")?).into_owned();
        // A grid of one thread computes all states.
        let example = example.replace("<<<1, 32>>>", "").replace("<<<1, 1>>>", "");
        let example = format!("#include \"shims.h\"\n{example}");
        files::write(folder, "example.cpp", example.as_bytes())?;
        let options = ["-std=c++17", "-O0", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror"];
        compiled_and_run(work, folder, &CALLS, ["g++", "cpp"], &options)
    }
}

/// Compiles a program with all calls, and the example of the package, runs both, and returns the results of the calls.
fn compiled_and_run(
    work: &Work,
    folder: &Path,
    calls: &Calls,
    [compiler, ending]: [&str; 2],
    options: &[&str],
) -> Result<Vec<Found>, String> {
    let tree_options = FlatOptions { scalar: work.options.scalar, ..FlatOptions::default() };
    let tree = c::cuda_tree(&work.programs.module, &tree_options);
    let text = program(work, &tree, calls);
    files::write(folder, &format!("main.{ending}"), text.as_bytes())?;
    for source in ["main", "example"] {
        let file = format!("{source}.{ending}");
        let arguments = [options, &[&file, "-o", source]].concat();
        files::run(folder, compiler, &arguments)?;
        files::run(folder, &format!("./{source}"), &[])?;
    }
    let has_batch = |index: usize| (calls.has_batch)(&tree.functions[index]);
    Ok(vec![
        Found { way: "single", results: results(work, &read(folder, "single.bin")?, |_| true)? },
        Found { way: "kernel", results: results(work, &read(folder, "batch.bin")?, has_batch)? },
    ])
}

/// The runner on a device, with the header compiled by nvcc: functions are called on the host, and kernels on the
/// device.
pub(super) struct Nvcc;

/// Columns that host and device share, filled with NaN, and the wait for a kernel.
const DEVICE: &str = "#include <cstdio>
#include <cstdlib>
#include <cstring>

static void check(cudaError_t error)
{
    if (error != cudaSuccess) {
        std::fprintf(stderr, \"%s\\n\", cudaGetErrorString(error));
        std::exit(4);
    }
}

template <class T> static T *shared_columns(std::size_t count)
{
    T *memory = nullptr;
    check(cudaMallocManaged(&memory, count * sizeof(T)));
    std::memset(memory, 0xff, count * sizeof(T));
    return memory;
}

static void finish()
{
    check(cudaGetLastError());
    check(cudaDeviceSynchronize());
}

";

/// Calls of kernels, with fewer threads than states.
const DEVICE_CALLS: Calls = Calls {
    top: DEVICE,
    before: "",
    grid: "<<<3, 7>>>",
    after: " finish();",
    columns: |[real, name, count]| format!("{real} *{name} = shared_columns<{real}>({count});"),
    ..CALLS
};

impl Runner for Nvcc {
    fn name(&self) -> &'static str {
        "nvcc"
    }

    fn missing(&self) -> Option<String> {
        if !files::is_there("nvcc", &["--version"]) {
            return Some("nvcc is not installed".to_owned());
        }
        (!files::is_there("nvidia-smi", &["-L"])).then(|| "`nvidia-smi` finds no device".to_owned())
    }

    fn has(&self, _: Scalar) -> bool {
        true
    }

    fn has_standard_sines(&self) -> bool {
        false
    }

    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String> {
        write_package(work, Language::Cuda, folder)?;
        let options = [
            "-std=c++17",
            "-arch=native",
            "-fmad=false",
            "-Werror",
            "all-warnings",
            "-Xcompiler",
            "-ffp-contract=off,-Wall,-Wextra",
        ];
        compiled_and_run(work, folder, &DEVICE_CALLS, ["nvcc", "cu"], &options)
    }
}

/// The runner that compiles the header to PTX with NVRTC from its Python package. It does not compare bits: missing
/// kernels and fused products are errors.
pub(super) struct Nvrtc;

/// Finds the library in the Python package.
const NVRTC: &str = "import importlib.util, pathlib
folder = importlib.util.find_spec('nvidia.cuda_nvrtc').submodule_search_locations[0]
library = next((pathlib.Path(folder) / 'lib').glob('libnvrtc.so*'))
";

/// Compiles `robot.cuh` to `robot.ptx`.
const COMPILE: &str = "import ctypes

nvrtc = ctypes.CDLL(str(library))
program = ctypes.c_void_p()
text = open('robot.cuh', 'rb').read()
assert nvrtc.nvrtcCreateProgram(ctypes.byref(program), text, b'robot.cuh', 0, None, None) == 0
options = (ctypes.c_char_p * 2)(b'--std=c++17', b'-fmad=false')
failed = nvrtc.nvrtcCompileProgram(program, 2, options)


def said(what):
    size = ctypes.c_size_t()
    assert getattr(nvrtc, f'nvrtcGet{what}Size')(program, ctypes.byref(size)) == 0
    text = ctypes.create_string_buffer(size.value)
    assert getattr(nvrtc, f'nvrtcGet{what}')(program, text) == 0
    return text.value.decode()


log = said('ProgramLog')
assert not failed and not log, log
open('robot.ptx', 'w').write(said('PTX'))
";

impl Runner for Nvrtc {
    fn name(&self) -> &'static str {
        "nvrtc"
    }

    fn missing(&self) -> Option<String> {
        let is_there = files::is_there("python3", &["-c", NVRTC]);
        (!is_there).then(|| "the Python package nvidia-cuda-nvrtc-cu12 is not installed".to_owned())
    }

    fn has(&self, _: Scalar) -> bool {
        true
    }

    fn has_standard_sines(&self) -> bool {
        false
    }

    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String> {
        write_package(work, Language::Cuda, folder)?;
        let options = FlatOptions { scalar: work.options.scalar, ..FlatOptions::default() };
        let name = c::cuda_tree(&work.programs.module, &options).name;
        let header = read(folder, &format!("{name}.cuh"))?;
        let header = String::from_utf8_lossy(&header).into_owned();
        files::write(folder, "robot.cuh", header.as_bytes())?;
        files::write(folder, "compile.py", format!("{NVRTC}{COMPILE}").as_bytes())?;
        files::run(folder, "python3", &["compile.py"])?;
        let ptx = String::from_utf8_lossy(&read(folder, "robot.ptx")?).into_owned();
        let kernels = header.matches("_KERNEL_ void ").count();
        let (entries, fused) = (ptx.matches(".entry ").count(), ptx.matches("fma.rn").count());
        match (entries == kernels && kernels > 0, fused) {
            (true, 0) => Ok(vec![]),
            _ => Err(format!("PTX has {entries} of {kernels} kernels, and {fused} fused products")),
        }
    }
}
