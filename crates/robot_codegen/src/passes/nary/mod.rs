//! Sums and products of many terms: a view of a program for the passes that reorder them.
//!
//! A sum that is used only by one other sum becomes part of it, and likewise for products. A value that several
//! others use stays a node of its own, because sharing makes a program cheap. A value that depends only on
//! parameters also stays: it costs nothing at a call, and if unchanged it is the same in every function of a
//! module. Signs belong to the terms.

use robot_symbolic::Function;
use rustc_hash::FxHashMap;

use crate::program::{Builder, Constant, Operation, Program, Source, Stage, Value};

/// A node of the view.
pub(super) type Id = u32;

/// A node with its sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Term {
    pub(super) node: Id,
    pub(super) negative: bool,
}

impl Term {
    pub(super) fn positive(node: Id) -> Term {
        Term { node, negative: false }
    }

    fn times_sign(self, negative: bool) -> Term {
        Term { negative: self.negative != negative, ..self }
    }
}

/// The kind of a node.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Node {
    /// A constant, not negative, or a load.
    Leaf(Operation),
    /// The sum of the terms.
    Sum(Vec<Term>),
    /// The product of the factors.
    Product(Vec<Id>),
    /// The first node divided by the second.
    Quotient(Id, Id),
    /// A function of a term.
    Call(Function, Term),
}

/// A program as sums and products.
#[derive(Clone, Debug)]
pub(super) struct Nary {
    nodes: Vec<Node>,
    stages: Vec<Stage>,
    leaves: FxHashMap<Operation, Id>,
    pub(super) results: Vec<Term>,
}

impl Nary {
    /// Makes the view of a program.
    pub(super) fn new(program: &Program) -> Nary {
        let mut view =
            Nary { nodes: vec![], stages: vec![], leaves: FxHashMap::default(), results: vec![] };
        let uses = uses_through_signs(program);
        let mut terms: Vec<Term> = Vec::with_capacity(uses.len());
        for operation in program.operations() {
            let term = view.term(*operation, &terms, &uses);
            terms.push(term);
        }
        let results = program.results().iter();
        view.results = results.map(|value| terms[value.index()]).collect();
        view
    }

    pub(super) fn len(&self) -> usize {
        self.nodes.len()
    }

    pub(super) fn node(&self, id: Id) -> &Node {
        &self.nodes[id as usize]
    }

    /// The stage at which a node is known.
    pub(super) fn stage(&self, id: Id) -> Stage {
        self.stages[id as usize]
    }

    /// Whether a node is known before the call, so that it costs nothing at a call.
    pub(super) fn is_early(&self, id: Id) -> bool {
        self.stage(id) < Stage::Call
    }

    pub(super) fn push(&mut self, node: Node) -> Id {
        let id = self.nodes.len() as Id;
        self.stages.push(self.stage_of(&node));
        self.nodes.push(node);
        id
    }

    /// Replaces a node with another node that has the same value.
    pub(super) fn replace(&mut self, id: Id, node: Node) {
        self.stages[id as usize] = self.stage_of(&node);
        self.nodes[id as usize] = node;
    }

    /// Adds a constant, which must not be negative.
    pub(super) fn constant(&mut self, value: f64) -> Id {
        self.leaf(Operation::Constant(Constant::new(value)))
    }

    /// For each node, how often it is a result, or an operand of a node that is needed.
    pub(super) fn uses(&self) -> Vec<u32> {
        let mut uses = vec![0_u32; self.nodes.len()];
        let mut pending: Vec<Id> = self.results.iter().map(|term| term.node).collect();
        while let Some(id) = pending.pop() {
            uses[id as usize] += 1;
            if uses[id as usize] == 1 {
                pending.extend(self.operands(id));
            }
        }
        uses
    }

