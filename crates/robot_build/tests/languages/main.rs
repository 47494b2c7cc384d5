//! Packages in all languages: all entry points write the same files, and no text of a robot file becomes code.

// Helpers of tests may panic, as tests do.
#![allow(clippy::unwrap_used, clippy::panic)]

mod harmless;
mod names;
mod packages;

use harmless::{Chosen, PLAIN, in_every_language};
use robot_build::languages::{Language, package, sources};
use robot_build::{Builder, Options, Scalar, Source, Trigonometry};
use robot_model::functions::{FunctionKind, Functions};
use robot_symbolic::Random;

const ARM: &str = r#"format = 1
[robot]
name = "Pendulum"
gravity = [0, 0, "-g"]
[parameters]
g = { value = 9.81, unit = "m/s^2" }
m = { value = 2.0, unit = "kg" }
l = { value = 0.5, unit = "m" }
[[link]]
name = "1"
joint = { type = "revolute", axis = "y" }
mass = "m"
center_of_mass = ["l", 0, 0]
inertia = { xx = 0, yy = 0, zz = 0 }
"#;

/// The builder writes the files of `package`, which are also those of the command.
#[test]
fn the_builder_writes_the_packages_of_the_command() {
    let folder = std::env::temp_dir().join(format!("robot_build-{}-doors", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("a.toml"), ARM).unwrap();
    let source = Source { name: "a.toml".to_owned(), text: ARM.to_owned() };
    for language in Language::ALL.iter().filter(|language| **language != Language::Rust) {
        let options = Options { scalar: Scalar::F32, ..Options::default() };
        let builder = Builder::new()
            .language(*language)
            .scalar(Scalar::F32)
            .package_dir(&folder)
            .out_dir(language.name())
            .emit_directives(false);
        match (package(&source, &options, *language), builder.compile(&["a.toml"])) {
            (Ok(expected), Ok(())) => {
                assert!(expected.len() > 2, "{}", language.name());
                for file in expected {
                    let path = folder.join(language.name()).join("pendulum").join(&file.path);
                    let found = std::fs::read(&path).unwrap();
                    assert!(found == file.contents.bytes(), "{}", path.display());
                }
            }
            (Err(expected), Err(found)) => assert_eq!(found.to_string(), expected.to_string()),
            (expected, found) => panic!("{}: {expected:?}, {found:?}", language.name()),
        }
    }
    let _ = std::fs::remove_dir_all(&folder);
}

/// The distance between columns is not read if every array has a single column; compilers would warn of this.
#[test]
fn functions_over_columns_of_a_single_joint_use_all_parameters() {
    let source = Source { name: "a.toml".to_owned(), text: ARM.to_owned() };
    for language in [Language::C, Language::Cpp, Language::Cuda] {
        let files = package(&source, &Options::default(), language).unwrap();
        let texts = files.iter().map(|file| String::from_utf8_lossy(file.contents.bytes()));
        let text: String = texts.collect();
        assert!(text.contains("size_t stride") && text.contains("(void)stride;"), "{text}");
    }
}

/// Functions differ from the constants of their module, and parameters from the helpers that compute with them.
#[test]
fn names_of_robot_files_do_not_hide_those_that_printers_use() {
    let text = ARM
        .replace("m = {", "sqrt_ = { value = 4.0, unit = \"1\" }\nm = {")
        .replace("\"l\"", "\"l*sqrt(sqrt_)\"")
        + "[code]\nfunctions = [\"gravity\"]\n[code.bundles]\nDOF = [\"gravity\", \"energies\"]\n";
    let source = Source { name: "a.toml".to_owned(), text };
    let files = |language| package(&source, &Options::default(), language).unwrap();
    let cases = [
        (Language::JavaScript, "pendulum.mjs", "export function DOF_2(", "export function DOF("),
        (Language::Python, "pendulum.py", "def DOF_2(", "def DOF("),
        (Language::Rust, "lib.rs", "fn DOF_2(", "fn DOF("),
        (Language::Matlab, "create_model.m", "sqrt_(sqrt__2)", "sqrt_(sqrt_)"),
    ];
    for (language, file, expected, wrong) in cases {
        let files = files(language);
        let paths: Vec<&str> = files.iter().map(|file| file.path.as_str()).collect();
        let texts = files.iter().filter_map(|file| file.contents.text());
        let text: String = texts.collect();
        assert!(paths.iter().any(|path| path.ends_with(file)), "{file} in {paths:?}");
        assert!(text.contains(expected), "{}: {text}", language.name());
        assert!(!text.contains(wrong), "{}: {text}", language.name());
    }
}

/// A bundle with the name of a constant is listed in the README by its name in the code, also beside its check values.
#[test]
fn a_readme_has_the_names_of_the_code() {
    let text = ARM.to_owned() + "[code.bundles]\nDOF = [\"gravity\", \"energies\"]\n";
    let source = Source { name: "a.toml".to_owned(), text };
    for language in [Language::Rust, Language::Python, Language::JavaScript] {
        let files = package(&source, &Options::default(), language).unwrap();
        let readme = text_of(&files, "README.md");
        assert!(readme.contains("| `DOF_2` |") && readme.contains("```text\nDOF_2\n"), "{readme}");
    }
    // Classes of C++.
    let text = ARM.to_owned() + "[code.bundles]\nModel = [\"gravity\", \"energies\"]\n";
    let source = Source { name: "a.toml".to_owned(), text };
    let files = package(&source, &Options::default(), Language::Cpp).unwrap();
    assert!(text_of(&files, "README.md").contains("| `Model_2` |"));
}

/// What else can be generated is listed in Rust, because the places to choose it are those of Rust.
#[test]
fn sources_in_rust_alone_list_the_functions_that_can_be_added() {
    let source = Source { name: "a.toml".to_owned(), text: ARM.to_owned() };
    for language in [Language::Rust, Language::C] {
        let files = sources(&source, &options(Scalar::F64), language).unwrap();
        let has_list = files
            .iter()
            .filter_map(|file| file.contents.text())
            .any(|text| text.contains("Other functions can be generated too"));
        assert_eq!(has_list, language == Language::Rust, "{}", language.name());
    }
}

/// A file of a package as text.
fn text_of<'f>(files: &'f [robot_build::File], name: &str) -> &'f str {
    files.iter().find(|file| file.path.ends_with(name)).unwrap().contents.text().unwrap()
}

