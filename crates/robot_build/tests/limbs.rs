//! Limbs that are alike, side by side.
#![allow(clippy::unwrap_used, reason = "a test that fails panics")]

use robot_build::{FunctionKind, Functions, Limbs, Options, Source, generate};

fn source() -> Source {
    let text = include_str!("../../../tests/fixtures/limbs/quadruped.toml");
    Source { name: "quadruped.toml".to_owned(), text: text.to_owned() }
}

#[test]
#[ignore = "writes code to look at"]
fn text() {
    let folder = std::env::var("LIMBS_OUT").unwrap();
    let source = match std::env::var("LIMBS_ROBOT") {
        Ok(path) => Source { text: std::fs::read_to_string(&path).unwrap(), name: path },
        Err(_) => source(),
    };
    for (name, limbs) in [("flat", Limbs::Apart), ("limbs", Limbs::SideBySide)] {
        for fused in [false, true] {
            let functions = [
                "inverse_dynamics", "bias", "gravity", "mass_matrix", "forward_dynamics",
                "inverse_dynamics_derivatives", "forward_dynamics_derivatives",
            ];
            let kinds = FunctionKind::ALL.iter().copied();
            let kinds = kinds.filter(|kind| functions.contains(&kind.name())).collect();
            let functions = Functions::Chosen(kinds);
            let options = Options { functions, limbs, fused, search: true, ..Options::default() };
            let found = generate(&source, &options).unwrap();
            std::fs::write(format!("{folder}/{name}_{fused}.rs"), found.code).unwrap();
        }
    }
}
