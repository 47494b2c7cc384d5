//! Limits on the operations and the stack of generated code: `[[budget]]` in a robot file, and options of a build.
//!
//! Operation counts are exact: the multiplications, additions and divisions of one call, as
//! `robot-symbolic stats` counts them. A build cannot measure the stack with a compiler; it compares the
//! estimate of [`robot_codegen::backend::rust::stack::estimate`] with the limit. `robot-symbolic prove` compares the
//! stack of release builds with the same limit.

use std::fmt;

use robot_codegen::backend::rust::stack;
use robot_codegen::module::Function;
use robot_model::description::{Budget, Limit};
use robot_model::diagnostic::{Diagnostic, Diagnostics, Source, code};
use robot_model::functions::FunctionKind;

use crate::driver::options::Options;
use crate::driver::programs::{self, Programs};
use crate::error::{Error, Errors};

/// The resource that is limited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Resource {
    /// The operations of a call.
    Operations,
    /// The bytes of stack of a call.
    Stack,
}

/// A function that exceeds its budget.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Over {
    /// The function.
    pub function: String,
    /// The resource that exceeds its limit.
    pub resource: Resource,
    /// The operation count, or the estimated stack in bytes.
    pub found: u64,
    /// The limit.
    pub limit: u64,
}

impl Over {
    /// The remedy.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self.resource {
            Resource::Operations => {
                "run a search for a cheaper plan, check for values that are nearly, but not exactly, 0 or \
                 right angles, generate fewer outputs, or raise `max_operations`"
            }
            Resource::Stack => {
                "this is an upper bound for builds without optimization, sines and cosines excluded: measure the \
                 compiled code; use `f32`, generate fewer outputs, or raise `max_stack`"
            }
        }
    }
}

impl fmt::Display for Over {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Over { function, resource, found, limit } = self;
        match resource {
            Resource::Operations => {
                let plural = if *found == 1 { "" } else { "s" };
                write!(
                    formatter,
                    "`{function}` takes {found} operation{plural}; its budget is {limit}"
                )
            }
            Resource::Stack => write!(
                formatter,
                "`{function}` takes up to {found} bytes of stack; its budget is {limit}"
            ),
        }
    }
}

/// The maximum stack of a function in bytes; `None` if there is no limit.
#[must_use]
pub fn max_stack(programs: &Programs, options: &Options, function: &str) -> Option<u64> {
    let of_file = limits(programs, function).filter_map(|(_, stack)| stack);
    of_file.map(|limit| limit.value).chain(options.max_stack).min()
}

/// Does the same as [`programs()`](crate::programs), and checks the functions against their budgets.
///
/// # Errors
///
/// All errors in the file or the options, or each function that exceeds a budget.
pub fn programs(source: &Source, options: &Options) -> Result<Programs, Errors> {
    let programs = programs::programs(source, options)?;
    check(&programs, source, options)?;
    Ok(programs)
}

/// Returns an error for each function that exceeds a budget of the file or of the options.
fn check(programs: &Programs, source: &Source, options: &Options) -> Result<(), Errors> {
    let (mut found, mut errors) = (vec![], vec![]);
    for function in &programs.module.functions {
        let limits: Vec<_> = limits(programs, &function.name).collect();
        if limits.is_empty() && options.max_operations.is_none() && options.max_stack.is_none() {
            continue;
        }
        let [operations, stack] = costs(programs, function, options);
        for (max_operations, max_stack) in limits {
            found.extend(max_operations.and_then(|limit| excess(operations, limit)));
            found.extend(max_stack.and_then(|limit| excess(stack, limit)));
        }
        for (cost, limit) in [(operations, options.max_operations), (stack, options.max_stack)] {
            let over = limit.and_then(|limit| cost.over(limit));
            errors.extend(over.map(|over| Error::Budget { name: source.name.clone(), over }));
        }
    }
    if !found.is_empty() {
        let diagnostics = Diagnostics::new(source.clone(), found);
        errors.push(Error::Robot(Box::new(diagnostics)));
    }
    Errors::check(errors, ())
}

/// The cost of a function.
#[derive(Clone, Copy)]
struct Cost<'f> {
    function: &'f str,
    resource: Resource,
    found: u64,
}

impl Cost<'_> {
    fn over(self, limit: u64) -> Option<Over> {
        let Cost { function, resource, found } = self;
        (found > limit).then(|| Over { function: function.to_owned(), resource, found, limit })
    }
}

fn costs<'f>(programs: &Programs, function: &'f Function, options: &Options) -> [Cost<'f>; 2] {
    let operations = programs.module.counts(function).call.operations();
    let stack = stack::estimate(function, options.scalar.size());
    [(Resource::Operations, operations), (Resource::Stack, stack)].map(|(resource, found)| Cost {
        function: &function.name,
        resource,
        found: found as u64,
    })
}

fn excess(cost: Cost<'_>, limit: &Limit) -> Option<Diagnostic> {
    let over = cost.over(limit.value)?;
    Some(
        Diagnostic::error(code::BUDGET, over.to_string())
            .at(&limit.place, format!("exceeded by {}", over.found - over.limit))
            .help(over.remedy()),
    )
}

/// Returns the limits on operations and stack that the file sets for a function.
fn limits<'p>(
    programs: &'p Programs,
    function: &str,
) -> impl Iterator<Item = (Option<&'p Limit>, Option<&'p Limit>)> {
    let bundle = programs.bundles.iter().find(|bundle| bundle.name == function);
    let known = || kind(function).map(FunctionKind::name);
    let named = bundle.map(|bundle| bundle.name.as_str()).or_else(known);
    let function = function.to_owned();
    let is_of = move |budget: &&Budget| match &budget.function {
        Some(wanted) => named == Some(wanted.as_str()) || *wanted == function,
        None => true,
    };
    let budgets = programs.budgets.iter().filter(is_of);
    budgets.map(|budget| (budget.max_operations.as_ref(), budget.max_stack.as_ref()))
}

/// Returns the kind of the function with this name. The names of functions of a frame end with the frame's name.
fn kind(name: &str) -> Option<FunctionKind> {
    let is_of = |kind: &&FunctionKind| {
        let rest = name.strip_prefix(kind.name());
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    };
    FunctionKind::ALL.iter().filter(is_of).max_by_key(|kind| kind.name().len()).copied()
}
