//! Pinned plans: when they are valid, and how commands handle invalid ones.

use std::path::Path;
use std::time::{Duration, SystemTime};

use crate::{complaint, folder, output, run};

const ARM: &str = "format = 1\n[robot]\nname = \"arm\"\ngravity = [0, \"-g\", 0]\n[parameters]\n\
    g = { value = 9.81, unit = \"m/s^2\" }\nm = { value = 2, unit = \"kg\" }\n\
    [[link]]\nname = \"1\"\njoint = { type = \"revolute\", axis = \"z\" }\nmass = \"m\"\n\
    center_of_mass = [0.1, 0, 0]\ninertia = { xx = 0.01, yy = 0.02, zz = 0.02 }\n";

/// Makes a robot file with its plan in a separate folder.
fn pinned(test: &str) -> String {
    let path = folder(test).join("arm.toml").to_str().unwrap().to_owned();
    std::fs::write(&path, ARM).unwrap();
    output(&["search", &path], "");
    path
}

fn edit(path: &str, from: &str, to: &str) {
    assert!(ARM.contains(from), "{from}");
    std::fs::write(path, ARM.replace(from, to)).unwrap();
}

#[test]
fn what_is_no_change_of_the_mechanics_keeps_the_plan() {
    let arm = pinned("plans_kept");
    for (from, to) in [
        ("format = 1", "# a remark\nformat = 1"),
        ("value = 2, unit", "value = 2.5, doc = \"of the arm\", unit"),
        ("name = \"1\"", "name = \"lever\""),
    ] {
        edit(&arm, from, to);
        output(&["generate", &arm], "");
        output(&["stats", &arm], "");
        output(&["check", &arm, "--deny", "warnings"], "");
    }
}

#[cfg(unix)]
#[test]
fn a_plan_stands_next_to_the_file_that_a_link_leads_to() {
    let folder = folder("plans_linked");
    std::fs::create_dir(folder.join("robots")).unwrap();
    std::fs::write(folder.join("robots/arm.toml"), ARM).unwrap();
    let link = folder.join("current.toml");
    std::os::unix::fs::symlink("robots/arm.toml", &link).unwrap();
    let link = link.to_str().unwrap();
    let said = output(&["search", link], "");
    assert!(said.contains("robots/arm.plan"), "{said}");
    assert!(folder.join("robots/arm.plan").is_file() && !folder.join("current.plan").exists());
    // What reads the plan through the link finds it stale.
    std::fs::write(folder.join("robots/arm.toml"), ARM.replace("[0.1, 0, 0]", "[0.1, 0.2, 0]"))
        .unwrap();
    assert!(run(&["stats", link]).errors.contains("search"));
}

#[test]
fn a_stale_plan_is_a_warning_where_nothing_is_built_and_an_error_where_code_is() {
    let arm = pinned("plans_stale");
    let other = arm.replace("arm.toml", "other.toml");
    let code = arm.replace("arm.toml", "code");
    std::fs::write(&other, ARM).unwrap();
    edit(&arm, "[0.1, 0, 0]", "[0.1, 0.2, 0]");
    let states = "[{\"q\": [0.1], \"qd\": [0], \"qdd\": [0]}]";
    let eval = ["eval", &arm, "--function", "inverse_dynamics", "--states", "-"];
    let remedy = format!("run `robot-symbolic search {arm}` again, or remove the file");
    for arguments in [
        &["stats", &arm][..],
        &["simulate", &arm, "--time", "0.1", "--step", "0.1"],
        &["torques", &arm, "--expressions", "q1 = t", "--time", "0.1", "--step", "0.1"],
        &["report", &arm, "--without-compiler"],
        &eval,
    ] {
        let outcome = crate::run_with(arguments, states.as_bytes());
        assert_eq!(outcome.code, 0, "{arguments:?}: {}", outcome.errors);
        assert!(!outcome.output.is_empty(), "{arguments:?}");
        for part in [
            "warning: ",
            "stale",
            "took 3 operations",
            &remedy,
            "takes 5 operations",
            "builds refuse",
        ] {
            assert!(
                outcome.errors.contains(part),
                "{arguments:?}: {part} is not in {}",
                outcome.errors
            );
        }
        assert_eq!(outcome.errors.matches("plan is stale").count(), 1, "{}", outcome.errors);
    }
    let compared = run(&["diff", &arm, &other]);
    assert!(compared.code == 1 && compared.errors.contains("stale"), "{}", compared.errors);
    // Commands that do not need a plan print no message.
    for command in ["equations", "show", "base", "document"] {
        output(&[command, &arm], "");
    }
    for arguments in [&["generate", &arm][..], &["crate", &arm, "-o", &code], &["prove", &arm]] {
        let refused = complaint(1, arguments, "");
        assert!(refused.starts_with("error: ") && refused.contains(&remedy), "{refused}");
    }
    let warned = complaint(0, &["check", &arm], "");
    assert!(warned.contains("warning[R0803]") && warned.contains(&remedy), "{warned}");

    // The errors of an invalid file are reported, whatever is pinned.
    edit(&arm, "mass = \"m\"", "mas = \"m\"");
    let broken = complaint(1, &["check", &arm], "");
    assert!(broken.contains("R0101") && !broken.contains("R0803"), "{broken}");
    assert!(complaint(1, &["stats", &arm], "").contains("R0101"));

    edit(&arm, "[0.1, 0, 0]", "[0.1, 0.2, 0]");
    output(&["search", &arm], "");
    output(&["generate", &arm], "");
}

