//! Names of functions, which are the same in all commands.

use robot_build::FunctionKind;
use serde_json::Value;

use crate::{complaint, folder, output, robot, run, run_with};

/// A planar arm with frames whose names are not identifiers.
fn arm(test: &str) -> String {
    let text = std::fs::read_to_string(robot("planar_2r")).unwrap();
    let frame = |name: &str| format!("\n[[frame]]\nname = \"{name}\"\nparent = \"1\"\n");
    let frames: Vec<String> = ["EndEffector_Link", "Cam", "cam-1", "cam.1"].map(frame).into();
    let path = folder(test).join("arm.toml");
    std::fs::write(&path, format!("{text}{}", frames.concat())).unwrap();
    path.to_str().unwrap().to_owned()
}

/// An arm without any frame.
fn bare(test: &str) -> String {
    let text = std::fs::read_to_string(robot("planar_3r")).unwrap();
    let path = folder(test).join("bare.toml");
    std::fs::write(&path, text.split("[tip]").next().unwrap()).unwrap();
    path.to_str().unwrap().to_owned()
}

fn eval(file: &str, function: &str, states: &str) -> Value {
    let arguments = ["eval", file, "--function", function, "--states", "-"];
    let outcome = run_with(&arguments, states.as_bytes());
    assert_eq!(outcome.code, 0, "{function}: {}", outcome.errors);
    serde_json::from_str(&outcome.output).unwrap()
}

const STATE: &str = r#"[{"q": [0.3, 0.5], "qd": [1, 2]}]"#;

#[test]
fn frames_are_named_as_in_the_file_or_as_in_the_function() {
    let file = arm("functions-frames");
    for kind in ["jacobian", "jacobian_dot_qd"] {
        let of = |frame: &str| eval(&file, &format!("{kind}_{frame}"), STATE);
        assert_eq!(of("EndEffector_Link"), of("endeffector_link"));
        assert_eq!(of("Cam"), of("cam"));
        assert_eq!(of("cam-1"), of("cam_1_4"));
        assert_eq!(of("cam.1"), of("cam_1_5"));
        // Two frames have the same name as an identifier.
        let name = format!("{kind}_cam_1");
        let arguments = ["eval", &file, "--function", &name, "--states", "-"];
        let shown = complaint(2, &arguments, STATE);
        assert!(shown.contains(&format!("`{name}_4`, `{name}_5`")), "{shown}");
    }
}

#[test]
fn every_name_that_a_message_has_can_be_asked_for() {
    let file = arm("functions-messages");
    let arguments = ["eval", &file, "--function", "jacobian", "--states", "-"];
    let shown = complaint(2, &arguments, STATE);
    let names: Vec<&str> = shown.split('`').skip(3).step_by(2).collect();
    assert_eq!(names.len(), 5, "{shown}");
    for name in names {
        eval(&file, name, STATE);
    }
    let shown = output(&["stats", &file], "");
    let shown: Value = serde_json::from_str(&shown).unwrap();
    let jacobians = shown["functions"].as_object().unwrap().keys();
    let jacobians: Vec<&String> = jacobians.filter(|name| name.starts_with("jacobian")).collect();
    assert_eq!(jacobians.len(), 10);
    for name in jacobians {
        eval(&file, name, STATE);
    }
}

#[test]
fn one_frame_or_link_is_asked_for_alone_everywhere() {
    let file = arm("functions-alone");
    let functions = |arguments: &[&str]| -> Vec<String> {
        let outcome = run(arguments);
        assert_eq!(outcome.code, 0, "{}", outcome.errors);
        let lines = outcome.output.lines().filter_map(|line| line.trim().strip_prefix("pub fn "));
        let names = lines.map(|line| line.split('(').next().unwrap().to_owned());
        names.filter(|name| name.starts_with("jacobian") && !name.ends_with("_sc")).collect()
    };
    let generated = functions(&["generate", &file, "--function", "jacobian_Cam,jacobian_2"]);
    assert_eq!(generated, ["jacobian_cam", "jacobian_2"]);
    // If all frames and one of them are chosen, each function occurs once.
    let generated = functions(&["generate", &file, "--function", "jacobian_Cam,jacobian"]);
    assert_eq!(generated.len(), 5);
    let bundle = "both=jacobian_cam-1,jacobian_dot_qd_1";
    let outcome = run(&["generate", &file, "--bundle", bundle]);
    assert!(outcome.output.contains("pub jacobian_cam_1_4:"), "{}", outcome.output);
    let shown = output(&["stats", &file, "--function", "jacobian_dot_qd_2"], "");
    assert!(shown.contains("\"jacobian_dot_qd_2\""), "{shown}");

    // In the robot file.
    let text = std::fs::read_to_string(&file).unwrap();
    let code = "\n[code]\nfunctions = [\"jacobian_EndEffector_Link\", \"jacobian_1\"]\n\
                bundles = { both = [\"jacobian_cam\", \"bias\"] }\n\
                [[budget]]\nfunction = \"jacobian_Cam\"\nmax_operations = 100\n";
    std::fs::write(&file, format!("{text}{code}")).unwrap();
    assert_eq!(functions(&["generate", &file]), ["jacobian_endeffector_link", "jacobian_1"]);
    std::fs::write(&file, format!("{text}{}", code.replace("jacobian_1", "jacobian_9"))).unwrap();
    let shown = run(&["check", &file]).errors;
    assert!(
        shown.contains("error[R0802]: `jacobian_9` is not a function of this robot"),
        "{shown}"
    );
}

