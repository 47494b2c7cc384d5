//! The functions of a robot with the states at which they are called.

use robot_build::{Functions, Options, Programs, Source, check};
use robot_codegen::{Interpreter, Scalar, Trigonometry};
use robot_symbolic::Random;

use crate::files;

/// The number of states at which each function is called.
pub const STATES: usize = 200;

/// A robot, its programs, and the inputs and results of each function.
pub struct Work {
    /// The robot file.
    pub source: Source,
    /// The options with which it is generated.
    pub options: Options,
    /// The programs.
    pub programs: Programs,
    /// The parameters, in their order.
    pub parameters: Vec<f64>,
    /// The functions, in their order.
    pub functions: Vec<Calls>,
}

/// The calls of a function.
pub struct Calls {
    /// The function.
    pub name: String,
    /// The number of entries of all inputs.
    pub taken: usize,
    /// The number of entries of all outputs.
    pub given: usize,
    /// The entries of all inputs, state by state.
    pub inputs: Vec<f64>,
    /// The results of the interpreter, state by state.
    pub expected: Vec<f64>,
}

/// The name of a robot whose names are reserved words of languages.
const HOSTILE: &str = "hostile";

/// The names of the robots.
///
/// # Errors
///
/// The folder cannot be read.
pub fn robots() -> Result<Vec<String>, String> {
    let folder = files::root().join("robots");
    let entries = std::fs::read_dir(&folder).map_err(|error| error.to_string())?;
    let names = entries.filter_map(|entry| {
        let name = entry.ok()?.file_name().into_string().ok()?;
        name.strip_suffix(".toml").map(str::to_owned)
    });
    let mut names: Vec<String> = names.chain([HOSTILE.to_owned()]).collect();
    names.sort_unstable();
    Ok(names)
}

impl Work {
    /// Prepares all functions of a robot of the repository, with the runtime's sines.
    ///
    /// # Errors
    ///
    /// All errors in its file.
    pub fn new(robot: &str, scalar: Scalar) -> Result<Work, String> {
        Work::with(robot, scalar, Trigonometry::Polynomial)
    }

    /// Does the same as [`Work::new`], with sines of either source.
    ///
    /// # Errors
    ///
    /// All errors in its file.
    pub fn with(robot: &str, scalar: Scalar, trigonometry: Trigonometry) -> Result<Work, String> {
        let name = format!("{robot}.toml");
        let folder = if robot == HOSTILE { "crates/robot_languages" } else { "robots" };
        let path = files::root().join(folder).join(&name);
        let text = std::fs::read_to_string(path).map_err(|error| error.to_string())?;
        let source = Source { name, text };
        let mut options =
            Options { functions: Functions::All, scalar, trigonometry, ..Options::default() };
        let described = robot_build::read(&source).map_err(|error| error.to_string())?;
        options.bundles = described.code.bundles;
        let programs =
            robot_build::programs(&source, &options).map_err(|error| error.to_string())?;
        let module = &programs.module;
        let first = module.functions.first().map_or("", |function| function.name.as_str());
        let stated = check::check_value(&source.name, &programs, first, options.trigonometry);
        let stated = stated.map_err(|error| error.to_string())?.parameters;
        let given: Vec<(&str, f64)> =
            stated.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        let interpreter = Interpreter::new(module, &given).map_err(|error| error.to_string())?;
        let interpreter = interpreter.with_trigonometry(trigonometry);
        let parameters = module.parameters.iter().map(|parameter| {
            let stated = given.iter().find(|(name, _)| *name == parameter.name);
            parameter.nominal.or(stated.map(|(_, value)| *value)).unwrap_or(1.0)
        });
        let parameters = parameters.collect();
        let functions = module.functions.iter();
        let functions = functions.map(|function| calls(&interpreter, &function.name, scalar));
        let functions = functions.collect::<Result<_, _>>()?;
        Ok(Work { source, options, programs, parameters, functions })
    }

    /// The inputs of all functions, one after the other, as bytes of the number type.
    #[must_use]
    pub fn input_bytes(&self) -> Vec<u8> {
        let values = self.functions.iter().flat_map(|function| &function.inputs);
        match self.options.scalar {
            Scalar::F64 => values.flat_map(|value| value.to_le_bytes()).collect(),
            Scalar::F32 => values.flat_map(|value| (*value as f32).to_le_bytes()).collect(),
        }
    }
}

/// The calls of a function at pseudo-random states, which are exact in single precision.
fn calls(interpreter: &Interpreter<'_>, name: &str, scalar: Scalar) -> Result<Calls, String> {
    let callable = interpreter.function(name).map_err(|error| error.to_string())?;
    let mut random = Random::new(1);
    let (taken, given) = (callable.input_size(), callable.output_size());
    let states = if taken == 0 { 1 } else { STATES };
    let inputs: Vec<f64> = (0..states * taken)
        .map(|_| {
            let value = random.uniform(-3.0, 3.0);
            if scalar == Scalar::F32 { f64::from(value as f32) } else { value }
        })
        .collect();
    let lengths: Vec<usize> = callable.inputs().iter().map(|input| input.symbols.len()).collect();
    let mut expected = vec![];
    for state in 0..states {
        let mut rest = &inputs[state * taken..(state + 1) * taken];
        let named = callable.inputs().iter().zip(&lengths).map(|(input, length)| {
            let (entries, after) = rest.split_at(*length);
            rest = after;
            (input.name.as_str(), entries)
        });
        let named: Vec<(&str, &[f64])> = named.collect();
        expected.extend(callable.call(&named).map_err(|error| error.to_string())?);
    }
    Ok(Calls { name: name.to_owned(), taken, given, inputs, expected })
}
