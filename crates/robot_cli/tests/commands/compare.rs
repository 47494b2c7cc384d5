//! `compare`: `docs/trttr1.md` and `docs/comparing.md` show the output of the command, and the equations that
//! `equations` prints are right in every notation.

use serde_json::Value;

use crate::printing::rounded;
use crate::{complaint, output, robot, run};

/// The path of a file in the folder of the project.
fn project(file: &str) -> String {
    format!("{}/../../{file}", env!("CARGO_MANIFEST_DIR"))
}

fn text(file: &str) -> String {
    std::fs::read_to_string(project(file)).unwrap()
}

/// The output of the command for the equations of the paper, with one part of them replaced.
fn paper(from: &str, to: &str, format: &str) -> String {
    let printed = text("docs/trttr1.printed");
    assert!(printed.contains(from));
    let path = crate::folder(&format!("compare-paper-{format}-{}", to.len())).join("printed");
    std::fs::write(&path, printed.replacen(from, to, 1)).unwrap();
    let path = path.to_str().unwrap();
    let outcome = run(&["compare", &robot("trttr1"), path, "--format", format]);
    assert_eq!((outcome.code, outcome.errors.as_str()), (1, ""));
    outcome.output
}

#[test]
fn the_paper_differs_in_the_terms_that_the_document_lists() {
    let shown = paper("", "", "markdown");
    let document = text("docs/trttr1.md");
    // The page adds a row with the grade to each pair of terms.
    let is_printed = |line: &&str| !line.starts_with("| grade |");
    let lines: Vec<&str> = document.split_inclusive('\n').filter(is_printed).collect();
    assert!(lines.concat().contains(&shown), "docs/trttr1.md does not hold\n{shown}");
    let claim = "34 terms differ from the derivation in the text that we have";
    assert!(document.contains(claim), "docs/trttr1.md does not say: {claim}");
    assert!(shown.ends_with(
        "85 equations (5 only name other quantities), 839 terms: 34 terms differ (1 missing term, 1 sign, \
         20 dots, 9 indices, 1 power, 2 factors)\n"
    ));
    let found: Value = serde_json::from_str(&paper("", "", "json")).unwrap();
    let differences = found["differences"].as_array().unwrap();
    assert_eq!((differences.len(), &found["terms"]), (34, &Value::from(839)));
    for difference in differences {
        assert!(!difference["evidence"].as_array().unwrap().is_empty(), "{difference}");
        assert!(!difference["mistakes"].as_array().unwrap().is_empty(), "{difference}");
    }
    // A changed sign is found.
    let changed = paper("+ M5*qdd3 + cos(q5)*Fz6", "- M5*qdd3 + cos(q5)*Fz6", "text");
    assert!(changed.contains(": 35 terms differ (1 missing term, 2 sign"), "{changed}");
}

#[test]
fn the_example_of_the_docs_is_what_the_command_prints() {
    let document = text("docs/comparing.md");
    let block = |mark: &str| {
        let (_, rest) = document.split_once(mark).unwrap();
        rest.split_once("```").unwrap().0.to_owned()
    };
    let path = crate::folder("compare-docs").join("paper.tex");
    std::fs::write(&path, block("```latex\n")).unwrap();
    let outcome = run(&["compare", &robot("planar_2r"), path.to_str().unwrap()]);
    assert_eq!((outcome.code, outcome.errors.as_str()), (1, ""));
    assert_eq!(outcome.output, block("```text\n"));
}

#[test]
fn what_equations_prints_does_not_differ() {
    let folder = crate::folder("compare-own");
    for name in ["planar_2r", "scara", "trttr1"] {
        let notations = [
            &["--format", "text"][..],
            &["--format", "latex", "--trig", "named"],
            &["--format", "latex", "--trig", "short"],
            &["--format", "latex", "--trig", "paper"],
        ];
        for notation in notations {
            let file = robot(name);
            let arguments = [&["equations", &file, "--quantity", "all"], notation].concat();
            let path = folder.join("equations");
            std::fs::write(&path, output(&arguments, "")).unwrap();
            let shown = output(&["compare", &file, path.to_str().unwrap()], "");
            assert!(shown.contains(": no differences\n"), "{name} {notation:?}: {shown}");
        }
    }
}

