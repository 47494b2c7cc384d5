//! Denavit–Hartenberg rows: the frames that they define, in both conventions, both as single rows and as a table.

use std::fmt::Write;

use nalgebra::{Matrix3, Vector3};
use robot_model::robot::DhConvention;
use robot_numeric::random::Random;
use robot_numeric::{Mechanism, Pose};

use crate::{arm, errors, read};

fn rotation(axis: usize, angle: f64) -> Pose {
    let (s, c) = angle.sin_cos();
    let mut matrix = Matrix3::identity();
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    matrix[(j, j)] = c;
    matrix[(k, k)] = c;
    matrix[(j, k)] = -s;
    matrix[(k, j)] = s;
    Pose { rotation: matrix, translation: Vector3::zeros() }
}

fn translation(axis: usize, length: f64) -> Pose {
    let mut pose = Pose::identity();
    pose.translation[axis] = length;
    pose
}

/// A row: joint type, a, alpha, d, theta.
type Row = (&'static str, [f64; 4]);

/// The frame of a row relative to that of the preceding row at joint position q, by definition.
fn by_definition(convention: &str, (kind, [a, alpha, d, theta]): Row, q: f64) -> Pose {
    let (theta, d) = match kind {
        "revolute" => (theta + q, d),
        "prismatic" => (theta, d + q),
        _ => (theta, d),
    };
    match convention {
        "standard" => rotation(2, theta)
            .then(&translation(2, d))
            .then(&translation(0, a))
            .then(&rotation(0, alpha)),
        _ => rotation(0, alpha)
            .then(&translation(0, a))
            .then(&rotation(2, theta))
            .then(&translation(2, d)),
    }
}

fn random_rows(random: &mut Random) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for _ in 0..6 {
        let kind = ["revolute", "revolute", "prismatic", "fixed"][random.index(4)];
        rows.push((kind, [(); 4].map(|()| random.uniform(-1.0, 1.0))));
    }
    rows.push(("revolute", [0.3, 0.4, 0.5, 0.6]));
    rows
}

/// The robot file of the rows, with a `[dh]` table or with `dh` in every link. The frame of each link is named `f…`.
fn file(convention: &str, rows: &[Row], table: bool) -> String {
    let mut text = String::new();
    if table {
        writeln!(text, "[dh]\nconvention = \"{convention}\"\nrows = [").unwrap();
        for (kind, [a, alpha, d, theta]) in rows {
            let row = format!("a = {a:?}, alpha = {alpha:?}, d = {d:?}, theta = {theta:?}");
            writeln!(text, "  {{ type = \"{kind}\", {row} }},").unwrap();
        }
        writeln!(text, "]").unwrap();
    }
    for (index, (kind, [a, alpha, d, theta])) in rows.iter().enumerate() {
        writeln!(text, "[[link]]\nname = \"{index}\"").unwrap();
        if *kind != "fixed" {
            writeln!(text, "massless = true").unwrap();
        }
        if !table {
            let row = format!("a = {a:?}, alpha = {alpha:?}, d = {d:?}, theta = {theta:?}");
            writeln!(text, "joint = {{ type = \"{kind}\" }}").unwrap();
            writeln!(text, "dh = {{ convention = \"{convention}\", {row} }}").unwrap();
        }
    }
    for index in 0..rows.len() {
        writeln!(text, "[[frame]]\nname = \"f{index}\"\nparent = \"{index}\"").unwrap();
    }
    arm(&text)
}

