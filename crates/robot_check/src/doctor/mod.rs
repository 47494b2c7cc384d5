//! The doctor: finds likely mistakes in robot files.
//!
//! The readers reject impossible mechanisms. This module reports possible but unlikely ones: inertias in kg mm², a
//! tensor about the wrong point, a right angle with four digits. Each file contains one family of checks. The reasons
//! for its thresholds are stated there and on the page of the diagnostic code (`crates/robot_model/diagnostics`).
//! Nothing is ever changed. Values that depend on a parameter without a nominal value are skipped.

mod angles;
mod axes;
mod copies;
mod extent;
mod facts;
mod letters;
mod motion;
mod origin;
mod units;

use robot_model::description::{self, Described, Options};
use robot_model::diagnostic::{Diagnostic, Diagnostics, Severity};

use facts::RobotFacts;

/// The findings about a file.
#[derive(Clone, Debug)]
pub struct Examination {
    /// Errors and warnings. If there are errors, they are only those of the reader.
    pub found: Diagnostics,
    /// Notes about the choices of the reader that the format leaves open.
    pub choices: Diagnostics,
}

/// Reads a file and examines the robot that it describes.
#[must_use]
pub fn check(name: &str, text: &str, options: &Options) -> Examination {
    match description::read_with(name, text, options) {
        Ok(described) => examine(&described),
        Err(found) => Examination::refused(found),
    }
}

impl Examination {
    /// The examination of a file that does not describe a robot.
    #[must_use]
    pub fn refused(found: Diagnostics) -> Examination {
        let choices = Diagnostics::new(found.source().clone(), vec![]);
        Examination { found, choices }
    }
}

/// Examines a robot. The result contains the reader's warnings and choices and those of the checks in this module.
#[must_use]
pub fn examine(described: &Described) -> Examination {
    let Described { warnings, choices, .. } = described;
    let own = mistakes(described);
    let (notes, mistakes): (Vec<_>, Vec<_>) =
        own.into_iter().partition(|found| found.severity == Severity::Note);
    let joined = |of_reader: &Diagnostics, own: Vec<Diagnostic>| {
        let list = of_reader.iter().cloned().chain(own).collect();
        Diagnostics::new(of_reader.source().clone(), list)
    };
    Examination { found: joined(warnings, mistakes), choices: joined(choices, notes) }
}

/// The warnings and notes of this module only.
fn mistakes(described: &Described) -> Vec<Diagnostic> {
    let facts = RobotFacts::new(described);
    let mut found = Vec::new();
    units::check(&facts, &mut found);
    extent::check(&facts, &mut found);
    origin::check(&facts, &mut found);
    copies::check(&facts, &mut found);
    angles::check(&facts, &mut found);
    axes::check(&facts, &mut found);
    motion::check(&facts, &mut found);
    letters::check(&facts, &mut found);
    found
}

#[cfg(test)]
mod tests;