#[test]
fn a_tex_file_is_latex_even_without_a_command() {
    let path = crate::folder("compare-tex").join("paper.tex");
    std::fs::write(&path, "Q_2 = m_2 g r_2 c_2\n").unwrap();
    let file = robot("planar_2r");
    let arguments = ["compare", &file, path.to_str().unwrap()];
    let outcome = run(&arguments);
    assert_eq!(outcome.code, 1, "{}", outcome.errors);
    assert!(outcome.output.contains("printed  g*r2*m2*cos(q2)\n"), "{}", outcome.output);
    let complaint = complaint(2, &[&arguments[..], &["--notation", "text"]].concat(), "");
    assert!(complaint.contains("write a product as `m_2*g`"), "{complaint}");
    let complaint = crate::complaint(2, &["compare", &file, "paper.typ"], "");
    assert!(complaint.contains("Typst is not read"), "{complaint}");
}

/// The summary of the comparison of a robot's own equations, printed with the given options.
fn of_own(file: &str, options: &[&str]) -> String {
    let path = crate::folder(&format!("compare-{}", options.concat())).join("equations");
    std::fs::write(&path, output(&[&["equations", file], options].concat(), "")).unwrap();
    output(&["compare", file, path.to_str().unwrap()], "").lines().last().unwrap().to_owned()
}

/// Published equations are compared with what `equations` prints for the same tolerance.
#[test]
fn rounded_right_angles_are_compared_as_they_are_printed() {
    let file = rounded("rounded_compared");
    let path = format!("{file}.txt");
    for (format, printed, compared, code) in [
        ("text", &[][..], &[][..], 0),
        ("latex", &[], &[], 0),
        ("text", &["--snap", "0"], &["--snap", "0"], 0),
        ("text", &["--snap", "0"], &[], 1),
    ] {
        let arguments = ["equations", &file, "--form", "expanded", "--format", format];
        std::fs::write(&path, run(&[&arguments, printed].concat()).output).unwrap();
        let shown = run(&[&["compare", &file, &path], compared].concat());
        assert_eq!(shown.code, code, "{format} {printed:?} {compared:?}: {}", shown.output);
        assert_eq!(shown.output.contains(": no differences"), code == 0, "{}", shown.output);
    }
}

#[test]
fn a_long_equation_goes_on_in_the_next_environment() {
    let expected = "6 equations, 451 terms: no differences; \
        4 coefficients agree only to the digits printed";
    for format in ["text", "latex"] {
        let shown = of_own(&robot("stanford"), &["--form", "expanded", "--format", format]);
        assert_eq!(shown, expected, "{format}");
    }
}

/// Constants such as sin(0.7) are printed as decimals, and so are roots in denominators that the derivation squares.
#[test]
fn constants_of_oblique_frames_are_read() {
    let text = |parameter: &str, joint: &str| {
        format!(
            "format = 1\n[robot]\nname = \"arm\"\n[parameters]\n{parameter} = 0.5\n[[link]]\nname = \"a\"\n{joint}\n\
             mass = 1\ncenter_of_mass = [1, 0, 0]\ninertia = {{ xx = 1, yy = 1, zz = 1 }}\n"
        )
    };
    let turned = text(
        "m",
        "joint = { type = \"revolute\", axis = \"z\" }\norigin = { rpy = [0.3, 0.7, 0] }",
    )
    .replace("mass = 1", "mass = \"m\"");
    let oblique = text("p", "joint = { type = \"revolute\", axis = [1, 0, \"p\"] }");
    // The denominator is p² + 1.25.
    let with_decimal = text("p", "joint = { type = \"revolute\", axis = [1, 0.5, \"p\"] }")
        .replace("= [1, 0, 0]", "= [1, 0.3333333333333, 0.7]");
    let path = crate::folder("compare-oblique").join("arm.toml");
    let file = path.to_str().unwrap();
    for (robot, options) in [
        (&turned, &[][..]),
        (&turned, &["--digits", "17"]),
        (&turned, &["--form", "collected", "--digits", "17"]),
        (&oblique, &[]),
        (&oblique, &["--form", "collected"]),
        (&with_decimal, &[]),
    ] {
        std::fs::write(&path, robot).unwrap();
        let shown = of_own(file, options);
        assert!(shown.contains(": no differences"), "{options:?} {shown}");
    }
}

