//! Checks for symbols that look alike in print.

use robot_document::{Error, SymbolTable, Trigonometry};
use robot_model::diagnostic::{Diagnostic, code};

use super::facts::RobotFacts;

/// Equations in which two symbols look alike cannot be printed; code can be generated.
pub(super) fn check(facts: &RobotFacts<'_>, found: &mut Vec<Diagnostic>) {
    let table = SymbolTable::new(facts.robot, Trigonometry::default());
    let Err(Error::Alike { name, other, latex }) = table else { return };
    let message = format!("`{name}` and `{other}` are both printed as {latex}");
    let parameters = facts.robot.parameters.iter().zip(&facts.locations.parameters);
    let places: Vec<_> = parameters
        .filter(|(parameter, _)| [&name, &other].contains(&&parameter.name))
        .map(|(_, place)| &place.name)
        .collect();
    let place = places.first().copied().unwrap_or(&facts.locations.name);
    let diagnostic = Diagnostic::warning(code::SAME_LETTER, message).at(place, "this symbol");
    let diagnostic =
        places.iter().skip(1).fold(diagnostic, |found, place| found.and_at(place, "and this one"));
    found.push(
        diagnostic
            .because("equations and documents with these symbols are refused")
            .help("give one of the symbols another `latex`, or another name"),
    );
}
