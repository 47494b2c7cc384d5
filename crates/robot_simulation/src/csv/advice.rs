//! Remedies in messages about CSV that other programs write differently.

use robot_model::diagnostic::quote;
use robot_symbolic::is_below_range;

use super::cells;

/// Separators of other formats, with their names.
const SEPARATORS: [(char, &str); 3] = [(';', "semicolons"), ('\t', "tabs"), ('|', "vertical bars")];

/// The message with a remedy about a first line that is not a header of a CSV file, such as a comment, numbers or names
/// with semicolons between them; `None` if it can be a header.
#[must_use]
pub fn wrong_header(header: &str) -> Option<String> {
    let header = header.trim();
    if header.contains('\r') {
        let message = "the lines end with carriage returns alone; end them with line feeds";
        return Some(message.to_owned());
    }
    if header.starts_with('#') {
        let message = "the first line is a comment, which CSV does not have; remove it, so that the header is first";
        return Some(message.to_owned());
    }
    if header.to_ascii_lowercase().starts_with("sep=") {
        let message = "the first line names a separator, as Excel writes it; remove it, so that the header is first";
        return Some(message.to_owned());
    }
    if cells(header).iter().all(|cell| cell.parse::<f64>().is_ok()) {
        let message = "the first line has numbers instead of names; add a header, the line with the names of the columns";
        return Some(message.to_owned());
    }
    if is_unclosed(header) {
        return Some("a quote in the header is not closed; close or remove it".to_owned());
    }
    if header.ends_with(',') {
        return Some("the header ends with a comma; remove it, or name the last column".to_owned());
    }
    let found = SEPARATORS.iter().find(|(separator, _)| header.contains(*separator));
    let (_, name) = found.filter(|_| !header.contains(','))?;
    Some(format!(
        "the header has {name} instead of commas; separate columns with commas, and write decimals with points"
    ))
}

/// The remedy, to be appended to a message about an unknown column, if its name seems to contain a unit; otherwise
/// empty.
#[must_use]
pub fn unit(name: &str) -> &'static str {
    if name.contains(['[', '(', '°']) || name.ends_with("_deg") || name.ends_with("_rad") {
        "; write the name without a unit, and values in s, rad, m, N m and N: degrees are not converted"
    } else {
        ""
    }
}

/// The message about a cell in the column `name` that is not a finite number.
#[must_use]
pub fn wrong_number(name: &str, cell: &str) -> String {
    let number = match cell.parse::<f64>() {
        Ok(number) if number.is_infinite() => "finite number",
        Ok(number) if is_below_range(cell, number) => "number in the range of doubles",
        _ => "number",
    };
    let remedy = if cell.contains(',') { "; write decimals with points" } else { "" };
    format!("`{}` is `{}`, not a {number}{remedy}", quote(name), quote(cell))
}

fn is_unclosed(line: &str) -> bool {
    !line.matches('"').count().is_multiple_of(2)
}

/// The message about a line whose number of entries is not that of the header. `place` is the line.
#[must_use]
pub fn miscounted(place: &str, line: &str, found: usize, expected: usize) -> String {
    let entries = if found == 1 { "entry" } else { "entries" };
    let remedy = if SEPARATORS.iter().any(|(separator, _)| line.trim().contains(*separator)) {
        "; separate them with commas"
    } else if is_unclosed(line) {
        "; a quote is not closed"
    } else if line.contains('"') {
        "; a comma in quotes does not separate entries, and decimals have points"
    } else {
        ""
    };
    format!("{place}: {found} {entries}, but the header has {expected}{remedy}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_headers_and_rows_have_a_remedy() {
        for (header, part) in [
            ("t;q1;q2\n", Some("has semicolons instead of commas; separate columns with commas")),
            ("t\tq1\n", Some("has tabs instead of commas")),
            ("t|q1\n", Some("has vertical bars instead of commas")),
            ("t,q1\r0,1\r1,1\r", Some("end with carriage returns alone")),
            ("t,q1\r\n", None),
            ("\tt\t, q1;\n", None),
            ("t,q1,\n", Some("ends with a comma; remove it")),
            ("t,\"q1\n", Some("a quote in the header is not closed")),
            ("t\n", None),
        ] {
            let found = wrong_header(header);
            assert_eq!(found.is_some(), part.is_some(), "{header:?}: {found:?}");
            assert!(found.is_none_or(|found| found.contains(part.unwrap_or_default())));
        }
        assert_eq!(
            miscounted("line 2", "0;1", 1, 3),
            "line 2: 1 entry, but the header has 3; separate them with commas"
        );
        assert_eq!(miscounted("line 2", "0,1\n", 2, 3), "line 2: 2 entries, but the header has 3");
        assert!(
            miscounted("line 2", "\"0,1\"", 1, 2)
                .ends_with("quotes does not separate entries, and decimals have points")
        );
        assert!(miscounted("line 2", "\"0,1", 1, 2).ends_with("; a quote is not closed"));
        assert_eq!(
            wrong_number("q1", "0,1"),
            "`q1` is `0,1`, not a number; write decimals with points"
        );
        assert_eq!(wrong_number("q1", "1e400"), "`q1` is `1e400`, not a finite number");
    }

    #[test]
    fn a_unit_in_a_name_has_a_remedy() {
        for name in ["q1 [deg]", "q1 (rad)", "q1_deg", "q1 °"] {
            assert!(unit(name).contains("without a unit"), "{name}");
        }
        assert_eq!(["q3", "speed", "qd_1"].map(unit), [""; 3]);
    }
}
