//! Printing of a comparison as text, JSON and Markdown.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use robot_check::errata::{Comparison, Difference, MistakeKind};
use serde_json::{Value, json};

use crate::screen::{ADDED, CHANGED, REMOVED, TITLE, styled_lines};

/// Prints a paragraph for each difference, and a summary.
pub(super) fn text(comparison: &Comparison) -> String {
    let mut shown = String::new();
    for difference in &comparison.differences {
        // Writing to a string does not fail.
        let _ = writeln!(
            shown,
            "{}, line {}: {}",
            name(difference),
            difference.line,
            mistakes(difference)
        );
        let terms = [
            ("printed", &difference.printed),
            ("derived", &difference.derived),
            ("nearest", &difference.nearest),
        ];
        for (title, term) in terms {
            if let Some(term) = term {
                let _ = writeln!(shown, "    {title}  {term}");
            }
        }
        for evidence in &difference.evidence {
            let _ = writeln!(shown, "    {evidence}");
        }
    }
    shown + &summary(comparison) + "\n"
}

/// Colors the text: published terms as removed ones, derived terms as added ones.
pub(super) fn colored(text: &str) -> String {
    styled_lines(text, |line| match line.split_whitespace().next() {
        Some("printed") => Some(REMOVED),
        Some("derived") => Some(ADDED),
        Some("nearest") => Some(CHANGED),
        _ => (!line.starts_with(' ')).then_some(TITLE),
    })
}

/// The name of an equation: `(31) F_l5.x`.
fn name(difference: &Difference) -> String {
    match difference.number.as_str() {
        "" => difference.quantity.clone(),
        number => format!("({number}) {}", difference.quantity),
    }
}

fn mistakes(difference: &Difference) -> String {
    let mistakes: Vec<String> = difference.mistakes.iter().map(ToString::to_string).collect();
    mistakes.join(", ")
}

/// Prints a summary such as `85 equations (10 only name a quantity), 839 terms: 34 terms differ (23 dot, 8 index, …)`.
fn summary(comparison: &Comparison) -> String {
    let Comparison { equations, names, terms, wrench, differences } = comparison;
    let mut kinds: BTreeMap<MistakeKind, usize> = BTreeMap::new();
    for mistake in differences.iter().flat_map(|difference| &difference.mistakes) {
        *kinds.entry(mistake.kind).or_default() += 1;
    }
    let kinds: Vec<String> = kinds.iter().map(|(kind, count)| kind.counted(*count)).collect();
    let counted =
        |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let mut shown = counted(*equations, "equation");
    if *names > 0 {
        let _ = write!(shown, " ({names} only name a quantity)");
    }
    let _ = write!(shown, ", {}", counted(*terms, "term"));
    if !wrench {
        shown.push_str(", no wrench");
    }
    match differences.len() {
        0 => shown + ": no differences",
        1 => shown + &format!(": 1 term differs ({})", kinds.join(", ")),
        count => shown + &format!(": {count} terms differ ({})", kinds.join(", ")),
    }
}

/// Prints the comparison as `{"equations": …, "terms": …, "differences": […]}`.
pub(super) fn json(comparison: &Comparison) -> String {
    let differences: Vec<Value> = comparison
        .differences
        .iter()
        .map(|difference| {
            let mistakes: Vec<Value> = difference
                .mistakes
                .iter()
                .map(|mistake| {
                    let (printed, derived) = (&mistake.printed, &mistake.derived);
                    json!({ "kind": mistake.kind.name(), "printed": printed, "derived": derived })
                })
                .collect();
            let evidence: Vec<String> =
                difference.evidence.iter().map(ToString::to_string).collect();
            json!({
                "number": difference.number,
                "quantity": difference.quantity,
                "line": difference.line,
                "slips": mistakes,
                "printed": difference.printed,
                "derived": difference.derived,
                "nearest": difference.nearest,
                "evidence": evidence,
            })
        })
        .collect();
    let shown = json!({
        "equations": comparison.equations,
        "names": comparison.names,
        "terms": comparison.terms,
        "wrench": comparison.wrench,
        "differences": differences,
    });
    format!("{shown:#}\n")
}

/// Prints a table and a summary.
pub(super) fn markdown(comparison: &Comparison) -> String {
    let mut shown = String::new();
    if !comparison.differences.is_empty() {
        shown.push_str("| equation | mistake | printed term | derived term | evidence |\n");
        shown.push_str("|---|---|---|---|---|\n");
    }
    let term = |term: &Option<String>| match term {
        Some(term) => format!("`{term}`"),
        None => "—".to_owned(),
    };
    for difference in &comparison.differences {
        let evidence: Vec<String> = difference.evidence.iter().map(ToString::to_string).collect();
        let derived = match &difference.nearest {
            Some(nearest) => format!("— (nearest: `{nearest}`)"),
            None => term(&difference.derived),
        };
        // Writing to a string does not fail.
        let _ = writeln!(
            shown,
            "| {} | {} | {} | {derived} | {} |",
            name(difference).replace('|', "\\|"),
            mistakes(difference),
            term(&difference.printed),
            evidence.join("; ").replace('|', "\\|"),
        );
    }
    shown + "\n" + &summary(comparison) + "\n"
}
