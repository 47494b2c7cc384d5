//! Writes robots as URDF, for tests only; every value is written as it is.

use std::fmt::Write;

use robot_model::robot::{Axis, Body, Inertia, JointKind, Link, Move, Placement, Robot};
use robot_symbolic::{Formula, Rational};

/// The robot as URDF. All bodies of a link except the first become fixed links.
pub(crate) fn of_robot(robot: &Robot) -> String {
    let mut text = format!("<robot name=\"{}\">\n<link name=\"ground\"/>\n", robot.name);
    for link in &robot.links {
        push_link(&mut text, robot, link);
    }
    text + "</robot>\n"
}

fn push_link(text: &mut String, robot: &Robot, link: &Link) {
    let (first, others) = link.bodies.split_first().unwrap();
    writeln!(text, "<link name=\"{}\">{}</link>", link.name, inertial(first)).unwrap();
    for body in others {
        writeln!(text, "<link name=\"{}\">{}</link>", body.name, inertial(body)).unwrap();
        writeln!(
            text,
            "<joint name=\"{0}\" type=\"fixed\"><parent link=\"{1}\"/><child link=\"{0}\"/></joint>",
            body.name, link.name
        )
        .unwrap();
    }
    let joint = &link.joint;
    let kind = match joint.kind {
        JointKind::Revolute => "continuous",
        JointKind::Prismatic => "prismatic",
    };
    let parent = link.parent.map_or("ground", |parent| &robot.links[parent].name);
    let leader = &robot.coordinates[joint.coordinate].joint;
    let mimic = if *leader == joint.name {
        String::new()
    } else {
        format!(
            "<mimic joint=\"{leader}\" multiplier=\"{}\" offset=\"{}\"/>",
            number(&joint.ratio),
            number(&joint.offset)
        )
    };
    writeln!(
        text,
        "<joint name=\"{}\" type=\"{kind}\">{}<parent link=\"{parent}\"/><child link=\"{}\"/>\
         <axis xyz=\"{}\"/>{mimic}</joint>",
        joint.name,
        origin(&link.placement),
        link.name,
        vector(&joint.axis),
    )
    .unwrap();
}

fn inertial(body: &Body) -> String {
    let Inertia { xx, yy, zz, xy, xz, yz } = &body.inertia;
    let [xx, yy, zz, xy, xz, yz] = [xx, yy, zz, xy, xz, yz].map(number);
    format!(
        "<inertial>{}<mass value=\"{}\"/><inertia ixx=\"{xx}\" ixy=\"{xy}\" ixz=\"{xz}\" \
         iyy=\"{yy}\" iyz=\"{yz}\" izz=\"{zz}\"/></inertial>",
        origin(&body.placement),
        number(&body.mass),
    )
}

/// The `<origin>` of a placement that consists of one translation and rotations about fixed axes.
fn origin(placement: &Placement) -> String {
    let zero = || [(); 3].map(|()| Formula::number(&Rational::ZERO));
    let (mut xyz, mut rpy) = (zero(), zero());
    for step in &placement.0 {
        match step {
            Move::Translate(by) => xyz = by.clone(),
            Move::Rotate(axis, angle) => {
                let index = match axis {
                    Axis::X => 0,
                    Axis::Y => 1,
                    Axis::Z => 2,
                };
                rpy[index] = angle.clone();
            }
        }
    }
    format!("<origin xyz=\"{}\" rpy=\"{}\"/>", vector(&xyz), vector(&rpy))
}

fn vector(vector: &[Formula; 3]) -> String {
    vector.each_ref().map(number).join(" ")
}

fn number(formula: &Formula) -> String {
    formula.text().to_owned()
}

/// A robot with one link on a joint: `inertial` is its `<inertial>`, and `joint` further content of the joint.
pub(crate) fn one_link(inertial: &str, joint: &str) -> String {
    format!(
        "<robot name=\"arm\">\n<link name=\"ground\"/>\n<link name=\"arm\">{inertial}</link>\n\
         <joint name=\"joint\" type=\"revolute\">\n<parent link=\"ground\"/><child link=\"arm\"/>\n\
         {joint}\n</joint>\n</robot>\n"
    )
}

/// A valid `<inertial>`.
pub(crate) const BODY: &str = "<inertial><origin xyz=\"0 0 0.1\"/><mass value=\"2\"/>\
     <inertia ixx=\"0.02\" ixy=\"0\" ixz=\"0\" iyy=\"0.03\" iyz=\"0\" izz=\"0.04\"/></inertial>";
