//! Reciprocals of divisors that are positive unless there is an error: [`recip_positive_f64`] and
//! [`recip_positive_f32`].

macro_rules! recip_positive {
    ($name:ident, $float:ident, $integer:ident, $unsigned:ident) => {
        /// Returns 1/x if x is above 0 and finite, otherwise NaN; without a branch.
        #[inline(always)]
        #[must_use]
        pub const fn $name(x: $float) -> $float {
            // Uses the signs of differences, because LLVM turns comparisons into jumps.
            const LARGEST: $integer = $float::MAX.to_bits() as $integer;
            let bits = x.to_bits() as $integer;
            let outside = bits.wrapping_sub(1) | LARGEST.wrapping_sub(bits);
            let nan = (outside >> ($integer::BITS - 1)) as $unsigned;
            $float::from_bits((1.0 / x).to_bits() | nan)
        }
    };
}

recip_positive!(recip_positive_f64, f64, i64, u64);
recip_positive!(recip_positive_f32, f32, i32, u32);
