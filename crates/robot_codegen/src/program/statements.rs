//! The statements of a printed program: which values have names, and where long programs are cut into blocks and
//! functions.
//!
//! A backend prints each named value as a statement and every other value within the one expression
//! that uses it. Compilers do not handle thousands of statements in one block well, so statements are grouped
//! into blocks that export only the values used later; very long programs are cut into functions in the same way.

use super::{Operation, Program, Source, Value};

/// Limits of the printed code; each language sets its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The most operations in one expression; if it is 1, every value has a name.
    pub expression: usize,
    /// The most statements in one block.
    pub block: usize,
    /// The most statements in one function; longer programs are cut into several functions.
    pub function: usize,
    /// The most statements in each of these several functions.
    pub part: usize,
}

/// Statements of one block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// The named values that the block computes, in order.
    pub statements: Vec<Value>,
    /// The values of the block that later blocks or the results use.
    pub leaving: Vec<Value>,
    /// The named values of earlier blocks that the block uses.
    pub entering: Vec<Value>,
}

/// Blocks of one function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// The blocks in order. A single block needs no nesting.
    pub blocks: Vec<Block>,
    /// The values of the part that later parts or the results use.
    pub leaving: Vec<Value>,
    /// The named values of earlier parts that the part uses.
    pub entering: Vec<Value>,
}

/// The statements of a program, in blocks and parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statements {
    /// The parts in order. There is one, except for very long programs; a program without statements has none.
    pub parts: Vec<Part>,
    named: Vec<bool>,
}

impl Statements {
    /// Decides which values of a program have names, and groups its statements.
    #[must_use]
    pub fn new(program: &Program, limits: &Limits) -> Statements {
        let named = name_values(program, limits.expression.max(1));
        let statements: Vec<Value> =
            program.values().map(|(value, _)| value).filter(|value| named[value.index()]).collect();
        let last_use = last_uses(program, &named);
        let part = if statements.len() > limits.function { limits.part } else { limits.function };
        let groups = |statements: &[Value], limit: usize| {
            let cuts = cut(statements, &last_use, limit.max(1));
            make_blocks(program, &named, statements, &cuts, &last_use)
        };
        let parts = groups(&statements, part).into_iter().map(|part| Part {
            blocks: groups(&part.statements, limits.block),
            leaving: part.leaving,
            entering: part.entering,
        });
        Statements { parts: parts.collect(), named }
    }

    /// Whether a value is a statement of its own; others are printed within the expression that uses them.
    #[must_use]
    pub fn is_named(&self, value: Value) -> bool {
        self.named[value.index()]
    }

    /// The sources that the statements of a part read, sorted, each once.
    #[must_use]
    pub fn sources(&self, program: &Program, part: &Part) -> Vec<Source> {
        let statements = part.blocks.iter().flat_map(|block| &block.statements);
        let mut pending: Vec<Value> = statements.copied().collect();
        let mut sources = vec![];
        while let Some(value) = pending.pop() {
            let operation = program.operation(value);
            if let Operation::Load(source) = operation {
                sources.push(source);
            }
            pending.extend(operation.operands().filter(|value| !self.is_named(*value)));
        }
        sources.sort_unstable();
        sources.dedup();
        sources
    }

    /// The number of statements.
    #[must_use]
    pub fn count(&self) -> usize {
        let blocks = self.parts.iter().flat_map(|part| &part.blocks);
        blocks.map(|block| block.statements.len()).sum()
    }
}

