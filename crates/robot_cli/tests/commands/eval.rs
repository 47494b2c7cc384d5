//! `eval` compared with the numeric recursive solver, and its messages about wrong input.

use robot_model::description::read_toml;
use robot_numeric::{Loads, Mechanism, Wrench};
use serde_json::{Value, json};

use crate::{WRIST, complaint, folder, output, robot, run_with};

/// The numeric mechanism of a robot with some parameters changed.
fn mechanism(name: &str, settings: &[(&str, f64)]) -> Mechanism {
    let text = std::fs::read_to_string(robot(name)).unwrap();
    let robot = read_toml(name, &text).unwrap().robot;
    Mechanism::from_robot(&robot, &|name| {
        let set = settings.iter().find(|(set, _)| *set == name).map(|(_, value)| *value);
        set.unwrap_or_else(|| robot.parameter(name).unwrap().value.as_ref().unwrap().to_f64())
    })
    .unwrap()
}

#[test]
#[cfg(target_os = "linux")]
fn a_device_without_end_is_refused() {
    let arguments = ["eval", &robot("scara"), "--function", "gravity", "--states", "/dev/zero"];
    assert!(complaint(1, &arguments, "").contains("/dev/zero: line 1 has more than 1 MiB"));
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

fn assert_close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= 1e-12 * size, "{found} is not {expected}");
    }
}

const Q: [f64; 5] = [0.1, -0.7, 0.2, 0.3, 1.1];
const QD: [f64; 5] = [0.4, 1.2, -0.3, 0.6, -0.9];
const QDD: [f64; 5] = [-1.0, 0.5, 0.8, -0.2, 2.0];
const WRENCH: [f64; 6] = [5.0, -3.0, 20.0, 0.4, 0.7, -0.6];

/// The torques of TRTTR1 by the numeric solver.
fn expected(settings: &[(&str, f64)], wrench: &[f64; 6], friction: bool) -> Vec<f64> {
    let mechanism = mechanism("trttr1", settings);
    let [fx, fy, fz, mx, my, mz] = *wrench;
    let wrench = Wrench { force: [fx, fy, fz].into(), moment: [mx, my, mz].into() };
    let loads = Loads { wrenches: vec![wrench], friction };
    let torques = mechanism.inverse_dynamics_with(&Q, &QD, &QDD, &loads).unwrap();
    torques.iter().copied().collect()
}

fn eval(function: &str, states: &Value, more: &[&str]) -> Vec<Vec<f64>> {
    let file = robot("trttr1");
    let mut arguments = vec!["eval", &file, "--function", function, "--states", "-"];
    arguments.extend(more);
    let shown: Value = serde_json::from_str(&output(&arguments, &states.to_string())).unwrap();
    let objects = shown.as_array().unwrap().iter();
    objects.map(|object| numbers(&object["tau"])).collect()
}

#[test]
fn torques_are_those_of_the_numeric_solver() {
    let still = json!({"q": Q, "qd": QD, "qdd": QDD});
    let loaded = json!({"q": Q, "qd": QD, "qdd": QDD, "wrench": WRENCH});
    for (function, friction) in [("inverse_dynamics", false), ("inverse_dynamics_friction", true)] {
        let found = eval(function, &json!([still]), &[]);
        assert_close(&found[0], &expected(&[], &[0.0; 6], friction));
        // A wrench determines that the function with a wrench is used, for all states.
        let found = eval(function, &json!([still, loaded]), &[]);
        assert_close(&found[0], &expected(&[], &[0.0; 6], friction));
        assert_close(&found[1], &expected(&[], &WRENCH, friction));
        assert_eq!(
            found,
            eval(
                &format!("{}_wrench{}", "inverse_dynamics", &function[16..]),
                &json!([still, loaded]),
                &[]
            )
        );
    }
}

#[test]
fn parameters_can_be_set() {
    let settings = [("M5", 2.5), ("l6", -0.25)];
    let loaded = json!([{"q": Q, "qd": QD, "qdd": QDD, "wrench": WRENCH}]);
    let found = eval("inverse_dynamics", &loaded, &["--set", "M5=2.5", "--set", "l6 = -0.25"]);
    assert_close(&found[0], &expected(&settings, &WRENCH, false));
}

