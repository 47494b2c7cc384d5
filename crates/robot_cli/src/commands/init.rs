//! `init`: a first robot file.

use std::path::PathBuf;

use clap::Args;
use robot_build::{Output, Ownership, shown};
use robot_model::description;

use crate::Terminal;
use crate::delivery::{ForceArgument, write};
use crate::failure::Failure;

/// The text of the file, which describes an arm with two links.
const ROBOT: &str = include_str!("../../demo/first.toml");

/// The name of the robot in it.
const NAME: &str = "my_robot";

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic init
  robot-symbolic init two_link

Writes NAME.toml, a planar arm with two links and comments, to be edited. Its first line names the
JSON schema for editors, which `robot-symbolic schema` writes. docs/robot-file.md describes all keys, and
`import` converts a URDF file to a robot file.")]
pub(crate) struct Arguments {
    /// The name of the robot, and of the file without `.toml`
    #[arg(default_value = NAME, value_parser = name)]
    name: String,
    #[command(flatten)]
    force: ForceArgument,
}

/// Parses a name that is valid for a robot and for a file. The file is read with it as a check, so that commands can
/// read the file that is written.
fn name(text: &str) -> Result<String, String> {
    let name = text.strip_suffix(".toml").unwrap_or(text);
    let is_fine = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if !name.starts_with(|c: char| c.is_ascii_alphabetic()) || !name.chars().all(is_fine) {
        return Err(
            "a name begins with a letter and contains only letters, digits and _".to_owned()
        );
    }
    let refused = description::read_toml(name, &named(name)).err();
    let refused = refused.as_ref().and_then(|found| found.iter().next());
    match refused {
        None => Ok(name.to_owned()),
        Some(refused) => {
            let reason = refused.primary.iter().map(|label| label.text.as_str());
            let parts = reason.chain(refused.help.as_deref());
            Err(std::iter::once(&*refused.message).chain(parts).collect::<Vec<_>>().join("; "))
        }
    }
}

/// The text of the file for a robot with this name.
fn named(name: &str) -> String {
    ROBOT.replace(NAME, name)
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let path = PathBuf::from(format!("{}.toml", self.name));
        let text = named(&self.name);
        let writer = self.force.writer([], true)?;
        let (bytes, ownership) = (text.as_bytes(), Ownership::Edited);
        let file = shown(&path);
        if std::fs::read(&path).is_ok_and(|present| present == bytes) {
            writeln!(
                terminal.errors,
                "{file} already exists as init writes it; it is not written again"
            )?;
        } else {
            let output = Output { path: path.clone(), bytes, ownership };
            writer.check(&[(&path, ownership)])?;
            write(&writer, &[output], terminal.errors)?;
        }
        writeln!(
            terminal.output,
            "Next:\n  robot-symbolic show {file}\n  robot-symbolic equations {file}\n  robot-symbolic report {file} \
             --open\n  robot-symbolic schema -o robot-file.schema.json"
        )?;
        Ok(())
    }
}
