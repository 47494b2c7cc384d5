//! Jacobian matrices of many expressions with respect to many symbols, in two modes that reuse different intermediate
//! results.
//!
//! [`forward`] propagates the derivatives with respect to every symbol from operands to results, which is cheap if each
//! node depends on few symbols. [`reverse`] propagates, for every root, the derivatives with respect to the nodes from
//! results to operands, which is cheap if few roots depend on each node. Both give the same values; a count of the
//! operations shows which mode gives the cheaper expressions.
//!
//! As everywhere, |x| has the derivative sgn x, and sgn x the derivative 0.

mod forward;
mod reverse;

pub use forward::forward;
pub use reverse::reverse;

#[cfg(test)]
mod tests;
