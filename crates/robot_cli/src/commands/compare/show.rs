//! Printing of a comparison as text and JSON.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use robot_check::errata::{Comparison, Difference, Evidence, MistakeKind};
use serde_json::{Value, json};

use crate::screen::{ADDED, CHANGED, REMOVED, TITLE, styled_lines};

/// A paragraph for each difference, a summary, and a note on coefficients that are close.
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
    shown + &summary(comparison) + "\n" + &hint(comparison) + &of_symbols(comparison)
}

/// The relative difference of coefficients below which they may be the same number with other digits.
const CLOSE: f64 = 1e-6;

/// A line about coefficients that may differ only because printed decimals are rounded; empty if there are none.
fn hint(comparison: &Comparison) -> String {
    let is_close = |difference: &&Difference| {
        let [mistake] = difference.mistakes.as_slice() else { return false };
        let number = |text: &Option<String>| {
            let text = text.as_ref()?;
            let (above, below) = text.split_once('/').unwrap_or((text, "1"));
            Some(above.parse::<f64>().ok()? / below.parse::<f64>().ok()?)
        };
        let pair = number(&mistake.printed).zip(number(&mistake.derived));
        mistake.kind == MistakeKind::Coefficient
            && pair
                .is_some_and(|(printed, derived)| (printed - derived).abs() < CLOSE * derived.abs())
    };
    let count = comparison.differences.iter().filter(is_close).count();
    let differ = if count == 1 { "differs" } else { "differ" };
    match count {
        0 => String::new(),
        count => format!(
            "note: {count} of these {differ} by less than a millionth, as rounded decimals do; \
             equations printed with `--digits 17` have more digits\n"
        ),
    }
}

/// A line about symbols that the robot does not have; empty if there are none.
fn of_symbols(comparison: &Comparison) -> String {
    let evidence = comparison.differences.iter().flat_map(|difference| &difference.evidence);
    let unknown = evidence.filter_map(|one| match one {
        Evidence::UnknownSymbol(name) => Some(name.as_str()),
        _ => None,
    });
    let unknown: BTreeSet<&str> = unknown.collect();
    if unknown.is_empty() {
        return String::new();
    }
    let names: Vec<&str> = unknown.into_iter().collect();
    format!(
        "note: not symbols of the robot: {}; joint positions, velocities and accelerations are q1, qd1, qdd1, in LaTeX q_1, \\dot q_1, \\ddot q_1, and \
         parameters have the names of the robot file\n",
        names.join(", ")
    )
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
pub(super) fn name(difference: &Difference) -> String {
    match difference.number.as_str() {
        "" => difference.quantity.clone(),
        number => format!("({number}) {}", difference.quantity),
    }
}

fn mistakes(difference: &Difference) -> String {
    let mistakes: Vec<String> = difference.mistakes.iter().map(ToString::to_string).collect();
    mistakes.join(", ")
}

/// Prints a summary such as `85 equations (10 only name other quantities), 839 terms: 34 terms differ (23 dot, 8 index, …)`.
pub(super) fn summary(comparison: &Comparison) -> String {
    let Comparison { equations, names, terms, wrench, rounded, unread, differences } = comparison;
    let mut kinds: BTreeMap<MistakeKind, usize> = BTreeMap::new();
    for mistake in differences.iter().flat_map(|difference| &difference.mistakes) {
        *kinds.entry(mistake.kind).or_default() += 1;
    }
    let kinds: Vec<String> = kinds.iter().map(|(kind, count)| kind.counted(*count)).collect();
    let counted =
        |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let mut shown = counted(*equations, "equation");
    if *names > 0 {
        let verb = if *names == 1 { "names" } else { "name" };
        let _ = write!(shown, " ({names} only {verb} other quantities)");
    }
    let _ = write!(shown, ", {}", counted(*terms, "term"));
    if !wrench {
        shown.push_str(", no wrench");
    }
    shown += &match differences.len() {
        0 => ": no differences".to_owned(),
        1 => format!(": 1 term differs ({})", kinds.join(", ")),
        count => format!(": {count} terms differ ({})", kinds.join(", ")),
    };
    let agreed = match rounded {
        0 => "",
        1 => "; 1 coefficient agrees only to the digits printed",
        count => &format!("; {count} coefficients agree only to the digits printed"),
    };
    shown + agreed + &not_compared(unread)
}

/// The end of a summary about equations on these lines, which are not compared.
fn not_compared(lines: &[usize]) -> String {
    let shown: Vec<String> = lines.iter().take(5).map(ToString::to_string).collect();
    let more = if lines.len() > shown.len() { ", …" } else { "" };
    let (equations, is, on) = match lines.len() {
        0 => return String::new(),
        1 => ("1 equation".to_owned(), "is", "line"),
        count => (format!("{count} equations"), "are", "lines"),
    };
    let shown = shown.join(", ");
    format!("; {equations} outside of displays {is} not compared ({on} {shown}{more})")
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
                "mistakes": mistakes,
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
        "rounded": comparison.rounded,
        "unread": comparison.unread,
        "differences": differences,
    });
    format!("{shown:#}\n")
}

#[cfg(test)]
mod tests {
    use robot_check::errata::Mistake;

    use super::*;