/// Any form of the recursion gives the same torques, but not the same operations, which the plan states.
#[test]
fn an_edited_plan_is_refused_where_code_is_made() {
    let arm = pinned("plans_edited");
    let plan = arm.replace(".toml", ".plan");
    let text = std::fs::read_to_string(&plan).unwrap();
    let edits = [
        ("operations = 3", "operations = 1"),
        ("free = \"zero\"", "free = \"still\""),
        ("fingerprint = \"", "fingerprint = \"0"),
        ("digest = \"", "digest = \"0"),
        ("operations = 3", "unit_length = [0, 0]\noperations = 3"),
    ];
    let remedy = format!("run `robot-symbolic search {arm}` again");
    for (from, to) in edits {
        assert!(text.contains(from), "{from} is not in {text}");
        std::fs::write(&plan, text.replacen(from, to, 1)).unwrap();
        let refused = complaint(1, &["generate", &arm], "");
        assert!(refused.contains("was edited") && refused.contains(&remedy), "{to}: {refused}");
        let warned = run(&["stats", &arm]);
        assert!(warned.code == 0 && warned.errors.starts_with("warning: "), "{}", warned.errors);
    }
    // Remarks and blank lines are not part of the plan.
    std::fs::write(&plan, text.replace("\n", "\n# a remark\n\n")).unwrap();
    output(&["generate", &arm], "");
}

#[test]
fn a_plan_of_an_earlier_version_names_the_remedy() {
    let arm = pinned("plans_earlier");
    let plan = arm.replace(".toml", ".plan");
    let text = std::fs::read_to_string(&plan).unwrap();
    std::fs::write(&plan, text.replace("format = 3", "format = 1")).unwrap();
    let remedy = format!("run `robot-symbolic search {arm}` again");
    let refused = complaint(1, &["generate", &arm], "");
    assert!(refused.contains("format 1") && refused.contains(&remedy), "{refused}");
    let warned = run(&["stats", &arm]);
    assert!(warned.code == 0 && warned.errors.starts_with("warning: "), "{}", warned.errors);
    output(&["search", &arm], "");
    output(&["generate", &arm], "");
}

#[test]
fn a_search_sets_the_time_of_the_robot_file_and_leaves_its_text() {
    let arm = pinned("plans_time");
    let long_ago = SystemTime::now() - Duration::from_secs(3600);
    let old = || {
        let file = std::fs::OpenOptions::new().append(true).open(&arm).unwrap();
        file.set_modified(long_ago).unwrap();
    };
    let is_new = || Path::new(&arm).metadata().unwrap().modified().unwrap() > long_ago;
    old();
    output(&["search", &arm, "--dry-run"], "");
    assert!(!is_new());
    output(&["search", &arm], "");
    assert!(is_new());
    assert_eq!(std::fs::read_to_string(&arm).unwrap(), ARM);
}

/// A file at the path of the plan that cannot be a plan is reported, and the command never waits for it.
#[cfg(unix)]
#[test]
fn what_is_no_file_is_no_plan() {
    let arm = pinned("plans_no_file");
    let plan = Path::new(&arm).with_extension("plan");
    std::fs::remove_file(&plan).unwrap();
    let made = std::process::Command::new("mkfifo").arg(&plan).status().unwrap();
    assert!(made.success());
    let shown = complaint(1, &["search", &arm], "");
    assert!(shown.contains("a pinned plan must be a regular file"), "{shown}");
    let shown = complaint(1, &["generate", &arm], "");
    assert!(shown.contains("a pinned plan must be a regular file"), "{shown}");
    let shown = run(&["stats", &arm]);
    assert!(shown.code == 0 && shown.errors.contains("warning: "), "{}", shown.errors);
    std::fs::remove_file(&plan).unwrap();
    std::os::unix::fs::symlink(&plan, &plan).unwrap();
    assert!(complaint(1, &["generate", &arm], "").contains("arm.plan"));
}

#[test]
fn a_tuned_plan_is_one_of_those_with_the_fewest_operations() {
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/puma560.toml");
    let arm = folder("plans_tuned").join("puma560.toml").to_str().unwrap().to_owned();
    std::fs::copy(robot, &arm).unwrap();
    let outcome = run(&["search", "--tune", &arm]);
    if robot_jit::Registers::detect().is_err() {
        assert!(outcome.errors.contains("search without --tune"), "{}", outcome.errors);
        return;
    }
    assert_eq!(outcome.code, 0, "{}", outcome.errors);
    // In the table of times, there are at least 274 operations, and one plan is chosen.
    let rows = outcome.output.lines().skip_while(|line| !line.contains("ns per call")).skip(1);
    let rows: Vec<&str> = rows.take_while(|line| !line.trim().is_empty()).collect();
    assert!(rows.len() > 1, "{}", outcome.output);
    for row in &rows {
        let numbers: Vec<f64> =
            row.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        let [operations, fused, call, state] = numbers[..] else { panic!("{row}") };
        assert!(operations >= 274.0 && fused < operations && call > state, "{row}");
    }
    assert_eq!(rows.iter().filter(|row| row.starts_with("chosen")).count(), 1);
    let fewest = rows.iter().any(|row| row.starts_with("chosen") && row.contains(" 274 "));
    let pin = std::fs::read_to_string(arm.replace(".toml", ".plan")).unwrap();
    assert!(fewest || pin.contains("tuned = true"), "{pin}");
    output(&["generate", &arm], "");
}

