//! Defines register types for any processor from the names of its instructions.

/// Defines a register type, whose multiply-adds, also those in its sines, round once if `ONCE`.
///
/// SAFETY of every `unsafe` block below: the instructions need a processor that has them. The type is
/// compiled only for such processors, or used only by code that has queried the processor. Loads and
/// stores use references to as many numbers as the register holds, with any alignment.
macro_rules! register {
    (
        $(#[$attribute:meta])*
        $name:ident: [$float:ident; $lanes:literal] as $vector:ident, $integer:ident by $bits:ident,
        polynomials $polynomials:ident,
        load $load:ident, store $store:ident, splat $splat:ident, splat_bits $splat_bits:ident,
        arithmetic $add:ident $sub:ident $mul:ident $div:ident $sqrt:ident $mul_add:ident,
        casts $to_bits:ident $to_float:ident,
        bits $and:ident $or:ident $xor:ident $add_bits:ident $sub_bits:ident,
        shift $shift:ident by $by:literal, not_below |$a:ident, $b:ident| $not_below:expr
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Copy)]
        #[repr(transparent)]
        pub(in super::super) struct $name<const ONCE: bool>($vector);

        impl<const ONCE: bool> $name<ONCE> {
            #[inline(always)]
            fn bits(self) -> $integer {
                unsafe { $to_bits(self.0) }
            }

            #[inline(always)]
            fn from_bits(bits: $integer) -> Self {
                Self(unsafe { $to_float(bits) })
            }

            #[inline(always)]
            fn splat_bits(bits: $bits) -> $integer {
                unsafe { $splat_bits(bits) }
            }

            #[inline(always)]
            fn and(self, bits: $integer) -> Self {
                Self::from_bits(unsafe { $and(self.bits(), bits) })
            }

            #[inline(always)]
            fn or(self, bits: $integer) -> Self {
                Self::from_bits(unsafe { $or(self.bits(), bits) })
            }

            #[inline(always)]
            fn xor(self, bits: $integer) -> Self {
                Self::from_bits(unsafe { $xor(self.bits(), bits) })
            }

            /// Sets all bits of a lane unless its number is below the limit.
            #[inline(always)]
            fn not_below(self, limit: Self) -> $integer {
                let (Self($a), Self($b)) = (self, limit);
                unsafe { $not_below }
            }

            #[inline(always)]
            fn lanes(self) -> [$float; $lanes] {
                let mut lanes = [0.0; $lanes];
                self.store(&mut lanes);
                lanes
            }
        }

        impl<const ONCE: bool> Register<$float, $lanes> for $name<ONCE> {
            #[inline(always)]
            fn load(from: &[$float; $lanes]) -> Self {
                Self(unsafe { $load(from.as_ptr()) })
            }

            #[inline(always)]
            fn store(self, to: &mut [$float; $lanes]) {
                unsafe { $store(to.as_mut_ptr(), self.0) }
            }
        }

        register!(@binary $name, Add, add, $add);
        register!(@binary $name, Sub, sub, $sub);
        register!(@binary $name, Mul, mul, $mul);
        register!(@binary $name, Div, div, $div);

        impl<const ONCE: bool> Neg for $name<ONCE> {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                self.xor(Self::splat_bits($bits::MIN))
            }
        }

        impl<const ONCE: bool> Number<$float> for $name<ONCE> {
            #[inline(always)]
            fn splat(value: $float) -> Self {
                Self(unsafe { $splat(value) })
            }

            #[inline(always)]
            fn multiply_add<const FUSE: bool>(self, factor: Self, addend: Self) -> Self {
                if FUSE {
                    return Self(unsafe { $mul_add(self.0, factor.0, addend.0) });
                }
                self * factor + addend
            }

            #[inline(always)]
            fn nan_unless_below(self, limit: $float) -> Self {
                self.or(self.abs().not_below(<Self as Number<$float>>::splat(limit)))
            }

            #[inline(always)]
            fn apply_quadrant(self, sine: Self, cosine: Self) -> (Self, Self) {
                let (k, one, two) = (self.bits(), Self::splat_bits(1), Self::splat_bits(2));
                unsafe {
                    let odd = $sub_bits(Self::splat_bits(0), $and(k, one));
                    let swap = $and($xor(sine.bits(), cosine.bits()), odd);
                    let sine_sign = $shift::<$by>($and(k, two));
                    let cosine_sign = $shift::<$by>($and($add_bits(k, one), two));
                    (sine.xor($xor(swap, sine_sign)), cosine.xor($xor(swap, cosine_sign)))
                }
            }
        }

        impl<const ONCE: bool> Scalar for $name<ONCE> {
            const ZERO: Self = {
                // SAFETY: both types have the same number of numbers, and any bits are valid numbers.
                unsafe { core::mem::transmute::<[$float; $lanes], Self>([0.0; $lanes]) }
            };
            const ONE: Self = {
                unsafe { core::mem::transmute::<[$float; $lanes], Self>([1.0; $lanes]) }
            };

            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                <Self as Number<$float>>::splat(value as $float)
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                self.multiply_add::<ONCE>(factor, addend)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(unsafe { $sqrt(self.0) })
            }

            #[inline(always)]
            fn abs(self) -> Self {
                self.and(Self::splat_bits($bits::MAX))
            }

            #[inline(always)]
            fn signum0(self) -> Self {
                let magnitude = self.abs();
                let sign = self.and(Self::splat_bits($bits::MIN));
                let unit = sign.or(Self::ONE.bits());
                // Lanes with zero, whose sign is 0, or with NaN, which stays NaN.
                let neither = Self::ZERO.not_below(magnitude);
                let kept = Self::from_bits(neither).xor(Self::splat_bits(-1));
                unit.and(kept.bits()).or(magnitude.and(neither).bits())
            }

            #[inline(always)]
            fn tanh(self) -> Self {
                Self::load(&self.lanes().map(<$float as Scalar>::tanh))
            }

            #[inline(always)]
            fn recip_positive(self) -> Self {
                let infinite = <Self as Number<$float>>::splat($float::INFINITY);
                let reciprocal = Self::ONE / self;
                reciprocal.or(Self::ZERO.not_below(self)).or(self.not_below(infinite))
            }

            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $polynomials::compute::<ONCE, Self>(self)
            }
        }

        impl<const ONCE: bool> PartialEq for $name<ONCE> {
            #[inline]
            fn eq(&self, other: &Self) -> bool {
                self.lanes() == other.lanes()
            }
        }

        impl<const ONCE: bool> fmt::Debug for $name<ONCE> {
            #[inline]
            fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.lanes().fmt(formatter)
            }
        }
    };
    (@binary $name:ident, $operator:ident, $method:ident, $instruction:ident) => {
        impl<const ONCE: bool> $operator for $name<ONCE> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
    };
}

pub(super) use register;
