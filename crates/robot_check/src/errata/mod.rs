//! Errata: compares published equations with derived ones, term by term.
//!
//! Terms have no order, and like terms may be printed separately, so equations are compared as sets of canonical terms.
//! Of the terms that differ, each printed one is paired with the derived term that it resembles most. Each difference
//! is reported with the kind of mistake and with evidence that does not depend on the derivation: the dimension of the
//! printed term, and other printed equations in which the derived term occurs.

mod dimension;
mod entries;
mod evidence;
mod half_angles;
mod latex;
mod left_side;
mod mistake;
mod order;
mod printed;
#[cfg(test)]
mod refused;
mod rounding;
#[cfg(test)]
mod spoiled;
mod symbols;
mod term;
#[cfg(test)]
mod tests;
mod unprinted;
mod unread;

use std::collections::{BTreeMap, BTreeSet};

use robot_model::functions::Effects;
use robot_symbolic::{AngleSums, Expr, Formula, Function, Graph, PolynomialOptions, View, walk};

use dimension::Dimensions;
pub use evidence::Evidence;
use evidence::PrintedTerms;
pub use mistake::{Mistake, MistakeKind};
pub use order::term_order;
pub use printed::Notation;
use printed::{PrintedEquation, read_printed};
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_dynamics::newton_euler;
use robot_dynamics::quantity::{Kind, Quantity};
use robot_model::diagnostic::{Diagnostic, Diagnostics, Source, code};
use robot_model::robot::Robot;
use robot_model::unit::Dimension;
use symbols::Symbols;
use term::Term;

/// The limits of an expansion, which takes a second or two.
const LIMITS: PolynomialOptions = PolynomialOptions {
    angle_sums: AngleSums::Expand,
    max_terms: 500_000,
    max_products: 4_000_000,
};

/// The number of terms that printed equations may have together, multiplied out. They may also have four times as many
/// as the derived ones.
const MAX_PRINTED: usize = 100_000;

/// The maximum number of printed equations for each quantity of the robot, on average.
const MAX_REPEATED: usize = 8;

/// The maximum number of printed terms that are not among the derived ones; more are those of another robot.
const MAX_WRONG: usize = 50_000;

/// The maximum number of pairs of a wrong printed term and a missing derived term that are compared for one equation.
const MAX_PAIRS: usize = 2_000_000;

/// The options of a comparison.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// The notation. If it is `None`, [`Notation::detect`] determines it.
    pub notation: Option<Notation>,
    /// The tolerance within which a constant angle becomes a multiple of π/2, rad. If it is `None`, that of the robot
    /// file, or 10⁻⁹.
    pub snap: Option<f64>,
}

/// A difference between the printed and the derived equations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The printed number of the equation.
    pub number: String,
    /// The quantity, such as `M_l4.z`.
    pub quantity: String,
    /// The line of the equation in the file.
    pub line: usize,
    /// The printed term in canonical form; `None` if a derived term is not printed.
    pub printed: Option<String>,
    /// The derived term in canonical form; `None` if a printed term has no counterpart.
    pub derived: Option<String>,
    /// The derived term that a printed term without a counterpart resembles most.
    pub nearest: Option<String>,
    /// The mistakes that turn the derived term into the printed one; never empty.
    pub mistakes: Vec<Mistake>,
    /// Evidence against the printed term or for the derived one, which does not depend on the derivation.
    pub evidence: Vec<Evidence>,
}

/// The result of a comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comparison {
    /// The number of equations that were compared.
    pub equations: usize,
    /// The number of these equations that only name another quantity.
    pub names: usize,
    /// The number of printed terms in the other equations, after parentheses are expanded.
    pub terms: usize,
    /// Whether the derived equations contain the wrenches of the tips: this is the case if any printed one does.
    pub wrench: bool,
    /// The number of derived coefficients that agree with the printed decimals only to the digits printed.
    pub rounded: usize,
    /// The lines, counted from 1, of equations that are not compared because they are outside of the displays that are
    /// read.
    pub unread: Vec<usize>,
    /// The differences, in the order of the printed equations.
    pub differences: Vec<Difference>,
}

