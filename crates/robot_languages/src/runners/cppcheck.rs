//! cppcheck with its addon for MISRA C:2012 on printed C. It does not compare bits: all findings except the documented
//! deviations are errors.

use std::path::Path;

use robot_build::Functions;
use robot_build::languages::{Language, package};
use robot_codegen::Scalar;
use robot_model::functions::{Effects, FunctionKind};

use super::{Found, Runner};
use crate::files;
use crate::work::Work;

/// The runner of cppcheck.
pub(super) struct Cppcheck;

/// The rules from which printed C deviates, for reasons given in `docs/users/languages.md`.
const DEVIATIONS: &[&str] = &["2.2", "2.5", "10.4", "10.8", "12.1", "12.3", "17.7", "21.15"];

impl Runner for Cppcheck {
    fn name(&self) -> &'static str {
        "cppcheck"
    }

    fn missing(&self) -> Option<String> {
        let is_there = files::is_there("cppcheck", &["--version"]);
        (!is_there).then(|| "cppcheck is not installed".to_owned())
    }

    fn has(&self, _: Scalar) -> bool {
        true
    }

    fn has_standard_sines(&self) -> bool {
        false
    }

    /// Checks only three functions, because cppcheck takes minutes for long ones.
    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String> {
        let functions = vec![
            FunctionKind::InverseDynamics(Effects::default()),
            FunctionKind::ForwardDynamics(Effects::default()),
            FunctionKind::Gravity,
        ];
        let mut options = work.options.clone();
        options.functions = Functions::Chosen(functions);
        options.bundles = vec![];
        let files = package(&work.source, &options, Language::C);
        let files = files.map_err(|error| error.to_string())?;
        let mut unit = String::new();
        for file in files.iter().filter(|file| file.path.ends_with(".h")) {
            files::write(folder, &file.path, file.contents.bytes())?;
            unit.push_str(&format!("#include \"{}\"\n", file.path));
        }
        files::write(folder, "unit.c", unit.as_bytes())?;
        let suppressed = DEVIATIONS.iter().map(|rule| format!("--suppress=misra-c2012-{rule}"));
        let suppressed: Vec<String> = suppressed.collect();
        let mut arguments = vec!["--addon=misra", "--enable=warning,style,performance,portability"];
        arguments.extend(["--std=c99", "--quiet", "--error-exitcode=1"]);
        arguments.extend(suppressed.iter().map(String::as_str));
        arguments.push("unit.c");
        files::run(folder, "cppcheck", &arguments)?;
        Ok(vec![])
    }
}

#[cfg(test)]
mod tests {
    use super::DEVIATIONS;
    use crate::files;

    #[test]
    fn the_page_has_each_deviation_and_no_other() {
        let page = files::root().join("docs/users/languages.md");
        let page = std::fs::read_to_string(page).unwrap();
        let rows = page.lines().filter_map(|line| line.strip_prefix("| rule "));
        let rules: Vec<&str> = rows.filter_map(|row| row.split(' ').next()).collect();
        assert_eq!(rules, DEVIATIONS);
    }
}
