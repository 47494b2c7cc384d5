//! The files and values that commands accept, and their messages about input without effect.

use crate::{URDF, complaint, folder, output, robot, run, run_with};

fn written(test: &str, name: &str, text: &str) -> String {
    let path = folder(test).join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

const STATE: &str = r#"[{"q": [0.3, 0.5], "qd": [1, 2], "qdd": [0, 0]}]"#;

#[test]
fn values_that_are_set_are_held_against_the_checks_of_the_reader() {
    let file = robot("planar_2r");
    let eval = ["eval", &file, "--function", "gravity", "--states", "-"];
    let shown = complaint(1, &[&eval[..], &["--set", "m2=-1"]].concat(), STATE);
    assert!(shown.starts_with("with --set m2=-1:\nerror[R0501]: the mass is -1 kg"), "{shown}");
    for command in ["simulate", "torques"] {
        let arguments = [command, &file, "--set", "m2=-1", "--time", "1"];
        let expressions = ["--expressions", "q1=t;q2=t"];
        let more = if command == "torques" { &expressions[..] } else { &[] };
        let shown = complaint(1, &[&arguments[..], more].concat(), "");
        assert!(shown.contains("error[R0501]: the mass is -1 kg"), "{shown}");
    }
    let outcome = run_with(
        &[&eval[..], &["--set", "m2=-1", "--allow-unphysical"]].concat(),
        STATE.as_bytes(),
    );
    assert_eq!(outcome.code, 0);
    assert!(outcome.errors.starts_with("warning[R0501]: the mass is -1 kg"), "{}", outcome.errors);

    // A tensor, an axis, a payload.
    let text = std::fs::read_to_string(robot("planar_2r")).unwrap();
    let checked =
        text.replace("{ zz = \"I2\", unchecked = true }", "{ xx = 0.1, yy = 0.1, zz = \"I2\" }");
    assert_ne!(text, checked);
    let payload = checked.replace("[tip]", "[payload]\n\n[tip]");
    let file = written("reading-set", "arm.toml", &payload);
    let eval = ["eval", &file, "--function", "gravity", "--states", "-", "--set"];
    for (setting, code) in [
        ("I2=-5", "R0502"),
        ("I2=0.5", "R0503"),
        ("payload_mass=-1", "R0501"),
        ("payload_xx=1e40", "R0301"),
        ("payload_xx=-1", "R0502"),
    ] {
        let shown = complaint(1, &[&eval[..], &[setting]].concat(), STATE);
        assert!(shown.contains(&format!("error[{code}]")), "{setting}: {shown}");
    }
    output(&[&eval[..], &["payload_mass=1.5"]].concat(), STATE);
    // No payload is a mass of 0 with a tensor of 0. With a mass of 0, a tensor is judged as with any other.
    output(&[&eval[..], &["payload_mass=0"]].concat(), STATE);
    let tensor = ["payload_xx=0.2", "--set", "payload_yy=0.2", "--set", "payload_zz=0.3"];
    output(&[&eval[..], &tensor].concat(), STATE);
    let leaning = text.replacen("axis = \"z\"", "axis = [0, 0, \"r1\"]", 1);
    let file = written("reading-axis", "arm.toml", &leaning);
    let eval = ["eval", &file, "--function", "gravity", "--states", "-", "--set", "r1=0"];
    assert!(complaint(1, &eval, STATE).contains("error[R0403]: the joint axis is zero"));
}

#[test]
fn what_is_waived_is_waived_at_every_command() {
    let text = URDF.replace("iyy=\"0.1\" izz=\"0.1\"", "iyy=\"1e-6\" izz=\"0.1\"");
    let file = written("reading-waived", "arm.urdf", &text);
    let state = r#"[{"q": [0.3], "qd": [1], "qdd": [0]}]"#;
    let commands: [&[&str]; 7] = [
        &["equations", &file],
        &["stats", &file, "--function", "bias"],
        &["generate", &file],
        &["show", &file],
        &["base", &file],
        &["eval", &file, "--function", "bias", "--states", "-"],
        &["simulate", &file, "--time", "0.1"],
    ];
    for arguments in commands {
        let outcome = run_with(arguments, state.as_bytes());
        assert_eq!(outcome.code, 1, "{arguments:?}");
        assert!(
            outcome.errors.contains("read the file with `--allow-unphysical`"),
            "{}",
            outcome.errors
        );
        let outcome = run_with(&[arguments, &["--allow-unphysical"]].concat(), state.as_bytes());
        assert_eq!(outcome.code, 0, "{arguments:?}: {}", outcome.errors);
        assert!(outcome.errors.contains("warning[R0503]"), "{}", outcome.errors);
    }
}

/// A trunk of 5 kg with two legs.
const WALKER: &str = include_str!("../../../robot_model/tests/broken/urdf_free_base.urdf");

#[test]
fn a_trunk_that_stands_still_is_a_warning_everywhere() {
    let file = written("reading-trunk", "walker.urdf", WALKER);
    let commands: [&[&str]; 4] = [
        &["equations", &file],
        &["generate", &file],
        &["stats", &file, "--function", "bias"],
        &["check", &file],
    ];
    for arguments in commands {
        let shown = run(arguments).errors;
        let expected = "warning[R0617]: the base of 5 kg is fixed, and 2 branches move on it";
        assert!(shown.contains(expected), "{arguments:?}: {shown}");
    }
    // The base of an arm is unchanged.
    let arm = URDF.replace(
        "<link name=\"base\"/>",
        "<link name=\"base\"><inertial><mass value=\"3\"/>\
        <inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>",
    );
    assert_ne!(arm, URDF);
    let file = written("reading-base", "arm.urdf", &arm);
    output(&["equations", &file], "");
}

#[test]
fn what_bears_on_the_dynamics_and_is_not_read_is_told_in_a_line() {
    let dynamics = "<dynamics damping=\"5\" friction=\"3\"/></joint>\
        <transmission name=\"t\"><actuator name=\"m\"><mechanicalReduction>50</mechanicalReduction></actuator></transmission>\
        <gazebo reference=\"rod\"><turnGravityOff>true</turnGravityOff></gazebo>";
    let text = URDF.replace("</joint>", dynamics);
    let file = written("reading-dropped", "arm.urdf", &text);
    let outcome = run(&["generate", &file]);
    assert_eq!(outcome.code, 0);
    let line = outcome.errors.trim_end();
    assert_eq!(line.lines().count(), 1, "{line}");
    for part in ["the friction of 1 joint", "1 transmission", "gravity", "import --friction"] {
        assert!(line.contains(part), "{line}");
    }
    let shown = run(&["check", &file]).errors;
    for part in
        ["1 joint: `effort` of `<limit>` is ignored", "1 transmission: gear ratio", "1 Gazebo"]
    {
        assert!(shown.contains(part), "{shown}");
    }
    // Data that does not concern dynamics is not reported.
    let file = written("reading-plain", "arm.urdf", URDF);
    output(&["generate", &file], "");
    let negative = URDF.replace("effort=\"10\"", "effort=\"-10\"");
    let file = written("reading-effort", "arm.urdf", &negative);
    let shown = run(&["check", &file]).errors;
    assert!(shown.contains("warning[R0618]: the effort limit is -10"), "{shown}");
}

#[test]
fn friction_that_the_robot_has_not_is_an_error() {
    let dynamics = "<dynamics damping=\"5\" friction=\"3\"/></joint>";
    let file = written("reading-friction", "arm.urdf", &URDF.replace("</joint>", dynamics));
    let commands: [&[&str]; 4] = [
        &["equations", &file, "--friction"],
        &["document", &file, "--friction"],
        &["simulate", &file, "--friction", "--time", "0.1"],
        &["torques", &file, "--friction", "--expressions", "q1=t", "--time", "0.1"],
    ];
    for arguments in commands {
        let shown = complaint(1, arguments, "");
        assert!(shown.contains("--friction: no joint has friction"), "{shown}");
        assert!(shown.contains("import --friction"), "{shown}");
    }
    let imported = run(&["import", &file, "--friction"]).output;
    let file = written("reading-imported", "arm.toml", &imported);
    assert!(output(&["equations", &file, "--friction"], "").contains("5*qd1"));
}

#[test]
fn options_without_effect_are_refused() {
    let file = robot("planar_2r");
    let gravity = ["eval", &file, "--function", "gravity", "--q", "0,0"];
    let eval = |more: &[&'static str]| [&gravity[..], more].concat();
    let (moving, loaded) =
        (eval(&["--qd", "1,1", "--tau", "0,0"]), eval(&["--wrench", "0,1,0,0,0,0"]));
    let commands: [(&[&str], &str); 14] = [
        (&moving, "--qd has no effect on gravity, which takes q; leave it out\n"),
        (&moving, "--tau has no effect on gravity, which takes q; leave it out\n"),
        (&loaded, "--wrench has no effect on gravity, which takes q; leave it out\n"),
        (
            &["equations", &file, "--quantity", "F", "--form", "grouped"],
            "--quantity F has no effect",
        ),
        (
            &["document", &file, "--quantity", "all", "--form", "recursive,grouped"],
            "has only Q; choose",
        ),
        (
            &["equations", &file, "--quantity", "Q,F", "--form", "regrouped"],
            "--quantity Q,F has no",
        ),
        (&["equations", &file, "--christoffel"], "add --form grouped"),
        (&["equations", &file, "--double-angles"], "add --form collected"),
        (&["equations", &file, "--width", "8cm"], "add --format latex"),
        (&["equations", &file, "--numbers"], "add --format latex"),
        (&["equations", &file, "--trig", "short"], "add --format latex"),
        (&["equations", &file, "--form", "recursive", "--angle-sums", "keep"], "another form"),
        (&["base", &file, "--width", "8cm", "--format", "json"], "add --format latex"),
        (&["document", &file, "--christoffel", "--form", "expanded"], "add --form grouped"),
    ];
    for (arguments, expected) in commands {
        let shown = complaint(2, arguments, "");
        assert!(shown.contains(expected), "{arguments:?}: {shown}");
    }
    let trajectory = ["torques", &file, "--trajectory", "a.csv", "--step", "0.1"];
    assert!(complaint(2, &trajectory, "").contains("--step"));
    assert!(complaint(1, &["import", &file, "--friction"], "").contains("already a robot file"));
}

#[test]
fn tables_of_other_programs_have_a_remedy() {
    let file = robot("planar_2r");
    for (table, part) in [
        ("t;q1;q2\n0;0;0\n", "the header has semicolons instead of commas; separate columns with"),
        ("t\tq1\tq2\n0\t0\t0\n", "the header has tabs instead of commas"),
        ("t,q1,q2\r0,0,0\r", "the lines end with carriage returns alone; end them with line feeds"),
        (
            "# log of today\nt,q1,q2\n0,0,0\n",
            "the first line is a comment, which CSV does not have",
        ),
        (
            "t,q1 [deg],q2\n0,0,0\n",
            "the column `q1 [deg]` is unknown; write the name without a unit",
        ),
        ("t,q1,q2\n0\n", "line 2: 1 entry, but the header has 3\n"),
    ] {
        let shown = complaint(1, &["torques", &file, "--trajectory", "-"], table);
        assert!(shown.contains(part), "{table:?}: {shown}");
    }
    let torques = ["simulate", &file, "--time", "1", "--torques", "-"];
    let shown = complaint(1, &torques, "t;tau1;tau2\n0;0;0\n");
    assert!(shown.contains("the header has semicolons instead of commas"), "{shown}");
}

#[test]
fn remedies_fit_what_was_written() {
    let file = robot("planar_2r");
    let motion = complaint(2, &["torques", &file], "");
    assert!(
        motion.contains("--trajectory with a CSV file, or --expressions with --time"),
        "{motion}"
    );
    let open = ["torques", &file, "--expressions", "q1 = sin(2*pi*t; q2=t", "--time", "1"];
    let open = complaint(1, &open, "");
    assert!(open.contains("this parenthesis is not closed") && open.lines().count() == 1, "{open}");
    for (text, remedy) in
        [("q1 = t, q2 = t", "separate coordinates by `;`"), ("q1 == t; q2 = t", "write `=` once")]
    {
        let shown = complaint(2, &["torques", &file, "--expressions", text, "--time", "1"], "");
        assert!(shown.contains(remedy), "{shown}");
    }
    let more = ["torques", &file, "--trajectory", "-"];
    let other = complaint(1, &more, "t,q1,q2,qd1,qd2,qdd1,qdd2,tau3\n0,0,0,0,0,0,0,0\n");
    assert!(other.contains("the column `tau3` is unknown"), "{other}");
    let single = complaint(1, &["generate", &file, "--language", "wgsl", "--scalar", "f64"], "");
    assert!(single.ends_with("WGSL computes only in f32; use `--scalar f32`\n"), "{single}");
    let tip = "\n[[tip]]\nlink = \"2\"\nposition = [0, 0, 0]\n[tip]\nlink = \"1\"\n";
    let text = std::fs::read_to_string(&file).unwrap() + tip;
    let path = folder("single-tip").join("arm.toml");
    std::fs::write(&path, text).unwrap();
    let shown = complaint(1, &["check", path.to_str().unwrap()], "");
    assert!(shown.contains("help: write each tip as `[[tip]]`, with double brackets\n"), "{shown}");
}

#[test]
fn torques_of_a_file_are_those_of_all_joints() {
    let file = robot("planar_2r");
    let arguments = ["simulate", &file, "--torques", "-", "--time", "0.1"];
    let shown = complaint(1, &arguments, "t,tau1\n0,1\n1,1\n");
    assert_eq!(
        shown,
        "error: standard input: there is no column tau2; add a column of zeros for a joint that is not driven\n"
    );
    output(&arguments, "t,tau1,tau2\n0,1,0\n1,1,0\n");
}

#[test]
fn a_motion_with_a_kink_is_refused() {
    let file = robot("planar_2r");
    let of = |expressions: &'static str, time: &'static str| {
        [
            "torques".to_owned(),
            file.clone(),
            format!("--expressions={expressions}"),
            format!("--time={time}"),
        ]
    };
    let refused = |expressions, time| {
        let arguments = of(expressions, time);
        complaint(1, &arguments.each_ref().map(String::as_str), "")
    };
    let taken = |expressions, time| {
        let arguments = of(expressions, time);
        output(&arguments.each_ref().map(String::as_str), "");
    };
    let shown = refused("q1=t;q2=abs(t-0.025)", "0.1");
    assert!(shown.contains("`q2`: the velocity jumps at t = 0.025"), "{shown}");
    assert!(shown.contains("from -1 to 1"), "{shown}");
    // A velocity that jumps at a sample, at the start, and twice between samples, and a position that jumps.
    assert!(refused("q1=t;q2=abs(t-0.02)", "0.1").contains("t = 0.02"));
    assert!(refused("q1=abs(t);q2=t", "0.1").contains("`q1`: the velocity jumps at t = 0 s"));
    assert!(refused("q1=abs(sin(9*t));q2=t", "1").contains("`q1`: the velocity jumps"));
    assert!(refused("q1=t;q2=sign(t-0.055)", "0.1").contains("`q2`: the position jumps"));
    // The velocity has a kink but no jump, or the jump is after the end.
    taken("q1=t*abs(t-0.025)*(t-0.025);q2=t", "0.1");
    taken("q1=t;q2=abs(t-0.3)", "0.1");
    taken("q1=tanh((t-0.5)/1e-3);q2=1e6*sin(50*t) + abs(t + 1)", "1");
}

#[test]
fn a_pole_between_two_samples_is_refused() {
    let file = robot("planar_2r");
    let arguments = |expressions: &'static str| {
        [
            "torques".to_owned(),
            file.clone(),
            format!("--expressions={expressions}"),
            "--time=1".to_owned(),
        ]
    };
    let refused =
        |expressions| complaint(1, &arguments(expressions).each_ref().map(String::as_str), "");
    let shown = refused("q1=t;q2=1/(t-0.505)");
    assert!(shown.contains("`q2`: the position has no bound at t = 0.505"), "{shown}");
    // Poles of even order, under a root, deep in a product, of a parameter, and at a sample.
    for expressions in [
        "q1=1/(t-0.505)^2;q2=t",
        "q1=1/sqrt((t-0.505)^2);q2=t",
        "q1=t*sin(t)/(3*(2+t)*(t-0.505));q2=t",
        "q1=tan(pi*t/1.01);q2=t",
        "q1=1e-9*l1/(t-0.505*l1);q2=t",
    ] {
        assert!(refused(expressions).contains("`q1`: the position has no bound"), "{expressions}");
    }
    assert!(refused("q1=1/(t-0.5);q2=t").contains("no bound at t = 0.5 s"));
    // A divisor that is 0 where the numerator is, one that is never 0, and one that is 0 after the end.
    for expressions in [
        "q1=sin(t-0.505)/(t-0.505);q2=t",
        "q1=1/((t-0.505)^2+1e-9);q2=t",
        "q1=1/(t-1.5);q2=1/(t+0.001)",
    ] {
        output(&arguments(expressions).each_ref().map(String::as_str), "");
    }
}

#[test]
fn torques_without_a_finite_value_are_an_error() {
    let file = robot("planar_2r");
    let arguments = ["torques", &file, "--expressions", "q1=1e300*t;q2=0", "--time", "1"];
    let shown = complaint(1, &arguments, "");
    assert!(shown.contains("torques do not have finite values"), "{shown}");
}

#[test]
fn values_that_are_not_finite_are_told_by_their_cause() {
    // Two massless links: at q2 = 0 the axes of the first and the last joint coincide.
    let text = "format = 1\n[robot]\nname = \"gimbal\"\n\
        [[link]]\nname = \"a\"\njoint = { type = \"revolute\", axis = \"z\" }\nmassless = true\n\
        [[link]]\nname = \"b\"\njoint = { type = \"revolute\", axis = \"y\" }\nmassless = true\n\
        [[link]]\nname = \"c\"\njoint = { type = \"revolute\", axis = \"z\" }\nmass = 1\n\
        center_of_mass = [0, 0, 0.3]\ninertia = { xx = 0.1, yy = 0.12, zz = 0.13 }\n";
    let file = written("reading-gimbal", "gimbal.toml", text);
    let arguments = ["eval", &file, "--function", "forward_dynamics", "--states", "-"];
    let states = r#"[{"q": [0.1, 0.2, 0.3], "qd": [0, 0, 0], "tau": [1, 1, 1]},
                     {"q": [0.1, 0, 0.3], "qd": [0, 0, 0], "tau": [1, 1, 2]}]"#;
    let shown = complaint(1, &arguments, states);
    assert!(shown.contains("state 2: `qdd` does not have a finite value at entry"), "{shown}");
    assert!(shown.contains("the mass matrix is singular at this state"), "{shown}");
    assert!(
        shown.contains("q1 = 0.1 (joint `a`)") && shown.contains("q3 = 0.3 (joint `c`)"),
        "{shown}"
    );
    assert!(!shown.contains("q2 ="), "{shown}");

    // The mass matrix is singular in every configuration.
    let text = text.replace("axis = \"y\"", "axis = \"z\"");
    let file = written("reading-idle", "idle.toml", &text);
    let arguments = ["eval", &file, "--function", "forward_dynamics", "--states", "-"];
    let shown = complaint(1, &arguments, states);
    assert!(shown.contains("the mass matrix is singular in every configuration"), "{shown}");
    assert!(shown.contains("R0611"), "{shown}");
}

