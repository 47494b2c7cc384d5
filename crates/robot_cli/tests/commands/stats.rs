//! `stats`, `search` and `show`.

use serde_json::Value;

use crate::{output, robot, run};

#[test]
fn counts_have_the_stated_keys() {
    let file = robot("trttr1");
    let shown: Value = serde_json::from_str(&output(&["stats", &file], "")).unwrap();
    let functions = shown["functions"].as_object().unwrap();
    for name in ["inverse_dynamics", "inverse_dynamics_wrench_friction", "link_wrenches"] {
        for counts in [&functions[name], &functions[name]["constructor"]] {
            for key in ["mul", "add", "div", "sqrt", "other", "sin", "cos", "temporaries"] {
                assert!(counts[key].is_u64(), "{name} {key}");
            }
        }
        assert!(functions[name]["mul"].as_u64() > Some(0));
        assert_eq!([&functions[name]["sin"], &functions[name]["cos"]], [2, 2]);
    }
    assert!(functions["inverse_dynamics_friction"]["sqrt"].as_u64() > Some(0));
}

#[test]
fn text_has_a_line_for_each_function() {
    let file = robot("planar_2r");
    let arguments = ["stats", &file, "--function", "inverse_dynamics", "--format", "text"];
    let shown = output(&arguments, "");
    let starts: Vec<&str> = shown.lines().map(|line| line.split("  ").next().unwrap()).collect();
    assert_eq!(starts[..4], ["function", "inverse_dynamics", "", ""]);
    assert!(
        starts[4].starts_with("inverse_dynamics: about 0.")
            && starts[4].contains(" kB of code: fits "),
        "{starts:?}"
    );
    assert!(shown.lines().nth(2).unwrap().starts_with("  once for inverse_dynamics "));
}

/// For code larger than the instruction cache, the time to fetch it is reported; the estimate grows with the
/// operations.
#[test]
fn code_sizes_are_told() {
    let file = robot("panda");
    let shown: Value = serde_json::from_str(&output(&["stats", &file], "")).unwrap();
    let functions = shown["functions"].as_object().unwrap();
    for (name, counts) in functions {
        let count = |key: &str| counts[key].as_u64().unwrap();
        let bytes = counts["code"]["bytes"].as_u64().unwrap();
        assert!(bytes >= 8 * (count("mul") + count("add")), "{name}");
        let fits = bytes <= 32 * 1024;
        assert_eq!(counts["code"]["fits_instruction_cache"], fits, "{name}");
        assert_eq!(counts["code"]["fetch_ns"].is_null(), fits, "{name}");
    }
    assert_eq!(functions["inverse_dynamics"]["code"]["fits_instruction_cache"], true);
    let arguments =
        ["stats", &file, "--function", "forward_dynamics_derivatives", "--format", "text"];
    let shown = output(&arguments, "");
    let line = shown.lines().last().unwrap();
    assert!(line.starts_with("forward_dynamics_derivatives: about 3"), "{line}");
    let end = "KB instruction cache; expect the time to fetch it, about ";
    assert!(line.contains(end) && line.ends_with(" ns at 3.7 GHz"), "{line}");
}

#[test]
fn a_search_does_not_make_things_worse() {
    let file = robot("scara");
    let shown = output(&["search", "--dry-run", &file], "");
    let operations = shown.strip_prefix("scara: ").and_then(|rest| rest.split(' ').next());
    let operations: u64 = operations.unwrap().parse().unwrap();
    let stats: Value = serde_json::from_str(&output(&["stats", &file], "")).unwrap();
    let counts = &stats["functions"]["inverse_dynamics"];
    assert!(operations > 0);
    assert!(operations <= counts["mul"].as_u64().unwrap() + counts["add"].as_u64().unwrap());
    assert_eq!(shown.lines().filter(|line| line.starts_with("link")).count(), 5);
}

#[test]
fn a_robot_is_shown() {
    let shown = output(&["show", &robot("trttr1")], "");
    for part in ["TRTTR1", "prismatic along (0, 1, 0)", "mass of link 5", "link_wrenches"] {
        assert!(shown.contains(part), "{part} is not in {shown}");
    }
}

#[test]
fn what_is_wrong_with_a_file_is_shown() {
    let path = crate::folder("stats-broken").join("arm.toml");
    let text = std::fs::read_to_string(robot("planar_2r")).unwrap();
    std::fs::write(&path, text.replace("gravity", "gravty")).unwrap();
    for command in ["stats", "show", "search", "generate", "equations"] {
        let outcome = run(&[command, path.to_str().unwrap()]);
        assert_eq!((outcome.code, outcome.output.as_str()), (1, ""), "{command}");
        assert!(outcome.errors.contains("did you mean `gravity`"), "{}", outcome.errors);
    }
}

