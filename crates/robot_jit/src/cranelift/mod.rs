//! Code with 128-bit registers, made by cranelift, for processors that `emit` does not support.
//!
//! A list is translated step by step, in its order, to a function of cranelift on `f64` or on vectors of two. Cranelift
//! allocates registers and spills values to the stack, so the working memory is not used.

#[cfg(any(target_arch = "aarch64", feature = "cranelift"))]
mod body;
#[cfg(any(target_arch = "aarch64", feature = "cranelift"))]
mod function;

#[cfg(any(target_arch = "aarch64", feature = "cranelift"))]
pub(crate) use self::function::encode;

/// Returns an error if cranelift is not compiled in; no machine then has registers that need it.
#[cfg(not(any(target_arch = "aarch64", feature = "cranelift")))]
pub(crate) fn encode(
    _: &crate::list::List,
    _: usize,
    _: crate::emit::Addressing,
) -> Result<(Vec<u8>, u32), crate::emit::Fault> {
    Err(crate::emit::Fault::Encoding("this build is without cranelift".to_owned()))
}