/// Compares printed equations with the paper's iterations for a robot. Friction is not included, and the wrenches of
/// tips are only included if one of the equations contains one of their symbols.
///
/// An equation is `(number) quantity = terms`; the number is optional. In infix text, it is on one line, which indented
/// lines may continue; `#` begins a comment. In LaTeX, it is also on one line, or in a display (`equation`,
/// `align` …), in which case all other text is ignored; a vector may be a column of three rows.
///
/// # Errors
///
/// Everything that cannot be read, with its place; quantities that the robot does not have; equations that are too long
/// to be compared term by term.
pub fn compare(
    robot: &Robot,
    source: &Source,
    options: &Options,
) -> Result<Comparison, Diagnostics> {
    let failed = |errors: Vec<Diagnostic>| Diagnostics::new(source.clone(), errors);
    let graph = Graph::new();
    let exact = MechanismOptions::EXACT.with_snap(options.snap, robot);
    let mechanism = Mechanism::new(robot, &graph, &exact);
    let (printed, unread) = read(robot, source, options, &mechanism).map_err(failed)?;
    let wrench = has_wrench(robot, &printed);
    let quantities: BTreeMap<String, Quantity<'_>> = quantities(&mechanism, wrench)
        .into_iter()
        .map(|quantity| (quantity.symbol.to_string(), quantity))
        .collect();
    let compared = expand(&graph, &printed, &quantities).map_err(|error| failed(vec![*error]))?;
    let lines = Lines::of(&source.text);
    let (rounded, differences) = find(&compared, &Dimensions::of(robot), &lines).map_err(failed)?;
    let terms = compared.iter().filter(|one| !one.is_name).map(|one| one.print.len()).sum();
    Ok(Comparison {
        equations: compared.len(),
        names: compared.iter().filter(|one| one.is_name).count(),
        terms,
        wrench,
        rounded,
        unread: unread.into_iter().map(|place| lines.at(place)).collect(),
        differences,
    })
}

/// All quantities by the paper's iterations, without friction.
fn quantities<'g>(mechanism: &Mechanism<'g>, wrench: bool) -> Vec<Quantity<'g>> {
    let solution = newton_euler::newton_euler(mechanism, Effects { wrench, friction: false });
    Kind::ALL.iter().flat_map(|kind| solution.quantities(*kind)).collect()
}

/// Reads the printed equations; all must be equations of quantities that the robot has. Also returns the places of
/// equations that are not read.
fn read(
    robot: &Robot,
    source: &Source,
    options: &Options,
    mechanism: &Mechanism<'_>,
) -> Result<(Vec<PrintedEquation>, Vec<usize>), Vec<Diagnostic>> {
    let quantities = quantities(mechanism, true);
    let values: Vec<Expr<'_>> = quantities.iter().map(|quantity| quantity.value).collect();
    let used = walk::symbols(&values).into_iter();
    let used = used.map(|symbol| mechanism.graph.symbol_name(symbol)).collect();
    let names: Vec<_> = quantities.iter().map(|quantity| quantity.symbol).collect();
    let notation = options.notation.unwrap_or_else(|| Notation::detect(&source.text));
    let symbols = Symbols::of(robot, &names, used);
    let printed = read_printed(source, notation, &symbols)?;
    if let Some(further) = printed.get(MAX_REPEATED * names.len()) {
        return Err(vec![left_side::too_many(further, MAX_REPEATED)]);
    }
    let known: BTreeSet<String> = names.iter().map(ToString::to_string).collect();
    let unknown = printed.iter().filter(|equation| !known.contains(&equation.quantity));
    let unknown = unknown.map(|equation| left_side::unknown(equation, robot));
    let empty = printed.iter().filter(|equation| left_side::is_repeated(equation));
    let empty = empty.map(left_side::repeated);
    let wrong: Vec<Diagnostic> = unknown.chain(empty).collect();
    let unread = match notation {
        Notation::Latex => unread::unread(&source.text, &symbols),
        Notation::Text => vec![],
    };
    if wrong.is_empty() { Ok((printed, unread)) } else { Err(wrong) }
}