#[test]
fn frames_are_those_of_the_definition() {
    let mut random = Random::new(5);
    for round in 0..20 {
        let rows = random_rows(&mut random);
        for (convention, table) in
            [("standard", false), ("standard", true), ("modified", false), ("modified", true)]
        {
            let robot = read(&file(convention, &rows, table)).robot;
            let mechanism = Mechanism::nominal(&robot).unwrap();
            let q: Vec<f64> =
                (0..mechanism.coordinates()).map(|_| random.uniform(-2.0, 2.0)).collect();
            let placements = mechanism.forward_kinematics(&q).unwrap();
            let mut expected = Pose::identity();
            let mut coordinates = q.iter();
            for (index, row) in rows.iter().enumerate() {
                let q = if row.0 == "fixed" { 0.0 } else { *coordinates.next().unwrap() };
                expected = expected.then(&by_definition(convention, *row, q));
                let name = format!("f{index}");
                let frame = robot.frames.iter().position(|frame| frame.name == name).unwrap();
                let found = &placements.frames[frame];
                let worst = (found.translation - expected.translation).amax()
                    + (found.rotation - expected.rotation).amax();
                assert!(worst < 1e-13, "round {round}, {convention}, {name}: {worst:e}");
            }
        }
    }
}

/// The PUMA 560 in the standard convention, as Corke gives it.
const STANDARD: &str = "
[dh]
convention = \"standard\"
rows = [
  { alpha = \"pi/2\" },
  { a = 0.4318 },
  { a = 0.0203, alpha = \"-pi/2\", d = 0.15005 },
  { alpha = \"pi/2\", d = 0.4318 },
  { alpha = \"-pi/2\" },
  {},
]

[[link]]
name = \"1\"
massless = true
inertia = { yy = 0.35, unchecked = true }

[[link]]
name = \"2\"
mass = 17.4
center_of_mass = [-0.3638, 0.006, 0.2275]
inertia = { xx = 0.13, yy = 0.524, zz = 0.539 }

[[link]]
name = \"3\"
mass = 4.8
center_of_mass = [-0.0203, -0.0141, 0.070]
inertia = { xx = 0.066, yy = 0.086, zz = 0.0125, unchecked = true }

[[link]]
name = \"4\"
mass = 0.82
center_of_mass = [0, 0.019, 0]
inertia = { xx = 1.8e-3, yy = 1.3e-3, zz = 1.8e-3 }

[[link]]
name = \"5\"
mass = 0.34
center_of_mass = [0, 0, 0]
inertia = { xx = 0.3e-3, yy = 0.4e-3, zz = 0.3e-3 }

[[link]]
name = \"6\"
mass = 0.09
center_of_mass = [0, 0, 0.032]
inertia = { xx = 0.15e-3, yy = 0.15e-3, zz = 0.04e-3 }
";

/// The same arm with inertias about the origins of the standard frames.
fn about_origins(text: &str) -> String {
    let number = |text: &str| text.trim().parse::<f64>().unwrap();
    let field = |line: &str, key: &str| {
        let rest = line.split(&format!("{key} = ")).nth(1).unwrap();
        number(rest.split([',', ' ']).next().unwrap())
    };
    let (mut mass, mut c) = (0.0, [0.0; 3]);
    let mut lines = Vec::new();
    for line in text.lines() {
        if let Some(value) = line.strip_prefix("mass = ") {
            mass = number(value);
        } else if let Some(list) = line.strip_prefix("center_of_mass = [") {
            let list: Vec<_> = list.trim_end_matches(']').split(',').map(number).collect();
            c.copy_from_slice(&list);
        } else if line.starts_with("inertia") && !line.contains("0.35") {
            let squares = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
            let moments = ["xx", "yy", "zz"].map(|key| field(line, key));
            let moments: Vec<_> =
                (0..3).map(|i| moments[i] + mass * (squares - c[i] * c[i])).collect();
            let product = |i: usize, j: usize| -mass * c[i] * c[j];
            let (xx, yy, zz) = (moments[0], moments[1], moments[2]);
            let (xy, xz, yz) = (product(0, 1), product(0, 2), product(1, 2));
            lines.push(format!(
                "inertia = {{ about = \"origin\", xx = {xx:?}, yy = {yy:?}, zz = {zz:?}, \
                 xy = {xy:?}, xz = {xz:?}, yz = {yz:?}, unchecked = true }}"
            ));
            continue;
        }
        lines.push(line.to_owned());
    }
    lines.join("\n")
}

#[test]
fn puma_in_standard_dh_has_the_torques_of_the_robot_file() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots");
    let text = std::fs::read_to_string(format!("{folder}/puma560.toml")).unwrap();
    let reference = Mechanism::nominal(&read(&text).robot).unwrap();
    let variants =
        [("about mass centers", STANDARD.to_owned()), ("about origins", about_origins(STANDARD))];
    for (variant, text) in variants {
        let described = read(&arm(&text));
        let mechanism = Mechanism::nominal(&described.robot).unwrap();
        let mut random = Random::new(7);
        for _ in 0..20 {
            let mut state = || -> Vec<f64> { (0..6).map(|_| random.uniform(-2.0, 2.0)).collect() };
            let (q, qd, qdd) = (state(), state(), state());
            let expected = reference.inverse_dynamics(&q, &qd, &qdd).unwrap();
            let found = mechanism.inverse_dynamics(&q, &qd, &qdd).unwrap();
            for (joint, (found, given)) in (1..).zip(found.iter().zip(&expected)) {
                let error = (found - given).abs() / expected.amax();
                assert!(
                    error < 1e-13,
                    "moments {variant}, joint {joint}: {found} for {given}, off by {error:e}"
                );
            }
        }
    }
}

#[test]
fn rows_and_links_must_match() {
    let more = format!("{STANDARD}\n[[link]]\nname = \"7\"\nmassless = true\n");
    let found = errors(&arm(&more)).to_string();
    assert!(found.contains("6 rows") && found.contains("is 7"), "{found}");
    // A link with a frame of its own takes no row of the table.
    let own = format!(
        "{STANDARD}\n[[link]]\nname = \"7\"\njoint = {{ type = \"fixed\" }}\norigin = {{}}\n"
    );
    read(&arm(&own));
}

/// A rotating column, a fixed flange and a sliding arm, whose lengths are parameters.
const SYMBOLIC: &str = "
[parameters]
l1 = { value = 0.4, unit = \"m\" }

[[link]]
name = \"column\"
massless = true
joint = { type = \"revolute\" }
dh = { convention = \"CONVENTION\", a = \"l1/2\", alpha = \"pi/2\", d = \"l1\", theta = \"-pi/2\" }

[[link]]
name = \"flange\"
joint = { type = \"fixed\" }
dh = { convention = \"CONVENTION\", alpha = 0.3 }

[[link]]
name = \"arm\"
massless = true
joint = { type = \"prismatic\" }
dh = { convention = \"CONVENTION\", d = 0.25 }

[[link]]
name = \"hand\"
massless = true
joint = { type = \"revolute\", axis = \"x\" }
origin = {}
";

#[test]
fn rows_are_kept_as_in_the_file() {
    for convention in DhConvention::ALL {
        let text = SYMBOLIC.replace("CONVENTION", convention.name());
        let robot = read(&arm(&text)).robot;
        let rows = robot.dh.iter().map(|row| {
            assert_eq!(row.convention, convention);
            let values =
                [&row.a, &row.alpha, &row.d, &row.theta].map(robot_symbolic::Formula::text);
            (row.link.as_str(), row.moving, values)
        });
        let expected = [
            ("column", Some(0), ["l1/2", "pi/2", "l1", "-pi/2"]),
            ("flange", None, ["0", "0.3", "0", "0"]),
            ("arm", Some(1), ["0", "0", "0.25", "0"]),
        ];
        assert_eq!(rows.collect::<Vec<_>>(), expected);
    }
    let table = read(&arm(STANDARD)).robot.dh;
    assert_eq!(table.len(), 6);
    assert_eq!(
        (table[2].link.as_str(), table[2].moving, table[2].d.text()),
        ("3", Some(2), "0.15005")
    );
}
