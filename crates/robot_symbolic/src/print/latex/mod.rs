//! LaTeX of expressions and polynomials, for math mode.
//!
//! Names reach LaTeX in one of two ways: spelt by [`symbol_latex`] from letters and digits, all else
//! escaped; or as LaTeX of the caller's that [`check_name`] lets pass (subscripts, accents, Greek:
//! nothing that could do more than print). Names that it refuses are spelt.

mod check;
mod expression;
mod names;
mod polynomial;
#[cfg(test)]
mod tests;

use std::fmt;

pub use check::{LatexNameError, check_name};
pub use expression::{to_latex, to_latex_limited};
pub use names::symbol_latex;
pub use polynomial::{LatexTerm, polynomial_terms, polynomial_to_latex};

/// How sines and cosines are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Trigonometry {
    /// `\sin q_2`, `\cos^{2} q_5`, `\sin\left(q_2 + q_3\right)`.
    #[default]
    Named,
    /// `s_2`, `c_5^{2}`, `s_{23}` for the joint variables q2, q5, q2 + q3; `s_{\theta}` for others.
    Short,
    /// `sq_2`, `c^{2}q_5`, `s(q_2 + q_3)`, as some papers print.
    Paper,
}

/// LaTeX for names.
type Names<'a> = dyn Fn(&str) -> Option<String> + 'a;

/// How LaTeX is printed.
///
/// ```
/// use robot_symbolic::print::latex::{LatexStyle, Trigonometry, to_latex};
/// let graph = robot_symbolic::Graph::new();
/// let expr = graph.parse("M5*sin(q2)*qdd1 - qd2^2*l4/3").unwrap();
/// let style = LatexStyle::new(Trigonometry::Paper);
/// assert_eq!(
///     to_latex(expr, &style)?,
///     r"M_5 sq_2 \ddot{q}_1 - \frac{1}{3} \dot{q}_2^{2} l_4"
/// );
/// # Ok::<(), robot_symbolic::print::TooLarge>(())
/// ```
#[derive(Clone, Copy, Default)]
pub struct LatexStyle<'a> {
    /// Sines and cosines.
    pub trigonometry: Trigonometry,
    names: Option<&'a Names<'a>>,
}

impl<'a> LatexStyle<'a> {
    /// A style whose names are all spelt by [`symbol_latex`].
    #[must_use]
    pub fn new(trigonometry: Trigonometry) -> LatexStyle<'a> {
        LatexStyle { trigonometry, names: None }
    }

    /// The style with LaTeX of the caller's for the names for which `names` gives some. What
    /// [`check_name`] refuses is not used.
    #[must_use]
    pub fn with_names(self, names: &'a Names<'a>) -> LatexStyle<'a> {
        LatexStyle { names: Some(names), ..self }
    }

    /// The LaTeX of a symbol.
    #[must_use]
    pub fn symbol(&self, name: &str) -> String {
        let given = self.names.and_then(|names| names(name));
        given.filter(|latex| check_name(latex).is_ok()).unwrap_or_else(|| symbol_latex(name))
    }
}

impl fmt::Debug for LatexStyle<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("LatexStyle")
            .field("trigonometry", &self.trigonometry)
            .field("names", &self.names.is_some())
            .finish()
    }
}

/// `x^{n}`; in parentheses where `x` has a superscript already.
fn raised(base: &str, exponent: u32) -> String {
    match exponent {
        1 => base.to_owned(),
        _ if base.contains(['^', '\'']) => format!(r"\left({base}\right)^{{{exponent}}}"),
        _ => format!("{base}^{{{exponent}}}"),
    }
}
