//! Malicious files, processed up to equations and code: each must give a result or a message within limited time and
//! memory, and no text from it may take effect outside its place. docs/security.md describes what is promised.

use std::fmt::Write as _;
use std::time::Instant;

use robot_build::{FunctionKind, Functions, Options, Source, generate};
use robot_document::base_parameters::base;
use robot_document::{EquationOptions, Form, Trigonometry, equations};
use robot_dynamics::economical::search::{Measure, search};
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::description::{MAX_BYTES, read_toml};

fn source(text: String) -> Source {
    Source { name: "robot.toml".to_owned(), text }
}

/// Runs a function on a stack as small as that of a thread, and prints the time that it took.
fn timed<T: Send>(what: &str, run: impl FnOnce() -> T + Send) -> T {
    let start = Instant::now();
    let result = std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(1 << 20);
        thread.spawn_scoped(scope, run).unwrap().join().unwrap()
    });
    println!("{what}: {:.2} s", start.elapsed().as_secs_f64());
    result
}

/// A chain of joints with skew axes, in which links have all possible properties.
fn chain(joints: usize) -> String {
    let mut text = "format = 1\n[robot]\nname = \"chain\"\n".to_owned();
    for number in 1..=joints {
        write!(
            text,
            "[[link]]\nname = \"{number}\"\njoint = {{ type = \"revolute\", axis = [1, {}, 2] }}\n\
             origin = {{ xyz = [0.1, 0.02, 0.3], rpy = [0.{number}, 0.7, -0.4] }}\nmass = 1.5\n\
             center_of_mass = [0.1, 0.2, 0.03]\n\
             inertia = {{ xx = 0.02, yy = 0.03, zz = 0.04, xy = 0.001, xz = 0.002, yz = 0.003 }}\n\
             friction = {{ viscous = 1, coulomb_torque = 2, smoothing = 0.1 }}\n\
             drive = {{ rotor_inertia = 1e-5, gear_ratio = 100, gyroscopic = true }}\n",
            number % 5
        )
        .unwrap();
    }
    text + "[tip]\n"
}

#[test]
fn sixty_four_joints_end_in_code() {
    let file = source(chain(64));
    let generated = timed("code of 64 joints", || generate(&file, &Options::default()));
    let code = generated.unwrap().code;
    println!("{} bytes of code", code.len());
    assert!(code.contains("pub const DOF: usize = 64;"));
    let found = read_toml("robot.toml", &chain(65)).unwrap_err().to_string();
    assert!(found.contains("at most 64"), "{found}");
}

/// Each function by itself gives either code or the message that it is too long.
#[test]
fn every_function_of_sixty_four_joints_ends() {
    let file = source(chain(64));
    let robot = robot_build::read(&file).unwrap().robot;
    for kind in FunctionKind::of_robot(&robot) {
        let options = Options { functions: Functions::Chosen(vec![kind]), ..Options::default() };
        match timed(kind.name(), || generate(&file, &options)) {
            Ok(generated) => println!("    {} bytes of code", generated.code.len()),
            Err(errors) => assert!(errors.to_string().contains("expressions"), "{errors}"),
        }
    }
}

/// If no plan is pinned, commands search for one; for a long chain, the search ends early.
#[test]
fn a_search_over_sixty_four_joints_ends_early() {
    let robot = robot_build::read(&source(chain(64))).unwrap().robot;
    let options = MechanismOptions::ROUNDED;
    let found = timed("search over 64 joints", || search(&robot, &options, Measure::Operations));
    let found = found.unwrap();
    println!("{} forms, {} operations", found.tried, found.operations);
    assert!(found.cut_short && found.plan.fits(64));
    let short = robot_build::read(&source(chain(3))).unwrap().robot;
    assert!(!search(&short, &options, Measure::Operations).unwrap().cut_short);
}

/// All functions of 64 joints together would have millions of expressions; they are refused before these are created.
#[test]
fn all_functions_of_sixty_four_joints_are_refused() {
    let file = source(chain(64));
    for functions in [
        Functions::All,
        Functions::Chosen(vec![FunctionKind::ForwardDynamicsDerivatives]),
        Functions::Chosen(vec![FunctionKind::InverseDynamicsDerivatives]),
    ] {
        let options = Options { functions: functions.clone(), ..Options::default() };
        let found = timed(&format!("{functions:?} of 64 joints"), || generate(&file, &options));
        let message = found.unwrap_err().to_string();
        assert!(message.contains("more than 500000 expressions"), "{message}");
        assert!(message.contains("choose fewer functions"), "{message}");
    }
}

