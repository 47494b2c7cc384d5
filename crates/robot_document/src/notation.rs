//! How the symbols of a robot look, and formulas made of expressions.

use robot_model::robot::Robot;
use robot_symbolic::print::latex::{
    LatexStyle, LatexTerm, Trigonometry, polynomial_terms, to_latex,
};
use robot_symbolic::{Expr, Polynomial, walk};
use rustc_hash::FxHashMap;

use crate::error::Error;
use crate::latex::{self, Symbols, read_name};
use crate::math::{Math, Symbol};
use crate::order::Order;

/// The look of a robot's symbols, of further ones that a form of the equations defines, and of sines
/// and cosines.
#[derive(Clone, Debug)]
pub struct Notation {
    trigonometry: Trigonometry,
    latex: FxHashMap<String, String>,
    symbols: Symbols,
    /// The names of symbols that a form defines.
    defined: Vec<String>,
}

impl Notation {
    /// The robot's coordinates, parameters and wrenches as its file wants them to look.
    ///
    /// # Errors
    ///
    /// Two symbols that look alike.
    pub fn new(robot: &Robot, trigonometry: Trigonometry) -> Result<Notation, Error> {
        let mut notation = Notation {
            trigonometry,
            latex: FxHashMap::default(),
            symbols: Symbols::default(),
            defined: vec![],
        };
        for number in 1..=robot.degrees_of_freedom() {
            for prefix in ["q", "qd", "qdd"] {
                notation.add(&format!("{prefix}{number}"), None)?;
            }
        }
        for parameter in &robot.parameters {
            notation.add(&parameter.name, parameter.latex.as_deref())?;
        }
        for (_, wrench) in robot.tips() {
            let names = wrench.force.iter().chain(&wrench.moment);
            for (name, given) in names.zip(&wrench.latex) {
                notation.add(name, given.as_deref())?;
            }
        }
        Ok(notation)
    }

    fn add(&mut self, name: &str, given: Option<&str>) -> Result<(), Error> {
        let given = |_: &str| given.map(str::to_owned);
        let latex = LatexStyle::default().with_names(&given).symbol(name);
        self.insert(name, read_name(&latex)?)
    }

    /// Defines a further symbol.
    ///
    /// # Errors
    ///
    /// A symbol that there is already, or that looks like another one.
    pub fn define(&mut self, name: &str, shape: Math) -> Result<(), Error> {
        if self.latex.contains_key(name) {
            return Err(Error::Taken { name: name.to_owned() });
        }
        self.defined.push(name.to_owned());
        self.insert(name, shape)
    }

    fn insert(&mut self, name: &str, shape: Math) -> Result<(), Error> {
        let latex = latex::formula(&shape);
        if self.is_like_sine(&latex) {
            // Read back it would hide the sine.
            self.latex.insert(name.to_owned(), latex);
            return Ok(());
        }
        let symbol = Symbol { name: name.to_owned(), shape: Box::new(shape) };
        match self.symbols.insert(&latex, symbol) {
            Some(other) => Err(Error::Alike { name: name.to_owned(), other, latex }),
            None => {
                self.latex.insert(name.to_owned(), latex);
                Ok(())
            }
        }
    }

    /// How sines and cosines look.
    #[must_use]
    pub fn trigonometry(&self) -> Trigonometry {
        self.trigonometry
    }

    /// The symbols by their LaTeX.
    #[must_use]
    pub fn symbols(&self) -> &Symbols {
        &self.symbols
    }

    /// Whether a form of the equations defines the symbol.
    #[must_use]
    pub fn is_defined(&self, name: &str) -> bool {
        self.defined.iter().any(|known| known == name)
    }

    /// A letter that no symbol has with an index, neither in text nor in print; the last one where
    /// all are taken.
    #[must_use]
    pub fn free_letter(&self, candidates: &[&'static str]) -> &'static str {
        let taken = |letter: &str| {
            let sine = self.trigonometry != Trigonometry::Named && matches!(letter, "s" | "c");
            sine || self.latex.iter().any(|(name, latex)| {
                let tail = name.strip_prefix(letter);
                tail.is_some_and(|tail| tail.starts_with(|c: char| c.is_ascii_digit() || c == '_'))
                    || latex.strip_prefix(letter).is_some_and(|tail| tail.starts_with(['_', '^']))
            })
        };
        let free = candidates.iter().find(|letter| !taken(letter));
        free.or(candidates.last()).copied().unwrap_or("x")
    }

    /// The look of a symbol, alone.
    ///
    /// # Errors
    ///
    /// None for symbols of the robot and of the form.
    pub fn symbol(&self, name: &str) -> Result<Math, Error> {
        Ok(latex::read(self.latex.get(name).map_or(name, String::as_str), &self.symbols)?)
    }

    /// The sum that a polynomial is.
    ///
    /// # Errors
    ///
    /// A symbol that looks like a sine; an argument that is too long to be written out.
    pub fn polynomial(&self, value: &Polynomial<'_>, order: &Order<'_>) -> Result<Math, Error> {
        let names = |name: &str| self.latex.get(name).cloned();
        let style = LatexStyle::new(self.trigonometry).with_names(&names);
        self.check(&value.atoms())?;
        let mut pieces = vec![];
        for (place, term) in
            polynomial_terms(value, &style, |atom| order.rank(atom))?.iter().enumerate()
        {
            let LatexTerm { negative, text } = term;
            match (place, negative) {
                (0, false) => {}
                (_, true) => pieces.push(Math::Sign('-')),
                (_, false) => pieces.push(Math::Sign('+')),
            }
            pieces.extend(latex::read(text, &self.symbols)?.pieces().iter().cloned());
        }
        Ok(Math::row(pieces))
    }

    /// An expression as it is built.
    ///
    /// # Errors
    ///
    /// A symbol that looks like a sine; an expression that is too long to be written out.
    pub fn expression(&self, value: Expr<'_>) -> Result<Math, Error> {
        let names = |name: &str| self.latex.get(name).cloned();
        let style = LatexStyle::new(self.trigonometry).with_names(&names);
        self.check(&[value])?;
        Ok(latex::read(&to_latex(value, &style)?, &self.symbols)?)
    }

    /// Refuses symbols that would read as sines and cosines.
    fn check(&self, values: &[Expr<'_>]) -> Result<(), Error> {
        for value in values {
            for symbol in walk::symbols(&[*value]) {
                let name = value.graph().symbol_name(symbol);
                if let Some(latex) = self.latex.get(&name).filter(|latex| self.is_like_sine(latex))
                {
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
            Trigonometry::Paper => latex == "s" || latex == "c",
        }
    }
}
