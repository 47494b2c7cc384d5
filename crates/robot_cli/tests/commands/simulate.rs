//! `simulate`, from files to files.

use std::path::Path;

use crate::{WRIST, complaint, folder, output, output_beside_files, robot, run, run_with};
use robot_testing::pages::blocks;

/// The columns of CSV by name.
fn column(csv: &str, name: &str) -> Vec<f64> {
    let mut lines = csv.lines();
    let place = lines.next().unwrap().split(',').position(|column| column == name).unwrap();
    lines.map(|line| line.split(',').nth(place).unwrap().parse().unwrap()).collect()
}

#[test]
fn a_motion_is_csv_and_keeps_its_energy() {
    let arguments = ["simulate", &robot("planar_2r"), "--time", "2", "--q0", "-1.5,0.5"];
    let csv = output(&arguments, "");
    let header = "t,q1,q2,qd1,qd2,qdd1,qdd2,tau1,tau2,kinetic,potential,energy";
    assert_eq!(csv.lines().next(), Some(header));
    assert_eq!(csv.lines().count(), 202);
    assert_eq!(csv, output(&arguments, ""), "the same input gives the same bytes");
    let energy = column(&csv, "energy");
    assert!(energy.iter().all(|value| (value - energy[0]).abs() < 1e-6), "{}", energy[0]);
    assert!(column(&csv, "kinetic").iter().any(|value| *value > 1.0));
    assert_eq!(column(&csv, "q1")[0], -1.5);
    assert_eq!(column(&csv, "t").last(), Some(&2.0));
}

/// The torques of a motion, given as a file, result in the same motion again: they are linear in time, as is the
/// interpolation between the lines of the file.
#[test]
fn torques_from_a_file_repeat_the_motion() {
    let path = folder("simulate-file").join("motion.csv");
    let path = path.to_str().unwrap();
    let file = robot("planar_2r");
    let driven = ["simulate", &file, "--time", "1", "--step", "0.001", "--torque"];
    let more = ["1 = m1*g*r1 + 3*t", "--torque", "2=-0.5*t", "-o", path];
    let shown = output_beside_files(&[&driven[..], &more].concat());
    assert!(shown.starts_with("1 s in 100"), "{shown}");
    let first = std::fs::read_to_string(path).unwrap();
    let repeated = ["simulate", &file, "--time", "1", "--step", "0.001", "--torques", path];
    let second = output(&repeated, "");
    for name in ["q1", "q2", "tau1", "tau2"] {
        for (a, b) in column(&first, name).iter().zip(column(&second, name)) {
            assert!((a - b).abs() < 1e-8, "{name}: {a} and {b}");
        }
    }
}

#[test]
fn friction_slows_and_parameters_are_set() {
    let file = robot("trttr1");
    let motion = |more: &[&str]| {
        let common = ["simulate", &file, "--time", "0.5", "--qd0", "0,1,0,0,2", "--step", "0.1"];
        column(&output(&[&common[..], more].concat(), ""), "energy")
    };
    let free = motion(&[]);
    assert!((free[5] - free[0]).abs() < 1e-6);
    let rubbed = motion(&["--friction", "--smoothing", "0.01"]);
    assert!(rubbed[5] < rubbed[0] - 1.0, "{rubbed:?}");
    let more = motion(&["--friction", "--smoothing", "0.01", "--set", "b2=20"]);
    assert!(more[5] < rubbed[5], "{more:?}");
}

