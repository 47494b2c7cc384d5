//! Groups of diagnostics of the same kind, each of which is shown as one.

use std::collections::{HashMap, HashSet};

use super::{Diagnostic, Label, Severity, Source};

/// Up to this many diagnostics of the same kind are shown separately.
const FEW: usize = 2;
/// The maximum number of names, lines or columns that are listed; further ones are only counted.
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

    /// The names and lines of the other diagnostics, such as ``also `current`; on lines 12, 15``;
    /// if all stand on one line, its columns.
    #[must_use]
    pub fn others(&self, source: &Source) -> Option<String> {
        if self.others.is_empty() {
            return None;
        }
        let mut known: HashSet<&str> = subjects(&self.first.message).collect();
        let further = self.others.iter().flat_map(|other| subjects(&other.message));
        let also: Vec<String> =
            further.filter(|name| known.insert(name)).map(|name| format!("`{name}`")).collect();
        let others = self.others.iter().filter_map(|other| other.primary.as_ref());
        let (on, lines) = lines(source, others);
        let parts = [(also, "also ".to_owned()), (lines, on)];
        let parts = parts.into_iter().filter(|(list, _)| !list.is_empty());
        let parts: Vec<String> =
            parts.map(|(list, before)| format!("{before}{}", shortened(&list))).collect();
        (!parts.is_empty()).then(|| parts.join("; "))
    }

    /// The secondary places of the first diagnostic that are shown with their lines, and a list of the others, such as
    /// `and here on lines 12, 15, 20`: if several places have the same remark, only their lines are listed.
    pub(super) fn secondary(&self, source: &Source) -> (Vec<&Label>, Vec<String>) {
        let all = &self.first.secondary;
        let (mut shown, mut listed): (Vec<&Label>, Vec<String>) = (vec![], vec![]);
        let mut known: HashSet<&str> = HashSet::new();
        for label in all {
            let alike: Vec<&Label> = all.iter().filter(|other| other.text == label.text).collect();
            if label.text.is_empty() || alike.len() <= FEW {
                shown.push(label);
            } else if known.insert(&label.text) {
                let (on, lines) = lines(source, alike.into_iter());
                listed.push(format!("{} {on}{}", label.text, shortened(&lines)));
            }
        }
        (shown, listed)
    }
}

/// The lines at which labels begin, in order and each once, and the words before them; if there are several labels and
/// all begin on one line, their columns.
fn lines<'l>(source: &Source, labels: impl Iterator<Item = &'l Label>) -> (String, Vec<String>) {
    let labels: Vec<&Label> = labels.collect();
    let ends = source.text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
    let ends: Vec<usize> = ends.map(|(place, _)| place).collect();
    let line = |label: &Label| ends.partition_point(|end| *end < label.span.start) + 1;
    let mut lines: Vec<usize> = labels.iter().map(|label| line(label)).collect();
    lines.sort_unstable();
    lines.dedup();
    if let (&[line], [_, _, ..]) = (lines.as_slice(), labels.as_slice()) {
        let start = line.checked_sub(2).and_then(|end| ends.get(end)).map_or(0, |end| end + 1);
        let columns = columns(source.text.get(start..).unwrap_or_default(), start, &labels);
        return (format!("on line {line} at column{} ", plural(&columns)), columns);
    }
    (format!("on line{} ", plural(&lines)), lines.iter().map(ToString::to_string).collect())
}

fn plural<T>(list: &[T]) -> &'static str {
    if list.len() == 1 { "" } else { "s" }
}

/// The columns at which labels in a line begin, in order and each once; `start` is the first byte of the line.
fn columns(line: &str, start: usize, labels: &[&Label]) -> Vec<String> {
    let mut places: Vec<usize> = labels.iter().map(|label| label.span.start - start).collect();
    places.sort_unstable();
    places.dedup();
    // One pass over the line, because there can be as many labels as characters.
    let mut characters = line.char_indices().peekable();
    let mut column = 1;
    let places = places.into_iter().map(|place| {
        while characters.next_if(|(byte, _)| *byte < place).is_some() {
            column += 1;
        }
        column
    });
    places.map(|column| column.to_string()).collect()
}

fn shortened(list: &[String]) -> String {
    let shown = list.iter().take(MAX_LISTED).cloned().collect::<Vec<_>>().join(", ");
    match list.len().saturating_sub(MAX_LISTED) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// Groups the diagnostics, in the order of their first members. Kinds with only a few diagnostics are not grouped, nor
/// are errors with different remedies, because each error must be corrected.
pub(super) fn groups(list: &[Diagnostic]) -> Vec<Group<'_>> {
    let mut places: HashMap<Kind<'_>, usize> = HashMap::new();
    let mut found: Vec<Vec<(usize, &Diagnostic)>> = vec![];
    for member in list.iter().enumerate() {
        let new = found.len();
        let place = *places.entry(kind(member.1)).or_insert(new);
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

/// The properties that diagnostics of the same kind share: severity, code, and the texts without names and numbers.
type Kind<'d> = (Severity, &'d str, [String; 4]);

fn kind(one: &Diagnostic) -> Kind<'_> {
    let label = one.primary.as_ref().map_or("", |label| label.text.as_str());
    let [why, help] = [&one.why, &one.help].map(|text| text.as_deref().unwrap_or_default());
    let message = pattern(&one.message, |_| None);
    let texts = match one.severity {
        Severity::Error => {
            // A name in a remedy is part of the correction, unless the list of names has it.
            let listed = names(&one.message);
            let literal = |name: &str| (!listed.contains(&name)).then(|| name.to_owned());
            [label, why, help].map(|text| pattern(text, literal))
        }
        _ => [label, why, help].map(|text| pattern(text, |_| None)),
    };
    let [label, why, help] = texts;
    (one.severity, one.code, [message, label, why, help])
}

