//! States from CSV: a header such as `q1,q2,qd1,qd2,fx,fy,fz,mx,my,mz`, then a line for each state.

use std::borrow::Cow;
use std::io::BufRead;

use robot_model::diagnostic::quote;
use robot_model::variable::JointVariable;
use robot_simulation::csv::{
    Lines, cells, miscounted, number, numbers, unit, wrong_header, wrong_number,
};
use robot_simulation::is_energy;

use super::{Layout, Place, Sink, State};
use crate::failure::Failure;
use crate::text;

pub(super) fn read<'l>(
    lines: &mut Lines<impl BufRead>,
    layout: &'l Layout,
    sink: &mut dyn Sink<'l>,
) -> Result<(), Failure> {
    let Some((_, header)) = lines.next_line()? else {
        sink.error("there are no states".to_owned());
        return Ok(());
    };
    if let Some(wrong) = wrong_header(header) {
        sink.error(wrong);
        return Ok(());
    }
    let header = cells(header);
    let errors = header_errors(&header, layout);
    if !errors.is_empty() {
        errors.into_iter().for_each(|error| sink.error(error));
        return Ok(());
    }
    let columns = Columns::of(&header, layout);
    let (mut state, mut found) = (State::new(layout), vec![]);
    let mut is_empty = true;
    while let Some((number, line)) = lines.next_line()? {
        is_empty = false;
        state.clear(Place::Line(number));
        let is_right = numbers(line, &mut found) && found.len() == columns.names.len();
        let is_state = if is_right {
            columns.set(&found, &mut state);
            true
        } else {
            columns.set_cells(line, &mut state, sink)
        };
        if is_state && sink.state(&mut state).is_break() {
            break;
        }
    }
    if is_empty {
        state.clear(Place::Header);
        columns.set(&vec![0.0; columns.names.len()], &mut state);
        sink.header(&state);
    }
    Ok(())
}

/// Whether a header has a column of a wrench.
pub(super) fn has_wrench(header: &str, layout: &Layout) -> bool {
    let cells = cells(header);
    let mut wrenches = layout.arrays.iter().filter(|array| array.is_wrench());
    wrenches.any(|array| array.columns.iter().any(|name| cells.contains(&name.as_str())))
}

fn header_errors(header: &[&str], layout: &Layout) -> Vec<String> {
    let mut errors = vec![];
    let columns = layout.columns();
    for (index, name) in header.iter().enumerate() {
        // Simulated motions have a time and energies, which no function of a robot takes.
        if !(columns.contains(name) || *name == "t" || is_energy(name)) {
            let meant = text::meant(&in_our_order(name), &columns);
            let unknown = format!("unknown column `{}`.{meant}", quote(name));
            let unit = match is_time(name) {
                true => "; call the column of times `t`, which is not used, or remove it",
                false => unit(name),
            };
            let unknown = if unit.is_empty() { &unknown } else { unknown.trim_end_matches('.') };
            errors.push(format!("the header: {unknown}{unit}"));
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

/// Whether a name is one of those that other programs give to a column of times.
fn is_time(name: &str) -> bool {
    let name = name.trim_start_matches('%').to_ascii_lowercase();
    name.starts_with("time") || name == "stamp"
}

/// The name `qd1` for `dq1`, as other programs name velocities and accelerations; others unchanged.
fn in_our_order(name: &str) -> Cow<'_, str> {
    let position = name.trim_start_matches('d');
    let variable = match name.len() - position.len() {
        1 => JointVariable::Velocity,
        2 => JointVariable::Acceleration,
        _ => return Cow::Borrowed(name),
    };
    match position.strip_prefix(JointVariable::Position.name()) {
        Some(number) => Cow::Owned(format!("{}{number}", variable.name())),
        None => Cow::Borrowed(name),
    }
}

/// The meaning of the columns of a file.
struct Columns {
    names: Vec<String>,
    /// The given arrays, by their indices in the layout, with the columns of their entries.
    arrays: Vec<(usize, Vec<usize>)>,
}

impl Columns {
    fn of(header: &[&str], layout: &Layout) -> Columns {
        let position = |name: &String| header.iter().position(|known| known == name);
        let arrays = layout.arrays.iter().enumerate().filter_map(|(index, array)| {
            Some((index, array.columns.iter().map(position).collect::<Option<_>>()?))
        });
        let arrays = arrays.collect();
        Columns { names: header.iter().map(|name| (*name).to_owned()).collect(), arrays }
    }

    /// Sets the arrays of a state.
    fn set(&self, numbers: &[f64], state: &mut State<'_>) {
        for (index, columns) in &self.arrays {
            state.begin_array(*index).extend(columns.iter().map(|column| numbers[*column]));
        }
    }

    /// Adds the cells of a line that are numbers to the state, and reports the others as errors; returns whether the
    /// number of cells is that of the columns.
    fn set_cells<'l>(&self, line: &str, state: &mut State<'l>, sink: &mut dyn Sink<'l>) -> bool {
        let cells = cells(line);
        let (place, entries, expected) = (state.place, cells.len(), self.names.len());
        if entries != expected {
            sink.error(miscounted(&place.to_string(), line, entries, expected));
            return false;
        }
        for (index, columns) in &self.arrays {
            let array = state.begin_array(*index);
            for column in columns {
                match number(cells[*column]) {
                    Some(entry) => array.push(entry),
                    None => {
                        let message = wrong_number(&self.names[*column], cells[*column]);
                        sink.error(format!("{place}: {message}"));
                    }
                }
            }
        }
        true
    }
}