/// A slide of 1 kg whose dry friction is 10 N, and TRTTR1 with the friction of its file.
#[test]
fn dry_friction_holds_and_lets_go() {
    let path = folder("simulate-slide").join("slide.toml");
    let text = "format = 1\n[robot]\nname = \"slide\"\ngravity = [0, 0, 0]\n[[link]]\nname = \"1\"\n\
                joint = { type = \"prismatic\", axis = \"x\" }\nmass = 1\ncenter_of_mass = [0, 0, 0]\n\
                inertia = { xx = 1, yy = 1, zz = 1 }\nfriction = { coulomb_force = 10 }\n";
    std::fs::write(&path, text).unwrap();
    let slide = path.to_str().unwrap();
    for torque in ["1 = tan(pi/2)", "1 = q1 + 1/0"] {
        let said = complaint(1, &["simulate", slide, "--torque", torque], "");
        assert!(said.contains(&format!("torque `{torque}` does not have a value")), "{said}");
    }
    let pushed = |torque: &str, time: &str| {
        let common = ["simulate", slide, "--friction", "--torque", torque, "--time", time];
        output(&common, "")
    };
    let held = pushed("1=5", "1");
    for name in ["q1", "qd1", "qdd1"] {
        assert!(column(&held, name).iter().all(|value| *value == 0.0), "{name}");
    }
    let moved = pushed("1=15", "1");
    assert!((column(&moved, "q1").last().unwrap() - 2.5).abs() < 1e-12);
    // With a force that jumps with the velocity there is no solution, which is reported soon.
    let jump = ["simulate", slide, "--friction", "--torque", "1=20*(1-qd1/abs(qd1))", "--qd0", "1"];
    let shown = complaint(1, &jump, "");
    assert!(shown.contains("the motion ends at t = 0.1"), "{shown}");

    let path = folder("simulate-trttr1").join("motion.csv");
    let (file, path) = (robot("trttr1"), path.to_str().unwrap().to_owned());
    let torque = ["--torque", "1 = 10*sin(3*t)", "-o", &path];
    let shown = output_beside_files(&[&["simulate", &file, "--friction"], &torque[..]].concat());
    let steps = shown.strip_prefix("10 s in ").and_then(|shown| shown.split_once(' ')).unwrap().0;
    assert!(steps.parse::<usize>().unwrap() < 2500, "{shown}");
}

/// A run that cannot succeed ends after a few thousand steps.
#[test]
fn steps_that_lead_nowhere_are_few() {
    let file = robot("planar_2r");
    let shown = complaint(1, &["simulate", &file, "--torque", "1 = -1e9*qd1"], "");
    assert!(shown.contains("the last 5000 steps advanced so little"), "{shown}");
}

#[test]
fn everything_that_is_wrong_is_said() {
    let file = robot("planar_2r");
    let shown = |more: &[&str]| complaint(1, &[&["simulate", &file], more].concat(), "");
    let start = complaint(2, &["simulate", &file, "--q0", "1", "--qd0", "1,2,3"], "");
    assert_eq!(
        start,
        "error: --q0: 1 entry, not 2 (q1, q2)\nerror: --qd0: 3 entries, not 2 (qd1, qd2)\n"
    );
    let tolerance = "error: the tolerance is 2; it must be between 1e-14 and 0.1\n";
    assert_eq!(shown(&["--tolerance", "2"]), tolerance);
    assert!(shown(&["--torque", "3=1"]).starts_with("error: torque `3` does not match a joint"));
    assert!(
        shown(&["--torque", "1=1/(t-t)"])
            .contains("joint torques are not a finite number for each joint")
    );
    assert!(shown(&["--time", "0"]).contains("the duration is 0 s"));
    assert!(shown(&["--torques", "none.csv"]).contains("cannot read none.csv"));
    assert!(shown(&["--set", "x=1"]).contains("there is no parameter `x`"));
    assert!(shown(&["--max-steps", "5"]).contains("the limit of 5 steps was reached"));
    assert!(shown(&["--friction"]).contains("friction"));
    for wrong in [["--smoothing", "1"], ["--max-steps", "0"], ["--time", "1 min"]] {
        assert_eq!(run(&[&["simulate", &file], &wrong[..]].concat()).code, 2);
    }
    let times = [["--time", "0.5"], ["--time", "1/2"], ["--time", "0.5s"]];
    let [first, others @ ..] =
        times.map(|time| output(&[&["simulate", &file], &time[..]].concat(), ""));
    assert!(others.iter().all(|other| *other == first));
    let trttr1 = robot("trttr1");
    let zero = run(&["simulate", &trttr1, "--friction", "--smoothing", "0"]);
    assert_eq!(zero.code, 2, "{}", zero.errors);
    assert!(
        zero.errors.contains("'--smoothing <WIDTH>': it is 0; it must be a positive velocity"),
        "{}",
        zero.errors
    );
    // Products of a width below the range of robot files would be 0, and so would the friction.
    for width in ["-1", "1e-320", "1e-400", "1e400", "1e31", "nan", "abc"] {
        let usage = run(&["simulate", &trttr1, "--friction", "--smoothing", width]);
        assert_eq!(usage.code, 2, "{width}");
    }
}