/// The functions of the arm that have inputs.
const FUNCTIONS: [&str; 3] = ["inverse_dynamics", "mass_matrix", "forward_dynamics"];

fn options(scalar: Scalar) -> Options {
    let kinds = FUNCTIONS.map(|name| FunctionKind::from_name(name).unwrap());
    Options { functions: Functions::Chosen(kinds.to_vec()), scalar, ..Options::default() }
}

/// The example of CUDA launches each kernel once, with as many arguments as it takes: its arrays one behind the other.
#[test]
fn the_example_in_cuda_launches_every_kernel() {
    let source = Source { name: "a.toml".to_owned(), text: ARM.to_owned() };
    let files = package(&source, &options(Scalar::F64), Language::Cuda).unwrap();
    let (header, example) = (text_of(&files, ".cuh"), text_of(&files, "example.cu"));
    for function in FUNCTIONS {
        let kernel = format!("pendulum_{function}_kernel");
        let declared = header.split_once(&format!("{kernel}(")).unwrap().1;
        let count = declared.split_once(')').unwrap().0.split(',').count();
        let launches: Vec<&str> = example.split(&format!("{kernel}<<<1, 32>>>(")).skip(1).collect();
        assert_eq!(launches.len(), 1, "{function}: {example}");
        let arguments: Vec<&str> = launches[0].split_once(");").unwrap().0.split(", ").collect();
        assert_eq!(arguments.len(), count, "{function}: {arguments:?}");
        assert_eq!(arguments[..3], ["model", "1", "1"], "{function}");
        let places = (0..count - 3).map(|place| format!("memory + {place}")).collect::<Vec<_>>();
        assert_eq!(arguments[3..], places, "{function}");
    }
}

