//! The number of correct digits of the accelerations at states.

use robot_build::{Options, Pivot, Pivots, Programs, Trigonometry};
use robot_model::variable::JointVariable;

use crate::failure::Failure;
use crate::states::State;

/// The pivots of the mass matrix, if functions solve with it.
pub(super) struct Digits(Option<Pivots>);

impl Digits {
    /// The pivots; none without programs, if values are missing and only errors are reported.
    pub(super) fn of(
        programs: Option<&Programs>,
        options: &Options,
        given: &[(&str, f64)],
        trigonometry: Trigonometry,
    ) -> Result<Digits, Failure> {
        let Some(programs) = programs else { return Ok(Digits(None)) };
        let bundled = programs.bundles.iter().flat_map(|bundle| &bundle.functions);
        if !programs.functions.iter().chain(bundled).any(|kind| kind.divides_by_mass_matrix()) {
            return Ok(Digits(None));
        }
        let pivots = Pivots::new(&programs.robot, options, given)?;
        Ok(Digits(Some(pivots.with_trigonometry(trigonometry))))
    }

    /// The warning for a state whose accelerations have few correct digits.
    pub(super) fn warning(&self, state: &State<'_>) -> Option<String> {
        let pivot = self.smallest(state)?;
        Some(format!("warning: {}: {pivot}\n", state.place))
    }

    /// Whether the functions solve with the mass matrix.
    pub(super) fn matter(&self) -> bool {
        self.0.is_some()
    }

    /// The reason why the accelerations at a state do not exist, if it is the mass matrix.
    pub(super) fn singular(&self, state: &State<'_>) -> Option<String> {
        let pivot = self.smallest(state).filter(Pivot::is_wrong)?;
        Some(format!("forward dynamics has no solution: {pivot}"))
    }

    fn smallest(&self, state: &State<'_>) -> Option<Pivot> {
        // An incomplete state has already been reported for the function.
        self.0.as_ref()?.smallest(state.array(JointVariable::Position.name())?).ok().flatten()
    }
}
