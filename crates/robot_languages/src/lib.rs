//! Runs printed code of every language on the same states and compares its bits.
//!
//! Each robot of `robots/` is generated with all its functions. A [`runners::Runner`] makes a package of it with a
//! program that reads states, calls every function and writes the results; these must be the bits that the
//! interpreter gives, whose digests are committed in `digests.txt`. Where a language promises no bits, WGSL, and where sines are those of
//! a language's library, results are compared with the interpreter's in units in the last place of the largest output.

pub mod digests;
pub mod files;
pub mod runners;
pub mod ulps;
pub mod work;
