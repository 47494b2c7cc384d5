//! The helper functions that printed C calls. They are those of the runtime and have the same bits if products and
//! sums are not fused.

use super::spelling::{literal, number};
use super::{Dialect, Header, macros, vectors};
use crate::backend::common::Scalar;
use crate::backend::flat::Helpers;
use crate::backend::flat::polynomials::{Arithmetic, Assignment, Circular, HyperbolicTangent};
use crate::trigonometry::Trigonometry;

/// Prints the macros, and the helpers that the module needs.
pub(super) fn helpers(header: &Header<'_>) -> Vec<String> {
    let mut lines = macros::macros(header);
    let scalar = header.options.scalar;
    let polynomials = header.options.trigonometry == Trigonometry::Polynomial;
    let functions = header.tree.helpers();
    let constructor = Helpers::of(&header.tree.constructor);
    let all = functions.and(constructor);
    if header.dialect == Dialect::C && (all.tanh || (all.circular && polynomials)) {
        lines.extend(macros::refusal());
    }
    let needed = match scalar {
        Scalar::F64 => vec![(Scalar::F64, functions.and(constructor))],
        Scalar::F32 => vec![(Scalar::F64, constructor), (Scalar::F32, functions)],
    };
    for (scalar, needed) in needed {
        let writer = Writer { header, scalar };
        if needed.mul_add {
            lines.extend(writer.mul_add());
        }
        if needed.circular && polynomials {
            lines.extend(writer.circular(needed.mul_add));
        }
        if scalar == header.options.scalar {
            lines.extend(vectors::several(&writer, needed.mul_add));
        }
        if needed.sign {
            lines.extend(writer.sign());
        }
        if needed.tanh {
            lines.extend(writer.tanh());
        }
        if needed.recip_positive {
            lines.extend(writer.recip_positive());
        }
    }
    lines
}

/// Writes the helpers for a number type.
pub(super) struct Writer<'h> {
    pub(super) header: &'h Header<'h>,
    pub(super) scalar: Scalar,
}

/// Spells multiply-adds: as a product and a sum, or rounded once by the library's function or, in lanes, by an
/// instruction.
struct MulAdd<'w> {
    writer: &'w Writer<'w>,
    once: bool,
    lanes: usize,
}

impl Arithmetic for MulAdd<'_> {
    fn number(&self, value: f64) -> String {
        let number = self.writer.number(value);
        match (self.once, self.lanes) {
            (false, _) | (_, 1) => number,
            (true, _) => vectors::splat(&number, self.writer.scalar),
        }
    }

    fn mul_add(&self, a: &str, b: &str, c: &str) -> String {
        match (self.once, self.lanes) {
            (false, _) => format!("{a} * {b} + {c}"),
            (true, 1) => format!("{}({a}, {b}, {c})", self.writer.library("fma")),
            (true, _) => format!("{}({a}, {b}, {c})", vectors::mul_add(self.writer.scalar)),
        }
    }
}

/// Prints assignments as indented lines `name = value;`.
fn assignments(steps: Vec<Assignment>) -> impl Iterator<Item = String> {
    steps.into_iter().map(|(name, value)| format!("    {name} = {value};"))
}

