//! Functions without finite values at the nominal values of the parameters.

use robot_codegen::{Interpreter, Trigonometry};
use robot_model::diagnostic::{Diagnostic, code};
use robot_model::functions::FunctionKind;

use crate::driver::check::{check_value, is_finite};
use crate::driver::programs::Programs;

/// The warning if constants that the module computes from the parameters are infinite or NaN at the nominal
/// values of these; `None` if all are finite or a parameter has no nominal value.
pub(crate) fn infinite(programs: &Programs) -> Option<Diagnostic> {
    let interpreter = Interpreter::new(&programs.module, &[]).ok()?;
    if interpreter.fields().iter().all(|value| value.is_finite()) {
        return None;
    }
    let is_infinite = |name: &str| {
        let check = check_value("", programs, name, Trigonometry::default());
        check.is_ok_and(|check| !is_finite(&check))
    };
    let names = programs.module.functions.iter().map(|function| function.name.as_str());
    let names: Vec<&str> = names.filter(|name| is_infinite(name)).collect();
    let message = match names.as_slice() {
        [] => "constants of the module are not finite at the nominal values of the parameters"
            .to_owned(),
        [one] => format!("`{one}` has no finite value at the nominal values of the parameters"),
        several => format!(
            "`{}` have no finite values at the nominal values of the parameters",
            several.join("`, `")
        ),
    };
    let has_base = |kind: &FunctionKind| kind.has_base_parameters();
    let is_base = |name: &&str| {
        let bundle = programs.bundles.iter().find(|bundle| bundle.name == **name);
        FunctionKind::from_name(name).as_ref().is_some_and(has_base)
            || bundle.is_some_and(|bundle| bundle.functions.iter().any(has_base))
    };
    let help = if !names.is_empty() && names.iter().all(is_base) {
        "the robot has fewer base parameters at these values than in general: write a parameter that is always 0 as \
         the number in the file, or give it another nominal value"
    } else {
        "give the parameters that make a divisor 0 other nominal values, or set them before a call"
    };
    let warning = Diagnostic::warning(code::INFINITE, message);
    Some(warning.because("a divisor is 0 there, so that a constant is infinite or NaN").help(help))
}
