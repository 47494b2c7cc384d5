//! The external functions for CasADi, called through its Python package.

use std::path::Path;

use robot_build::languages::Language;
use robot_codegen::Scalar;
use robot_codegen::backend::c;
use robot_codegen::backend::flat::FlatOptions;

use super::{Found, Runner, read, results, write_package};
use crate::files;
use crate::work::Work;

/// The runner of a shared C library with the interface of CasADi.
pub(super) struct Casadi;

impl Runner for Casadi {
    fn name(&self) -> &'static str {
        "casadi"
    }

    fn missing(&self) -> Option<String> {
        let is_there = files::is_there("gcc", &["--version"])
            && files::is_there("python3", &["-c", "import casadi, numpy"]);
        (!is_there).then(|| "gcc, CasADi or NumPy is not installed".to_owned())
    }

    fn has(&self, scalar: Scalar) -> bool {
        scalar == Scalar::F64
    }

    /// Compares the values and also the Jacobians: with differences of values, and at all states with the functions
    /// that compute them.
    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String> {
        write_package(work, Language::C, folder)?;
        let options = FlatOptions { scalar: work.options.scalar, ..FlatOptions::default() };
        let module = &work.programs.module;
        let casadi = c::casadi(module, &options).ok_or("CasADi has double precision alone")?;
        let mut arguments = vec!["-std=c99", "-O2", "-ffp-contract=off", "-shared", "-fPIC"];
        arguments.extend(super::c::WARNINGS);
        arguments.extend([casadi.file.name.as_str(), "-o", "library.so", "-lm"]);
        files::run(folder, "gcc", &arguments)?;
        files::write(folder, "calls.py", program(work, &casadi).as_bytes())?;
        files::run(folder, "python3", &["calls.py"])?;
        let results = results(work, &read(folder, "single.bin")?, |_| true)?;
        Ok(vec![Found { way: "single", results }])
    }
}

const PROGRAM: &str = r#"
import casadi, numpy

parameters = [numpy.array(parameters)] if parameters else []
states = numpy.fromfile("states.bin")
single = open("single.bin", "wb")
functions = {name: casadi.external(symbol, "./library.so") for name, symbol, _, _ in calls}
if nominal:
    given = numpy.array(casadi.external(nominal, "./library.so")()["parameters"]).ravel()
    assert (given == parameters[0]).all(), nominal

def row_by_row(values):
    return numpy.concatenate([numpy.array(value).ravel() for value in values])

def close(found, stated, bound):
    size = max(1.0, abs(stated).max())
    return found.shape == stated.shape and abs(found - stated).max() <= bound * size

def blocks(function, jacobian, arguments):
    outputs = function.call(arguments)
    count = function.n_in() - len(parameters)
    return [numpy.array(block) for block in jacobian.call(arguments + outputs)[:count]]

def by_functions(name, x):
    """The Jacobian by the functions of the module, if both of them are there."""
    zeros = [numpy.zeros_like(x[0])] * (3 - len(x))
    if name == "forward_dynamics":
        return functions["forward_dynamics_derivatives"].call(x + parameters)
    found = list(functions["inverse_dynamics_derivatives"].call(x + zeros + parameters))
    return (found + list(functions["mass_matrix"].call(x[:1] + parameters)))[: len(x)]

def compare(name, function, x, is_first):
    found = blocks(function, function.jacobian(), x + parameters)
    for block, stated in zip(found, by_functions(name, x), strict=True):
        assert close(block, numpy.array(stated), 1e-12), (name, "is not the derivative of the module")
    for index, block in enumerate(found if is_first else []):
        for column in range(block.shape[1]):
            def value(step):
                moved = [entry.copy() for entry in x]
                moved[index][column] += step
                return numpy.array(function.call(moved + parameters)[0]).ravel()
            difference = (value(1e-5) - value(-1e-5)) / 2e-5
            size = abs(value(0.0)).max() + abs(block).max()
            assert abs(block[:, column] - difference).max() <= 1e-6 * size, (name, index, column)

for name, symbol, has_jacobian, count in calls:
    function = functions[name]
    variables = function.n_in() - len(parameters)
    sizes = [function.size1_in(index) for index in range(variables)]
    for state in range(count):
        x = []
        for size in sizes:
            x.append(states[:size].copy())
            states = states[size:]
        row_by_row(function.call(x + parameters)).tofile(single)
        if has_jacobian:
            compare(name, function, x, state == 0)
"#;

/// Prints a program that calls every function at every state and writes the results.
fn program(work: &Work, casadi: &c::Casadi) -> String {
    let mut text = format!(
        "parameters = {:?}\nnominal = {:?}\ncalls = [\n",
        work.parameters,
        casadi.nominal.as_deref().unwrap_or_default()
    );
    for ((symbol, has_jacobian), calls) in casadi.functions.iter().zip(&work.functions) {
        let (states, flag) =
            (calls.expected.len() / calls.given, if *has_jacobian { "True" } else { "False" });
        text.push_str(&format!("    ({:?}, {symbol:?}, {flag}, {states}),\n", calls.name));
    }
    text.push_str("]\n");
    text.push_str(PROGRAM);
    text
}
