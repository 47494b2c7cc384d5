//! The text of this crate's modules.

/// The oldest Rust version that supports the module and the code generated for it.
pub const RUST_VERSION: &str = env!("CARGO_PKG_RUST_VERSION");

/// Path and text of every file of the run-time module, its root `mod.rs` first.
///
/// A generator of self-contained crates writes them unchanged into a folder `runtime` beside
/// its crate root and declares `pub mod runtime;` (private, it would warn of unused functions).
/// The manifest declares a feature `std`, empty; with it code runs on the processor at hand and the module offers `StdTrig`, without it
/// the module needs `core` alone. Nothing else is asked of the crate around it but that it does not
/// forbid `unsafe`: no dependency, no edition before 2024.
pub const SOURCES: &[(&str, &str)] = &[
    ("mod.rs", include_str!("runtime/mod.rs")),
    ("batch.rs", include_str!("runtime/batch.rs")),
    ("field.rs", include_str!("runtime/field.rs")),
    ("fused.rs", include_str!("runtime/fused.rs")),
    ("lanes.rs", include_str!("runtime/lanes.rs")),
    ("lanes_on.rs", include_str!("runtime/lanes_on.rs")),
    ("lanewise.rs", include_str!("runtime/lanewise.rs")),
    ("no_std_trig.rs", include_str!("runtime/no_std_trig.rs")),
    ("number.rs", include_str!("runtime/number.rs")),
    ("processor.rs", include_str!("runtime/processor.rs")),
    ("real.rs", include_str!("runtime/real.rs")),
    ("reciprocal.rs", include_str!("runtime/reciprocal.rs")),
    ("registers.rs", include_str!("runtime/registers.rs")),
    ("registers/neon.rs", include_str!("runtime/registers/neon.rs")),
    ("registers/register.rs", include_str!("runtime/registers/register.rs")),
    ("registers/x86.rs", include_str!("runtime/registers/x86.rs")),
    ("root.rs", include_str!("runtime/root.rs")),
    ("scalar.rs", include_str!("runtime/scalar.rs")),
    ("state.rs", include_str!("runtime/state.rs")),
    ("std_trig.rs", include_str!("runtime/std_trig.rs")),
    ("tanh.rs", include_str!("runtime/tanh.rs")),
    ("trig.rs", include_str!("runtime/trig.rs")),
    ("trig/block.rs", include_str!("runtime/trig/block.rs")),
    ("trig/double.rs", include_str!("runtime/trig/double.rs")),
    ("trig/single.rs", include_str!("runtime/trig/single.rs")),
];
