//! The helper functions that printed code calls. They are those of the runtime and have the same bits if the runtime
//! does not fuse products and sums.

use super::code::{Code, Kind, Local};
use super::module::Assembly;
use crate::backend::flat::Helpers;
use crate::backend::flat::polynomials::{Circular, HyperbolicTangent};

/// The indices of the helpers for a kind of values; 0 for helpers that are not called.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Functions {
    /// Sine and cosine.
    pub(super) sin_cos: u32,
    /// Cosine.
    pub(super) cos: u32,
    /// The sign.
    pub(super) sign: u32,
    /// Hyperbolic tangent.
    pub(super) tanh: u32,
    /// 1/x of a positive number.
    pub(super) recip_positive: u32,
}

impl Functions {
    /// Adds the helpers that are needed.
    pub(super) fn new(needed: &Helpers, kind: Kind, assembly: &mut Assembly) -> Functions {
        let mut functions = Functions::default();
        let value = kind.value();
        let one = || Code::new(kind, vec![value], vec![value]);
        if needed.circular {
            let code = Code::new(kind, vec![value], vec![value, value]);
            functions.sin_cos = assembly.add(sin_cos(code));
            functions.cos = assembly.add(cos(one(), functions.sin_cos));
        }
        if needed.sign {
            functions.sign = assembly.add(sign(one()));
        }
        if needed.tanh {
            functions.tanh = assembly.add(tanh(one()));
        }
        if needed.recip_positive {
            functions.recip_positive = assembly.add(recip_positive(one()));
        }
        functions
    }
}

const ARGUMENT: Local = Local(0);

/// Writes sine and cosine of an angle in rad, after Cody and Waite, Software Manual for the Elementary Functions
/// (1980), chapter 8: the angle minus k right angles, and minimax polynomials.
fn sin_cos(mut code: Code) -> Code {
    let numbers = Circular::new(code.kind.scalar);
    let [shifted, k, r, z, zz, s, c] = code.values();
    code.get(ARGUMENT).number(numbers.two_over_pi).mul().number(numbers.shift).add().set(shifted);
    code.get(shifted).number(numbers.shift).sub().set(k);
    nan_unless_below(&mut code, numbers.limit);
    let (parts, last) = numbers.parts_of_half_pi(false);
    for part in parts {
        code.set(r).get(k).number(-part).mul().get(r).add();
    }
    code.set(r).get(r).get(r).mul().set(z).get(z).get(z).mul().set(zz);
    polynomial(&mut code, &numbers.sine, z, zz);
    code.set(s);
    match last {
        Some(last) => {
            code.get(r).get(r).get(z).mul().get(s).mul();
            code.get(k).number(last).mul().neg().add().add().set(s);
        }
        None => {
            code.get(r).get(z).mul().get(s).mul().get(r).add().set(s);
        }
    }
    polynomial(&mut code, &numbers.cosine, z, zz);
    code.set(c).get(z).get(c).mul().number(-0.5).add().set(c);
    code.get(z).get(c).mul().number(1.0).add().set(c);
    turned(&mut code, shifted, s, c);
    code
}

/// Writes the argument, or NaN if its absolute value is not below the limit.
fn nan_unless_below(code: &mut Code, limit: f64) {
    let kind = code.kind;
    let rest = kind.sign() - kind.pattern(limit);
    code.get(ARGUMENT).bits_of().pattern(kind.sign() - 1).and().pattern(rest).whole_add();
    code.spread_sign().get(ARGUMENT).bits_of().or().value_of();
}

/// Writes a polynomial in `z`, in Estrin's order in double precision and in Horner's order in single precision.
fn polynomial(code: &mut Code, coefficients: &[f64], z: Local, zz: Local) {
    if let [c0, c1, c2, c3, c4, c5] = *coefficients {
        let pair = |code: &mut Code, low: f64, high: f64| {
            code.number(high).get(z).mul().number(low).add();
        };
        pair(code, c4, c5);
        for (low, high) in [(c2, c3), (c0, c1)] {
            code.get(zz).mul();
            pair(code, low, high);
            code.add();
        }
        return;
    }
    let mut coefficients = coefficients.iter().rev();
    code.number(coefficients.next().copied().unwrap_or_default());
    for coefficient in coefficients {
        code.get(z).mul().number(*coefficient).add();
    }
}