/// A robot with nothing that may be left out, neither tips nor parameters nor friction, is taken by every command.
#[test]
fn a_robot_of_one_link_is_taken_by_every_command() {
    let text = "format = 1\n[robot]\nname = \"pendulum\"\n\
        [[link]]\nname = \"rod\"\njoint = { type = \"revolute\", axis = \"y\" }\nmass = 2\n\
        center_of_mass = [0.5, 0, 0]\ninertia = { xx = 0, yy = 0.1, zz = 0.1 }\n";
    let file = written("reading-pendulum", "pendulum.toml", text);
    let commands: [&[&str]; 11] = [
        &["check"],
        &["show"],
        &["stats"],
        &["base"],
        &["generate"],
        &["equations"],
        &["document"],
        &["diff", &file],
        &["eval", "--function", "inverse_dynamics", "--q", "0", "--qd", "0", "--qdd", "1"],
        &["simulate", "--time", "0.02"],
        &["torques", "--expressions", "q1 = t^2/2", "--time", "0.01"],
    ];
    for command in commands {
        let arguments = [&command[..1], &[file.as_str()], &command[1..]].concat();
        let ran = run(&arguments);
        assert_eq!(
            (ran.code, ran.errors.contains("error")),
            (0, false),
            "{arguments:?}: {}",
            ran.errors
        );
    }
    // 2 kg at half a meter: 0.1 + 2·0.5² by inertia, −2·9.81·0.5 by gravity.
    let arguments = ["torques", &file, "--expressions", "q1 = t^2/2", "--time", "0.01"];
    let shown = output(&arguments, "");
    let mut lines = shown.lines();
    assert_eq!(lines.next(), Some("t,tau1,inertia1,coriolis1,gravity1"));
    let first = lines.next().unwrap().split(',').map(|value| value.parse::<f64>().unwrap());
    for (value, expected) in first.zip([0.0, -9.21, 0.6, 0.0, -9.81]) {
        assert!((value - expected).abs() < 1e-12, "{shown}");
    }
}

