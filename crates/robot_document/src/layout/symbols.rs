//! The layouts of a robot's symbols, and formulas from expressions.

use robot_model::robot::Robot;
use robot_model::signs::check_latex;
use robot_model::variable::JointVariable;
use robot_symbolic::print::{self, ArrangedTerm};
use robot_symbolic::{Expr, Polynomial, walk};
use rustc_hash::FxHashMap;

use super::appearance::appearance;
use super::expression::Expressions;
use super::math::{Math, Symbol};
use super::{Order, Trigonometry, polynomial};
use crate::error::Error;
use crate::latex;

/// The number π and the functions that equations have, with printed forms that read as these.
const OWN: [(&str, &str); 6] = [
    ("pi", "\\pi"),
    ("sin", "\\mathrm{sin}"),
    ("cos", "\\mathrm{cos}"),
    ("tanh", "\\mathrm{tanh}"),
    ("sign", "\\mathrm{sign}"),
    ("sign", "\\mathrm{sgn}"),
];

/// The layouts of a robot's symbols and of symbols that a form of the equations defines, and the notation of sines and
/// cosines.
#[derive(Clone, Debug)]
pub struct SymbolTable {
    trigonometry: Trigonometry,
    entries: FxHashMap<String, Entry>,
    /// The names of symbols by their printed forms, except symbols that could be read as a sine or cosine.
    printed: FxHashMap<String, String>,
    /// The names of symbols that a form defines.
    defined: Vec<String>,
    /// Letters that are given for what a form defines, which no other definition may have.
    reserved: Vec<String>,
    /// Whether components of vectors are printed beside the symbols.
    has_components: bool,
}

#[derive(Clone, Debug)]
struct Entry {
    shape: Math,
    latex: String,
}

impl SymbolTable {
    /// A table in which the layout of every symbol follows from its name.
    #[must_use]
    pub fn spelled(trigonometry: Trigonometry) -> SymbolTable {
        let (entries, printed) = (FxHashMap::default(), FxHashMap::default());
        SymbolTable {
            trigonometry,
            entries,
            printed,
            defined: vec![],
            reserved: vec![],
            has_components: false,
        }
    }

    /// The coordinates, parameters and wrenches of a robot, with the layouts that its file gives.
    ///
    /// # Errors
    ///
    /// If two symbols look the same.
    pub fn new(robot: &Robot, trigonometry: Trigonometry) -> Result<SymbolTable, Error> {
        let mut table = SymbolTable::spelled(trigonometry);
        for index in 0..robot.degrees_of_freedom() {
            for variable in JointVariable::MOTION {
                table.add(&variable.symbol(index), None)?;
            }
        }
        for parameter in &robot.parameters {
            table.add(&parameter.name, parameter.latex.as_deref())?;
        }
        for (_, wrench) in robot.tips() {
            for (name, given) in wrench.components().zip(&wrench.latex) {
                table.add(name, given.as_deref())?;
            }
        }
        table.check_powers()?;
        OWN.into_iter().try_for_each(|(other, latex)| table.check_printed(other, latex))?;
        Ok(table)
    }

    /// The table for equations that contain components of vectors: `F_y^2` is one of link 2 there.
    pub(crate) fn beside_components(self, has_components: bool) -> SymbolTable {
        SymbolTable { has_components, ..self }
    }

    /// Whether a power of what is printed needs parentheses, because an exponent would be read as an index.
    pub(super) fn is_fenced_in_powers(&self, look: &Math) -> bool {
        look.has_upper_index() || self.has_components && look.is_like_component()
    }

    /// Returns an error if a symbol is printed like something else, `other`, whose LaTeX is given.
    pub(crate) fn check_printed(&self, other: &str, latex: &str) -> Result<(), Error> {
        match self.printed_as(latex) {
            Some(name) => {
                let (name, other) = (name.to_owned(), other.to_owned());
                Err(Error::Alike { name, other, latex: latex.to_owned() })
            }
            None => Ok(()),
        }
    }

    /// Returns an error if the left side of an equation or of a matrix is printed like a symbol of the robot.
    pub(crate) fn check_left_side(&self, name: &str, left: &Math) -> Result<(), Error> {
        match self.printed_as(&latex::formula(&appearance(left))) {
            Some(other) if other != name && !self.is_defined(other) => {
                let (name, other, latex) =
                    (other.to_owned(), name.to_owned(), latex::formula(left));
                Err(Error::Alike { name, other, latex })
            }
            _ => Ok(()),
        }
    }