    /// Builds the program again: early values first, then the terms and factors in their order.
    pub(super) fn program(&self) -> Program {
        let mut builder = Builder::new();
        let mut built: Vec<Option<Signed>> = vec![None; self.nodes.len()];
        let mut pending: Vec<Id> = self.results.iter().rev().map(|term| term.node).collect();
        while let Some(id) = pending.last().copied() {
            let missing: Vec<Id> = if built[id as usize].is_some() {
                vec![]
            } else {
                self.operands(id).filter(|operand| built[*operand as usize].is_none()).collect()
            };
            if missing.is_empty() {
                pending.pop();
                if built[id as usize].is_none() {
                    built[id as usize] = Some(self.build(id, &mut builder, &built));
                }
            } else {
                pending.extend(missing.into_iter().rev());
            }
        }
        let at = |term: &Term| signed(&built, *term);
        let results: Vec<Signed> = self.results.iter().map(at).collect();
        let results = results.into_iter().map(|result| result.value(&mut builder)).collect();
        builder.finish(results)
    }

    fn leaf(&mut self, operation: Operation) -> Id {
        match self.leaves.get(&operation) {
            Some(id) => *id,
            None => {
                let id = self.push(Node::Leaf(operation));
                self.leaves.insert(operation, id);
                id
            }
        }
    }

    fn term(&mut self, operation: Operation, terms: &[Term], uses: &[u32]) -> Term {
        let at = |value: Value| terms[value.index()];
        // A term, and whether it is part of the sum or product that uses it.
        let part = |value: Value| {
            let term = terms[value.index()];
            (term, uses[value.index()] == 1 && !self.is_early(term.node))
        };
        match operation {
            Operation::Constant(constant) => {
                Term { node: self.constant(constant.get().abs()), negative: constant.get() < 0.0 }
            }
            Operation::Load(_) => Term::positive(self.leaf(operation)),
            Operation::Neg(a) => at(a).times_sign(true),
            Operation::Add(a, b) => self.sum([part(a), part(b)]),
            Operation::Sub(a, b) => {
                let (b, inline) = part(b);
                self.sum([part(a), (b.times_sign(true), inline)])
            }
            Operation::Mul(a, b) => self.product([part(a), part(b)]),
            Operation::MulAdd(a, b, c) => {
                let (product, addend) = ([part(a), part(b)], part(c));
                let product = self.product(product);
                self.sum([(product, false), addend])
            }
            Operation::Div(a, b) => Term {
                node: self.push(Node::Quotient(at(a).node, at(b).node)),
                negative: at(a).negative != at(b).negative,
            },
            Operation::Call(function, a) => Term::positive(self.push(Node::Call(function, at(a)))),
        }
    }

    /// Makes the sum of two terms; a term whose flag is set is split into its own terms.
    fn sum(&mut self, parts: [(Term, bool); 2]) -> Term {
        let mut terms: Vec<Term> = vec![];
        for (term, inline) in parts {
            match self.node(term.node) {
                Node::Sum(inner) if inline => {
                    terms.extend(inner.iter().map(|inner| inner.times_sign(term.negative)));
                }
                _ => terms.push(term),
            }
        }
        let terms = self.merge_like(terms);
        match terms.as_slice() {
            [] => Term::positive(self.constant(0.0)),
            [term] => *term,
            _ => Term::positive(self.push(Node::Sum(terms))),
        }
    }

    /// Merges equal terms: x − x vanishes, x + x becomes 2 x.
    fn merge_like(&mut self, terms: Vec<Term>) -> Vec<Term> {
        let mut multiples: Vec<(Id, i64)> = vec![];
        let mut places: FxHashMap<Id, usize> = FxHashMap::default();
        for term in terms {
            let sign = if term.negative { -1 } else { 1 };
            let place = *places.entry(term.node).or_insert(multiples.len());
            if place == multiples.len() {
                multiples.push((term.node, 0));
            }
            multiples[place].1 += sign;
        }
        multiples.retain(|(_, count)| *count != 0);
        let merged = multiples.into_iter().map(|(node, count)| {
            let negative = count < 0;
            if count.abs() == 1 {
                return Term { node, negative };
            }
            let factor = self.constant(count.unsigned_abs() as f64);
            Term { node: self.push(Node::Product(vec![factor, node])), negative }
        });
        merged.collect()
    }

    fn product(&mut self, parts: [(Term, bool); 2]) -> Term {
        let mut factors: Vec<Id> = vec![];
        let mut negative = false;
        for (term, inline) in parts {
            negative ^= term.negative;
            match self.node(term.node) {
                Node::Product(inner) if inline => factors.extend(inner),
                _ => factors.push(term.node),
            }
        }
        Term { node: self.push(Node::Product(factors)), negative }
    }