/// Whether any equation contains a symbol of a tip's wrench.
fn has_wrench(robot: &Robot, printed: &[PrintedEquation]) -> bool {
    let names: BTreeSet<&str> = robot.tips().flat_map(|(_, wrench)| wrench.components()).collect();
    let terms = printed.iter().flat_map(|equation| &equation.terms);
    terms.flat_map(Formula::symbols).any(|(name, _)| names.contains(name))
}

/// A printed equation with the derived one.
#[derive(Clone)]
struct Compared<'p, 'g> {
    equation: &'p PrintedEquation,
    dimension: Dimension,
    print: Vec<Term<'g>>,
    derived: Vec<Term<'g>>,
    /// Whether the printed equation only names another quantity; its terms are then not counted as printed terms.
    is_name: bool,
}

/// A printed term as an expression.
fn lowered<'g>(term: &Formula, graph: &'g Graph) -> Expr<'g> {
    term.lower(graph, &mut |name| graph.symbol(&symbols::in_text(name)))
}

/// The terms of every equation, printed and derived.
fn expand<'p, 'g>(
    graph: &'g Graph,
    printed: &'p [PrintedEquation],
    quantities: &BTreeMap<String, Quantity<'g>>,
) -> Result<Vec<Compared<'p, 'g>>, Box<Diagnostic>> {
    let wanted: BTreeSet<&str> =
        printed.iter().map(|equation| equation.quantity.as_str()).collect();
    let wanted: Vec<&Quantity<'g>> =
        wanted.into_iter().filter_map(|name| quantities.get(name)).collect();
    let values: Vec<Expr<'g>> = wanted.iter().map(|quantity| quantity.value).collect();
    let half_angles = half_angles::of(&values);
    let derived = term::terms_of(&values, &LIMITS).map_err(|_| {
        Diagnostic::error(
            code::LIMIT,
            "the derived equations are too long to be compared term \
            by term",
        )
        .help("compare fewer: those of the last joints are the shortest")
    })?;
    let derived: BTreeMap<String, Vec<Term<'g>>> =
        wanted.iter().map(|quantity| quantity.symbol.to_string()).zip(derived).collect();
    let mut values = vec![];
    let mut compared = vec![];
    for equation in printed {
        let Some(quantity) = quantities.get(&equation.quantity) else { continue };
        // A right side that is the name of another quantity stands for that quantity.
        let named = match equation.terms.as_slice() {
            [alone] => quantities.get(&*symbols::in_text(alone.text().trim())),
            _ => None,
        };
        let first = values.len();
        half_angles::refuse(equation, &half_angles, graph)?;
        values.extend(equation.terms.iter().map(|term| match named {
            Some(quantity) => quantity.value,
            None => lowered(term, graph),
        }));
        let derived = derived.get(&equation.quantity).cloned().unwrap_or_default();
        let (dimension, is_name) = (quantity.dimension, named.is_some());
        let one = Compared { equation, dimension, print: vec![], derived, is_name };
        compared.push((one, first..values.len()));
    }
    let mut room = MAX_PRINTED.max(4 * derived.values().map(Vec::len).sum::<usize>());
    let expanded = |(one, range): (Compared<'p, 'g>, std::ops::Range<usize>)| {
        let limits = PolynomialOptions { max_terms: room, ..LIMITS };
        let own = term::terms_of(values.get(range).unwrap_or_default(), &limits).ok();
        let own = own.filter(|own| own.iter().map(Vec::len).sum::<usize>() <= room);
        let own = own.ok_or_else(|| too_long(one.equation))?;
        let own = own.into_iter().zip(&one.equation.terms);
        let print: Vec<_> = own.flat_map(|(terms, formula)| rounded(terms, formula)).collect();
        room = room.saturating_sub(print.len());
        let Some((written_out, is_all)) = in_symbols(&one, &print, quantities) else {
            return Ok(one.with_print(print));
        };
        if is_all {
            return Ok(Compared { is_name: true, ..one.with_print(written_out) });
        }
        // If as many terms differ then, the name is the mistake.
        let [named, written_out] = [print, written_out].map(|print| one.clone().with_print(print));
        Ok(if written_out.differing() < named.differing() { written_out } else { named })
    };
    compared.into_iter().map(expanded).collect()
}

