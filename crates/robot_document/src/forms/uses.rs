//! Decides by the uses of their names which common parts keep a definition: parts that nothing uses in the end are left
//! out, and rarely used ones are written where they are used.

use robot_symbolic::{Expr, Id, View, walk};
use rustc_hash::{FxHashMap, FxHashSet};

use super::definitions::{Definitions, is_omitted};
use super::{Group, Writer};
use crate::error::Error;
use crate::layout::tidied_text;

/// Equations with names for common parts.
pub(super) struct Attempt<T> {
    pub(super) groups: Vec<Group>,
    pub(super) uses: Uses,
    /// What else is known of the equations.
    pub(super) more: T,
}

/// The expressions whose definitions are one too many or are missing.
pub(super) struct Uses {
    /// Those whose names occur neither in the equations nor in a definition that they need.
    pub(super) unused: FxHashSet<Id>,
    /// Their names.
    names: FxHashSet<String>,
    /// Those that were omitted and whose names occur.
    pub(super) missing: FxHashSet<Id>,
}

/// The expressions that get no names although they are common parts.
#[derive(Clone, Default)]
pub(super) struct Unnamed {
    /// Those whose names nothing uses in the end: their definitions are not printed.
    pub(super) omitted: FxHashSet<Id>,
    /// Those that are written where they are used.
    pub(super) inlined: FxHashSet<Id>,
}

/// The largest number of attempts to leave out the names that nothing uses.
const ATTEMPTS: usize = 5;

/// Returns what `write` writes, without the names that nothing uses in the end, such as those of parts that cancel.
/// `write` gives no names to the expressions that it is given.
pub(super) fn without_unused<'r, 'g, T>(
    writer: &mut Writer<'r, 'g>,
    write: impl Fn(&mut Writer<'r, 'g>, Unnamed) -> Result<Attempt<T>, Error>,
) -> Result<(Vec<Group>, T), Error> {
    writer.check_size()?;
    let (symbols, digits) = (writer.symbols.clone(), writer.options.digits);
    let mut best = write(writer, Unnamed::default())?;
    let mut unnamed = Unnamed { omitted: best.uses.unused.clone(), inlined: FxHashSet::default() };
    for _ in 0..ATTEMPTS {
        if best.uses.unused.is_empty() {
            break;
        }
        let known = std::mem::replace(&mut writer.symbols, symbols.clone());
        let Attempt { groups, uses, more } = write(writer, unnamed.clone())?;
        let is_better = uses.missing.is_empty()
            && uses.unused.len() < best.uses.unused.len()
            && printed_length(&groups, digits) <= printed_length(&best.groups, digits);
        unnamed.omitted.extend(&uses.unused);
        // Without some names, the others have another order, in which factors and terms are collected otherwise, and a
        // name can be used that was not.
        unnamed.omitted.retain(|one| !uses.missing.contains(one));
        unnamed.inlined.extend(&uses.missing);
        if is_better {
            best = Attempt { groups, uses, more };
        } else {
            writer.symbols = known;
        }
    }
    // Each attempt can make other names superfluous.
    for group in best.groups.iter_mut().filter(|group| group.definitions) {
        group.equations.retain(|equation| !best.uses.names.contains(&equation.name));
    }
    best.groups.retain(|group| !group.definitions || !group.equations.is_empty());
    Ok((best.groups, best.more))
}

/// The number of bytes of the equations as text, with equals signs, ends of lines, and titles if there are several, if
/// decimals have so many significant digits.
pub(super) fn printed_length(groups: &[Group], digits: Option<usize>) -> usize {
    let titles = groups.iter().map(|group| group.title.len() + 4).filter(|_| groups.len() > 1);
    let equations = groups.iter().flat_map(|group| &group.equations);
    let equations = equations
        .map(|equation| equation.name.len() + tidied_text(&equation.text, digits).len() + 4);
    titles.chain(equations).sum()
}

/// The largest numbers of bytes of a part of a long expression that is written within it if it is used once.
const INLINED: [usize; 2] = [120, 0];
/// The largest number of uses of an expression, and of bytes of its text, that is written in each place.
const FEW_USES: usize = 3;
const FEW_BYTES: usize = 16;

/// Sets of expressions that could be written where they are used. The first that does not make the equations longer is
/// taken.
pub(super) type Rare = [FxHashSet<Id>; 3];

impl Definitions<'_, '_> {
    /// The expressions whose definitions are one too many or are missing in the equations.
    pub(super) fn uses(&self, groups: &[Group]) -> Uses {
        let mut needed: FxHashSet<&str> = FxHashSet::default();
        let (mut unused, mut names) = (FxHashSet::default(), FxHashSet::default());
        for equation in groups.iter().rev().flat_map(|group| group.equations.iter().rev()) {
            match self.sources.get(&equation.name) {
                Some(source) if !needed.contains(equation.name.as_str()) => {
                    unused.insert(*source);
                    names.insert(equation.name.clone());
                }
                _ => needed.extend(equation.right.symbols()),
            }
        }
        let equations = groups.iter().flat_map(|group| &group.equations);
        let missing = equations.flat_map(|equation| equation.right.symbols());
        let missing = missing.filter(|name| is_omitted(name));
        let missing = missing.filter_map(|name| self.sources.get(name).copied()).collect();
        Uses { unused, names, missing }
    }

    /// The expressions whose names are rarely used: those that are used once, for each length in [`INLINED`], and those
    /// with a short text that are used a few times. Of those that are named because they are part of a long expression,
    /// only the ones with at most so many bytes of text.
    pub(super) fn rarely_used(&self, groups: &[Group]) -> Rare {
        let mut uses: FxHashMap<&str, usize> = FxHashMap::default();
        let equations = || groups.iter().flat_map(|group| &group.equations);
        for name in equations().flat_map(|equation| equation.right.symbols()) {
            *uses.entry(name).or_default() += 1;
        }
        // Lines do not break within arguments and denominators.
        let whole = walk::reachable(&self.roots).into_iter().filter_map(|part| match part.view() {
            View::Call(_, inside) | View::Div(_, inside) => Some(inside),
            _ => None,
        });
        let whole = walk::reachable(&whole.collect::<Vec<_>>());
        let whole: FxHashSet<Id> = whole.into_iter().map(Expr::id).collect();
        let cut = self.worthy.iter().filter(|one| one.is_cut).map(|one| one.expr.id());
        let cut: FxHashSet<Id> = cut.collect();
        let mut found = Rare::default();
        for equation in equations() {
            let count = uses.get(equation.name.as_str()).copied().unwrap_or_default();
            let Some(source) = self.sources.get(&equation.name).copied() else { continue };
            let bytes = equation.text.len();
            let is_chosen = |longest| count == 1 && (!cut.contains(&source) || bytes <= longest);
            let is_chosen = [
                is_chosen(INLINED[0]),
                is_chosen(INLINED[1]),
                (1..=FEW_USES).contains(&count) && bytes <= FEW_BYTES,
            ];
            for (sources, is_chosen) in found.iter_mut().zip(is_chosen) {
                if is_chosen && !whole.contains(&source) {
                    sources.insert(source);
                }
            }
        }
        found
    }
}
