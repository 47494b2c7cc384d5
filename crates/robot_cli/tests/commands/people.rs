//! The output for people who type commands: help and results on a terminal, tips, first files.

use robot_cli::Screen;

use crate::shell::Shell;
use crate::{Outcome, complaint, folder, output, robot, run, run_on};

/// A terminal with this number of columns and without colors.
fn terminal(columns: usize) -> Option<Screen> {
    Some(Screen { columns: Some(columns), colors: false })
}

const COLORED: Option<Screen> = Some(Screen { columns: Some(100), colors: true });

#[test]
fn help_is_as_wide_as_the_terminal() {
    let help = |columns| run_on(terminal(columns), &["diff", "--help"]).output;
    let widest = |text: &str| text.lines().map(|line| line.chars().count()).max().unwrap();
    assert!(widest(&help(60)) <= 60 && widest(&help(80)) <= 80);
    assert!(help(60).lines().count() > help(100).lines().count());
    assert_eq!(help(200), output(&["diff", "--help"], ""));
    let shown = output(&["diff", "--help"], "");
    assert!(shown.find("Options:\n").unwrap() < shown.find("Model options:\n").unwrap(), "{shown}");
    assert!(shown.find("--allow-massless").unwrap() > shown.find("Model options:\n").unwrap());
    let colored = run_on(COLORED, &["diff", "--help"]).output;
    assert!(colored.contains("\x1b[1m") && !shown.contains('\x1b'), "{colored:?}");
    assert!(output(&["simulate", "--help"], "").contains("[default: 1e-9]"));
}

#[test]
fn tips_name_the_option_of_a_value_and_no_others() {
    let found = complaint(2, &["equations", &robot("planar_2r"), "--latex"], "");
    assert!(found.contains("did you mean '--format latex'?"), "{found}");
    assert!(!found.contains("as a value") && !found.contains("-- --latex"), "{found}");
    let found = complaint(2, &["equations", &robot("planar_2r"), "--formt", "latex"], "");
    assert!(found.contains("a similar argument exists: '--format'"), "{found}");
}

#[test]
fn misspelled_files_are_suggested() {
    let file = robot("planar_2r");
    let found = complaint(1, &["show", &file.replace("planar", "planr")], "");
    assert!(
        found.ends_with("there is no such file; did you mean ")
            || found.contains("planar_2r.toml?"),
        "{found}"
    );
    assert!(!found.contains("looked for"), "{found}");
    let found = complaint(1, &["show", &file.replace(".toml", ".urdf")], "");
    assert!(found.contains("planar_2r.toml?"), "{found}");
    let found = complaint(1, &["show", "nowhere/arm.toml"], "");
    assert!(found.contains("there is no folder nowhere"), "{found}");
}

#[test]
fn operations_are_a_table_on_a_terminal() {
    let arguments = ["stats", &robot("planar_2r"), "--function", "mass_matrix"];
    let shown = run_on(terminal(80), &arguments).output;
    assert!(shown.starts_with("function") && shown.contains("\nmass_matrix "), "{shown}");
    assert!(output(&arguments, "").starts_with('{'));
    let json = run_on(terminal(80), &[&arguments[..], &["--format", "json"]].concat()).output;
    assert_eq!(json, output(&arguments, ""));
}

#[test]
fn differences_have_colors_on_a_terminal_that_shows_them() {
    let (a, b) = (robot("planar_2r"), robot("scara"));
    let arguments = ["diff", &a, &b, "--states", "1"];
    let plain = run(&arguments).output;
    let colored = run_on(COLORED, &arguments).output;
    assert!(
        colored.contains("\x1b[31m- link ") && colored.contains("\x1b[32m+ link "),
        "{colored}"
    );
    assert_eq!(run_on(terminal(80), &arguments).output, plain);
    assert!(!plain.contains('\x1b'));
    let printed = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/trttr1.printed");
    let colored = run_on(COLORED, &["compare", &robot("trttr1"), printed]).output;
    assert!(colored.contains("\x1b[31m    printed") && colored.contains("\x1b[32m    derived"));
}

#[test]
fn masses_and_limits_are_shown() {
    let shown = output(&["show", &robot("puma560")], "");
    for part in [
        "link2  17.4  0.068  0.006   0.2275     0.13    0.524   0.539\n",
        "-2.79 to 2.79 rad",
        "moments of inertia about the center of",
        "not available: inverse_dynamics_friction,",
        "    no joint has friction; add",
    ] {
        assert!(shown.contains(part), "{part} is not in {shown}");
    }
    assert!(!shown.contains(" yes"), "{shown}");
    for pose in [
        "frame  from   pose\nlink1  base   the same\nlink2  link1  rotated about x by pi/2\n",
        "link4  link3  to (0.0203, 0, 0.15005), rotated about x by -pi/2\n",
        "\ntool0  link6  the same\n",
    ] {
        assert!(shown.contains(pose), "{pose} is not in {shown}");
    }
    for name in ["puma560", "panda"] {
        let shown = output(&["show", &robot(name)], "");
        let wide = shown.lines().find(|line| line.chars().count() > 100);
        assert_eq!(wide, None, "{name}");
    }
    // A file without inertias has no columns of zeros.
    let planar = output(&["show", &robot("planar_2r")], "");
    assert!(planar.contains("\nlink  mass    x    zz\n"), "{planar}");
}

