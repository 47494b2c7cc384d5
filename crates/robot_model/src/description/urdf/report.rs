//! Notes about the choices that the reader made for a URDF file.

use super::super::draft::{Draft, DraftLink, Parent};
use super::super::options::Options;
use super::super::reader::Reader;
use super::element::Element;
use super::joint::UrdfJoint;
use super::unread;
use crate::diagnostic::{Diagnostic, code};
use crate::variable::JointVariable;

/// Elements that do not affect the motion, in the singular and plural.
const IGNORED: &[(&str, &str)] = &[
    ("visual", "visuals"),
    ("collision", "collisions"),
    ("transmission", "transmissions"),
    ("gazebo", "Gazebo elements"),
    ("sensor", "sensors"),
    ("ros2_control", "ros2_control elements"),
    ("safety_controller", "safety controllers"),
    ("calibration", "calibrations"),
];

/// Reports the choices.
pub(super) fn choices(
    reader: &mut Reader<'_>,
    root: &Element<'_, '_>,
    draft: &Draft,
    order: &[usize],
    joints: &[UrdfJoint<'_>],
    options: &Options,
) {
    whole(reader, root, draft, order);
    for index in order {
        let Some(link) = draft.links.get(*index) else { continue };
        if link.joint.kind.is_none() {
            reader.report(fixed(draft, link));
        }
    }
    for joint in joints {
        if joint.kind.is_some() {
            moving(reader, joint, options);
        }
    }
    unread::notes(reader, root, joints, options);
}

/// Reports the choices that concern the whole file.
fn whole(reader: &mut Reader<'_>, root: &Element<'_, '_>, draft: &Draft, order: &[usize]) {
    let gravity = draft.gravity.each_ref().map(|entry| entry.text().to_owned()).join(", ");
    reader.report(
        Diagnostic::note(code::TAKEN_DEFAULT, format!("gravity is [{gravity}] m/s^2"))
            .at(&root.tag(), "in the base frame")
            .because("URDF does not specify gravity"),
    );
    let links = order.iter().filter_map(|index| draft.links.get(*index));
    let leading = links.filter(|link| link.joint.kind.is_some() && link.joint.mimic.is_none());
    let names: Vec<String> = leading
        .enumerate()
        .map(|(index, link)| {
            format!("{} of `{}`", JointVariable::Position.symbol(index), link.joint.name.name)
        })
        .collect();
    reader.report(
        Diagnostic::note(
            code::TAKEN_COORDINATE,
            match names.as_slice() {
                [alone] => format!("the coordinate is {alone}"),
                names => format!("the coordinates are {}", names.join(", ")),
            },
        )
        .at(&root.tag(), "")
        .because("joints are numbered in the order of the file, parents before children"),
    );
    let counts: Vec<String> = IGNORED
        .iter()
        .filter_map(|(name, plural)| match root.count(name) {
            0 => None,
            1 => Some(format!("1 {name}")),
            count => Some(format!("{count} {plural}")),
        })
        .collect();
    if !counts.is_empty() {
        reader.report(
            Diagnostic::note(code::LEFT_OUT, format!("ignored: {}", counts.join(", ")))
                .at(&root.tag(), "")
                .because("they do not affect the motion; files that they name, such as meshes, are not read"),
        );
    }
}

fn fixed(draft: &Draft, link: &DraftLink) -> Diagnostic {
    let name = &link.name.name;
    let mut carrier = link;
    for _ in 0..draft.links.len() {
        let Parent::Link(parent) = carrier.parent else { break };
        let Some(next) = draft.links.get(parent) else { break };
        carrier = next;
        if carrier.joint.kind.is_some() {
            let by = &carrier.name.name;
            let message = format!("`{name}` is merged into `{by}`; its frame keeps its name");
            return Diagnostic::note(code::TAKEN_TOGETHER, message).at(&link.places.joint, "fixed");
        }
    }
    let message = match link.body {
        Some(_) => format!("`{name}` is the base or fixed to it; its mass has no effect"),
        None => format!("`{name}` is the base or fixed to it"),
    };
    Diagnostic::note(code::TAKEN_AS_BASE, message).at(&link.places.name, "does not move")
}

fn moving(reader: &mut Reader<'_>, joint: &UrdfJoint<'_>, options: &Options) {
    let name = &joint.name.named.name;
    if joint.is_continuous && joint.mimic.is_none() {
        let message = format!("the position of `{name}` is one angle without limits");
        reader
            .report(Diagnostic::note(code::TAKEN_COORDINATE, message).at(&joint.tag, "continuous"));
    }
    if let Some(mimic) = &joint.mimic {
        let message = format!("`{name}` does not have a coordinate of its own");
        let offset = mimic.offset.to_string();
        let (sign, offset) = match offset.strip_prefix('-') {
            Some(offset) => ("minus", offset),
            None => ("plus", offset.as_str()),
        };
        let motion =
            format!("{} times the position of that joint, {sign} {offset}", mimic.multiplier);
        reader.report(
            Diagnostic::note(code::TAKEN_COORDINATE, message)
                .at(&mimic.joint.span, motion)
                .because("the torque of the leading joint drives both"),
        );
    }
    if let Some(dynamics) = joint.dynamics.as_ref().filter(|_| options.friction) {
        let message = format!("the friction of `{name}` is included");
        reader.report(
            Diagnostic::note(code::TAKEN_DEFAULT, message)
                .at(&dynamics.span, dynamics.values_text())
                .because("`damping` is viscous friction, `friction` is constant Coulomb friction"),
        );
    }
}