/// The printed terms of an equation in which other quantities of the same dimension, as in `Q1 = Q2 + …`, are replaced by
/// their derived terms, and whether all printed terms are such quantities, as in `Q1 = -2*Q2`. `None` if there are no such
/// quantities, or if the terms would be too many.
fn in_symbols<'g>(
    one: &Compared<'_, 'g>,
    print: &[Term<'g>],
    quantities: &BTreeMap<String, Quantity<'g>>,
) -> Option<(Vec<Term<'g>>, bool)> {
    let quantity = |term: &Term<'g>| {
        let [power] = term.factors.as_slice() else { return None };
        let symbol = power.atom.as_symbol().filter(|_| power.exponent == 1)?;
        let name = power.atom.graph().symbol_name(symbol);
        let known = quantities.get(&name).filter(|_| name != one.equation.quantity)?;
        (known.dimension == one.dimension).then_some(known.value)
    };
    let count = print.iter().filter(|term| quantity(term).is_some()).count();
    if count == 0 {
        return None;
    }
    let mut written_out = vec![];
    for term in print {
        match quantity(term) {
            Some(value) => {
                let product = value * value.graph().number(term.coefficient.clone());
                let terms = term::terms_of(&[product], &LIMITS).ok()?;
                written_out.extend(terms.into_iter().flatten());
            }
            None => written_out.push(term.clone()),
        }
        if written_out.len() > MAX_PRINTED {
            return None;
        }
    }
    Some((written_out, count == print.len()))
}

fn too_long(equation: &PrintedEquation) -> Box<Diagnostic> {
    let message = "the printed equations up to this one are too long, multiplied out";
    let error = Diagnostic::error(code::LIMIT, message).at(&equation.span, "");
    let help = "check that the equations are of this robot; leave out the longest, or compare each in a file of its own";
    Box::new(error.help(help))
}

/// The terms of a printed formula, with the errors of their coefficients.
fn rounded<'g>(mut terms: Vec<Term<'g>>, formula: &Formula) -> Vec<Term<'g>> {
    let Some(share) = rounding::of_formula(formula) else { return terms };
    for term in &mut terms {
        let error = &share * &term.coefficient;
        term.rounding = Some(if error.is_negative() { -&error } else { error });
    }
    terms
}

/// The number of coefficients that agree only to the digits printed, and all differences, or errors for the equations
/// that have too many.
fn find(
    compared: &[Compared<'_, '_>],
    dimensions: &Dimensions,
    lines: &Lines,
) -> Result<(usize, Vec<Difference>), Vec<Diagnostic>> {
    let mut printed = PrintedTerms::default();
    for one in compared.iter().filter(|one| !one.is_name) {
        printed.insert(one.name(), &one.print);
    }
    let derived = compared.iter().map(|one| (one.derived.as_slice(), one.dimension));
    let has_units = dimensions.terms_have_units(derived);
    let friction =
        dimensions.of_friction_alone(compared.iter().flat_map(|one| one.derived.as_slice()));
    let known = Known { printed, dimensions, has_units, friction };
    let (mut wrong, mut rounded, mut differences, mut errors) = (0, 0, vec![], vec![]);
    for one in compared {
        let left = term::leftover(&one.print, &one.derived);
        wrong += left.wrong.len();
        if wrong > MAX_WRONG || left.wrong.len().saturating_mul(one.derived.len()) > MAX_PAIRS {
            errors.push(too_different(one, left.wrong.len()));
            continue;
        }
        rounded += left.rounded;
        for (printed, derived) in term::pair(left.wrong, left.missing) {
            let pair = (printed.as_ref(), derived.as_ref());
            differences.push(one.difference(pair, &known, lines));
        }
    }
    if errors.is_empty() { Ok((rounded, differences)) } else { Err(errors) }
}

