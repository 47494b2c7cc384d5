//! The stores of a function's results: each as soon as its value is known, or two neighboring entries at once.
//!
//! Storing two entries at once halves the stores, but the first value waits for the second. That is faster only if the
//! stores, and not the operations, take the time: if most results become known at the end, as the poses of several
//! frames on the last link do, or if there are very many, as in regressors. For other functions it is up to 28 %
//! slower.

use rustc_hash::FxHashMap;

use super::{Id, Writer};

/// The part of the operations, at the end, of which results are counted.
const LAST_PART: usize = 5;

/// The number of results that are many, and the number of operations for each of them up to which their stores count.
const MANY: usize = 100;
const OPERATIONS: usize = 8;

/// The entries that are still to be stored.
pub(super) struct Stores {
    /// The positions of values and the entries that they are stored to, in order.
    entries: std::iter::Peekable<std::vec::IntoIter<(usize, u32)>>,
    /// For each entry of a pair, the first entry of the pair.
    pairs: FxHashMap<u32, u32>,
    /// For each pair of which one value is known, that value.
    known: FxHashMap<u32, Id>,
}

impl Stores {
    /// The stores of a function with a number of operations; `pairs` is whether two values can be stored at once.
    pub(super) fn new(mut entries: Vec<(usize, u32)>, operations: usize, pairs: bool) -> Stores {
        entries.sort_unstable();
        let last = operations / LAST_PART;
        let late = entries.iter().filter(|(position, _)| *position >= operations - last).count();
        let are_many = entries.len() >= MANY && entries.len() * OPERATIONS >= operations;
        let pairs = if pairs && (late > last || are_many) {
            neighbors(&entries)
        } else {
            FxHashMap::default()
        };
        Stores { entries: entries.into_iter().peekable(), pairs, known: FxHashMap::default() }
    }

    /// Stores the value at a position to the entries that it is the result of.
    pub(super) fn store(&mut self, writer: &mut Writer<'_>, position: usize, value: Id) {
        while let Some((_, entry)) = self.entries.next_if(|(result, _)| *result == position) {
            let Some(first) = self.pairs.get(&entry).copied() else {
                writer.store(value, entry);
                continue;
            };
            match self.known.remove(&first) {
                None => {
                    self.known.insert(first, value);
                }
                Some(other) if entry == first => writer.store_pair([value, other], first),
                Some(other) => writer.store_pair([other, value], first),
            }
        }
    }
}

/// Neighboring entries in pairs: for each entry of a pair the first one.
fn neighbors(entries: &[(usize, u32)]) -> FxHashMap<u32, u32> {
    let mut sorted: Vec<u32> = entries.iter().map(|(_, entry)| *entry).collect();
    sorted.sort_unstable();
    let mut pairs = FxHashMap::default();
    for run in sorted.chunk_by(|entry, next| entry + 1 == *next) {
        for pair in run.as_chunks::<2>().0 {
            pairs.extend(pair.iter().map(|entry| (*entry, pair[0])));
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbors_are_stored_at_once_if_most_results_come_late() {
        let entries = vec![(9, 0), (8, 1), (9, 2), (9, 3), (2, 5)];
        let pairs = |operations, pairs| Stores::new(entries.clone(), operations, pairs).pairs;
        let found = pairs(10, true);
        let mut found: Vec<(u32, u32)> = found.into_iter().collect();
        found.sort_unstable();
        assert_eq!(found, [(0, 0), (1, 0), (2, 2), (3, 2)]);
        assert!(pairs(10, false).is_empty());
        assert!(pairs(40, true).is_empty());
    }

    #[test]
    fn neighbors_are_stored_at_once_if_there_are_many() {
        let pairs = |results: usize, operations| {
            let entries = (0..results).map(|result| (result, result as u32)).collect();
            Stores::new(entries, operations, true).pairs.len()
        };
        assert_eq!([pairs(100, 800), pairs(100, 801), pairs(98, 400)], [100, 0, 0]);
    }
}