/// A pendulum whose mass and length have no value in the file.
#[test]
fn parameters_without_a_value_have_to_be_set() {
    let file = folder("parameters_without_a_value").join("arm.toml");
    let text = "format = 1\n[robot]\nname = \"arm\"\n[parameters]\nm = {}\nl = {}\n[[link]]\n\
        name = \"rod\"\nmass = \"m\"\ncenter_of_mass = [\"l\", 0, 0]\n\
        inertia = { xx = 0, yy = 0, zz = 0 }\njoint = { type = \"revolute\", axis = \"y\" }\n";
    std::fs::write(&file, text).unwrap();
    let file = file.to_str().unwrap();
    let states = json!([{"q": [0.0]}]).to_string();
    let gravity = ["eval", file, "--function", "gravity", "--states", "-", "--set", "m=2"];
    let errors = complaint(1, &gravity, &states);
    assert!(
        errors.contains("`l` does not have a nominal value: set it with --set l=…"),
        "{errors}"
    );
    assert!(!errors.contains("`m`"), "{errors}");
    let shown: Value =
        serde_json::from_str(&output(&[&gravity[..], &["--set", "l=0.5"]].concat(), &states))
            .unwrap();
    let found = numbers(shown[0].as_object().unwrap().values().next_back().unwrap());
    assert_close(&found.iter().map(|torque| torque.abs()).collect::<Vec<_>>(), &[9.81]);
}

#[test]
fn matrices_are_rows_and_csv_has_a_header() {
    let file = robot("trttr1");
    let header: Vec<String> = ["q", "qd", "qdd"]
        .iter()
        .flat_map(|name| (1..=5).map(move |number| format!("{name}{number}")))
        .collect();
    let entries: Vec<String> =
        [Q, QD, QDD].concat().iter().map(|entry| format!("{entry:?}")).collect();
    let states = format!("{}\n{}\n", header.join(","), entries.join(","));
    let arguments = ["eval", &file, "--function", "link_wrenches", "--states", "-"];
    let shown: Value = serde_json::from_str(&output(&arguments, &states)).unwrap();
    let dynamics = mechanism("trttr1", &[]).link_dynamics(&Q, &QD, &QDD, &[]).unwrap();
    let csv = output(&[&arguments[..], &["--format", "csv"]].concat(), &states);
    let (header, line) = csv.split_once('\n').unwrap();
    let cells: Vec<f64> = line.trim().split(',').map(|cell| cell.parse().unwrap()).collect();
    for (name, first) in [("force", 0), ("moment", 15)] {
        let rows = shown[0][name].as_array().unwrap();
        assert_eq!(rows.len(), 5);
        let found: Vec<f64> = rows.iter().flat_map(numbers).collect();
        let mut expected = vec![];
        for link in &dynamics {
            let vector = if name == "force" { link.contact_force } else { link.contact_moment };
            expected.extend_from_slice(vector.as_slice());
        }
        assert_close(&found, &expected);
        assert_eq!(cells[first..first + 15], found);
        assert_eq!(header.split(',').nth(first + 5), Some(format!("{name}2_3").as_str()));
    }
}

/// The accelerations of `forward_dynamics_friction` need the given joint torques, with a wrench and
/// without one; a robot without friction does not have this function.
#[test]
fn forward_dynamics_takes_friction_in() {
    let file = robot("trttr1");
    let tau = [40.0, -3.0, 300.0, 8.0, 0.5];
    for wrench in [[0.0; 6], WRENCH] {
        let state = json!([{"q": Q, "qd": QD, "tau": tau, "wrench": wrench}]);
        let called = |function: &str, state: &Value| {
            let arguments = ["eval", &file, "--function", function, "--states", "-"];
            let found: Value =
                serde_json::from_str(&output(&arguments, &state.to_string())).unwrap();
            found[0].clone()
        };
        let qdd = called("forward_dynamics_friction", &state)["qdd"].clone();
        let state = json!([{"q": Q, "qd": QD, "qdd": qdd, "wrench": wrench}]);
        let found = called("inverse_dynamics_friction", &state)["tau"].clone();
        for (found, tau) in found.as_array().unwrap().iter().zip(tau) {
            assert!((found.as_f64().unwrap() - tau).abs() < 1e-10, "{found} is not {tau}");
        }
    }
    let file = robot("planar_2r");
    let arguments = ["eval", &file, "--function", "forward_dynamics_friction", "--states", "-"];
    assert!(complaint(1, &arguments, "[]").contains("no joint has friction"));
}