    #[test]
    fn coefficients_that_may_be_rounded_are_counted() {
        let one = |printed: &str, derived: &str| {
            let [printed, derived] = [printed, derived].map(|text| Some(text.to_owned()));
            let mistakes = vec![Mistake { kind: MistakeKind::Coefficient, printed, derived }];
            Difference { mistakes, ..difference("", MistakeKind::Coefficient) }
        };
        let differences = vec![
            one("0.01194004998", "0.01194004998333631"),
            one("-0.005970024992", "-0.005970024991668155"),
            one("2.080734686", "20618/9909"),
            one("1.00001", "1"),
            one("1", "-1"),
            difference("", MistakeKind::Index),
        ];
        let comparison = |differences| Comparison {
            equations: 1,
            names: 0,
            terms: 5,
            wrench: false,
            rounded: 0,
            unread: vec![],
            differences,
        };
        let shown = text(&comparison(differences));
        assert!(shown.contains("\nnote: 3 of these differ by less than a millionth"), "{shown}");
        let shown = text(&comparison(vec![difference("", MistakeKind::Index)]));
        assert!(!shown.contains("note"), "{shown}");
    }

    fn difference(number: &str, kind: MistakeKind) -> Difference {
        let some = |text: &str| Some(text.to_owned());
        Difference {
            number: number.to_owned(),
            quantity: "Q1".to_owned(),
            line: 7,
            printed: some("m1"),
            derived: some("m2"),
            nearest: None,
            mistakes: vec![Mistake { kind, printed: some("m1"), derived: some("m2") }],
            evidence: vec![],
        }
    }

    fn comparison(differences: Vec<Difference>) -> Comparison {
        Comparison {
            equations: 1,
            names: 0,
            terms: 1,
            wrench: true,
            rounded: 0,
            unread: vec![],
            differences,
        }
    }

    #[test]
    fn the_summary_counts_in_words() {
        let none = comparison(vec![]);
        assert_eq!(summary(&none), "1 equation, 1 term: no differences");
        let some = Comparison { equations: 2, names: 1, terms: 0, wrench: false, ..none };
        assert_eq!(
            summary(&some),
            "2 equations (1 only names other quantities), 0 terms, no wrench: no differences"
        );
        let one_rounded = Comparison { rounded: 1, ..some.clone() };
        assert!(
            summary(&one_rounded)
                .ends_with(": no differences; 1 coefficient agrees only to the digits printed")
        );
        let one = difference("", MistakeKind::Index);
        let two_rounded = Comparison { rounded: 2, ..comparison(vec![one.clone()]) };
        assert!(
            summary(&two_rounded)
                .ends_with("(1 index); 2 coefficients agree only to the digits printed")
        );
        let shown = summary(&comparison(vec![one.clone()]));
        assert_eq!(shown, "1 equation, 1 term: 1 term differs (1 index)");
        let other = difference("", MistakeKind::Sign);
        let shown = summary(&comparison(vec![one.clone(), other, one]));
        assert_eq!(shown, "1 equation, 1 term: 3 terms differ (1 sign, 2 indices)");
    }

    #[test]
    fn differences_are_paragraphs_and_objects() {
        let extra = Difference {
            derived: None,
            nearest: Some("m3".to_owned()),
            ..difference("3|4", MistakeKind::ExtraTerm)
        };
        let missing = Difference { printed: None, ..difference("", MistakeKind::MissingTerm) };
        let all = comparison(vec![extra, missing]);
        let shown = text(&all);
        let lines: Vec<&str> = shown.lines().collect();
        assert!(lines[0].starts_with("(3|4) Q1, line 7: extra term"), "{shown}");
        assert_eq!(lines[1..3], ["    printed  m1", "    nearest  m3"]);
        assert!(lines[3].starts_with("Q1, line 7: missing term"), "{shown}");
        assert_eq!(lines[4..], ["    derived  m2", &summary(&all)]);
        let shown: Value = serde_json::from_str(&json(&all)).unwrap();
        assert_eq!(shown["differences"][0]["nearest"], "m3");
        assert_eq!(shown["differences"][1]["printed"], Value::Null);
        assert_eq!(shown["differences"][1]["mistakes"][0]["kind"], "missing term");
        assert_eq!((&shown["equations"], &shown["wrench"]), (&json!(1), &json!(true)));
        assert_eq!(shown["rounded"], 0);
    }

    #[test]
    fn titles_are_bold_and_terms_have_the_colors_of_changes() {
        let plain =
            "Q1, line 7\n    printed  a\n    derived  b\n    nearest  c\n    evidence\n1 term\n";
        let shown = colored(plain);
        let starts =
            ["\x1b[1mQ1", "\x1b[31m    p", "\x1b[32m    d", "\x1b[33m    n", "    e", "\x1b[1m1"];
        for (line, start) in shown.lines().zip(starts) {
            assert!(line.starts_with(start), "{line:?}");
        }
    }

    #[test]
    fn colors_change_no_text() {
        let text = "(31) F_l5.x\n  printed -x\n  derived x\n  why\n";
        let colored = colored(text);
        assert_ne!(colored, text);
        let mut plain = String::new();
        let mut rest = colored.as_str();
        while let Some((before, after)) = rest.split_once('\u{1b}') {
            plain.push_str(before);
            rest = after.split_once('m').map_or("", |(_, after)| after);
        }
        assert_eq!(plain + rest, text);
    }
}
