//! Content of a URDF file that the reader does not use, with one note for each kind of content.
//!
//! Content that affects the dynamics is also described in words, so that every command can report it.

use roxmltree::Node;

use super::super::options::Options;
use super::super::reader::Reader;
use super::element::{Element, tag};
use super::joint::UrdfJoint;
use crate::diagnostic::{Diagnostic, Span, code};

/// Reports the unused content as notes.
pub(super) fn notes(
    reader: &mut Reader<'_>,
    root: &Element<'_, '_>,
    joints: &[UrdfJoint<'_>],
    options: &Options,
) {
    limits(reader, joints);
    if !options.friction {
        friction(reader, joints);
    }
    let gears: Vec<Span> =
        root.nodes("transmission").filter(|node| any(*node, has_gear)).map(tag).collect();
    drives(reader, &gears);
    let below = root.nodes("link").chain(root.nodes("joint"));
    let below = below.flat_map(|node| node.children().filter(|child| child.has_tag_name("gazebo")));
    let gazebo = root.nodes("gazebo").chain(below);
    let forces: Vec<Span> = gazebo.filter(|node| any(*node, has_force)).map(tag).collect();
    simulated(reader, &forces);
}

/// The count with its noun, such as `12 joints`.
fn counted(count: usize, one: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {one}{plural}")
}

/// Reports limits that are not used: of forces and velocities, and of joints that mimic others.
fn limits(reader: &mut Reader<'_>, joints: &[UrdfJoint<'_>]) {
    let mut kinds: Vec<(&str, Vec<&Span>)> = Vec::new();
    for unread in joints.iter().flat_map(|joint| &joint.unread) {
        match kinds.iter_mut().find(|(name, _)| *name == unread.name) {
            Some((_, spans)) => spans.push(&unread.span),
            None => kinds.push((unread.name, vec![&unread.span])),
        }
    }
    for (name, spans) in kinds {
        let count = counted(spans.len(), "joint");
        let message = format!("{count}: `{name}` of `<limit>` is ignored");
        let diagnostic = Diagnostic::note(code::LEFT_OUT, message);
        let why = match name {
            "lower" | "upper" => "a joint with `<mimic>` moves with its leading joint",
            _ => "limits on forces and velocities do not affect the equations",
        };
        reader.report(diagnostic.at(spans.first().copied().unwrap_or(&(0..0)), "").because(why));
    }
}

/// Reports friction of joints.
fn friction(reader: &mut Reader<'_>, joints: &[UrdfJoint<'_>]) {
    let mut found = joints.iter().filter_map(|joint| joint.dynamics.as_ref());
    let Some(first) = found.next() else { return };
    let count = counted(1 + found.count(), "joint");
    let message = format!("{count}: the friction in `<dynamics>` is not part of the robot");
    reader.report(
        Diagnostic::note(code::LEFT_OUT, message)
            .at(&first.span, first.values_text())
            .because("the torques do not include it")
            .help("the import option `friction` includes it in the robot file"),
    );
    reader.left_out.push(format!(
        "the friction of {count} (the import option `friction` includes \
        it)"
    ));
}

/// Reports gears and motors.
fn drives(reader: &mut Reader<'_>, places: &[Span]) {
    let Some(first) = places.first() else { return };
    let count = counted(places.len(), "transmission");
    let message = format!("{count}: gear ratio and rotor inertia are not part of the robot");
    reader.report(
        Diagnostic::note(code::LEFT_OUT, message)
            .at(first, "")
            .because("the torques are joint torques without drive inertia")
            .help("add a `drive` to the link in the imported robot file"),
    );
    reader.left_out.push(format!("the drives of {count}"));
}

/// Reports Gazebo's settings of gravity, springs and damping.
fn simulated(reader: &mut Reader<'_>, places: &[Span]) {
    let Some(first) = places.first() else { return };
    let count = counted(places.len(), "Gazebo element");
    let message =
        format!("{count}: settings of gravity, springs and damping are not part of the robot");
    reader.report(Diagnostic::note(code::LEFT_OUT, message).at(first, "").because(
        "they are meant for a simulator; here gravity acts on every body, and there \
                are no springs",
    ));
    reader.left_out.push(format!("gravity, springs or damping of {count}"));
}

/// Whether the predicate holds for the name and text of any element within the node.
fn any(node: Node<'_, '_>, is: fn(&str, &str) -> bool) -> bool {
    let mut within = node.descendants().filter(Node::is_element);
    within.any(|one| is(one.tag_name().name(), one.text().unwrap_or_default().trim()))
}

/// Whether a value of a transmission affects the dynamics.
fn has_gear(name: &str, text: &str) -> bool {
    let value = text.parse::<f64>().ok();
    match name {
        "mechanicalReduction" | "mechanical_reduction" => value != Some(1.0),
        "motorInertia" | "motor_inertia" | "rotorInertia" | "rotor_inertia" => value != Some(0.0),
        _ => false,
    }
}

/// Whether a setting of Gazebo affects the dynamics.
fn has_force(name: &str, text: &str) -> bool {
    let is_true = text == "1" || text.eq_ignore_ascii_case("true");
    let is_some = text.parse::<f64>().ok() != Some(0.0);
    match name {
        "turnGravityOff" => is_true,
        "gravity" => text == "0" || text.eq_ignore_ascii_case("false"),
        "springStiffness" | "spring_stiffness" | "dampingFactor" => is_some,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Elements that do not affect the dynamics are not reported: a reduction of 1, a motor without inertia.
    #[test]
    fn gears_and_motors_that_act_are_distinguished_from_others() {
        for name in ["mechanicalReduction", "mechanical_reduction"] {
            for (text, acts) in
                [("1", false), ("1.0", false), ("50", true), ("0", true), ("-1", true), ("", true)]
            {
                assert_eq!(has_gear(name, text), acts, "{name} {text}");
            }
        }
        for name in ["motorInertia", "motor_inertia", "rotorInertia", "rotor_inertia"] {
            for (text, acts) in
                [("0", false), ("0.0", false), ("1", true), ("1e-5", true), ("${j}", true)]
            {
                assert_eq!(has_gear(name, text), acts, "{name} {text}");
            }
        }
        assert!(!has_gear("hardwareInterface", "50"));
    }

    #[test]
    fn forces_of_a_simulator_are_distinguished_from_its_other_settings() {
        for (name, text, acts) in [
            ("turnGravityOff", "1", true),
            ("turnGravityOff", "true", true),
            ("turnGravityOff", "True", true),
            ("turnGravityOff", "0", false),
            ("turnGravityOff", "false", false),
            ("gravity", "0", true),
            ("gravity", "false", true),
            ("gravity", "FALSE", true),
            ("gravity", "1", false),
            ("gravity", "true", false),
            ("springStiffness", "0", false),
            ("springStiffness", "2.5", true),
            ("spring_stiffness", "0.0", false),
            ("spring_stiffness", "1", true),
            ("dampingFactor", "0", false),
            ("dampingFactor", "0.1", true),
            ("dampingFactor", "?", true),
            ("material", "1", false),
        ] {
            assert_eq!(has_force(name, text), acts, "{name} {text}");
        }
    }
}