#[test]
fn letters_of_the_field_are_read() {
    for format in ["text", "latex"] {
        let shown = of_own(&robot("planar_2r"), &["--letters", "field", "--format", format]);
        assert_eq!(shown, "2 equations, 29 terms: no differences", "{format}");
    }
}

#[test]
fn a_heading_of_the_recursive_form_says_what_to_do() {
    let path = crate::folder("compare-heading").join("equations");
    let file = robot("planar_2r");
    std::fs::write(&path, output(&["equations", &file, "--form", "recursive"], "")).unwrap();
    let shown = complaint(2, &["compare", &file, path.to_str().unwrap()], "");
    assert!(shown.contains("begin a heading with `#`; of the forms that"), "{shown}");
}

#[test]
fn what_is_wrong_has_its_code_and_place() {
    let path = crate::folder("compare-wrong").join("printed");
    std::fs::write(&path, "Q1 = m1*g +\nQ9 = 0\n").unwrap();
    let (file, path) = (robot("planar_2r"), path.to_str().unwrap());
    assert!(complaint(2, &["compare", &file, path], "").contains("printed:1:"));
    std::fs::write(path, [0xff, 0xfe, 0x00]).unwrap();
    assert!(complaint(2, &["compare", &file, path], "").contains("UTF-8"));
    assert!(complaint(2, &["compare", &file, "none.tex"], "").contains("no such file"));
    assert!(complaint(2, &["compare", path, path], "").contains("error"));
    assert!(complaint(2, &["compare", &file], "").contains("Usage"));
}

/// The row that the page adds to a difference: its grade and the reason.
fn grade(row: &str) -> [&str; 3] {
    let parts = || {
        let (grade, rest) = row.strip_prefix("| grade | ")?.strip_suffix(" |")?.split_once(": ")?;
        let (extent, relation) =
            rest.strip_prefix("differs by ")?.split_once("; contradicted by ")?;
        Some([grade, extent, relation])
    };
    parts().unwrap_or_else(|| panic!("{row}"))
}

#[test]
fn every_difference_of_the_paper_has_one_grade_and_the_grade_its_reason() {
    let found: Value = serde_json::from_str(&paper("", "", "json")).unwrap();
    let differences = found["differences"].as_array().unwrap();
    let document = text("docs/trttr1.md");
    let lines: Vec<&str> = document.lines().collect();
    let rows: Vec<[&str; 3]> =
        lines.iter().filter(|line| line.starts_with("| grade |")).map(|line| grade(line)).collect();
    assert_eq!(rows.len(), differences.len());
    // Each is below its pair of terms.
    for place in (0..lines.len()).filter(|place| lines[*place].starts_with("| grade |")) {
        let above = &lines[place - 3..place];
        assert!(above[0].starts_with("| printed | ") && above[1].starts_with("| derived | "));
    }
    let (mut by_dimension, mut one_glyph) = (0, 0);
    for (row, difference) in rows.iter().zip(differences) {
        let [grade, extent, relation] = *row;
        let text = |value: &Value| value.as_str().unwrap().to_owned();
        let evidence = difference["evidence"].as_array().unwrap();
        let wrong = evidence.iter().any(|one| text(one).starts_with("has units "));
        let mistakes = difference["mistakes"].as_array().unwrap();
        let [mistake] = &mistakes[..] else { panic!("{mistakes:?}") };
        let (of, glyph) = match text(&mistake["kind"]).as_str() {
            "dot" => ("a dot", true),
            "index" => ("an index", true),
            "power" => ("an exponent", true),
            "sign" => ("a sign", true),
            "factor" => ("two indices", false),
            "missing term" => ("a term", false),
            other => panic!("{other}"),
        };
        assert_eq!(extent, of, "{row:?}");
        let expected = match (wrong || relation.starts_with('('), glyph) {
            (true, true) => "a, b",
            (true, false) => "a",
            (false, true) => "b",
            (false, false) => "c",
        };
        assert_eq!(grade, expected, "{row:?}");
        by_dimension += usize::from(wrong);
        one_glyph += usize::from(glyph);
    }
    assert!(rows.iter().all(|[grade, ..]| grade.starts_with('a')));
    let summary = format!(
        "All {} are *a*: {by_dimension} by their dimension, the other {} by a relation alone. \
         None is *c*. {one_glyph} are *b* as well",
        rows.len(),
        rows.len() - by_dimension
    );
    assert!(document.contains(&summary), "{summary}");
}

