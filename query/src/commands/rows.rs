//! Results with a row for each row of the log.

use std::path::Path;

use datafusion::logical_expr::Expr;
use datafusion::prelude::DataFrame;
use robot_query::Error;
use robot_query::log::{Answer, FileQuery, Log, Resumed, Session, resume, write};

use super::Engine;
use super::inputs::{Inputs, Opened, explained};

/// A column that is computed beside columns of the log, and its destination.
pub(super) struct Rows<'a> {
    pub(super) inputs: &'a Inputs,
    /// The columns of the log that are kept.
    pub(super) columns: Option<&'a [String]>,
    pub(super) output: &'a Path,
    /// Whether each file of the log gets a file of its own, unless that exists already.
    pub(super) resume: bool,
    /// The expression of the column.
    pub(super) column: fn(&Session, &Opened) -> Result<Expr, Error>,
}

impl Rows<'_> {
    pub(super) async fn write(&self, engine: &Engine) -> Result<(), Error> {
        let answer = Answer::at(self.output)?;
        if self.resume {
            return self.resume(engine, &answer).await;
        }
        let threads = if matches!(answer, Answer::Folder(_)) { engine.threads() } else { 1 };
        let session = engine.session(threads)?;
        let opened = self.inputs.open(&session).await?;
        let table = self.table(&session, &opened)?;
        if self.inputs.explain {
            return explained(table, &opened).await;
        }
        let rows = write(table, &answer, opened.rows()).await;
        let rows = rows.map_err(|error| opened.located(error))?;
        eprintln!("{rows} rows");
        Ok(())
    }

    fn table(&self, session: &Session, opened: &Opened) -> Result<DataFrame, Error> {
        let mut columns = opened.kept(self.columns)?;
        columns.push((self.column)(session, opened)?);
        Ok(opened.table.clone().select(columns)?)
    }

    async fn resume(&self, engine: &Engine, answer: &Answer) -> Result<(), Error> {
        let Answer::Folder(folder) = answer else {
            let reason = "--resume needs a folder, whose name has no extension, for a file for each file of the log";
            return Err(Error::File {
                path: self.output.to_owned(),
                row_group: None,
                reason: reason.to_owned(),
            });
        };
        let session = engine.session(1)?;
        let opened = self.inputs.open(&session).await?;
        let table = self.table(&session, &opened)?;
        if self.inputs.explain {
            return explained(table, &opened).await;
        }
        let names: Vec<&str> =
            table.schema().fields().iter().map(|field| field.name().as_str()).collect();
        let column = (self.column)(&session, &opened)?;
        let filter = self.inputs.filter.as_deref().unwrap_or("true");
        let question = FileQuery {
            words: format!(
                "{column} with {} where {filter}, of the robot\n{}",
                names.join(", "),
                opened.model.source.text
            ),
            filtered: self.inputs.filter.is_some(),
            threads: engine.threads(),
        };
        let table = async |log: Log| {
            let opened = self.inputs.open_log(&session, log).await?;
            self.table(&session, &opened)
        };
        let found = resume(&opened.log, folder, &question, table).await;
        let Resumed { computed, kept } = found.map_err(|error| opened.located(error))?;
        eprintln!("{computed} rows computed, {kept} kept from an earlier run");
        Ok(())
    }
}
