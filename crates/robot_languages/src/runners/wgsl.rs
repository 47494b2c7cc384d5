//! WGSL, validated by naga, and run on the device that the Python package `wgpu` finds, which can be the processor.

use std::path::Path;

use robot_build::languages::Language;
use robot_codegen::Scalar;
use robot_codegen::backend::wgsl;

use super::{Found, Runner, read, results, write_package};
use crate::files;
use crate::work::Work;

/// The runner of naga's validator. It does not compare bits: its findings are errors.
pub(super) struct Naga;

impl Runner for Naga {
    fn name(&self) -> &'static str {
        "naga"
    }

    fn missing(&self) -> Option<String> {
        let is_there = files::is_there("naga", &["--version"]);
        (!is_there).then(|| "naga-cli is not installed".to_owned())
    }

    fn has(&self, scalar: Scalar) -> bool {
        scalar == Scalar::F32
    }

    fn has_standard_sines(&self) -> bool {
        false
    }

    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String> {
        write_package(work, Language::Wgsl, folder)?;
        let name = wgsl::tree(&work.programs.module).name;
        files::run(folder, "naga", &[&format!("{name}.wgsl")])?;
        Ok(vec![])
    }
}

/// The runner of kernels on a device, and of the package's test.
pub(super) struct Wgsl;

/// The largest permitted distance of single precision on a device from double precision, in units in the last place of
/// the function's largest output. The largest distance on lavapipe so far was 90.5, for the derivatives of the Panda's
/// forward dynamics.
const BOUND: f64 = 128.0;

/// Code that finds a device.
const PROBE: &str = "import numpy, wgpu; wgpu.gpu.request_adapter_sync()";

/// Code that calls every kernel.
const CALLS: &str = "import numpy
import test

robot = test.Robot()
data = numpy.fromfile('states.bin', 'float32')
place = 0
found = open('kernel.bin', 'wb')
for function, states in zip(robot.described['functions'], STATES):
    if function['kernel'] is None:
        continue
    width = sum(len(taken['entries']) for taken in function['inputs'])
    block = data[place : place + width * states].reshape(states, width)
    place += width * states
    robot.call(function, block.T).T.copy().tofile(found)
found.close()
";

impl Runner for Wgsl {
    fn name(&self) -> &'static str {
        "wgsl"
    }

    fn missing(&self) -> Option<String> {
        let is_there = files::is_there("python3", &["-c", PROBE]);
        (!is_there).then(|| {
            "the Python package wgpu is not installed, or finds no device of Vulkan".to_owned()
        })
    }

    fn has(&self, scalar: Scalar) -> bool {
        scalar == Scalar::F32
    }

    fn has_standard_sines(&self) -> bool {
        false
    }

    fn bound(&self) -> Option<f64> {
        Some(BOUND)
    }

    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String> {
        write_package(work, Language::Wgsl, folder)?;
        let states = work.functions.iter().map(|calls| calls.expected.len() / calls.given);
        let states: Vec<usize> = states.collect();
        let calls = format!("STATES = {states:?}\n{CALLS}");
        files::write(folder, "calls.py", calls.as_bytes())?;
        files::run(folder, "python3", &["test.py"])?;
        files::run(folder, "python3", &["calls.py"])?;
        let has_kernel = |index: usize| work.functions[index].taken > 0;
        let results = results(work, &read(folder, "kernel.bin")?, has_kernel)?;
        Ok(vec![Found { way: "kernel", results }])
    }
}
