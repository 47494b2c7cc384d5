//! The functions that are generated as code: named arrays of expressions over named input arrays.
//!
//! All functions of a robot are derived in one graph ([`Derivation`]), so that expressions that depend only on
//! parameters are shared among them. Joint torques are derived by the economical recursion, or by the paper's
//! iterations if a joint axis depends on parameters; quantities that depend on the forces between links are always
//! derived by the paper's iterations.

mod acting;
mod alternatives;
mod bundle;
mod coriolis;
mod derivatives;
mod energies;
mod forward_dynamics;
mod gravity;
mod inverse_dynamics;
mod kinematics;
mod mass_matrix;
mod pivots;
mod plans;
mod regressor;
mod sampled;
mod sharing;
mod singular;

pub use plans::search_plan;
pub use singular::undetermined;

pub use crate::derivation::Derivation;

use robot_model::functions::{Effects, FunctionKind};
pub use robot_symbolic::named::{Function, Input};
use robot_symbolic::{Expr, named};

use crate::base_parameters::BaseParameters;
use crate::economical::Recursion;
use crate::matrix::Pivots;
use robot_model::robot::JointKind;
use robot_model::variable::{JointVariable, WRENCH};

/// An output with its expressions.
pub type Output<'g> = named::Output<Vec<Expr<'g>>>;