fn too_different(one: &Compared<'_, '_>, wrong: usize) -> Diagnostic {
    let (print, derived) = (one.print.len(), one.derived.len());
    let message =
        format!("{wrong} of {print} printed terms are not among the {derived} derived terms");
    let error = Diagnostic::error(code::LIMIT, message).at(&one.equation.span, "");
    error.help("check that the equation is one of this robot, in the same frames")
}

/// What evidence is found with.
struct Known<'d> {
    printed: PrintedTerms,
    dimensions: &'d Dimensions,
    /// Whether the dimension of a term is that of its symbols.
    has_units: bool,
    /// The symbols that only friction has.
    friction: BTreeSet<String>,
}

impl Known<'_> {
    /// Whether a term is one of friction: whether it has the sign of a velocity or a symbol of friction alone.
    fn is_of_friction(&self, term: &Term<'_>) -> bool {
        let atoms: Vec<Expr<'_>> = term.factors.iter().map(|factor| factor.atom).collect();
        walk::reachable(&atoms).into_iter().any(|part| match part.view() {
            View::Symbol(symbol) => self.friction.contains(&*part.graph().symbol_name(symbol)),
            View::Call(function, _) => matches!(function, Function::Sign | Function::Tanh),
            _ => false,
        })
    }

    /// The evidence from the units of a printed term, or the symbols that have none.
    fn of_units(&self, term: &Term<'_>, expected: Dimension) -> Vec<Evidence> {
        let of_symbol = |symbol: String| match evidence::is_quantity(&symbol) {
            true => Evidence::OtherQuantity(symbol),
            false => Evidence::UnknownSymbol(symbol),
        };
        match self.dimensions.of_term(term) {
            Ok(Some(printed)) if printed != expected && self.has_units => {
                vec![Evidence::Dimension { printed, expected }]
            }
            Ok(_) => vec![],
            Err(symbols) => symbols.into_iter().map(of_symbol).collect(),
        }
    }
}

impl<'g> Compared<'_, 'g> {
    /// The equation with these printed terms, and with the derived terms as these are printed.
    fn with_print(self, print: Vec<Term<'g>>) -> Self {
        let derived = term::noted_like(self.derived, &print);
        Compared { print, derived, ..self }
    }

    /// The number of terms that differ.
    fn differing(&self) -> usize {
        let left = term::leftover(&self.print, &self.derived);
        left.wrong.len() + left.missing.len()
    }

    /// The name of the equation, such as `(31) F_l5.x`.
    fn name(&self) -> String {
        match self.equation.number.as_str() {
            "" => self.equation.quantity.clone(),
            number => format!("({number}) {}", self.equation.quantity),
        }
    }

    fn difference(
        &self,
        (printed, derived): (Option<&Term<'g>>, Option<&Term<'g>>),
        known: &Known<'_>,
        lines: &Lines,
    ) -> Difference {
        let units = match printed.filter(|term| known.is_of_friction(term)) {
            Some(_) => vec![Evidence::Friction],
            None => printed.map_or_else(Vec::new, |term| known.of_units(term, self.dimension)),
        };
        let same = derived.and_then(|term| known.printed.support(term, &self.name()));
        let nearest = match (printed, derived) {
            (Some(term), None) if units != [Evidence::Friction] => term.nearest(&self.derived),
            _ => None,
        };
        Difference {
            number: self.equation.number.clone(),
            quantity: self.equation.quantity.clone(),
            line: lines.at(self.equation.span.start),
            printed: printed.map(Term::to_string),
            derived: derived.map(Term::to_string),
            nearest: nearest.map(Term::to_string),
            mistakes: mistake::mistakes(printed, derived),
            evidence: units.into_iter().chain(same).collect(),
        }
    }
}

/// The bytes at which the lines of a text begin.
struct Lines(Vec<usize>);

impl Lines {
    fn of(text: &str) -> Lines {
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        Lines(std::iter::once(0).chain(ends.map(|(place, _)| place + 1)).collect())
    }

    /// The line of a byte, counted from 1.
    fn at(&self, byte: usize) -> usize {
        self.0.partition_point(|start| *start <= byte)
    }
}
