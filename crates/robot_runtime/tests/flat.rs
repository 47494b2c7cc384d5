//! The compiled functions have no branches and no calls, and use vector instructions.

use std::collections::BTreeMap;

mod assembly;
use assembly::{Listing, compile, is_installed};

const X86: &str = "x86_64-unknown-linux-gnu";
const CORTEX_M4F: &str = "thumbv7em-none-eabihf";

/// The number of instructions that start with one of `beginnings`.
fn count(listing: &Listing, beginnings: &[&str]) -> usize {
    let is_one = |operation: &str| beginnings.iter().any(|start| operation.starts_with(start));
    listing.iter().filter(|(operation, _)| is_one(operation)).count()
}

/// The number of conditional jumps of x86: all `j…` except `jmp`.
fn jumps(listing: &Listing) -> usize {
    count(listing, &["j"]) - count(listing, &["jmp"])
}

/// The numbers of packed and of scalar arithmetic instructions of x86: `mulpd`, `vfmadd213ps` …, `mulsd`,
/// `vfmadd213ss` ….
fn arithmetic(listing: &Listing) -> (usize, usize) {
    let is_arithmetic = |operation: &str| {
        let name = operation.trim_start_matches('v');
        ["add", "sub", "mul", "div", "sqrt", "fmadd", "fmsub", "fnmadd", "fnmsub"]
            .iter()
            .any(|start| name.starts_with(start))
    };
    let with_suffix = |suffixes: [&str; 2]| {
        let matches = |name: &String| suffixes.iter().any(|suffix| name.ends_with(suffix));
        listing.iter().filter(|(name, _)| is_arithmetic(name) && matches(name)).count()
    };
    (with_suffix(["pd", "ps"]), with_suffix(["sd", "ss"]))
}

/// Code with arrays of common sizes, lanes, and the functions that only friction needs.
const ARRAYS: &str = r#"
use runtime::{F32x16, F64x8, Scalar};
macro_rules! arrays {
    ($($name:ident: $float:ty, $n:literal;)*) => {$(
        #[unsafe(no_mangle)]
        pub fn $name(angles: &[$float; $n]) -> ([$float; $n], [$float; $n]) {
            Scalar::sin_cos_array(angles)
        }
    )*};
}
arrays! {
    double_3: f64, 3; double_6: f64, 6; double_7: f64, 7; double_8: f64, 8;
    single_3: f32, 3; single_6: f32, 6; single_7: f32, 7; single_8: f32, 8; single_16: f32, 16;
}
#[unsafe(no_mangle)] pub fn sin_cos_f64x8(x: &F64x8) -> (F64x8, F64x8) { x.sin_cos() }
#[unsafe(no_mangle)] pub fn sin_cos_f32x16(x: &F32x16) -> (F32x16, F32x16) { x.sin_cos() }
#[unsafe(no_mangle)] pub fn product_f64x8(x: &F64x8, y: &F64x8) -> F64x8 { x.mul_add(*y, *x) }
"#;

const NUMBERS: &str = r#"
use runtime::Scalar;
macro_rules! numbers {
    ($($name:ident: $float:ty, $function:expr;)*) => {$(
        #[unsafe(no_mangle)] pub fn $name(x: $float) -> $float { $function(x) }
    )*};
}
numbers! {
    sine_f64: f64, |x| Scalar::sin_cos(x).0; cosine_f32: f32, |x| Scalar::sin_cos(x).1;
    root_f64: f64, Scalar::sqrt; root_f32: f32, Scalar::sqrt;
    sign_f64: f64, Scalar::signum0; sign_f32: f32, Scalar::signum0;
    tanh_f64: f64, Scalar::tanh; tanh_f32: f32, Scalar::tanh;
    recip_f64: f64, Scalar::recip_positive; recip_f32: f32, Scalar::recip_positive;
}
"#;

/// Code that resembles generated code for many states.
const STATES: &str = r#"
macro_rules! states {
    ($($name:ident: $float:ty;)*) => {$(
        #[unsafe(no_mangle)]
        pub fn $name(q: &[[$float; 3]; 8], qd: &[[$float; 3]; 8]) -> [[$float; 3]; 8] {
            let mut torques = [[0.0; 3]; 8];
            for ((torque, q), qd) in torques.iter_mut().zip(q).zip(qd) {
                let (s, c) = runtime::sin_cos_each(q);
                let h = s[1] * c[2] + c[1] * s[2];
                let i = 1.5 + 0.25 * c[1] * h;
                let w = (i * qd[0] + 0.5 * s[0], c[0] * qd[1] - h * qd[2], qd[1] + qd[2]);
                *torque = [w.0 * i + w.1 * h, w.1 * w.2 - s[0] * w.0, w.2 * h + c[0] * w.1];
            }
            torques
        }
    )*};
}
states! { states_f64: f64; states_f32: f32; }
"#;

