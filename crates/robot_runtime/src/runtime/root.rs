//! Square root: the processor's with feature `std`, otherwise [`software_sqrt_f64`] and
//! [`software_sqrt_f32`], whose bits were the same for all numbers that were tried (every `f32`).

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
        $name:ident, $float:ident, $integer:ident, $unsigned:ident,
        magic = $magic:literal, split = $split:literal, bias = $bias:literal, scale = $scale:literal
    ) => {
        /// Square root of `x` from additions and multiplications, without a branch: an estimate of 1/√x from the
        /// halved exponent (Lomont, *Fast inverse square root*, 2003), Newton steps, and a correction by the exact
        /// residual x − s² (Dekker's product, 1971).
        ///
        /// Within 0.51 units in the last place; √±0 = ±0, √∞ = ∞, NaN below zero and for NaN.
        #[inline(always)]
        pub fn $name(x: $float) -> $float {
            // Masks are made from signs of differences of bits, because LLVM turns comparisons into jumps.
            let mask = |negative: $integer| negative >> ($integer::BITS - 1);
            let of_bits = |bits: $integer| $float::from_bits(bits as $unsigned);
            let power_of_two =
                |exponent: $integer| of_bits(exponent << ($float::MANTISSA_DIGITS - 1));
            let bits = x.to_bits() as $integer;
            const ONE: $integer = $float::to_bits(1.0) as $integer;
            const INFINITY: $integer = $float::INFINITY.to_bits() as $integer;
            const NAN: $integer = $float::NAN.to_bits() as $integer;

            // 0, ∞ and NaN are their own roots, and a number below zero has none. For these, +0 is used
            // in the computation, whose root has no bits set.
            let is_ordinary = mask(bits.wrapping_neg() & bits.wrapping_sub(INFINITY));
            let is_below_zero = mask(bits & $integer::MIN.wrapping_sub(bits));
            let special = (bits | NAN & is_below_zero) & !is_ordinary;

            // Scaled away from the ends of the range, so that nothing overflows or loses its last bits.
            let below_one = mask(bits.wrapping_sub(ONE));
            let a = of_bits(bits & is_ordinary);
            let up_or_down = (2 * $scale & below_one).wrapping_sub($scale);
            let a = a * power_of_two(up_or_down.wrapping_add($bias));

            #[inline(always)]
            fn newton(half: $float, y: $float) -> $float {
                y * (1.5 - half * y * y)
            }
            let half = 0.5 * a;
            let halved = (a.to_bits() >> 1) as $integer;
            let y = of_bits(halved.wrapping_neg().wrapping_add($magic));
            let y = newton(half, newton(half, newton(half, newton(half, y))));
            let s = a * y;
            let high = $split * s;
            let high = high - (high - s);
            let low = s - high;
            let square = s * s;
            let square_low = ((high * high - square) + 2.0 * high * low) + low * low;
            let root = s + 0.5 * y * ((a - square) - square_low);
            let root = root * power_of_two((up_or_down >> 1).wrapping_neg().wrapping_add($bias));
            of_bits(root.to_bits() as $integer | special)
        }
    };
}

software_sqrt!(
    software_sqrt_f64,
    f64,
    i64,
    u64,
    magic = 0x5fe6_eb50_c7b5_37a9,
    split = 134_217_729.0,
    bias = 1023,
    scale = 512
);
software_sqrt!(
    software_sqrt_f32,
    f32,
    i32,
    u32,
    magic = 0x5f37_59df,
    split = 4097.0,
    bias = 127,
    scale = 64
);
