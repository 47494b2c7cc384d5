//! The text of this crate's modules.

/// The oldest Rust version that supports the module and the code generated for it.
pub const RUST_VERSION: &str = env!("CARGO_PKG_RUST_VERSION");

/// The path and text of every file of the run-time module, starting with its root `mod.rs`.
///
/// A generator of self-contained crates writes them unchanged into a folder `runtime` next to
/// its crate root and declares `pub mod runtime;` (if it were private, the compiler would warn of unused functions).
/// The manifest declares an empty feature `std`. With it, code is chosen for the current processor and the module
/// offers `StdTrig`; without it, the module needs only `core`. Beyond that, the crate only has to use the edition 2024
/// and must not forbid `unsafe`; it needs no dependencies.
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
