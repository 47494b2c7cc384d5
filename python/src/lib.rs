//! The native part of the Python package `robots`: the programs of robot files as functions over arrays, and the
//! command with its streams as bytes. The rest of the package is written in Python.

mod engine;
mod strided;

use std::path::{Path, PathBuf};

use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use robot_build::{Bundle, FunctionKind, Functions, Options, Robot, RobotFile, kinds_named};
use robot_cli::Terminal;
use robot_codegen::spec::{Input, Output};
use robot_document::robot::{rows, words};
use robot_model::diagnostic::significant;
use robot_model::robot::{JointKind, Payload};

use engine::Engine;

/// The name, the number of entries or the shape, the meaning and the unit of an input or output.
type Described<T> = (String, T, String, String);

create_exception!(
    robots,
    RobotError,
    PyValueError,
    "What is wrong with a robot file, an option or an input."
);

/// Makes a Python exception with the whole text of an error.
fn wrong(error: impl std::fmt::Display) -> PyErr {
    RobotError::new_err(error.to_string())
}

/// A robot file after reading.
#[pyclass(frozen)]
struct RobotSource {
    robot: Robot,
    name: String,
    options: Options,
}

#[pymethods]
impl RobotSource {
    /// Reads a robot file and the plan that is pinned beside it. The last two arguments turn the errors about
    /// missing masses and physically impossible inertias into warnings.
    #[new]
    fn new(
        py: Python<'_>,
        path: PathBuf,
        search: bool,
        allow_massless: bool,
        allow_unphysical: bool,
    ) -> PyResult<RobotSource> {
        let options = Options { search, allow_massless, allow_unphysical, ..Options::default() };
        py.detach(|| read(&path, &options))
    }

    /// The robot's name.
    #[getter]
    fn robot(&self) -> &str {
        &self.robot.name
    }

    /// The remark of the robot file.
    #[getter]
    fn description(&self) -> Option<&str> {
        self.robot.description.as_deref().map(str::trim)
    }

    /// The number of coordinates.
    #[getter]
    fn degrees_of_freedom(&self) -> usize {
        self.robot.degrees_of_freedom()
    }

    /// The parameters and their nominal values.
    fn parameters(&self) -> Vec<(String, Option<f64>)> {
        let parameters = self.robot.parameters.iter();
        parameters
            .map(|parameter| {
                (parameter.name.clone(), parameter.value.as_ref().map(|value| value.to_f64()))
            })
            .collect()
    }

    /// The names of the payload's parameters: mass, center of mass, inertia.
    fn payload(&self) -> Option<Vec<String>> {
        let Payload { mass, center_of_mass, inertia } = self.robot.payload.as_ref()?;
        Some([mass].into_iter().chain(center_of_mass).chain(inertia).cloned().collect())
    }

    /// The rows of a table of the links and their joints; the first row is the title.
    fn links(&self) -> Vec<[String; 6]> {
        let title = ["link", "parent", "joint", "type", "coordinate", "limits"];
        let rows = rows::links(&self.robot).map(|row| {
            let axis = words::vector(&row.link.joint.axis, |formula| formula.text().to_owned());
            let (way, unit) = match row.link.joint.kind {
                JointKind::Revolute => ("about", "rad"),
                JointKind::Prismatic => ("along", "m"),
            };
            let limits = row.limits.map_or_else(String::new, |limits| {
                let [low, high] = limits.each_ref().map(|limit| significant(limit.to_f64()));
                format!("{low} to {high} {unit}")
            });
            let kind = format!("{} {way} {axis}", row.kind);
            let [link, joint] = [&row.link.name, &row.link.joint.name].map(String::clone);
            [link, row.parent.to_owned(), joint, kind, row.coordinate, limits]
        });
        std::iter::once(title.map(str::to_owned)).chain(rows).collect()
    }

    /// The rows of a table of the parameters; the first row is the title.
    fn parameter_rows(&self) -> Vec<[String; 4]> {
        let title = ["parameter", "value", "unit", "meaning"].map(str::to_owned);
        let rows = rows::parameters(&self.robot).map(|row| {
            let [unit, meaning] =
                [row.unit, row.meaning].map(|text| text.unwrap_or_default().to_owned());
            [row.parameter.name.clone(), row.value.unwrap_or_default(), unit, meaning]
        });
        std::iter::once(title).chain(rows).collect()
    }