/// Writes sine and cosine of the angle from those of the angle minus k right angles, which are swapped and change sign
/// depending on the low bits of k.
fn turned(code: &mut Code, shifted: Local, s: Local, c: Local) {
    let width = code.kind.width();
    let to_sign = width - 2;
    let [k, swap] = code.patterns();
    code.get(shifted).bits_of().set(k);
    // `swap` has all bits set if k is odd.
    code.get(k).left(width - 1).spread_sign();
    code.get(s).bits_of().get(c).bits_of().xor().and().set(swap);
    code.get(s).bits_of().get(swap).xor();
    code.get(k).pattern(2).and().left(to_sign).xor().value_of();
    code.get(c).bits_of().get(swap).xor();
    code.get(k).pattern(1).whole_add().pattern(2).and().left(to_sign).xor().value_of();
}

fn cos(mut code: Code, sin_cos: u32) -> Code {
    let [cosine] = code.values();
    code.get(ARGUMENT).call(sin_cos).set(cosine).drop().get(cosine);
    code
}

/// Writes the sign function: −1, 0 or 1, and NaN for NaN.
fn sign(mut code: Code) -> Code {
    let kind = code.kind;
    let [unit] = code.patterns();
    code.get(ARGUMENT).bits_of().pattern(kind.sign()).and().pattern(kind.pattern(1.0)).or();
    code.get(ARGUMENT).number(0.0).differs().and().set(unit);
    // For NaN, the bits of the argument are added.
    code.get(ARGUMENT).get(ARGUMENT).differs().get(ARGUMENT).bits_of().and();
    code.get(unit).or().value_of();
    code
}

/// Writes 1/x for finite numbers above 0, and NaN for others.
fn recip_positive(mut code: Code) -> Code {
    let kind = code.kind;
    let [bits] = code.patterns();
    code.get(ARGUMENT).bits_of().set(bits);
    code.get(bits).pattern(1).whole_sub();
    code.pattern(kind.pattern(kind.largest())).get(bits).whole_sub().or().spread_sign();
    code.number(1.0).get(ARGUMENT).div().bits_of().or().value_of();
    code
}

/// Writes the hyperbolic tangent.
fn tanh(mut code: Code) -> Code {
    let kind = code.kind;
    let numbers = HyperbolicTangent::new(kind.scalar);
    let [twice, y, shifted, n, r, e, power, t] = code.values();
    let [beyond] = code.patterns();
    code.number(2.0).get(ARGUMENT).abs().mul().set(twice);
    code.get(twice).number(numbers.saturated).is_above().set(beyond);
    code.pattern(kind.pattern(numbers.saturated)).get(beyond).and();
    code.get(twice).bits_of().get(beyond).pattern(kind.sign() | (kind.sign() - 1)).xor().and();
    code.or().value_of().set(y);
    code.get(y).number(numbers.log2_e()).mul().number(numbers.shift).add().set(shifted);
    code.get(shifted).number(numbers.shift).sub().set(n);
    code.get(y);
    for part in numbers.ln_2 {
        code.set(r).get(n).number(-part).mul().get(r).add();
    }
    code.set(r).number(0.0);
    for coefficient in &numbers.exponential {
        code.get(r).mul().number(*coefficient).add();
    }
    code.set(e).get(r).get(r).mul().get(e).mul().get(r).add().set(e);
    let mantissa = kind.width() - if kind.size() == 8 { 12 } else { 9 };
    code.get(shifted).bits_of().left(mantissa);
    code.pattern(kind.pattern(1.0)).whole_add().value_of().set(power);
    code.get(power).get(e).mul().get(power).number(1.0).sub().add().set(t);
    code.get(t).get(t).number(2.0).add().div().bits_of().pattern(kind.sign() - 1).and();
    code.get(ARGUMENT).bits_of().pattern(kind.sign()).and().or().value_of();
    code
}