#[test]
fn everything_that_is_wrong_is_said_at_once() {
    let states = json!([{"q": Q, "qd": QD}, {"q": [1, 2], "qd": QD, "qdd": QDD, "tip": 1}]);
    let file = robot("trttr1");
    let arguments =
        ["eval", &file, "--function", "inverse_dynamics", "--states", "-", "--set", "M6=1"];
    let shown = complaint(1, &arguments, &states.to_string());
    let lines: Vec<&str> = shown.lines().collect();
    assert!(
        lines[0].starts_with("error: --set: there is no parameter `M6`. Did you mean `M"),
        "{shown}"
    );
    assert_eq!(lines[1], "error: standard input: state 2: `q` has 2 entries, not 5");
    assert!(lines[2].starts_with("error: standard input: state 2: unknown key `tip`"), "{shown}");
    assert_eq!(
        lines[3],
        "error: standard input: state 1: `qdd` is missing; inverse_dynamics needs it"
    );
    assert_eq!(lines.len(), 4);
}

/// A text that is not a list of states is told beside a wrong option, and in place of what was wrong with its states.
#[test]
fn what_is_not_a_list_of_states_is_told_with_wrong_options() {
    let path = folder("eval-no-states").join("states.json");
    std::fs::write(&path, r#"[{"q": [1]}, {"q": [1, 2, 3]} oops"#).unwrap();
    let (file, path) = (robot("planar_2r"), path.to_str().unwrap());
    let eval = ["eval", &file, "--function", "gravity", "--states", path, "--set", "m9=1"];
    let shown = complaint(1, &eval, "");
    let lines: Vec<&str> = shown.lines().collect();
    assert!(lines[0].starts_with("error: --set: there is no parameter `m9`."), "{shown}");
    assert!(
        lines[1].starts_with(&format!("error: {path}: this is not JSON at line 1, ")),
        "{shown}"
    );
    assert_eq!(lines.len(), 2, "{shown}");
    let twice = ["--set", "m1=1", "--set", "m1=2"];
    let shown = complaint(2, &[&eval[..4], &["--q", "0,0"], &twice[..]].concat(), "");
    assert_eq!(shown, "error: --set: `m1` is given twice; leave one out\n");
}

#[test]
fn a_robot_without_a_tip_takes_no_wrench() {
    let file = robot("planar_3r");
    let text = std::fs::read_to_string(&file).unwrap();
    let (without_tip, _) = text.split_once("[tip]").unwrap();
    let path = folder("eval-no-tip").join("arm.toml");
    std::fs::write(&path, without_tip).unwrap();
    let zero = [0.0; 3];
    let arguments =
        ["eval", path.to_str().unwrap(), "--function", "inverse_dynamics", "--states", "-"];
    let state = json!([{"q": zero, "qd": zero, "qdd": zero, "wrench": [0, 0, 0, 0, 0, 0]}]);
    run_with(&arguments, state.to_string().as_bytes());
    let state = json!([{"q": zero, "qd": zero, "qdd": zero, "wrench": [1, 0, 0, 0, 0, 0]}]);
    let shown = complaint(1, &arguments, &state.to_string());
    assert!(shown.contains("state 1: has a wrench, but the robot has no tip"), "{shown}");
}

#[test]
fn wrong_arguments_are_usage_errors() {
    let file = robot("trttr1");
    let with = |function: &str, more: &[&str]| {
        let arguments = ["eval", &file, "--function", function, "--states", "-"];
        complaint(2, &[&arguments[..], more].concat(), "[]")
    };
    let shown = with("inverse_dynamic", &[]);
    assert!(
        shown.contains("there is no function `inverse_dynamic`. Did you mean `inverse_dynamics`?")
    );
    for setting in ["M5", "M5=x", "M5=inf", "M5="] {
        assert!(with("inverse_dynamics", &["--set", setting]).contains("--set"), "{setting}");
    }
    let shown = complaint(
        1,
        &["eval", &file, "--function", "inverse_dynamics", "--states", "none.json"],
        "",
    );
    assert!(shown.starts_with("error: cannot read none.json"), "{shown}");
}

#[test]
fn functions_of_a_frame_are_called_by_their_names() {
    let text = std::fs::read_to_string(robot("planar_2r")).unwrap();
    let path = folder("eval-frames").join("arm.toml");
    assert!(text.contains("[tip]"));
    let frame = "\n[[frame]]\nname = \"elbow\"\nparent = \"1\"\n";
    std::fs::write(&path, format!("{text}{frame}")).unwrap();
    let states = json!([{"q": [0.3, 0.5]}]).to_string();
    let arguments = |function: &'static str| {
        let path = path.to_str().unwrap();
        ["eval", path, "--function", function, "--states", "-"]
    };
    let shown: Value =
        serde_json::from_str(&output(&arguments("jacobian_elbow"), &states)).unwrap();
    let (_, rows) = shown[0].as_object().unwrap().iter().next().unwrap();
    assert_eq!(rows.as_array().unwrap().len(), 6);
    let shown = complaint(2, &arguments("jacobian"), &states);
    assert!(shown.contains("jacobian_elbow"), "{shown}");
    let shown = complaint(2, &arguments("jacobian_knee"), &states);
    assert!(shown.contains("there is no function `jacobian_knee`"), "{shown}");
}

