//! Derivation of straight-line programs from the text of a robot file.

use robot_codegen::Module;
use robot_dynamics::economical::Plan;
use robot_dynamics::economical::search::{Measure, search};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::Snap;
use robot_model::description::{self, Budget, Described};
use robot_model::diagnostic::{Diagnostics, Source};
use robot_model::functions::{Bundle, FunctionKind};
use robot_model::robot::Robot;
use robot_symbolic::Graph;

use crate::driver::counted::search_code;
use crate::driver::options::Options;
use crate::driver::{limbs, nominal, singular, specification};
use crate::error::{Error, Errors};

/// The largest number of expressions of functions that become code. The usual functions of a robot with 64 joints about
/// skew axes have a few tens of thousands.
pub(crate) const MAX_NODES: usize = 500_000;

/// A robot and the programs of its functions.
#[derive(Clone, Debug)]
pub struct Programs {
    /// The robot.
    pub robot: Robot,
    /// Likely mistakes in the file.
    pub warnings: Diagnostics,
    /// The constant angles that were snapped to multiples of π/2.
    pub snapped: Vec<Snap>,
    /// The requested functions that are not in bundles.
    pub functions: Vec<FunctionKind>,
    /// The requested bundles.
    pub bundles: Vec<Bundle>,
    /// The budgets of the file for the functions.
    pub budgets: Vec<Budget>,
    /// The programs, which the interpreter runs and the backends print.
    pub module: Module,
}

/// Reads a robot file in TOML or URDF; the extension of its name determines the format or, if it is unknown, the text.
///
/// # Errors
///
/// All errors in the file.
pub fn read(source: &Source) -> Result<Described, Errors> {
    Ok(description::read(&source.name, &source.text)?)
}

/// Does the same as [`read`], with options that turn some errors into warnings.
///
/// # Errors
///
/// All errors in the file.
pub fn read_with(source: &Source, options: &Options) -> Result<Described, Errors> {
    Ok(description::read_with(&source.name, &source.text, &options.reading())?)
}

/// Derives the functions of a robot and compiles them to straight-line programs.
///
/// # Errors
///
/// All errors in the file or the options.
pub fn programs(source: &Source, options: &Options) -> Result<Programs, Errors> {
    let Described { robot, warnings, code, budgets, .. } = read_with(source, options)?;
    let mut programs = programs_of(robot, &source.name, &options.or_of_file(&code))?;
    programs.warnings = match nominal::infinite(&programs) {
        Some(warning) => {
            let all = warnings.iter().cloned().chain([warning]).collect();
            Diagnostics::new(warnings.source().clone(), all)
        }
        None => warnings,
    };
    programs.budgets = budgets;
    Ok(programs)
}

/// Derives and compiles the functions of a robot that has been read, with these options alone: the result has no warnings
/// and no budgets of a file. `name` is the name of the robot's source in errors.
///
/// # Errors
///
/// All errors in the options; a plan that does not fit the robot; functions that are too large or cannot be computed.
pub fn programs_of(robot: Robot, name: &str, options: &Options) -> Result<Programs, Errors> {
    programs_under(robot, name, options, &options.codegen(), MAX_NODES)
}

/// Returns the plan of the options, or searches for one if the options request a search.
pub(crate) fn plan_of(robot: &Robot, options: &Options) -> Option<Plan> {
    let searched = || {
        let of_expressions = |measure| search(robot, &options.mechanism(robot), measure);
        let found = match options.fused {
            // What makes code impossible is found again with the plan.
            true => search_code(robot, Measure::Instructions, options.snap)
                .unwrap_or_else(|_| of_expressions(Measure::Instructions)),
            false => of_expressions(Measure::Operations),
        };
        found.map(|found| found.plan)
    };
    let given = options.plan.clone();
    if options.search { given.or_else(searched) } else { given }
}

/// Returns the options with the plan that they contain or that a requested search finds, so that several uses search
/// only once.
#[must_use]
pub fn planned(robot: &Robot, options: &Options) -> Options {
    Options { plan: plan_of(robot, options), search: false, ..options.clone() }
}

/// Does the same as [`programs_of`], with a choice of passes and a limit on the number of expressions.
pub(crate) fn programs_under(
    robot: Robot,
    name: &str,
    options: &Options,
    codegen: &robot_codegen::Options,
    limit: usize,
) -> Result<Programs, Errors> {
    options.check()?;
    let base_frames = options.base_frames.unwrap_or(robot.base_frames);
    let robot = Robot { base_frames, ..robot };
    let (functions, bundles) = options.functions_of(&robot)?;
    let graph = Graph::limited(limit);
    let plan = plan_of(&robot, options);
    if plan.as_ref().is_some_and(|plan| !plan.fits(robot.links.len())) {
        return Err(Errors::from(Error::Plan { name: name.to_owned() }));
    }
    let derivation = Derivation::new(&robot, &graph, &options.mechanism(&robot), plan.clone());
    let more = specification::not_generated(&robot, options, &functions, &bundles);
    let specification = specification::module(&derivation, &functions, &bundles, &more);
    if graph.is_full() {
        return Err(Errors::from(Error::TooLarge { name: name.to_owned(), limit }));
    }
    let mut module = Module::compile(&specification, codegen)
        .map_err(|errors| singular::by_cause(name, &robot, &functions, &bundles, &errors))?;
    limbs::set_limbs(&mut module, &robot, options, (&functions, &bundles), plan.as_ref());
    let snapped = derivation.mechanism.snapped.clone();
    let source = Source { name: name.to_owned(), text: String::new() };
    let warnings = Diagnostics::new(source, vec![]);
    let budgets = vec![];
    Ok(Programs { robot, warnings, snapped, functions, bundles, budgets, module })
}

#[cfg(test)]
mod tests {
    use robot_dynamics::economical::plan::LinkPlan;

    use super::*;

    #[test]
    fn a_plan_is_searched_once_and_only_if_none_is_given() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/planar_2r.toml");
        let text = std::fs::read_to_string(path).unwrap();
        let robot = description::read("planar_2r.toml", &text).unwrap().robot;
        let usual = Options { fused: true, ..Options::default() };
        assert_eq!(planned(&robot, &usual), usual);
        let searching = Options { search: true, ..usual.clone() };
        let found = search_code(&robot, Measure::Instructions, None).unwrap().unwrap();
        let expected = Options { plan: Some(found.plan), ..usual.clone() };
        assert_eq!(planned(&robot, &searching), expected);
        let given = Options { plan: Some(Plan::uniform(2, &LinkPlan::BASIC)), ..usual };
        assert_eq!(planned(&robot, &Options { search: true, ..given.clone() }), given);
    }
}
