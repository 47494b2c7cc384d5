//! Names of robot files that the libraries of a language have too.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use robot_build::languages::{Language, package};
use robot_build::{File, Options, Scalar, Source};

/// Macros of the headers of C and C++.
const MACROS: [&str; 24] = [
    "HUGE_VAL",
    "SIZE_MAX",
    "FP_NAN",
    "INT8_MAX",
    "math_errhandling",
    "M_PI_2",
    "M_SQRT2",
    "M_LN2",
    "MAXFLOAT",
    "RAND_MAX",
    "BIG_ENDIAN",
    "BUFSIZ",
    "INT_MAX",
    "DBL_MAX",
    "SIGINT",
    "EXIT_FAILURE",
    "EDOM",
    "CLOCKS_PER_SEC",
    "FE_TONEAREST",
    "PRId64",
    "CMPLX",
    "LC_ALL",
    "WEOF",
    "INFINITY",
];

/// Macros of Arduino.
const OF_ARDUINO: [&str; 22] = [
    "HIGH",
    "LOW",
    "INPUT_PULLUP",
    "HALF_PI",
    "DEG_TO_RAD",
    "EULER",
    "LSBFIRST",
    "FALLING",
    "DEFAULT",
    "EXTERNAL",
    "constrain",
    "radians",
    "sq",
    "noInterrupts",
    "lowByte",
    "bitRead",
    "F",
    "B11",
    "A0",
    "LED_BUILTIN",
    "MOSI",
    "TCCR0A",
];

/// A pendulum whose mass is the sum of parameters with these names, and with a bundle of the first of them.
fn pendulum(robot: &str, parameters: &[&str], bundle: &str) -> Source {
    let values: String = parameters
        .iter()
        .map(|name| format!("{name} = {{ value = 0.5, unit = \"kg\" }}\n"))
        .collect();
    let text = format!(
        "format = 1
[robot]
name = \"{robot}\"
[parameters]
{values}[[link]]
name = \"rod\"
joint = {{ type = \"revolute\", axis = \"y\" }}
mass = \"{}\"
center_of_mass = [0.5, 0, 0]
inertia = {{ xx = 0, yy = 0.1, zz = 0.1, unchecked = true }}
[code]
functions = [\"gravity\", \"inverse_dynamics\"]
[code.bundles]
{bundle} = [\"gravity\", \"energies\"]
",
        parameters.join(" + ")
    );
    Source { name: "pendulum.toml".to_owned(), text }
}

fn files(source: &Source, language: Language) -> Vec<File> {
    let scalar = if language == Language::Arduino { Scalar::F32 } else { Scalar::F64 };
    package(source, &Options { scalar, ..Options::default() }, language).unwrap()
}

/// The code of a package.
fn code(files: &[File]) -> String {
    let is_code = |file: &&File| !file.path.ends_with(".md") && !file.path.ends_with(".json");
    files.iter().filter(is_code).filter_map(|file| file.contents.text()).collect()
}

/// Asserts that each parameter has an underscore, or that none has.
#[track_caller]
fn assert_renamed(names: &[&str], source: &Source, language: Language, renamed: bool) {
    let code = code(&files(source, language));
    for name in names {
        let declared = |ending: &str| code.contains(&format!("double {name}{ending};"));
        let found = [declared(""), declared("_")];
        assert_eq!(found, [!renamed, renamed], "{name} in {}", language.name());
    }
}

/// Writes the files of a package into a new folder.
fn written(files: &[File], name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("robot_build-{}-{name}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    for file in files {
        let path = folder.join(&file.path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, file.contents.bytes()).unwrap();
    }
    folder
}

fn is_there(tool: &str) -> bool {
    Command::new(tool).arg("--version").output().is_ok_and(|found| found.status.success())
}

/// Runs a program in a folder.
#[track_caller]
fn run(folder: &Path, program: impl AsRef<Path>, arguments: &[&str]) {
    let program = program.as_ref();
    let found = Command::new(program).args(arguments).current_dir(folder).output().unwrap();
    let text = [found.stdout, found.stderr].concat();
    assert!(found.status.success(), "{}: {}", program.display(), String::from_utf8_lossy(&text));
}

#[test]
fn macros_of_c_are_not_names() {
    let source = pendulum("arm", &MACROS, "ULLONG_MAX");
    for language in [Language::C, Language::Cpp, Language::Cuda, Language::Arduino] {
        assert_renamed(&MACROS, &source, language, true);
    }
    assert!(code(&files(&source, Language::Cpp)).contains(" ULLONG_MAX_("));
}

#[test]
fn macros_of_arduino_are_names_only_elsewhere() {
    let source = pendulum("arm", &OF_ARDUINO, "SERIAL");
    assert_renamed(&OF_ARDUINO, &source, Language::Arduino, true);
    assert_renamed(&OF_ARDUINO, &source, Language::C, false);
}

/// Where the compilers are installed, such packages compile behind all headers, and compute their check values.
#[test]
fn packages_with_names_of_macros_compile() {
    let source = pendulum("arm", &MACROS, "ULLONG_MAX");
    let headers = [
        "complex", "errno", "fenv", "float", "inttypes", "limits", "locale", "signal", "stdlib",
        "time", "wchar",
    ];
    let headers: String = headers.iter().map(|name| format!("#include <{name}.h>\n")).collect();
    for (language, compiler, standard, test) in [
        (Language::C, "gcc", "-std=gnu11", "test.c"),
        (Language::Cpp, "g++", "-std=gnu++17", "test.cpp"),
    ] {
        if !is_there(compiler) {
            continue;
        }
        let folder = written(&files(&source, language), compiler);
        fs::write(folder.join("all.h"), &headers).unwrap();
        let options = [standard, "-Wall", "-Wextra", "-Werror", "-ffp-contract=off"];
        let program = ["-include", "all.h", test, "-o", "test", "-lm"];
        run(&folder, compiler, &[&options[..], &program].concat());
        run(&folder, folder.join("test"), &[]);
        if language == Language::C {
            let casadi = ["-include", "all.h", "-c", "arm_casadi.c"];
            run(&folder, compiler, &[&options[..], &casadi].concat());
        }
        let _ = fs::remove_dir_all(&folder);
    }
}

/// A package folder does not have the name of a function, nor of one of the test; where Octave is installed, the test
/// runs.
#[test]
fn packages_in_matlab_hide_no_functions() {
    let robots = ["std", "var", "mean", "cross", "check", "test_functions", "model", "found1"];
    for (robot, is_renamed) in robots.iter().zip([[true; 7].as_slice(), &[false]].concat()) {
        let files = files(&pendulum(robot, &["m"], "median"), Language::Matlab);
        let folder = if is_renamed { format!("+{robot}_/") } else { format!("+{robot}/") };
        let path = format!("{folder}gravity.m");
        assert!(files.iter().any(|file| file.path == path), "{path}");
        if is_there("octave-cli") {
            let folder = written(&files, robot);
            run(&folder, "octave-cli", &["--norc", "--eval", "test_functions; std([1, 2, 3]);"]);
            let _ = fs::remove_dir_all(&folder);
        }
    }
}