    /// Returns an error if a symbol with a number as its upper index looks like a power of another symbol.
    fn check_powers(&self) -> Result<(), Error> {
        let mut symbols: Vec<(&String, &String)> = self.printed.iter().collect();
        symbols.sort();
        for (latex, name) in symbols {
            let Some((base, upper)) = latex.rsplit_once('^') else { continue };
            let exponent = upper.trim_start_matches('{').trim_end_matches('}');
            let is_power =
                !exponent.is_empty() && exponent.bytes().all(|byte| byte.is_ascii_digit());
            let group = base.strip_prefix('{').and_then(|base| base.strip_suffix('}'));
            let base = group.unwrap_or(base);
            if let Some(other) = self.printed.get(base).filter(|_| is_power) {
                let other = format!("{other}^{exponent}");
                return Err(Error::Alike { name: name.clone(), other, latex: latex.clone() });
            }
        }
        Ok(())
    }

    /// Adds a symbol with the layout of its LaTeX. LaTeX that could do more than print is ignored.
    fn add(&mut self, name: &str, given: Option<&str>) -> Result<(), Error> {
        let shape = match given.filter(|given| check_latex(given).is_ok()) {
            Some(given) => latex::read_symbol(given)?,
            None => Math::spelled(name),
        };
        self.insert(name, shape)
    }

    /// Defines an additional symbol.
    ///
    /// # Errors
    ///
    /// If the symbol exists already or looks like another one.
    pub fn define(&mut self, name: &str, shape: Math) -> Result<(), Error> {
        if self.entries.contains_key(name) {
            return Err(Error::Taken { name: name.to_owned() });
        }
        self.defined.push(name.to_owned());
        self.insert(name, shape)
    }

    fn insert(&mut self, name: &str, shape: Math) -> Result<(), Error> {
        let latex = latex::formula(&shape);
        let other = match self.is_like_sine(&latex) {
            true => None,
            false => self.printed.insert(latex::formula(&appearance(&shape)), name.to_owned()),
        };
        if let Some(other) = other.filter(|other| other != name) {
            return Err(Error::Alike { name: name.to_owned(), other, latex });
        }
        self.entries.insert(name.to_owned(), Entry { shape, latex });
        Ok(())
    }

    /// The notation of sines and cosines.
    #[must_use]
    pub fn trigonometry(&self) -> Trigonometry {
        self.trigonometry
    }

    /// The names and layouts of all symbols, except those that could be read as a sine or cosine.
    pub fn shapes(&self) -> impl Iterator<Item = (&str, &Math)> {
        let entry = |name: &String| self.entries.get(name).map(|entry| &entry.shape);
        self.printed.values().filter_map(move |name| Some((name.as_str(), entry(name)?)))
    }

    /// Whether a form of the equations defines the symbol.
    #[must_use]
    pub fn is_defined(&self, name: &str) -> bool {
        self.defined.iter().any(|known| known == name)
    }

    /// Whether no symbol has this name or this layout.
    pub(crate) fn is_free(&self, name: &str, shape: &Math) -> bool {
        !self.entries.contains_key(name)
            && !self.printed.contains_key(&latex::formula(&appearance(shape)))
    }

    /// Whether a symbol of the robot looks like this.
    pub(crate) fn is_shown_like(&self, shape: &Math) -> bool {
        let owner = self.printed.get(&latex::formula(&appearance(shape)));
        owner.is_some_and(|name| !self.is_defined(name))
    }

