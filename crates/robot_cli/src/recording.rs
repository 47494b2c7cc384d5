//! The output of commands about motions: a table and its plot.

use std::io::Write;
use std::path::{Path, PathBuf};

use robot_build::{Output, Ownership, Writer, sealed};
use robot_simulation::plot::Figure;

use crate::delivery::{Kind, file_of, write};
use crate::failure::Failure;
use crate::outgoing::Outgoing;

/// Parses the path of a picture, whose ending gives the format.
pub(crate) fn plot_path(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let known = path.extension().is_some_and(|extension| extension == "svg" || extension == "png");
    if known { Ok(path) } else { Err("the name must end in .svg or .png".to_owned()) }
}

/// The destinations of a table and a plot, which have been checked.
pub(crate) struct Recording<'a> {
    table: Option<&'a Path>,
    plot: Option<&'a Path>,
    writer: Writer,
}

/// The ownership of tables: CSV has no comments, so that a table is recognized by its header.
const TABLE: Ownership = Ownership::Headed(is_header);

/// Whether a line is the header of a table of `simulate` or of `torques`.
fn is_header(line: &str) -> bool {
    line.starts_with("t,q1,") && line.ends_with(",kinetic,potential,energy")
        || line.starts_with("t,tau1,") && line.contains(",inertia1,") && line.contains(",gravity1")
}

impl<'a> Recording<'a> {
    /// Checks the paths of a table, whose default is standard output, and of a plot. If they cannot be written, the
    /// error is returned here, before any work.
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
        let kind = Kind { doc: "this table is CSV", ending: "csv" };
        table.map_or(Ok(()), |path| kind.check(path))?;
        Ok(Recording { table, plot, writer })
    }

    /// Whether there is a plot.
    pub(crate) fn has_plot(&self) -> bool {
        self.plot.is_some()
    }

    /// Starts the table.
    pub(crate) fn begin<'t>(
        &'t self,
        output: &'t mut dyn Write,
        errors: &'t mut dyn Write,
    ) -> Result<Outgoing<'t>, Failure> {
        let begin = |path: &'t Path| Ok::<_, Failure>((self.writer.begin(path, TABLE)?, path));
        Ok(Outgoing::new(self.table.map(begin).transpose()?, output, errors))
    }

    /// Ends the table, and writes the plot if there is one.
    pub(crate) fn end(
        &self,
        table: Outgoing<'_>,
        figure: impl FnOnce() -> Figure,
    ) -> Result<(), Failure> {
        table.end(|errors| {
            let Some(path) = self.plot else { return Ok(()) };
            let bytes = picture(path, &figure())?;
            let ownership = Ownership::Marked;
            let output = Output { path: path.to_owned(), bytes: &bytes, ownership };
            write(&self.writer, &[output], errors)
        })
    }
}

/// Makes a picture in the format given by the ending of its name.
fn picture(path: &Path, figure: &Figure) -> Result<Vec<u8>, Failure> {
    let is_svg = path.extension().is_some_and(|extension| extension == "svg");
    Ok(if is_svg { sealed(&figure.svg()?).as_bytes().to_owned() } else { figure.png()? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_of_motions_are_recognized_and_others_are_not() {
        let motion = "t,q1,q2,qd1,qd2,tau1,tau2,kinetic,potential,energy";
        let torques = "t,tau1,tau2,inertia1,inertia2,coriolis1,coriolis2,gravity1,gravity2";
        let single = ["t,q1,qd1,kinetic,potential,energy", "t,tau1,inertia1,coriolis1,gravity1"];
        for header in [motion, torques].into_iter().chain(single) {
            assert!(is_header(header), "{header}");
            assert!(!is_header(&header[1..]) && !is_header(&format!(" {header}")), "{header}");
        }
        for other in [
            "",
            "t,q1,q2,qd1,qd2,qdd1,qdd2",
            "a,q1,kinetic,potential,energy",
            "t,kinetic,potential,energy",
            "t,q1,kinetic,potential,energy,note",
            "t,tau1,tau2",
            "t,tau1,inertia1,coriolis1",
            "t,tau1,coriolis1,gravity1",
            "t,inertia1,gravity1",
            "a,tau1,inertia1,gravity1",
            // Half of one and half of the other.
            "t,q1,inertia1,gravity1",
            "t,tau1,kinetic,potential,energy",
        ] {
            assert!(!is_header(other), "{other}");
        }
    }

    /// Commands keep what they compute only for a plot.
    #[test]
    fn a_plot_is_there_only_if_it_was_asked_for() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plot.svg");
        for plot in [None, Some(path.as_path())] {
            let recording = Recording::open(None, plot, Writer::new());
            let has_plot = recording.ok().map(|recording| recording.has_plot());
            assert_eq!(has_plot, Some(plot.is_some()));
        }
    }

    #[test]
    fn pictures_are_svg_or_png() {
        for name in ["a.svg", "a.png", "b/a.b.svg"] {
            assert_eq!(plot_path(name), Ok(PathBuf::from(name)));
        }
        for name in ["a", "svg", "a.pdf", "a.svg.txt", "a.SVG", ""] {
            assert!(plot_path(name).is_err_and(|error| error.contains(".svg or .png")), "{name}");
        }
        let figure = Figure { t: vec![0.0, 1.0], ..Figure::default() };
        let bytes = |name| picture(Path::new(name), &figure).unwrap();
        assert!(String::from_utf8(bytes("a.svg")).unwrap().contains("<svg "));
        assert!(bytes("a.png").starts_with(b"\x89PNG"));
    }
}
