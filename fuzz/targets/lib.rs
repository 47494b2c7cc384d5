//! Functions that the targets share: how far an accepted robot is processed, and what is checked there.

use robot_codegen::backend::rust::{self, RustOptions};
use robot_model::description::{Described, Options, import, read_toml};
use robot_model::diagnostic::Diagnostics;
use robot_check::doctor::{Examination, examine};
use robot_document::{SymbolTable, Trigonometry, latex};
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_dynamics::newton_euler::newton_euler;
use robot_model::functions::Effects;
use robot_symbolic::{Graph, print};

/// The maximum number of moving links of a robot that is derived; larger robots are only read.
const MAX_LINKS: usize = 3;
/// The maximum number of terms of an equation that is printed.
const MAX_TERMS: u64 = 20_000;

/// Whether an input is one of the few that are processed further: one in `every`, always the same ones.
pub fn chosen(data: &[u8], every: u64) -> bool {
    // FNV-1a
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3);
    (data.iter().fold(0xcbf2_9ce4_8422_2325, step) >> 20).is_multiple_of(every)
}

/// Renders some of the messages, which must be possible for any text that they refer to.
pub fn show(found: &Diagnostics) {
    assert!(!found.is_empty());
    if chosen(found.source().text.as_bytes(), 32) {
        assert!(!found.to_string().is_empty());
    }
}

/// Examines every accepted robot. Some robots are derived by the paper's iterations and printed as text and LaTeX,
/// and few of them as Rust, which is parsed again.
pub fn follow(text: &str, described: &Described) {
    let Examination { found, choices } = examine(described);
    for told in [&found, &choices].into_iter().filter(|told| !told.is_empty()) {
        show(told);
    }
    let robot = &described.robot;
    if robot.links.len() > MAX_LINKS || !chosen(text.as_bytes(), 16) {
        return;
    }
    let graph = Graph::new();
    let mechanism = Mechanism::new(robot, &graph, &MechanismOptions::EXACT);
    let effects = Effects { wrench: true, friction: true };
    let equations = newton_euler(&mechanism, effects).joint_torques;
    assert_eq!(equations.len(), robot.degrees_of_freedom());
    let table = SymbolTable::spelled(Trigonometry::Named);
    for equation in equations {
        let Ok(text) = print::to_text_limited(equation, MAX_TERMS) else { continue };
        assert!(!text.is_empty());
        if let Ok(formula) = table.expression(equation) {
            harmless_latex(&latex::formula(&formula));
        }
    }
    if chosen(text.as_bytes(), 512) {
        generate(described);
    }
}

/// Generates Rust, which the backend parses again before it returns it.
fn generate(described: &Described) {
    let options = robot_build::Options::default();
    let robot = described.robot.clone();
    let Ok(programs) = robot_build::programs_of(robot, "fuzz", &options) else { return };
    let code = rust::generate(&programs.module, &RustOptions::default());
    assert!(code.is_ok_and(|code| !code.to_text().is_empty()));
}

/// Checks that an accepted description can be imported, that the import is a robot file with the same coordinates,
/// and that importing it again changes nothing.
pub fn imports(name: &str, text: &str, described: &Described) {
    if !chosen(text.as_bytes(), 4) {
        return;
    }
    let first = import(name, text, &Options::default()).expect("what is read can be imported");
    let again = read_toml("again.toml", &first.toml).expect("an import can be read");
    assert_eq!(again.robot.coordinates.len(), described.robot.coordinates.len());
    let second = import("again.toml", &first.toml, &Options::default()).expect("and imported");
    assert_eq!(first.toml, second.toml);
}

/// LaTeX that can only print: no command that reads, writes or defines, balanced braces, no comment
/// and no way out of math mode.
pub fn harmless_latex(latex: &str) {
    const HARM: [&str; 12] = [
        "input",
        "include",
        "write",
        "openin",
        "openout",
        "read",
        "catcode",
        "def",
        "let",
        "csname",
        "newcommand",
        "begin",
    ];
    const SIGNS: [char; 7] = ['#', '$', '%', '&', '_', '{', '}'];
    let mut depth = 0_i32;
    let mut rest = latex;
    while let Some(letter) = rest.chars().next() {
        rest = &rest[letter.len_utf8()..];
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            '%' | '$' | '#' | '~' | '&' => panic!("{letter} in {latex}"),
            '\\' => {
                let end = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
                assert!(!HARM.contains(&&rest[..end]), "{latex}");
                // An escaped sign is no more than itself.
                rest = &rest[end.max(usize::from(rest.starts_with(SIGNS)))..];
            }
            _ => assert!(letter.is_ascii() && !letter.is_ascii_control(), "{latex:?}"),
        }
        assert!(depth >= 0, "{latex}");
    }
    assert_eq!(depth, 0, "{latex}");
}