#[test]
fn a_motion_through_a_singular_configuration_is_reported() {
    let from =
        |q0: &str| run(&["simulate", WRIST, "--time", "0.01", "--step", "0.005", "--q0", q0]);
    let near = from("0.1,0.00001,0.2");
    assert_eq!((near.code, near.errors.lines().count()), (0, 1), "{}", near.errors);
    assert!(
        near.errors.starts_with("warning: t = 0 s: the mass matrix is nearly singular"),
        "{}",
        near.errors
    );
    let there = from("0.1,0,0.2");
    let reason = "error: the motion ends at t = 0 s: forward dynamics has no solution: the mass matrix is singular";
    assert!(there.code == 1 && there.errors.starts_with(reason), "{}", there.errors);
    assert!(there.errors.contains("`roll`"), "{}", there.errors);
    assert_eq!(from("0.1,0.5,0.2").errors, "");
}

/// I2 + m2 r2² is 0 except for rounding, so a quotient with it as divisor is not an acceleration.
#[test]
fn a_mass_matrix_of_rounding_is_reported() {
    let file = robot("planar_2r");
    for q2 in ["1.5707963267948966", "-1.5707963267948966"] {
        let states = format!("[{{\"q\": [0, {q2}], \"qd\": [0, 0], \"tau\": [1, 1]}}]");
        let of_eval = ["eval", &file, "--set", "I2=-0.48", "--function", "forward_dynamics"];
        let shown = run_with(&[&of_eval[..], &["--states", "-"]].concat(), states.as_bytes());
        let reason = "the mass matrix is singular to within rounding";
        assert!(shown.errors.contains(reason), "{q2}: {}", shown.errors);
        let q0 = format!("0,{q2}");
        let of_simulate = ["simulate", &file, "--set", "I2=-0.48", "--q0", &q0];
        let shown = complaint(1, &of_simulate, "");
        let start = format!(
            "error: the motion ends at t = 0 s: forward dynamics has no solution: {reason}"
        );
        assert!(shown.lines().any(|line| line.starts_with(&start)), "{shown}");
    }
    // A negative inertia determines accelerations, but no motion.
    let state = ["--q", "0,1", "--qd", "0,0", "--tau", "1,1"];
    let of_eval = ["eval", &file, "--set", "I2=-0.6", "--function", "forward_dynamics"];
    let shown = complaint(1, &[&of_eval[..], &state].concat(), "");
    let reason = "forward dynamics has no solution: the mass matrix is not positive definite";
    assert!(shown.contains(reason), "{shown}");
}

#[test]
fn numbers_of_any_size_are_shown_short() {
    let file = robot("planar_2r");
    let arguments = [
        "--tolerance=1e300",
        "--tolerance=1e-300",
        "--step=1e-300",
        "--step=-1e300",
        "--time=1e300",
        "--time=-1e300",
        "--qd0=1e300,0",
        "--torque=1=1e300",
        "--set=m1=1e300",
    ];
    for argument in arguments {
        let shown = complaint(1, &["simulate", &file, argument], "");
        let is_short = |word: &str| word.len() < 60;
        assert!(shown.split_whitespace().all(is_short), "{argument}: {shown}");
        assert!(!shown.contains("Bad input") && !shown.contains("Initial step"), "{shown}");
    }
    let shown = output(&["simulate", &file, "--time", "1e-300"], "");
    assert_eq!(column(&shown, "t"), [0.0, 1e-300]);
}

/// Runs a command line as documents show it, with robot files of the project and other files in `folder`.
fn run_line(line: &str, folder: &Path) {
    let mut words = vec![];
    for (index, part) in line.split('"').enumerate() {
        match index % 2 {
            0 => words.extend(part.split_whitespace().map(str::to_owned)),
            _ => words.push(part.to_owned()),
        }
    }
    let is_file = |word: &str| {
        let extension = Path::new(word).extension().and_then(|extension| extension.to_str());
        matches!(extension, Some("csv" | "svg" | "png" | "toml"))
    };
    let placed = words.iter().skip(1).map(|word| {
        if let Some(name) = word.strip_prefix("robots/").and_then(|name| name.strip_suffix(".toml"))
        {
            robot(name)
        } else if is_file(word) {
            let name = Path::new(word).file_name().unwrap();
            folder.join(name).to_str().unwrap().to_owned()
        } else {
            word.clone()
        }
    });
    let arguments: Vec<String> = placed.collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    output_beside_files(&arguments);
}

/// The texts of a picture, except the labels of the integration error, which depends on the processor.
fn texts(svg: &str) -> Vec<&str> {
    let upto = svg.find("energy − start").unwrap_or(svg.len());
    svg[..upto].lines().filter(|line| !line.starts_with('<')).collect()
}

