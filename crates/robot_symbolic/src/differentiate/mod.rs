//! Jacobian matrices of many expressions by many symbols, in two modes that reuse different intermediate results.
//!
//! [`forward`] carries the slopes by every symbol from operands to results: cheap if few symbols
//! reach a node. [`reverse`] carries, for every root, the weights of nodes from results to operands:
//! cheap if few roots see a node. Both give the same values; which expressions are cheaper is
//! found by counting.
//!
//! As everywhere, |x| has the derivative sgn x, and sgn x the derivative 0.

mod forward;
mod reverse;

pub use forward::forward;
pub use reverse::reverse;

#[cfg(test)]
mod tests;
