//! The conditions that the data of a mechanism must satisfy.

use nalgebra::{Matrix3, Vector3};

use super::{
    error::Fault,
    friction::Sign,
    mechanism::{Frame, JointKind, Link},
    pose::Pose,
};

/// The tolerance for unit vectors, rotation matrices and symmetric matrices.
const TOLERANCE: f64 = 1e-9;

/// Returns all faults, in the order of the data.
pub(super) fn faults(gravity: &Vector3<f64>, links: &[Link], frames: &[Frame]) -> Vec<Fault> {
    let mut faults = Vec::new();
    let mut report = |place: String, reasons: Vec<String>| {
        faults.extend(reasons.into_iter().map(|reason| Fault { place: place.clone(), reason }));
    };
    report("gravity".into(), not_finite("acceleration", gravity.as_slice()));
    for (index, link) in links.iter().enumerate() {
        report(format!("link {index}"), link_reasons(link, index, links.len()));
    }
    for (index, frame) in frames.iter().enumerate() {
        let mut reasons = pose_reasons(&frame.placement);
        if let Some(link) = frame.link.filter(|&link| link >= links.len()) {
            reasons.push(format!("link {link} does not exist: there are {}", links.len()));
        }
        report(format!("frame {index}"), reasons);
    }
    report("coordinates".into(), idle_coordinates(links));
    faults
}

fn link_reasons(link: &Link, index: usize, count: usize) -> Vec<String> {
    let mut reasons = pose_reasons(&link.placement);
    if let Some(parent) = link.parent.filter(|&parent| parent >= index) {
        reasons.push(format!("parent {parent} must come before its child"));
    }
    if let Some(coordinate) = link.joint.driver().filter(|&coordinate| coordinate >= count) {
        reasons.push(format!(
            "coordinate {coordinate} must be less than the number of links, {count}"
        ));
    }
    let axis = &link.joint.axis;
    reasons.extend(not_finite("axis", axis.as_slice()));
    if link.joint.kind != JointKind::Fixed && (axis.norm() - 1.0).abs() > TOLERANCE {
        reasons.push(format!("the axis must have length 1, not {}", axis.norm()));
    }
    reasons.extend(not_finite("joint", &[link.joint.ratio, link.joint.offset]));
    reasons.extend(not_finite("mass", &[link.mass]));
    reasons.extend(not_finite("center of mass", link.center_of_mass.as_slice()));
    reasons.extend(not_finite("inertia", link.inertia.as_slice()));
    let skewness = (link.inertia - link.inertia.transpose()).abs().max();
    if skewness > TOLERANCE * link.inertia.abs().max() {
        reasons.push("the inertia tensor must be symmetric".into());
    }
    reasons.extend(not_finite("rotor inertia", &[link.rotor_inertia]));
    reasons.extend(not_finite("friction", &link.friction.numbers()));
    if matches!(link.friction.sign, Sign::Smooth(width) if width <= 0.0) {
        reasons.push("the smoothing width must be positive".into());
    }
    reasons
}

fn pose_reasons(pose: &Pose) -> Vec<String> {
    let mut reasons = not_finite("rotation", pose.rotation.as_slice());
    reasons.extend(not_finite("translation", pose.translation.as_slice()));
    let departure = pose.rotation.transpose() * pose.rotation - Matrix3::identity();
    if departure.abs().max() > TOLERANCE || pose.rotation.determinant() < 0.0 {
        reasons.push("the rotation must be an orthonormal matrix of determinant +1".into());
    }
    reasons
}

fn not_finite(what: &str, numbers: &[f64]) -> Vec<String> {
    if numbers.iter().all(|number| number.is_finite()) {
        Vec::new()
    } else {
        vec![format!("{what}: every number must be finite")]
    }
}

/// Returns the coordinates below the last one that move no joint.
fn idle_coordinates(links: &[Link]) -> Vec<String> {
    let mut drives = vec![false; links.len()];
    for coordinate in links.iter().filter_map(|link| link.joint.driver()) {
        if let Some(entry) = drives.get_mut(coordinate) {
            *entry = true;
        }
    }
    let used = drives.iter().rposition(|&drives| drives).map_or(0, |last| last + 1);
    (0..used)
        .filter(|&coordinate| !drives[coordinate])
        .map(|coordinate| format!("coordinate {coordinate} moves no joint: number them from 0"))
        .collect()
}