    pub(super) fn operands(&self, id: Id) -> Box<dyn Iterator<Item = Id> + '_> {
        match self.node(id) {
            Node::Leaf(_) => Box::new(std::iter::empty()),
            Node::Sum(terms) => Box::new(terms.iter().map(|term| term.node)),
            Node::Product(factors) => Box::new(factors.iter().copied()),
            Node::Quotient(a, b) => Box::new([*a, *b].into_iter()),
            Node::Call(_, term) => Box::new(std::iter::once(term.node)),
        }
    }

    fn stage_of(&self, node: &Node) -> Stage {
        let latest = |ids: &mut dyn Iterator<Item = Id>| {
            ids.map(|id| self.stage(id)).max().unwrap_or(Stage::Constant)
        };
        match node {
            Node::Leaf(Operation::Constant(_)) => Stage::Constant,
            Node::Leaf(Operation::Load(Source::Parameter(_))) => Stage::Parameters,
            Node::Leaf(_) => Stage::Call,
            Node::Sum(terms) => latest(&mut terms.iter().map(|term| term.node)),
            Node::Product(factors) => latest(&mut factors.iter().copied()),
            Node::Quotient(a, b) => self.stage(*a).max(self.stage(*b)),
            Node::Call(_, term) => self.stage(term.node),
        }
    }

    fn build(&self, id: Id, builder: &mut Builder, built: &[Option<Signed>]) -> Signed {
        let at = |id: Id| signed(built, Term::positive(id));
        match self.node(id) {
            Node::Leaf(operation) => Signed(builder.apply(*operation), false),
            Node::Sum(terms) => {
                let mut terms = terms.clone();
                terms.sort_by_key(|term| self.stage(term.node));
                let terms = terms.into_iter().map(|term| signed(built, term));
                let sum = terms.reduce(|a, b| a.plus(b, builder));
                sum.unwrap_or_else(|| Signed(builder.constant(0.0), false))
            }
            Node::Product(factors) => {
                let mut factors = factors.clone();
                factors.sort_by_key(|factor| self.stage(*factor));
                let product = factors.into_iter().map(at).reduce(|a, b| a.times(b, builder));
                product.unwrap_or_else(|| Signed(builder.constant(1.0), false))
            }
            Node::Quotient(a, b) => {
                let (Signed(a, minus_a), Signed(b, minus_b)) = (at(*a), at(*b));
                Signed(builder.div(a, b), minus_a != minus_b)
            }
            Node::Call(function, term) => {
                let argument = signed(built, *term).value(builder);
                Signed(builder.call(*function, argument), false)
            }
        }
    }
}

/// A value of the program under construction, and whether its negative is the term.
#[derive(Clone, Copy, Debug)]
struct Signed(Value, bool);

impl Signed {
    fn plus(self, other: Signed, builder: &mut Builder) -> Signed {
        match (self.1, other.1) {
            (false, false) => Signed(builder.add(self.0, other.0), false),
            (false, true) => Signed(builder.sub(self.0, other.0), false),
            (true, false) => Signed(builder.sub(other.0, self.0), false),
            (true, true) => Signed(builder.add(self.0, other.0), true),
        }
    }

    fn times(self, other: Signed, builder: &mut Builder) -> Signed {
        Signed(builder.mul(self.0, other.0), self.1 != other.1)
    }

    fn value(self, builder: &mut Builder) -> Value {
        if self.1 { builder.neg(self.0) } else { self.0 }
    }
}

/// Returns the value that was built for a term. Operands are built before the nodes that use them.
fn signed(built: &[Option<Signed>], term: Term) -> Signed {
    let Signed(value, negative) = built[term.node as usize].unwrap_or(Signed(Value(0), false));
    Signed(value, negative != term.negative)
}

/// For each value, how often it or its negative is used.
fn uses_through_signs(program: &Program) -> Vec<u32> {
    let mut uses = program.uses();
    for (value, operation) in program.values().rev() {
        if let Operation::Neg(a) = operation {
            uses[a.index()] += uses[value.index()];
            uses[a.index()] -= 1;
        }
    }
    uses
}

#[cfg(test)]
mod tests;
