//! Code of 128-bit registers, made by cranelift: for processors that `emit` has no instructions of.
//!
//! A list becomes a function of cranelift step by step, in its order, of `f64` or of two of them side by side. Cranelift
//! gives registers and puts values aside on the stack, so that the working memory is not used.

#[cfg(any(target_arch = "aarch64", feature = "cranelift"))]
mod body;
#[cfg(any(target_arch = "aarch64", feature = "cranelift"))]
mod function;

#[cfg(any(target_arch = "aarch64", feature = "cranelift"))]
pub(crate) use self::function::encode;

/// There is no code for registers that no machine of this architecture has.
#[cfg(not(any(target_arch = "aarch64", feature = "cranelift")))]
pub(crate) fn encode(
    _: &crate::list::List,
    _: usize,
    _: crate::emit::Addressing,
) -> Result<(Vec<u8>, u32), crate::emit::Fault> {
    Err(crate::emit::Fault::Encoding("this build is without cranelift".to_owned()))
}
