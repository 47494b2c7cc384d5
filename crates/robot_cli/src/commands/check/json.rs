//! Diagnostics as JSON. The document is described in `docs/diagnostics`.

use robot_check::doctor::Examination;
use robot_model::diagnostic::{Diagnostic, Diagnostics, Label, Severity, Source, Span};
use serde_json::{Value, json};

use super::Report;

/// The version of the document. It is incremented if a member changes its meaning or is removed; new members can be
/// added at any time.
const VERSION: u64 = 1;

/// Makes one document for all files.
pub(super) fn document(reports: &[Report]) -> Value {
    let diagnostics: Vec<Value> = reports.iter().flat_map(of_report).collect();
    let count = |severity| reports.iter().map(|report| report.count(severity)).sum::<usize>();
    json!({
        "version": VERSION,
        "errors": count(Severity::Error),
        "warnings": count(Severity::Warning),
        "notes": count(Severity::Note),
        "diagnostics": diagnostics,
    })
}

fn of_report(report: &Report) -> Vec<Value> {
    match report {
        Report::Examined(Examination { found, choices }) => {
            of_source(found).chain(of_source(choices)).collect()
        }
        Report::Unread { file, reason } => vec![json!({
            "code": null, "severity": "error", "file": file,
            "line": 1, "column": 1, "end_line": 1, "end_column": 1,
            "message": reason, "label": null, "reason": null, "remedy": null, "related": [],
        })],
    }
}

fn of_source(found: &Diagnostics) -> impl Iterator<Item = Value> {
    found.iter().map(|one| of_diagnostic(found.source(), one))
}

fn of_diagnostic(source: &Source, diagnostic: &Diagnostic) -> Value {
    let severity = match diagnostic.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    };
    let span = diagnostic.primary.as_ref().map_or(0..0, |label| label.span.clone());
    let [line, column, end_line, end_column] = corners(source, &span);
    let label = diagnostic.primary.as_ref().map(|label| &label.text);
    let related: Vec<Value> =
        diagnostic.secondary.iter().map(|label| related(source, label)).collect();
    json!({
        "code": diagnostic.code, "severity": severity, "file": source.name,
        "line": line, "column": column, "end_line": end_line, "end_column": end_column,
        "message": diagnostic.message, "label": label.filter(|label| !label.is_empty()),
        "reason": diagnostic.why, "remedy": diagnostic.help, "related": related,
    })
}

fn related(source: &Source, label: &Label) -> Value {
    let [line, column, end_line, end_column] = corners(source, &label.span);
    json!({
        "line": line, "column": column, "end_line": end_line, "end_column": end_column,
        "message": label.text,
    })
}

/// The line and column of the first character and of the character after the last.
fn corners(source: &Source, span: &Span) -> [usize; 4] {
    let (line, column) = source.position(span.start);
    let (end_line, end_column) = source.position(span.end.max(span.start));
    [line, column, end_line, end_column]
}
