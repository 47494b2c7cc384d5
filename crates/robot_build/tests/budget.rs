//! Budgets: limits on the cost of code.

#![allow(clippy::unwrap_used)]

use robot_build::{Functions, Options, Source, budget, generate, package, programs};
use robot_codegen::backend::rust::stack;
use robot_model::functions::{Effects, FunctionKind};

const ROBOT: &str = include_str!("../../../robots/planar_2r.toml");

fn source(budgets: &str) -> Source {
    Source { name: "arm.toml".to_owned(), text: format!("{ROBOT}\n{budgets}") }
}

fn options() -> Options {
    let functions = vec![FunctionKind::InverseDynamics(Effects::NONE), FunctionKind::MassMatrix];
    Options { functions: Functions::Chosen(functions), ..Options::default() }
}

/// The operations and bytes of stack of `inverse_dynamics`, and the operations of `mass_matrix`.
fn costs() -> [u64; 3] {
    let module = programs(&source(""), &options()).unwrap().module;
    let [id, mass] = ["inverse_dynamics", "mass_matrix"].map(|name| module.function(name).unwrap());
    let operations = |function| module.counts(function).call.operations() as u64;
    let costs = [operations(id), stack::estimate(id, 8) as u64, operations(mass)];
    assert!(costs[0] > costs[2] && costs[2] > 0 && costs[1] > 100, "{costs:?}");
    costs
}

#[test]
fn what_costs_as_much_as_it_may_is_generated() {
    let [operations, stack, _] = costs();
    let text = format!(
        "[[budget]]\nfunction = \"inverse_dynamics\"\nmax_operations = {operations}\nmax_stack = {stack}\n\
         [[budget]]\nmax_operations = {operations}\n"
    );
    generate(&source(&text), &options()).unwrap();
    // Budgets of functions that are not generated have no effect.
    let other = "[[budget]]\nfunction = \"bias\"\nmax_operations = 0\nmax_stack = 0\n";
    generate(&source(other), &options()).unwrap();
    let limits = Options { max_operations: Some(operations), max_stack: Some(stack), ..options() };
    generate(&source(""), &limits).unwrap();
}

#[test]
fn one_operation_too_many_breaks_the_build_at_the_limits_place() {
    let [operations, stack, _] = costs();
    let (most, bytes) = (operations - 1, stack - 1);
    let text = format!(
        "[[budget]]\nfunction = \"inverse_dynamics\"\nmax_operations = {most}\nmax_stack = {bytes}\n"
    );
    let source = source(&text);
    for error in [
        generate(&source, &options()).unwrap_err().to_string(),
        package::package(&source, &options()).unwrap_err().to_string(),
    ] {
        let line = source.text.lines().position(|line| line.starts_with("max_op")).unwrap() + 1;
        for part in [
            format!("arm.toml:{line}:18"),
            format!("takes {operations} operations; its budget is {most}"),
            "a search for a cheaper plan".to_owned(),
            format!("arm.toml:{}:13", line + 1),
            format!("takes up to {stack} bytes of stack; its budget is {bytes}"),
            "measure the compiled code".to_owned(),
            "R0801".to_owned(),
        ] {
            assert!(error.contains(&part), "{part} is not in\n{error}");
        }
    }
    // The programs are still available, so that users can see which functions cost too much.
    programs(&source, &options()).unwrap();
}

#[test]
fn options_and_budgets_of_every_function_hold_all() {
    let [_, _, least] = costs();
    let limits = Options { max_operations: Some(least - 1), max_stack: Some(1), ..options() };
    let error = generate(&source(""), &limits).unwrap_err();
    assert_eq!(error.as_slice().len(), 4);
    for part in ["arm.toml: `inverse_dynamics` takes", "`mass_matrix` takes", "raise `max_stack`"] {
        assert!(error.to_string().contains(part), "{error}");
    }
    let text = format!("[budget]\nmax_operations = {}\n", least - 1);
    let error = generate(&source(&text), &options()).unwrap_err().to_string();
    assert_eq!(error.matches("R0801").count(), 2, "{error}");
}

#[test]
fn the_tightest_limit_of_the_stack_counts() {
    let source =
        source("[[budget]]\nmax_stack = 900\n[[budget]]\nfunction = \"bias\"\nmax_stack = 800\n");
    let programs = programs(&source, &options()).unwrap();
    let limit = |options: &Options, name| budget::max_stack(&programs, options, name);
    assert_eq!(limit(&options(), "inverse_dynamics"), Some(900));
    assert_eq!(limit(&options(), "bias"), Some(800));
    let options = Options { max_stack: Some(850), ..options() };
    assert_eq!(limit(&options, "inverse_dynamics"), Some(850));
    assert_eq!(limit(&options, "bias"), Some(800));
}

/// A budget of a function of frames holds for that of each frame, and that of a function not for others whose names begin
/// with its own.
#[test]
fn a_budget_holds_for_the_function_of_each_frame() {
    let frame = "[[frame]]\nname = \"elbow\"\nparent = \"2\"\n";
    let limited = |function: &str| {
        let text = format!("{frame}[[budget]]\nfunction = \"{function}\"\nmax_operations = 0\n");
        let source = source(&text);
        let names = ["jacobian_elbow", "inverse_dynamics_wrench"].map(str::to_owned);
        let robot = robot_build::read(&source).unwrap().robot;
        let functions = robot_build::functions_named(&names, &robot).unwrap();
        match generate(&source, &Options { functions, ..Options::default() }) {
            Ok(_) => String::new(),
            Err(errors) => errors.to_string(),
        }
    };
    for (function, named) in [
        ("jacobian", Some("jacobian_elbow")),
        ("jacobian_elbow", Some("jacobian_elbow")),
        ("inverse_dynamics_wrench", Some("inverse_dynamics_wrench")),
        ("inverse_dynamics", None),
        ("jacobian_dot_qd", None),
    ] {
        let found = limited(function);
        for name in ["jacobian_elbow", "inverse_dynamics_wrench"] {
            let is_over = found.contains(&format!("`{name}` takes"));
            assert_eq!(is_over, named == Some(name), "{function}: {found}");
        }
        assert_eq!(found.is_empty(), named.is_none(), "{function}: {found}");
    }
}
