//! States from CSV: a header such as `q1,q2,qd1,qd2,fx,fy,fz,mx,my,mz`, then a line each.

use robot_model::diagnostic::quote;

use super::{Layout, State};
use crate::text;

pub(super) fn read(text: &str, layout: &Layout) -> (Vec<State>, Vec<String>) {
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let mut lines = lines.map(|(index, line)| (index + 1, cells(line)));
    let Some((_, header)) = lines.next() else {
        return (vec![], vec!["there are no states".to_owned()]);
    };
    let mut errors = header_errors(&header, layout);
    if !errors.is_empty() {
        return (vec![], errors);
    }
    let mut states = vec![];
    for (number, cells) in lines {
        let place = format!("line {number}");
        let (entries, expected) = (cells.len(), header.len());
        if entries == expected {
            states.push(state(place, &header, &cells, layout, &mut errors));
        } else {
            errors.push(format!("{place}: {entries} entries, but the header has {expected}"));
        }
    }
    (states, errors)
}

fn cells(line: &str) -> Vec<&str> {
    line.split(',').map(|cell| cell.trim().trim_matches('"')).collect()
}

fn header_errors(header: &[&str], layout: &Layout) -> Vec<String> {
    let mut errors = vec![];
    let columns = layout.columns();
    for (index, name) in header.iter().enumerate() {
        if !columns.contains(name) {
            errors.push(format!("the header: {}", text::unknown("column", name, &columns)));
        } else if header[..index].contains(name) {
            errors.push(format!("`{name}` appears twice in the header"));
        }
    }
    for array in &layout.arrays {
        let given = array.columns.iter().filter(|column| header.contains(&column.as_str()));
        if (1..array.columns.len()).contains(&given.count()) {
            let lacks = array.columns.iter().filter(|column| !header.contains(&column.as_str()));
            let lacks: Vec<&str> = lacks.map(String::as_str).collect();
            errors.push(format!("the header lacks {} of `{}`", lacks.join(", "), array.name));
        }
    }
    errors
}

fn state(
    place: String,
    header: &[&str],
    cells: &[&str],
    layout: &Layout,
    errors: &mut Vec<String>,
) -> State {
    let mut arrays = vec![];
    for array in &layout.arrays {
        let positions: Option<Vec<usize>> = array
            .columns
            .iter()
            .map(|column| header.iter().position(|name| name == column))
            .collect();
        let Some(positions) = positions else {
            continue;
        };
        let mut entries = vec![];
        for position in positions {
            let (name, cell) = (header[position], cells[position]);
            match cell.parse::<f64>().ok().filter(|entry| entry.is_finite()) {
                Some(entry) => entries.push(entry),
                None => {
                    let cell = quote(cell);
                    errors.push(format!("{place}: `{name}` is `{cell}`, not a number"));
                }
            }
        }
        arrays.push((array.name.clone(), entries));
    }
    State { place, arrays }
}