/// The description of WGSL names the entry point of each function, and has a number for each field of the model in the order
/// of the fields.
#[test]
fn the_description_of_wgsl_has_kernels_and_the_model() {
    let source = Source { name: "a.toml".to_owned(), text: ARM.to_owned() };
    let files = package(&source, &options(Scalar::F32), Language::Wgsl).unwrap();
    let code = text_of(&files, ".wgsl");
    let described: serde_json::Value = serde_json::from_str(text_of(&files, "robot.json")).unwrap();
    let functions = described["functions"].as_array().unwrap();
    assert_eq!(functions.len(), FUNCTIONS.len());
    for (function, name) in functions.iter().zip(FUNCTIONS) {
        let kernel = function["kernel"].as_str().unwrap();
        assert_eq!(kernel, format!("pendulum_{name}_kernel"));
        assert!(code.contains(&format!("fn {kernel}(")), "{code}");
    }
    let fields =
        code.split_once("struct pendulum_model_of_ {").unwrap().1.split_once('}').unwrap().0;
    let fields: Vec<&str> =
        fields.lines().filter_map(|line| Some(line.split_once(": f32")?.0.trim())).collect();
    let model = described["model"].as_object().unwrap();
    assert_eq!(model.keys().collect::<Vec<_>>(), fields);
    assert!(fields.len() > 1 && model.values().all(serde_json::Value::is_number), "{model:?}");
    // The pendulum's m l², for one.
    assert!(model.values().any(|value| value.as_f64() == Some(2.0 * 0.25)), "{model:?}");
}

/// The test of a package in WebAssembly compares bits only if they are those of the interpreter: in double precision, with the
/// own sines and without fused operations. Other packages have a tolerance.
#[test]
fn the_test_in_wasm_compares_bits_where_they_are_stated() {
    let source = Source { name: "a.toml".to_owned(), text: ARM.to_owned() };
    for scalar in [Scalar::F64, Scalar::F32] {
        for trigonometry in [Trigonometry::Polynomial, Trigonometry::Standard] {
            for fused in [false, true] {
                let options = Options { trigonometry, fused, ..options(scalar) };
                let Ok(files) = package(&source, &options, Language::Wasm) else { continue };
                let test = text_of(&files, "test.mjs");
                let exact =
                    scalar == Scalar::F64 && trigonometry == Trigonometry::Polynomial && !fused;
                let case = format!("{scalar:?}, {trigonometry:?}, {fused}");
                assert_eq!(test.contains("last bits differ"), exact, "{case}");
                let tolerance =
                    if scalar == Scalar::F64 { "<= 1e-12 * size" } else { "<= 1e-4 * size" };
                assert!(test.contains(tolerance), "{case}: {test}");
            }
        }
    }
}

/// A compiler that reorders sums makes own sines wrong, and changes the last bits of others.
#[test]
fn the_readme_in_c_tells_what_fast_math_does() {
    let source = Source { name: "a.toml".to_owned(), text: ARM.to_owned() };
    for (trigonometry, words) in [
        (Trigonometry::Polynomial, "makes sines wrong, so the header refuses to compile with it."),
        (Trigonometry::Standard, "reorders sums: last bits differ."),
    ] {
        let options = Options { trigonometry, ..options(Scalar::F64) };
        let files = package(&source, &options, Language::C).unwrap();
        assert!(text_of(&files, "README.md").contains(words), "{words}");
        let is_exact = trigonometry == Trigonometry::Polynomial;
        assert_eq!(text_of(&files, "test.c").contains("name_flags();"), is_exact);
    }
}

#[test]
fn options_of_rust_are_refused_in_other_languages() {
    let source = Source { name: "a.toml".to_owned(), text: ARM.to_owned() };
    let usual = || options(Scalar::F32);
    for (options, name) in [
        (Options { generic: true, ..usual() }, "generic"),
        (Options { batch: Some(8), ..usual() }, "batch"),
        (Options { runtime: "crate::runtime".to_owned(), ..usual() }, "runtime"),
    ] {
        for language in Language::ALL {
            let printed = [
                sources(&source, &options, *language).map(|_| ()),
                package(&source, &options, *language).map(|_| ()),
            ];
            for printed in printed {
                let expected = format!(
                    "the option `{name}` applies to Rust and not to `{}`; leave it out",
                    language.name()
                );
                match printed {
                    Ok(()) => assert_eq!(*language, Language::Rust, "{name}"),
                    Err(errors) => assert_eq!(errors.to_string(), expected),
                }
            }
        }
    }
    let both = Options { generic: true, batch: Some(8), parallel: true, ..usual() };
    let errors = package(&source, &both, Language::C).unwrap_err().to_string();
    assert_eq!(errors.lines().count(), 3, "{errors}");
}

#[test]
fn plain_names_and_texts_are_those_of_a_robot() {
    let chosen = Chosen { names: PLAIN.map(str::to_owned), ..Chosen::default() };
    let source = Source { name: "plain.toml".to_owned(), text: chosen.file() };
    if let Err(errors) = robot_build::programs(&source, &Options::default()) {
        panic!("{errors}");
    }
}

