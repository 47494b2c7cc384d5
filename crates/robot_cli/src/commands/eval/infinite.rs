//! Messages about outputs that are not finite, which JSON cannot represent: the entry, the state and the reason.

use robot_build::{Trigonometry, too_large_angle};
use robot_codegen::OutputValues;
use robot_model::diagnostic::number;
use robot_model::robot::Robot;
use robot_model::variable::JointVariable;
use robot_numeric::Mechanism;

use super::digits::Digits;
use crate::states::State;

/// Makes a message for each output that is not finite; it explains the effect of the mass matrix, if there is one.
pub(super) fn messages(
    robot: &Robot,
    settings: &[(&str, f64)],
    state: &State<'_>,
    outputs: &[OutputValues],
    digits: &Digits,
    trigonometry: Trigonometry,
) -> Vec<String> {
    let wrong =
        outputs.iter().filter(|output| output.values.iter().any(|value| !value.is_finite()));
    let wrong: Vec<&OutputValues> = wrong.collect();
    if wrong.is_empty() {
        return vec![];
    }
    // The eigenvectors of a singular matrix give all affected coordinates; the pivots of a nearly singular
    // one give a single coordinate.
    let of_matrix = || digits.matter().then(|| singular(robot, settings, state)).flatten();
    let q = state.array(JointVariable::Position.name());
    let angle = q.and_then(|q| too_large_angle(robot, q, trigonometry));
    // The sum of the angles of parallel joints can overflow, which no sine repairs.
    let is_finite = |q: &[f64]| q.iter().map(|angle| angle.abs()).sum::<f64>().is_finite();
    let standard = if q.is_some_and(is_finite) { ", or use --trigonometry standard" } else { "" };
    let angle = angle.map(|why| format!("{why}{standard}"));
    let why = angle.or_else(of_matrix).or_else(|| digits.singular(state));
    let why =
        why.unwrap_or_else(|| "check the magnitudes of the parameters and of the state, and whether parameters that are 0 \
            make a divisor 0".to_owned());
    let message = |output: &&OutputValues| {
        let entries = entries(robot, output);
        format!("{}: `{}` does not have a finite value{entries}; {why}", state.place, output.name)
    };
    wrong.iter().map(message).collect()
}

/// Prints the first entry that is not finite: ` at entry 2 (joint `elbow`)`, or ` at row 1, column 2` for a matrix.
fn entries(robot: &Robot, output: &OutputValues) -> String {
    let Some(first) = output.values.iter().position(|value| !value.is_finite()) else {
        return String::new();
    };
    match output.shape.as_slice() {
        [_, columns] if *columns > 0 => {
            format!(" at row {}, column {}", first / columns + 1, first % columns + 1)
        }
        [length] => {
            let joint = robot.coordinates.get(first).filter(|_| *length == robot.coordinates.len());
            let joint = joint.map(|one| format!(" (joint `{}`)", one.joint)).unwrap_or_default();
            format!(" at entry {}{joint}", first + 1)
        }
        _ => String::new(),
    }
}

/// Names the coordinates whose accelerations are not determined, if the mass matrix is singular at the state.
fn singular(robot: &Robot, settings: &[(&str, f64)], state: &State<'_>) -> Option<String> {
    let value = |name: &str| {
        let set = settings.iter().find(|(set, _)| *set == name).map(|(_, value)| *value);
        let nominal = || Some(robot.parameter(name)?.value.as_ref()?.to_f64());
        set.or_else(nominal).unwrap_or(f64::NAN)
    };
    let mechanism = Mechanism::from_robot(robot, &value).ok();
    let free = mechanism
        .zip(state.array(JointVariable::Position.name()))
        .map(|(mechanism, q)| mechanism.undetermined(q));
    match free.and_then(Result::ok).as_deref() {
        None | Some([]) => None,
        Some(free) => {
            let q = state.array(JointVariable::Position.name()).unwrap_or_default();
            let at: Vec<String> = free
                .iter()
                .map(|index| {
                    let joint = robot.coordinates.get(*index).map_or("", |one| &one.joint);
                    let position = q.get(*index).copied().unwrap_or_default();
                    let symbol = JointVariable::Position.symbol(*index);
                    format!("{symbol} = {} (joint `{joint}`)", number(position))
                })
                .collect();
            Some(format!(
                "the mass matrix is singular at this state: the joint torques do not determine \
                 the accelerations of {}",
                at.join(", ")
            ))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first entry that is not finite, counted from 1: of an array over the joints with the joint, of a matrix by
    /// its row and column.
    #[test]
    fn the_first_entry_without_a_value_is_named() {
        let robot = robot_testing::robot("planar_2r");
        let joint = |index: usize| &robot.coordinates[index].joint;
        let told = |shape: &[usize], wrong: &[usize]| {
            let mut values = vec![1.0; shape.iter().product()];
            wrong.iter().for_each(|place| values[*place] = f64::NAN);
            entries(&robot, &OutputValues { name: String::new(), shape: shape.to_vec(), values })
        };
        assert_eq!(told(&[2], &[]), "");
        assert_eq!(told(&[2], &[0, 1]), format!(" at entry 1 (joint `{}`)", joint(0)));
        assert_eq!(told(&[2], &[1]), format!(" at entry 2 (joint `{}`)", joint(1)));
        // Six numbers are not two joints, nor is one.
        assert_eq!([told(&[6], &[1]), told(&[1], &[0])], [" at entry 2", " at entry 1"]);
        assert_eq!(told(&[2, 3], &[0]), " at row 1, column 1");
        assert_eq!(told(&[2, 3], &[5, 4]), " at row 2, column 2");
        assert_eq!(told(&[2, 2], &[3]), " at row 2, column 2");
        assert_eq!(told(&[], &[0]), "");
    }
}