impl<'r, 'g> Derivation<'r, 'g> {
    /// The recursion, if M q̈ = b must be solved by the articulated-body algorithm to preserve digits: pivots of M may
    /// be small, and each coordinate moves exactly one joint.
    fn recursion_for_small_pivots(&self) -> Option<&Recursion<'g>> {
        let recursion = self.recursion.as_ref().filter(|recursion| recursion.is_articulated());
        recursion.filter(|_| self.may_have_small_pivots())
    }

    fn may_have_small_pivots(&self) -> bool {
        *self.small_pivots.get_or_init(|| pivots::may_be_small(self.robot))
    }

    /// Whether the pivots of M are known to be positive. If all values are numbers and no pivot is small in any
    /// configuration, no check is needed at run time.
    fn pivots_known(&self) -> Pivots {
        let is_sure = self.robot.parameters.is_empty() && !self.may_have_small_pivots();
        if is_sure { Pivots::Positive } else { Pivots::Checked }
    }

    /// Derives the functions of a kind: one function, or one for each frame. A property that the robot does not have (a
    /// tip, friction) is taken as 0; check [`FunctionKind::missing_in`] first.
    ///
    /// Parameters that have no effect on a function do not occur in it.
    #[must_use]
    pub fn functions(&self, kind: FunctionKind) -> Vec<Function<'g>> {
        self.cheapest_plan(&[kind], |derivation| derivation.acting(kind))
    }

    /// The functions of a kind with this plan.
    fn acting(&self, kind: FunctionKind) -> Vec<Function<'g>> {
        let derived = self.derived(kind).into_iter();
        derived.map(|function| self.of_acting_parameters(function)).collect()
    }

    /// The regressor for known base parameters, as [`Derivation::functions`] derives it.
    #[must_use]
    pub fn regressor_over(&self, base: &BaseParameters<'g>) -> Function<'g> {
        self.of_acting_parameters(regressor::regressor_over(self, base))
    }

    /// The functions before parameters without effect are removed.
    fn derived(&self, kind: FunctionKind) -> Vec<Function<'g>> {
        let function = match kind {
            FunctionKind::InverseDynamics(_) => inverse_dynamics::inverse_dynamics(self, kind),
            FunctionKind::LinkWrenches => inverse_dynamics::link_wrenches(self),
            FunctionKind::MassMatrix => mass_matrix::mass_matrix(self),
            FunctionKind::MassMatrixLower => mass_matrix::mass_matrix_lower(self),
            FunctionKind::Bias => inverse_dynamics::bias(self),
            FunctionKind::Gravity => gravity::gravity(self),
            FunctionKind::ForwardDynamics(_) => forward_dynamics::forward_dynamics(self, kind),
            FunctionKind::ForwardKinematics => kinematics::forward_kinematics(self),
            FunctionKind::FramePoses => kinematics::frame_poses(self),
            FunctionKind::Jacobian | FunctionKind::JacobianDotQd => {
                return kinematics::per_frame(self, kind);
            }
            FunctionKind::JacobianOf(_) | FunctionKind::JacobianDotQdOf(_) => {
                return Vec::from_iter(kinematics::of_frame(self, kind));
            }
            FunctionKind::Energies => energies::energies(self),
            FunctionKind::CoriolisMatrix => coriolis::coriolis_matrix(self),
            FunctionKind::InverseDynamicsDerivatives => derivatives::inverse_dynamics(self),
            FunctionKind::ForwardDynamicsDerivatives => derivatives::forward_dynamics(self),
            FunctionKind::Regressor => regressor::regressor(self),
            FunctionKind::RegressorBase => return Vec::from_iter(regressor::regressor_base(self)),
            FunctionKind::BaseParameters => return Vec::from_iter(regressor::base_values(self)),
        };
        vec![function]
    }

    /// The function `pivots` of the input `q`. Its outputs are `pivots`, the pivots D of M = Lᵀ D L as forward dynamics
    /// computes them, and `diagonal`, the diagonal of M; both are ordered by coordinates, in kg m² or kg.
    ///
    /// A pivot is the inertia with respect to its joint if the joints farther outward are free. Forward dynamics has no
    /// solution if a pivot is not positive, and few correct digits if a pivot is of the size of rounding errors.
    #[must_use]
    pub fn pivots(&self) -> Function<'g> {
        pivots::pivots(self)
    }

    /// A function with the name and the inputs of its kind.
    fn of_kind(&self, kind: FunctionKind, doc: &[&str], outputs: Vec<Output<'g>>) -> Function<'g> {
        let doc = doc.iter().map(|&paragraph| paragraph.to_owned()).collect();
        let mut inputs: Vec<Input> =
            kind.inputs().iter().map(|variable| self.coordinate_input(*variable)).collect();
        if kind.effects().wrench || kind == FunctionKind::LinkWrenches {
            inputs.extend(self.wrench_inputs());
        }
        Function { name: kind.name().to_owned(), doc, inputs, outputs }
    }

    /// The joint torques as an output.
    fn torque_output(&self, values: Vec<Expr<'g>>) -> Output<'g> {
        Output::new(
            JointVariable::Torque.name(),
            JointVariable::Torque.meaning(),
            &self.coordinate_unit(JointVariable::Torque),
            vec![values.len()],
            values,
        )
    }

    /// An input array with one entry for each coordinate.
    fn coordinate_input(&self, variable: JointVariable) -> Input {
        Input {
            name: variable.name().to_owned(),
            doc: variable.meaning().to_owned(),
            unit: self.coordinate_unit(variable),
            symbols: self.robot.symbols(variable),
        }
    }

    /// The unit of an array over the coordinates; the prismatic joints are named if there are both kinds.
    fn coordinate_unit(&self, variable: JointVariable) -> String {
        self.unit_by_joint(variable.unit(JointKind::Revolute), variable.unit(JointKind::Prismatic))
    }

    /// The unit of an array over the coordinates that depends on the kind of the joint.
    fn unit_by_joint(&self, rotation: &str, translation: &str) -> String {
        let kinds = &self.robot.coordinates;
        let translations: Vec<String> = kinds
            .iter()
            .enumerate()
            .filter(|(_, coordinate)| match coordinate.kind {
                JointKind::Revolute => false,
                JointKind::Prismatic => true,
            })
            .map(|(index, _)| ordinal(index + 1))
            .collect();
        match translations.as_slice() {
            [] => rotation.to_owned(),
            all if all.len() == kinds.len() => translation.to_owned(),
            [one] => format!("{rotation}; {translation} for the prismatic joint (the {one} entry)"),
            [others @ .., last] => format!(
                "{rotation}; {translation} for the prismatic joints (the {} and {last} entries)",
                others.join(", ")
            ),
        }
    }

    /// The unit of a matrix over the coordinates; the mixed entries and those of prismatic joints are named if there
    /// are both kinds.
    fn matrix_unit(&self, rotation: &str, mixed: &str, translation: &str) -> String {
        let (mut revolute, mut prismatic) = (0, 0);
        for coordinate in &self.robot.coordinates {
            match coordinate.kind {
                JointKind::Revolute => revolute += 1,
                JointKind::Prismatic => prismatic += 1,
            }
        }
        match (revolute, prismatic) {
            (_, 0) => rotation.to_owned(),
            (0, _) => translation.to_owned(),
            _ => format!(
                "{rotation} between revolute joints, {translation} between prismatic joints, \
                 {mixed} between a revolute and a prismatic joint"
            ),
        }
    }

    /// One input array for each tip: force, then moment.
    fn wrench_inputs(&self) -> Vec<Input> {
        let inputs = self.robot.tips().map(|(frame, wrench)| Input {
            name: format!("{WRENCH}{}", self.robot.wrench_suffix(frame)),
            doc: format!(
                "Wrench that the frame `{}` exerts on its surroundings (the negative of the \
                 external wrench), in its axes, the moment about its origin: force x y z, moment \
                 x y z",
                frame.name
            ),
            unit: "N and N m".to_owned(),
            symbols: wrench.components().map(str::to_owned).collect(),
        });
        inputs.collect()
    }
}

/// A position in a list, counted from 1, in words: languages count their entries from 0 or from 1.
fn ordinal(position: usize) -> String {
    const WORDS: [&str; 12] = [
        "first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth",
        "tenth", "eleventh", "twelfth",
    ];
    if let Some(word) = position.checked_sub(1).and_then(|index| WORDS.get(index)) {
        return (*word).to_owned();
    }
    let ending = match (position % 10, position % 100) {
        (_, 11..=13) => "th",
        (1, _) => "st",
        (2, _) => "nd",
        (3, _) => "rd",
        _ => "th",
    };
    format!("{position}{ending}")
}

#[cfg(test)]
mod tests {
    use super::ordinal;

    #[test]
    fn positions_are_words_up_to_twelve() {
        let shown = [1, 12, 13, 21, 22, 33, 112, 113, 121].map(ordinal);
        let expected =
            ["first", "twelfth", "13th", "21st", "22nd", "33rd", "112th", "113th", "121st"];
        assert_eq!(shown, expected);
    }
}
