//! The pivots of the mass matrix at given states, which show how many correct digits forward dynamics has.

mod perturbed;

use std::fmt;
use std::sync::OnceLock;

use robot_codegen::{Interpreter, Module, ModuleSpec, Rounded, Trigonometry};
use robot_dynamics::functions::Derivation;
use robot_model::functions::FunctionKind;
use robot_model::robot::Robot;
use robot_model::variable::JointVariable;
use robot_symbolic::Graph;

use crate::driver::options::Options;
use crate::driver::programs::MAX_NODES;
use crate::driver::specification;
use crate::error::{Error, Errors};

/// A pivot is reported if it is below this fraction of the joint's entry on the diagonal of M.
const SMALL: f64 = 1e-8;
/// The number of decimal digits of `f64`.
const DIGITS: f64 = 15.0;

/// A program for the pivots of a robot's mass matrix, which is decomposed as in its forward dynamics.
///
/// The pivot of a coordinate is the inertia at its joint if the joints farther out are free.
#[derive(Clone, Debug)]
pub struct Pivots {
    interpreter: Interpreter<'static>,
    joints: Vec<String>,
    matrix: MassMatrix,
}

/// A program for the mass matrix, which is made when it is first needed: that of a long chain takes seconds.
#[derive(Clone, Debug)]
struct MassMatrix {
    robot: Robot,
    options: Options,
    given: Vec<(String, f64)>,
    trigonometry: Trigonometry,
    interpreter: OnceLock<Option<Interpreter<'static>>>,
}

/// A pivot at a state for which forward dynamics has few correct digits or none.
#[derive(Clone, Debug, PartialEq)]
pub struct Pivot {
    /// The joint.
    pub joint: String,
    /// The pivot as a fraction of the joint's entry on the diagonal of M. If the accelerations do not exist at the
    /// state, it is not above 0, or NaN.
    pub part: f64,
    /// The fewest correct decimal digits of a pivot: 0 to 15. The accelerations have at most as many: fewer if forces
    /// cancel. If it is 0, this pivot is only rounding error, and the accelerations do not exist.
    pub digits: u32,
}

impl Pivots {
    /// Derives the pivots of a robot with the parameter values in `given`; all other parameters have their nominal
    /// values.
    ///
    /// # Errors
    ///
    /// A robot that is too large for code, or parameters without a value.
    pub fn new(robot: &Robot, options: &Options, given: &[(&str, f64)]) -> Result<Pivots, Errors> {
        let interpreter = interpreter(robot, options, given, specification::pivots)?;
        let joints = robot.coordinates.iter().map(|coordinate| coordinate.joint.clone()).collect();
        let given = given.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
        let matrix = MassMatrix {
            robot: robot.clone(),
            options: options.clone(),
            given,
            trigonometry: Trigonometry::Standard,
            interpreter: OnceLock::new(),
        };
        Ok(Pivots { interpreter, joints, matrix })
    }

    /// Uses sines and cosines from this source instead of the standard library.
    #[must_use]
    pub fn with_trigonometry(self, trigonometry: Trigonometry) -> Pivots {
        let interpreter = self.interpreter.with_trigonometry(trigonometry);
        let matrix = MassMatrix { trigonometry, interpreter: OnceLock::new(), ..self.matrix };
        Pivots { interpreter, matrix, ..self }
    }

    /// Returns the last pivot in the order of the coordinates that is not positive and finite at these positions, or is
    /// only rounding error. If there is none, returns the pivot that is the smallest part of its joint's entry on the
    /// diagonal of M, if this part is below 10⁻⁸ or a pivot has fewer than eight correct digits.
    ///
    /// # Errors
    ///
    /// The number of positions is wrong.
    pub fn smallest(&self, q: &[f64]) -> Result<Option<Pivot>, robot_codegen::Errors> {
        let positions = [(JointVariable::Position.name(), q)];
        let mut values = self.interpreter.call_rounded("pivots", &positions)?;
        let (pivots, diagonal) = values.split_at_mut(self.joints.len());
        if pivots.iter().any(|pivot| pivot.value > 0.0 && f64::from(digits(pivot)) < DIGITS / 2.0) {
            let errors = self.matrix.errors_of_pivots(q).into_iter().flatten();
            let pairs = pivots.iter_mut().zip(errors).filter(|(pivot, _)| pivot.value > 0.0);
            for (pivot, error) in pairs {
                pivot.error = pivot.error.min(error);
            }
        }
        let found = pivots.iter().zip(diagonal).zip(&self.joints).map(|((pivot, whole), joint)| {
            let part = pivot.value / whole.value.abs();
            Pivot { joint: joint.clone(), part, digits: digits(pivot) }
        });
        // Starts with the last row of M, in the order of its decomposition: all pivots after a wrong one are wrong.
        let (mut smallest, mut fewest): (Option<Pivot>, _) = (None, u32::MAX);
        for pivot in found.collect::<Vec<_>>().into_iter().rev() {
            if pivot.is_wrong() {
                return Ok(Some(pivot));
            }
            fewest = fewest.min(pivot.digits);
            if smallest.as_ref().is_none_or(|smallest| pivot.part < smallest.part) {
                smallest = Some(pivot);
            }
        }
        let smallest = smallest.map(|pivot| Pivot { digits: fewest, ..pivot });
        Ok(smallest.filter(|pivot| pivot.part < SMALL || f64::from(fewest) < DIGITS / 2.0))
    }
}