#[test]
fn the_commands_of_the_document_make_its_pictures() {
    let docs = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs");
    let document = std::fs::read_to_string(format!("{docs}/simulation.md")).unwrap();
    let folder = folder("simulate-docs");
    for block in blocks(&document) {
        if let Some(name) = block.value("file") {
            std::fs::write(folder.join(name), &block.text).unwrap();
        }
    }
    for line in document.lines().filter(|line| line.starts_with("robot-symbolic ")) {
        run_line(line, &folder);
    }
    let pictures = [
        "planar_2r.svg",
        "stick_slip.svg",
        "pendulum.svg",
        "double_pendulum.svg",
        "puma560.svg",
        "torques.svg",
    ];
    for name in pictures {
        assert!(document.contains(&format!("(simulation/{name})")), "{name}");
        let kept = std::fs::read_to_string(format!("{docs}/simulation/{name}")).unwrap();
        let made = std::fs::read_to_string(folder.join(name)).unwrap();
        assert!(kept.len() < 150_000, "{name}: {} bytes", kept.len());
        assert!(texts(&made).len() > 10);
        assert_eq!(texts(&kept), texts(&made), "{name} is out of date: run the command above it");
    }
    let contributions = std::fs::read_to_string(folder.join("contributions.csv")).unwrap();
    for (index, t) in column(&contributions, "t").iter().enumerate() {
        assert!((column(&contributions, "tau3")[index] - 2.0 * (3.0 * t).sin()).abs() < 1e-9);
    }
    assert!(std::fs::read(folder.join("contributions.png")).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn torques_are_split_and_wrong_trajectories_refused() {
    let file = robot("planar_2r");
    let arguments = ["torques", &file, "--expressions", "q1 = 0.2*t^2; q2=0;", "--time", "1"];
    let csv = output(&[&arguments[..], &["--step", "0.5"]].concat(), "");
    let header = "t,tau1,tau2,inertia1,inertia2,coriolis1,coriolis2,gravity1,gravity2";
    assert_eq!((csv.lines().next(), csv.lines().count()), (Some(header), 4));
    let inertia = column(&csv, "inertia1");
    // (m1 r1² + I1 + m2 (l1 + r2)² + I2) · 0.4
    assert!((inertia[0] - (1.25 + 0.42 + 3.0 * 1.96 + 0.16) * 0.4).abs() < 1e-12, "{inertia:?}");
    let csv = "t,q1\n0,0\n";
    let shown = complaint(1, &["torques", &file, "--trajectory", "-"], csv);
    assert!(shown.contains("error: standard input: there is no column `qdd2`"), "{shown}");
    let wrong = [&["torques", file.as_str()][..], &arguments[..4]];
    for arguments in wrong {
        assert_eq!(run(arguments).code, 2, "{arguments:?}");
    }
    assert_eq!(run(&["simulate", &file, "--plot", "a.pdf"]).code, 2);
    for option in ["--time", "--step"] {
        let shown = complaint(2, &["torques", &file, "--trajectory", "-", option, "5"], "");
        assert!(shown.contains("cannot be used with"), "{shown}");
    }
}

#[test]
fn starts_may_be_in_degrees_and_the_drift_is_told() {
    let file = robot("planar_2r");
    let motion = |q0: &str| output(&["simulate", &file, "--time", "0.02", "--q0", q0], "");
    assert_eq!(motion("90deg,-pi/4"), motion("1.5707963267948966,-0.7853981633974483"));
    let found = complaint(2, &["simulate", &file, "--q0", "1,two"], "");
    assert!(found.starts_with("error: --q0: entry 2, q2: `two` is not a number"), "{found}");
    let (table, plot) = (folder("drift").join("a.csv"), folder("drift_plot").join("a.svg"));
    let (table, plot) = (table.to_str().unwrap(), plot.to_str().unwrap());
    let outcome =
        run(&["simulate", &file, "--q0", "1,1", "--time", "1", "-o", table, "--plot", plot]);
    let (_, energy) = outcome.output.split_once("; energy from ").unwrap();
    let (before, energy) = energy.split_once(" J to ").unwrap();
    let (after, change) = energy.split_once(" J, a relative change of ").unwrap();
    // The energies have six digits, because the change is also printed.
    assert!(before == after && before.len() <= 8, "{}", outcome.output);
    assert!(change.trim_end().contains("e-"), "{}", outcome.output);
    assert!(outcome.errors.contains(&format!("wrote {table} (")), "{}", outcome.errors);
    assert!(outcome.errors.contains(&format!("wrote {plot} (")), "{}", outcome.errors);
}
