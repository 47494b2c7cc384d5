//! Checks for symbols that look alike in print.

use std::borrow::Cow;

use robot_document::{Error, SymbolTable, Trigonometry};
use robot_model::diagnostic::{Diagnostic, code};

use super::facts::RobotFacts;

/// Reports symbols that are printed alike: equations in which two symbols look alike cannot be printed, although code can
/// be generated.
pub(super) fn check(facts: &RobotFacts<'_>, found: &mut Vec<Diagnostic>) {
    let mut robot = Cow::Borrowed(facts.robot);
    // Each round reports a pair and gives one of the two another look.
    for round in 0..robot.parameters.len() {
        let table = SymbolTable::new(&robot, Trigonometry::default());
        let Err(Error::Alike { name, other, latex }) = table else { return };
        found.push(diagnostic(facts, [&name, &other], &latex));
        let mut parameters = robot.to_mut().parameters.iter_mut().rev();
        let one = parameters.find(|one| [&name, &other].contains(&&one.name));
        let Some(one) = one else { return };
        one.latex = Some(format!("\\mathrm{{reported}}_{{{round}}}"));
    }
}

fn diagnostic(facts: &RobotFacts<'_>, pair: [&String; 2], latex: &str) -> Diagnostic {
    let [name, other] = pair;
    let message = format!("`{name}` and `{other}` are both printed as {latex}");
    let parameters = facts.robot.parameters.iter().zip(&facts.locations.parameters);
    let places: Vec<_> = parameters
        .filter(|(parameter, _)| pair.contains(&&parameter.name))
        .map(|(_, place)| &place.name)
        .collect();
    let place = places.first().copied().unwrap_or(&facts.locations.name);
    let diagnostic = Diagnostic::warning(code::PRINTED_ALIKE, message).at(place, "this symbol");
    let others = places.iter().skip(1);
    others
        .fold(diagnostic, |found, place| found.and_at(place, "and this one"))
        .because("equations and documents with these symbols are refused")
        .help("give one of the symbols another `latex`, or another name")
}

#[cfg(test)]
mod tests {
    use crate::doctor::check;

    #[test]
    fn all_pairs_are_reported() {
        let text = "format = 1\n[robot]\nname = \"arm\"\n[parameters]\na = { value = 1, latex = \"q_1\" }\n\
                    b = { value = 1, latex = \"m\" }\nm = 1\nc = { value = 1, latex = \"m\" }\n[[link]]\n\
                    name = \"1\"\njoint = { type = \"revolute\", axis = \"z\" }\nmass = \"a + b + c + m\"\n\
                    center_of_mass = [0, 0, 0]\ninertia = { xx = 1, yy = 1, zz = 1 }\n";
        let found = check("arm.toml", text, &robot_model::description::Options::default()).found;
        let alike: Vec<&str> = found
            .iter()
            .filter(|one| one.code == super::code::PRINTED_ALIKE)
            .map(|one| one.message.as_str())
            .collect();
        assert_eq!(alike.len(), 3, "{alike:?}");
        assert!(alike.iter().any(|message| message.contains("q_1")), "{alike:?}");
    }
}
