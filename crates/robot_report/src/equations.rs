//! The equations of motion in each form, as MathML whose terms refer to the links and parameters that they depend on.

use std::collections::{BTreeMap, BTreeSet};

use robot_document::breaking::terms;
use robot_document::markup::{Element, Node, element, holding};
use robot_document::math::Math;
use robot_document::width::width;
use robot_document::{
    DIGITS, Equation, EquationOptions, Equations, Error, Form, Group, Room, equations,
};
use robot_document::{latex, mathml, typst};
use robot_model::robot::Robot;
use robot_model::variable::{JointVariable, Variable};

use crate::folded::{deferred, folded};
use crate::parts;

/// The largest number of characters of a form that is shown; nobody could read a longer one.
const MAX_LENGTH: usize = 120_000;
/// The largest number of definitions that are shown unfolded; longer lists are for looking things up.
const MOST_DEFINITIONS: usize = 18;
/// The largest number of coordinates for which all forms are shown. For more coordinates only the recursive and the
/// compact form are shown, because the others have functions for pairs of joints or multiply everything out.
const MOST_COORDINATES: usize = 24;
/// The width of a piece of an equation that is not broken, in points of 10 pt type: about the width of a phone.
const PIECE: f64 = 190.0;

/// The width available for an array with its left side, in points of 10 pt type; on a phone, wider ones scroll.
const LINE: f64 = 470.0;

/// The forms in the order of the page, except that the open form comes first.
const FORMS: [(Form, &str); 6] = [
    (Form::Grouped, "Grouped: mass matrix, Coriolis and centrifugal terms, gravity"),
    (Form::Collected, "Collected: one short formula for each joint torque, without friction"),
    (Form::Recursive, "Recursive: the Newton-Euler algorithm link by link"),
    (Form::Compact, "Compact: names for repeated expressions"),
    (Form::Regrouped, "Regrouped: linear in the base parameters"),
    (Form::Expanded, "Expanded: the same formulas multiplied out, without friction"),
];

/// All forms as folded parts, of which one is open.
pub(crate) fn forms(robot: &Robot) -> Vec<Node> {
    let found: Vec<_> = FORMS.map(|(form, title)| (form, title, in_form(robot, form))).into();
    let lengths = found
        .iter()
        .filter_map(|(form, _, found)| Some((*form, length(&found.as_ref().ok()?.arranged))));
    let opened = opened(&lengths.collect::<Vec<_>>());
    // The form that is open comes first.
    let (first, others): (Vec<_>, Vec<_>) =
        found.iter().partition(|(form, _, _)| opened == Some(*form));
    let forms = first.into_iter().chain(others).map(|(form, title, found)| {
        let details = element("details").with(holding("summary", *title));
        match found {
            Err(reason) => details.with(note(reason)),
            Ok(found) if opened == Some(*form) => details
                .attribute("open", "")
                .with_all(Sources::of(robot, *form, found).groups(true)),
            Ok(found) => details.with_all(Sources::of(robot, *form, found).groups(false)),
        }
    });
    let is_rounded =
        found.iter().any(|(_, _, found)| found.as_ref().is_ok_and(|shown| shown.arranged.rounded));
    let words = match is_rounded {
        true => format!("{WORDS} Decimals are rounded to {DIGITS} significant digits."),
        false => WORDS.to_owned(),
    };
    std::iter::once(holding("p", words)).chain(forms).map(Node::from).collect()
}

/// Chooses the form that is open: the shortest one, or a form without auxiliary names if it is at most twice as long.
fn opened(lengths: &[(Form, usize)]) -> Option<Form> {
    let (shortest, least) = lengths.iter().min_by_key(|(_, length)| *length)?;
    let plain = lengths.iter().find(|(form, length)| {
        matches!(form, Form::Grouped | Form::Collected) && *length <= 2 * least
    });
    plain.map(|(form, _)| *form).or(Some(*shortest))
}

/// The introduction to the equations.
const WORDS: &str = "The joint torques τ (Q in the equations), as functions of the joint \
    positions, velocities and accelerations. Hover over a term, or move to it with Tab and the \
    arrow keys, to highlight the links and parameters that it depends on and the definitions of \
    its symbols.";

fn note(words: &str) -> Element {
    holding("p", words).class("note")
}

/// The number of characters of the equations with their definitions, without spaces.
fn length(found: &Equations) -> usize {
    let all = found.groups.iter().flat_map(|group| &group.equations);
    let texts = all.flat_map(|equation| [&equation.name, &equation.text]);
    texts.flat_map(|text| text.split_whitespace()).map(str::len).sum()
}

/// The equations of one form as the page shows them.
struct Shown {
    /// The equations, with matrices and columns where they fit.
    arranged: Equations,
    /// The names and layouts of these matrices and columns.
    arrays: Vec<(String, Math)>,
    /// The names of their entries without an equation of their own, each with the name of its matrix or column.
    entries: BTreeMap<String, String>,
}