/// With other values of parameters, warnings that the values cause are added to those of the file. None is shown twice.
#[test]
fn warnings_of_values_are_added_to_those_of_the_file() {
    let text = std::fs::read_to_string(robot("planar_2r")).unwrap();
    let spare = |count: usize| {
        let name = |index| format!("spare{index} = {{ value = 1.0, unit = \"m\" }}\n");
        let spares: String = (0..count).map(name).collect();
        text.replace("[parameters]\n", &format!("[parameters]\n{spares}"))
    };
    let file = folder("warnings_of_values").join("arm.toml");
    let at = file.to_str().unwrap();
    for known in [0, 1, 2] {
        std::fs::write(&file, spare(known)).unwrap();
        let eval = ["eval", at, "--function", "gravity", "--states", "-", "--allow-unphysical"];
        let warnings = |more: &[&str]| {
            let outcome = run_with(&[&eval[..], more].concat(), STATE.as_bytes());
            assert_eq!(outcome.code, 0, "{}", outcome.errors);
            let of = |code: &str| outcome.errors.matches(&format!("warning[{code}]")).count();
            (of("R0601"), outcome.errors.matches("warning[").count())
        };
        assert_eq!(warnings(&[]), (known, known));
        assert_eq!(warnings(&["--set", "m2=2.5"]), (known, known));
        let (same, all) = warnings(&["--set", "m2=-1"]);
        assert_eq!(same, known);
        assert!(all > known, "{known}: {all}");
    }
}

