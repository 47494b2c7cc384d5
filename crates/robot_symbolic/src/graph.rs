//! The arena of interned nodes.

use std::cell::RefCell;
use std::hash::BuildHasher;

use hashbrown::{HashMap, HashTable};
use indexmap::{IndexMap, IndexSet};
use rustc_hash::FxBuildHasher;

use crate::expr::Expr;
use crate::number::Number;
use crate::polynomial::AtomTable;
use crate::rational::Rational;

/// The identity of a node in its [`Graph`]. A node's operands always have smaller ids than the node itself, so a pass
/// in ascending order of ids visits operands first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Id(pub(crate) u32);

impl Id {
    /// The id as an index into a table over the graph's nodes.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// The identity of a symbol in its [`Graph`], in order of first use.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SymbolId(pub(crate) u32);

impl SymbolId {
    /// The id as an index into a table over the graph's symbols.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// The functions of one argument that expressions can apply.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Function {
    /// Sine of an angle in radians.
    Sin,
    /// Cosine of an angle in radians.
    Cos,
    /// Square root.
    Sqrt,
    /// Absolute value.
    Abs,
    /// The sign of the argument: −1, 0 or 1, with sgn 0 = 0.
    Sign,
    /// Hyperbolic tangent.
    Tanh,
    /// 1/x if x is positive and finite, otherwise NaN: for divisors that are positive unless something is wrong.
    /// Formulas in files cannot use it.
    RecipPositive,
}

impl Function {
    /// The functions that formulas can apply, in the order of their declaration.
    pub const ALL: [Function; 6] = [
        Function::Sin,
        Function::Cos,
        Function::Sqrt,
        Function::Abs,
        Function::Sign,
        Function::Tanh,
    ];

    /// The function's name in formulas.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Sqrt => "sqrt",
            Function::Abs => "abs",
            Function::Sign => "sign",
            Function::Tanh => "tanh",
            Function::RecipPositive => "recip_positive",
        }
    }

    /// Returns the function's value at a number.
    #[must_use]
    pub fn apply(self, argument: f64) -> f64 {
        match self {
            Function::Sin => argument.sin(),
            Function::Cos => argument.cos(),
            Function::Sqrt => argument.sqrt(),
            Function::Abs => argument.abs(),
            Function::Sign if argument == 0.0 || argument.is_nan() => argument,
            Function::Sign => argument.signum(),
            Function::Tanh => argument.tanh(),
            Function::RecipPositive if argument > 0.0 && argument.is_finite() => argument.recip(),
            Function::RecipPositive => f64::NAN,
        }
    }
}

/// A node. Numbers are never negative: the minus sign becomes a `Neg` node, which the rules move outward.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Node {
    Number(u32),
    Pi,
    Symbol(SymbolId),
    Add(Id, Id),
    Sub(Id, Id),
    Mul(Id, Id),
    Div(Id, Id),
    Neg(Id),
    Call(Function, Id),
}

impl Node {
    pub(crate) fn operands(self) -> impl Iterator<Item = Id> {
        let (first, second) = match self {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => (None, None),
            Node::Neg(a) | Node::Call(_, a) => (Some(a), None),
            Node::Add(a, b) | Node::Sub(a, b) | Node::Mul(a, b) | Node::Div(a, b) => {
                (Some(a), Some(b))
            }
        };
        first.into_iter().chain(second)
    }
}

/// An operation on two constants; the graph caches its results.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Folding {
    Add,
    Sub,
    Mul,
}

/// An arena of expressions, each stored once.
///
/// The same sequence of operations gives the same ids, and therefore the same order in every output. A graph is meant
/// to live for one derivation.
#[derive(Default)]
pub struct Graph {
    inner: RefCell<Inner>,
    atoms: RefCell<AtomTable>,
    /// The number of nodes at which operations stop creating new ones; `None` for no limit.
    limit: Option<usize>,
}

