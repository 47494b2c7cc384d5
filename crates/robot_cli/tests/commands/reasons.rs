//! Reasons of the system and of parsers are given in plain words, with a remedy that works.

use crate::{complaint, folder, output, robot, run};

/// A folder with a copy of the planar arm; its path, and that of the arm.
fn arm(test: &str) -> (std::path::PathBuf, String) {
    let folder = folder(test);
    let path = folder.join("arm.toml");
    std::fs::copy(robot("planar_2r"), &path).unwrap();
    (folder, path.to_str().unwrap().to_owned())
}

#[test]
fn paths_that_cannot_be_have_a_reason() {
    let (_, file) = arm("reasons_paths");
    let below = format!("{file}/x");
    let reason = "a part of its path is a file, not a folder";
    for arguments in [
        &["check", &below][..],
        &["generate", &file, "-o", &below],
        &["eval", &file, "--function", "gravity", "--states", &below],
        &["torques", &file, "--trajectory", &below],
        &["convert", &below],
    ] {
        let done = run(arguments);
        assert_ne!(done.code, 0, "{arguments:?}");
        if arguments[0] != "convert" {
            assert!(done.errors.contains(reason), "{arguments:?}: {}", done.errors);
        }
        assert!(!done.errors.contains("os error"), "{arguments:?}: {}", done.errors);
    }
}

#[cfg(unix)]
#[test]
fn links_that_form_a_cycle_have_a_reason() {
    let (folder, file) = arm("reasons_links");
    let link = folder.join("link");
    let _ = std::fs::remove_file(&link);
    std::os::unix::fs::symlink(&link, &link).unwrap();
    let link = link.to_str().unwrap();
    for arguments in [
        &["check", link][..],
        &["generate", &file, "-o", link],
        &["eval", &file, "--function", "gravity", "--states", link],
    ] {
        let done = run(arguments);
        let reason = "its symbolic links form a cycle";
        assert!(done.errors.contains(reason), "{arguments:?}: {}", done.errors);
    }
}

#[test]
fn states_that_cannot_be_read_have_a_reason() {
    let (_, file) = arm("reasons_states");
    let eval = ["eval", &file, "--function", "gravity", "--states", "-"];
    let deep = complaint(1, &eval, &"[".repeat(1000));
    for (states, expected) in [
        ("[{\"q\": [1e999, 1]}]", "the number at line 1, column 14 is too large"),
        ("[{\"q\": [1, 1]}", "the text ends too early, at line 1, column 14"),
        ("[{\"q\": [NaN, 1]}]", "this is not JSON at line 1, column 9: expected value"),
        ("q1,q2\n1e999,1\n", "`q1` is `1e999`, not a finite number"),
        ("q1,q2\nx,1\n", "`q1` is `x`, not a number"),
    ] {
        let found = complaint(1, &eval, states);
        assert!(found.contains(expected), "{states}: {found}");
    }
    let power = complaint(2, &["eval", &file, "--function", "gravity", "--q", "10^400,0"], "");
    assert!(power.contains("`10^400`: the exponent 400 is beyond"), "{power}");
    assert!(deep.contains("brackets are nested too deeply at line 1, column 128"), "{deep}");
    let wide: Vec<u8> = "q1,q2".encode_utf16().flat_map(|unit| [unit as u8, 0]).collect();
    let done = crate::run_with(&eval, &[&[0xff, 0xfe], &wide[..]].concat());
    assert!(
        done.errors.contains("not UTF-8 text from byte 1 on; save it as UTF-8"),
        "{}",
        done.errors
    );
    for (states, place) in [("[{\"qd\": [0, 0]}]", "state 1"), ("qd1,qd2\n0,0\n", "line 2")] {
        let found = complaint(1, &eval, states);
        let expected = format!("error: standard input: {place}: `q` is missing");
        assert!(found.contains(&expected), "{found}");
    }
}

