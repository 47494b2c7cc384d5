//! Output for people: angles, letters, numbers.

use crate::{complaint, folder, messages_on_terminal, output, robot, run};

/// An arm with angles that are rounded as in exported files.
const ROUNDED_ANGLES: &str = r#"<robot name="rounded">
  <link name="base"/>
  <link name="upper">
    <inertial>
      <origin xyz="0 0 0.2" rpy="0 0 0"/>
      <mass value="2"/>
      <inertia ixx="0.02" iyy="0.03" izz="0.01" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <link name="fore">
    <inertial>
      <origin xyz="0.1 0 0" rpy="0 0 0"/>
      <mass value="1"/>
      <inertia ixx="0.002" iyy="0.003" izz="0.004" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/>
    <origin xyz="0 0 0.3" rpy="1.5708 0 3.1416"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="10" velocity="2"/>
  </joint>
  <joint name="elbow" type="revolute">
    <parent link="upper"/><child link="fore"/>
    <origin xyz="0 0 0.4" rpy="-4.9305e-37 0 -1.570796"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="10" velocity="2"/>
  </joint>
</robot>
"#;

/// The path of a file with this arm.
pub(crate) fn rounded(test: &str) -> String {
    let path = folder(test).join("rounded.urdf");
    std::fs::write(&path, ROUNDED_ANGLES).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn rounded_right_angles_are_right_in_print_and_said() {
    let file = rounded("rounded_angles");
    for command in
        [&["equations", &file][..], &["document", &file], &["document", &file, "--format", "typst"]]
    {
        let shown = run(command);
        assert_eq!(shown.code, 0, "{}", shown.errors);
        assert!(
            !shown.output.contains("1.57") && !shown.output.contains("3.14"),
            "{}",
            shown.output
        );
        let expected = "note: rounded: 3 constant angles within 1e-5 rad of a multiple of π/2 are printed as multiples \
                        (shoulder, elbow); --snap 0 prints them as they are\n";
        assert_eq!(shown.errors, expected);
    }
    let shown = run(&["report", &file, "--without-compiler", "-o", "-"]);
    assert!(shown.errors.contains("3 constant angles within 1e-5 rad"), "{}", shown.errors);
    assert!(shown.output.contains("In tables and equations, 3 constant angles within 1e-5 rad"));
    assert!(shown.output.contains("rotate x by π/2") && !shown.output.contains("0.00000000"));
}

#[test]
fn a_tolerance_that_is_given_is_taken_and_code_keeps_its_own() {
    let file = rounded("given_tolerance");
    for snap in ["0", "1e-9"] {
        let shown = output(&["equations", &file, "--snap", snap, "--digits", "17"], "");
        assert!(shown.contains("sin(1.5708)"), "{shown}");
    }
    assert!(!output(&["equations", &file, "--snap", "1e-4"], "").contains("1.57"));
    let code = |snap: &str| output(&["generate", &file, "--snap", snap, "-o", "-"], "");
    assert_eq!(output(&["generate", &file, "-o", "-"], ""), code("1e-9"));
    assert_ne!(code("1e-5"), code("1e-9"));
}

#[test]
fn letters_are_those_of_the_field() {
    let of = |arguments: &[&str]| {
        let file = robot("planar_2r");
        output(&[&["equations", &file, "--form", "grouped"], arguments].concat(), "")
    };
    let usual = of(&[]);
    assert!(usual.contains("Q1 = M_1_1*qdd1") && usual.contains("g_1 = "), "{usual}");
    assert_eq!(of(&["--letters", "paper"]), usual);
    let field = of(&["--letters", "field"]);
    assert!(
        field.contains("tau1 = M_1_1*qdd1 + M_1_2*qdd2 + C_1_1_2*(2*qd1 + qd2)*qd2"),
        "{field}"
    );
    assert!(field.contains("\nC_1_1_2 = -m2*l1*r2*sin(q2)\n"), "{field}");
    assert_eq!(of(&["--letters", "field", "--christoffel"]), field);
    assert!(of(&["--letters", "tau,M,h,g"]).contains("h_1_1_2*qd1*qd2 + h_1_2_2*qd2^2"));
    assert_eq!(of(&["--letters", "tau,M,C,g"]), field);
    let scalars = ["--letters", "tau,D,h,G", "--format", "latex", "--layout", "scalars"];
    let latex = of(&scalars);
    assert!(latex.contains(r"\tau_1 &= D_{11} \ddot{q}_1") && latex.contains("G_1 &="), "{latex}");
    assert!(latex.contains("h_{112} &="), "{latex}");
    let typst = of(&["--letters", "field", "--format", "typst", "--layout", "scalars"]);
    assert!(typst.contains("τ_1 ") && typst.contains("C_112"), "{typst}");
    assert!(of(&["--letters", "field", "--format", "mathml"]).contains("<mi>τ</mi>"));
    for (wrong, why) in [
        ("tau,M,C", "four letters are needed, not 3"),
        ("tau,M,M,g", "`M` is given twice"),
        ("tau,M,C,g1", "`g1` is not a letter"),
        ("feild", "`feild` is not a letter"),
    ] {
        let found = complaint(2, &["equations", &robot("planar_2r"), "--letters", wrong], "");
        assert!(found.contains(why), "{found}");
        assert!(found.contains("letters are `field`, `paper`, or four different ones"), "{found}");
    }
    let arguments = ["equations", &robot("planar_2r"), "--quantity", "F", "--letters", "field"];
    assert!(complaint(2, &arguments, "").contains("--letters has no effect"));
    let document = ["document", &robot("planar_2r"), "--letters", "field"];
    let document = output(&document, "");
    assert!(document.contains(r"\(\tau_i\) is the joint torque"), "{document}");
    assert!(!document.contains("Q_"), "{document}");
}

#[test]
fn letters_are_those_of_matrices_and_columns() {
    let of = |name: &str, arguments: &[&str]| {
        let file = robot(name);
        let grouped = ["equations", &file, "--form", "grouped", "--layout", "vectors"];
        output(&[&grouped[..], arguments].concat(), "")
    };
    let field = ["--letters", "field"];
    for (name, usual) in [
        ("planar_2r", "Q = M(q)*qdd + h(q, qd) + g(q) + w"),
        ("trttr1", "Q = H(q)*qdd + n(q, qd) + g(q) + w"),
    ] {
        assert!(of(name, &[]).contains(&format!("\n{usual}\n")), "{name}");
        let shown = of(name, &field);
        assert!(shown.contains("\ntau = M(q)*qdd + C(q, qd)*qd + g(q) + w\n"), "{shown}");
        assert!(shown.contains("\nC(q, qd) = [ "), "{shown}");
    }
    // Greek letters are spelled out in text and typeset in formulas, and entries that do not fit have the letter of
    // their matrix.
    let greek = ["--letters", "tau,Lambda,mu,p"];
    let shown = of("trttr1", &greek);
    assert!(shown.contains("\ntau = Lambda(q)*qdd + mu(q, qd) + p(q) + w\n"), "{shown}");
    let narrow = [&greek[..], &["--format", "latex", "--width", "12cm"]].concat();
    let shown = of("trttr1", &narrow);
    let sum = r"\tau &= \Lambda\left(q\right) \ddot{q} + \mu\left(q, \dot{q}\right) + p\left(q\right) + w";
    assert!(shown.contains(sum) && shown.contains("\n  \\Lambda_{22} &= "), "{shown}");
    let document = output(&["document", &robot("trttr1"), "--letters", "field"], "");
    for meaning in [
        r"\(\tau\) & joint torques",
        r"\(C\left(q, \dot{q}\right)\) & matrix of the Coriolis and centrifugal terms",
        r"\(g\left(q\right)\) & gravity terms",
    ] {
        assert!(document.contains(meaning), "{meaning}: {document}");
    }
    // The style of the paper has its own letters.
    let arguments = ["equations", &robot("trttr1"), "--style", "paper", "--letters", "field"];
    assert!(complaint(2, &arguments, "").contains("--letters"));
}

#[test]
fn entries_of_matrices_have_fractions_and_rounded_numbers() {
    let of = |name: &str, arguments: &[&str]| {
        let file = robot(name);
        run(&[&["equations", &file, "--layout", "vectors"], arguments].concat()).output
    };
    let christoffel = ["--form", "grouped", "--christoffel", "--format", "latex", "--expand"];
    let shown = of("stanford", &[&christoffel[..], &["--digits", "3"]].concat());
    let opens = [r"\begin{bmatrix}", r"\left[\begin{array}"];
    let matrices = shown.lines().filter(|line| opens.iter().any(|open| line.contains(open)));
    let rounded = |line: &str| {
        let is_digit = |c: char| c.is_ascii_digit() || c == '.';
        let numbers = line.split(|c| !is_digit(c)).filter(|number| number.contains('.'));
        let significant = |number: &str| number.trim_start_matches(['0', '.']).replace('.', "");
        numbers.map(significant).all(|number| number.trim_end_matches('0').len() <= 3)
    };
    assert!(matrices.clone().count() > 1 && matrices.clone().all(rounded), "{shown}");
    let text = of("puma560", &["--form", "grouped", "--digits", "2"]);
    assert!(text.contains("g(q) = [ ") && text.contains("[ 0.028*sin(q2 + q3)"), "{text}");
    assert!(!text.contains("0.4318"), "{text}");
    let recursive = ["--form", "recursive", "--format", "latex"];
    let shown = of("ur5", &recursive);
    assert!(shown.contains(r"\begin{bmatrix} \frac{1}{4} \omega_x^{3}"), "{shown}");
    // Beside another decimal, a quarter is one, too.
    let quarters = shown.lines().filter(|line| line.contains(" 0.25 "));
    assert!(quarters.clone().all(|line| line.contains(" 0.39225 ")), "{shown}");
}

#[test]
fn documents_say_which_angles_are_rounded() {
    let file = rounded("rounded_document");
    for format in ["latex", "typst"] {
        let shown = run(&["document", &file, "--format", format]).output;
        let sentence = "3 constant angles of the robot file are rounded: tables and equations have the multiples of π/2, \
                        which differ by at most 7e-6 rad (upper, fore).";
        let words: String = shown.split_whitespace().collect::<Vec<_>>().join(" ");
        let words = words.replace(r"\(\pi\)", "π").replace("\\", "");
        assert!(words.contains(sentence), "{words}");
        for as_they_are in [&["--snap", "0"][..], &["--snap", "1e-9"]] {
            let arguments = ["document", &file, "--format", format];
            let shown = output(&[&arguments[..], as_they_are].concat(), "");
            assert!(!shown.contains("of the robot file are rounded"), "{shown}");
        }
    }
    let exact = output(&["document", &robot("trttr1")], "");
    assert!(!exact.contains("of the robot file"), "{exact}");
}

#[test]
fn vectors_have_right_angles_where_the_file_has_rounded_ones() {
    let file = rounded("rounded_vectors");
    let recursive = ["equations", &file, "--form", "recursive", "--format", "latex"];
    let shown = run(&recursive).output;
    assert!(shown.contains(r"\begin{bmatrix}") && !shown.contains("1.57"), "{shown}");
    assert!(output(&[&recursive[..], &["--snap", "0"]].concat(), "").contains("1.57"));
}

#[test]
fn the_mass_matrix_is_m_unless_masses_are() {
    let grouped = |name| run(&["equations", &robot(name), "--form", "grouped"]).output;
    // The wrench of a tip has M_x, which differs from M_11.
    for name in ["planar_2r", "puma560", "panda"] {
        assert!(grouped(name).contains("\nM_1_1 = "), "{name}");
    }
    assert!(grouped("trttr1").contains("\nH_1_1 = "), "masses are M1 to M5");
    let found =
        output(&["equations", &robot("trttr1"), "--form", "grouped", "--letters", "field"], "");
    assert!(found.contains("\nM_1_1 = "), "{found}");
}

#[test]
fn indices_have_one_style() {
    let file = robot("trttr1");
    let recursive = ["equations", &file, "--form", "recursive", "--format", "latex"];
    let vectors = output(&recursive, "");
    assert!(vectors.contains(r"\bar{\varepsilon}^{5} &=") && vectors.contains(r"\bar{F}_l^{5} &="));
    let shown = output(&[&recursive[..], &["--layout", "scalars"]].concat(), "");
    assert!(shown.contains(r"\omega_z^{2} &=") && shown.contains("F_x^{2} &="), "{shown}");
    assert!(!shown.contains(r"\omega_{2"), "{shown}");
}

#[test]
fn digits_are_rounded_for_people_alone() {
    let file = robot("puma560");
    let grouped = ["equations", &file, "--form", "grouped", "--digits", "3"];
    let shown = output(&grouped, "");
    let is_digit = |c: char| c.is_ascii_digit() || c == '.';
    let numbers = shown.split(|c| !is_digit(c)).filter(|number| number.contains('.'));
    for number in numbers {
        let significant = number.trim_start_matches(['0', '.']).replace('.', "");
        assert!(significant.trim_end_matches('0').len() <= 3, "{number}");
    }
    let latex = output(&[&grouped[..], &["--format", "latex"]].concat(), "");
    assert!(!latex.contains("0.43180") && latex.contains("0.432"), "{latex}");
    let found = complaint(2, &[&grouped[..], &["--format", "json"]].concat(), "");
    assert!(found.contains("--digits has no effect on JSON"), "{found}");
    let document = output(&["document", &file, "--digits", "3"], "");
    assert!(
        document.contains("Decimals of equations and poses are rounded to 3 significant digits.")
    );
    assert!(!output(&["document", &robot("planar_2r")], "").contains("significant digits"));
}

/// The rounding noise of doubles that a program wrote into a robot file is printed only for machines; on a terminal, a
/// note says that decimals are rounded, unless an option requests it.
#[test]
fn the_noise_of_doubles_is_not_printed() {
    let folder = folder("noise");
    let path = folder.join("noisy.urdf");
    let noisy = crate::URDF
        .replace("xyz=\"0.5 0 0\"", "xyz=\"0.17500000000000002 0 0\"")
        .replace("<axis", "<origin xyz=\"0 0 0.41700000000000004\"/><axis");
    std::fs::write(&path, noisy).unwrap();
    let file = path.to_str().unwrap();
    for arguments in [
        &["equations", file][..],
        &["equations", file, "--form", "compact"],
        &["equations", file, "--form", "grouped", "--format", "latex"],
        &["base", file],
        &["base", file, "--format", "typst"],
    ] {
        let done = run(arguments);
        assert_eq!((done.code, done.errors.as_str()), (0, ""), "{arguments:?}");
        assert!(!done.output.contains("00000"), "{}", done.output);
        let note = "note: decimals are rounded to 10 significant digits; --digits 17 prints all\n";
        assert!(messages_on_terminal(arguments).ends_with(note), "{arguments:?}");
        for digits in ["4", "17"] {
            let messages = messages_on_terminal(&[arguments, &["--digits", digits]].concat());
            assert!(!messages.contains("rounded"), "{messages}");
        }
        let all = run(&[arguments, &["--digits", "17"]].concat());
        assert_eq!((all.code, all.errors.as_str()), (0, ""), "{arguments:?}");
        assert!(all.output.contains("00000000"), "{}", all.output);
    }
    for command in ["equations", "base"] {
        let exact = run(&[command, file, "--format", "json"]);
        assert_eq!((exact.code, exact.errors.as_str()), (0, ""), "{command}");
        assert!(exact.output.contains("00000000"), "{}", exact.output);
        let found = complaint(2, &[command, file, "--format", "json", "--digits", "4"], "");
        assert!(found.contains("--digits has no effect on JSON"), "{found}");
    }
    let document = output(&["document", file], "");
    let said = "Decimals of equations and poses are rounded to 10 significant digits.";
    assert!(document.contains(said) && !document.contains("00000"), "{document}");
    assert!(document.contains("0.417"), "{document}");
    let page = output(&["report", file, "--without-compiler"], "");
    assert!(page.contains("Decimals are rounded to 10 significant digits."));
    assert!(
        !output(&["report", &robot("planar_2r"), "--without-compiler"], "")
            .contains("rounded to 10")
    );
}

/// The derivation ends at its limit, and nothing is made of what it has by then.
#[test]
fn a_form_that_no_limit_of_joints_holds_ends_at_a_limit_of_expressions() {
    let link = |number: usize| {
        let axis = ["x", "y", "z"][number % 3];
        format!(
            "[[link]]\nname = \"{number}\"\njoint = {{ type = \"revolute\", axis = \"{axis}\" }}\n\
             origin = {{ xyz = [0.1, 0, 0.05] }}\nmass = 1\ncenter_of_mass = [0.05, 0, 0]\n\
             inertia = {{ xx = 0.01, yy = 0.01, zz = 0.01 }}\n"
        )
    };
    let links: String = (1..=64).map(link).collect();
    let path = folder("printing_long_chain").join("chain.toml");
    std::fs::write(&path, format!("format = 1\n[robot]\nname = \"chain\"\n{links}")).unwrap();
    let arguments = ["equations", path.to_str().unwrap(), "--form", "regrouped"];
    let said = complaint(1, &arguments, "");
    assert!(said.contains("need more than 300000 expressions"), "{said}");
    assert!(said.contains("`recursive` and `compact`"), "{said}");
}

#[test]
fn a_long_document_names_shorter_forms() {
    let done = run(&["document", &robot("panda")]);
    let note = done.errors.lines().find(|line| line.starts_with("note: the document has "));
    assert!(note.unwrap().ends_with(" equations; --form compact or recursive has fewer"));
    let short = run(&["document", &robot("panda"), "--form", "compact"]);
    assert!(!short.errors.contains("the document has"), "{}", short.errors);
}

#[test]
fn no_number_is_a_quotient_of_long_ones_and_constants_are_a_table() {
    let shown = output(&["document", &robot("panda"), "--form", "compact", "--columns", "2"], "");
    assert!(!shown.split(|c: char| !c.is_ascii_digit()).any(|digits| digits.len() > 20), "{shown}");
    assert!(!shown.contains(r"\frac{745"), "{shown}");
    assert!(shown.contains("Constants."), "{shown}");
    assert!(!shown.contains("k_{1} &=") && !shown.contains("k_1 &="), "{shown}");
    let recursive = output(&["document", &robot("trttr1"), "--form", "recursive"], "");
    assert!(!recursive.contains("Constants."), "zeros of vectors are not constants");
    let shown = output(&["equations", &robot("panda"), "--form", "compact"], "");
    let quotient = |line: &str| line.replace("sqrt(2)/2", "").contains('/');
    assert!(!shown.lines().any(quotient), "{shown}");
}

#[test]
fn halves_are_fractions_where_no_number_is_a_decimal() {
    let shown = output(&["equations", &robot("trttr1"), "--friction", "--format", "latex"], "");
    assert!(shown.contains(r"\frac{1}{2}") && !shown.contains("0.5"), "{shown}");
}

#[test]
fn compact_equations_are_in_terms_of_mechanics() {
    let shown = output(&["equations", &robot("planar_2r"), "--form", "compact"], "");
    assert!(
        shown.contains("(m2*r2^2 + I2)") && shown.contains("m1*r1^2 + I1 + m2*l1^2"),
        "{shown}"
    );
    assert!(!shown.contains("0.5*"), "{shown}");
    assert!(shown.lines().all(|line| !line.starts_with("Q1 = x_2")), "{shown}");
    let shown = output(&["equations", &robot("trttr1"), "--form", "compact"], "");
    assert!(
        shown.contains("Jy5*qdd5") && shown.contains("(Jz5 - Jx5)*sin(q5)*cos(q5)*qd2^2"),
        "{shown}"
    );
    for idle in ["Jx2", "Jy2", "Jx3", "Jx4", "k_1"] {
        assert!(!shown.contains(idle), "{idle}: {shown}");
    }
}

#[test]
fn markdown_has_displays_that_are_closed() {
    let file = robot("trttr1");
    let arguments =
        ["equations", &file, "--form", "grouped", "--format", "markdown", "--width", "8"];
    let shown = output(&arguments, "");
    let fences = shown.lines().filter(|line| *line == "$$").count();
    assert!(fences > 10 && fences.is_multiple_of(2), "{shown}");
    assert!(shown.starts_with("## Equations of motion, grouped\n\n$$\n"), "{shown}");
    assert!(
        shown.contains("\n## Mass matrix\n\n$$\nH\\left(q\\right) = \\begin{bmatrix} H_{11}"),
        "{shown}"
    );
    for name in ["{aligned}", "{bmatrix}", "{array}"] {
        let [begins, ends] =
            ["begin", "end"].map(|word| shown.matches(&format!("\\{word}{name}")).count());
        assert!(begins > 0 && begins == ends, "{name}: {shown}");
    }
    for unknown in ["operatorname", "align*", "@{}"] {
        assert!(!shown.contains(unknown), "{unknown}: {shown}");
    }
    let scalars = output(&[&arguments[..], &["--layout", "scalars"]].concat(), "");
    assert!(scalars.contains("$$\nH_{11} = ") && !scalars.contains("bmatrix"), "{scalars}");
    let arguments = ["equations", &file, "--format", "markdown", "--numbers"];
    assert!(complaint(2, &arguments, "").contains("--numbers has no effect on Markdown"));
}

#[test]
fn frames_of_base_parameters_without_these_are_noticed() {
    let file = robot("planar_2r");
    let arguments = ["equations", &file, "--base-frames", "denavit_hartenberg"];
    let found = run(&arguments).errors;
    assert!(found.contains("--base-frames has no effect in this form"), "{found}");
    assert_eq!(run(&[&arguments[..], &["--form", "regrouped"]].concat()).errors, "");
}

#[test]
fn base_parameters_that_are_standard_ones_are_named_once() {
    let shown = output(&["base", &robot("planar_2r")], "");
    for line in shown.lines() {
        assert!(line.split_once(" = ").is_none_or(|(left, right)| left != right), "{shown}");
    }
}

#[test]
fn misspelled_files_of_states_are_suggested() {
    let folder = folder("misspelled_states");
    std::fs::write(folder.join("states.csv"), "q1,q2\n0,0\n").unwrap();
    let file = folder.join("stats.csv");
    let arguments =
        ["eval", &robot("planar_2r"), "--function", "gravity", "--states", file.to_str().unwrap()];
    let found = complaint(1, &arguments, "");
    assert!(found.contains("did you mean") && found.contains("states.csv?"), "{found}");
}

#[test]
fn a_document_in_markdown_has_tables_and_numbered_equations() {
    let done = run(&["document", &robot("planar_2r"), "--format", "markdown"]);
    assert_eq!(done.code, 0, "{}", done.errors);
    assert!(done.errors.contains("a document in Markdown has no figure"), "{}", done.errors);
    let shown = done.output;
    assert!(shown.starts_with("<!-- @generated by robot-symbolic -->\n# Equations of motion of "));
    assert!(shown.contains("\n## Equations of motion, grouped\n"), "{shown}");
    assert!(
        shown.contains("| Link | Parent | Joint |") || shown.contains("| $i$ | Link |"),
        "{shown}"
    );
    // Displays are closed, numbers are counted, and each row of a table has its cells.
    assert_eq!(shown.lines().filter(|line| *line == "$$").count() % 2, 0);
    let tags = (1..).take_while(|number| shown.contains(&format!(r"\tag{{{number}}}"))).count();
    assert_eq!(tags, shown.matches(r"\tag{").count());
    assert!(tags > 3, "{shown}");
    let mut cells = None;
    for line in shown.lines() {
        let count = line.starts_with('|').then(|| line.matches('|').count());
        if let (Some(before), Some(count)) = (cells, count) {
            assert_eq!(before, count, "{line}");
        }
        cells = count;
    }
    let complaint = complaint(
        2,
        &["document", &robot("planar_2r"), "--format", "markdown", "--columns", "2"],
        "",
    );
    assert!(complaint.contains("--columns has no effect on Markdown"), "{complaint}");
}

#[test]
fn base_parameters_are_printed_in_markdown() {
    let shown = output(&["base", &robot("planar_2r"), "--format", "markdown"], "");
    assert!(shown.contains("\n$$\n") && shown.contains(r"\mathit{ZZR}_1 = "), "{shown}");
    let errors =
        complaint(2, &["base", &robot("planar_2r"), "--format", "markdown", "--numbers"], "");
    assert!(errors.contains("--numbers has no effect on Markdown"), "{errors}");
}

/// A torque that others contain has its own name, and sums are not split if terms would then cancel.
#[test]
fn compact_equations_are_those_of_mechanics() {
    let shown = output(&["equations", &robot("planar_2r"), "--form", "compact"], "");
    assert!(shown.starts_with("Q2 = ") && !shown.contains("x_1"), "{shown}");
    assert!(shown.ends_with(" + Q2\n"), "{shown}");
    let named = ["equations", &robot("planar_2r"), "--form", "compact", "--letters", "field"];
    let named = output(&named, "");
    assert!(named.starts_with("tau2 = ") && named.ends_with(" + tau2\n"), "{named}");
    let shown = output(&["equations", &robot("trttr1"), "--form", "compact"], "");
    assert!(shown.contains("Jx5*sin(q5)^2 + Jz5*cos(q5)^2") && !shown.contains("0.5*"), "{shown}");
    assert!(!shown.contains("Q4 = x_") && shown.contains("sin(q2)*Q4"), "{shown}");
    assert!(shown.contains("(l4 + q4)*x_2") && !shown.contains("l4*x_2"), "{shown}");
    // Roots of numbers belong to the coefficient.
    let arguments = ["equations", &robot("panda"), "--form", "recursive", "--format", "latex"];
    let shown = output(&arguments, "");
    assert!(
        shown.contains(r"\frac{\sqrt{2}}{2} F_x") && !shown.contains(r"F_x \sqrt{2}"),
        "{shown}"
    );
}
