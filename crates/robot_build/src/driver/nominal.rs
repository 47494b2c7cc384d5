//! Functions without finite values at the nominal values of the parameters.

use robot_codegen::{Interpreter, Trigonometry};
use robot_model::diagnostic::{Diagnostic, code};
use robot_model::functions::FunctionKind;

use crate::driver::check::{check_value, is_finite};
use crate::driver::programs::Programs;

/// The warning if constants that the module computes from the parameters are infinite or NaN at their nominal values;
/// `None` if a parameter has no nominal value.
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that fails panics")]

    use robot_model::diagnostic::Source;
    use robot_model::functions::{Effects, Functions};

    use super::*;
    use crate::driver::options::Options;
    use crate::driver::programs::programs;

    /// The warnings about three joints along x before which the angle `d` turns about y: if it is 0, their axes are
    /// parallel, and the arm has fewer base parameters.
    fn warned(d: &str, functions: &[FunctionKind]) -> Vec<String> {
        let link = |(name, kind): (&str, &str)| {
            format!(
                "[[link]]\nname = \"{name}\"\njoint = {{ type = \"{kind}\", axis = \"x\" }}\n\
                 origin = {{ xyz = [0.1, 0, 0], rpy = [0, \"d\", 0] }}\nmass = 1\n\
                 center_of_mass = [0.1, 0.2, 0.3]\ninertia = {{ xx = 0.1, yy = 0.11, zz = 0.12 }}\n"
            )
        };
        let links = [("shoulder", "revolute"), ("slide", "prismatic"), ("wrist", "revolute")];
        let text = format!(
            "format = 1\n[robot]\nname = \"arm\"\n[parameters]\nd = {d}\n{}",
            links.map(link).concat()
        );
        let source = Source { name: "arm.toml".to_owned(), text };
        let functions = Functions::Chosen(functions.to_vec());
        let programs = programs(&source, &Options { functions, ..Options::default() }).unwrap();
        let of_code = programs.warnings.iter().filter(|one| one.code == code::INFINITE);
        of_code.map(|one| one.message.clone()).collect()
    }

    #[test]
    fn base_parameters_that_a_nominal_value_makes_infinite_are_a_warning() {
        let base = [FunctionKind::RegressorBase, FunctionKind::BaseParameters];
        let [warning] = warned("0", &base).try_into().unwrap();
        assert!(warning.contains("`base_parameters`"), "{warning}");
        assert!(warned("0.3", &base).is_empty());
        assert!(warned("0", &[FunctionKind::InverseDynamics(Effects::NONE)]).is_empty());
    }
}