#[test]
fn whole_numbers_have_their_range() {
    let file = robot("planar_2r");
    for (arguments, range) in [
        (&["generate", &file, "--batch=-1"][..], ""),
        (&["generate", &file, "--batch=1.5"], ""),
        (&["generate", &file, "--batch=x"], ""),
        (&["generate", &file, "--batch=99999999999999999999999"], ""),
        (&["diff", &file, &file, "--seed", "-1"], ""),
        (&["diff", &file, &file, "--states=0"], " from 1 to 100000"),
        (&["diff", &file, &file, "--terms=1.5"], ""),
        (&["equations", &file, "--digits=18"], " from 1 to 17"),
        (&["base", &file, "--digits=x"], " from 1 to 17"),
        (&["document", &file, "--columns=3"], " from 1 to 2"),
        (&["watch", &file, "--saves", "-1"], ""),
        (&["simulate", &file, "--max-steps=-1"], ""),
        (&["simulate", &file, "--max-steps", "-1"], ""),
    ] {
        let found = complaint(2, arguments, "");
        let expected = format!("expected a whole number{range}");
        assert!(found.contains(&expected), "{arguments:?}: {found}");
    }
    output(&["simulate", &file, "--time", "0.01", "--max-steps", "1e6"], "");
}

/// The remedy for a plan that no search wrote is not a search, which does not replace it either.
#[test]
fn plans_that_are_none_are_to_be_moved() {
    let (folder, file) = arm("reasons_plans");
    let plan = folder.join("arm.plan");
    let _ = std::fs::remove_dir(&plan);
    std::fs::write(&plan, "format = 3\ngarbage\n").unwrap();
    let found = run(&["stats", &file]).errors;
    let expected = "line 2 is not that of a plan: key with no value, expected `=`; move it away\n";
    assert!(found.contains(expected), "{found}");
    assert!(complaint(1, &["search", &file], "").contains("move it away"));
    std::fs::remove_file(&plan).unwrap();
    std::fs::create_dir(&plan).unwrap();
    for command in ["stats", "search"] {
        let found = run(&[command, &file]).errors;
        assert!(
            found.contains("must be a regular file, and this one is not; move it away"),
            "{found}"
        );
    }
    std::fs::remove_dir(&plan).unwrap();
    // A plan that a search wrote, and somebody edited, is replaced.
    output(&["search", &file], "");
    let text = std::fs::read_to_string(&plan).unwrap();
    std::fs::write(&plan, text + "garbage\n").unwrap();
    let found = run(&["stats", &file]).errors;
    assert!(found.contains(&format!("run `robot-symbolic search {file}` again")), "{found}");
    output(&["search", &file], "");
    assert!(!run(&["stats", &file]).errors.contains("plan"));
}

/// Every option that is a whole number can be read: the type of its parser is that of its field.
#[test]
fn whole_numbers_are_read() {
    let file = robot("planar_2r");
    for arguments in [
        &["generate", &file, "--batch=8"][..],
        &["diff", &file, &file, "--seed=2", "--states=2"],
        &["diff", &file, &file, "--terms=3"],
        &["equations", &file, "--format", "latex", "--digits=3"],
        &["base", &file, "--digits=3"],
        &["document", &file, "--columns=2"],
        &["simulate", &file, "--time", "0.01", "--max-steps", "1000"],
    ] {
        let done = run(arguments);
        assert_eq!(done.code, 0, "{arguments:?}: {}", done.errors);
    }
}

#[test]
fn a_file_that_begins_with_a_dash_has_a_tip() {
    let (folder, file) = arm("reasons_dash");
    let text = std::fs::read(&file).unwrap();
    std::fs::write(folder.join("-dash.toml"), text).unwrap();
    let command = env!("CARGO_BIN_EXE_robot-symbolic");
    let check = |name: &str| {
        let mut command = std::process::Command::new(command);
        command.args(["check", name]).current_dir(&folder).output().unwrap()
    };
    let wrong = String::from_utf8(check("-dash.toml").stderr).unwrap();
    assert!(wrong.contains("write the file as './-dash.toml'"), "{wrong}");
    assert!(check("./-dash.toml").status.success());
}

