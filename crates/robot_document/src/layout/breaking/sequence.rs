//! The places where lines can start, the cost of a line between two of them, and the lines with the lowest cost.

use super::{Limits, TooWide, starts_term};
use crate::layout::math::{Fence, Line, Math};
use crate::layout::width::{in_row, width};

/// The width of a quad, by which lines within a product or within parentheses are indented more, in pt.
const QUAD: f64 = 10.0;
/// The width of a `·` that is added at the beginning of a line, in pt.
const DOT: f64 = 2.78;
/// The spaces around a sign, which the indent of a line contains, in pt.
const SPACES: f64 = 4.44;

/// The cost of a line.
const LINE: u32 = 100;
/// The additional cost of a line that starts within a sum in parentheses that is wider than a line, by depth.
const LONG_SUM: [u32; 3] = [20, 15, 10];
/// The same for a sum that fits on a line.
const WHOLE_SUM: u32 = 70;
/// The same for a sum that is narrower than [`SHORT`] of a line.
const SHORT_SUM: u32 = 250;
/// The largest width of a short sum, as a fraction of the line.
const SHORT: f64 = 0.5;
/// The cost of a line that starts at a factor.
const FACTOR: u32 = 60;
/// The additional cost of a line that starts at a factor, if the product does not start on a line of its own.
const WITHIN: u32 = 150;
/// The additional cost of such a line if the line before it ends with a number.
const AFTER_NUMBER: u32 = 60;
/// The additional cost of such a line if it is shorter than [`TAIL_WIDTH`] of a line.
const TAIL: u32 = 35;
const TAIL_WIDTH: f64 = 0.25;
/// The additional cost of such a line if it has no sign of a sum and is shorter than [`ALONE_WIDTH`] of a line.
const ALONE: u32 = 300;
const ALONE_WIDTH: f64 = 0.4;

/// A formula as a sequence of tokens: its pieces and the parentheses of its sums.
#[derive(Default)]
pub(super) struct Sequence<'m> {
    tokens: Vec<Token<'m>>,
    /// The widths of the tokens before each place, in pt.
    before: Vec<f64>,
    starts: Vec<Start>,
    sums: Vec<Sum>,
    /// The width of a line.
    line: f64,
    /// The largest indent of lines that start with a term, in quads.
    deepest: usize,
    /// The innermost sum in parentheses at the current place, the number of parentheses around it, and the cost that they
    /// add to a start.
    sum: Option<usize>,
    depth: usize,
    nesting: u32,
}

/// A sum in parentheses.
struct Sum {
    /// The sum in parentheses that contains it.
    outer: Option<usize>,
    /// The token of the parenthesis that opens it, and the first token of the term to which it belongs.
    open: usize,
    term: usize,
    /// The largest indent of lines that start with its terms, in quads.
    indent: usize,
}

#[derive(Clone, Copy)]
enum Token<'m> {
    Piece(&'m Math),
    /// The parenthesis that opens a sum, and the place of the one that closes it.
    Open(&'m Math, usize),
    Close,
}

/// A place where a line can start.
#[derive(Clone, Copy)]
struct Start {
    token: usize,
    cost: u32,
    connection: Connection,
    /// The first token of the term.
    term: usize,
    /// The sum in parentheses in which it is.
    sum: Option<usize>,
}

/// The way in which a line is joined to the preceding one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Connection {
    /// By the sign at its beginning.
    Sign,
    /// As a factor that starts with a `·`.
    Dot,
    /// As a factor to which a `·` is added.
    Factor,
}

impl Start {
    /// The cost of starting a line here if the line before it starts at `last`.
    fn cost_after(self, last: Start) -> u32 {
        let is_within = self.connection != Connection::Sign && last.token < self.term;
        self.cost + if is_within { WITHIN } else { 0 }
    }

    /// How much more a line that starts here is indented than one that starts with a term of the same sum, in quads.
    fn deeper(self) -> usize {
        usize::from(self.connection != Connection::Sign)
    }
}