impl Shown {
    fn new(found: &Equations) -> Shown {
        let arranged = found.arranged(Room::Points(LINE));
        let equations = || arranged.groups.iter().flat_map(|group| &group.equations);
        let (mut arrays, mut entries) = (vec![], BTreeMap::new());
        for array in found.arrays() {
            let is_shown = |equation: &Equation| {
                equation.name == array.name && matches!(equation.right, Math::Matrix(_))
            };
            if !equations().any(is_shown) {
                continue;
            }
            arrays.push((array.name.clone(), array.left.clone()));
            for cell in array.rows.iter().flatten() {
                if !equations().any(|equation| equation.name == cell.name) {
                    entries.insert(cell.name.clone(), array.name.clone());
                }
            }
        }
        Shown { arranged, arrays, entries }
    }
}

/// The equations in a form, or the reason why they are not shown.
fn in_form(robot: &Robot, form: Form) -> Result<Shown, String> {
    let coordinates = robot.degrees_of_freedom();
    let link_by_link = matches!(form, Form::Recursive | Form::Compact);
    if coordinates > MOST_COORDINATES && !link_by_link {
        return Err(format!(
            "This form is not shown: the robot has {coordinates} coordinates, and the form is too \
             long to read if there are more than {MOST_COORDINATES}."
        ));
    }
    // In the expanded form, dry friction would have whole joint forces under a root, which would fill pages.
    let friction = robot.has_friction() && !matches!(form, Form::Expanded | Form::Collected);
    let digits = Some(DIGITS);
    let rounds_roots = true;
    let options =
        EquationOptions { form, friction, digits, rounds_roots, ..EquationOptions::default() };
    let found = equations(robot, &options);
    let found = found.and_then(|found| found.check_array_names(true).map(|()| found));
    let found = found.map_err(|error| format!("This form is not shown: {}.", reason(&error)))?;
    let length = length(&found);
    if length > MAX_LENGTH {
        return Err(format!(
            "This form is not shown: it has {length} characters, too many to read; print it \
             separately (form `{}`).",
            form.name()
        ));
    }
    Ok(Shown::new(&found))
}

/// The reason why equations are not shown. The letters of a page cannot be chosen.
fn reason(error: &Error) -> String {
    match error {
        Error::TakenLetter { letter, owner } => format!(
            "the letter {letter} already stands for {owner}; give the robot's symbols with this letter another `latex` in the \
             robot file"
        ),
        other => other.to_string(),
    }
}

/// What the symbols of a form refer to.
struct Sources<'r> {
    robot: &'r Robot,
    form: Form,
    found: &'r Shown,
    /// The symbols that the equations of this form define.
    names: BTreeSet<&'r str>,
}

