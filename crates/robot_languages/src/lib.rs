//! Runs printed code of every language on the same states and compares its bits.
//!
//! Each robot of `robots/` is generated with all its functions. A [`runners::Runner`] makes a package of it with a
//! program that reads states, calls every function and writes the results; these must be the bits that the
//! interpreter gives, whose digests are committed in `digests.txt`.

pub mod digests;
pub mod files;
pub mod runners;
pub mod work;
