//! The paper's printed equations against the derivation: the differences are those that
//! `docs/trttr1.md` lists, no more and no fewer.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

mod common;

use robot_dynamics::errata::{Comparison, Difference, compare, read_printed};

const PRINTED: &str = include_str!("../docs/trttr1.printed");
const DOCUMENT: &str = include_str!("../docs/trttr1.md");

fn comparison() -> Comparison {
    let printed = read_printed(PRINTED).unwrap();
    compare(&common::robot("trttr1"), &printed).unwrap()
}

/// A row of the document's table: equation, quantity, printed term, derived term, evidence.
fn row(difference: &Difference) -> String {
    let term = |term: &Option<String>| match term {
        Some(term) => format!("`{term}`"),
        None => "—".to_owned(),
    };
    let evidence: Vec<String> = difference.evidence.iter().map(ToString::to_string).collect();
    format!(
        "| ({}) | `{}` | {} | {} | {} |",
        difference.number,
        difference.quantity,
        term(&difference.printed),
        term(&difference.derived),
        evidence.join("; ")
    )
}

#[test]
fn the_document_lists_every_difference_and_nothing_else() {
    let found: Vec<String> = comparison().differences.iter().map(row).collect();
    let listed: Vec<&str> = DOCUMENT.lines().filter(|line| line.starts_with("| (")).collect();
    let missing: Vec<_> = found.iter().filter(|row| !listed.contains(&row.as_str())).collect();
    let stale: Vec<_> = listed.iter().filter(|row| !found.iter().any(|f| f == *row)).collect();
    assert!(missing.is_empty(), "not in docs/trttr1.md:\n{missing:#?}");
    assert!(stale.is_empty(), "in docs/trttr1.md, but not found:\n{stale:#?}");
    assert_eq!(found.len(), listed.len(), "a row stands twice in docs/trttr1.md");
    let count = format!("{} terms differ", found.len());
    assert!(DOCUMENT.contains(&count), "docs/trttr1.md does not say that {count}");
}

#[test]
fn every_printed_equation_is_compared() {
    let comparison = comparison();
    // (9)-(24), (31)-(61): five vectors of a_c, F, M_c, F_l and M_l, five Q twice.
    assert_eq!(comparison.equations, 75 + 10);
    assert!(comparison.terms > 800, "{}", comparison.terms);
}

#[test]
fn every_difference_has_evidence_of_its_own() {
    for difference in comparison().differences {
        assert!(!difference.evidence.is_empty(), "no evidence for {difference:?}");
    }
}

#[test]
fn a_changed_sign_is_found() {
    let spoilt = PRINTED.replacen("+ M5*qdd3 + cos(q5)*Fz6", "- M5*qdd3 + cos(q5)*Fz6", 1);
    assert_ne!(spoilt, PRINTED);
    let printed = read_printed(&spoilt).unwrap();
    let changed = compare(&common::robot("trttr1"), &printed).unwrap();
    assert_eq!(changed.differences.len(), comparison().differences.len() + 1);
}
