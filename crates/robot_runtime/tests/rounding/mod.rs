//! Sine and cosine with multiply-adds that round once, and with multiply-adds that round twice, independent
//! of which of the two this build has.

pub(crate) mod once;
pub(crate) mod twice;
