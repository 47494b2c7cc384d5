//! Names for expressions that occur several times.

use robot_symbolic::{Expr, Graph, Id, View, walk};
use rustc_hash::{FxHashMap, FxHashSet};

use super::definitions::positive;
use crate::layout::tidied_text;

/// The names of expressions of one graph, as symbols of another graph.
#[derive(Clone)]
pub(super) struct Named<'h> {
    /// The graph that contains the symbols and the right sides.
    pub(super) graph: &'h Graph,
    symbols: FxHashMap<Id, Expr<'h>>,
}

/// The smallest number of printed operations of an expression that gets a name because it is used twice.
const SHORT: usize = 2;
/// The largest number of printed operations of an expression that is not divided into parts.
const LONG: usize = 24;
/// The number of bytes of text above which a constant gets a name.
const LONG_CONSTANT: usize = 9;

impl<'h> Named<'h> {
    pub(super) fn new(graph: &'h Graph) -> Named<'h> {
        Named { graph, symbols: FxHashMap::default() }
    }

    /// Names an expression, unless it has a name already. The negative of the expression is then written with the name
    /// too.
    pub(super) fn name(&mut self, expr: Expr<'_>, name: &str) {
        self.replace(expr, self.graph.symbol(name));
    }

    /// Sets the expression that replaces another one wherever it is used.
    pub(super) fn replace(&mut self, expr: Expr<'_>, value: Expr<'h>) {
        let (mut value, mut expr) = (value, expr);
        while let View::Neg(inside) = expr.view() {
            (value, expr) = (-value, inside);
        }
        self.symbols.entry(expr.id()).or_insert(value);
    }

    /// Whether an expression or its negative is replaced by a name or another expression.
    pub(super) fn has(&self, expr: Expr<'_>) -> bool {
        self.symbols.contains_key(&positive(expr).id())
    }

    /// Rewrites an expression with the names of its parts.
    pub(super) fn rewritten(&self, expr: Expr<'_>) -> Expr<'h> {
        let replace = |part: Expr<'_>| self.symbols.get(&part.id()).copied();
        let rewritten = walk::rebuild_above(&[expr], self.graph, replace);
        rewritten.first().copied().unwrap_or_else(|| self.graph.zero())
    }
}

/// Whether an expression is a number, a symbol or the negative of one, and so needs no name.
pub(super) fn is_leaf(expr: Expr<'_>) -> bool {
    match expr.view() {
        View::Number(_) | View::Pi | View::Symbol(_) => true,
        View::Neg(inside) => is_leaf(inside),
        _ => false,
    }
}

/// Whether a constant is long enough for a name if it is printed with `digits` significant digits.
pub(super) fn is_long_constant(expr: Expr<'_>, digits: Option<usize>) -> bool {
    matches!(expr.view(), View::Number(_)) && !is_short_text(expr, digits)
}

/// Whether a constant is as easy to read as a name if it is printed with `digits` significant digits.
fn is_short_text(expr: Expr<'_>, digits: Option<usize>) -> bool {
    let shown = robot_symbolic::print::to_text(expr).map(|text| tidied_text(&text, digits));
    shown.is_ok_and(|text| text.len() <= LONG_CONSTANT)
}

/// The expressions without symbols.
fn constants(all: &[Expr<'_>]) -> FxHashSet<Id> {
    let mut constants = FxHashSet::default();
    for expr in all {
        let is_constant = expr.as_symbol().is_none()
            && expr.operands().iter().all(|operand| constants.contains(&operand.id()));
        if is_constant {
            constants.insert(expr.id());
        }
    }
    constants
}

/// An expression that should have a name.
#[derive(Clone, Copy)]
pub(super) struct Worthy<'g> {
    pub(super) expr: Expr<'g>,
    /// Whether it is used only once and has a name because the expression that contains it would be too long.
    pub(super) is_cut: bool,
}

/// Returns the parts of `roots` that should have a name, operands before results: long parts that are used several
/// times, and parts of expressions that would be too long to print. Sines and cosines get no names. A constant gets one
/// if it is long when it is printed with `digits` significant digits and is used several times; without `digits`, each
/// long constant gets one.
pub(super) fn worth_naming<'g>(roots: &[Expr<'g>], digits: Option<usize>) -> Vec<Worthy<'g>> {
    let all = walk::reachable(roots);
    let angles = angles(&all);
    let constants = constants(&all);
    let mut users: FxHashMap<Id, usize> = FxHashMap::default();
    for expr in &all {
        // The base of a square is counted twice.
        for operand in expr.operands() {
            *users.entry(operand.id()).or_default() += 1;
        }
    }
    for root in roots {
        *users.entry(root.id()).or_default() += 1;
    }
    let is_root = |expr: &Expr<'g>| roots.iter().any(|root| root.id() == expr.id());
    let mut sizes: FxHashMap<Id, usize> = FxHashMap::default();
    let mut worthy = vec![];
    for expr in all {
        let size = match expr.view() {
            View::Number(_) | View::Symbol(_) | View::Pi => 0,
            _ if angles.contains(&expr.id()) => 0,
            View::Neg(_) => operand_sizes(expr, &sizes),
            _ => 1 + operand_sizes(expr, &sizes),
        };
        let used = users.get(&expr.id()).copied().unwrap_or_default();
        let is_short = || constants.contains(&expr.id()) && is_short_text(expr, digits);
        let long = (used > 1 && size >= SHORT && !is_leaf(expr) && !is_short()) || size > LONG;
        // A quantity that is not part of another one already has a name.
        let is_quantity = used == 1 && is_root(&expr);
        let is_negative = matches!(expr.view(), View::Neg(_));
        // A number with all its digits can be very long.
        let is_constant = (used > 1 || digits.is_none()) && is_long_constant(expr, digits);
        let named = (long && !is_negative && !is_quantity) || is_constant;
        if named {
            let is_cut = used == 1 && !is_constant;
            worthy.push(Worthy { expr, is_cut });
        }
        sizes.insert(expr.id(), if named { 0 } else { size });
    }
    worthy
}

