//! The regressors: joint torques as linear functions of the robot's parameters.

use robot_model::robot::BaseFrames;
use robot_model::robot::LINK_PARAMETERS;

use super::{Derivation, Function, FunctionKind, Output};
use crate::base_parameters::{
    BaseParameter, BaseParameters, Quantity, StandardParameter, base_columns, base_parameters,
    standard_columns, standard_parameters,
};
use crate::economical::Column;

/// The function for the regressor Y with Y π = τ.
pub(super) fn regressor<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let columns = standard_columns(derivation);
    let standard = standard_parameters(&derivation.mechanism);
    let drives = standard.iter().map(|(parameter, _)| *parameter).enumerate();
    let drives: Vec<String> = drives
        .filter_map(|(place, parameter)| drive_meaning(derivation, place, parameter))
        .collect();
    function(
        derivation,
        FunctionKind::Regressor,
        &paragraphs(derivation, &drives),
        &columns.iter().collect::<Vec<_>>(),
    )
}

/// The function for the regressor of the base parameters; `None` if the robot has none.
pub(super) fn regressor_base<'g>(derivation: &Derivation<'_, 'g>) -> Option<Function<'g>> {
    base_parameters(derivation).map(|base| regressor_over(derivation, &base))
}

/// The function for the regressor of known base parameters.
pub(super) fn regressor_over<'g>(
    derivation: &Derivation<'_, 'g>,
    base: &BaseParameters<'g>,
) -> Function<'g> {
    let columns = base_columns(derivation);
    let kept: Vec<&Column<'g>> =
        base.base.iter().filter_map(|parameter| columns.get(parameter.column)).collect();
    let doc = [
        "The regressor Y over the base parameters β, the smallest set of combinations of \
         inertial and drive parameters that determines the joint torques: they are Y β. Without \
         wrenches, and without load-dependent friction."
            .to_owned(),
        match base.frames {
            BaseFrames::File => format!(
                "Its columns are those of the full regressor at {}.",
                columns_and_names(base).join(", ")
            ),
            BaseFrames::DenavitHartenberg => {
                format!("Its columns are those of {}. {OF_DENAVIT_HARTENBERG}", names(base))
            }
        },
    ];
    function(derivation, FunctionKind::RegressorBase, &doc, &kept)
}

/// The function for the values β of the base parameters.
pub(super) fn base_values<'g>(derivation: &Derivation<'_, 'g>) -> Option<Function<'g>> {
    let base = base_parameters(derivation)?;
    let mut order = format!("In the order {}.", names(&base));
    if base.frames == BaseFrames::DenavitHartenberg {
        order = format!("{order} {OF_DENAVIT_HARTENBERG}");
    }
    let doc = [
        "The base parameters β; the regressor over them times β gives the joint torques. Each is \
         named after an inertial or drive parameter, with an R if others are regrouped into it. XX \
         to ZZ are entries of a link's inertia tensor about the origin of its frame, MX to MZ \
         its first moment, M its mass; IA is a drive's reflected inertia (armature), FV, FP and \
         FN its viscous, forward and backward friction, FO its friction offset, IC the coupling \
         of its rotor.",
        &order,
    ];
    let values = base.nominal();
    Some(derivation.of_kind(
        FunctionKind::BaseParameters,
        &doc,
        vec![Output::new(
            "base_parameters",
            "The base parameters",
            "kg, kg m, kg m²; viscous friction in N m s/rad or N s/m, other friction and offsets in N m or N",
            vec![values.len()],
            values,
        )],
    ))
}

/// Describes the link parameters of a base set that is not in the file's frames.
const OF_DENAVIT_HARTENBERG: &str = "They refer to Denavit-Hartenberg frames: z of each link is \
    the joint axis, and the origin is the point where the common normal with the parent's joint \
    axis meets it (through the parent's origin if the axes are parallel, at the file's origin if \
    there is no parent or no revolute joint); x is as close to the file's as that allows. In \
    these frames SXX, SXY, SYY, SXZ, SYZ, SZZ are the second moments ∫ x² dm, ∫ x y dm and so \
    on, MX, MY, MZ the first moments.";

/// The names of the base parameters, in order.
fn names(base: &BaseParameters<'_>) -> String {
    base.base.iter().map(BaseParameter::name).collect::<Vec<_>>().join(", ")
}

/// The columns of base parameters in the full regressor, and their names.
fn columns_and_names(base: &BaseParameters<'_>) -> Vec<String> {
    let name =
        |parameter: &BaseParameter<'_>| format!("{} ({})", parameter.column, parameter.name());
    base.base.iter().map(name).collect()
}

fn function<'g>(
    derivation: &Derivation<'_, 'g>,
    kind: FunctionKind,
    doc: &[String],
    columns: &[&Column<'g>],
) -> Function<'g> {
    let doc: Vec<&str> = doc.iter().map(String::as_str).collect();
    let rows = derivation.mechanism.degrees_of_freedom;
    let values = (0..rows).flat_map(|row| columns.iter().map(move |column| column[row])).collect();
    derivation.of_kind(
        kind,
        &doc,
        vec![Output::new(
            kind.name(),
            "The regressor, row by row: one row per joint torque, one column per parameter",
            "the unit of tau per unit of the parameter",
            vec![rows, columns.len()],
            values,
        )],
    )
}

fn paragraphs(derivation: &Derivation<'_, '_>, drives: &[String]) -> Vec<String> {
    let names: Vec<String> =
        derivation.robot.links.iter().map(|link| format!("`{}`", link.name)).collect();
    let mut paragraphs = vec![
        "The regressor Y: the joint torques are Y π, linear in the parameters π. Without \
         wrenches, and without load-dependent friction."
            .to_owned(),
        format!(
            "{LINK_PARAMETERS} columns per link, in the order {}: mass m (kg), first moment m \
             c_x, m c_y, m c_z (kg m), and the entries I_xx, I_xy, I_yy, I_xz, I_yz, I_zz of the \
             inertia tensor (kg m²), with their signs. First moment and tensor are about the \
             origin of the link frame, in its axes.",
            names.join(", ")
        ),
    ];
    if !drives.is_empty() {
        paragraphs.push(format!(
            "Columns of the drives, reflected inertia (armature) in kg m² or kg, viscous \
             friction in N m s/rad or N s/m, constant dry friction and friction offset in N \
             m or N, and the coupling of a gyroscopic rotor with the link that carries it, its \
             inertia times the gear ratio: {}.",
            drives.join(", ")
        ));
    }
    paragraphs
}

/// The meaning of a drive's column in words; `None` if it is the column of a link.
fn drive_meaning(
    derivation: &Derivation<'_, '_>,
    place: usize,
    StandardParameter { link, quantity }: StandardParameter,
) -> Option<String> {
    let joint = &derivation.robot.links.get(link)?.joint;
    let is_drive = !matches!(quantity, Quantity::Link(_));
    is_drive.then(|| format!("{place} {} of `{}`", quantity.meaning(), joint.name))
}
