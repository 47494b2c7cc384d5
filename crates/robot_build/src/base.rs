//! From the text of a robot file to its base parameters, as text and LaTeX.

use robot_dynamics::base_parameters::{
    BaseParameter, BaseParameters, StandardParameter, base_parameters, out_of_reach,
};
use robot_dynamics::diagnostic::{Diagnostics, Source};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_dynamics::model::Robot;
use robot_symbolic::print::TooLarge;
use robot_symbolic::print::latex::LatexTerm;
use robot_symbolic::{AngleSums, Expr, Graph, Polynomial, PolynomialOptions};

use crate::equations::{Notation, Writer, joined};
use crate::error::{Error, Errors};
use crate::programs::read;

/// What expansions may cost: more terms than anybody reads.
const LIMITS: PolynomialOptions =
    PolynomialOptions { angle_sums: AngleSums::Expand, max_terms: 20_000, max_products: 1_000_000 };

/// The base parameters of a robot, written.
#[derive(Clone, Debug)]
pub struct BaseSet {
    /// The robot.
    pub robot: Robot,
    /// What looks like a slip in the robot file.
    pub warnings: Diagnostics,
    /// The names of the standard parameters, in the order of the full regressor's columns.
    pub standard: Vec<String>,
    /// The base parameters, in the order of their columns.
    pub list: Vec<BaseEntry>,
    /// Whether figures are rounded, see [`BaseParameters::rounded`].
    pub rounded: bool,
}

/// A base parameter, written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BaseEntry {
    /// The name in text, `ZZR_2`.
    pub name: String,
    /// The name in the notation that was chosen.
    pub left: String,
    /// The column of the full regressor that is this one's.
    pub column: usize,
    /// The formula in standard parameters: those with one figure stand in one term.
    pub formula: Vec<LatexTerm>,
    /// The figure of each standard parameter by its place, as text that reads back.
    pub figures: Vec<(usize, String)>,
    /// The value in the file's parameters.
    pub value: Vec<LatexTerm>,
}

/// Finds the base parameters of a robot and writes their formulas.
///
/// # Errors
///
/// Everything that is wrong with the file; a robot whose base parameters are out of reach; formulas that
/// are too long to be of use.
pub fn base(source: &Source, snap: Option<f64>, notation: Notation) -> Result<BaseSet, Errors> {
    let described = read(source)?;
    let robot = described.robot;
    let failed = |reason: &dyn std::fmt::Display| {
        Errors::from(Error::Equations { name: source.name.clone(), reason: reason.to_string() })
    };
    let graph = Graph::new();
    let options = MechanismOptions::EXACT.with_snap(snap, &robot);
    let derivation = Derivation::new(&robot, &graph, &options, None);
    let Some(found) = base_parameters(&derivation) else {
        return Err(failed(&out_of_reach(&robot).unwrap_or_default()));
    };
    let values = Polynomial::of_all(&found.nominal(), &LIMITS).map_err(|error| failed(&error))?;
    let writer = Writer::new(&robot, notation);
    let mut list = vec![];
    for (parameter, value) in found.base.iter().zip(&values) {
        let figures: Vec<Expr<'_>> = parameter.terms.iter().map(|(_, figure)| *figure).collect();
        let figures = Polynomial::of_all(&figures, &LIMITS).map_err(|error| failed(&error))?;
        let entry = entry(&writer, notation, &found, parameter, &figures);
        let mut entry = entry.map_err(|error| failed(&error))?;
        entry.value = writer.terms(value).map_err(|error| failed(&error))?;
        list.push(entry);
    }
    let standard = found.standard.iter().map(|(parameter, _)| parameter.name()).collect();
    let rounded = found.rounded;
    Ok(BaseSet { warnings: described.warnings, standard, list, rounded, robot })
}

fn entry(
    writer: &Writer<'_>,
    notation: Notation,
    found: &BaseParameters<'_>,
    parameter: &BaseParameter<'_>,
    figures: &[Polynomial<'_>],
) -> Result<BaseEntry, TooLarge> {
    let latex = notation != Notation::Text;
    let name = |standard: StandardParameter| {
        if latex { standard.latex() } else { standard.name() }
    };
    // The kept one comes first; those with one figure stand together.
    let mut groups: Vec<(LatexTerm, Vec<String>)> = vec![];
    let mut places: Vec<usize> = (0..figures.len()).collect();
    places.sort_by_key(|place| parameter.terms[*place].0 != parameter.column);
    for place in places {
        let standard = name(found.standard[parameter.terms[place].0].0);
        let factor = factor(writer, &figures[place], latex)?;
        match groups.iter_mut().find(|(known, _)| *known == factor) {
            Some((_, names)) => names.push(standard),
            None => groups.push((factor, vec![standard])),
        }
    }
    let mut texts = vec![];
    for ((column, _), figure) in parameter.terms.iter().zip(figures) {
        texts.push((*column, figure.to_text()?));
    }
    Ok(BaseEntry {
        name: parameter.name(),
        left: if latex { parameter.latex() } else { parameter.name() },
        column: parameter.column,
        formula: groups
            .into_iter()
            .map(|(factor, names)| product(&factor, &names, latex))
            .collect(),
        figures: texts,
        value: vec![],
    })
}

/// A figure as a factor: nothing for 1, sums in parentheses.
fn factor(
    writer: &Writer<'_>,
    figure: &Polynomial<'_>,
    latex: bool,
) -> Result<LatexTerm, TooLarge> {
    let terms = writer.terms(figure)?;
    let width = terms.iter().map(|term| term.width + 3).sum();
    let text = joined(&terms);
    if figure.len() > 1 {
        let text = if latex { format!(r"\left({text}\right)") } else { format!("({text})") };
        return Ok(LatexTerm { negative: false, text, width });
    }
    let (negative, magnitude) = match text.strip_prefix('-') {
        Some(magnitude) => (true, magnitude),
        None => (false, text.as_str()),
    };
    let text = if magnitude == "1" { String::new() } else { magnitude.to_owned() };
    Ok(LatexTerm { negative, text, width })
}

/// The figure times the sum of the names.
fn product(factor: &LatexTerm, names: &[String], latex: bool) -> LatexTerm {
    let sum = names.join(" + ");
    let sum = match (names, latex, factor.text.is_empty() && !factor.negative) {
        ([_], ..) | (_, _, true) => sum,
        (_, true, false) => format!(r"\left({sum}\right)"),
        (_, false, false) => format!("({sum})"),
    };
    let between = match (factor.text.is_empty(), latex) {
        (true, _) => "",
        (false, true) => " ",
        (false, false) => "*",
    };
    let width = factor.width + 6 * names.len();
    LatexTerm { negative: factor.negative, text: format!("{}{between}{sum}", factor.text), width }
}
