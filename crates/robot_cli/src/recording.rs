//! The output of commands about motions: a table, and a plot of it.

use std::path::{Path, PathBuf};

use robot_build::{Output, Ownership, Writer};
use robot_simulation::plot::Figure;

use crate::Terminal;
use crate::delivery::{file_of, write};
use crate::failure::Failure;

/// A path that says what picture to write.
pub(crate) fn plot_path(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let known = path.extension().is_some_and(|extension| extension == "svg" || extension == "png");
    if known { Ok(path) } else { Err("the name must end in .svg or .png".to_owned()) }
}

/// The paths of table and plot, which have been found to be free for them.
pub(crate) struct Recording<'a> {
    table: Option<&'a Path>,
    plot: Option<&'a Path>,
    writer: Writer,
}

/// CSV has no comments: a table is known by its header.
const TABLE: Ownership = Ownership::Headed(is_header);

/// Whether a line is the header of a table of `simulate` or of `torques`.
fn is_header(line: &str) -> bool {
    line.starts_with("t,q1,") && line.ends_with(",kinetic,potential,energy")
        || line.starts_with("t,tau1,") && line.contains(",inertia1,") && line.contains(",gravity1")
}

impl<'a> Recording<'a> {
    /// The places of a table, without which it goes to standard output, and of a plot; refused at once,
    /// before any work, if they cannot be written.
    pub(crate) fn open(
        table: Option<&'a Path>,
        plot: Option<&'a Path>,
        writer: Writer,
    ) -> Result<Recording<'a>, Failure> {
        let table = file_of(table);
        let outputs: Vec<(&Path, Ownership)> = table
            .map(|path| (path, TABLE))
            .into_iter()
            .chain(plot.map(|path| (path, Ownership::Marked)))
            .collect();
        writer.check(&outputs)?;
        Ok(Recording { table, plot, writer })
    }

    /// Writes or prints the table, and writes the plot if one is wanted.
    pub(crate) fn write(
        &self,
        csv: &str,
        figure: impl FnOnce() -> Figure,
        terminal: &mut Terminal<'_>,
    ) -> Result<(), Failure> {
        let plot = self.plot.map(|path| Ok::<_, Failure>((path, picture(path, &figure())?)));
        let plot = plot.transpose()?;
        let plot = plot.as_ref().map(|(path, bytes)| Output {
            path: path.to_path_buf(),
            bytes,
            ownership: Ownership::Marked,
        });
        let table = self.table.map(|path| Output {
            path: path.to_owned(),
            bytes: csv.as_bytes(),
            ownership: TABLE,
        });
        let outputs: Vec<Output<'_>> = plot.into_iter().chain(table).collect();
        write(&self.writer, &outputs, terminal)?;
        if self.table.is_none() {
            terminal.output.write_all(csv.as_bytes())?;
        }
        Ok(())
    }
}

/// A picture as its name says.
fn picture(path: &Path, figure: &Figure) -> Result<Vec<u8>, Failure> {
    let is_svg = path.extension().is_some_and(|extension| extension == "svg");
    Ok(if is_svg { figure.svg()?.into_bytes() } else { figure.png()? })
}