#[test]
fn show_prints_the_positions_of_joints_that_mimic_others() {
    let link = |name: &str, more: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\njoint = {{ type = \"revolute\", axis = \"z\"{more} }}\nmass = 1\n\
             center_of_mass = [0.1, 0, 0]\ninertia = {{ xx = 0.1, yy = 0.1, zz = 0.1 }}\n"
        )
    };
    let mimic = ", mimic = { joint = \"a\", ratio = -2, offset = 0.3 }";
    let links = [link("a", ", limits = [-1, 1]"), link("b", mimic)].concat();
    let path = folder("show_mimic").join("arm.toml");
    let text = format!("format = 1\n[robot]\nname = \"arm\"\n{links}");
    std::fs::write(&path, text).unwrap();
    let shown = output(&["show", path.to_str().unwrap()], "");
    assert!(shown.contains("  0.3 - 2*q1\n"), "{shown}");
    assert_eq!(shown.matches("-1 to 1 rad").count(), 1, "{shown}");
}

#[test]
fn show_prints_the_drives() {
    let link = |name: &str, drive: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\njoint = {{ type = \"revolute\", axis = \"z\" }}\nmass = 1\n\
             center_of_mass = [0.1, 0, 0]\ninertia = {{ xx = 0.1, yy = 0.1, zz = 0.1 }}\n{drive}\n"
        )
    };
    let drive = "drive = { rotor_inertia = \"J\", gear_ratio = 50 }";
    let text = format!(
        "format = 1\n[robot]\nname = \"arm\"\n[parameters]\nJ = 0.001\n{}{}",
        link("a", ""),
        link("b", drive)
    );
    let path = folder("show_drives").join("arm.toml");
    std::fs::write(&path, &text).unwrap();
    let shown = output(&["show", path.to_str().unwrap()], "");
    assert!(
        shown.contains("\nlink  rotor inertia  gear ratio\nb     J                      50\n"),
        "{shown}"
    );
    assert!(shown.contains("Drives: the rotor inertia, in kg m²"), "{shown}");
    std::fs::write(&path, text.replace(drive, "").replace("J = 0.001\n", "")).unwrap();
    let shown = output(&["show", path.to_str().unwrap()], "");
    assert!(!shown.contains("Drives"), "{shown}");
}
