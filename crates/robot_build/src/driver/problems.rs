//! Errors as separate problems, for tools that show the first line of a message: Cargo, rustc, editors.

use robot_model::diagnostic::{Diagnostic, Diagnostics, Severity, Style, render};

use crate::error::{Error, Errors};

/// The largest number of problems that are shown; further ones are only counted.
const MAX_SHOWN: usize = 40;

/// An error.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The place, if there is one, and the error, on one line: ``lift.toml:52:9: error R0303: `m5` is not a parameter
    /// of this robot``.
    pub headline: String,
    /// Further lines, possibly none: an excerpt of the file, the reason, the remedy.
    pub details: String,
}

impl Problem {
    fn of_line(line: String) -> Problem {
        Problem { headline: line, details: String::new() }
    }
}

impl Errors {
    /// Returns all errors, without warnings, as separate problems; never empty.
    #[must_use]
    pub fn problems(&self) -> Vec<Problem> {
        let mut problems: Vec<Problem> = self.as_slice().iter().flat_map(of_error).collect();
        if let Some(more @ 1..) = problems.len().checked_sub(MAX_SHOWN) {
            problems.truncate(MAX_SHOWN);
            problems.push(Problem::of_line(format!("{more} more errors are not shown")));
        }
        problems
    }
}

fn of_error(error: &Error) -> Vec<Problem> {
    if let Error::Robot(found) = error {
        let errors = found.iter().filter(|one| one.severity == Severity::Error);
        return errors.map(|one| of_diagnostic(found, one)).collect();
    }
    let text = error.to_string();
    let (headline, details) = text.split_once('\n').unwrap_or((&text, ""));
    vec![Problem { headline: headline.to_owned(), details: details.to_owned() }]
}

fn of_diagnostic(found: &Diagnostics, one: &Diagnostic) -> Problem {
    let source = found.source();
    let position = one.primary.as_ref().map(|label| source.position(label.span.start));
    let place = position.map(|(line, column)| format!(":{line}:{column}")).unwrap_or_default();
    let Diagnostic { code, message, .. } = one;
    let text = render(source, one, Style::Plain);
    // The headline repeats the title of the excerpt.
    let title = format!("error[{code}]: {message}\n");
    let details = text.strip_prefix(&title).unwrap_or(&text).to_owned();
    Problem { headline: format!("{}{place}: error {code}: {message}", source.name), details }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Source;

    fn problems(text: &str) -> Vec<Problem> {
        let source = Source { name: "arms/lift.toml".to_owned(), text: text.to_owned() };
        crate::read(&source).unwrap_err().problems()
    }

    #[test]
    fn the_first_line_says_what_and_where() {
        let file = "format = 1\n[robot]\nname = \"lift\"\n[[link]]\nname = \"1\"\n\
            joint = { type = \"prismatic\", axis = \"z\" }\nmass = \"m5\"\ncenter_of_mass = [0, 0, 0]\n\
            inertia = { xx = 1, yy = 1, zz = 1 }\nmas = 2\n";
        let found = problems(file);
        let headlines: Vec<&str> = found.iter().map(|one| one.headline.as_str()).collect();
        assert_eq!(headlines.len(), 2, "{headlines:?}");
        assert!(
            headlines[0].starts_with("arms/lift.toml:7:9: error R0303: `m5` is no"),
            "{headlines:?}"
        );
        assert!(headlines[1].starts_with("arms/lift.toml:10:1: error R0101: "), "{headlines:?}");
        assert!(found[0].details.trim_start().starts_with("--> arms/lift.toml:7:9\n"), "{found:?}");
        assert!(found[0].details.contains("mass = \"m5\""), "{found:?}");
        assert!(!found[0].details.contains("error"), "{found:?}");
    }

    #[test]
    fn many_problems_are_counted() {
        let found = problems(&format!("format = 1\n{}", "[[x]]\n".repeat(3)));
        assert!(!found.is_empty() && found.iter().all(|one| !one.headline.contains('\n')));
        let error = || Error::NotUnderCargo { variable: "OUT_DIR", remedy: "a\nb" };
        let mut errors = vec![];
        (0..50).for_each(|_| Errors::extend(&mut errors, Errors::from(error())));
        let found = Errors::check(errors, ()).unwrap_err().problems();
        assert_eq!(found.len(), 41);
        assert_eq!(
            (found[0].details.as_str(), found[40].headline.as_str()),
            ("b", "10 more errors are not shown")
        );
    }
}
