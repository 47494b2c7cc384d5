//! The effect of each option and each pass: the operations of functions if it is left out.

use robot_codegen::{FunctionCounts, Resubstitution};
use robot_dynamics::economical::Plan;
use robot_dynamics::economical::plan::{LinkPlan, Origin, Turn};
use robot_model::description::Described;
use robot_model::diagnostic::Source;

use crate::driver::generate::counts;
use crate::driver::options::Options;
use crate::driver::programs::{plan_of, programs_under, read_with};
use crate::error::Errors;

/// The largest number of expressions of functions that are derived repeatedly. All functions of an arm with
/// seven joints have a few tens of thousands.
const MAX_NODES: usize = 40_000;

/// The functions with one option or pass left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Ablation {
    /// The option or pass that is left out: `none`, a key of a pinned plan, or a pass.
    pub without: &'static str,
    /// The operation counts of each function without it, by the function's name.
    pub counts: Vec<(String, FunctionCounts)>,
}

/// Removes an option from a plan.
type Change = fn(&mut Plan);
/// Removes a pass from the options.
type PassChange = fn(&mut robot_codegen::Options);

/// The choices of a [`Plan`] by name, with the change to their value in [`LinkPlan::BASIC`] or to the file's frames.
const PLAN_OPTIONS: [(&str, Change); 10] = [
    ("origin", |plan| each(plan, |link| link.origin = Origin::File)),
    ("turn", |plan| each(plan, |link| link.turn = Turn::File)),
    ("angle_sum", |plan| each(plan, |link| link.angle_sum = false)),
    ("column", |plan| each(plan, |link| link.column = false)),
    ("doubled", |plan| each(plan, |link| link.doubled = false)),
    ("moment", |plan| each(plan, |link| link.moment = [false; 3])),
    ("diagonal", |plan| each(plan, |link| link.diagonal = false)),
    ("residual", |plan| each(plan, |link| link.residual = [None; 3])),
    ("composite_sum", |plan| each(plan, |link| link.composite_sum = false)),
    ("unit_length", |plan| plan.unit_length = None),
];

/// The passes that save operations.
const PASSES: [(&str, PassChange); 4] = [
    ("factoring", |options| options.factoring = false),
    ("pair reuse", |options| options.pair_reuse = false),
    ("resubstitution", |options| options.resubstitution = Resubstitution::Off),
    ("any pass", |options| {
        *options = robot_codegen::Options { cost: options.cost, ..robot_codegen::Options::none() };
    }),
];

fn each(plan: &mut Plan, change: fn(&mut LinkPlan)) {
    plan.links.iter_mut().for_each(change);
}

/// Counts the operations of functions with all options and passes, without each option of the recursion, and
/// without each pass. Options interact, so the savings of single options do not add up.
///
/// # Errors
///
/// All errors in the file or the options.
pub fn ablation(source: &Source, options: &Options) -> Result<Vec<Ablation>, Errors> {
    let Described { robot, code, .. } = read_with(source, options)?;
    let options = &options.or_of_file(&code);
    let plan = plan_of(&robot, options).unwrap_or_else(|| Plan::default_for(&robot));
    let counted = |without, plan: Plan, codegen: &robot_codegen::Options| -> Result<_, Errors> {
        let options = Options { plan: Some(plan), search: false, ..options.clone() };
        let programs = programs_under(robot.clone(), &source.name, &options, codegen, MAX_NODES)?;
        Ok(Ablation { without, counts: counts(&programs.module) })
    };
    let codegen = options.codegen();
    let mut found = vec![counted("none", plan.clone(), &codegen)?];
    for (name, change) in PLAN_OPTIONS {
        let mut changed = plan.clone();
        change(&mut changed);
        found.push(counted(name, changed, &codegen)?);
    }
    for (name, change) in PASSES {
        let mut changed = codegen;
        change(&mut changed);
        found.push(counted(name, plan.clone(), &changed)?);
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use robot_model::functions::{Effects, FunctionKind, Functions};

    use super::*;

    const STANFORD: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/stanford.toml");

    fn operations(one: &Ablation) -> usize {
        one.counts.iter().map(|(_, counts)| counts.call.operations()).sum()
    }

    /// Each entry has the counts of all functions; the first is the code that is generated.
    #[test]
    fn each_option_and_pass_is_left_out_once() {
        let text = std::fs::read_to_string(STANFORD).unwrap();
        let source = Source { name: "stanford.toml".to_owned(), text };
        let functions = vec![FunctionKind::InverseDynamics(Effects::NONE), FunctionKind::Gravity];
        let options = Options { functions: Functions::Chosen(functions), ..Options::default() };
        let found = ablation(&source, &options).unwrap();
        let names: Vec<&str> = found.iter().map(|one| one.without).collect();
        let expected = PLAN_OPTIONS.map(|(name, _)| name).into_iter();
        let expected = expected.chain(PASSES.map(|(name, _)| name));
        assert_eq!(names, ["none"].into_iter().chain(expected).collect::<Vec<_>>());
        let module = crate::programs(&source, &options).unwrap().module;
        assert_eq!(found[0].counts, counts(&module));
        for one in &found {
            let functions: Vec<&str> = one.counts.iter().map(|(name, _)| name.as_str()).collect();
            assert_eq!(functions, ["inverse_dynamics", "gravity"], "{}", one.without);
        }
        // What an option or a pass saves is the difference; no pass at all costs most.
        let of = |name: &str| operations(found.iter().find(|one| one.without == name).unwrap());
        assert!(of("any pass") > of("none"));
        assert!(found[1..=PLAN_OPTIONS.len()].iter().any(|one| operations(one) > of("none")));
        assert!(found.iter().all(|one| operations(one) <= of("any pass")));
        // If the plan has no options, none can be left out.
        let robot = crate::read(&source).unwrap().robot;
        let basic = Plan::uniform(robot.links.len(), &LinkPlan::BASIC);
        let found = ablation(&source, &Options { plan: Some(basic), ..options }).unwrap();
        assert!(found[1..=PLAN_OPTIONS.len()].iter().all(|one| one.counts == found[0].counts));
        assert!(operations(&found[0]) > of("none"));
    }
}