impl<'m> Sequence<'m> {
    /// The sequence of a formula, for lines of this width; those that start with a term have at most an indent of
    /// `deepest` quads.
    pub(super) fn new(math: &'m Math, line: f64, deepest: usize) -> Sequence<'m> {
        let mut sequence = Sequence { before: vec![0.0], line, deepest, ..Sequence::default() };
        let connection = Connection::Sign;
        sequence.starts.push(Start { token: 0, cost: 0, connection, term: 0, sum: None });
        sequence.row(math.pieces(), 0);
        sequence
    }

    /// The lines with the lowest cost.
    pub(super) fn lines(&self, limits: Limits) -> Result<Vec<Line>, TooWide> {
        let costs = self.costs(limits);
        let (mut lines, mut place) = (vec![], 0);
        // The indents of terms of sums whose parentheses have been opened, in quads.
        let mut indents: Vec<usize> = vec![];
        let of_sum = |indents: &[usize], sum: Option<usize>| {
            sum.and_then(|sum| indents.get(sum)).copied().unwrap_or_default()
        };
        while let Some(start) = self.starts.get(place) {
            let best = costs.get(place).copied().flatten();
            let (_, next) = best.ok_or_else(|| TooWide { needed: self.widest() })?;
            let following = self.starts.get(next);
            let end = following.map_or(self.tokens.len(), |next| next.token);
            let indent = of_sum(&indents, start.sum).min(self.deepest) + start.deeper();
            lines.push(Line { math: self.line(*start, end), indent });
            for sum in self.sums.iter().skip(indents.len()).take_while(|sum| sum.open < end) {
                // The term of the sum started in an earlier line.
                let is_late = sum.outer == start.sum && sum.term == start.term;
                let late = if is_late { start.deeper() } else { 0 };
                indents.push(of_sum(&indents, sum.outer) + 1 + late);
            }
            place = next;
        }
        Ok(lines)
    }

    fn push(&mut self, token: Token<'m>, width: f64) {
        self.before.push(self.before.last().copied().unwrap_or_default() + width);
        self.tokens.push(token);
    }

    /// Adds the pieces of a row; `term` is where the first term starts.
    fn row(&mut self, pieces: &'m [Math], mut term: usize) {
        for (place, piece) in pieces.iter().enumerate() {
            let last = place.checked_sub(1).and_then(|last| pieces.get(last));
            if let Some(last) = last
                && let Some(connection) = connection(last, piece, pieces.get(place + 1))
            {
                self.start(connection, last, &mut term);
            }
            match piece {
                Math::Fenced(Fence::Parentheses, inside) if !last.is_some_and(is_applied) => {
                    self.fenced(piece, inside, in_row(pieces, place), term);
                }
                _ => self.push(Token::Piece(piece), in_row(pieces, place)),
            }
        }
    }

    fn start(&mut self, connection: Connection, last: &Math, term: &mut usize) {
        let token = self.tokens.len();
        let cost = match (connection, last) {
            (Connection::Sign, _) => 0,
            (_, Math::Number(_)) => FACTOR + AFTER_NUMBER,
            _ => FACTOR,
        };
        if connection == Connection::Sign {
            *term = token;
        }
        self.starts.push(Start {
            token,
            cost: LINE + self.nesting + cost,
            connection,
            term: *term,
            sum: self.sum,
        });
    }

    /// The largest indent of lines that start with a term of the sum in parentheses, in quads.
    fn indent(&self, sum: Option<usize>) -> usize {
        sum.and_then(|sum| self.sums.get(sum)).map_or(0, |sum| sum.indent)
    }

    /// Adds a sum in parentheses to the term that starts at `term`; `whole` is its width with the parentheses, in pt.
    fn fenced(&mut self, piece: &'m Math, inside: &'m Math, whole: f64, term: usize) {
        let around = whole - width(inside);
        let open = self.tokens.len();
        let (outer, depth, nesting) = (self.sum, self.depth, self.nesting);
        let of_term = self.starts.iter().rev().take_while(|start| start.token >= term);
        let mut factors = of_term.filter(|start| start.connection != Connection::Sign);
        let is_late = factors.any(|start| start.sum == outer && start.term == term);
        let indent = self.indent(outer) + 1 + usize::from(is_late);
        self.push(Token::Open(piece, open), around / 2.0);
        self.sum = Some(self.sums.len());
        self.sums.push(Sum { outer, open, term, indent });
        self.depth += 1;
        self.nesting += match () {
            () if whole <= SHORT * self.line => SHORT_SUM,
            () if whole <= self.line => WHOLE_SUM,
            () => LONG_SUM.get(depth).copied().unwrap_or_default(),
        };
        let is_first = !self.tokens.iter().skip(term).any(|one| matches!(one, Token::Close));
        self.row(inside.pieces(), if is_first { term } else { open + 1 });
        (self.sum, self.depth, self.nesting) = (outer, depth, nesting);
        let close = self.tokens.len();
        if let Some(token) = self.tokens.get_mut(open) {
            *token = Token::Open(piece, close);
        }
        self.push(Token::Close, around / 2.0);
    }

    /// The width of the line from one start to the next, or to the end.
    fn width(&self, start: Start, next: Option<&Start>) -> f64 {
        let end = next.map_or(self.tokens.len(), |next| next.token);
        let at = |place: usize| self.before.get(place).copied().unwrap_or_default();
        let width = at(end) - at(start.token);
        match start.connection {
            Connection::Factor => width + DOT,
            // The row's first piece has no spaces.
            _ if start.token == 0 => width,
            _ => width - SPACES,
        }
    }

    /// For each start, the cost of the rest of the formula and the start of the next line. Of equal costs, the fullest first
    /// line is taken.
    fn costs(&self, limits: Limits) -> Vec<Option<(u32, usize)>> {
        let end = self.starts.len();
        let mut costs: Vec<Option<(u32, usize)>> = vec![None; end];
        costs.push(Some((0, end)));
        for (place, start) in self.starts.iter().enumerate().rev() {
            let indent = self.indent(start.sum).min(self.deepest) + start.deeper();
            let limit = match place {
                0 => limits.first,
                _ => limits.rest - QUAD * indent as f64,
            };
            let mut best: Option<(u32, usize)> = None;
            let is_factor = start.connection != Connection::Sign;
            let mut has_sign = false;
            for next in place + 1..=end {
                let following = self.starts.get(next);
                let width = self.width(*start, following);
                if width > limit {
                    break;
                }
                let fits = following.is_some() || width <= limit - limits.number;
                let tail = if is_factor { self.tail(width, has_sign) } else { 0 };
                has_sign |= following.is_some_and(|next| next.connection == Connection::Sign);
                let rest = costs.get(next).copied().flatten().filter(|_| fits);
                let Some((rest, _)) = rest else { continue };
                let cost = rest + tail + following.map_or(0, |next| next.cost_after(*start));
                if best.is_none_or(|(least, _)| cost <= least) {
                    best = Some((cost, next));
                }
            }
            if let Some(slot) = costs.get_mut(place) {
                *slot = best;
            }
        }
        costs
    }

    /// The additional cost of a line of this width that starts at a factor.
    fn tail(&self, width: f64, has_sign: bool) -> u32 {
        match () {
            () if !has_sign && width < ALONE_WIDTH * self.line => ALONE,
            () if width < TAIL_WIDTH * self.line => TAIL,
            () => 0,
        }
    }

    /// The width of the widest piece without a place where a line can start.
    fn widest(&self) -> f64 {
        let nexts = self.starts.iter().skip(1).map(Some).chain([None]);
        let widths = self.starts.iter().zip(nexts).map(|(start, next)| self.width(*start, next));
        widths.fold(0.0, f64::max)
    }

    fn line(&self, start: Start, end: usize) -> Math {
        let mut pieces = vec![];
        if start.connection == Connection::Factor {
            pieces.push(Math::Sign('·'));
        }
        let mut place = start.token;
        while let Some(token) = self.tokens.get(place).filter(|_| place < end) {
            match token {
                Token::Open(whole, close) if *close < end => {
                    pieces.push((*whole).clone());
                    place = *close;
                }
                Token::Open(..) => pieces.push(Math::Sign('(')),
                Token::Close => pieces.push(Math::Sign(')')),
                Token::Piece(piece) => pieces.push((*piece).clone()),
            }
            place += 1;
        }
        Math::row(pieces)
    }
}

/// How a line that starts at `piece` is joined to the one that ends with `last`; `None` if no line starts there. A sign
/// stays with the factor after it, a function with its argument, a power of ten with its number, and a `×` with both of
/// its operands.
fn connection(last: &Math, piece: &Math, next: Option<&Math>) -> Option<Connection> {
    match piece {
        _ if starts_term(last, piece) => Some(Connection::Sign),
        Math::Sign('·') if !next.is_some_and(is_power_of_ten) => Some(Connection::Dot),
        Math::Sign(_) => None,
        _ => (!stays_with_next(last)).then_some(Connection::Factor),
    }
}

fn is_power_of_ten(piece: &Math) -> bool {
    matches!(piece, Math::Script(script) if matches!(&script.base, Math::Number(ten) if ten == "10"))
}

fn stays_with_next(piece: &Math) -> bool {
    matches!(piece, Math::Sign(_)) || is_applied(piece)
}

/// Whether the piece is a function whose argument follows.
fn is_applied(piece: &Math) -> bool {
    match piece {
        Math::Function(_) | Math::Letter('s' | 'c') => true,
        Math::Script(script) => is_applied(&script.base) && script.lower.is_none(),
        _ => false,
    }
}
