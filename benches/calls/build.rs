//! Generates every function of every robot twice, with the standard library's sine and cosine and with the
//! runtime's, and the list of all calls. If the target has no multiply-adds, they are products and sums. It also
//! generates inverse dynamics with the default options, forms of the UR5 over many states, and single functions of
//! larger robots.
//!
//! If the environment variable `CALLS_OF` has names of robots, there are only their functions, and the gravity torques of
//! the larger robots: CI then checks in seconds that the benchmark compiles. The UR5 must be one of them.

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use robot_build::{
    Builder, Bundle, DEFAULT_BATCH, FunctionKind, Functions, Options, Scalar, Source, Trigonometry, programs,
};

const TRIGONOMETRY: [(&str, Trigonometry); 2] =
    [("standard", Trigonometry::Standard), ("polynomial", Trigonometry::Polynomial)];

const ROBOTS: &str = "../../robots";

/// The poses and Jacobians of all named frames in one call; the other programs compute those of the last frame
/// only.
const BUNDLE: &str = "pose_and_jacobian";
/// Robot files for which all functions would take too long, and the functions to generate for them.
const LARGE: [(&str, &[&str]); 3] = [
    ("../../tests/fixtures/limbs/quadruped.toml", &["inverse_dynamics"]),
    ("robots/humanoid.toml", &["inverse_dynamics", "inverse_dynamics_derivatives"]),
    ("robots/chain.toml", &["mass_matrix_lower"]),
];
const BUNDLED: [FunctionKind; 2] = [FunctionKind::FramePoses, FunctionKind::Jacobian];

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-env-changed=CALLS_OF");
    let out = PathBuf::from(std::env::var("OUT_DIR")?);
    let only = std::env::var("CALLS_OF").ok();
    let folder = &match &only {
        Some(names) => copied(names.split(','), &out.join("robots"))?,
        None => PathBuf::from(ROBOTS),
    };
    let large = LARGE.map(|(file, functions)| (file, if only.is_some() { &["gravity"] } else { functions }));
    for (name, trigonometry) in TRIGONOMETRY {
        let out = out.join(name);
        std::fs::create_dir_all(&out)?;
        Builder::new()
            .functions(["all"])
            .bundle(BUNDLE, BUNDLED.map(FunctionKind::name))
            .trigonometry(trigonometry)
            .fused(true)
            .batch(DEFAULT_BATCH)
            .allow_outside(true)
            .out_dir(out)
            .compile_folder(folder)?;
    }
    let folder_of = |name: &str| -> std::io::Result<PathBuf> {
        let folder = out.join(name);
        std::fs::create_dir_all(&folder)?;
        Ok(folder)
    };
    let one = || Builder::new().functions(["inverse_dynamics"]).allow_outside(true);
    one().out_dir(folder_of("default")?).compile_folder(folder)?;
    let forms = || one().trigonometry(Trigonometry::Polynomial).fused(true).generic(true);
    let ur5 = [folder.join("ur5.toml")];
    forms().batch(8).out_dir(folder_of("double")?).compile(&ur5)?;
    let single = forms().batch(16).scalar(Scalar::F32);
    single.out_dir(folder_of("single")?).compile(&ur5)?;
    for (file, functions) in large {
        Builder::new()
            .functions(functions.iter().copied())
            .trigonometry(Trigonometry::Polynomial)
            .fused(true)
            .allow_outside(true)
            .out_dir(folder_of("large")?)
            .compile(&[file])?;
    }
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<_>>()?;
    files.retain(|file| file.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    let mut list = String::from("/// Every function of every robot.\npub fn all(calls: &mut impl Calls) {\n");
    for file in files {
        let built: Vec<(&str, Option<&[&str]>)> =
            TRIGONOMETRY.iter().map(|(name, _)| (*name, None)).collect();
        robot(&mut list, &file, &built)?;
        robot(&mut list, &file, &[("default", Some(&["inverse_dynamics"]))])?;
    }
    for (file, functions) in large {
        robot(&mut list, Path::new(file), &[("large", Some(functions))])?;
    }
    list.push_str("}\n");
    Ok(std::fs::write(out.join("list.rs"), list)?)
}

/// Copies the files of these robots into a folder, which is returned.
fn copied<'r>(robots: impl Iterator<Item = &'r str>, folder: &Path) -> std::io::Result<PathBuf> {
    std::fs::create_dir_all(folder)?;
    for robot in robots {
        for extension in ["toml", "plan"] {
            let file = format!("{robot}.{extension}");
            std::fs::copy(Path::new(ROBOTS).join(&file), folder.join(&file))?;
        }
    }
    Ok(folder.to_owned())
}

/// Adds the calls of one robot's functions to the list. Each module has either the given functions of the robot, or
/// all of them and a batch.
fn robot(
    list: &mut String,
    file: &Path,
    modules: &[(&str, Option<&[&str]>)],
) -> Result<(), Box<dyn Error>> {
    let text = std::fs::read_to_string(file)?;
    let name = file.file_stem().ok_or("a file without a name")?.to_string_lossy().into_owned();
    let source = Source { name: file.to_string_lossy().into_owned(), text };
    let described = programs(&source, &Options::default())?;
    let all = modules.iter().all(|(_, chosen)| chosen.is_none());
    let chosen = modules.iter().filter_map(|(_, chosen)| *chosen).flatten();
    let functions = match all {
        true => FunctionKind::of_robot(&described.robot),
        false => chosen.filter_map(|name| FunctionKind::from_name(name)).collect(),
    };
    let bundle = Bundle { name: BUNDLE.to_owned(), functions: BUNDLED.to_vec() };
    let bundles = if all { vec![bundle] } else { vec![] };
    let options = Options { functions: Functions::Chosen(functions), bundles, ..Options::default() };
    let module = programs(&source, &options)?.module;
    let parameters = !module.parameters.is_empty();
    let model = if parameters { "Model::new(&Parameters::NOMINAL)" } else { "Model::NOMINAL" };
    let import = if parameters { "{Model, Parameters}" } else { "Model" };
    for (trigonometry, chosen) in modules {
        writeln!(list, "{{ use crate::{trigonometry}::{name}::{import}; let model = std::hint::black_box({model});")?;
        // A function without inputs is computed once and takes no time, so it is omitted.
        let wanted = |name: &str| chosen.is_none_or(|chosen| chosen.contains(&name));
        let functions = module.functions.iter().filter(|function| wanted(&function.name));
        for function in functions.filter(|function| !function.inputs.is_empty()) {
            let names: Vec<String> = (0..function.inputs.len()).map(|i| format!("i{i}")).collect();
            let arrays: Vec<String> = function
                .inputs
                .iter()
                .map(|input| format!("random.array::<{}>()", input.symbols.len()))
                .collect();
            let (names, arrays) = (names.join(", "), arrays.join(", "));
            // Several outputs are the fields of a struct.
            let first = match function.outputs.as_slice() {
                [first, _, ..] => format!("result.{}.first()", first.name),
                _ => "result.first()".to_owned(),
            };
            writeln!(
                list,
                "calls.call(({name:?}, {trigonometry:?}, {function:?}), |random| ({arrays},), |({names},)| model.{function}({names}), |(i0, ..)| i0, |result| {first});",
                function = function.name,
            )?;
        }
        if chosen.is_some() {
            list.push('}');
            continue;
        }
        writeln!(
            list,
            "calls.batch(({name:?}, {trigonometry:?}, \"inverse_dynamics_batch\"), |q, qd, qdd, tau| {{ model.inverse_dynamics_batch(q, qd, qdd, tau); }}); }}"
        )?;
    }
    Ok(())
}