impl Writer<'_> {
    pub(super) fn real(&self) -> &'static str {
        super::function::real(self.scalar)
    }

    pub(super) fn bits(&self) -> &'static str {
        if self.scalar == Scalar::F64 { "uint64_t" } else { "uint32_t" }
    }

    fn width(&self) -> u32 {
        if self.scalar == Scalar::F64 { 64 } else { 32 }
    }

    pub(super) fn name(&self, name: &str) -> String {
        self.header.names.private(&super::spelling::helper(name, self.scalar))
    }

    fn library(&self, name: &str) -> String {
        super::spelling::library(name, self.scalar)
    }

    pub(super) fn number(&self, value: f64) -> String {
        number(value, self.scalar)
    }

    /// Prints a pattern of bits, such as a mask.
    fn pattern(&self, bits: u64) -> String {
        match self.scalar {
            Scalar::F64 => format!("UINT64_C(0x{bits:016x})"),
            Scalar::F32 => format!("UINT32_C(0x{bits:08x})"),
        }
    }

    /// Returns the bits of a number of the type.
    fn bits_of(&self, value: f64) -> u64 {
        match self.scalar {
            Scalar::F64 => value.to_bits(),
            Scalar::F32 => u64::from((value as f32).to_bits()),
        }
    }

    fn sign_bit(&self) -> u64 {
        1 << (self.width() - 1)
    }

    /// The condition under which fused multiply-adds are fast. clang does not define the C macro for this.
    pub(super) fn fast(&self) -> String {
        let macro_of_c = if self.scalar == Scalar::F64 { "FP_FAST_FMA" } else { "FP_FAST_FMAF" };
        let of_cuda = match self.header.dialect {
            Dialect::C => "",
            Dialect::Cuda => " || defined(__CUDA_ARCH__)",
        };
        format!(
            "#if defined({macro_of_c}) || defined(__FMA__) || defined(__ARM_FEATURE_FMA){of_cuda}"
        )
    }

    pub(super) fn lines(text: &str) -> Vec<String> {
        text.lines().map(str::to_owned).chain([String::new()]).collect()
    }

    fn mul_add(&self) -> Vec<String> {
        let (inline, real, name) = (self.header.inline(), self.real(), self.name("mul_add"));
        let (fast, fma) = (self.fast(), self.library("fma"));
        Writer::lines(&format!(
            "/* a b + c, rounded once where the processor has the instruction. */
{inline} {real} {name}({real} a, {real} b, {real} c)
{{
{fast}
    return {fma}(a, b, c);
#else
    return a * b + c;
#endif
}}"
        ))
    }

    fn circular(&self, fused: bool) -> Vec<String> {
        let (inline, real, bits) = (self.header.inline(), self.real(), self.bits());
        let numbers = Circular::new(self.scalar);
        let mut lines = Writer::lines(&format!(
            "/* Sine and cosine of an angle, rad; NaN from {} rad on. By Cody and Waite, Software Manual for the
 * Elementary Functions (1980), chapter 8: the angle less k right angles, and minimax polynomials. */
{inline} void {}({real} angle, {real} *sine, {real} *cosine)
{{
    {real} shifted, k, x, r, z, s, c;
    {bits} pattern, turns, swap, s_bits, c_bits;",
            numbers.limit,
            self.name("sin_cos")
        ));
        lines.pop();
        lines.extend(self.sine_and_cosine(fused, 1));
        let sin_cos = self.name("sin_cos");
        for (name, value) in [(self.name("sin"), "sine"), (self.name("cos"), "cosine")] {
            lines.extend(Writer::lines(&format!(
                "{inline} {real} {name}({real} angle)
{{
    {real} sine, cosine;
    {sin_cos}(angle, &sine, &cosine);
    return {value};
}}"
            )));
        }
        lines
    }

    /// Prints the body of a function that computes `sine` and `cosine` from `angle`, each a number or a vector of
    /// `lanes` numbers.
    pub(super) fn sine_and_cosine(&self, fused: bool, lanes: usize) -> Vec<String> {
        let numbers = Circular::new(self.scalar);
        let mut lines = vec![];
        if fused {
            lines.push(self.fast());
            lines.extend(self.polynomials(&numbers, true, lanes));
            lines.push("#else".to_owned());
        }
        lines.extend(self.polynomials(&numbers, false, lanes));
        if fused {
            lines.push("#endif".to_owned());
        }
        lines.extend(self.apply_quadrant(lanes));
        lines
    }

    /// The size of a vector of `lanes` numbers, in bytes.
    pub(super) fn size(&self, lanes: usize) -> usize {
        self.scalar.size() * lanes
    }

    /// Prints the assignments of `s` and `c`, the sine and cosine of the angle minus `k` right angles.
    fn polynomials(&self, numbers: &Circular, once: bool, lanes: usize) -> Vec<String> {
        let language = MulAdd { writer: self, once, lanes };
        let size = self.size(lanes);
        let mut lines: Vec<String> = assignments(numbers.turns(&language)).collect();
        let nan = format!(
            "    memcpy(&pattern, &angle, {size});
    turns = (pattern & {}) + {};
    pattern |= 0 - (turns >> {});
    memcpy(&x, &pattern, {size});",
            self.pattern(self.sign_bit() - 1),
            self.pattern(self.sign_bit() - self.bits_of(numbers.limit)),
            self.width() - 1
        );
        lines.extend(nan.lines().map(str::to_owned));
        lines.extend(assignments(numbers.rest(&language, once)));
        lines
    }

    /// Prints the sine and cosine of the angle in terms of `s` and `c`, which are swapped and change sign depending on
    /// the low bits of `k`.
    fn apply_quadrant(&self, lanes: usize) -> Vec<String> {
        let (size, to_sign) = (self.size(lanes), self.width() - 2);
        Writer::lines(&format!(
            "    memcpy(&turns, &shifted, {size});
    memcpy(&s_bits, &s, {size});
    memcpy(&c_bits, &c, {size});
    swap = (s_bits ^ c_bits) & (0 - (turns & 1));
    s_bits ^= swap ^ ((turns & 2) << {to_sign});
    c_bits ^= swap ^ (((turns + 1) & 2) << {to_sign});
    memcpy(sine, &s_bits, {size});
    memcpy(cosine, &c_bits, {size});
}}"
        ))
    }

    fn sign(&self) -> Vec<String> {
        let (inline, real, bits, size) =
            (self.header.inline(), self.real(), self.bits(), self.width() / 8);
        let (name, sign) = (self.name("sign"), self.pattern(self.sign_bit()));
        let one = self.pattern(self.bits_of(1.0));
        Writer::lines(&format!(
            "/* The sign: -1, 0 or 1, and NaN of NaN. */
{inline} {real} {name}({real} x)
{{
    {bits} unit, is_nan;
    {real} result;
    memcpy(&unit, &x, {size});
    is_nan = unit & (0 - ({bits})(x != x));
    unit = ((unit & {sign}) | {one}) & (0 - ({bits})(x != 0));
    unit |= is_nan;
    memcpy(&result, &unit, {size});
    return result;
}}"
        ))
    }

    fn recip_positive(&self) -> Vec<String> {
        let (inline, real, bits, size) =
            (self.header.inline(), self.real(), self.bits(), self.width() / 8);
        let (name, top) = (self.name("recip_positive"), self.width() - 1);
        let largest = match self.scalar {
            Scalar::F64 => f64::MAX.to_bits(),
            Scalar::F32 => u64::from(f32::MAX.to_bits()),
        };
        let (largest, one) = (self.pattern(largest), literal(1.0, self.scalar));
        Writer::lines(&format!(
            "/* 1/x of a number above 0 and finite, NaN of others. */
{inline} {real} {name}({real} x)
{{
    {bits} bits, outside;
    {real} result = {one} / x;
    memcpy(&bits, &x, {size});
    outside = (bits - 1) | ({largest} - bits);
    memcpy(&bits, &result, {size});
    bits |= 0 - (outside >> {top});
    memcpy(&result, &bits, {size});
    return result;
}}"
        ))
    }

    fn tanh(&self) -> Vec<String> {
        let (inline, real, bits, size) =
            (self.header.inline(), self.real(), self.bits(), self.width() / 8);
        let (name, fabs) = (self.name("tanh"), self.library("fabs"));
        let sign = self.pattern(self.sign_bit());
        let numbers = HyperbolicTangent::new(self.scalar);
        let number = |value: f64| self.number(value);
        let language = MulAdd { writer: self, once: false, lanes: 1 };
        let steps: Vec<String> = assignments(numbers.rest(&language)).collect();
        let steps = steps.join("\n");
        let mantissa = if self.scalar == Scalar::F64 { 52 } else { 23 };
        let limit = self.pattern(self.bits_of(numbers.saturated));
        Writer::lines(&format!(
            "/* Hyperbolic tangent. */
{inline} {real} {name}({real} x)
{{
    const {real} twice = {} * {fabs}(x);
    const {bits} beyond = 0 - ({bits})(twice > {});
    {bits} pattern, of_x;
    {real} y, shifted, n, r, e, power, t;
    memcpy(&pattern, &twice, {size});
    pattern = ({limit} & beyond) | (pattern & ~beyond);
    memcpy(&y, &pattern, {size});
{steps}
    memcpy(&pattern, &shifted, {size});
    pattern = (pattern << {mantissa}) + {};
    memcpy(&power, &pattern, {size});
    t = power * e + (power - {});
    t = t / (t + {});
    /* As copysign, which some compilers turn into a branch. */
    memcpy(&pattern, &t, {size});
    memcpy(&of_x, &x, {size});
    pattern = (pattern & ~{sign}) | (of_x & {sign});
    memcpy(&t, &pattern, {size});
    return t;
}}",
            number(2.0),
            number(numbers.saturated),
            self.pattern(self.bits_of(1.0)),
            number(1.0),
            number(2.0)
        ))
    }
}
