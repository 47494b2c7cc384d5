//! The equations of motion in each form, as MathML whose terms point at the links and parameters that
//! they come from.

use robot_document::breaking::terms;
use robot_document::markup::{Element, Node, element, holding};
use robot_document::math::Math;
use robot_document::{Equation, EquationOptions, Equations, Form, Group, equations};
use robot_model::robot::Robot;
use robot_model::variable::{JointVariable, Variable};

use crate::formula::{self, math};
use crate::parts;

/// Forms of more terms than this are not shown: pages would be slow, and nobody reads so far.
const MAX_TERMS: usize = 5_000;

/// The forms of the page in their order, the first one open.
const FORMS: [(Form, &str); 5] = [
    (Form::Grouped, "Grouped: Q = M(q) q̈ + C(q, q̇) q̇ + g(q)"),
    (Form::Expanded, "Expanded: sums of products, without friction"),
    (Form::Recursive, "Recursive: the iterations link by link"),
    (Form::Compact, "Compact: repeated expressions have names"),
    (Form::Regrouped, "Regrouped: linear in the base parameters"),
];

/// All forms, each to be opened.
pub(crate) fn forms(robot: &Robot) -> Vec<Node> {
    let mut body: Vec<Node> = vec![holding("p", WORDS).into()];
    for (place, (form, title)) in FORMS.into_iter().enumerate() {
        // Expanded under the root of dry friction, the forces in the joints fill pages.
        let friction = robot.has_friction() && form != Form::Expanded;
        let options = EquationOptions { form, friction, ..EquationOptions::default() };
        let shown = match equations(robot, &options) {
            Ok(found) => in_form(robot, form, &found),
            Err(error) => vec![note(&format!("This form is not shown: {error}"))],
        };
        let details = element("details").with(holding("summary", title)).with_all(shown);
        let details = if place == 0 { details.attribute("open", "") } else { details };
        body.push(details.into());
    }
    body
}

/// The form of the equations.
const WORDS: &str = "The joint torques τ (Q in the equations), as functions of the joint \
    positions, velocities and accelerations. Hover a term, or move to it with Tab and the arrow \
    keys, to highlight the links and parameters it depends on and the definitions of its \
    symbols.";

fn note(words: &str) -> Element {
    holding("p", words).class("note")
}

fn in_form(robot: &Robot, form: Form, found: &Equations) -> Vec<Element> {
    let all = found.groups.iter().flat_map(|group| &group.equations);
    let count: usize = all.map(|equation| terms(equation.right.pieces()).count()).sum();
    if count > MAX_TERMS {
        return vec![note(&format!(
            "This form has {count} terms and is too long for this page; print it separately \
             (form `{}`).",
            form.name()
        ))];
    }
    let names: Vec<&str> = found
        .groups
        .iter()
        .flat_map(|group| &group.equations)
        .map(|equation| equation.name.as_str())
        .collect();
    let sources = Sources { robot, form, names };
    found.groups.iter().flat_map(|group| sources.group(group)).collect()
}

/// The meaning of symbols.
struct Sources<'r> {
    robot: &'r Robot,
    form: Form,
    /// The symbols that the form's own equations define.
    names: Vec<&'r str>,
}

impl Sources<'_> {
    fn group(&self, group: &Group) -> Vec<Element> {
        let mut shown = vec![holding("h3", group.title.as_str())];
        if !group.introduction.is_empty() {
            shown.push(holding("p", group.introduction.as_str()));
        }
        shown.extend(group.equations.iter().map(|equation| self.equation(equation)));
        shown
    }

    /// An equation that breaks between its terms.
    fn equation(&self, equation: &Equation) -> Element {
        let left = Math::Row(vec![equation.left.clone(), Math::Sign('=')]);
        let right = terms(equation.right.pieces()).enumerate();
        element("p")
            .class("equation")
            .attribute("data-terms", "")
            .attribute("data-is", self.defined(&equation.name))
            .with(math(&left))
            .with_all(right.map(|(place, term)| self.term(place, term)))
    }

    fn term(&self, place: usize, pieces: &[Math]) -> Element {
        let term = Math::Row(pieces.to_vec());
        let mut tokens: Vec<String> = vec![];
        for name in term.symbols() {
            for token in self.tokens(name) {
                if !tokens.contains(&token) {
                    tokens.push(token);
                }
            }
        }
        let shown = element("span").class("term").with(formula::term(pieces, place == 0));
        if tokens.is_empty() {
            return shown;
        }
        // One stop of the tabulator for each equation; the arrows go through its terms.
        let stop = if place == 0 { "0" } else { "-1" };
        shown.attribute("data-of", tokens.join(" ")).attribute("tabindex", stop)
    }

    /// The origin of a symbol.
    fn tokens(&self, name: &str) -> Vec<String> {
        let parameter = self.robot.parameter(name).is_some();
        if !parameter && self.names.contains(&name) {
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

    /// The token of an equation of this form.
    fn defined(&self, name: &str) -> String {
        let plain = |letter: char| if letter.is_ascii_alphanumeric() { letter } else { '-' };
        format!("{}-{}", self.form.name(), name.chars().map(plain).collect::<String>())
    }
}
