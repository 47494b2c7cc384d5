//! Diagnostics as the protocol has them.

use robot_check::doctor::Examination;
use robot_model::diagnostic::{Diagnostic, Severity, code};
use serde_json::{Value, json};

use super::lines::Lines;
use crate::NAME;
use crate::options::in_flags;

/// The largest number of diagnostics of a document; further ones are only counted, because editors become slow.
const MAX_SHOWN: usize = 1000;

/// The tag of text that is not needed, which editors fade.
const UNNECESSARY: u8 = 1;

/// All diagnostics of a document: errors, warnings, then notes. If `relates`, the editor shows related places;
/// otherwise, the messages list them.
pub(super) fn findings(
    examination: &Examination,
    lines: &Lines<'_>,
    uri: &str,
    relates: bool,
) -> Vec<Value> {
    let Examination { found, choices } = examination;
    let all = found.iter().chain(choices.iter());
    let mut shown: Vec<Value> =
        all.take(MAX_SHOWN).map(|one| finding(one, lines, uri, relates)).collect();
    if let Some(more @ 1..) = (found.len() + choices.len()).checked_sub(MAX_SHOWN) {
        let message = format!("{more} more errors, warnings and notes are not shown");
        let (range, severity) = (lines.range(&(0..0)), number(Severity::Note));
        shown.push(json!({
            "range": range, "severity": severity, "source": NAME, "message": message,
        }));
    }
    shown
}

fn finding(one: &Diagnostic, lines: &Lines<'_>, uri: &str, relates: bool) -> Value {
    let span = one.primary.as_ref().map_or(0..0, |label| label.span.clone());
    let mut finding = json!({
        "range": lines.range(&span),
        "severity": number(one.severity),
        "code": one.code,
        "source": NAME,
        "message": message(one, lines, relates),
    });
    if one.code == code::UNUSED {
        finding["tags"] = json!([UNNECESSARY]);
    }
    if relates && !one.secondary.is_empty() {
        let related = one.secondary.iter().map(|label| {
            let text = if label.text.is_empty() { &one.message } else { &label.text };
            let location = json!({ "uri": uri, "range": lines.range(&label.span) });
            json!({ "location": location, "message": in_flags(text) })
        });
        finding["relatedInformation"] = related.collect();
    }
    finding
}

const fn number(severity: Severity) -> u8 {
    match severity {
        Severity::Error => 1,
        Severity::Warning => 2,
        Severity::Note => 3,
    }
}

/// The message with the remark about the place, the reason and the remedy, a line for each.
fn message(one: &Diagnostic, lines: &Lines<'_>, relates: bool) -> String {
    let mut parts = vec![one.message.clone()];
    let label = one.primary.as_ref().map_or("", |label| label.text.as_str());
    if !label.is_empty() {
        parts.push(label.to_owned());
    }
    let related = one.secondary.iter().filter(|label| !relates && !label.text.is_empty());
    parts.extend(related.map(|label| {
        let line = lines.position(label.span.start)["line"].as_u64().unwrap_or_default() + 1;
        format!("line {line}: {}", label.text)
    }));
    parts.extend(one.why.as_ref().map(|why| format!("note: {why}")));
    parts.extend(one.help.as_ref().map(|help| format!("help: {help}")));
    in_flags(&parts.join("\n"))
}
