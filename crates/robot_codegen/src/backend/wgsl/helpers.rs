//! The helper functions that printed WGSL calls. They are those of the runtime, except that numbers are rounded to
//! integers by a function of WGSL. The runtime adds and subtracts a large number, but WGSL lets compilers reorder sums.

use super::{Printer, number};
use crate::backend::common::Scalar;
use crate::backend::flat::polynomials::{Arithmetic, Assignment, Circular, HyperbolicTangent};
use crate::trigonometry::Trigonometry;

struct Plain;

impl Arithmetic for Plain {
    fn number(&self, value: f64) -> String {
        number(value)
    }
}

fn assignments(steps: impl IntoIterator<Item = Assignment>) -> String {
    let lines = steps.into_iter().map(|(name, value)| format!("    {name} = {value};\n"));
    lines.collect::<String>().trim_end().to_owned()
}

/// Prints the helpers that the functions need.
pub(super) fn helpers(printer: &Printer<'_>) -> Vec<String> {
    let needed = printer.tree.helpers();
    let circular = needed.circular && printer.options.trigonometry == Trigonometry::Polynomial;
    let mut text = String::new();
    if circular || needed.recip_positive {
        text.push_str(&not_a_number(printer));
    }
    if circular {
        text.push_str(&sines(printer));
    }
    if needed.recip_positive {
        text.push_str(&recip_positive(printer));
    }
    if needed.tanh {
        text.push_str(&tanh(printer));
    }
    text.lines().map(str::to_owned).collect()
}

/// Prints a function that returns NaN. It reads the bits from a variable, because NaN as a constant is an error.
fn not_a_number(printer: &Printer<'_>) -> String {
    let name = printer.private("not_a_number");
    format!(
        "fn {name}() -> f32 {{
    var bits = 0x7fc00000u;
    return bitcast<f32>(bits);
}}

"
    )
}

fn sines(printer: &Printer<'_>) -> String {
    let numbers = Circular::new(Scalar::F32);
    let rest = assignments(numbers.rest(&Plain, false));
    let (limit, two_over_pi) = (number(numbers.limit), number(numbers.two_over_pi));
    let [sin_cos, sin, cos, nan] =
        ["sin_cos", "sin", "cos", "not_a_number"].map(|name| printer.private(name));
    format!(
        "// Sine and cosine of an angle, rad. By Cody and Waite, Software Manual for the Elementary Functions (1980),
// chapter 8: the angle less k right angles, and minimax polynomials.
fn {sin_cos}(angle: f32) -> vec2<f32> {{
    let x = select({nan}(), angle, abs(angle) < {limit});
    let k = round(x * {two_over_pi});
    let turns = u32(i32(k));
    var r: f32;
    var z: f32;
    var s: f32;
    var c: f32;
{rest}
    let is_odd = (turns & 1u) != 0u;
    let sine = select(s, c, is_odd);
    let cosine = select(c, s, is_odd);
    return vec2<f32>(
        select(sine, -sine, (turns & 2u) != 0u),
        select(cosine, -cosine, ((turns + 1u) & 2u) != 0u),
    );
}}

fn {sin}(angle: f32) -> f32 {{
    return {sin_cos}(angle).x;
}}

fn {cos}(angle: f32) -> f32 {{
    return {sin_cos}(angle).y;
}}

"
    )
}

fn recip_positive(printer: &Printer<'_>) -> String {
    let [name, nan] = ["recip_positive", "not_a_number"].map(|name| printer.private(name));
    let largest = number(f64::from(f32::MAX));
    format!(
        "// 1/x of a number above 0 and finite.
fn {name}(x: f32) -> f32 {{
    return select({nan}(), 1.0f / x, x > 0.0f && x <= {largest});
}}

"
    )
}

fn tanh(printer: &Printer<'_>) -> String {
    let numbers = HyperbolicTangent::new(Scalar::F32);
    // The first two steps, which round to an integer by means of a large number, are skipped.
    let rest = assignments(numbers.rest(&Plain).into_iter().skip(2));
    let (limit, log2_e) = (number(numbers.saturated), number(numbers.log2_e()));
    let name = printer.private("tanh");
    format!(
        "// Hyperbolic tangent.
fn {name}(x: f32) -> f32 {{
    let y = min(2.0f * abs(x), {limit});
    let n = round(y * {log2_e});
    var r: f32;
    var e: f32;
{rest}
    let power = bitcast<f32>(u32(i32(n) + 127) << 23u);
    let t = power * e + (power - 1.0f);
    let result = t / (t + 2.0f);
    return select(result, -result, x < 0.0f);
}}

"
    )
}