#[test]
fn what_snapping_changes_is_told() {
    let text = std::fs::read_to_string(robot("scara")).unwrap();
    let near = text.replacen(
        "[[link]]",
        "[[frame]]\nname = \"near\"\nparent = \"base\"\n\
        origin = { rpy = [1.5708, 3e-10, 0] }\n\n[[link]]",
        1,
    );
    let path = crate::folder("snap").join("near.toml");
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(&path, near).unwrap();
    let path = path.to_str().unwrap();
    let shown = output(&["show", path], "");
    for part in [
        "angles within 1e-9 rad of a multiple of π/2 are taken as that multiple (--snap); 1 is changed\n",
        "the largest change is 3.0e-10 rad",
        "--snap 1e-4 would change 2 by up to 3.7e-6 rad; inverse dynamics would need the same number of operations",
    ] {
        assert!(shown.contains(part), "{part} is not in {shown}");
    }
    let stats: Value = serde_json::from_str(&output(&["stats", path], "")).unwrap();
    assert_eq!(stats["snap"]["angles"], 1);
    assert_eq!(stats["snap"]["larger"][0]["angles"], 2);
    let stats = output(&["stats", path, "--snap", "1e-4"], "");
    let stats: Value = serde_json::from_str(&stats).unwrap();
    assert_eq!(stats["snap"]["angles"], 2);
}

#[test]
fn passes_and_options_show_what_they_give() {
    let file = robot("stanford");
    let of = |flag: &str| -> Vec<(String, u64)> {
        let shown = output(&["stats", &file, "--function", "inverse_dynamics", flag], "");
        let shown: Vec<Value> = serde_json::from_str(&shown).unwrap();
        let step = |step: &Value| {
            (step["step"].as_str().unwrap().to_owned(), step["operations"].as_u64().unwrap())
        };
        shown.iter().map(step).collect()
    };
    let counts: Value = serde_json::from_str(&output(&["stats", &file], "")).unwrap();
    let counts = &counts["functions"]["inverse_dynamics"];
    let total = counts["mul"].as_u64().unwrap() + counts["add"].as_u64().unwrap();

    let passes = of("--passes");
    let (last, passes) = passes.split_last().unwrap();
    assert!(
        passes.is_sorted_by_key(|(_, operations)| std::cmp::Reverse(*operations)),
        "{passes:?}"
    );
    assert_eq!((last.0.as_str(), last.1), ("with angles", total));
    assert_eq!(passes.last().unwrap().0, "schedule");
    for pass in
        ["as built", "value numbering", "factoring", "pair reuse", "resubstitution", "signs"]
    {
        assert!(passes.iter().any(|(name, _)| name == pass), "{pass}: {passes:?}");
    }
    assert!(passes[0].1 > total);

    let options = of("--options");
    assert_eq!(options[0], ("with all".to_owned(), total));
    let without = |name: &str| options.iter().find(|(step, _)| *step == format!("without {name}"));
    for name in ["origin", "column", "residual", "unit_length", "factoring", "resubstitution"] {
        assert!(without(name).is_some(), "{name}: {options:?}");
    }
    assert!(without("any pass").unwrap().1 > total);
    assert!(without("column").unwrap().1 > total, "{options:?}");
}

/// The text has a row for each step, with the numbers of JSON.
#[test]
fn passes_are_rows_of_a_table() {
    let file = robot("planar_2r");
    let arguments = ["stats", &file, "--function", "gravity", "--passes", "--format"];
    let of = |format: &str| output(&[&arguments[..], &[format]].concat(), "");
    let steps: Vec<Value> = serde_json::from_str(&of("json")).unwrap();
    let text = of("text");
    let mut lines = text.lines();
    let title: Vec<&str> = lines.next().unwrap().split_whitespace().collect();
    assert!(
        title.starts_with(&["function", "step", "M", "+", "A", "+", "D", "neg", "mul"]),
        "{text}"
    );
    for (line, step) in lines.clone().zip(&steps) {
        let cells: Vec<&str> = line.split_whitespace().collect();
        assert!(cells[0] == "gravity" && line.contains(step["step"].as_str().unwrap()), "{line}");
        let numbers: Vec<u64> = cells.iter().filter_map(|cell| cell.parse().ok()).collect();
        let counts = &step["counts"];
        let expected = [&step["operations"], &step["neg"], &counts["mul"], &counts["add"]];
        assert_eq!(numbers[..4], expected.map(|number| number.as_u64().unwrap()), "{line}");
    }
    assert!(steps.len() > 3 && lines.count() == steps.len(), "{text}");
}