#[test]
fn a_scheme_is_an_svg_or_a_pdf_file() {
    let folder = folder("scheme");
    let (svg, pdf) = (folder.join("arm.svg"), folder.join("arm.pdf"));
    let (svg, pdf) = (svg.to_str().unwrap(), pdf.to_str().unwrap());
    let outcome = run(&["scheme", &robot("trttr1"), "-o", svg]);
    assert_eq!((outcome.code, outcome.output.as_str()), (0, ""), "{}", outcome.errors);
    assert!(
        outcome.errors.starts_with(&format!("wrote {svg} (")) && outcome.errors.ends_with(" kB)\n")
    );
    // The picture in the file is that on standard output; its first line has a seal.
    let (written, printed) =
        (std::fs::read_to_string(svg).unwrap(), output(&["scheme", &robot("trttr1")], ""));
    assert!(written.starts_with("<!-- @generated by robot-symbolic; the next run"), "{written}");
    assert_eq!(written.split_once('\n').unwrap().1, printed.split_once('\n').unwrap().1);
    assert_eq!(run(&["scheme", &robot("trttr1"), "-o", pdf]).code, 0);
    let written = std::fs::read_to_string(pdf).unwrap();
    assert!(written.starts_with("%PDF-1.7") && written.contains("@generated by robot-symbolic"));
    // A file of this program is written again.
    assert_eq!(run(&["scheme", &robot("planar_2r"), "-o", pdf]).code, 0);
    assert_ne!(std::fs::read_to_string(pdf).unwrap(), written);
    let png = folder.join("scheme.png");
    let found = complaint(2, &["scheme", &robot("trttr1"), "-o", png.to_str().unwrap()], "");
    assert!(found.contains("SVG or PDF"), "{found}");
    let done = run(&["scheme", &robot("planar_2r"), "--base-frames", "denavit_hartenberg"]);
    assert!(done.errors.contains("--base-frames has no effect here"), "{}", done.errors);
}

#[test]
fn a_first_robot_is_written_and_kept() {
    let shell = Shell::new();
    let done = shell.run("robot-symbolic init two_link");
    assert_eq!(done.code, Some(0), "{}", done.errors);
    assert!(done.errors.starts_with("wrote two_link.toml ("), "{}", done.errors);
    assert!(done.output.contains("robot-symbolic report two_link.toml --open"), "{}", done.output);
    let checked = shell.run("robot-symbolic check two_link.toml --deny warnings");
    assert_eq!((checked.code, checked.errors.as_str()), (Some(0), ""));
    let text = shell.run("cat two_link.toml").output;
    assert!(text.starts_with("#:schema ") && text.contains("name = \"two_link\""), "{text}");
    let untouched = shell.run("robot-symbolic init two_link");
    let message = "two_link.toml already exists as init writes it; it is not written again\n";
    assert_eq!((untouched.code, untouched.errors.as_str()), (Some(0), message));
    let again = shell.run("echo '# mine' >> two_link.toml; robot-symbolic init two_link.toml");
    assert_eq!(again.code, Some(1));
    assert!(again.errors.contains("two_link.toml is not replaced"), "{}", again.errors);
    assert!(shell.run("cat two_link.toml").output.ends_with("# mine\n"));
    assert_eq!(shell.run("robot-symbolic init ../arm").code, Some(2));
}

/// The other commands read every file that `init` writes.
#[test]
fn a_first_robot_has_a_name_that_robots_can_have() {
    let shell = Shell::new();
    for (name, reason) in [
        ("two-link", "only letters, digits and _"),
        (
            "q1",
            "a joint's position, velocity, acceleration or torque; choose another name, such as `q1_a`",
        ),
        ("tanh", "a symbol of the equations"),
        (&*"x".repeat(65), "65 bytes long; at most 64"),
    ] {
        let refused = shell.run(&format!("robot-symbolic init {name}"));
        assert_eq!(refused.code, Some(2), "{name}");
        assert!(refused.errors.contains(reason), "{name}: {}", refused.errors);
        assert_ne!(shell.run(&format!("ls {name}.toml")).code, Some(0), "{name}");
    }
    for name in ["match", "base", "x_1", "Foo"] {
        let both = format!("robot-symbolic init {name} && robot-symbolic check {name}.toml");
        assert_eq!(shell.run(&both).code, Some(0), "{name}");
    }
}

