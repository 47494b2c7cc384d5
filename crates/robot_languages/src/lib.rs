//! Runs printed code of every language on the same states and compares its bits.
//!
//! All functions of each robot in `robots/` are generated. A [`runners::Runner`] makes a package with a program that
//! reads states, calls every function and writes the results. In double precision, these must have the bits of the
//! interpreter, whose digests are committed in `digests.txt`; in single precision, which the interpreter does not
//! support, those of the first runner. If a language does not promise bits (WGSL), or if sines come from the
//! library of a language, results are compared with those of the interpreter in units in the last place of the largest
//! output.

pub mod digests;
pub mod files;
pub mod runners;
pub mod ulps;
pub mod work;