    /// The names of the functions that the robot has, including the functions of single frames.
    fn functions(&self) -> Vec<String> {
        let kinds = FunctionKind::of_robot(&self.robot).into_iter().flat_map(|kind| {
            let parts = kind.parts(&self.robot);
            std::iter::once(kind).chain(parts)
        });
        kinds.map(|kind| kind.full_name(&self.robot)).collect()
    }

    /// Derives the program of a function, or of one function that computes several.
    fn program(&self, py: Python<'_>, names: Vec<String>) -> PyResult<Program> {
        py.detach(|| {
            let kinds = kinds_named(&names, &self.robot).map_err(wrong)?;
            let (functions, bundles) = match kinds.len() {
                1 => (Functions::Chosen(kinds), vec![]),
                _ => {
                    let bundle = Bundle { name: "joined".to_owned(), functions: kinds };
                    (Functions::Usual, vec![bundle])
                }
            };
            let options = Options { functions, bundles, ..self.options.clone() };
            let programs = robot_build::programs_of(self.robot.clone(), &self.name, &options);
            Ok(Program { module: programs.map_err(wrong)?.module })
        })
    }
}

/// Reads a robot file, with the plan that is pinned beside it or, if `options` say so, with a plan that is searched
/// for.
fn read(path: &Path, options: &Options) -> PyResult<RobotSource> {
    let file = RobotFile::read(path).map_err(wrong)?;
    let options = file.with_pin(options).map_err(wrong)?;
    let described = robot_build::read_with(&file.source, &options).map_err(wrong)?;
    let robot = described.robot;
    let options = robot_build::planned(&robot, &options);
    Ok(RobotSource { robot, name: file.source.name, options })
}

/// The program of one function.
#[pyclass(frozen)]
struct Program {
    module: robot_codegen::Module,
}

#[pymethods]
impl Program {
    /// The documentation of the function.
    #[getter]
    fn doc(&self) -> String {
        self.module.functions.first().map(|function| function.doc.join("\n\n")).unwrap_or_default()
    }

    /// The inputs, with their numbers of entries.
    fn inputs(&self) -> Vec<Described<usize>> {
        let inputs = self.module.functions.iter().take(1).flat_map(|function| &function.inputs);
        let described = inputs.map(|Input { name, doc, unit, symbols }| {
            (name.clone(), symbols.len(), doc.clone(), unit.clone())
        });
        described.collect()
    }

    /// The outputs, with their shapes.
    fn outputs(&self) -> Vec<Described<Vec<usize>>> {
        let outputs = self.module.functions.iter().take(1).flat_map(|function| &function.outputs);
        let described = outputs.map(|Output { name, doc, unit, shape, .. }| {
            (name.clone(), shape.clone(), doc.clone(), unit.clone())
        });
        described.collect()
    }

    /// Compiles the program with other values for these parameters than the nominal ones.
    fn compile(&self, py: Python<'_>, parameters: Vec<(String, f64)>) -> PyResult<Engine> {
        py.detach(|| Engine::new(&self.module, &parameters).map_err(wrong))
    }
}

/// Runs the command; returns the exit code, standard output and standard error.
#[pyfunction]
fn command(py: Python<'_>, arguments: Vec<String>, input: Vec<u8>) -> (u8, Vec<u8>, Vec<u8>) {
    py.detach(|| {
        let (mut input, mut output, mut errors) = (input.as_slice(), vec![], vec![]);
        let mut terminal = Terminal {
            input: &mut input,
            output: &mut output,
            errors: &mut errors,
            colors: false,
            progress: false,
            screen: None,
        };
        let code =
            robot_cli::run(std::iter::once("robots".to_owned()).chain(arguments), &mut terminal);
        (code, output, errors)
    })
}

/// Runs the command with the streams of the process.
#[pyfunction]
fn main(py: Python<'_>, arguments: Vec<String>) -> u8 {
    py.detach(|| {
        let (mut input, mut output, mut errors) =
            (std::io::stdin(), std::io::stdout(), std::io::stderr());
        let mut terminal = Terminal {
            input: &mut input,
            output: &mut output,
            errors: &mut errors,
            colors: false,
            progress: false,
            screen: None,
        };
        robot_cli::run(std::iter::once("robots".to_owned()).chain(arguments), &mut terminal)
    })
}

/// The native part of the package.
#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("RobotError", module.py().get_type::<RobotError>())?;
    module.add_class::<RobotSource>()?;
    module.add_class::<Program>()?;
    module.add_class::<Engine>()?;
    module.add_function(wrap_pyfunction!(command, module)?)?;
    module.add_function(wrap_pyfunction!(main, module)?)
}
