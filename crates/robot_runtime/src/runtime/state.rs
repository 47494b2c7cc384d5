//! Many states at once: the numbers of one state, and those of several states in lanes.
//!
//! Several states are in memory state by state (`[[f64; 6]]`), coordinate by coordinate (six `[f64]`, columns), or in
//! blocks of a few states (`[[f64; 8]; 6]`: lane i of each coordinate belongs to state i).

use super::real::Real;
use super::scalar::Scalar;

/// The numbers of one state: a number, or an array of numbers.
pub trait State: Copy {
    /// The numbers of `W` states: each number is an array of `W`.
    type Lanes<const W: usize>: Copy;

    /// A mutable column for each number.
    type Columns<'c>;

    /// Stores the state in a lane, if the lane exists.
    fn set_lane<const W: usize>(self, lanes: &mut Self::Lanes<W>, lane: usize);

    /// Returns the state of a lane; zeros if there is no such lane.
    fn of_lane<const W: usize>(lanes: &Self::Lanes<W>, lane: usize) -> Self;

    /// Returns the length of the shortest column; `usize::MAX` if there are no columns.
    fn column_length(columns: &Self::Columns<'_>) -> usize;

    /// Copies `count` lanes into the columns from entry `start` on, as far as the columns have entries.
    fn to_columns<const W: usize>(
        lanes: &Self::Lanes<W>,
        columns: &mut Self::Columns<'_>,
        start: usize,
        count: usize,
    );
}

macro_rules! implement_state {
    ($float:ident) => {
        impl State for $float {
            type Lanes<const W: usize> = [$float; W];
            type Columns<'c> = &'c mut [$float];

            #[inline(always)]
            fn set_lane<const W: usize>(self, lanes: &mut [$float; W], lane: usize) {
                set_state(self, lanes, lane);
            }

            #[inline(always)]
            fn of_lane<const W: usize>(lanes: &[$float; W], lane: usize) -> $float {
                lanes.get(lane).copied().unwrap_or_default()
            }

            #[inline(always)]
            fn column_length(columns: &&mut [$float]) -> usize {
                columns.len()
            }

            #[inline(always)]
            fn to_columns<const W: usize>(
                lanes: &[$float; W],
                columns: &mut &mut [$float],
                start: usize,
                count: usize,
            ) {
                let rest = columns.get_mut(start..).unwrap_or_default();
                match rest.first_chunk_mut::<W>() {
                    Some(chunk) if count >= W => *chunk = *lanes,
                    _ => {
                        for (to, from) in rest.iter_mut().zip(lanes).take(count) {
                            *to = *from;
                        }
                    }
                }
            }
        }
    };
}

implement_state!(f64);
implement_state!(f32);

impl<S: State, const N: usize> State for [S; N] {
    type Lanes<const W: usize> = [S::Lanes<W>; N];
    type Columns<'c> = [S::Columns<'c>; N];

    #[inline(always)]
    fn set_lane<const W: usize>(self, lanes: &mut [S::Lanes<W>; N], lane: usize) {
        for (to, from) in lanes.iter_mut().zip(self) {
            from.set_lane(to, lane);
        }
    }

    #[inline(always)]
    fn of_lane<const W: usize>(lanes: &[S::Lanes<W>; N], lane: usize) -> [S; N] {
        lanes.each_ref().map(|lanes| S::of_lane(lanes, lane))
    }

    #[inline(always)]
    fn column_length(columns: &[S::Columns<'_>; N]) -> usize {
        columns.iter().map(S::column_length).min().unwrap_or(usize::MAX)
    }

    #[inline(always)]
    fn to_columns<const W: usize>(
        lanes: &[S::Lanes<W>; N],
        columns: &mut [S::Columns<'_>; N],
        start: usize,
        count: usize,
    ) {
        for (lanes, column) in lanes.iter().zip(columns) {
            S::to_columns(lanes, column, start, count);
        }
    }
}

/// Returns lane `lane` of each coordinate.
#[inline(always)]
pub fn lane<T: Scalar, const W: usize, const N: usize>(lanes: [&[T; W]; N], lane: usize) -> [T; N] {
    lanes.map(|numbers| numbers.get(lane).copied().unwrap_or(T::ZERO))
}

/// Returns state `index`; zeros beyond the last state.
#[inline(always)]
pub fn state<T: Scalar, const N: usize, const W: usize>(
    states: &[[T; N]; W],
    index: usize,
) -> [T; N] {
    states.get(index).copied().unwrap_or([T::ZERO; N])
}

/// Stores a state at `index`, if this index exists.
#[inline(always)]
pub fn set_state<S, const W: usize>(state: S, states: &mut [S; W], index: usize) {
    if let Some(to) = states.get_mut(index) {
        *to = state;
    }
}

/// Converts states to lanes: lane i of each coordinate is its value in state i.
#[inline(always)]
pub fn side_by_side<T: Scalar, const N: usize, const W: usize>(
    states: &[[T; N]; W],
) -> [[T; W]; N] {
    let mut lanes = [[T::ZERO; W]; N];
    for (index, state) in states.iter().enumerate() {
        for (lanes, number) in lanes.iter_mut().zip(state) {
            set_state(*number, lanes, index);
        }
    }
    lanes
}

/// Returns the length of the shortest column; `usize::MAX` if there are no columns.
#[inline(always)]
pub fn column_length<T, const N: usize>(columns: &[&[T]; N]) -> usize {
    columns.iter().map(|column| column.len()).min().unwrap_or(usize::MAX)
}

/// Returns references to `W` entries of each column from entry `start` on; zeros for a column that is too short.
#[inline(always)]
pub fn chunks<'c, T: Real, const W: usize, const N: usize>(
    columns: &[&'c [T]; N],
    start: usize,
) -> [&'c [T; W]; N] {
    columns.map(|column| {
        let rest = column.get(start..).unwrap_or_default();
        rest.first_chunk().unwrap_or(T::zeros())
    })
}

/// Copies `W` entries of each column from entry `start` on, padded with zeros.
#[inline(always)]
pub fn padded_chunks<T: Scalar, const W: usize, const N: usize>(
    columns: &[&[T]; N],
    start: usize,
) -> [[T; W]; N] {
    columns.map(|column| {
        let mut chunk = [T::ZERO; W];
        let rest = column.get(start..).unwrap_or_default();
        for (to, from) in chunk.iter_mut().zip(rest) {
            *to = *from;
        }
        chunk
    })
}
