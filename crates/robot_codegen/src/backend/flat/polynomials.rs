//! The runtime's sine, cosine and hyperbolic tangent as assignments, for languages without a runtime.

use robot_runtime::tanh::{TANH_F32, TANH_F64, Tanh};
use robot_runtime::trig::{double, single};

use crate::backend::common::Scalar;

/// The spelling of the assignments in a language.
pub trait Arithmetic {
    /// A number of either sign.
    fn number(&self, value: f64) -> String;

    /// The operator of products.
    fn times(&self) -> &'static str {
        "*"
    }

    /// a b + c; by default, a product and a sum.
    fn mul_add(&self, a: &str, b: &str, c: &str) -> String {
        format!("{a} {} {b} + {c}", self.times())
    }
}

/// An assignment: a variable and its new value.
pub type Assignment = (&'static str, String);

/// The constants of sine and cosine in a number type.
pub struct Circular {
    scalar: Scalar,
    /// The limit below which angles must be, in rad.
    pub limit: f64,
    /// A number that rounds smaller numbers when it is added: the low bits of the sum are the nearest integer.
    pub shift: f64,
    /// 2/π.
    pub two_over_pi: f64,
    half_pi: [f64; 3],
    short_half_pi: [f64; 4],
    /// The coefficients of the sine's polynomial, from the lowest.
    pub sine: Vec<f64>,
    /// The coefficients of the cosine's polynomial, from the lowest.
    pub cosine: Vec<f64>,
}

impl Circular {
    /// Returns the constants for a number type.
    #[must_use]
    pub fn new(scalar: Scalar) -> Circular {
        let wide = |values: &[f32]| values.iter().map(|value| f64::from(*value)).collect();
        match scalar {
            Scalar::F64 => Circular {
                scalar,
                limit: double::LIMIT,
                shift: double::SHIFT,
                two_over_pi: std::f64::consts::FRAC_2_PI,
                half_pi: double::HALF_PI,
                short_half_pi: double::SHORT_HALF_PI,
                sine: double::SINE.to_vec(),
                cosine: double::COSINE.to_vec(),
            },
            Scalar::F32 => Circular {
                scalar,
                limit: f64::from(single::LIMIT),
                shift: f64::from(single::SHIFT),
                two_over_pi: f64::from(std::f32::consts::FRAC_2_PI),
                half_pi: single::HALF_PI.map(f64::from),
                short_half_pi: single::SHORT_HALF_PI.map(f64::from),
                sine: wide(&single::SINE),
                cosine: wide(&single::COSINE),
            },
        }
    }

    /// Computes the number `k` of right angles in `angle`, rounded to an integer, and `shifted`, whose lowest bits are
    /// those of `k`.
    pub fn turns(&self, language: &impl Arithmetic) -> Vec<Assignment> {
        let number = |value: f64| language.number(value);
        let shifted = language.mul_add("angle", &number(self.two_over_pi), &number(self.shift));
        vec![("shifted", shifted), ("k", format!("shifted - {}", number(self.shift)))]
    }

    /// Computes the sine `s` and cosine `c` of the angle minus `k` right angles from `k` and `x`, which is the angle or
    /// NaN, with intermediate variables `r` and `z`. `once` is whether the multiply-adds of the language round once.
    pub fn rest(&self, language: &impl Arithmetic, once: bool) -> Vec<Assignment> {
        let number = |value: f64| language.number(value);
        let times = language.times();
        let (parts, last) = self.parts_of_half_pi(once);
        let mut steps = vec![];
        let mut from = "x";
        for part in parts {
            steps.push(("r", language.mul_add("k", &number(-part), from)));
            from = "r";
        }
        steps.push(("z", format!("r {times} r")));
        let rz = format!("(r {times} z)");
        steps.push(("s", self.polynomial(&self.sine, language)));
        match last {
            Some(last) => {
                steps.push(("k", format!("-(k {times} {})", number(last))));
                steps.push(("s", format!("r + ({})", language.mul_add(&rz, "s", "k"))));
            }
            None => steps.push(("s", language.mul_add(&rz, "s", "r"))),
        }
        steps.push(("c", self.polynomial(&self.cosine, language)));
        steps.push(("c", language.mul_add("z", "c", &number(-0.5))));
        steps.push(("c", language.mul_add("z", "c", &number(1.0))));
        steps
    }

    /// Returns the parts of π/2 that are subtracted from the angle one after the other, and the part that corrects only
    /// the sine.
    #[must_use]
    pub fn parts_of_half_pi(&self, once: bool) -> (&[f64], Option<f64>) {
        match (once, self.scalar) {
            (true, Scalar::F64) => (&self.half_pi[..2], Some(self.half_pi[2])),
            (true, Scalar::F32) => (&self.half_pi, None),
            (false, Scalar::F64) => (&self.short_half_pi[..3], Some(self.short_half_pi[3])),
            (false, Scalar::F32) => (&self.short_half_pi, None),
        }
    }

    /// Prints a polynomial in `z`, in Estrin's order in double precision and in Horner's order in single precision.
    fn polynomial(&self, c: &[f64], language: &impl Arithmetic) -> String {
        let number = |value: f64| language.number(value);
        let add = |a: &str, b: &str, c: &str| language.mul_add(a, b, c);
        if let [c0, c1, c2, c3, c4, c5] = *c {
            let pair = |low: f64, high: f64| format!("({})", add(&number(high), "z", &number(low)));
            let zz = format!("(z {} z)", language.times());
            let inner = add(&pair(c4, c5), &zz, &pair(c2, c3));
            return add(&format!("({inner})"), &zz, &pair(c0, c1));
        }
        let mut text = String::new();
        for coefficient in c.iter().rev() {
            let coefficient = number(*coefficient);
            text = match text.as_str() {
                "" => coefficient,
                _ => format!("({})", add(&text, "z", &coefficient)),
            };
        }
        text
    }
}

/// The constants of the hyperbolic tangent in a number type.
pub struct HyperbolicTangent {
    scalar: Scalar,
    /// The value of 2|x| from which on the result rounds to 1.
    pub saturated: f64,
    /// A number that rounds smaller numbers when it is added: the low bits of the sum are the nearest integer.
    pub shift: f64,
    /// ln 2 in two parts.
    pub ln_2: [f64; 2],
    /// The coefficients of the exponential's polynomial, from the highest.
    pub exponential: Vec<f64>,
}

impl HyperbolicTangent {
    /// Returns the constants for a number type.
    #[must_use]
    pub fn new(scalar: Scalar) -> HyperbolicTangent {
        match scalar {
            Scalar::F64 => {
                let Tanh { shift, saturated, ln_2, exponential } = TANH_F64;
                let exponential = exponential.to_vec();
                HyperbolicTangent { scalar, saturated, shift, ln_2, exponential }
            }
            Scalar::F32 => {
                let Tanh { shift, saturated, ln_2, exponential } = TANH_F32;
                HyperbolicTangent {
                    scalar,
                    saturated: f64::from(saturated),
                    shift: f64::from(shift),
                    ln_2: ln_2.map(f64::from),
                    exponential: exponential.iter().map(|value| f64::from(*value)).collect(),
                }
            }
        }
    }

    /// The logarithm of e to base 2.
    #[must_use]
    pub fn log2_e(&self) -> f64 {
        match self.scalar {
            Scalar::F64 => std::f64::consts::LOG2_E,
            Scalar::F32 => f64::from(std::f32::consts::LOG2_E),
        }
    }

    /// Computes from `y`, the smaller of 2|x| and [`saturated`](Self::saturated), the exponent `n` of a power of two,
    /// `shifted`, whose lowest bits are those of `n`, and `e`, which is eʳ − 1 for the remainder `r`.
    pub fn rest(&self, language: &impl Arithmetic) -> Vec<Assignment> {
        let number = |value: f64| language.number(value);
        let log2_e = self.log2_e();
        let [high, low] = self.ln_2;
        let mut steps = vec![
            ("shifted", language.mul_add("y", &number(log2_e), &number(self.shift))),
            ("n", format!("shifted - {}", number(self.shift))),
            ("r", language.mul_add("n", &number(-high), "y")),
            ("r", language.mul_add("n", &number(-low), "r")),
            ("e", number(0.0)),
        ];
        let coefficients = self.exponential.iter();
        steps.extend(coefficients.map(|value| ("e", language.mul_add("e", "r", &number(*value)))));
        let rr = format!("r {} r", language.times());
        steps.push(("e", language.mul_add(&rr, "e", "r")));
        steps
    }
}