#[derive(Default)]
struct Inner {
    nodes: Vec<Node>,
    index: HashTable<u32>,
    numbers: IndexSet<Number, FxBuildHasher>,
    symbols: IndexMap<String, Id, FxBuildHasher>,
    /// Cached results of operations on constants, because a search derives the same constants many times.
    folded: HashMap<(Folding, Id, Id), Id, FxBuildHasher>,
}

/// Writes only the number of nodes, because a graph is too large to print.
impl std::fmt::Debug for Graph {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "Graph({} nodes)", self.len())
    }
}

impl Graph {
    /// An empty graph.
    #[must_use]
    pub fn new() -> Graph {
        Graph::default()
    }

    /// An empty graph with a limit on its number of nodes, so that a derivation that grows too long ends early instead
    /// of using up the memory.
    ///
    /// Once the graph [is full](Graph::is_full), operations return one of their operands instead of a new node, so all
    /// results are meaningless.
    #[must_use]
    pub fn limited(nodes: usize) -> Graph {
        Graph { limit: Some(nodes), ..Graph::default() }
    }

    /// Whether the graph has reached its limit, so that its expressions are meaningless.
    #[must_use]
    pub fn is_full(&self) -> bool {
        self.limit.is_some_and(|limit| self.len() >= limit)
    }