/// Estimates how many symbols are printed for `roots` and their named parts, before like terms are merged.
pub(super) fn named_length(roots: &[Expr<'_>], digits: Option<usize>) -> usize {
    let named: FxHashSet<Id> =
        worth_naming(roots, digits).iter().map(|worthy| worthy.expr.id()).collect();
    // The length of each part, and whether it is a sum, which needs parentheses as a factor.
    let mut known: FxHashMap<Id, (usize, bool)> = FxHashMap::default();
    let mut total = 0;
    for expr in walk::reachable(roots) {
        let of = |operand: Expr<'_>| known.get(&operand.id()).copied().unwrap_or_default();
        let factor = |operand: Expr<'_>| of(operand).0 + usize::from(of(operand).1);
        let (length, is_sum) = match expr.view() {
            View::Number(_) | View::Pi | View::Symbol(_) | View::Call(..) => (1, false),
            View::Neg(a) => of(a),
            View::Add(a, b) | View::Sub(a, b) => (of(a).0 + of(b).0 + 1, true),
            View::Mul(a, b) => (factor(a) + factor(b), false),
            View::Div(a, b) => (factor(a) + factor(b) + 1, false),
        };
        let is_named = named.contains(&expr.id());
        // A long number that is written out counts as two symbols.
        total += match is_named {
            true => length,
            false => usize::from(is_long_constant(expr, digits)),
        };
        known.insert(expr.id(), if is_named { (1, false) } else { (length, is_sum) });
    }
    let of_roots = roots.iter().filter_map(|root| known.get(&root.id()));
    total + of_roots.map(|(length, _)| length).sum::<usize>()
}

fn operand_sizes(expr: Expr<'_>, sizes: &FxHashMap<Id, usize>) -> usize {
    let size = |operand: &Expr<'_>| sizes.get(&operand.id()).copied().unwrap_or_default();
    expr.operands().iter().map(size).sum()
}

/// The sines and cosines and their arguments.
fn angles(all: &[Expr<'_>]) -> FxHashSet<Id> {
    use robot_symbolic::Function::{Cos, Sin};
    let is_circular = |expr: &&Expr<'_>| matches!(expr.view(), View::Call(Sin | Cos, _));
    let circular: Vec<Expr<'_>> = all.iter().filter(is_circular).copied().collect();
    walk::reachable(&circular).iter().map(|expr| expr.id()).collect()
}
