//! Physical limits of bodies: the conditions on principal moments of inertia.

use crate::diagnostic::{code, significant};
use crate::space::eigenvalues;

/// The fraction of the largest principal moment by which rounded values may violate a condition.
pub(crate) const TOLERANCE: f64 = 1e-3;

/// The verdict on an inertia tensor. Principal moments are in ascending order, kg m².
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The tensor is possible; a tensor of zeros describes a point mass.
    Possible,
    /// A principal moment is negative.
    Negative([f64; 3]),
    /// The largest moment exceeds the sum of the others, by this fraction of itself.
    Triangle([f64; 3], f64),
}

/// Judges the tensor `[xx, yy, zz, xy, xz, yz]` about the center of mass.
#[must_use]
pub fn judge(tensor: [f64; 6]) -> Verdict {
    judge_shifted(tensor, 0.0)
}

/// Judges a tensor about the center of mass, of which entries up to `rounding` can be the rounding errors of a tensor
/// that was given about another point: those of a point mass are not exactly 0.
#[must_use]
pub fn judge_shifted(tensor: [f64; 6], rounding: f64) -> Verdict {
    let Some(moments) = principal_moments(tensor) else {
        return Verdict::Possible;
    };
    let [least, middle, largest] = moments;
    let [xx, yy, zz, ..] = tensor;
    let tolerance = (TOLERANCE * largest.abs()).max(rounding);
    if least < -tolerance || xx.min(yy).min(zz) < -rounding {
        return Verdict::Negative(moments);
    }
    if largest > least + middle + tolerance {
        return Verdict::Triangle(moments, 1.0 - (least + middle) / largest);
    }
    Verdict::Possible
}

impl Verdict {
    /// The code of the diagnostic for the verdict.
    pub(crate) fn code(&self) -> &'static str {
        match self {
            Verdict::Triangle(..) => code::INERTIA_TRIANGLE,
            Verdict::Possible | Verdict::Negative(_) => code::INERTIA_SIGN,
        }
    }

    /// The message of the diagnostic, on one line.
    pub(crate) fn message(&self) -> &'static str {
        match self {
            Verdict::Possible => "the inertia is physically possible",
            Verdict::Negative(_) => {
                "the inertia is physically impossible: a principal moment is \
                negative"
            }
            Verdict::Triangle(..) => {
                "the inertia is physically impossible: one principal moment exceeds the sum of \
                 the others"
            }
        }
    }

    /// The principal moments, as a label for the place in the file.
    pub(crate) fn label(&self) -> String {
        match self {
            Verdict::Possible => String::new(),
            Verdict::Negative(moments) | Verdict::Triangle(moments, _) => {
                format!("principal moments {} kg m^2", moments.map(significant).join(", "))
            }
        }
    }
}

/// The eigenvalues of the tensor `[xx, yy, zz, xy, xz, yz]` in ascending order; `None` if all
/// entries are 0.
pub(crate) fn principal_moments(tensor: [f64; 6]) -> Option<[f64; 3]> {
    // Scaled so that no square overflows.
    let scale = tensor.iter().fold(0.0_f64, |scale, entry| scale.max(entry.abs()));
    if scale == 0.0 {
        return None;
    }
    let [xx, yy, zz, xy, xz, yz] = tensor.map(|entry| entry / scale);
    let moments = eigenvalues([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
    Some(moments.map(|moment| moment * scale))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// m (c² − x²) and so on, of which rounding leaves 10⁻¹⁷.
    #[test]
    fn a_shifted_point_mass_may_have_rounding_errors() {
        let tensor = [-2.5e-17, 1e-17, 0.0, 0.0, 0.0, 0.0];
        assert_eq!(judge_shifted(tensor, 1e-12), Verdict::Possible);
        assert!(matches!(judge_shifted(tensor, 0.0), Verdict::Negative(_)));
        assert!(matches!(
            judge_shifted([-2e-12, 0.0, 0.0, 0.0, 0.0, 0.0], 1e-12),
            Verdict::Negative(_)
        ));
    }

    #[test]
    fn principal_moments_are_eigenvalues() {
        assert_eq!(principal_moments([0.0; 6]), None);
        let moments = principal_moments([2.0, 2.0, 5.0, 1.0, 0.0, 0.0]).unwrap();
        for (found, expected) in moments.iter().zip([1.0, 3.0, 5.0]) {
            assert!((found - expected).abs() < 1e-14, "{moments:?}");
        }
        let [least, ..] = principal_moments([1e300, 1e300, 1e300, 2e300, 0.0, 0.0]).unwrap();
        assert!((least + 1e300).abs() < 1e286);
    }

    #[test]
    fn possible_tensors_are_distinguished_from_impossible_ones() {
        let verdict = |tensor| judge(tensor);
        for tensor in [[0.0; 6], [1.0, 2.0, 3.0, 0.0, 0.0, 0.0], [1.0, 1.0, 0.0, 0.0, 0.0, 0.0]] {
            assert_eq!(verdict(tensor), Verdict::Possible, "{tensor:?}");
        }
        // A flat plate with moments 1/3, 1/3 and 2/3, rounded to three digits, exceeds the limit by 0.1 %.
        assert_eq!(verdict([0.333, 0.333, 0.6666, 0.0, 0.0, 0.0]), Verdict::Possible);
        assert!(matches!(verdict([1.0, 1.0, 1.0, 1.5, 0.0, 0.0]), Verdict::Negative(_)));
        assert!(matches!(verdict([-1e-9, 1.0, 1.0, 0.0, 0.0, 0.0]), Verdict::Negative(_)));
        let Verdict::Triangle(_, excess) = verdict([1.0, 1.0, 4.0, 0.0, 0.0, 0.0]) else {
            panic!("a triangle inequality is broken");
        };
        assert!((excess - 0.5).abs() < 1e-14, "{excess}");
    }
}