#[test]
fn bundles_of_the_file_are_called_by_their_names() {
    let text = std::fs::read_to_string(robot("planar_2r")).unwrap();
    let path = folder("eval-bundles").join("arm.toml");
    let code = "\n[code]\nbundles = { both = [\"mass_matrix\", \"bias\"] }\n";
    std::fs::write(&path, format!("{text}{code}")).unwrap();
    let states = json!([{"q": [0.3, 0.5], "qd": [1, 2]}]).to_string();
    let call = |function: &str| -> Value {
        let arguments = ["eval", path.to_str().unwrap(), "--function", function, "--states", "-"];
        serde_json::from_str(&output(&arguments, &states)).unwrap()
    };
    let (both, mass, bias) = (call("both"), call("mass_matrix"), call("bias"));
    assert_eq!(both[0]["mass_matrix"], mass[0]["mass_matrix"]);
    assert_eq!(both[0]["bias"], bias[0]["tau"]);
    let shown = output(&["stats", path.to_str().unwrap(), "--format", "text"], "");
    assert!(shown.lines().any(|line| line.starts_with("both ")), "{shown}");
}

#[test]
fn a_nearly_singular_mass_matrix_is_reported() {
    let states = |q2: f64| {
        json!([{"q": [0.3, 0.5, 0.4], "qd": [0, 0, 0], "tau": [1, 2, 3]},
                                  {"q": [0.3, q2, 0.4], "qd": [0, 0, 0], "tau": [1, 2, 3]}])
    };
    for function in ["forward_dynamics", "forward_dynamics_derivatives"] {
        let arguments = ["eval", WRIST, "--function", function, "--states", "-"];
        let shown = |q2: f64| run_with(&arguments, states(q2).to_string().as_bytes());
        let (far, near, there) = (shown(0.1), shown(1e-6), shown(0.0));
        assert_eq!((far.code, far.errors.as_str()), (0, ""));
        assert_eq!((near.code, near.errors.lines().count()), (0, 1), "{}", near.errors);
        let starts = "warning: state 2: the mass matrix is nearly singular";
        assert!(
            near.errors.starts_with(starts) && near.errors.contains("`roll`"),
            "{}",
            near.errors
        );
        assert_eq!((there.code, there.output.as_str()), (1, ""));
        let reason = "the mass matrix is singular at this state";
        assert!(there.errors.starts_with("error: state 2: "), "{}", there.errors);
        assert!(there.errors.contains(reason), "{}", there.errors);
    }
}

/// The reason is that of the robot with the parameters that are set, and the nominal values of the others.
#[test]
fn a_set_parameter_that_makes_the_mass_matrix_singular_is_the_reason() {
    let file = folder("eval-set-singular").join("arm.toml");
    let text = "format = 1\n[robot]\nname = \"arm\"\n[parameters]\nm = 2\nl = 3\n[[link]]\n\
        name = \"rod\"\nmass = \"m\"\ncenter_of_mass = [\"l - 1\", 0, 0]\n\
        inertia = { xx = 0, yy = 0, zz = 0 }\njoint = { name = \"swing\", type = \"revolute\", axis = \"z\" }\n";
    std::fs::write(&file, text).unwrap();
    let state = ["--function", "forward_dynamics", "--q=0.5", "--qd=0", "--tau=1"];
    let eval = [&["eval", file.to_str().unwrap()][..], &state].concat();
    let shown: Value = serde_json::from_str(&output(&eval, "")).unwrap();
    assert_close(&numbers(&shown[0]["qdd"]), &[1.0 / 8.0]);
    let shown = complaint(1, &[&eval[..], &["--set", "l=1"]].concat(), "");
    let reason = "`qdd` does not have a finite value at entry 1 (joint `swing`); the mass matrix is singular at this \
        state: the joint torques do not determine the accelerations of q1 = 0.5 (joint `swing`)";
    assert!(shown.contains(reason), "{shown}");
}