#[test]
fn a_term_without_a_value_is_a_wrong_input() {
    let path = crate::folder("compare-value").join("printed");
    let path = path.to_str().unwrap();
    for term in ["1/0", "m2/(q1 - q1)"] {
        std::fs::write(path, format!("Q1 = m1*g\n  + {term}*qdd1\n")).unwrap();
        let shown = complaint(2, &["compare", &robot("planar_2r"), path], "");
        assert!(shown.contains("the term does not have a finite value"), "{shown}");
        assert!(shown.contains("printed:2:"), "{shown}");
    }
}

/// Symbols of a textbook that are not the robot's, inside a cosine as well, are named once with those of the robot.
#[test]
fn symbols_that_the_robot_lacks_are_named() {
    let path = crate::folder("compare-symbols").join("printed");
    std::fs::write(&path, "\\[ \\tau_2 = I_2 \\ddot q_1 + g m_2 r_2 \\cos(\\theta_2) \\]").unwrap();
    let shown = run(&["compare", &robot("planar_2r"), path.to_str().unwrap()]).output;
    assert!(shown.contains("the robot does not have the symbol theta2"), "{shown}");
    assert!(shown.ends_with("and parameters have the names of the robot file\n"), "{shown}");
    assert_eq!(shown.matches("note: not symbols of the robot: theta2; joint positions").count(), 1);
}

/// Friction is not compared, as the messages about its terms say, whether its parameters have names or not.
#[test]
fn terms_of_friction_are_named() {
    let folder = crate::folder("compare-friction");
    let (file, document) = (folder.join("arm.toml"), folder.join("arm.txt"));
    let arm = "format = 1\n[robot]\nname = \"arm\"\n[parameters]\nb_y = 0.2\n[[link]]\nname = \"1\"\n\
               joint = { type = \"revolute\", axis = \"z\" }\nmass = 1\ncenter_of_mass = [0.1, 0, 0]\n\
               inertia = { xx = 1, yy = 1, zz = 1 }\nfriction = { viscous = \"b_y\", coulomb_torque = 0.3 }\n";
    std::fs::write(&file, arm).unwrap();
    let file = file.to_str().unwrap();
    let printed = output(&["equations", file, "--form", "expanded", "--friction"], "");
    std::fs::write(&document, &printed).unwrap();
    let found = run(&["compare", file, document.to_str().unwrap()]);
    assert_eq!(found.code, 1, "{}", found.errors);
    let said = found.output.matches("friction is not compared: leave its terms out").count();
    assert_eq!(
        (said, found.output.matches("nearest").count()),
        (2, 0),
        "{printed}{}",
        found.output
    ); // Beside a derived term that is missing, too.
    std::fs::write(&document, "Q1 = 0.3*sign(qd1) + b_y*qd1\n").unwrap();
    let found = run(&["compare", file, document.to_str().unwrap()]).output;
    assert_eq!(found.matches("friction is not compared").count(), 2, "{found}");
}