    /// Keeps letters from being chosen by [`free_letter`](Self::free_letter).
    pub(crate) fn reserve<'l>(&mut self, letters: impl Iterator<Item = &'l str>) {
        self.reserved.extend(letters.map(str::to_owned));
    }

    /// Returns the first candidate that is not reserved, is not the letter of sines or cosines, and that no symbol uses
    /// with a number as its first index, neither in text nor in print; the last one that is not reserved if all are
    /// used. An index such as x in M_x cannot be mistaken for that of M_12.
    #[must_use]
    pub fn free_letter(&self, candidates: &[&'static str]) -> &'static str {
        let free = candidates.iter().find(|letter| !self.is_taken(letter));
        let last = || candidates.iter().rfind(|letter| !self.is_reserved(letter));
        free.or_else(last).copied().unwrap_or("x")
    }

    /// Like [`free_letter`](Self::free_letter), but prefers a candidate that is not itself a symbol: a letter for a matrix
    /// or column, which is also printed without indices.
    #[must_use]
    pub fn free_letter_alone(&self, candidates: &[&'static str]) -> &'static str {
        let is_free = |letter: &str| !self.is_taken(letter) && !self.is_symbol(letter);
        let free = candidates.iter().find(|letter| is_free(letter));
        free.copied().unwrap_or_else(|| self.free_letter(candidates))
    }

    /// Whether there is a symbol of this name.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.entries.contains_key(name)
    }

    /// The name of the symbol that is printed as this LaTeX.
    pub(crate) fn printed_as(&self, latex: &str) -> Option<&str> {
        self.printed.get(latex).map(String::as_str)
    }

    /// Whether a letter is the name or the layout of a symbol.
    #[must_use]
    pub fn is_symbol(&self, letter: &str) -> bool {
        let is_letter = |text: &str| text.trim_start_matches('\\') == letter;
        self.entries.iter().any(|(name, entry)| is_letter(name) || is_letter(&entry.latex))
    }

    fn is_reserved(&self, letter: &str) -> bool {
        self.reserved.iter().any(|reserved| reserved == letter)
    }

    fn is_taken(&self, letter: &str) -> bool {
        self.is_reserved(letter)
            || self.is_letter_of_sines(letter)
            || self.is_letter_of_symbol(letter)
    }

    /// Whether the letter with an index would read as a sine or a cosine.
    pub(crate) fn is_letter_of_sines(&self, letter: &str) -> bool {
        self.trigonometry != Trigonometry::Named && matches!(letter, "s" | "c")
    }

    /// Whether there are symbols of [`symbols_with_letter`](Self::symbols_with_letter).
    fn is_letter_of_symbol(&self, letter: &str) -> bool {
        self.symbols_with_letter(letter).next().is_some()
    }

    /// The names of the symbols that are the letter with a number in text, or the letter with a number as lower index or
    /// with any upper index in print.
    pub(crate) fn symbols_with_letter<'s>(
        &'s self,
        letter: &'s str,
    ) -> impl Iterator<Item = &'s str> {
        let is_number = |tail: &str| {
            tail.trim_start_matches(['_', '{']).starts_with(|c: char| c.is_ascii_digit())
        };
        let has_letter = move |name: &str, latex: &str| {
            let tail = name.strip_prefix(letter);
            tail.is_some_and(is_number)
                || latex.trim_start_matches('\\').strip_prefix(letter).is_some_and(|tail| {
                    tail.starts_with('^') || tail.starts_with('_') && is_number(tail)
                })
        };
        let entries = self.entries.iter();
        entries
            .filter(move |(name, one)| has_letter(name, &one.latex))
            .map(|(name, _)| name.as_str())
    }

    /// The layout of a symbol; if the table does not contain it, the layout follows from its name.
    #[must_use]
    pub fn look(&self, name: &str) -> Math {
        let known = self.entries.get(name).map(|entry| entry.shape.clone());
        let shape = Box::new(known.unwrap_or_else(|| Math::spelled(name)));
        Math::Symbol(Symbol { name: name.to_owned(), shape })
    }

    /// The layout of a polynomial as a sum of terms.
    ///
    /// # Errors
    ///
    /// If a symbol looks like a sine or cosine, or if an argument is too long to be written out.
    pub fn polynomial(&self, value: &Polynomial<'_>, order: &Order<'_>) -> Result<Math, Error> {
        self.terms(&value.arranged(|atom| order.rank(atom)))
    }

    /// The layout of a sum of terms.
    ///
    /// # Errors
    ///
    /// If a symbol looks like a sine or cosine, or if an argument is too long to be written out.
    pub fn terms(&self, terms: &[ArrangedTerm<'_>]) -> Result<Math, Error> {
        self.check(&print::atoms(terms))?;
        polynomial::sum(terms, self)
    }

    /// The layout of an expression in the structure in which it was built.
    ///
    /// # Errors
    ///
    /// If a symbol looks like a sine or cosine, or if the expression is too long to be written out.
    pub fn expression(&self, value: Expr<'_>) -> Result<Math, Error> {
        self.check(&[value])?;
        Ok(Math::row(Expressions(self).pieces(value)?))
    }

    /// Returns an error for a symbol that could be read as a sine or cosine.
    fn check(&self, values: &[Expr<'_>]) -> Result<(), Error> {
        for value in values {
            for symbol in walk::symbols(&[*value]) {
                let name = value.graph().symbol_name(symbol);
                let latex = self.entries.get(&name).map(|entry| &entry.latex);
                if let Some(latex) = latex.filter(|latex| self.is_like_sine(latex)) {
                    return Err(Error::LikeSine { name, latex: latex.clone() });
                }
            }
        }
        Ok(())
    }

    fn is_like_sine(&self, latex: &str) -> bool {
        match self.trigonometry {
            Trigonometry::Named => false,
            Trigonometry::Short => latex.starts_with("s_") || latex.starts_with("c_"),
            Trigonometry::Paper => {
                let is_of_joint = |sine| latex.starts_with(&format!("\\mathrm{{{sine}}}_"));
                matches!(latex, "s" | "c") || is_of_joint("sq") || is_of_joint("cq")
            }
        }
    }
}