/// Decides which values have names. Values used once stay within the expression that uses them while it has room;
/// results that nothing else uses are printed where they are returned.
fn name_values(program: &Program, limit: usize) -> Vec<bool> {
    let uses = program.uses();
    let mut named = vec![false; uses.len()];
    // The number of operations that are printed with an unnamed value, including its own.
    let mut size = vec![0_usize; uses.len()];
    for (value, operation) in program.values() {
        if operation.is_leaf() {
            continue;
        }
        // If there are too many, name the largest operands until the rest fits.
        let mut operands: Vec<Value> = operation.operands().collect();
        operands.sort_by_key(|operand| std::cmp::Reverse(size[operand.index()]));
        let mut total = 1 + operands.iter().map(|a| size[a.index()]).sum::<usize>();
        for operand in operands {
            if total <= limit {
                break;
            }
            let index = operand.index();
            named[index] |= size[index] > 0;
            total -= std::mem::take(&mut size[index]);
        }
        let index = value.index();
        size[index] = total;
        if uses[index] > 1 && !is_signed_leaf(program, operation) {
            named[index] = true;
            size[index] = 0;
        }
    }
    named
}

/// Whether an operation is −x of a constant or load, which needs no statement.
fn is_signed_leaf(program: &Program, operation: Operation) -> bool {
    matches!(operation, Operation::Neg(a) if program.operation(a).is_leaf())
}

/// For each named value, the index of the last named value whose statement uses it; its own index if nothing uses it,
/// and `usize::MAX` if the results use it.
fn last_uses(program: &Program, named: &[bool]) -> Vec<usize> {
    let mut last: Vec<usize> = (0..named.len()).collect();
    for value in program.results() {
        last[value.index()] = usize::MAX;
    }
    // From the end, because a value printed within another is used where that one is.
    for (value, operation) in program.values().rev() {
        let index = value.index();
        let place = if named[index] { index } else { last[index] };
        for operand in operation.operands() {
            let slot = &mut last[operand.index()];
            *slot = (*slot).max(place);
        }
    }
    last
}

/// Returns the ends of blocks, as positions in `statements`: in the later half of each block, the position
/// at which the fewest values are alive.
fn cut(statements: &[Value], last_use: &[usize], limit: usize) -> Vec<usize> {
    let live = live_after(statements, last_use);
    let mut cuts = vec![];
    let mut start = 0;
    while statements.len() - start > limit {
        let candidates = start + limit.div_ceil(2)..=start + limit;
        let end = candidates
            .min_by_key(|end| (live[*end - 1], std::cmp::Reverse(*end)))
            .unwrap_or(start + limit);
        cuts.push(end);
        start = end;
    }
    cuts.push(statements.len());
    cuts
}

/// For each statement, the number of named values that are used after it.
fn live_after(statements: &[Value], last_use: &[usize]) -> Vec<usize> {
    let mut dying = vec![0_usize; last_use.len()];
    let mut live = 0;
    let mut result = Vec::with_capacity(statements.len());
    for value in statements {
        let last = last_use[value.index()];
        if last > value.index() {
            live += 1;
            if last != usize::MAX {
                dying[last] += 1;
            }
        }
        live -= dying[value.index()];
        result.push(live);
    }
    result
}

fn make_blocks(
    program: &Program,
    named: &[bool],
    statements: &[Value],
    cuts: &[usize],
    last_use: &[usize],
) -> Vec<Block> {
    let mut blocks = vec![];
    let mut start = 0;
    for end in cuts {
        let inside = &statements[start..*end];
        start = *end;
        let Some((first, last)) = inside.first().zip(inside.last()) else {
            continue;
        };
        let leaves = |value: &&Value| last_use[value.index()] > last.index();
        let mut entering: Vec<Value> = inside
            .iter()
            .flat_map(|value| named_operands(program, named, *value))
            .filter(|value| value < first)
            .collect();
        entering.sort_unstable();
        entering.dedup();
        blocks.push(Block {
            statements: inside.to_vec(),
            leaving: inside.iter().filter(leaves).copied().collect(),
            entering,
        });
    }
    blocks
}

/// The named values in the expression of a statement.
fn named_operands(program: &Program, named: &[bool], statement: Value) -> Vec<Value> {
    let mut found = vec![];
    let mut pending: Vec<Value> = program.operation(statement).operands().collect();
    while let Some(value) = pending.pop() {
        if named[value.index()] {
            found.push(value);
        } else {
            pending.extend(program.operation(value).operands());
        }
    }
    found
}