#[test]
fn a_plan_is_no_robot_file_and_is_named_as_its_robot_is() {
    let (folder, file) = arm("reasons_named");
    output(&["search", &file], "");
    let plan = file.replace(".toml", ".plan");
    let found = complaint(1, &["check", &plan], "");
    assert!(found.contains("this is a pinned plan, not a robot file"), "{found}");
    assert!(found.contains("name the robot file that the plan belongs to"), "{found}");
    std::fs::write(&plan, "mine").unwrap();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_robot-symbolic"));
    let done = command.args(["search", "arm.toml"]).current_dir(&folder).output().unwrap();
    let found = String::from_utf8(done.stderr).unwrap();
    assert!(found.starts_with("error: arm.plan is not replaced"), "{found}");
}

#[test]
fn names_do_not_control_a_terminal_on_standard_output_either() {
    let (folder, file) = arm("reasons_names");
    let turned = folder.join("RTL\u{202e}.toml");
    std::fs::copy(file, &turned).unwrap();
    let found = output(&["check", turned.to_str().unwrap()], "");
    assert!(found.contains("RTL\\u{202e}.toml: no errors"), "{found}");
}

#[test]
fn an_error_that_is_not_hidden_is_noted() {
    let (folder, file) = arm("reasons_allowed");
    let text = std::fs::read_to_string(&file).unwrap();
    let wrong = folder.join("wrong.toml");
    std::fs::write(&wrong, format!("{text}\nweight = 1\n")).unwrap();
    let found = run(&["check", wrong.to_str().unwrap(), "--allow", "R0101"]);
    assert_eq!(found.code, 1);
    let note = "note: --allow R0101 hides warnings and notes, but not errors";
    assert!(found.errors.contains(note), "{}", found.errors);
    assert!(!run(&["check", &file, "--allow", "R0101"]).errors.contains("note: --allow"));
}

#[cfg(unix)]
#[test]
fn a_plan_that_is_a_link_to_nothing_says_so() {
    let (folder, file) = arm("reasons_plan_link");
    let plan = folder.join("arm.plan");
    let _ = std::fs::remove_file(&plan);
    std::os::unix::fs::symlink("nowhere", &plan).unwrap();
    let found = complaint(1, &["generate", &file], "");
    let reason = "the pinned plan is a link to `nowhere`, which does not exist; move it away";
    assert!(found.contains(reason), "{found}");
}

/// States of more than a mebibyte that are read twice are stored in a temporary file.
#[cfg(unix)]
#[test]
fn a_folder_for_temporary_files_that_is_not_there_is_named() {
    let (folder, file) = arm("reasons_temporary");
    let states = "q1,q2,fx,fy,fz,mx,my,mz\n".to_owned() + &"0,0,0,0,0,0,0,0\n".repeat(100_000);
    std::fs::write(folder.join("states.csv"), states).unwrap();
    let states = std::fs::File::open(folder.join("states.csv")).unwrap();
    let done = std::process::Command::new(env!("CARGO_BIN_EXE_robot-symbolic"))
        .args(["eval", &file, "--function", "gravity", "--states", "-"])
        .env("TMPDIR", folder.join("missing"))
        .stdin(states)
        .output()
        .unwrap();
    let errors = String::from_utf8(done.stderr).unwrap();
    assert!(errors.contains("it cannot be stored in a temporary file in "), "{errors}");
    assert!(
        errors.contains("missing: there is no such file or folder; write it to a file"),
        "{errors}"
    );
}

#[test]
fn an_option_of_rust_in_another_language_is_an_error_of_the_command_line() {
    let (_, file) = arm("reasons_rust");
    let found = complaint(2, &["generate", &file, "--language", "c", "--generic"], "");
    assert!(found.contains("applies to Rust and not to `c`; leave it out"), "{found}");
}
