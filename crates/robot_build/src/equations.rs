//! From the text of a robot file to its equations of motion, as text and LaTeX.

use robot_dynamics::diagnostic::{Diagnostics, Source};
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_dynamics::model::{Parameter, Robot};
use robot_dynamics::newton_euler::{Effects, newton_euler};
use robot_dynamics::quantity::{Kind, Symbol};
use robot_symbolic::print::latex::{LatexStyle, LatexTerm, Trigonometry, polynomial_terms};
use robot_symbolic::print::{TooLarge, default_rank};
use robot_symbolic::{AngleSums, Expr, Graph, Polynomial, PolynomialOptions, View};

use crate::error::{Error, Errors};
use crate::programs::read;

/// What an expansion may cost: a second or two, and more terms than anybody reads.
const LIMITS: PolynomialOptions = PolynomialOptions {
    angle_sums: AngleSums::Expand,
    max_terms: 500_000,
    max_products: 4_000_000,
};

/// Which equations, and how they are written.
#[derive(Clone, Debug, PartialEq)]
pub struct EquationOptions {
    /// The quantities, in the order in which they are wanted.
    pub kinds: Vec<Kind>,
    /// Whether the driving forces include friction, equations (4)-(5).
    pub friction: bool,
    /// Constant angles within this many radians of a multiple of π/2 become that multiple; `None`
    /// for what the robot file says, or 10⁻⁹.
    pub snap: Option<f64>,
    /// How the equations are written.
    pub notation: Notation,
}

/// How equations are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notation {
    /// Infix text that reads back: `M5*l5*qdd1*cos(q2)`.
    Text,
    /// LaTeX for math mode, with the names that the robot file gives.
    Latex(Trigonometry),
}

/// The driving forces as text, without friction.
impl Default for EquationOptions {
    fn default() -> EquationOptions {
        EquationOptions {
            kinds: vec![Kind::DrivingForce],
            friction: false,
            snap: None,
            notation: Notation::Text,
        }
    }
}

/// The equations of a robot.
#[derive(Clone, Debug)]
pub struct Equations {
    /// The robot.
    pub robot: Robot,
    /// What looks like a slip in the robot file.
    pub warnings: Diagnostics,
    /// The equations, in order.
    pub list: Vec<Equation>,
}

/// An equation: a quantity, and the expanded sum that it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Equation {
    /// The quantity in text, `F_l5.x`.
    pub name: String,
    /// The left side in the notation that was chosen.
    pub left: String,
    /// The terms of the right side; of 0 there is one term `0`. Text is one term.
    pub terms: Vec<LatexTerm>,
}

impl Equation {
    /// The right side on one line.
    #[must_use]
    pub fn right(&self) -> String {
        joined(&self.terms)
    }

    /// The right side on lines about `width` characters wide, broken before signs. A first line
    /// starts with its term, the others with a sign.
    #[must_use]
    pub fn lines(&self, width: usize) -> Vec<String> {
        lines(&self.terms, width)
    }
}

/// A sum on one line.
#[must_use]
pub fn joined(terms: &[LatexTerm]) -> String {
    let mut text = String::new();
    for (place, term) in terms.iter().enumerate() {
        text.push_str(sign(place, term.negative));
        text.push_str(&term.text);
    }
    text
}

/// A sum on lines about `width` characters wide, as [`Equation::lines`].
#[must_use]
pub fn lines(terms: &[LatexTerm], width: usize) -> Vec<String> {
    let (mut lines, mut line, mut used) = (vec![], String::new(), 0);
    for (place, term) in terms.iter().enumerate() {
        if !line.is_empty() && used + term.width > width {
            lines.push(std::mem::take(&mut line));
            used = 0;
        }
        let sign = sign(place, term.negative);
        line.push_str(if line.is_empty() { sign.trim_start() } else { sign });
        line.push_str(&term.text);
        used += term.width + 2;
    }
    lines.push(line);
    lines
}

fn sign(place: usize, negative: bool) -> &'static str {
    match (place, negative) {
        (0, false) => "",
        (0, true) => "-",
        (_, false) => " + ",
        (_, true) => " - ",
    }
}