/// 1 MiB of expressions: a mass that is a product of as many factors as a file can contain.
#[test]
fn a_mebibyte_of_expressions_ends_in_code_or_a_message() {
    let head = "format = 1\n[robot]\nname = \"wide\"\n[parameters]\na = 1\nb = 2\n[[link]]\n\
                name = \"1\"\njoint = { type = \"revolute\", axis = \"z\" }\n\
                center_of_mass = [0.1, 0, 0]\ninertia = { xx = 1, yy = 1, zz = 1 }\nmass = \"a";
    let wide = |products: usize| {
        let sum: String = (1..=products).map(|k| format!(" + a*sin(b + {k})^2")).collect();
        source(format!("{head}{sum}\"\n"))
    };
    for products in [9_000, 20_000] {
        let file = wide(products);
        assert!(file.text.len() <= MAX_BYTES);
        let what = format!("a sum of {products} products");
        match timed(&what, || generate(&file, &Options::default())) {
            Ok(generated) => println!("{} bytes of code", generated.code.len()),
            Err(errors) => assert!(errors.to_string().contains("is longer than"), "{errors}"),
        }
    }
    let found = read_toml("robot.toml", &" ".repeat(MAX_BYTES + 1)).unwrap_err().to_string();
    assert!(found.contains("bytes"), "{found}");
}

#[test]
fn nesting_of_a_hundred_thousand_ends_in_a_message() {
    let deep = 100_000;
    let one = |mass: &str| chain(1).replace("mass = 1.5", &format!("mass = {mass}"));
    let texts = [
        one(&format!("\"{}1{}\"", "(".repeat(deep), ")".repeat(deep))),
        one(&format!("\"{}1\"", "-".repeat(deep))),
        one(&format!("\"{}1{}\"", "sin(".repeat(deep), ")".repeat(deep))),
        one(&format!("\"2{}\"", "^2".repeat(deep))),
        one(&format!("{}1{}", "[".repeat(deep), "]".repeat(deep))),
        one(&format!("{}1{}", "{a=".repeat(deep), "}".repeat(deep))),
        format!("{}[a{}]\n", chain(1), ".a".repeat(deep)),
    ];
    for text in texts {
        let found = timed("nested deep", || read_toml("robot.toml", &text).unwrap_err());
        assert!(found.to_string().len() < 100_000);
    }
}

/// Texts that would have an effect if they were not only read.
const HOSTILE: [&str; 9] = [
    "*/ } fn harm() {} /*",
    "```rust panic!() ```",
    "</script><script>alert(1)</script>",
    "[x](javascript:alert(1)) <img src=x onerror=alert(1)>",
    "#![feature(harm)] #[doc = include_str!(\\\"/etc/passwd\\\")]",
    "\\\\input{/etc/passwd} \\\\write18{rm} $x$ %",
    "${jndi:x} {{x}} `id`",
    "-->]]><!--",
    "\\\" ; drop",
];

fn one_link(name: &str, doc: &str, latex: &str) -> String {
    format!(
        "format = 1\n[robot]\nname = \"arm\"\ndescription = \"{doc}\"\n[parameters]\n\
         m = {{ value = 2, latex = \"{latex}\", doc = \"{doc}\" }}\n[[link]]\nname = \"{name}\"\n\
         joint = {{ type = \"revolute\", axis = \"z\" }}\nmass = \"m\"\n\
         center_of_mass = [0.1, 0, 0]\ninertia = {{ xx = 1, yy = 1, zz = 1 }}\n"
    )
}

