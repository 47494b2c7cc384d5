//! What stands around the code in a package: how it is used, built and tested. The code itself is in the goldens of
//! `robot_codegen`.
//!
//! `UPDATE_SNAPSHOTS=1` writes the files anew; read the difference before it is kept.

use std::fmt::Write as _;
use std::path::Path;

use robot_build::languages::{Language, package_of};
use robot_build::{Options, Scalar, Source, programs};
use robot_model::functions::{FunctionKind, Functions};

/// A pendulum whose length has no nominal value: functions with and without inputs need the model.
const PENDULUM: &str = r#"format = 1
[robot]
name = "pendulum"
[parameters]
l = { unit = "m", doc = "length" }
[[link]]
name = "rod"
joint = { type = "revolute", axis = "y" }
mass = 2
center_of_mass = ["l", 0, 0]
inertia = { xx = 0, yy = 0.1, zz = 0.1 }
"#;

/// A robot without parameters, with a description and a prismatic joint.
const LIFT: &str = r#"format = 1
[robot]
name = "Lift"
description = "turns, then lifts"
gravity = [0, 0, -9.81]
[[link]]
name = "column"
joint = { type = "revolute", axis = "y" }
mass = 3
center_of_mass = [0.1, 0, 0]
inertia = { xx = 0.1, yy = 0.1, zz = 0.1 }
[[link]]
name = "carriage"
joint = { type = "prismatic", axis = "z" }
mass = 2
center_of_mass = [0.5, 0, 0]
inertia = { xx = 0.1, yy = 0.1, zz = 0.1 }
[tip]
parent = "carriage"
"#;

/// The files around the code of two packages: in double precision with parameters, and, where the language has it, in single
/// precision without.
fn around_the_code(language: Language) -> String {
    let kinds = |names: &[&str]| {
        let kinds = names.iter().map(|name| FunctionKind::from_name(name).unwrap());
        Functions::Chosen(kinds.collect())
    };
    let single = [Language::Wgsl, Language::Arduino].contains(&language);
    let options = Options {
        functions: kinds(&["mass_matrix", "base_parameters"]),
        scalar: if single { Scalar::F32 } else { Scalar::F64 },
        ..Options::default()
    };
    let pendulum = Source { name: "pendulum.toml".to_owned(), text: PENDULUM.to_owned() };
    let lift = Source { name: "robots/lift.toml".to_owned(), text: LIFT.to_owned() };
    let other = Options {
        functions: kinds(&["inverse_dynamics_wrench", "forward_kinematics", "energies"]),
        scalar: Scalar::F32,
        ..Options::default()
    };
    let double = Options { scalar: Scalar::F64, ..other.clone() };
    let found = [&other, &double].into_iter().find_map(|options| files(&lift, options, language));
    let [first, second] = [files(&pendulum, &options, language), found].map(Option::unwrap);
    format!("{first}\n==== the lift\n{second}")
}

/// The files of a package other than its code, one behind the other; `None` if the language does not have the options.
fn files(source: &Source, options: &Options, language: Language) -> Option<String> {
    let found = programs(source, options).unwrap();
    let mut shown = String::new();
    let module = &found.module.name;
    for file in package_of(&found, source, options, language).ok()? {
        let path = Path::new(&file.path);
        let is_code = path.file_stem().is_some_and(|stem| stem == module.as_str())
            || file.path.starts_with("src/");
        let Some(text) = file.contents.text().filter(|_| !is_code) else { continue };
        write!(shown, "---- {}\n{}\n", file.path, text.trim_end()).unwrap();
    }
    // A release changes nothing else of it.
    Some(
        shown.replace(&format!("robot_build {}", env!("CARGO_PKG_VERSION")), "robot_build VERSION"),
    )
}

#[test]
fn packages_are_those_that_were_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/languages/packages");
    let update = std::env::var_os("UPDATE_SNAPSHOTS").is_some();
    let mut differing = vec![];
    for language in Language::ALL {
        let path = folder.join(format!("{}.txt", language.name()));
        let found = around_the_code(*language);
        if update {
            std::fs::create_dir_all(&folder).unwrap();
            std::fs::write(&path, &found).unwrap();
        }
        let expected = std::fs::read_to_string(&path).unwrap_or_default();
        let mut lines = expected.lines().zip(found.lines()).zip(1..);
        if expected != found {
            let place = lines.find(|((before, now), _)| before != now);
            differing.push(format!("{}, {place:?}", path.display()));
        }
    }
    assert!(differing.is_empty(), "UPDATE_SNAPSHOTS=1 writes them: {differing:#?}");
}