fn on_each<'a>(
    functions: &'a BTreeMap<String, Listing>,
    prefix: &'a str,
) -> impl Iterator<Item = (&'a String, &'a Listing)> {
    functions.iter().filter(move |(name, _)| name.starts_with(prefix))
}

#[test]
fn arrays_are_computed_in_vector_registers_without_branches() {
    if !is_installed(X86) {
        return;
    }
    for cpu in ["x86-64", "x86-64-v3", "x86-64-v4"] {
        for feature in [&[][..], &["--cfg", "feature=\"std\""]] {
            let target_cpu = format!("-Ctarget-cpu={cpu}");
            let options = [&["-Copt-level=3", &target_cpu], feature].concat();
            let mut functions = compile("arrays", ARRAYS, X86, &options);
            // The runtime queries the processor once, in kernels that are dispatched.
            functions.retain(|name, _| !name.contains("processor"));
            assert_eq!(functions.len(), 12, "{:?}", functions.keys());
            for (name, listing) in &functions {
                assert_eq!(jumps(listing), 0, "{name} on {cpu} jumps");
                assert_eq!(count(listing, &["call"]), 0, "{name} on {cpu} calls");
                let (packed, scalar) = arithmetic(listing);
                assert!(
                    packed > 0 && scalar == 0,
                    "{name} on {cpu}: {packed} packed, {scalar} not"
                );
            }
        }
    }
}

#[test]
fn states_are_computed_side_by_side_at_either_level() {
    if !is_installed(X86) {
        return;
    }
    for cpu in ["x86-64", "x86-64-v3", "x86-64-v4"] {
        for level in ["-Copt-level=2", "-Copt-level=3"] {
            let target_cpu = format!("-Ctarget-cpu={cpu}");
            let functions = compile("states", STATES, X86, &[level, &target_cpu]);
            assert_eq!(on_each(&functions, "states_").count(), 2);
            for (name, listing) in on_each(&functions, "states_") {
                let (packed, scalar) = arithmetic(listing);
                assert!(packed > 50 && scalar == 0, "{name} on {cpu}, {level}: {packed}, {scalar}");
            }
        }
    }
}

#[test]
fn numbers_are_computed_without_branches_in_every_profile() {
    if !is_installed(X86) {
        return;
    }
    for level in ["-Copt-level=1", "-Copt-level=2", "-Copt-level=3"] {
        let functions = compile("numbers", NUMBERS, X86, &[level]);
        assert_eq!(functions.len(), 10, "{:?}", functions.keys());
        for (name, listing) in &functions {
            assert_eq!(jumps(listing), 0, "{name} at {level} jumps");
            assert_eq!(count(listing, &["call"]), 0, "{name} at {level} calls");
        }
    }
}

/// On a Cortex-M4F, single precision stays in registers, without calls of software double precision.
#[test]
fn single_precision_is_flat_on_a_microcontroller() {
    if !is_installed(CORTEX_M4F) {
        return;
    }
    for level in ["-Copt-level=s", "-Copt-level=3"] {
        let functions = compile("microcontroller", NUMBERS, CORTEX_M4F, &[level]);
        for name in ["cosine_f32", "root_f32", "sign_f32", "tanh_f32", "recip_f32"] {
            let listing = &functions[name];
            println!("{name} at {level}: {} instructions", listing.len());
            let jumps =
                ["beq", "bne", "bgt", "blt", "bge", "ble", "bhi", "bls", "bcc", "bcs", "cb"];
            assert_eq!(count(listing, &jumps), 0, "{name} at {level} jumps");
            assert_eq!(count(listing, &["bl\0", "blx"]), 0, "{name} at {level} calls");
            assert!(listing.iter().all(|(operation, _)| operation != "bl"), "{name} calls");
        }
    }
}

#[test]
fn compiles_for_targets_without_a_standard_library() {
    for target in [CORTEX_M4F, "wasm32-unknown-unknown"] {
        if is_installed(target) {
            for level in ["-Copt-level=0", "-Copt-level=3"] {
                let source = format!("{ARRAYS}\n{STATES}");
                let functions = compile("portable", &source, target, &[level]);
                assert!(functions.contains_key("double_6"), "{:?}", functions.keys());
            }
        }
    }
}
