//! Pieces of text that several commands show.

use std::fmt::Write as _;

use robot_build::{Options, Robot, Snapping, unsolvable};
use robot_dynamics::mechanism::Snap;
use robot_model::diagnostic::{Diagnostics, Style, quote};
use robot_model::snap;
use robot_symbolic::nearest_word;

use crate::Terminal;
use crate::failure::Failure;
use crate::options::in_flags;
use crate::robot::PRINT_SNAP;

/// The message ``there is no function `invers`; did you mean `inverse`? There are …``.
pub(crate) fn unknown(what: &str, name: &str, known: &[&str]) -> String {
    format!("there is no {what} `{}`.{}", quote(name), meant(name, known))
}

/// The known name that resembles a wrong one, and all known names, behind a space.
pub(crate) fn meant(name: &str, known: &[&str]) -> String {
    let near = nearest_word(name, known.iter().copied())
        .map(|near| format!(" Did you mean `{near}`?"))
        .unwrap_or_default();
    let known = match known {
        [] => "None are available.".to_owned(),
        known => format!("Available: {}.", known.join(", ")),
    };
    format!("{near} {known}")
}

/// A count with its noun, which has an s unless the count is 1.
pub(crate) fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// Prints the warnings of a robot file.
pub(crate) fn warnings(warnings: &Diagnostics, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
    if !warnings.is_empty() {
        let style = if terminal.colors { Style::Terminal } else { Style::Plain };
        writeln!(terminal.errors, "{}", in_flags(warnings.render(style).trim_end()))?;
    }
    Ok(())
}

/// Prints which functions the robot does not have because joint torques do not determine all of its accelerations.
pub(crate) fn lacking(
    robot: &Robot,
    options: &Options,
    terminal: &mut Terminal<'_>,
) -> Result<(), Failure> {
    if let Some(lacking) = unsolvable(robot, options) {
        writeln!(terminal.errors, "note: {}: {lacking}", robot.name)?;
    }
    Ok(())
}

/// The largest width of a line of a printed sum, in columns, without its indentation.
pub(crate) const COLUMNS: usize = 100;

/// Breaks `Q1 = …` into lines, and indents all but the first by four spaces.
pub(crate) fn sum(whole: &str) -> String {
    let mut lines = wrapped(whole, COLUMNS).join("\n    ");
    lines.push('\n');
    lines
}

/// The cost of a line break within the argument of a function: any number of other parentheses costs less.
const ARGUMENT: usize = 1_000_000;

/// The places before signs at which a sum can be broken, with their costs: the number of parentheses around them, and
/// more within arguments of functions.
fn breaks(text: &str) -> Vec<(usize, usize)> {
    let mut breaks = vec![];
    // The costs of the parentheses that are open.
    let mut open: Vec<usize> = vec![];
    for (place, character) in text.char_indices() {
        let before = &text[..place];
        let cost = open.iter().sum::<usize>();
        match character {
            '(' if before.ends_with(|before: char| before.is_ascii_alphanumeric()) => {
                open.push(ARGUMENT);
            }
            '(' => open.push(1),
            ')' => drop(open.pop()),
            '+' | '-' if before.ends_with(' ') && !before.ends_with("= ") => {
                breaks.push((place, cost));
            }
            _ => {}
        }
    }
    breaks
}

/// Breaks a sum before signs, into lines of at most `columns` columns if that is possible. Of the breaks within reach,
/// those within the fewest parentheses are preferred, and of these the last; a line is broken within the argument of a
/// function only if there is no other.
fn wrapped(text: &str, columns: usize) -> Vec<&str> {
    let breaks = breaks(text);
    let (mut lines, mut start) = (vec![], 0);
    while text.len() - start > columns {
        let further = || breaks.iter().filter(|(place, _)| *place > start);
        // The cheapest break within reach, and the last one of these, or else the next one.
        let reach = further().filter(|(place, _)| *place - start <= columns);
        let chosen = reach.min_by_key(|(place, cost)| (*cost, std::cmp::Reverse(*place)));
        let Some((place, _)) = chosen.or_else(|| further().next()) else { break };
        lines.push(text[start..*place].trim_end());
        start = *place;
    }
    lines.push(&text[start..]);
    lines
}

/// Prints `title: a, b, c`, broken after commas, with further lines indented.
pub(crate) fn list(title: &str, names: &[&str]) -> String {
    let mut shown = format!("{title}:");
    let mut column = shown.chars().count();
    for (index, name) in names.iter().enumerate() {
        let comma = if index + 1 < names.len() { "," } else { "" };
        let width = name.chars().count() + comma.len();
        if column + 1 + width > COLUMNS {
            shown.push_str("\n   ");
            column = 3;
        }
        // Writing to a string does not fail.
        let _ = write!(shown, " {name}{comma}");
        column += 1 + width;
    }
    shown.push('\n');
    shown
}

