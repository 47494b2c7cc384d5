//! Distances in units in the last place of the largest output.

use robot_codegen::Scalar;

use crate::work::Calls;

/// The unit in the last place of a number's size in a type; that of the smallest normal number below it.
#[must_use]
pub fn unit(size: f64, scalar: Scalar) -> f64 {
    let (smallest, bits) = match scalar {
        Scalar::F64 => (f64::MIN_POSITIVE, 52),
        Scalar::F32 => (f64::from(f32::MIN_POSITIVE), 23),
    };
    let exponent = (size.max(smallest).to_bits() >> 52) & 0x7ff;
    f64::from_bits(exponent << 52) / f64::from(2.0_f32).powi(bits)
}

/// The largest distance of results from those of the interpreter, over all states: each in units of the state's largest
/// output. Where the interpreter gives no finite number, the result must be none; if `any`, it may be any.
#[must_use]
pub fn largest(calls: &Calls, results: &[f64], scalar: Scalar, any: bool) -> f64 {
    let width = calls.given.max(1);
    let states = calls.expected.chunks(width).zip(results.chunks(width));
    let distances = states.map(|(expected, found)| {
        let sizes = expected.iter().map(|value| value.abs()).filter(|size| size.is_finite());
        let unit = unit(sizes.fold(0.0, f64::max), scalar);
        let distances = expected.iter().zip(found).map(|(expected, found)| {
            match (expected.is_finite(), found.is_finite()) {
                (true, true) => (expected - found).abs() / unit,
                (false, _) if any => 0.0,
                (false, false) => 0.0,
                _ => f64::INFINITY,
            }
        });
        distances.fold(0.0, f64::max)
    });
    distances.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_in_units_of_the_largest_output() {
        assert_eq!(unit(1.0, Scalar::F64), f64::EPSILON);
        assert_eq!(unit(3.9, Scalar::F32), 2.0 * f64::from(f32::EPSILON));
        let calls = Calls {
            name: String::new(),
            taken: 1,
            given: 2,
            inputs: vec![],
            expected: vec![1.5, 0.25, 8.0, f64::NAN],
        };
        let far = [1.5, 0.25 + 3.0 * f64::EPSILON, 8.0, f64::NAN];
        assert_eq!(largest(&calls, &far, Scalar::F64, false), 3.0);
        let number = [1.5, 0.25, 8.0, 1.0];
        assert_eq!(largest(&calls, &number, Scalar::F64, false), f64::INFINITY);
        assert_eq!(largest(&calls, &number, Scalar::F64, true), 0.0);
    }
}
