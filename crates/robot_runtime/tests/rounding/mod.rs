//! Sine and cosine as they are where a multiply-add rounds once and where it rounds twice, whichever
//! of the two this build has.

pub(crate) mod once;
pub(crate) mod twice;