#[cfg(unix)]
#[test]
fn pages_are_opened_with_the_program_of_the_system() {
    let shell = Shell::new();
    shell.write("bin/xdg-open", "#!/bin/sh\necho \"$1\" > opened\n");
    let command = "robot-symbolic report robots/planar_2r.toml --without-compiler --open";
    let done = shell
        .run(&format!("chmod +x bin/xdg-open; PATH=$PWD/bin:$PATH {command}; sleep 1; cat opened"));
    assert_eq!(done.code, Some(0), "{}", done.errors);
    assert!(done.errors.contains("wrote planar_2r.html ("), "{}", done.errors);
    assert!(done.output.trim().ends_with("planar_2r.html"), "{}", done.output);
    let none = shell.run(&format!("PATH=$(dirname $(command -v robot-symbolic)) {command}"));
    assert_eq!(none.code, Some(1), "{}", none.errors);
    assert!(none.errors.contains("could not be shown; open planar_2r.html"), "{}", none.errors);
}

#[test]
fn a_terminal_is_not_flooded_with_pages() {
    let arguments = ["report", &robot("planar_2r"), "--without-compiler"];
    let Outcome { code, output, errors } = run_on(terminal(80), &arguments);
    assert_eq!((code, output.as_str()), (2, ""));
    assert!(errors.contains("--open") && errors.contains("-o planar_2r.html"), "{errors}");
    let asked = run_on(terminal(80), &[&arguments[..], &["-o", "-"]].concat());
    assert!(asked.output.starts_with("<!DOCTYPE html>"));
}

#[test]
fn options_without_effect_are_refused() {
    let file = robot("planar_2r");
    for arguments in [
        &["generate", &file, "--force"][..],
        &["simulate", &file, "--force"],
        &["torques", &file, "--expressions", "q1=t;q2=t", "--time", "1", "--force"],
        &["document", &file, "-o", "-", "--force"],
        &["search", &file, "--dry-run", "--force"],
        &["watch", &file, "--force", "--saves", "0"],
        &["man", "--force"],
        &["crate", &file, "-o", "arm", "--check", "--force"],
        &["diff", &file, &file, "--terms", "3", "--format", "json"],
    ] {
        assert!(complaint(2, arguments, "").contains("has no effect"), "{arguments:?}");
    }
}

#[test]
fn known_words_are_completed() {
    for shell in ["bash", "zsh", "fish"] {
        let script = output(&["completions", shell], "");
        for word in ["M_c", "R0603", "mass_matrix"] {
            assert!(script.contains(word), "{shell} does not complete {word}");
        }
    }
    // Help does not list the codes.
    assert!(!output(&["check", "--help"], "").contains("R0611"));
}

/// A leg of three joints, whose limits have additional attributes of a vendor.
fn leg() -> String {
    let mut text = "<robot name=\"leg\">\n<link name=\"base\"/>\n".to_owned();
    for (index, parent) in ["base", "l0", "l1"].iter().enumerate() {
        text += &format!(
            "<link name=\"l{index}\"><inertial><origin xyz=\"0.1 0 0\"/><mass value=\"{0}\"/>\
             <inertia ixx=\"0.0{0}\" iyy=\"0.0{0}\" izz=\"0.0{0}\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n\
             <joint name=\"j{index}\" type=\"revolute\"><parent link=\"{parent}\"/><child link=\"l{index}\"/>\
             <axis xyz=\"0 1 0\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\" current=\"3\" \
             gear=\"4\"/></joint>\n",
            index + 1
        );
    }
    text + "</robot>\n"
}

#[test]
fn warnings_of_a_kind_are_one_and_in_json_each() {
    let path = folder("grouped").join("leg.urdf");
    std::fs::write(&path, leg()).unwrap();
    let path = path.to_str().unwrap();
    let shown = run(&["show", path]).errors;
    assert_eq!(shown.matches("warning[R0603]").count(), 1, "{shown}");
    assert!(shown.contains("(6 times like this)"), "{shown}");
    assert!(shown.contains("= note: also `gear`; on lines 4, 6, 8\n"), "{shown}");
    let json = run(&["check", path, "--format", "json"]).output;
    assert_eq!(json.matches("\"R0603\"").count(), 6, "{json}");
}

#[test]
fn a_terminal_is_not_flooded_with_a_font() {
    let file = robot("planar_2r");
    for command in ["equations", "base"] {
        let arguments = [command, &file, "--format", "mathml"];
        let shown = run_on(terminal(100), &arguments);
        assert!(!shown.output.contains("font/woff2") && shown.output.contains("<math"));
        assert!(shown.output.len() < 20_000, "{}", shown.output.len());
        assert!(shown.errors.contains("without its font"), "{}", shown.errors);
        let whole = run(&arguments);
        assert!(whole.output.contains("font/woff2") && whole.errors.is_empty());
    }
}
