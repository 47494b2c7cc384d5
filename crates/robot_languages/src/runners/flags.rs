//! The tests of C and C++ packages with compiler options that change results: each must fail and name the option.

use std::path::Path;

use robot_build::languages::Language;
use robot_codegen::Scalar;

use super::{Found, Runner, write_package};
use crate::files;
use crate::work::Work;

/// The runner that compiles tests of packages with good and with bad options. It does not compare bits: its findings
/// are errors.
pub(super) struct Flags;

/// The compilers, with their language, its standard and the file of the test.
const COMPILERS: [(&str, Language, &str, &str); 3] = [
    ("gcc", Language::C, "-std=c99", "test.c"),
    ("clang", Language::C, "-std=c99", "test.c"),
    ("g++", Language::Cpp, "-std=c++17", "test.cpp"),
];

/// The options that the README recommends.
const GOOD: &[&str] = &["-O2", "-ffp-contract=off"];

/// Options that change results, with the option that the test must name. The first has an effect only if the processor
/// has fused multiply-adds.
const BAD: [(&[&str], &str); 3] = [
    (&["-O2", "-march=native", "-ffp-contract=fast"], "-ffp-contract=off"),
    (
        &["-O2", "-fassociative-math", "-fno-signed-zeros", "-fno-trapping-math"],
        "-fassociative-math",
    ),
    (&["-O2", "-ffast-math"], "-ffast-math"),
];

/// The robot; one is enough, because all tests are printed in the same way.
const ROBOT: &str = "planar_2r.toml";

impl Runner for Flags {
    fn name(&self) -> &'static str {
        "flags"
    }

    fn missing(&self) -> Option<String> {
        let tools = COMPILERS.map(|(compiler, ..)| compiler);
        let missing = tools.into_iter().find(|tool| !files::is_there(tool, &["--version"]));
        missing.map(|tool| format!("{tool} is not installed"))
    }

    fn has(&self, scalar: Scalar) -> bool {
        scalar == Scalar::F64
    }

    fn has_standard_sines(&self) -> bool {
        false
    }

    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String> {
        if work.source.name != ROBOT {
            return Ok(vec![]);
        }
        for (index, (compiler, language, standard, test)) in COMPILERS.into_iter().enumerate() {
            let folder = folder.join(index.to_string());
            write_package(work, language, &folder)?;
            let run = |options: &[&str]| {
                let ends = [standard, test, "-o", "test", "-lm"];
                files::run(&folder, compiler, &[options, &ends[..]].concat())?;
                files::run(&folder, "./test", &[])
            };
            run(GOOD)?;
            for (options, named) in BAD.into_iter().skip(usize::from(!has_multiply_adds())) {
                let said = run(options).err();
                if !said.as_ref().is_some_and(|said| mentions(said, compiler, named)) {
                    return Err(format!("{compiler} {}: {said:?}", options.join(" ")));
                }
            }
        }
        Ok(vec![])
    }
}

/// Whether a message names an option. The first line of an error repeats the command, which does not count.
fn mentions(said: &str, compiler: &str, option: &str) -> bool {
    let own = said.lines().filter(|line| !line.starts_with(&format!("{compiler} ")));
    own.into_iter().any(|line| line.contains(option))
}

#[cfg(target_arch = "x86_64")]
fn has_multiply_adds() -> bool {
    std::arch::is_x86_feature_detected!("fma")
}

#[cfg(not(target_arch = "x86_64"))]
fn has_multiply_adds() -> bool {
    cfg!(target_arch = "aarch64")
}

#[cfg(test)]
mod tests {
    use super::mentions;

    #[test]
    fn the_repeated_command_names_nothing() {
        assert!(!mentions(
            "gcc -O2 -ffast-math test.c: exit 1\nno such file",
            "gcc",
            "-ffast-math"
        ));
        assert!(mentions(
            "gcc -O2 -ffast-math test.c: exit 1\nwithout -ffast-math",
            "gcc",
            "-ffast-math"
        ));
    }
}
