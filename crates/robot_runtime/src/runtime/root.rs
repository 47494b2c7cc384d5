//! Square root: the processor's with feature `std`, else [`software_sqrt_f64`] and
//! [`software_sqrt_f32`], which differ from it in no bit of any number tried (every `f32`).

#[cfg(feature = "std")]
extern crate std;

/// Square root of `x`.
#[inline(always)]
pub(super) fn sqrt_f64(x: f64) -> f64 {
    #[cfg(feature = "std")]
    return x.sqrt();
    #[cfg(not(feature = "std"))]
    return software_sqrt_f64(x);
}

/// Square root of `x`.
#[inline(always)]
pub(super) fn sqrt_f32(x: f32) -> f32 {
    #[cfg(feature = "std")]
    return x.sqrt();
    #[cfg(not(feature = "std"))]
    return software_sqrt_f32(x);
}

macro_rules! software_sqrt {
    (
        $name:ident, $float:ident, $bits:ident,
        magic = $magic:literal, steps = $steps:literal, split = $split:literal,
        bias = $bias:literal, scale = $scale:literal
    ) => {
        /// Square root of `x` by additions and multiplications without a branch: the halved
        /// exponent as estimate of 1/√x (Lomont, *Fast inverse square root*, 2003), Newton steps,
        /// and a correction by the exact residual x − s² (Dekker's product, 1971).
        ///
        /// Within 0.51 units in the last place; √±0 = ±0, √∞ = ∞, NaN below zero and for NaN.
        #[inline(always)]
        pub fn $name(x: $float) -> $float {
            const MANTISSA: u32 = $float::MANTISSA_DIGITS - 1;
            let keep_if = |condition: bool| $bits::from(condition).wrapping_neg();
            // Away from the ends of the range nothing overflows or loses its last bits.
            let below_one = keep_if(x < 1.0);
            let pick = |below: $float, above: $float| {
                $float::from_bits(below.to_bits() & below_one | above.to_bits() & !below_one)
            };
            let power = |exponent: $bits| $float::from_bits(exponent << MANTISSA);
            let a = x * pick(power($bias + $scale), power($bias - $scale));

            let mut y = $float::from_bits(($magic as $bits).wrapping_sub(a.to_bits() >> 1));
            let half = 0.5 * a;
            for _ in 0..$steps {
                y *= 1.5 - half * y * y;
            }
            let s = a * y;
            let high = $split * s;
            let high = high - (high - s);
            let low = s - high;
            let square = s * s;
            let square_low = ((high * high - square) + 2.0 * high * low) + low * low;
            let root = s + 0.5 * y * ((a - square) - square_low);
            let root = root * pick(power($bias - $scale / 2), power($bias + $scale / 2));

            // 0, ∞ and NaN are their own roots; a number below zero has none.
            let ordinary = keep_if((x > 0.0) & (x < $float::INFINITY));
            let negative = keep_if(x < 0.0) & $float::NAN.to_bits();
            $float::from_bits(root.to_bits() & ordinary | x.to_bits() & !ordinary | negative)
        }
    };
}

software_sqrt!(
    software_sqrt_f64,
    f64,
    u64,
    magic = 0x5fe6_eb50_c7b5_37a9,
    steps = 4,
    split = 134_217_729.0,
    bias = 1023,
    scale = 512
);
software_sqrt!(
    software_sqrt_f32,
    f32,
    u32,
    magic = 0x5f37_59df,
    steps = 3,
    split = 4097.0,
    bias = 127,
    scale = 64
);