/// Prints rows in columns; the first row is the header, and a column of numbers alone is right-aligned.
pub(crate) fn table(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let is_number = |column: usize| {
        let mut cells = rows.iter().skip(1).filter_map(|row| row.get(column));
        cells.all(|cell| cell.is_empty() || cell.parse::<f64>().is_ok())
    };
    let right: Vec<bool> = (0..columns).map(is_number).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (column, cell) in row.iter().enumerate() {
            let width = widths[column];
            // Writing to a string does not fail.
            let _ = match right[column] {
                true => write!(line, "{cell:>width$}  "),
                false => write!(line, "{cell:<width$}  "),
            };
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// Describes which angles are taken as multiples of π/2, and the effect of larger tolerances.
pub(crate) fn snapping(snapping: &Snapping) -> String {
    let Snapping { taken, larger } = snapping;
    let mut text = match taken.tolerance > 0.0 {
        false => "angles have the values in the file (--snap 0)".to_owned(),
        true => format!(
            "angles within {:e} rad of a multiple of π/2 are taken as that multiple (--snap); {} changed",
            taken.tolerance,
            match taken.snapped.len() {
                0 => "none is".to_owned(),
                1 => "1 is".to_owned(),
                count => format!("{count} are"),
            }
        ),
    };
    // Writing to a string does not fail.
    if let Some(Snap { name, angle, change }) = taken.largest() {
        let change = change.abs();
        let _ = write!(text, "\nthe largest change is {change:.1e} rad, from {angle} at {name}");
    }
    for tried in larger {
        let change = tried.largest().map_or(0.0, |snap| snap.change.abs());
        let saved = match taken.operations.checked_sub(tried.operations) {
            Some(0) => "the same number of operations".to_owned(),
            Some(saved) => format!("{saved} fewer operations"),
            None => format!("{} more operations", tried.operations - taken.operations),
        };
        let _ = write!(
            text,
            "\n--snap {:e} would change {} by up to {change:.1e} rad; inverse dynamics would need {saved}",
            tried.tolerance,
            tried.snapped.len()
        );
    }
    text
}

/// The largest number of links that the note about angles snapped for print names.
const NAMED: usize = 3;

/// Prints which constant angles are printed as multiples of π/2 although code uses their exact values; empty if there
/// are none.
pub(crate) fn snapped_for_print(robot: &Robot, snaps: &[Snap]) -> String {
    let changed = |snap: &&Snap| snap.change.abs() > snap::DEFAULT;
    let changed: Vec<&Snap> = snaps.iter().filter(changed).collect();
    let mut names: Vec<&str> = vec![];
    for snap in &changed {
        let link = robot.links.iter().find(|link| link.name == snap.name);
        let name = link.map_or(snap.name.as_str(), |link| link.joint.name.as_str());
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let more = match names.len().checked_sub(NAMED) {
        Some(more @ 1..) => format!(" and {more} more"),
        _ => String::new(),
    };
    names.truncate(NAMED);
    let (angles, are) = match changed.len() {
        0 => return String::new(),
        1 => ("1 constant angle".to_owned(), "is printed as that multiple"),
        count => (format!("{count} constant angles"), "are printed as multiples"),
    };
    format!(
        "note: {}: {angles} within {PRINT_SNAP:e} rad of a multiple of π/2 {are} ({}{more}); --snap 0 prints them \
         as they are\n",
        robot.name,
        names.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_are_near_are_suggested() {
        let shown = unknown("quantity", "F_1", &["Q", "F_l", "M_l"]);
        assert_eq!(
            shown,
            "there is no quantity `F_1`. Did you mean `F_l`? Available: Q, F_l, M_l."
        );
        assert!(!unknown("quantity", "torques", &["Q", "F_l"]).contains("mean"));
        assert_eq!(unknown("tip", "a", &[]), "there is no tip `a`. None are available.");
    }

    #[test]
    fn angles_that_are_printed_as_multiples_are_named() {
        let robot = robot_testing::robot("scara");
        let snap = |name: &str, change| Snap { name: name.to_owned(), angle: 1.57, change };
        let told = |snaps: &[Snap]| snapped_for_print(&robot, snaps);
        assert_eq!(told(&[]), "");
        // Angles that code changes, too, are not named.
        assert_eq!(
            told(&[snap("a", snap::DEFAULT), snap("b", -snap::DEFAULT), snap("c", 0.0)]),
            ""
        );
        let names: Vec<&str> = robot.links.iter().map(|link| link.name.as_str()).collect();
        let joint = &robot.links[0].joint.name;
        let shown = told(&[snap(names[0], -1e-6), snap("other", 0.0)]);
        let expected =
            "1 constant angle within 1e-5 rad of a multiple of π/2 is printed as that multiple";
        assert!(
            shown.ends_with(&format!("{expected} ({joint}); --snap 0 prints them as they are\n")),
            "{shown}"
        );
        // A link with two angles is named once.
        let shown = told(&[snap("a", 1e-6), snap("a", -1e-6), snap("b", 1e-6), snap("c", 1e-6)]);
        assert!(
            shown.contains(": 4 constant angles") && shown.contains("multiples (a, b, c);"),
            "{shown}"
        );
        let five = ["a", "b", "c", "d", "e"].map(|name| snap(name, 1e-6));
        assert!(told(&five[..4]).contains("(a, b, c and 1 more)"), "{}", told(&five[..4]));
        assert!(told(&five).contains("(a, b, c and 2 more)"), "{}", told(&five));
    }

    #[test]
    fn larger_tolerances_tell_what_they_change() {
        let tried = |tolerance, changes: &[f64], operations| robot_build::snapping::Tried {
            tolerance,
            snapped: changes
                .iter()
                .map(|change| Snap { name: "elbow".to_owned(), angle: 1.5, change: *change })
                .collect(),
            operations,
        };
        let start =
            "angles within 1e-9 rad of a multiple of π/2 are taken as that multiple (--snap); ";
        let taken = tried(1e-9, &[], 10);
        let alone = Snapping { taken: taken.clone(), larger: vec![] };
        assert_eq!(snapping(&alone), format!("{start}none is changed"));
        let exact = Snapping { taken: tried(0.0, &[], 10), larger: vec![] };
        assert_eq!(snapping(&exact), "angles have the values in the file (--snap 0)");
        let larger = vec![tried(1e-6, &[-1e-7, 1e-8], 7), tried(1e-4, &[2e-5], 12)];
        assert_eq!(
            snapping(&Snapping { taken, larger }),
            format!(
                "{start}none is changed\n--snap 1e-6 would change 2 by up to 1.0e-7 rad; inverse dynamics would \
                 need 3 fewer operations\n--snap 1e-4 would change 1 by up to 2.0e-5 rad; inverse dynamics would need 2 \
                 more operations"
            )
        );
        let taken = tried(1e-9, &[1e-10, -4e-10], 10);
        let shown = snapping(&Snapping { taken, larger: vec![] });
        assert_eq!(
            shown,
            format!("{start}2 are changed\nthe largest change is 4.0e-10 rad, from 1.5 at elbow")
        );
    }

    #[test]
    fn lists_are_broken_after_commas_at_the_last_column_that_fits() {
        assert_eq!(list("names", &[]), "names:\n");
        assert_eq!(list("names", &["a"]), "names: a\n");
        assert_eq!(list("names", &["a", "b", "c"]), "names: a, b, c\n");
        // The second name ends in the last column, or one after it; characters are counted, not bytes.
        for (length, breaks) in [(COLUMNS - 11, false), (COLUMNS - 10, true)] {
            let long = "ä".repeat(length);
            let names = ["ab", &long];
            let between = if breaks { "\n    " } else { " " };
            assert_eq!(list("names", &names), format!("names: ab,{between}{long}\n"), "{length}");
            // With a comma after it, the name is one character longer.
            let shown = list("names", &["ab", &long[2..], "c"]);
            assert!(shown.starts_with(&format!("names: ab,{between}{},", &long[2..])), "{shown}");
        }
        // All lines are as full as they can be.
        let words = ["word"; 100];
        for line in list("t", &words).lines() {
            assert!(line.chars().count() <= COLUMNS && !line.ends_with(' '), "{line}");
        }
        assert_eq!(list("t", &words).lines().count(), 7);
    }

    #[test]
    fn sums_are_broken_before_signs() {
        let lines = wrapped("Q = aa + bb*(c - d - e) - f + gggg", 12);
        assert_eq!(lines, ["Q = aa", "+ bb*(c - d", "- e) - f", "+ gggg"]);
        let lines = wrapped("Q = -a*(b - c) + d", 10);
        assert_eq!(lines, ["Q = -a*(b", "- c) + d"]);
        assert_eq!(wrapped("Q1 = 0", 3), ["Q1 = 0"]);
        let lines = wrapped("Q = (a - b + c)*sin(q2 + q3)", 22);
        assert_eq!(lines, ["Q = (a - b", "+ c)*sin(q2 + q3)"]);
        // After a closing parenthesis a sign is outside of the pair; after two of them, outside of the inner one.
        let lines = wrapped("x = a + (b - c) + d + eeeeeeee", 22);
        assert_eq!(lines, ["x = a + (b - c) + d", "+ eeeeeeee"]);
        assert_eq!(wrapped("x = a*((b + c) - d) + e", 20), ["x = a*((b + c) - d)", "+ e"]);
        assert_eq!(wrapped("x = a*((b + c) - d) + e", 19), ["x = a*((b + c)", "- d) + e"]);
        let text = "x = a - b + c - d*(e + f) + g - h";
        for columns in 0..40 {
            assert_eq!(wrapped(text, columns).join(" "), text);
        }
    }

    #[test]
    fn numbers_stand_to_the_right() {
        let rows = [["a", "number"], ["name", "1"], ["b", "20"]];
        let rows = rows.map(|row| row.map(str::to_owned).to_vec());
        assert_eq!(table(&rows), "a     number\nname       1\nb         20\n");
    }
}
