//! The functions of the runtime as vector instructions: the same operations in the same order, with bit masks
//! where the runtime uses them.

use robot_runtime::FUSED;
use robot_runtime::tanh::TANH_F64;
use robot_runtime::trig::double::{COSINE, HALF_PI, LIMIT, SHIFT, SHORT_HALF_PI, SINE};
use robot_symbolic::Function;

use super::Binary::{
    Add, AddInteger, And, Div, GreaterInteger, Min, Mul, Or, Sub, SubInteger, Xor,
};
use super::{Id, Instruction, Writer};
use crate::processor::Registers;

const SIGN: u64 = 1 << 63;
const INFINITE: u64 = f64::INFINITY.to_bits();
/// The number of bits of the fraction, without those of the exponent and the sign.
const FRACTION: u8 = 52;

impl Writer<'_> {
    /// Appends a function of a value, except sine and cosine, which are computed in pairs.
    pub(super) fn call(&mut self, function: Function, x: Id) -> Id {
        match function {
            Function::Sin => self.sin_cos(x).0,
            Function::Cos => self.sin_cos(x).1,
            Function::Sqrt => self.value(Instruction::Sqrt(x)),
            Function::Abs => self.abs(x),
            Function::Sign => self.sign(x),
            Function::Tanh => self.tanh(x),
            Function::RecipPositive => self.recip_positive(x),
        }
    }

    pub(super) fn neg(&mut self, x: Id) -> Id {
        let sign = self.bits(SIGN);
        self.binary(Xor, x, sign)
    }

    fn abs(&mut self, x: Id) -> Id {
        let mask = self.bits(!SIGN);
        self.binary(And, x, mask)
    }

    /// Sets all bits in lanes with the sign bit set, none in others.
    fn spread_sign(&mut self, x: Id) -> Id {
        match self.registers {
            Registers::Avx2 => {
                let zero = self.bits(0);
                self.binary(GreaterInteger, zero, x)
            }
            Registers::Avx512 | Registers::Bits128 => self.value(Instruction::SpreadSign(x)),
        }
    }

    /// a b + c with two roundings.
    fn twice(&mut self, a: Id, b: Id, c: Id) -> Id {
        let product = self.binary(Mul, a, b);
        self.binary(Add, product, c)
    }

    /// a b + c as in the runtime of this build, whose hyperbolic tangent is fused if the target fuses.
    fn as_built(&mut self, a: Id, b: Id, c: Id) -> Id {
        match FUSED {
            true => self.value(Instruction::MulAdd(a, b, c)),
            false => self.twice(a, b, c),
        }
    }

    /// a b + c as in sines and cosines.
    fn multiply_add(&mut self, a: Id, b: Id, c: Id) -> Id {
        match self.fused {
            true => self.value(Instruction::MulAdd(a, b, c)),
            false => self.twice(a, b, c),
        }
    }

    /// `trig::double::portable_sin_cos`, or `sin_cos` of a target with multiply-adds.
    pub(super) fn sin_cos(&mut self, angle: Id) -> (Id, Id) {
        let (turns, shift) = (self.number(std::f64::consts::FRAC_2_PI), self.number(SHIFT));
        let shifted = self.multiply_add(angle, turns, shift);
        let k = self.binary(Sub, shifted, shift);
        let mut r = self.nan_unless_below(angle, LIMIT);
        let (first, last): (&[f64], f64) = match self.fused {
            true => (&HALF_PI[..2], HALF_PI[2]),
            false => (&SHORT_HALF_PI[..3], SHORT_HALF_PI[3]),
        };
        for part in first {
            let part = self.number(-part);
            r = self.multiply_add(k, part, r);
        }
        let last = self.number(-last);
        let rest = self.binary(Mul, k, last);
        let z = self.binary(Mul, r, r);
        let z2 = self.binary(Mul, z, z);
        let rz = self.binary(Mul, r, z);

        let polynomial = self.polynomial(&SINE, z, z2);
        let behind = self.multiply_add(rz, polynomial, rest);
        let sine = self.binary(Add, r, behind);

        let polynomial = self.polynomial(&COSINE, z, z2);
        let (half, one) = (self.number(-0.5), self.number(1.0));
        let cosine = self.multiply_add(z, polynomial, half);
        let cosine = self.multiply_add(z, cosine, one);
        self.turned(shifted, sine, cosine)
    }

    /// x, or NaN in lanes in which its magnitude is not below the limit.
    fn nan_unless_below(&mut self, x: Id, limit: f64) -> Id {
        let magnitude = self.abs(x);
        let offset = self.bits(SIGN - limit.to_bits());
        let carried = self.binary(AddInteger, magnitude, offset);
        let beyond = self.spread_sign(carried);
        self.binary(Or, beyond, x)
    }

    /// A polynomial in Estrin's order.
    fn polynomial(&mut self, c: &[f64; 6], z: Id, z2: Id) -> Id {
        let [low, middle, high] = [0, 2, 4].map(|at| {
            let (low, high) = (self.number(c[at]), self.number(c[at + 1]));
            self.multiply_add(z, high, low)
        });
        let upper = self.multiply_add(high, z2, middle);
        self.multiply_add(upper, z2, low)
    }

    /// Sine and cosine of r + k·π/2 from those of r; the low bits of the value `k` are those of the integer k.
    fn turned(&mut self, k: Id, sine: Id, cosine: Id) -> (Id, Id) {
        let sign = self.bits(SIGN);
        let odd = self.value(Instruction::ShiftLeft(k, 63));
        let odd = self.spread_sign(odd);
        let different = self.binary(Xor, sine, cosine);
        let swap = self.binary(And, odd, different);
        let (sine, cosine) = (self.binary(Xor, sine, swap), self.binary(Xor, cosine, swap));

        let half = self.value(Instruction::ShiftLeft(k, 62));
        let sine_sign = self.binary(And, half, sign);
        // (k + 1) · 2⁶² = k · 2⁶² + 2⁶².
        let quarter = self.bits(1 << 62);
        let next = self.binary(AddInteger, half, quarter);
        let cosine_sign = self.binary(And, next, sign);
        (self.binary(Xor, sine, sine_sign), self.binary(Xor, cosine, cosine_sign))
    }

    /// `Scalar::signum0`.
    fn sign(&mut self, x: Id) -> Id {
        let (sign, one) = (self.bits(SIGN), self.number(1.0));
        let (zero, infinite) = (self.bits(0), self.bits(INFINITE));
        let signed = self.binary(And, x, sign);
        let unit = self.binary(Or, signed, one);
        // The sign of each integer difference says which is larger, because magnitudes do not have the sign bit set.
        let magnitude = self.abs(x);
        let not_zero = self.binary(SubInteger, zero, magnitude);
        let not_zero = self.spread_sign(not_zero);
        let nan = self.binary(SubInteger, infinite, magnitude);
        let nan = self.spread_sign(nan);
        let (unit, nan) = (self.binary(And, unit, not_zero), self.binary(And, nan, x));
        self.binary(Or, unit, nan)
    }

    /// `Scalar::recip_positive`.
    fn recip_positive(&mut self, x: Id) -> Id {
        let (minus_one, largest) = (self.bits(u64::MAX), self.bits(f64::MAX.to_bits()));
        let one = self.number(1.0);
        let below = self.binary(AddInteger, x, minus_one);
        let above = self.binary(SubInteger, largest, x);
        let outside = self.binary(Or, below, above);
        let nan = self.spread_sign(outside);
        let reciprocal = self.binary(Div, one, x);
        self.binary(Or, reciprocal, nan)
    }

    /// `Scalar::tanh`.
    fn tanh(&mut self, x: Id) -> Id {
        let numbers = TANH_F64;
        let [two, one, sign, limit, shift] =
            [2.0, 1.0, -0.0, numbers.saturated, numbers.shift].map(|number| self.number(number));
        let magnitude = self.abs(x);
        let doubled = self.binary(Mul, magnitude, two);
        let y = self.binary(Min, limit, doubled);

        let log = self.number(std::f64::consts::LOG2_E);
        let shifted = self.as_built(y, log, shift);
        let n = self.binary(Sub, shifted, shift);
        let mut r = y;
        for part in numbers.ln_2 {
            let part = self.number(-part);
            r = self.as_built(n, part, r);
        }
        let mut coefficients = numbers.exponential.iter();
        // The first step 0 · r + c would be c, or NaN if r is, and later steps also give NaN then.
        let mut e = self.number(coefficients.next().copied().unwrap_or_default());
        for coefficient in coefficients {
            let coefficient = self.number(*coefficient);
            e = self.as_built(r, e, coefficient);
        }
        let square = self.binary(Mul, r, r);
        let e = self.as_built(square, e, r);

        let exponent = self.value(Instruction::ShiftLeft(shifted, FRACTION));
        let power = self.binary(AddInteger, exponent, one);
        let less = self.binary(Sub, power, one);
        let t = self.as_built(power, e, less);
        let divisor = self.binary(Add, t, two);
        let quotient = self.binary(Div, t, divisor);
        let (magnitude, signed) = (self.abs(quotient), self.binary(And, x, sign));
        self.binary(Or, magnitude, signed)
    }
}
