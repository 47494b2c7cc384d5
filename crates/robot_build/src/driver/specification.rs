//! A robot's functions as the code generator takes them.

use robot_codegen::backend::common::markdown;
use robot_codegen::spec::{ModuleSpec, ParameterSpec};
use robot_dynamics::functions::Derivation;
use robot_model::functions::{Bundle, FunctionKind};
use robot_model::robot::{Parameter, Robot};

use crate::driver::conventions::CONVENTIONS;
use crate::driver::options::Options;
use crate::driver::singular::unsolvable;

/// The module of a robot; `more` are the functions that it could have besides.
pub(crate) fn module<'g>(
    derivation: &Derivation<'_, 'g>,
    functions: &[FunctionKind],
    bundles: &[Bundle],
    more: &[FunctionKind],
) -> ModuleSpec<'g> {
    let robot = derivation.robot;
    // A graph that is full holds nothing of use: the caller says so.
    let is_full = || derivation.mechanism.graph.is_full();
    ModuleSpec {
        name: robot.name.to_lowercase(),
        doc: module_doc(robot, more),
        parameters: robot.parameters.iter().map(parameter).collect(),
        functions: functions
            .iter()
            .filter(|_| !is_full())
            .flat_map(|kind| derivation.functions(*kind))
            .chain(bundles.iter().map(|bundle| derivation.bundle(bundle)))
            .collect(),
    }
}

/// The module of the pivots of the mass matrix alone.
pub(crate) fn pivots<'g>(derivation: &Derivation<'_, 'g>) -> ModuleSpec<'g> {
    let functions = vec![derivation.pivots()];
    ModuleSpec { functions, ..module(derivation, &[], &[], &[]) }
}

/// The robot, what the file says about it, the conventions, and what else there is.
pub(crate) fn module_doc(robot: &Robot, more: &[FunctionKind]) -> Vec<String> {
    let blank = || "\n".to_owned();
    let mut lines = vec![format!("Dynamics of the robot {}.", robot.name), blank()];
    if let Some(description) = &robot.description {
        lines.extend(markdown(description));
        lines.push(blank());
    }
    lines.extend(CONVENTIONS.map(|line| format!("- {line}")));
    if !more.is_empty() {
        let names: Vec<String> = more.iter().map(|kind| format!("`{}`", kind.name())).collect();
        lines.extend([
            blank(),
            "Other functions can be generated too: list them with `functions = [\"…\"]` in \
             `[code]` of the robot file or in the macro, `.functions([\"…\"])` in the builder, \
             or the command's option for functions; `\"all\"` selects all. Also available for \
             this robot:"
                .to_owned(),
            format!("{}.", names.join(", ")),
        ]);
    }
    lines
}

/// The functions that the robot has and the module does not, in a bundle either.
pub(crate) fn not_generated(
    robot: &Robot,
    options: &Options,
    functions: &[FunctionKind],
    bundles: &[Bundle],
) -> Vec<FunctionKind> {
    let bundled =
        |kind: &FunctionKind| bundles.iter().any(|bundle| bundle.functions.contains(kind));
    let mut more = FunctionKind::of_robot(robot);
    let chosen = |kind: &FunctionKind| functions.contains(kind) || bundled(kind);
    more.retain(|kind| !chosen(kind));
    // A caller that chose one that solves with the mass matrix gets a message elsewhere that it is singular.
    let mut solving = FunctionKind::ALL.iter().filter(|kind| kind.divides_by_mass_matrix());
    if !solving.any(chosen) && unsolvable(robot, options).is_some() {
        more.retain(|kind| !kind.divides_by_mass_matrix());
    }
    more
}

fn parameter(parameter: &Parameter) -> ParameterSpec {
    ParameterSpec {
        name: parameter.name.clone(),
        doc: parameter.doc.clone().unwrap_or_default(),
        unit: parameter.unit.as_ref().map(|unit| unit.text.clone()).unwrap_or_default(),
        nominal: parameter.value.as_ref().map(robot_symbolic::Rational::to_f64),
    }
}
