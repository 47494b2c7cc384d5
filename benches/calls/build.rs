//! Generates every function of every robot twice, with the standard library's sine and cosine and with
//! the runtime's, and the list of all calls. Multiply-adds are products and sums where the target has
//! none.

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use robot_build::{
    Builder, Bundle, DEFAULT_BATCH, FunctionKind, Functions, Options, Source, Trigonometry, programs,
};

const TRIGONOMETRY: [(&str, Trigonometry); 2] =
    [("standard", Trigonometry::Standard), ("polynomial", Trigonometry::Polynomial)];

/// The poses and Jacobians of all named frames in one call, as the other contenders give them for the
/// last one.
const BUNDLE: &str = "pose_and_jacobian";
const BUNDLED: [FunctionKind; 2] = [FunctionKind::FramePoses, FunctionKind::Jacobian];

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(std::env::var("OUT_DIR")?);
    let folder = Path::new("../../robots");
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
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<_>>()?;
    files.retain(|file| file.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    let mut list = String::from("/// Every function of every robot.\npub fn all(calls: &mut impl Calls) {\n");
    for file in files {
        robot(&mut list, &file)?;
    }
    list.push_str("}\n");
    Ok(std::fs::write(out.join("list.rs"), list)?)
}

/// The calls of one robot's functions.
fn robot(list: &mut String, file: &Path) -> Result<(), Box<dyn Error>> {
    let text = std::fs::read_to_string(file)?;
    let name = file.file_stem().ok_or("a file without a name")?.to_string_lossy().into_owned();
    let source = Source { name: file.to_string_lossy().into_owned(), text };
    let described = programs(&source, &Options::default())?;
    let functions = FunctionKind::of_robot(&described.robot);
    let bundle = Bundle { name: BUNDLE.to_owned(), functions: BUNDLED.to_vec() };
    let options =
        Options { functions: Functions::Chosen(functions), bundles: vec![bundle], ..Options::default() };
    let module = programs(&source, &options)?.module;
    let parameters = !module.parameters.is_empty();
    let model = if parameters { "Model::new(&Parameters::NOMINAL)" } else { "Model::NOMINAL" };
    let import = if parameters { "{Model, Parameters}" } else { "Model" };
    for (trigonometry, _) in TRIGONOMETRY {
        writeln!(list, "{{ use crate::{trigonometry}::{name}::{import}; let model = std::hint::black_box({model});")?;
        // What needs no inputs is computed once, and takes no time.
        for function in module.functions.iter().filter(|function| !function.inputs.is_empty()) {
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
        writeln!(
            list,
            "calls.batch(({name:?}, {trigonometry:?}, \"inverse_dynamics_batch\"), |q, qd, qdd, tau| {{ model.inverse_dynamics_batch(q, qd, qdd, tau); }}); }}"
        )?;
    }
    Ok(())
}
