//! The bounds of values: what is exactly at one is read, and what is beyond it is refused for what it is.

use robot_model::description::MAX_PARAMETERS;

use crate::{arm, errors, read};

/// A joint, with values of every kind.
const LINK: &str = "[[link]]
name = \"rod\"
joint = { type = \"revolute\", axis = \"z\", mimic = { joint = \"lead\", ratio = RATIO, offset = OFFSET } }
origin = { xyz = [ORIGIN, 0, 0], rpy = [ANGLE, 0, 0] }
mass = MASS
center_of_mass = [CENTER, 0, 0]
inertia = { xx = INERTIA, yy = INERTIA, zz = INERTIA }
friction = { viscous = VISCOUS, coulomb_torque = 1, smoothing = SMOOTHING }
drive = { armature = ARMATURE, rotor_inertia = 1, gear_ratio = GEAR }
[[frame]]
name = \"tip\"
parent = \"rod\"
origin = { xyz = [FRAME, 0, 0] }
";

/// The keys of [`LINK`], their values, and what messages call them.
const VALUES: [(&str, &str, &str); 12] = [
    ("RATIO", "1", "the ratio of `rod`"),
    ("OFFSET", "0.1", "the offset of `rod`"),
    ("ORIGIN", "0.1", "the pose of `rod`"),
    ("ANGLE", "0.1", "the pose of `rod`"),
    ("MASS", "1", "the mass of `rod`"),
    ("CENTER", "0.1", "the center of mass of `rod`"),
    ("INERTIA", "1", "the inertia of `rod`"),
    ("VISCOUS", "1", "the friction of `rod`"),
    ("SMOOTHING", "1", "the friction of `rod`"),
    ("ARMATURE", "1", "the drive of `rod`"),
    ("GEAR", "1", "the drive of `rod`"),
    ("FRAME", "0.1", "the pose of `tip`"),
];

/// The robot with one of its values changed.
fn with(key: &str, value: &str) -> String {
    let lead = "[[link]]\nname = \"lead\"\njoint = { type = \"revolute\", axis = \"z\" }\nmass = 1\n\
        center_of_mass = [0, 0, 0]\ninertia = { xx = 1, yy = 1, zz = 1 }\n";
    let values = VALUES.iter().fold(LINK.to_owned(), |text, (name, usual, _)| {
        text.replace(name, if *name == key { value } else { usual })
    });
    arm(&format!("{lead}{values}"))
}

/// Reads the robot if `is_right`, else expects the message that names what is wrong.
fn hold(text: &str, is_right: bool, message: &str) {
    if is_right {
        read(text);
    } else {
        let found = errors(text);
        assert_eq!(found.len(), 1, "{message}\n{found}");
        let shown = &found.iter().next().unwrap().message;
        assert!(shown.starts_with(message), "{shown}\n{message}");
    }
}

#[test]
fn the_most_parameters_are_read() {
    for (count, is_right) in [(MAX_PARAMETERS, true), (MAX_PARAMETERS + 1, false)] {
        let parameters: String = (0..count).map(|index| format!("p{index} = 1\n")).collect();
        let text = format!("{}[parameters]\n{parameters}", with("", ""));
        hold(&text, is_right, &format!("at most {MAX_PARAMETERS} parameters are allowed"));
    }
}

#[test]
fn magnitudes_up_to_the_largest_are_read() {
    for (key, _, what) in VALUES {
        let is_angle = matches!(key, "ANGLE" | "OFFSET");
        let (most, more, contains) = match is_angle {
            true => ("1e6", "1000001", "contains an angle of"),
            false => ("1e30", "1.01e30", "contains a value of"),
        };
        for sign in ["", "-"] {
            if sign == "-"
                && matches!(key, "MASS" | "INERTIA" | "VISCOUS" | "SMOOTHING" | "ARMATURE")
            {
                continue;
            }
            hold(&with(key, &format!("{sign}{most}")), true, what);
            let message = format!("{what} {contains}");
            hold(&with(key, &format!("{sign}{more}")), false, &message);
        }
    }
    let gravity = |size: &str| {
        with("", "").replacen("[robot]", &format!("[robot]\ngravity = [0, 0, -{size}]"), 1)
    };
    hold(&gravity("1e30"), true, "");
    hold(&gravity("1.01e30"), false, "gravity contains a value of");
}

/// What something is divided by and lengths are 0 or not too small; other values are as small as one likes.
#[test]
fn divisors_are_not_too_small() {
    for (key, _, what) in VALUES {
        let is_divisor = matches!(key, "RATIO" | "MASS" | "INERTIA" | "SMOOTHING");
        let is_length = matches!(key, "ORIGIN" | "CENTER" | "FRAME");
        hold(&with(key, "1e-100"), true, what);
        hold(
            &with(key, "0.99e-100"),
            !(is_divisor || is_length),
            &format!("{what} contains a value of"),
        );
    }
    // Of a tensor the largest entry counts.
    let one = with("INERTIA", "1e-99").replacen("xx = 1e-99", "xx = 1e-101", 1);
    read(&one);
}

/// The offset of a prismatic joint is a length.
#[test]
fn an_offset_is_an_angle_or_a_length() {
    let sliding = with("OFFSET", "1000001").replacen(
        "\"revolute\", axis = \"z\", mimic",
        "\"prismatic\", axis = \"z\", mimic",
        1,
    );
    let sliding = sliding.replace("coulomb_torque", "coulomb_force");
    read(&sliding);
}

/// An axis of numbers has any length; a component beside which another is lost is refused.
#[test]
fn components_of_an_axis_are_of_one_size() {
    let axis =
        |axis: &str| with("", "").replacen("axis = \"z\" }", &format!("axis = {axis} }}"), 1);
    for right in ["[1e300, 1e300, 0]", "[0, 0, 1e-300]", "[1e-100, 0, -1]", "[0, 1e200, 1e100]"] {
        hold(&axis(right), true, right);
    }
    for wrong in ["[0.99e-100, 0, -1]", "[0, 1e200, 0.99e100]"] {
        hold(&axis(wrong), false, "the axis of `lead` has components of");
    }
}

/// A text has at most 4096 bytes.
#[test]
fn texts_are_not_too_long() {
    let described = |length: usize| {
        let text = "é".repeat(length / 2) + &"x".repeat(length % 2);
        with("", "").replacen("[robot]", &format!("[robot]\ndescription = \"{text}\""), 1)
    };
    hold(&described(4096), true, "");
    hold(&described(4097), false, "the text has 4097 bytes; the limit is 4096");
}