/// A state whose angle is too large for the sine is not reported to have a singular mass matrix.
#[test]
fn an_angle_that_has_no_sine_is_the_reason() {
    let file = robot("planar_2r");
    let states = r#"[{"q": [0, 2e9], "qd": [0, 0], "tau": [1, 1]}]"#;
    let arguments = ["eval", &file, "--function", "forward_dynamics", "--states", "-"];
    let shown = complaint(1, &arguments, states);
    assert!(
        shown.contains("q2 = 2000000000 rad (joint `2`) is outside the range of the program"),
        "{shown}"
    );
    assert!(!shown.contains("singular"), "{shown}");
    output(&[&arguments[..], &["--trigonometry", "standard"]].concat(), states);
    let shown = complaint(1, &["simulate", &file, "--q0", "0,2e9"], "");
    assert!(shown.contains("q2 = 2000000000 rad (joint `2`) is outside the range"), "{shown}");
    let expressions = "q1 = 0; q2 = 2e9";
    let shown = complaint(1, &["torques", &file, "--expressions", expressions, "--time", "1"], "");
    assert!(shown.contains("q2 = 2000000000 rad (joint `2`) is outside the range"), "{shown}");
}

#[test]
fn a_state_is_given_on_the_command_line() {
    let file = robot("planar_2r");
    let eval = |more: &[&str]| output(&[&["eval", &file, "--function"], more].concat(), "");
    let states =
        r#"[{"q": [1.5707963267948966, -0.5235987755982988], "qd": [0, 1], "qdd": [-2, 0.5]}]"#;
    let arguments = ["eval", &file, "--function", "inverse_dynamics", "--states", "-"];
    let given = ["inverse_dynamics", "--q", "pi/2,-30deg", "--qd", "0,1", "--qdd=-2,1/2"];
    assert_eq!(eval(&given), output(&arguments, states));
    // A wrench chooses the function that takes it.
    let loaded = [
        "inverse_dynamics",
        "--q",
        "0,0",
        "--qd",
        "0,0",
        "--qdd",
        "0,0",
        "--wrench",
        "0,-10,0,0,0,0",
    ];
    assert_ne!(eval(&loaded), eval(&loaded[..7]));
}

#[test]
fn a_function_without_inputs_needs_no_state() {
    let file = robot("planar_2r");
    let shown = output(&["eval", &file, "--function", "base_parameters"], "");
    let states: Value = serde_json::from_str(&shown).unwrap();
    let base = numbers(&states[0]["base_parameters"]);
    // The values of MXR_1, MY_1, ZZR_1, MX_2, MY_2 and ZZR_2 by hand.
    assert_close(&base, &[5.0 * 0.5 + 3.0, 0.0, 0.42 + 1.25 + 3.0, 1.2, 0.0, 0.16 + 0.48]);
    // An option of a state still has no effect.
    let wrong = complaint(2, &["eval", &file, "--function", "base_parameters", "--q", "0,0"], "");
    assert!(wrong.contains("--q has no effect on base_parameters, which takes nothing"), "{wrong}");
}

#[test]
fn wrong_states_on_the_command_line_are_told_with_their_place() {
    let file = robot("planar_2r");
    let wrong = |code, more: &[&str]| {
        complaint(code, &[&["eval", &file, "--function", "inverse_dynamics"], more].concat(), "")
    };
    assert_eq!(
        wrong(2, &["--q", "pi/2,x", "--qd", "1", "--qdd", "1,90deg/s"]),
        "error: --q: entry 2, q2: `x` is not a number; write one such as 0.5, pi/2 or 90deg\n\
         error: --qd: 1 entry, not 2 (qd1, qd2)\n\
         error: --qdd: entry 2, qdd2: `90deg/s` is not a number; write one such as 0.5, pi/2 or 90deg/s^2\n"
    );
    assert!(wrong(2, &[]).contains("a state is needed"));
    assert!(wrong(2, &["--q", "0,0"]).contains("`qd` is missing; inverse_dynamics needs it"));
    assert!(wrong(2, &["--q", "0,0", "--states", "-"]).contains("cannot be used with"));
    assert!(wrong(2, &["--wrench", "1,2"]).contains("--wrench: 2 entries, not 6 (fx, fy"));
    assert!(wrong(2, &["--wrench", "hand=1,2,3,4,5,6"]).contains("leave out `hand=`"));
    let scara =
        complaint(2, &["eval", &robot("scara"), "--function", "gravity", "--q", "0,0,90deg,0"], "");
    assert!(
        scara.contains("entry 3, q3: `90deg` is an angle, and the joint is prismatic"),
        "{scara}"
    );
}

