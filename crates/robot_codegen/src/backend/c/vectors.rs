//! Sines and cosines of several angles at once: in 256-bit vectors of gcc and clang, if these compile them to good
//! code, otherwise one after the other. The bits are the same as for a single angle.

use std::collections::BTreeSet;

use super::helpers::Writer;
use super::{Dialect, Header};
use crate::backend::common::Scalar;
use crate::backend::flat::polynomials::Circular;
use crate::trigonometry::Trigonometry;

/// The number of values in a register of 256 bits.
fn lanes(scalar: Scalar) -> usize {
    32 / scalar.size()
}

/// The name of the function for a number of angles, without that of the module.
pub(super) fn name(angles: usize) -> String {
    format!("sin_cos_{angles}")
}

/// Prints a vector with the same number in every lane.
pub(super) fn splat(number: &str, scalar: Scalar) -> String {
    let instruction = if scalar == Scalar::F64 { "_mm256_set1_pd" } else { "_mm256_set1_ps" };
    format!("{instruction}({number})")
}

/// The instruction for multiply-adds of vectors that round once.
pub(super) fn mul_add(scalar: Scalar) -> &'static str {
    if scalar == Scalar::F64 { "_mm256_fmadd_pd" } else { "_mm256_fmadd_ps" }
}

/// The numbers of angles, above one, that functions of the module have.
fn counts(header: &Header<'_>) -> BTreeSet<usize> {
    if header.dialect == Dialect::Cuda || header.options.trigonometry == Trigonometry::Standard {
        return BTreeSet::new();
    }
    let counts = header.tree.functions.iter().map(|function| function.sines.len());
    counts.filter(|count| *count > 1).collect()
}

/// Prints the include for vector instructions, if multiply-adds are needed.
pub(super) fn includes(header: &Header<'_>) -> String {
    if counts(header).is_empty() || !header.tree.helpers().mul_add {
        return String::new();
    }
    format!("{CONDITION}\n#include <immintrin.h>\n#endif\n")
}

/// Prints the functions for several angles that the functions of the module call.
pub(super) fn several(writer: &Writer<'_>, fused: bool) -> Vec<String> {
    let counts = counts(writer.header);
    if counts.is_empty() {
        return vec![];
    }
    let mut lines = vector(writer, fused);
    lines.extend(counts.into_iter().flat_map(|count| of(writer, count)));
    lines
}

/// The condition under which vectors are used.
///
/// Without AVX2, clang compiles them well to pairs of 128-bit registers, but gcc 12 does not.
const CONDITION: &str =
    "#if (defined(__GNUC__) && defined(__AVX2__)) || (defined(__clang__) && defined(__SSE2__))";

/// The same condition in terms of the macro that is defined under it.
fn condition(writer: &Writer<'_>) -> String {
    format!("#if defined({})", writer.header.names.private_upper("vectors"))
}

/// Prints the types of vectors, and the function for the sine and cosine of a vector.
fn vector(writer: &Writer<'_>, fused: bool) -> Vec<String> {
    let (inline, real, bits) = (writer.header.inline(), writer.real(), writer.bits());
    let macro_name = writer.header.names.private_upper("vectors");
    let [vector, vector_bits, function] =
        ["vector", "vector_bits", "sin_cos_vector"].map(|name| writer.name(name));
    let (lanes, limit) = (lanes(writer.scalar), Circular::new(writer.scalar).limit);
    let mut lines = Writer::lines(&format!(
        "{CONDITION}
#define {macro_name}
typedef {real} {vector} __attribute__((vector_size(32)));
typedef {bits} {vector_bits} __attribute__((vector_size(32)));

/* Sines and cosines of {lanes} angles, rad, each with the bits that it has alone; NaN from {limit} rad on. */
{inline} void {function}(const {vector} *angles, {vector} *sine, {vector} *cosine)
{{
    const {vector} angle = *angles;
    {vector} shifted, k, x, r, z, s, c;
    {vector_bits} pattern, turns, swap, s_bits, c_bits;"
    ));
    lines.pop();
    lines.extend(writer.sine_and_cosine(fused, lanes));
    lines.pop();
    lines.extend(["#endif", ""].map(str::to_owned));
    lines
}

/// Prints the function for `count` angles.
fn of(writer: &Writer<'_>, count: usize) -> Vec<String> {
    let (inline, real) = (writer.header.inline(), writer.real());
    let [one, vector, of_vector] =
        ["sin_cos", "vector", "sin_cos_vector"].map(|name| writer.name(name));
    let mut lines = vec![
        format!(
            "{inline} void {}(const {real} angles[{count}], {real} s[{count}], {real} c[{count}])",
            writer.name(&name(count))
        ),
        "{".to_owned(),
        condition(writer),
        format!("    {vector} sine, cosine;"),
    ];
    let lanes = lanes(writer.scalar);
    let starts: Vec<usize> = (0..count).step_by(lanes).collect();
    for (index, start) in starts.iter().enumerate() {
        let entry = |lane: usize| match start + lane {
            place if place < count => format!("angles[{place}]"),
            _ => writer.number(0.0),
        };
        // Made from single angles, because a vector that is loaded from an array waits for the stores before it.
        let entries: Vec<String> = (0..lanes).map(entry).collect();
        lines.push(format!("    const {vector} angles{index} = {{{}}};", entries.join(", ")));
    }
    for (index, start) in starts.iter().enumerate() {
        let size = writer.size(lanes.min(count - start));
        lines.push(format!("    {of_vector}(&angles{index}, &sine, &cosine);"));
        lines.push(format!("    memcpy(&s[{start}], &sine, {size});"));
        lines.push(format!("    memcpy(&c[{start}], &cosine, {size});"));
    }
    let rest = format!(
        "#else
    int i;
    for (i = 0; i < {count}; i++) {{
        {one}(angles[i], &s[i], &c[i]);
    }}
#endif
}}"
    );
    lines.extend(Writer::lines(&rest));
    lines
}