/// The code without its comments.
fn bare(code: &str) -> String {
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn texts_of_a_file_stay_in_comments() {
    let code = |doc: &str| {
        let file = source(one_link("1", doc, "m"));
        generate(&file, &Options::default()).unwrap_or_else(|found| panic!("{found}")).code
    };
    let plain = code("a mass");
    assert!(plain.contains("a mass"));
    // Both texts are escaped: the description of the robot and the documentation of the parameter.
    assert_eq!(code("see `x`").matches(r"see \`x\`").count(), 2);
    for hostile in HOSTILE {
        let code = code(hostile);
        // Only comments differ, and nothing in them ends a comment or begins an example.
        assert_eq!(bare(&code), bare(&plain), "{hostile}");
        let unescaped = code.replace(r"\`", "").replace(r"\<", "").replace(r"\]", "");
        let marks = ["```", "<script", "<img", "](javascript"];
        assert!(!marks.iter().any(|mark| unescaped.contains(mark)), "{hostile}");
    }
}

#[test]
fn hostile_names_and_latex_are_refused() {
    for hostile in HOSTILE {
        let found = read_toml("robot.toml", &one_link(hostile, "", "m")).unwrap_err().to_string();
        assert!(found.contains("R0201") || found.contains("R0206"), "{found}");
        let found = read_toml("robot.toml", &one_link("1", "", hostile)).unwrap_err().to_string();
        assert!(found.contains("R0205") || found.contains("R0206"), "{found}");
    }
    let commands =
        ["input{x}", "write18{x}", "def", "catcode", "csname", "href{x}{y}", "htmlData{x}"];
    for command in commands {
        let latex = format!("m_{{\\\\{command}}}");
        let found = read_toml("robot.toml", &one_link("1", "", &latex)).unwrap_err().to_string();
        assert!(found.contains("R0205"), "{found}");
    }
}

/// Building from a robot file starts no program and uses no network: the crates that the builder and the macro use do
/// not even contain the names of such functions.
#[test]
fn the_crates_behind_a_build_start_no_process() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/crates");
    let mut folders: Vec<_> =
        ["symbolic", "model", "dynamics", "codegen", "build", "macros", "runtime"]
            .map(|name| std::path::PathBuf::from(format!("{root}/robot_{name}/src")))
            .to_vec();
    let mut files = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap();
            for word in ["process::Command", "Command::new", "std::net", "TcpStream"] {
                assert!(!text.contains(word), "{word} in {}", path.display());
            }
            // Instructions for vector registers, used if the processor has them.
            let instructions = [
                "registers/x86.rs",
                "registers/neon.rs",
                "registers/register.rs",
                "runtime/real.rs",
                "runtime/processor.rs",
            ];
            if !instructions.iter().any(|name| path.ends_with(name)) {
                assert!(!text.contains("unsafe {"), "unsafe in {}", path.display());
            }
            files += 1;
        }
    }
    assert!(files > 100, "{files}");
}

#[test]
fn equations_that_nobody_can_read_end_in_a_message() {
    let robot = robot_build::read(&source(chain(64))).unwrap().robot;
    let options =
        EquationOptions { trigonometry: Trigonometry::Short, ..EquationOptions::default() };
    let found = timed("equations of 64 joints", || equations(&robot, &options));
    let message = found.err().unwrap().to_string();
    assert!(message.contains("more than") && message.contains("recursive"), "{message}");
    assert!(!message.contains("grouped"), "a form that is refused: {message}");
    // The other forms exist for such robots.
    for form in [Form::Recursive, Form::Compact] {
        let options = EquationOptions { form, ..options.clone() };
        let found = timed(form.name(), || equations(&robot, &options));
        assert!(found.is_ok(), "{form:?}: {found:?}");
    }
    let options = EquationOptions { form: Form::Grouped, ..options };
    let found = timed("grouped", || equations(&robot, &options));
    let message = found.err().unwrap().to_string();
    assert!(message.contains("64 coordinates") && message.contains("recursive"), "{message}");
    let options = EquationOptions { form: Form::Regrouped, ..options };
    let found = timed("regrouped", || equations(&robot, &options));
    let message = found.err().unwrap().to_string();
    assert!(message.contains("more than 300000 expressions"), "{message}");
    let found = timed("base parameters", || base(&robot, None));
    let message = found.err().unwrap().to_string();
    assert!(message.contains("more than 300000 expressions"), "{message}");
    assert!(message.contains("base parameters") && !message.contains("--form"), "{message}");
}