#[test]
fn a_robot_without_frames_has_the_jacobian_of_its_last_link() {
    let file = bare("functions-bare");
    let states = r#"[{"q": [0.3, 0.5, -0.2], "qd": [1, 2, 3]}]"#;
    for kind in ["jacobian", "jacobian_dot_qd"] {
        assert_eq!(eval(&file, kind, states), eval(&file, &format!("{kind}_3"), states));
    }
}

#[test]
fn help_and_completions_list_the_functions() {
    for command in ["eval", "generate", "stats", "crate", "prove"] {
        let shown = run(&[command, "--help"]).output;
        for name in ["inverse_dynamics_derivatives", "jacobian_dot_qd", "regressor_base"] {
            assert!(shown.contains(name), "{command} --help lacks {name}");
        }
    }
    for shell in ["bash", "zsh", "fish"] {
        let shown = output(&["completions", shell], "");
        assert!(shown.contains("forward_dynamics_derivatives"), "{shell}");
    }
}

const HEAD: &str = "| function | arguments | result |\n|---|---|---|\n";

/// The table of functions, from their declarations.
fn table() -> String {
    let row = |kind: &FunctionKind| {
        let mut inputs: Vec<&str> = kind.inputs().iter().map(|input| input.name()).collect();
        if kind.effects().wrench || *kind == FunctionKind::LinkWrenches {
            inputs.push("wrenches of the tips");
        }
        let inputs = if inputs.is_empty() { "none".to_owned() } else { inputs.join(", ") };
        format!("| `{}` | {inputs} | {} |\n", kind.name(), kind.result())
    };
    HEAD.to_owned() + &FunctionKind::ALL.iter().map(row).collect::<String>()
}

/// `UPDATE_SNAPSHOTS=1` writes the tables anew.
#[test]
fn the_tables_of_functions_are_the_declared_ones() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    for name in ["docs/generated-code.md", "README.md"] {
        let page = std::fs::read_to_string(root.join(name)).unwrap();
        let start = page.find(HEAD).unwrap();
        let length = page[start..].find("\n\n").unwrap() + 1;
        let now = format!("{}{}{}", &page[..start], table(), &page[start + length..]);
        if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
            std::fs::write(root.join(name), &now).unwrap();
        } else {
            assert!(
                page == now,
                "{name} shows another table of functions: UPDATE_SNAPSHOTS=1 writes it"
            );
        }
    }
}

/// In code, each function of a frame has the same name whichever other functions are generated, also for names that are
/// alike as identifiers or long.
#[test]
fn the_name_of_a_function_does_not_depend_on_others() {
    let text = std::fs::read_to_string(robot("planar_2r")).unwrap();
    let frame = |name: &str| format!("\n[[frame]]\nname = \"{name}\"\nparent = \"1\"\n");
    let long = ["x", "y"].map(|end| format!("{}{end}", "a_long_name_".repeat(5)));
    let names = ["a", "a_", "_a", "b__c", "b_c", "__", &long[0], &long[1]];
    let path = folder("functions-alike").join("arm.toml");
    std::fs::write(&path, format!("{text}{}", names.map(frame).concat())).unwrap();
    let file = path.to_str().unwrap();
    let generated = |language: &str, function: &str| {
        let shown = output(&["generate", file, "--function", function, "--language", language], "");
        move |name: &str| shown.contains(&format!("{name}("))
    };
    let known = output(&["stats", file, "--function", "jacobian,jacobian_1"], "");
    let known: Value = serde_json::from_str(&known).unwrap();
    let known: Vec<&String> = known["functions"].as_object().unwrap().keys().collect();
    // The tip and the first link have one, too.
    assert_eq!(known.len(), names.len() + 2);
    for language in ["rust", "c", "python"] {
        let all = generated(language, "jacobian,jacobian_1");
        for function in &known {
            assert!(function.len() <= 63 && all(function), "{language}: {function}");
            assert!(generated(language, function)(function), "{language}: {function}");
        }
    }
}
