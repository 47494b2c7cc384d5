//! Groups of warnings and notes of the same kind, each of which is shown as one.

use std::collections::{HashMap, HashSet};

use super::{Diagnostic, Severity, Source};

/// Up to this many diagnostics of the same kind are shown separately.
const FEW: usize = 2;
/// The maximum number of names or lines that are listed; further ones are only counted.
const MAX_LISTED: usize = 16;

/// Diagnostics that differ only in names, numbers and places.
#[derive(Clone, Debug, PartialEq)]
pub struct Group<'d> {
    /// The first diagnostic of the group.
    pub first: &'d Diagnostic,
    /// The other diagnostics, in order.
    pub others: Vec<&'d Diagnostic>,
}

impl Group<'_> {
    /// The number of diagnostics in the group.
    #[must_use]
    pub fn count(&self) -> usize {
        1 + self.others.len()
    }

    /// The message of the first diagnostic, with the size of the group if there are several.
    #[must_use]
    pub fn message(&self) -> String {
        match self.count() {
            1 => self.first.message.clone(),
            count => format!("{} ({count} times like this)", self.first.message),
        }
    }

    /// The whole group on one line.
    #[must_use]
    pub fn line(&self, source: &Source) -> String {
        match self.others(source) {
            Some(others) => format!("{}; {others}", self.message()),
            None => self.message(),
        }
    }

    /// The names and lines of the other diagnostics, such as ``also `current`; on lines 12, 15``.
    #[must_use]
    pub fn others(&self, source: &Source) -> Option<String> {
        if self.others.is_empty() {
            return None;
        }
        let mut known: HashSet<&str> = names(&self.first.message).into_iter().collect();
        let further = self.others.iter().flat_map(|other| names(&other.message));
        let also: Vec<String> =
            further.filter(|name| known.insert(name)).map(|name| format!("`{name}`")).collect();
        let starts = source.text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        let starts: Vec<usize> = starts.map(|(place, _)| place).collect();
        let line = |byte: usize| starts.partition_point(|newline| *newline < byte) + 1;
        let others = self.others.iter();
        let mut lines: Vec<usize> =
            others.filter_map(|other| Some(line(other.primary.as_ref()?.span.start))).collect();
        lines.sort_unstable();
        lines.dedup();
        let plural = if lines.len() == 1 { "" } else { "s" };
        let lines: Vec<String> = lines.iter().map(ToString::to_string).collect();
        let parts = [(also, "also ".to_owned()), (lines, format!("on line{plural} "))];
        let parts = parts.into_iter().filter(|(list, _)| !list.is_empty());
        let parts: Vec<String> =
            parts.map(|(list, before)| format!("{before}{}", shortened(&list))).collect();
        (!parts.is_empty()).then(|| parts.join("; "))
    }
}

fn shortened(list: &[String]) -> String {
    let shown = list.iter().take(MAX_LISTED).cloned().collect::<Vec<_>>().join(", ");
    match list.len().saturating_sub(MAX_LISTED) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// Groups the diagnostics, in the order of their first members. Errors are never grouped, because each must be
/// corrected, nor are kinds with only a few diagnostics.
pub(super) fn groups(list: &[Diagnostic]) -> Vec<Group<'_>> {
    let mut places: HashMap<Kind<'_>, usize> = HashMap::new();
    let mut found: Vec<Vec<(usize, &Diagnostic)>> = vec![];
    for member in list.iter().enumerate() {
        let new = found.len();
        let place = match member.1.severity {
            Severity::Error => new,
            _ => *places.entry(kind(member.1)).or_insert(new),
        };
        match found.get_mut(place) {
            Some(members) => members.push(member),
            None => found.push(vec![member]),
        }
    }
    let mut groups: Vec<(usize, Group<'_>)> = vec![];
    for members in found {
        match members.as_slice() {
            [(place, first), others @ ..] if members.len() > FEW => {
                let others = others.iter().map(|(_, other)| *other).collect();
                groups.push((*place, Group { first, others }));
            }
            few => groups
                .extend(few.iter().map(|(place, first)| (*place, Group { first, others: vec![] }))),
        }
    }
    groups.sort_by_key(|(place, _)| *place);
    groups.into_iter().map(|(_, group)| group).collect()
}

/// The properties that diagnostics of the same kind share: the code, and the texts without names and numbers.
type Kind<'d> = (&'d str, String, String, String, String);

fn kind(one: &Diagnostic) -> Kind<'_> {
    let label = one.primary.as_ref().map_or("", |label| label.text.as_str());
    let [why, help] =
        [&one.why, &one.help].map(|text| pattern(text.as_deref().unwrap_or_default()));
    (one.code, pattern(&one.message), pattern(label), why, help)
}

/// The text with all names in backquotes, and all numbers, replaced by the same placeholder.
fn pattern(text: &str) -> String {
    let mut shown = String::new();
    for (index, part) in text.split('`').enumerate() {
        if index % 2 == 1 {
            shown.push('`');
            continue;
        }
        let mut in_number = false;
        for character in part.chars() {
            let digit =
                character.is_ascii_digit() || in_number && matches!(character, '.' | 'e' | '-');
            if !digit {
                shown.push(character);
            } else if !in_number {
                shown.push('0');
            }
            in_number = digit;
        }
    }
    shown
}

/// The names in backquotes.
fn names(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Diagnostics, Style};
    use super::*;

    fn warning(code: &'static str, message: &str, place: usize) -> Diagnostic {
        Diagnostic::warning(code, message).at(&(place..place + 1), "not read")
    }

    fn all(list: Vec<Diagnostic>) -> Diagnostics {
        let source = Source { name: "arm".to_owned(), text: "a\nb\nc\nd\ne\nf\n".to_owned() };
        Diagnostics::new(source, list)
    }

    #[test]
    fn many_of_a_kind_are_one() {
        let list = vec![
            warning("R0603", "`current` of `joint1` is 1.5e-3", 0),
            warning("R0602", "`x` is unused", 2),
            warning("R0603", "`current` of `joint2` is 2", 4),
            warning("R0603", "`gear` of `joint2` is 30", 6),
        ];
        let shown = all(list).render(Style::Plain);
        assert!(
            shown.starts_with(
                "warning[R0603]: `current` of `joint1` is 1.5e-3 (3 times like this)\n"
            ),
            "{shown}"
        );
        assert!(shown.contains("= note: also `joint2`, `gear`; on lines 3, 4\n"), "{shown}");
        assert_eq!(shown.matches("warning[").count(), 2, "{shown}");
        assert!(shown.ends_with("arm: 4 warnings\n"), "{shown}");
    }

    #[test]
    fn errors_and_few_of_a_kind_are_alone() {
        let few = vec![warning("R0603", "`a`", 0), warning("R0603", "`b`", 2)];
        assert_eq!(all(few).render(Style::Plain).matches("warning[").count(), 2);
        let error = |place: usize| Diagnostic::error("R0101", "`a`").at(&(place..place + 1), "");
        let errors = all(vec![error(0), error(2), error(4)]).render(Style::Plain);
        assert_eq!(errors.matches("error[").count(), 3, "{errors}");
        let other = vec![
            warning("R0603", "`a` is not read", 0),
            warning("R0603", "`a` is twice", 2),
            warning("R0604", "`a` is not read", 4),
        ];
        assert_eq!(all(other).render(Style::Plain).matches("warning[").count(), 3);
    }

    #[test]
    fn long_lists_are_cut() {
        let list: Vec<String> = (1..=20).map(|line| line.to_string()).collect();
        assert!(shortened(&list).ends_with("15, 16 and 4 more"));
    }
}