    /// Returns the symbol with this name, which is the same at every call.
    pub fn symbol(&self, name: &str) -> Expr<'_> {
        let known = self.inner.borrow().symbols.get(name).copied();
        let id = known.unwrap_or_else(|| {
            let symbol = SymbolId(self.inner.borrow().symbols.len() as u32);
            let id = self.intern(Node::Symbol(symbol));
            self.inner.borrow_mut().symbols.insert(name.to_owned(), id);
            id
        });
        self.expr(id)
    }

    /// Returns the symbol with this name, if it has been created.
    #[must_use]
    pub fn find_symbol(&self, name: &str) -> Option<Expr<'_>> {
        self.inner.borrow().symbols.get(name).map(|id| self.expr(*id))
    }

    /// The name of a symbol of this graph. The id of another graph's symbol gives a wrong name or an empty one.
    #[must_use]
    pub fn symbol_name(&self, symbol: SymbolId) -> String {
        let inner = self.inner.borrow();
        inner.symbols.get_index(symbol.index()).map(|(name, _)| name.clone()).unwrap_or_default()
    }

    /// The number of symbols created so far.
    #[must_use]
    pub fn symbol_count(&self) -> usize {
        self.inner.borrow().symbols.len()
    }

    /// The symbols created so far, in the order of their ids.
    pub fn symbols(&self) -> impl Iterator<Item = SymbolId> + use<> {
        (0..self.symbol_count() as u32).map(SymbolId)
    }

    /// A constant.
    pub fn number(&self, value: impl Into<Number>) -> Expr<'_> {
        self.expr(self.intern_number(&value.into()))
    }

    /// An integer constant.
    pub fn integer(&self, value: i64) -> Expr<'_> {
        self.number(Rational::integer(value))
    }

    /// The constant 0.
    pub fn zero(&self) -> Expr<'_> {
        self.integer(0)
    }

    /// The constant 1.
    pub fn one(&self) -> Expr<'_> {
        self.integer(1)
    }

    /// The constant π, exact.
    pub fn pi(&self) -> Expr<'_> {
        self.expr(self.intern(Node::Pi))
    }

    /// The number of nodes created so far; a shared node counts once.
    #[must_use]
    pub fn len(&self) -> usize {
        self.inner.borrow().nodes.len()
    }

    /// Whether no expression has been created.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the expression with this id.
    ///
    /// The id must be one of this graph: an id of another graph denotes an unrelated expression or, if it is too large,
    /// makes any use of the result panic.
    #[must_use]
    pub fn expr(&self, id: Id) -> Expr<'_> {
        Expr::new(self, id)
    }

    pub(crate) fn atoms(&self) -> &RefCell<AtomTable> {
        &self.atoms
    }

    pub(crate) fn node(&self, id: Id) -> Node {
        self.inner.borrow().nodes[id.index()]
    }

    /// Calls `read` with all nodes, in the order of their ids.
    pub(crate) fn with_nodes<T>(&self, read: impl FnOnce(&[Node]) -> T) -> T {
        read(&self.inner.borrow().nodes)
    }

    /// Interns a constant; a negative constant becomes a `Neg` node over its absolute value.
    pub(crate) fn intern_number(&self, value: &Number) -> Id {
        if value.is_negative() {
            let positive = self.intern_number(&-value);
            return self.intern(Node::Neg(positive));
        }
        // There is only one zero: a floating-point zero is stored as the exact one.
        let value = if value.is_zero() { Number::integer(0) } else { value.clone() };
        let (index, _) = self.inner.borrow_mut().numbers.insert_full(value);
        self.intern(Node::Number(index as u32))
    }

    /// The result of an operation on two nodes if both are constants.
    pub(crate) fn fold(&self, operation: Folding, a: Id, b: Id) -> Option<Id> {
        if !(self.is_number(a) && self.is_number(b)) {
            return None;
        }
        let key = (operation, a, b);
        let known = self.inner.borrow().folded.get(&key).copied();
        if known.is_some() {
            return known;
        }
        let (x, y) = (self.as_number(a)?, self.as_number(b)?);
        let value = match operation {
            Folding::Add => &x + &y,
            Folding::Sub => &x - &y,
            Folding::Mul => &x * &y,
        };
        let result = self.intern_number(&value);
        self.inner.borrow_mut().folded.insert(key, result);
        Some(result)
    }

    /// Whether a node is a constant.
    pub(crate) fn is_number(&self, id: Id) -> bool {
        let inner = self.inner.borrow();
        let is_positive = |id: Id| matches!(inner.nodes[id.index()], Node::Number(_));
        match inner.nodes[id.index()] {
            Node::Neg(operand) => is_positive(operand),
            _ => is_positive(id),
        }
    }

    /// Returns the value of a number with its sign, or `None` for other nodes, π among them.
    pub(crate) fn as_number(&self, id: Id) -> Option<Number> {
        let inner = self.inner.borrow();
        let positive = |id: Id| match inner.nodes[id.index()] {
            Node::Number(index) => inner.numbers.get_index(index as usize).cloned(),
            _ => None,
        };
        match inner.nodes[id.index()] {
            Node::Neg(operand) => positive(operand).map(|number| -&number),
            _ => positive(id),
        }
    }

    pub(crate) fn intern(&self, node: Node) -> Id {
        let mut inner = self.inner.borrow_mut();
        let Inner { nodes, index, .. } = &mut *inner;
        let is_full = self.limit.is_some_and(|limit| nodes.len() >= limit);
        let instead = if is_full { node.operands().next() } else { None };
        let hash = |node: &Node| FxBuildHasher.hash_one(node);
        let entry = index.entry(
            hash(&node),
            |known| nodes[*known as usize] == node,
            |known| hash(&nodes[*known as usize]),
        );
        match entry {
            hashbrown::hash_table::Entry::Occupied(known) => Id(*known.get()),
            hashbrown::hash_table::Entry::Vacant(free) => {
                if let Some(operand) = instead {
                    return operand;
                }
                let id = nodes.len() as u32;
                free.insert(id);
                nodes.push(node);
                Id(id)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Graph;

    #[test]
    fn a_limited_graph_fills_up_and_says_so() {
        let (limited, free) = (Graph::limited(50), Graph::new());
        let grown = |graph: &Graph| {
            let x = graph.symbol("x");
            (1..100).fold(x, |sum, k| sum * x + graph.symbol(&format!("y{k}")));
            (graph.len(), graph.is_full())
        };
        let (nodes, is_full) = grown(&limited);
        // A full graph still creates symbols, but no operations.
        assert!(is_full && (50..=50 + 100).contains(&nodes), "{nodes}");
        let (nodes, is_full) = grown(&free);
        assert!(!is_full && nodes > 200, "{nodes}");
        assert!(!Graph::limited(50).is_full());
    }
}
