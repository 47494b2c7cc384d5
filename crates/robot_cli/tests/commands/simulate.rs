//! `simulate`, from files to files.

use crate::{complaint, folder, output, robot, run};

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

/// The torques of a motion, given as a file, bring the motion about again: they are linear in time, as
/// the file is between its lines.
#[test]
fn torques_from_a_file_repeat_the_motion() {
    let path = folder("simulate-file").join("motion.csv");
    let path = path.to_str().unwrap();
    let file = robot("planar_2r");
    let driven = ["simulate", &file, "--time", "1", "--step", "0.001", "--torque"];
    let more = ["1 = m1*g*r1 + 3*t", "--torque", "2=-0.5*t", "-o", path];
    let shown = output(&[&driven[..], &more].concat(), "");
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

#[test]
fn everything_that_is_wrong_is_said() {
    let file = robot("planar_2r");
    let shown = |more: &[&str]| complaint(1, &[&["simulate", &file], more].concat(), "");
    let start = shown(&["--q0", "1", "--qd0", "1,2,3", "--tolerance", "2"]);
    assert_eq!(
        start,
        "error: the tolerance is 2; it must lie between 1e-14 and 0.1\n\
         error: the start has 1 entries of q, not 2\nerror: the start has 3 entries of qd, not 2\n"
    );
    assert!(shown(&["--torque", "3=1"]).starts_with("error: torque `3` is of no coordinate"));
    assert!(shown(&["--torque", "1=1/(t-t)"]).contains("driving forces have no finite value"));
    assert!(shown(&["--time", "0"]).contains("the duration is 0 s"));
    assert!(shown(&["--torques", "none.csv"]).contains("cannot read none.csv"));
    assert!(shown(&["--set", "x=1"]).contains("there is no parameter `x`"));
    assert!(shown(&["--max-steps", "5"]).contains("5 steps were not enough"));
    assert!(shown(&["--friction"]).contains("friction"));
    let usage = run(&["simulate", &file, "--smoothing", "1"]);
    assert_eq!(usage.code, 2);
    let trttr1 = robot("trttr1");
    let usage = run(&["simulate", &trttr1, "--friction", "--smoothing", "-1"]);
    assert_eq!(usage.code, 2);
}