impl MassMatrix {
    /// The bounds on the errors of the pivots that follow from the mass matrix at these positions; `None` if it is not
    /// positive definite or too large for code.
    fn errors_of_pivots(&self, q: &[f64]) -> Option<Vec<f64>> {
        let interpreter = self.interpreter.get_or_init(|| {
            let given: Vec<(&str, f64)> =
                self.given.iter().map(|(name, value)| (name.as_str(), *value)).collect();
            let made =
                interpreter(&self.robot, &self.options, &given, specification::mass_matrix).ok()?;
            Some(made.with_trigonometry(self.trigonometry))
        });
        let positions = [(JointVariable::Position.name(), q)];
        let name = FunctionKind::MassMatrix.name();
        perturbed::errors(&interpreter.as_ref()?.call_rounded(name, &positions).ok()?)
    }
}

/// An interpreter of the module that `specify` specifies.
fn interpreter(
    robot: &Robot,
    options: &Options,
    given: &[(&str, f64)],
    specify: impl for<'g> Fn(&Derivation<'_, 'g>) -> ModuleSpec<'g>,
) -> Result<Interpreter<'static>, Errors> {
    let (name, limit) = (&robot.name, MAX_NODES);
    let graph = Graph::limited(limit);
    let derivation =
        Derivation::new(robot, &graph, &options.mechanism(robot), options.plan.clone());
    let specification = specify(&derivation);
    if graph.is_full() {
        return Err(Errors::from(Error::TooLarge { name: name.clone(), limit }));
    }
    let module = Module::compile(&specification, &robot_codegen::Options::none())
        .map_err(|errors| Errors::of_code(name, &errors))?;
    let interpreter =
        Interpreter::owned(module, given).map_err(|errors| Errors::of_code(name, &errors))?;
    Ok(interpreter.with_trigonometry(Trigonometry::Standard))
}

impl Pivot {
    /// Whether the accelerations do not exist, because the pivot is not positive and finite, or is only rounding error.
    #[must_use]
    pub fn is_wrong(&self) -> bool {
        !(self.part > 0.0 && self.part.is_finite()) || self.digits == 0
    }
}

/// Prints the consequence for the accelerations.
impl fmt::Display for Pivot {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Pivot { joint, part, digits } = self;
        if *digits == 0 && part.is_finite() && *part != 0.0 {
            return write!(
                formatter,
                "the mass matrix is singular to within rounding: with the joints farther out \
                 free, the inertia of joint `{joint}` is only rounding error, and so are the \
                 accelerations; check the masses, the moments of inertia and the configuration"
            );
        }
        if self.is_wrong() && *part <= -SMALL {
            return write!(
                formatter,
                "the mass matrix is not positive definite: with the joints farther out free, the \
                 inertia of joint `{joint}` is negative; check the masses and the moments of \
                 inertia"
            );
        }
        if self.is_wrong() {
            return write!(
                formatter,
                "the mass matrix is singular in this configuration: with the joints farther out free, \
                 joint `{joint}` has no inertia; the cause is the configuration, not the parameters, \
                 unless this happens in every configuration"
            );
        }
        let plural = if *digits == 1 { "" } else { "s" };
        write!(
            formatter,
            "the mass matrix is nearly singular: with the joints farther out free, joint \
             `{joint}` has only {part:.1e} of its inertia; the inertias have about {digits} correct \
             digit{plural}, and accelerations at most as many"
        )
    }
}

/// The number of correct decimal digits.
fn digits(pivot: &Rounded) -> u32 {
    let left = -(pivot.error / pivot.value.abs()).log10();
    if left.is_nan() { 0 } else { left.clamp(0.0, DIGITS) as u32 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pivot_tells_why_accelerations_have_few_digits() {
        let nan = f64::NAN;
        for (part, digits, is_wrong, words) in [
            (
                1e-9,
                6,
                false,
                "is nearly singular: with the joints farther out free, joint `a` has only 1.0e-9 of",
            ),
            (0.5, 1, false, "the inertias have about 1 correct digit, and accelerations at most"),
            (1e-9, 0, true, "is singular to within rounding"),
            (-1e-9, 0, true, "is singular to within rounding"),
            (-0.5, 0, true, "is singular to within rounding"),
            (-0.5, 9, true, "is not positive definite"),
            (-1e-8, 9, true, "is not positive definite"),
            // A pivot that is smaller than this is 0 but for rounding.
            (-1e-9, 9, true, "is singular in this configuration"),
            (0.0, 0, true, "is singular in this configuration"),
            (0.0, 15, true, "is singular in this configuration"),
            (nan, 0, true, "is singular in this configuration"),
            (f64::INFINITY, 15, true, "is singular in this configuration"),
        ] {
            let pivot = Pivot { joint: "a".to_owned(), part, digits };
            assert_eq!(pivot.is_wrong(), is_wrong, "{pivot:?}");
            assert!(pivot.to_string().contains(words), "{pivot:?}: {pivot}");
        }
    }

    #[test]
    fn digits_are_those_of_the_error() {
        let of = |value: f64, error: f64| digits(&Rounded { value, error });
        assert_eq!([of(1.0, 1e-3), of(-1.0, 1e-3), of(100.0, 1e-3)], [3, 3, 5]);
        assert_eq!([of(1.0, 0.0), of(1.0, 1e-30), of(1.0, 2.0)], [15, 15, 0]);
        assert_eq!([of(0.0, 1.0), of(0.0, 0.0), of(f64::NAN, 1.0)], [0, 0, 0]);
    }
}
