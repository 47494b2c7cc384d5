//! The specification of a robot's functions for the code generator.

use robot_codegen::backend::common::markdown;
use robot_codegen::spec::{ModuleSpec, ParameterSpec};
use robot_dynamics::functions::Derivation;
use robot_model::functions::{Bundle, FunctionKind};
use robot_model::robot::{Parameter, Robot};

use crate::driver::conventions::CONVENTIONS;
use crate::driver::options::Options;
use crate::driver::singular::unsolvable;

/// Makes the specification of a robot's module; `more` are further functions that it could have.
pub(crate) fn module<'g>(
    derivation: &Derivation<'_, 'g>,
    functions: &[FunctionKind],
    bundles: &[Bundle],
    more: &[FunctionKind],
) -> ModuleSpec<'g> {
    let robot = derivation.robot;
    // The contents of a full graph are useless; the caller reports this.
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

/// Makes the specification of a module with only the pivots of the mass matrix.
pub(crate) fn pivots<'g>(derivation: &Derivation<'_, 'g>) -> ModuleSpec<'g> {
    let functions = vec![derivation.pivots()];
    ModuleSpec { functions, ..module(derivation, &[], &[], &[]) }
}

/// Makes the specification of a module with only the mass matrix.
pub(crate) fn mass_matrix<'g>(derivation: &Derivation<'_, 'g>) -> ModuleSpec<'g> {
    module(derivation, &[FunctionKind::MassMatrix], &[], &[])
}

/// The documentation of a module: the robot, its description in the file, the conventions, and further functions.
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

/// The functions of the robot that the module does not have, not even in a bundle.
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
    // If a function that solves with the mass matrix was chosen, another message says that the matrix is singular.
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