/// The text of a robot file of this project, in a folder without its plan.
fn unpinned(test: &str, name: &str) -> String {
    let path = folder(test).join(format!("{name}.toml")).to_str().unwrap().to_owned();
    std::fs::copy(crate::robot(name), &path).unwrap();
    path
}

/// Without a pinned plan, a plan is searched for each call. It is the one that `search` pins.
#[test]
fn without_a_pin_code_has_the_form_that_a_search_finds() {
    let arm = unpinned("plans_without", "stanford");
    let file = robot_build::RobotFile::read(arm.as_ref()).unwrap();
    let default = robot_build::generate(&file.source, &robot_build::Options::default()).unwrap();
    let commands = [&["generate", &arm][..], &["generate", &arm, "--fused"]];
    let before = commands.map(|arguments| output(arguments, ""));
    assert_ne!(before[0], default.code);
    let eval = ["eval", &arm, "--function", "inverse_dynamics", "--states", "-"];
    let states =
        "[{\"q\": [1, 1, 1, 1, 1, 1], \"qd\": [1, 1, 1, 1, 1, 1], \"qdd\": [1, 1, 1, 1, 1, 1]}]";
    let torques = crate::run_with(&eval, states.as_bytes()).output;
    assert!(torques.contains("\"tau\":["), "{torques}");
    output(&["search", &arm], "");
    assert_eq!(output(commands[0], ""), before[0]);
    assert_eq!(crate::run_with(&eval, states.as_bytes()).output, torques);
    output(&["search", &arm, "--fused"], "");
    assert_eq!(output(commands[1], ""), before[1]);
}

/// The numbers of operations in the table of times, in order.
fn timed_operations(output: &str) -> Vec<Vec<String>> {
    let rows = output.lines().skip_while(|line| !line.contains("ns per call")).skip(1);
    let rows = rows.take_while(|line| !line.trim().is_empty()).map(|row| {
        let row = row.trim_start_matches(|sign: char| !sign.is_ascii_digit());
        row.split_whitespace().take(2).map(str::to_owned).collect::<Vec<_>>()
    });
    let mut rows: Vec<_> = rows.collect();
    rows.sort();
    rows
}

/// The plans and the code that is timed are those of the snapped robot.
#[test]
fn a_search_snaps_angles_as_it_is_told() {
    let exact = "format = 1\n[robot]\nname = \"gantry\"\ngravity = [0, 0, -9.81]\n\
        [[link]]\nname = \"1\"\njoint = { type = \"prismatic\", axis = \"x\" }\nmass = 1\n\
        center_of_mass = [0, 0, 0]\ninertia = { xx = 0.1, yy = 0.12, zz = 0.13 }\n\
        [[link]]\nname = \"2\"\njoint = { type = \"prismatic\", axis = \"z\" }\n\
        origin = { xyz = [0.2, 0, 0], rpy = [\"pi/2\", 0, 0] }\nmass = 1\n\
        center_of_mass = [0.1, 0, 0]\ninertia = { xx = 0.1, yy = 0.12, zz = 0.13 }\n";
    let path = folder("plans_snap").join("gantry.toml");
    let at = path.to_str().unwrap();
    let found = |text: &str, more: &[&str]| {
        std::fs::write(&path, text).unwrap();
        let outcome = run(&[&["search", at, "--dry-run"][..], more].concat());
        assert!(!path.with_extension("plan").exists());
        outcome
    };
    let plan = |text: &str, more: &[&str]| found(text, more).output.replace("\n\n", "\n");
    let counts =
        |text: &str, more: &[&str]| plan(text, more).split("; ").next().unwrap().to_owned();
    let rounded = exact.replace("\"pi/2\"", "1.5708");
    assert_eq!(counts(&rounded, &["--snap", "1e-3"]), counts(exact, &[]));
    assert_ne!(counts(&rounded, &[]), counts(exact, &[]));
    let tuned = found(exact, &["--tune"]);
    if robot_jit::Registers::detect().is_err() {
        return;
    }
    assert_eq!(tuned.code, 0, "{}", tuned.errors);
    let snapped = found(&rounded, &["--tune", "--snap", "1e-3"]).output;
    assert_eq!(timed_operations(&snapped), timed_operations(&tuned.output));
    assert_eq!(timed_operations(&snapped).len(), 1, "{snapped}");
    assert!(timed_operations(&found(&rounded, &["--tune"]).output).len() > 1);
}