/// Derives the quantities of the paper's iterations and expands them: products multiplied out, angle
/// sums resolved, s² replaced by 1 − c², like terms merged.
///
/// # Errors
///
/// Everything that is wrong with the file; quantities whose expanded form is too long to be of use.
pub fn equations(source: &Source, options: &EquationOptions) -> Result<Equations, Errors> {
    let described = read(source)?;
    let robot = described.robot;
    let graph = Graph::new();
    let exact = MechanismOptions::EXACT.with_snap(options.snap, &robot);
    let mechanism = Mechanism::new(&robot, &graph, &exact);
    let effects = Effects { wrench: true, friction: options.friction };
    let iterations = newton_euler(&mechanism, effects);
    let quantities: Vec<_> =
        options.kinds.iter().flat_map(|kind| iterations.quantities(*kind)).collect();
    let values: Vec<Expr<'_>> = quantities.iter().map(|quantity| quantity.value).collect();
    let failed = |reason: &dyn std::fmt::Display| Error::Equations {
        name: source.name.clone(),
        reason: reason.to_string(),
    };
    let polynomials = Polynomial::of_all(&values, &LIMITS).map_err(|error| failed(&error))?;
    let writer = Writer::new(&robot, options.notation);
    let mut list = vec![];
    for (quantity, polynomial) in quantities.iter().zip(&polynomials) {
        list.push(writer.equation(quantity.symbol, polynomial).map_err(|error| failed(&error))?);
    }
    Ok(Equations { robot, warnings: described.warnings, list })
}

/// The order of factors within a term: masses and inertias, other parameters, sines and cosines,
/// then coordinates, velocities and accelerations; each by number.
type Rank = (u8, u8, usize);

/// Writes the equations of a robot.
pub(crate) struct Writer<'r> {
    robot: &'r Robot,
    notation: Notation,
}

impl<'r> Writer<'r> {
    pub(crate) fn new(robot: &'r Robot, notation: Notation) -> Writer<'r> {
        Writer { robot, notation }
    }

    fn equation(&self, symbol: Symbol, polynomial: &Polynomial<'_>) -> Result<Equation, TooLarge> {
        let name = symbol.to_string();
        let left = match self.notation {
            Notation::Text => name.clone(),
            Notation::Latex(_) => symbol.latex(),
        };
        Ok(Equation { name, left, terms: self.terms(polynomial)? })
    }

    /// The terms of a sum; text is one term.
    pub(crate) fn terms(&self, polynomial: &Polynomial<'_>) -> Result<Vec<LatexTerm>, TooLarge> {
        let rank = |atom: Expr<'_>| self.rank(atom);
        match self.notation {
            Notation::Text => {
                let text = polynomial.to_text_by(rank)?;
                let width = text.chars().count();
                Ok(vec![LatexTerm { negative: false, text, width }])
            }
            Notation::Latex(trigonometry) => {
                let names = |name: &str| self.latex(name);
                let style = LatexStyle::new(trigonometry).with_names(&names);
                polynomial_terms(polynomial, &style, rank)
            }
        }
    }

    fn rank(&self, atom: Expr<'_>) -> Rank {
        let group = 2 * default_rank(atom);
        let View::Symbol(symbol) = atom.view() else {
            return (group, 0, 0);
        };
        let name = atom.graph().symbol_name(symbol);
        let parameters = &self.robot.parameters;
        if let Some(place) = parameters.iter().position(|parameter| parameter.name == name) {
            return (group, u8::from(!is_inertial(&parameters[place])), place);
        }
        let digits = name.trim_start_matches(|letter: char| !letter.is_ascii_digit());
        let number = digits.parse().unwrap_or_default();
        // Motions stand at the end of a term, wrenches at its beginning.
        match name.strip_suffix(digits) {
            Some("q") => (9, 0, number),
            Some("qd") => (9, 1, number),
            Some("qdd") => (9, 2, number),
            _ => (0, 0, number),
        }
    }

    /// How the robot file wants a name to be printed.
    fn latex(&self, name: &str) -> Option<String> {
        if let Some(parameter) = self.robot.parameter(name) {
            return parameter.latex.clone();
        }
        self.robot.tips().find_map(|(_, wrench)| {
            let mut names = wrench.force.iter().chain(&wrench.moment);
            wrench.latex.get(names.position(|known| known == name)?)?.clone()
        })
    }
}

/// Whether a parameter is a mass or an inertia, by its unit.
fn is_inertial(parameter: &Parameter) -> bool {
    let dimension = parameter.unit.as_ref().map(|unit| unit.dimension);
    dimension.is_some_and(|dimension| dimension.mass == 1 && dimension.time == 0)
}