#[test]
fn each_tip_has_one_wrench_on_the_command_line() {
    let text = std::fs::read_to_string(robot("planar_2r")).unwrap();
    let two = "[[tip]]\nname = \"left\"\nparent = \"1\"\n\n[[tip]]\nname = \"right\"\n";
    let file = folder("eval-tips").join("two.toml");
    std::fs::write(&file, text.replace("[tip]\n", two)).unwrap();
    let (one, two) = (robot("planar_2r"), file.display().to_string());
    let rest = ["--function", "inverse_dynamics", "--q=0,0", "--qd=0,0", "--qdd=0,0"];
    let arguments = |file: &str, wrenches: &[&str]| -> Vec<String> {
        let wrenches = wrenches.iter().map(|wrench| format!("--wrench={wrench}"));
        ["eval", file].into_iter().chain(rest).map(str::to_owned).chain(wrenches).collect()
    };
    let run = |file: &str, wrenches: &[&str]| {
        let arguments = arguments(file, wrenches);
        run_with(&arguments.iter().map(String::as_str).collect::<Vec<_>>(), b"")
    };
    let (left, right) = ("left=0,10,0,0,0,0", "right=0,20,0,0,0,0");
    let both = run(&two, &[left, right]);
    assert_eq!((both.code, both.errors.as_str()), (0, ""));
    assert_eq!(run(&two, &[right, left]).output, both.output);
    for (file, wrenches, message) in [
        (&one, &["0,1,0,0,0,0"; 2][..], "--wrench: `wrench` is given twice; leave one out"),
        (&two, &[left, right, left], "--wrench: `wrench_left` is given twice; leave one out"),
        (&two, &[right, left, right], "--wrench: `wrench_right` is given twice; leave one out"),
        (
            &two,
            &["0,1,0,0,0,0"],
            "--wrench: the robot has several tips; write TIP=FX,FY,FZ,MX,MY,MZ for one of left, right",
        ),
    ] {
        let done = run(file, wrenches);
        let lines: Vec<&str> = done.errors.lines().collect();
        assert_eq!((done.code, done.output.as_str()), (2, ""), "{wrenches:?}");
        assert_eq!(lines, [format!("error: {message}")], "{wrenches:?}");
    }
}

#[test]
fn a_wrench_of_0_by_default_is_noted() {
    let file = robot("planar_2r");
    let eval = |function: &str, states: &str| {
        run_with(&["eval", &file, "--function", function, "--states", "-"], states.as_bytes())
    };
    // A file without a header is an error; one without states has no outputs.
    let done = eval("gravity", "");
    let message = "error: standard input: there are no states\n";
    assert_eq!((done.code, done.errors.as_str(), done.output.as_str()), (1, message, ""));
    let state = r#"{"q": [0, 0], "qd": [1, 1], "qdd": [0, 0]}"#;
    let loaded = state.replace('}', r#", "wrench": [0, 0, 0, 0, 0, 0]}"#);
    for (function, states, note) in [
        ("inverse_dynamics", format!("[{state}]"), ""),
        ("inverse_dynamics_wrench", format!("[{loaded}]"), ""),
        (
            "inverse_dynamics_wrench",
            format!("[{state}]"),
            "note: no wrench is given, so inverse_dynamics_wrench is computed with 0\n",
        ),
        ("inverse_dynamics_wrench", format!("[{state}, {loaded}, {state}]"), ""),
    ] {
        let done = eval(function, &states);
        assert_eq!((done.code, done.errors.as_str()), (0, note), "{function} {states}");
    }
}

/// Numbers are not arrays, in JSON and in the header of CSV.
#[test]
fn energies_are_numbers() {
    let file = robot("planar_2r");
    let eval = ["eval", &file, "--function", "energies", "--q=0,0", "--qd=1,2", "--format"];
    let shown: Value = serde_json::from_str(&output(&[&eval[..], &["json"]].concat(), "")).unwrap();
    let energies = mechanism("planar_2r", &[]).energies(&[0.0, 0.0], &[1.0, 2.0]).unwrap();
    let found = ["kinetic", "potential"].map(|name| shown[0][name].as_f64().unwrap());
    assert!((found[0] - energies.kinetic).abs() < 1e-12 * energies.kinetic.abs(), "{shown}");
    let csv = output(&[&eval[..], &["csv"]].concat(), "");
    assert_eq!(csv, format!("kinetic,potential\n{:?},{:?}\n", found[0], found[1]));
}