impl<'r> Sources<'r> {
    fn of(robot: &'r Robot, form: Form, found: &'r Shown) -> Sources<'r> {
        let all = found.arranged.groups.iter().flat_map(|group| &group.equations);
        let names = all.map(|equation| equation.name.as_str()).collect();
        Sources { robot, form, found, names }
    }

    /// The groups of the form, with long lists of definitions folded.
    fn groups(&self, is_open: bool) -> Vec<Element> {
        let one = |group: &Group| {
            let introduction =
                (!group.introduction.is_empty()).then(|| holding("p", group.introduction.as_str()));
            let equations = group.equations.iter().map(|equation| self.equation(equation));
            let content = introduction.into_iter().chain(equations);
            if group.equations.len() > MOST_DEFINITIONS && group.definitions {
                let title = format!("{} ({})", group.title, group.equations.len());
                return vec![folded(title, content)];
            }
            let content = std::iter::once(holding("h3", group.title.as_str())).chain(content);
            if is_open { content.collect() } else { vec![deferred(content)] }
        };
        self.found.arranged.groups.iter().flat_map(one).collect()
    }

    /// An equation that can be broken between groups of terms.
    fn equation(&self, equation: &Equation) -> Element {
        let left = [equation.left.pieces(), &[Math::Sign('=')]].concat();
        let whole = Math::Row([&left, equation.right.pieces()].concat());
        let left = Math::Row(left);
        let (lines, has_stop) = match &equation.right {
            Math::Matrix(rows) => {
                let (matrix, has_stop) = self.matrix(rows);
                (vec![vec![mathml::formula(&left), matrix]], has_stop)
            }
            _ => self.lines(&left, equation.right.pieces()),
        };
        let shown = element("p")
            .class("equation")
            .attribute("id", self.defined(&equation.name))
            .attribute("data-terms", "")
            .attribute("data-is", self.defined(&equation.name))
            .attribute("data-latex", latex::formula(&whole))
            .attribute("data-typst", typst::formula(&whole))
            .with_all(lines.into_iter().map(|line| element("math").with_all(line)));
        // Each equation is one stop of the Tab key.
        if has_stop { shown } else { shown.attribute("tabindex", "0") }
    }

    /// A matrix whose entries are terms, and whether one of them is the stop of the Tab key.
    fn matrix(&self, rows: &[Vec<Math>]) -> (Element, bool) {
        let mut has_stop = false;
        let mut shown = vec![];
        for row in rows {
            let mut cells = vec![];
            for entry in row {
                let (term, is_stop) = self.term(0, std::slice::from_ref(entry), !has_stop);
                has_stop |= is_stop;
                cells.push(term);
            }
            shown.push(cells);
        }
        (mathml::bracketed(shown), has_stop)
    }

    /// The lines of a sum after its left side, term by term, and whether one of the terms is the stop of the Tab key.
    fn lines(&self, left: &Math, right: &[Math]) -> (Vec<Vec<Element>>, bool) {
        let mut lines = vec![vec![mathml::formula(left)]];
        let mut taken = width(left);
        let mut has_stop = false;
        for (place, pieces) in terms(right).enumerate() {
            let (term, is_stop) = self.term(place, pieces, !has_stop);
            has_stop |= is_stop;
            let needed = width(&Math::Row(pieces.to_vec()));
            match lines.last_mut().filter(|_| place == 0 || taken + needed <= PIECE) {
                Some(line) => {
                    line.push(term);
                    taken += needed;
                }
                None => {
                    lines.push(vec![term]);
                    taken = needed;
                }
            }
        }
        (lines, has_stop)
    }

    /// A term with references to what it depends on, and whether it is the stop of the Tab key.
    fn term(&self, place: usize, pieces: &[Math], may_stop: bool) -> (Element, bool) {
        let term = Math::Row(pieces.to_vec());
        let mut tokens: Vec<String> = vec![];
        let arrays = self.arrays(pieces).map(|name| vec![self.defined(name)]);
        let symbols = term.symbols();
        for own in arrays.chain(symbols.into_iter().map(|name| self.tokens(name))) {
            for token in own {
                if !tokens.contains(&token) {
                    tokens.push(token);
                }
            }
        }
        let shown = if place == 0 { mathml::formula(&term) } else { mathml::continued(&term) };
        let shown = shown.class("term");
        if tokens.is_empty() {
            return (shown, false);
        }
        // Each equation has one stop; the arrow keys move between its terms.
        let stop = if may_stop { "0" } else { "-1" };
        (shown.attribute("data-of", tokens.join(" ")).attribute("tabindex", stop), may_stop)
    }

    /// The matrices and columns with which a term starts.
    fn arrays<'t>(&self, term: &'t [Math]) -> impl Iterator<Item = &'r str> + use<'r, 't> {
        let product = match term {
            [Math::Sign(_), product @ ..] => product,
            whole => whole,
        };
        let known = self.found.arrays.iter();
        let own = known.filter(move |(_, left)| product.starts_with(left.pieces()));
        own.map(|(name, _)| name.as_str())
    }

    /// The tokens of what a symbol depends on.
    fn tokens(&self, name: &str) -> Vec<String> {
        if let Some(array) = self.found.entries.get(name) {
            return vec![self.defined(array)];
        }
        let parameter = self.robot.parameter(name).is_some();
        if !parameter && self.names.contains(name) {
            return vec![self.defined(name)];
        }
        match self.robot.variable(name) {
            Some(Variable::Parameter(_)) => {
                let links = parts::links_of_parameter(self.robot, name).into_iter();
                let links = links.map(parts::link);
                std::iter::once(parts::parameter(name)).chain(links).collect()
            }
            Some(Variable::Wrench(tip, _)) => {
                let tip = self.robot.frames.get(tip).and_then(|tip| tip.link);
                tip.map(parts::link).into_iter().collect()
            }
            Some(Variable::Joint(variable, index)) if JointVariable::MOTION.contains(&variable) => {
                let links = self.robot.links.iter().enumerate();
                let moved = links.filter(|(_, link)| link.joint.coordinate == index);
                moved.map(|(index, _)| parts::link(index)).collect()
            }
            Some(Variable::Joint(..)) | None => vec![],
        }
    }

    /// The token of an equation of this form, which is also its anchor. The name of a matrix is used without its
    /// arguments.
    fn defined(&self, name: &str) -> String {
        let name = name.split_once('(').map_or(name, |(name, _)| name);
        let plain = |letter: char| match letter {
            '.' => ':',
            _ if letter.is_ascii_alphanumeric() => letter,
            _ => '-',
        };
        format!("{}-{}", self.form.name(), name.chars().map(plain).collect::<String>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_form_is_open_but_rather_a_plain_one() {
        let of = |lengths: [usize; 3]| {
            opened(
                &[Form::Grouped, Form::Collected, Form::Compact]
                    .into_iter()
                    .zip(lengths)
                    .collect::<Vec<_>>(),
            )
        };
        assert_eq!(of([9, 8, 5]), Some(Form::Grouped));
        assert_eq!(of([11, 10, 5]), Some(Form::Collected));
        assert_eq!(of([11, 11, 5]), Some(Form::Compact));
        assert_eq!(opened(&[]), None);
    }
}