/// The text with numbers, and names in backquotes that `literal` does not keep, replaced by the same placeholder.
fn pattern(text: &str, literal: impl Fn(&str) -> Option<String>) -> String {
    let mut shown = String::new();
    for (index, part) in text.split('`').enumerate() {
        if index % 2 == 1 {
            shown.push('`');
            shown.push_str(&literal(part).unwrap_or_default());
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

/// The names in backquotes that a message is about, without those that only say where, such as `<link>` in
/// ``twice in `<link>` ``.
fn subjects(message: &str) -> impl Iterator<Item = &str> {
    let parts = message.split('`').zip(message.split('`').skip(1)).step_by(2);
    parts.filter(|(before, _)| !before.ends_with(" in ")).map(|(_, name)| name)
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
    fn few_of_a_kind_are_alone() {
        let few = vec![warning("R0603", "`a`", 0), warning("R0603", "`b`", 2)];
        assert_eq!(all(few).render(Style::Plain).matches("warning[").count(), 2);
        let other = vec![
            warning("R0603", "`a` is not read", 0),
            warning("R0603", "`a` is twice", 2),
            warning("R0604", "`a` is not read", 4),
        ];
        assert_eq!(all(other).render(Style::Plain).matches("warning[").count(), 3);
    }

    #[test]
    fn errors_with_the_same_remedy_are_one() {
        let error = |name: &str, help: &str, place: usize| {
            let message = format!("`{name}` is unknown");
            Diagnostic::error("R0101", message).at(&(place..place + 1), "here").help(help)
        };
        let list = ["a", "b", "a"].into_iter().enumerate();
        let list = list.map(|(line, name)| error(name, &format!("define `{name}`"), 2 * line));
        let shown = all(list.collect()).render(Style::Plain);
        assert!(shown.starts_with("error[R0101]: `a` is unknown (3 times like this)\n"), "{shown}");
        assert!(shown.contains("= note: also `b`; on lines 2, 3\n"), "{shown}");
        assert_eq!(shown.matches("define").count(), 1, "{shown}");
        assert!(shown.ends_with("arm: 3 errors\n"), "{shown}");
        // Each of these must be corrected in its own way.
        let list = ["a", "b", "c"].into_iter().enumerate();
        let list = list.map(|(line, name)| error(name, &format!("write `{name}_1`"), 2 * line));
        let shown = all(list.collect()).render(Style::Plain);
        assert_eq!(shown.matches("error[").count(), 3, "{shown}");
        // An error is not hidden behind a warning.
        let graded = |place: usize| error("a", "", place).graded(Severity::Warning);
        let shown = all(vec![graded(0), graded(2), error("a", "", 4)]).render(Style::Plain);
        assert_eq!(shown.matches("error[").count(), 1, "{shown}");
    }

    #[test]
    fn places_on_one_line_have_columns() {
        let error = |place: usize| {
            let one = Diagnostic::error("R0101", "`x` is unknown").at(&(place..place + 1), "here");
            one.help("define it")
        };
        let source = Source { name: "arm".to_owned(), text: "[[a, b, c]]\n".to_owned() };
        let shown = Diagnostics::new(source, [2, 5, 8].map(error).to_vec()).render(Style::Plain);
        assert!(shown.contains("= note: on line 1 at columns 6, 9\n"), "{shown}");
    }

    #[test]
    fn many_places_with_the_same_remark_are_listed() {
        let of = |places: &[usize]| {
            let first = Diagnostic::warning("R0607", "`a`, `b`").at(&(0..1), "here");
            let one = places.iter().fold(first, |one, place| {
                let place = 2 * place;
                one.and_at(&(place..place + 1), "and here")
            });
            all(vec![one]).render(Style::Plain)
        };
        assert_eq!(of(&[1, 2]).matches(" and here\n").count(), 2);
        let shown = of(&[1, 2, 4]);
        assert!(shown.contains("= note: and here on lines 2, 3, 5\n"), "{shown}");
        assert_eq!(shown.matches("here").count(), 2, "{shown}");
    }

    #[test]
    fn long_lists_are_cut() {
        let list: Vec<String> = (1..=20).map(|line| line.to_string()).collect();
        assert!(shortened(&list).ends_with("15, 16 and 4 more"));
    }
}