/// Parts of names: words of languages, names that printers use themselves, and special characters.
const NAMES: &[&str] = &[
    "a",
    "m",
    "l",
    "class",
    "function",
    "end",
    "lambda",
    "model",
    "parameters",
    "static",
    "fn",
    "double",
    "blockIdx",
    "threadIdx",
    "step",
    "i",
    "n",
    "stride",
    "s",
    "c",
    "t1",
    "k1",
    "angles",
    "struct",
    "let",
    "var",
    "nominal",
    "create_model",
    "sin_cos",
    "robot",
    "test",
    "main",
    "q1",
    "array",
    "f32",
    "not_a_number",
    "_",
    "__",
    "-",
    ".",
    "0",
    "2",
    "kernel",
    "_kernel",
    "printf",
    "EOF",
    "INLINE",
    "half",
    "global",
    "gravity",
    "energies",
    "id",
    "é",
    " ",
    "\"",
    "'",
    ";",
    "}",
];

/// Parts of texts: the ends of comments and strings, and sequences that hide or continue them.
const TEXTS: &[&str] = &[
    "*/",
    "/*",
    "//",
    "#",
    "%",
    "%{",
    "%}",
    "\"\"\"",
    "'''",
    "\"",
    "'",
    "`",
    "${x}",
    "\\",
    "??/",
    "\n",
    "\r",
    "\n\n",
    "\u{85}",
    "\u{2028}",
    "\u{2029}",
    "\u{b}",
    "\u{c}",
    "\t",
    "\u{202e}",
    "]]",
    "--",
    "-->",
    "<!--",
    "</script>",
    "```",
    "{",
    "}",
    "{0}",
    ";",
    "\n}\n",
    "@",
    "*",
    "/",
    "\\u0041",
    "\\n",
    "\u{200b}",
    "\n#include <x>\n",
    "...",
    "\n```\n",
    "$(x)",
    "\0",
    "\u{1a}",
];

fn random(random: &mut Random, parts: &[&str], most: usize) -> String {
    let index = |random: &mut Random, below: usize| {
        (random.uniform(0.0, below as f64) as usize).min(below - 1)
    };
    let count = index(random, most) + 1;
    (0..count).map(|_| parts[index(random, parts.len())]).collect()
}

#[test]
fn no_text_of_a_robot_file_becomes_code() {
    let (mut hostile, mut texts) = (0, 0);
    for seed in 1..=120 {
        let mut source = Random::new(seed);
        let chosen = Chosen {
            names: std::array::from_fn(|_| random(&mut source, NAMES, 2)),
            texts: std::array::from_fn(|_| random(&mut source, TEXTS, 6)),
        };
        let chosen = chosen.accepted();
        let names = chosen.names.iter().zip(PLAIN);
        hostile += names.filter(|(name, plain)| name != plain).count();
        texts += chosen.texts.iter().filter(|text| !text.is_empty()).count();
        match std::panic::catch_unwind(|| in_every_language(&chosen)) {
            Ok(is_accepted) => assert!(is_accepted, "seed {seed}: {chosen:?}"),
            Err(_) => panic!("seed {seed}: {chosen:?}"),
        }
    }
    // Counted over the eight names and three texts of each robot.
    assert!(hostile > 600 && texts > 150, "{hostile} names and {texts} texts were tried");
}

#[test]
fn languages_are_found_by_their_names_alone() {
    for language in Language::ALL {
        assert_eq!(Language::named(language.name()), Some(*language));
        for other in [language.title().to_owned(), language.name().to_uppercase(), String::new()] {
            assert_eq!(Language::named(&other), None, "{other}");
        }
        let same = |other: &&Language| other.title() == language.title();
        assert_eq!(Language::ALL.iter().filter(same).count(), 1);
    }
}

/// The compiler refuses such characters in comments.
#[test]
fn the_name_of_the_file_does_not_change_the_direction_of_text() {
    let source = Source { name: "\u{202e}\u{2066}\nlmot.toml".to_owned(), text: ARM.to_owned() };
    for language in Language::ALL {
        // Some have only this scalar.
        let single = matches!(language, Language::Arduino | Language::Wgsl);
        let scalar = if single { Scalar::F32 } else { Scalar::F64 };
        let options = Options { scalar, ..Options::default() };
        for file in package(&source, &options, *language).unwrap() {
            let found = String::from_utf8_lossy(file.contents.bytes());
            assert!(!found.contains(['\u{202e}', '\u{2066}']), "{}", file.path);
        }
    }
}
