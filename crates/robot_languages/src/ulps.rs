//! Distances in units in the last place of the largest output.

use robot_codegen::Scalar;

use crate::work::Calls;

/// The unit in the last place of a number of this size in a type; for smaller sizes, that of the smallest normal
/// number.
#[must_use]
pub fn unit(size: f64, scalar: Scalar) -> f64 {
    let (smallest, bits) = match scalar {
        Scalar::F64 => (f64::MIN_POSITIVE, 52),
        Scalar::F32 => (f64::from(f32::MIN_POSITIVE), 23),
    };
    let exponent = (size.max(smallest).to_bits() >> 52) & 0x7ff;
    f64::from_bits(exponent << 52) / f64::from(2.0_f32).powi(bits)
}

/// The largest distances between results and those of the interpreter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Distances {
    /// The distance in units in the last place of the function's largest output over all states.
    pub of_function: f64,
    /// The distance in units in the last place of the largest output at its state.
    pub of_state: f64,
}

/// Computes the distances of a function's results. If the interpreter's result is not finite, the other must not be
/// finite either, unless `any` is set.
#[must_use]
pub fn distances(calls: &Calls, results: &[f64], scalar: Scalar, any: bool) -> Distances {
    let width = calls.given.max(1);
    let largest = unit(size(&calls.expected), scalar);
    let mut found = Distances::default();
    for (expected, results) in calls.expected.chunks(width).zip(results.chunks(width)) {
        let unit = unit(size(expected), scalar);
        for (expected, result) in expected.iter().zip(results) {
            let distance = match (expected.is_finite(), result.is_finite()) {
                (true, true) => (expected - result).abs(),
                (false, finite) if any || !finite => 0.0,
                _ => f64::INFINITY,
            };
            found.of_state = found.of_state.max(distance / unit);
            found.of_function = found.of_function.max(distance / largest);
        }
    }
    found
}

/// The largest finite absolute value.
fn size(values: &[f64]) -> f64 {
    let sizes = values.iter().map(|value| value.abs()).filter(|size| size.is_finite());
    sizes.fold(0.0, f64::max)
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
        let far = [1.5, 0.25 + 4.0 * f64::EPSILON, 8.0, f64::NAN];
        let found = distances(&calls, &far, Scalar::F64, false);
        assert_eq!(found, Distances { of_function: 0.5, of_state: 4.0 });
        let number = [1.5, 0.25, 8.0, 1.0];
        let found = distances(&calls, &number, Scalar::F64, false);
        assert_eq!(found.of_function, f64::INFINITY);
        let found = distances(&calls, &number, Scalar::F64, true);
        assert_eq!(found, Distances::default());
    }
}
