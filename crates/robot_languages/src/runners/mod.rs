//! One runner for each language and tool.

mod arduino;
mod c;
mod casadi;
mod cppcheck;
mod cuda;
mod flags;
mod rust;
mod scripts;
mod thumb;
mod wasm;
mod wgsl;

use std::path::Path;

use robot_codegen::Scalar;

use crate::files;
use crate::work::Work;

/// Runs the functions of a robot in a language.
pub trait Runner: Sync {
    /// The name of the runner.
    fn name(&self) -> &'static str;

    /// The reason why it cannot run here, if there is one.
    fn missing(&self) -> Option<String>;

    /// Whether the language has the number type.
    fn has(&self, scalar: Scalar) -> bool;

    /// Whether sines of the language's own library are compared.
    fn has_standard_sines(&self) -> bool {
        true
    }

    /// The largest permitted distance of results from those of the interpreter, in units in the last place of the
    /// largest output, if the language does not promise bits.
    fn bound(&self) -> Option<f64> {
        None
    }

    /// Makes a package in an empty folder and runs it.
    ///
    /// # Errors
    ///
    /// The messages of a tool that failed.
    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String>;
}

/// The results of a runner for one way of calling.
pub struct Found {
    /// The way: one state after the other, or several at once.
    pub way: &'static str,
    /// The results of each function, state by state; `None` for functions that cannot be called in this way.
    pub results: Vec<Option<Vec<f64>>>,
}

/// All runners.
#[must_use]
pub fn all() -> Vec<Box<dyn Runner>> {
    let mut runners: Vec<Box<dyn Runner>> = vec![Box::new(rust::Rust)];
    runners.extend(c::all());
    runners.push(Box::new(flags::Flags));
    runners.push(Box::new(cuda::Cuda));
    runners.push(Box::new(cuda::Nvrtc));
    runners.push(Box::new(cuda::Nvcc));
    runners.extend(scripts::all());
    runners.push(Box::new(wasm::Wasm));
    runners.push(Box::new(wgsl::Naga));
    runners.push(Box::new(wgsl::Wgsl));
    runners.push(Box::new(casadi::Casadi));
    runners.push(Box::new(thumb::Thumb));
    runners.push(Box::new(arduino::Arduino));
    runners.push(Box::new(cppcheck::Cppcheck));
    runners
}

/// Reads the results of functions from the bytes that a program wrote.
fn results(
    work: &Work,
    bytes: &[u8],
    has: impl Fn(usize) -> bool,
) -> Result<Vec<Option<Vec<f64>>>, String> {
    let size = work.options.scalar.size();
    let mut values = bytes.chunks_exact(size).map(|chunk| match *chunk {
        [a, b, c, d] => f64::from(f32::from_le_bytes([a, b, c, d])),
        [a, b, c, d, e, f, g, h] => f64::from_le_bytes([a, b, c, d, e, f, g, h]),
        _ => f64::NAN,
    });
    let mut found = vec![];
    for (index, function) in work.functions.iter().enumerate() {
        found.push(has(index).then(|| values.by_ref().take(function.expected.len()).collect()));
    }
    match values.next() {
        None if found.iter().zip(&work.functions).all(|(found, function)| {
            found.as_ref().is_none_or(|found: &Vec<f64>| found.len() == function.expected.len())
        }) =>
        {
            Ok(found)
        }
        _ => Err("the program did not write as many results as there are".to_owned()),
    }
}

/// Writes a package of the robot.
fn write_package(
    work: &Work,
    language: robot_build::languages::Language,
    folder: &Path,
) -> Result<(), String> {
    let files =
        robot_build::languages::package_of(&work.programs, &work.source, &work.options, language);
    for file in files.map_err(|error| error.to_string())? {
        files::write(folder, &file.path, file.contents.bytes())?;
    }
    files::write(folder, "states.bin", &work.input_bytes())
}

/// Reads the bytes of a file that a program wrote.
fn read(folder: &Path, name: &str) -> Result<Vec<u8>, String> {
    std::fs::read(folder.join(name)).map_err(|error| format!("{name}: {error}"))
}
