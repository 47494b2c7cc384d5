//! Digests of results, one for each function of each robot.

use std::collections::BTreeMap;

use robot_codegen::Scalar;

use crate::files;
use crate::work::Work;

/// The path of the file with the digests.
pub const FILE: &str = "crates/robot_languages/digests.txt";

/// The first 16 digits of the SHA-256 of the results as bytes; all NaN have the same bytes.
#[must_use]
pub fn digest(results: &[f64]) -> String {
    let bytes = results.iter().flat_map(|value| {
        let value = if value.is_nan() { f64::NAN } else { *value };
        value.to_le_bytes()
    });
    let hash = hmac_sha256::Hash::hash(&bytes.collect::<Vec<u8>>());
    hash[..8].iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Reads the committed digests, by robot, type and function.
///
/// # Errors
///
/// The file cannot be read.
pub fn committed() -> Result<BTreeMap<String, String>, String> {
    let path = files::root().join(FILE);
    let text = std::fs::read_to_string(path).map_err(|error| format!("{FILE}: {error}"))?;
    let lines = text.lines().filter_map(|line| line.rsplit_once(' '));
    Ok(lines.map(|(name, digest)| (name.to_owned(), digest.to_owned())).collect())
}

/// Prints the file of digests.
#[must_use]
pub fn text(digests: &BTreeMap<String, String>) -> String {
    let lines = digests.iter().map(|(name, digest)| format!("{name} {digest}\n"));
    lines.collect()
}

/// The name of a function's digest: `ur5 f64 gravity`.
#[must_use]
pub fn name(work: &Work, function: &str) -> String {
    format!("{} {} {function}", work.programs.module.name, type_name(work.options.scalar))
}

/// The name of a number type.
#[must_use]
pub fn type_name(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::F64 => "f64",
        Scalar::F32 => "f32",
    }
}
