//! All functions of the UR5 and the Panda compiled by rustc, with slices as arguments, like machine code in memory.

use std::array::from_fn;

pub mod options;

/// A function of a robot.
pub struct Function {
    /// The robot's name.
    pub robot: &'static str,
    /// The function's name.
    pub name: &'static str,
    /// Computes the entries of all outputs from the entries of all inputs.
    pub single: fn(&[f64], &mut [f64]),
    /// Computes the columns of all outputs from the columns of all inputs.
    pub columns: fn(&[&[f64]], &mut [&mut [f64]]),
}

include!(concat!(env!("OUT_DIR"), "/list.rs"));

/// Takes the next input of a state.
#[inline(always)]
fn row<'r, const N: usize>(rest: &mut &'r [f64]) -> &'r [f64; N] {
    let (first, others) = rest.split_first_chunk().unwrap();
    *rest = others;
    first
}

/// Takes the columns of the next input.
#[inline(always)]
fn columns<'c, const N: usize>(rest: &mut &[&'c [f64]]) -> [&'c [f64]; N] {
    let (first, others) = rest.split_first_chunk().unwrap();
    *rest = others;
    *first
}

/// A result as its entries, in their order.
trait Entries {
    const COUNT: usize;

    fn write(&self, to: &mut [f64]);
}

impl Entries for f64 {
    const COUNT: usize = 1;

    #[inline(always)]
    fn write(&self, to: &mut [f64]) {
        to[0] = *self;
    }
}

impl<E: Entries, const N: usize> Entries for [E; N] {
    const COUNT: usize = N * E::COUNT;

    #[inline(always)]
    fn write(&self, to: &mut [f64]) {
        for (entry, to) in self.iter().zip(to.chunks_exact_mut(E::COUNT)) {
            entry.write(to);
        }
    }
}

/// Writes a result; returns the rest of the slice.
#[inline(always)]
fn write<'o, E: Entries>(entries: &E, to: &'o mut [f64]) -> &'o mut [f64] {
    let (to, rest) = to.split_at_mut(E::COUNT);
    entries.write(to);
    rest
}
