//! `equations`: printed equations can be read back and have the values of the numeric solver.

use std::collections::BTreeMap;

use robot_model::description::read_toml;
use robot_numeric::{Loads, Mechanism, Wrench};
use robot_symbolic::Formula;
use serde_json::{Map, Value};

use crate::{complaint, folder, output, robot, run};

const Q: [f64; 5] = [0.1, -0.7, 0.2, 0.3, 1.1];
const QD: [f64; 5] = [0.4, 1.2, -0.3, 0.6, -0.9];
const QDD: [f64; 5] = [-1.0, 0.5, 0.8, -0.2, 2.0];
const WRENCH: [f64; 6] = [5.0, -3.0, 20.0, 0.4, 0.7, -0.6];

/// The value of a name of TRTTR1's equations at the state above.
fn value(robot: &robot_model::robot::Robot, name: &str) -> f64 {
    if let Some(parameter) = robot.parameter(name) {
        return parameter.value.as_ref().unwrap().to_f64();
    }
    let wrench = ["Fx6", "Fy6", "Fz6", "Mx6", "My6", "Mz6"];
    if let Some(component) = wrench.iter().position(|known| *known == name) {
        return WRENCH[component];
    }
    let (letters, number) = name.split_at(name.len() - 1);
    let number: usize = number.parse().unwrap();
    match letters {
        "q" => Q[number - 1],
        "qd" => QD[number - 1],
        "qdd" => QDD[number - 1],
        _ => panic!("{name} is not a name of the robot file"),
    }
}

fn quantities(arguments: &[&str]) -> Map<String, Value> {
    shown(arguments)["quantities"].as_object().unwrap().clone()
}

fn shown(arguments: &[&str]) -> Value {
    let file = robot("trttr1");
    let arguments = [&["equations", &file, "--format", "json"], arguments].concat();
    let shown: Value = serde_json::from_str(&output(&arguments, "")).unwrap();
    assert_eq!(shown["robot"], "TRTTR1");
    shown
}

/// The values of the printed equations, by name, and the numeric mechanism.
fn evaluated(arguments: &[&str]) -> (Vec<(String, f64)>, Mechanism) {
    let text = std::fs::read_to_string(robot("trttr1")).unwrap();
    let robot = read_toml("trttr1.toml", &text).unwrap().robot;
    let shown = shown(arguments);
    let mut defined: BTreeMap<String, f64> = BTreeMap::new();
    let evaluate = |text: &Value, defined: &BTreeMap<String, f64>| {
        let formula = Formula::parse(text.as_str().unwrap()).unwrap();
        formula.evaluate(|name| defined.get(name).copied().unwrap_or_else(|| value(&robot, name)))
    };
    for (name, text) in shown["definitions"].as_object().into_iter().flatten() {
        let number = evaluate(text, &defined);
        defined.insert(name.clone(), number);
    }
    let quantities = shown["quantities"].as_object().unwrap().iter();
    let values = quantities.map(|(name, text)| (name.clone(), evaluate(text, &defined)));
    (values.collect(), Mechanism::nominal(&robot).unwrap())
}

fn wrench() -> Wrench {
    let [fx, fy, fz, mx, my, mz] = WRENCH;
    Wrench { force: [fx, fy, fz].into(), moment: [mx, my, mz].into() }
}

fn assert_close(name: &str, found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-10 * expected.abs().max(1.0),
        "{name}: {found} {expected}"
    );
}

#[test]
fn joint_torques_have_the_values_of_the_numeric_solver() {
    for friction in [false, true] {
        let arguments: &[&str] = if friction { &["--friction"] } else { &[] };
        let (values, mechanism) = evaluated(arguments);
        let loads = Loads { wrenches: vec![wrench()], friction };
        let expected = mechanism.inverse_dynamics_with(&Q, &QD, &QDD, &loads).unwrap();
        assert_eq!(values.len(), 5);
        for (number, ((name, found), expected)) in values.iter().zip(expected.iter()).enumerate() {
            assert_eq!(*name, format!("Q{}", number + 1));
            assert_close(name, *found, *expected);
        }
    }
}

#[test]
fn every_quantity_has_the_value_of_the_numeric_solver() {
    let (values, mechanism) = evaluated(&["--quantity", "all"]);
    let links = mechanism.link_dynamics(&Q, &QD, &QDD, &[wrench()]).unwrap();
    let mut expected = vec![];
    for kind in ["a_c", "F", "M_c", "F_l", "M_l"] {
        for (index, link) in links.iter().enumerate() {
            let vector = match kind {
                "a_c" => link.center_acceleration,
                "F" => link.inertial_force,
                "M_c" => link.inertial_moment,
                "F_l" => link.contact_force,
                _ => link.contact_moment,
            };
            for (axis, value) in ["x", "y", "z"].iter().zip(vector.iter()) {
                expected.push((format!("{kind}{}.{axis}", index + 1), *value));
            }
        }
    }
    assert_eq!(values.len(), expected.len() + 5);
    for ((name, found), (expected_name, expected)) in values.iter().zip(&expected) {
        assert_eq!(name, expected_name);
        assert_close(name, *found, *expected);
    }
}

#[test]
fn the_quantities_asked_for_are_printed_in_their_order() {
    let names: Vec<String> =
        quantities(&["--quantity", "M_c,Q"]).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names.len(), 20);
    assert_eq!(
        [names[0].as_str(), names[14].as_str(), names[15].as_str()],
        ["M_c1.x", "M_c5.z", "Q1"]
    );
    let file = robot("trttr1");
    let shown = complaint(2, &["equations", &file, "--quantity", "F_1,Q,T"], "");
    assert!(shown.contains("there is no quantity `F_1`. Did you mean `F_l`?"), "{shown}");
    assert!(shown.contains("there is no quantity `T`."), "{shown}");
}

#[test]
fn text_holds_the_equations_on_lines_that_fit() {
    let shown = output(&["equations", &robot("trttr1")], "");
    assert!(shown.lines().all(|line| line.len() <= 104), "{shown}");
    let joined = shown.replace("\n    ", " ");
    for (name, text) in quantities(&[]) {
        assert!(joined.contains(&format!("{name} = {}\n", text.as_str().unwrap())), "{name}");
    }
}

#[test]
fn latex_has_the_names_of_the_file_and_the_style_asked_for() {
    let file = robot("trttr1");
    let shown = |trig: &str| {
        output(
            &["equations", &file, "--format", "latex", "--quantity", "Q,F_l", "--trig", trig],
            "",
        )
    };
    for (trig, sine) in [("named", r"\sin q_2"), ("short", "s_2"), ("paper", "sq_2")] {
        let latex = shown(trig);
        assert!(
            latex.starts_with("\\begin{align*}\n  Q_1 &= ") && latex.ends_with("\n\\end{align*}\n")
        );
        assert!(latex.contains("  F_{l_x}^{5} &= "), "{latex}");
        for part in [sine, r"\ddot{q}_1", "F_{l_x}^{6}", "J_x^{*5}", r"\dot{q}_2^{2}"] {
            assert!(latex.contains(part), "{part} is not in {latex}");
        }
        // Every line of an environment has one alignment mark, and all except the last end with a line break.
        for environment in latex.split_inclusive("\\end{align*}\n") {
            let lines: Vec<&str> = environment.lines().collect();
            assert_eq!(lines[0], r"\begin{align*}");
            for line in &lines[1..lines.len() - 2] {
                assert!(line.ends_with(r" \\") && line.matches('&').count() == 1, "{line}");
            }
        }
    }
}

#[test]
fn typst_is_a_notation_of_equations_and_documents() {
    let file = robot("trttr1");
    let shown = run(&["equations", &file, "--format", "typst", "--numbers"]);
    assert!(shown.output.contains("numbering: \"(1)\")\n$ Q_1 & = "), "{}", shown.output);
    assert!(shown.output.contains("$ <eq:Q5>\n"), "{}", shown.output);
    let shown = run(&["document", &file, "--format", "typst", "--columns", "2"]);
    assert_eq!((shown.code, shown.errors.as_str()), (0, ""));
    assert!(shown.output.contains("columns: 2)\n") && shown.output.contains("<eq:grouped:Q>"));
}

/// In two columns as well, a matrix is printed if its entries have room beside the number of the equation.
#[test]
fn matrices_take_the_whole_width_of_a_column() {
    let shown = run(&["document", &robot("trttr1"), "--columns", "2"]);
    let matrix = r"H\left(q\right) &= \begin{bmatrix} H_{11} & H_{12} & 0 & H_{14} & 0 \\ ";
    assert!(shown.output.contains(matrix), "{}", shown.output);
}

/// The part of a document between two marks.
fn between<'d>(document: &'d str, start: &str, end: &str) -> &'d str {
    let (_, rest) = document.split_once(start).unwrap_or_else(|| panic!("{start}: {document}"));
    rest.split_once(end).map_or(rest, |(part, _)| part)
}

#[test]
fn a_document_defines_the_symbols_that_occur() {
    let file = robot("trttr1");
    let shown =
        output(&["document", &file, "--form", "grouped,recursive", "--title", "An arm"], "");
    assert!(shown.contains(r"{\LARGE An arm\par}"), "{shown}");
    let symbols = between(&shown, r"\section{Symbols}", r"\section{");
    for defined in [
        r"\(q_1\) & position of joint 1, m",
        r"\(\ddot{q}_i\) & second time derivative of \(q_i\)",
        r"\(M_1\) & mass of link 1 & \(45 \mathrm{\ } \mathrm{kg}\)",
        r"\(H_{ij}\) & entry of the mass matrix",
        r"\(H\left(q\right)\) & mass matrix",
        r"\(n\left(q, \dot{q}\right)\) & Coriolis and centrifugal terms",
        r"\(w\) & contribution",
        r"\(\bar{\omega}^i\) & angular velocity of link i, rad/s; its component along x: \(\omega_x^i\)",
        r"\(\bar{M}_l^i\) & moment that link i receives",
    ] {
        assert!(symbols.contains(defined), "{defined}: {symbols}");
    }
    // Friction is not included.
    assert!(!symbols.contains("friction"), "{symbols}");
    let shown = output(&["document", &file, "--friction"], "");
    assert!(between(&shown, r"\section{Symbols}", r"\section{").contains("viscous friction"));
}

#[test]
fn every_symbol_that_a_form_defines_has_a_meaning() {
    for name in ["trttr1", "ur5", "scara"] {
        let forms = "grouped,recursive,compact";
        let shown = output(&["document", &robot(name), "--form", forms], "");
        let symbols = between(&shown, r"\section{Symbols}", r"\section{");
        let labels = shown.matches(r"\label{eq:recursive:").count();
        assert!(labels > 20 && symbols.contains("angular acceleration"), "{symbols}");
        for definitions in ["Gravity", "Combinations of parameters", "Expressions of the state"] {
            let (title, word) = (
                format!(r"\subsection{{{definitions}}}"),
                match definitions {
                    "Gravity" => "gravity term",
                    "Combinations of parameters" => "combination of parameters",
                    _ => "expression that occurs several times",
                },
            );
            assert_eq!(shown.contains(&title), symbols.contains(word), "{name}: {definitions}");
        }
    }
}

#[test]
fn documents_have_the_scheme_of_the_robot() {
    let file = robot("trttr1");
    let latex = output(&["document", &file], "");
    let figure = between(&latex, r"\begin{tikzpicture}", r"\end{tikzpicture}");
    let typst = output(&["document", &file, "--format", "typst"], "");
    for name in ["base", "1", "5", "6"] {
        assert!(figure.contains(&format!("{{\\textbf{{{name}}}}};")), "{name}: {figure}");
        assert!(typst.contains(&format!("weight: \"bold\")[{name}])")), "{name}: {typst}");
    }
    for symbol in ["q_1", "q_5", "l_1", "l_6"] {
        assert!(figure.contains(&format!("{{\\({symbol}\\)}};")), "{symbol}: {figure}");
        assert!(typst.contains(&format!(")[${symbol}$])")), "{symbol}: {typst}");
    }
}

#[test]
fn a_long_equation_of_typst_has_its_number_once() {
    let shown = output(&["document", &robot("puma560"), "--format", "typst", "--columns", "2"], "");
    // Typst repeats the number of an equation on each page, so only parts without one are broken across pages.
    let unnumbered = "numbering: none)\n#show math.equation: set block(breakable: true)";
    assert_eq!(
        shown.matches("set block(breakable: true)").count(),
        shown.matches(unnumbered).count()
    );
    let equations = shown.split("$ <eq:").filter(|part| part.contains("#hide($"));
    let mut parts = 0;
    for part in equations {
        let numbered = part.matches("numbering: none").count();
        assert_eq!(numbered, part.matches("#hide($").count(), "{part}");
        parts += numbered;
    }
    assert!(parts > 3, "{parts}");
}

#[test]
fn the_regrouped_form_is_linear_in_base_parameters() {
    let shown = output(&["equations", &robot("trttr1"), "--form", "regrouped"], "");
    for line in ["MR_4 = M4 + M5", "Q3 = M3*(g + qdd3) + MR_4*(g + qdd3) + w_3"] {
        assert!(shown.lines().any(|shown| shown == line), "{line} is not in {shown}");
    }
    let arguments = ["equations", &robot("puma560"), "--form", "regrouped", "--format", "latex"];
    let latex = output(&arguments, "");
    assert!(latex.contains(r"  \mathit{XXR}_4 &= \mathit{XX}_4 + "), "{latex}");
    assert!(latex.contains(r" Q_6 &= \mathit{ZZ}_6\, Y_{6,21} + w_6"), "{latex}");
}

#[test]
fn a_symbol_with_the_name_of_a_base_parameter_is_refused() {
    let text = std::fs::read_to_string(robot("planar_2r")).unwrap().replace("r1", "ZZR_1");
    let path = folder("taken").join("arm.toml");
    std::fs::write(&path, text).unwrap();
    let errors = complaint(1, &["equations", path.to_str().unwrap(), "--form", "regrouped"], "");
    assert!(errors.contains("defines a symbol `ZZR_1` of its own"), "{errors}");
}

#[test]
fn mathml_is_a_page_of_its_own() {
    let file = robot("trttr1");
    let page = output(&["equations", &file, "--form", "grouped", "--format", "mathml"], "");
    assert!(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>\n"), "{page}");
    for part in ["<h1>TRTTR1</h1>", "<h2>Mass matrix</h2>", "<math display=\"block\"><mtable "] {
        assert!(page.contains(part), "{part} is not in {page}");
    }
    for outside in ["http", "src=", "href=", "<script"] {
        assert!(!page.contains(outside), "{outside} is in {page}");
    }
    let count = |page: &str| page.matches("<mtr>").count();
    let narrow = output(
        &["equations", &file, "--form", "grouped", "--format", "mathml", "--width", "6"],
        "",
    );
    assert!(count(&narrow) > count(&page));
    let page = run(&["base", &file, "--format", "mathml", "--numbers"]).output;
    assert!(page.contains("<mtext>(20)</mtext>"), "{page}");
}

/// The short form of this friction is not proved equal; it is printed as a plain sum.
#[test]
fn what_is_not_proved_is_printed_as_a_sum() {
    let text = "format = 1\n[robot]\nname = \"swing\"\ngravity = [1, 2, -9]\n[parameters]\nc1 = 0.3\n[[link]]\n\
                name = \"1\"\njoint = { type = \"revolute\", axis = [0.494, 0, \"2.5*c1\"] }\nmass = 4.5\n\
                center_of_mass = [0, 0, 0]\ninertia = { xx = 0.1, yy = 0.1, zz = 0.1 }\n\
                friction = { coulomb = 0.151, spindle_diameter = 0.05 }\n";
    let file = folder("unproved").join("swing.toml");
    std::fs::write(&file, text).unwrap();
    let file = file.to_str().unwrap();
    for form in ["grouped", "collected", "regrouped", "expanded"] {
        let shown = output(&["equations", file, "--form", form, "--friction"], "");
        assert!(shown.contains("F_l1_y = "), "{form}: {shown}");
    }
}

#[test]
fn matrices_are_printed_in_every_notation_where_they_fit() {
    let shown = |format: &str, more: &[&str]| {
        let file = robot("planar_2r");
        let all = [&["equations", &file, "--form", "grouped", "--format", format], more].concat();
        output(&all, "")
    };
    for (format, matrix) in [
        (
            "text",
            "M(q) = [ m1*r1^2 + I1 + m2*(l1^2 + r2^2 + 2*l1*r2*cos(q2)) + I2,  m2*r2*(r2 + l1*cos(q2)) + I2 ]\n       [ m2*r2*(r2 + l1*cos(q2)) + I2 ",
        ),
        ("latex", r" &= \begin{bmatrix} m_1 r_1^{2} + I_1 + "),
        ("typst", "mat(delim: \"[\", row-gap: #0.35em, m_1 r_1^2 + I_1 + "),
        ("mathml", "<mo fence=\"true\" form=\"prefix\">[</mo><mtable><mtr><mtd>"),
    ] {
        let vectors = shown(format, &["--layout", "vectors"]);
        assert!(vectors.contains(matrix), "{matrix}: {vectors}");
        let scalars = shown(format, &["--layout", "scalars"]);
        assert!(!scalars.contains(matrix) && scalars != vectors, "{format}: {scalars}");
        // Vectors are the default if formulas are typeset.
        assert_eq!(shown(format, &[]), if format == "text" { scalars } else { vectors });
    }
    let json: Value = serde_json::from_str(&shown("json", &["--layout", "vectors"])).unwrap();
    let rows = &json["arrays"]["M(q)"];
    assert_eq!(*rows, serde_json::json!([["M_1_1", "M_1_2"], ["M_1_2", "M_2_2"]]));
    let plain: Value = serde_json::from_str(&shown("json", &[])).unwrap();
    assert!(plain["arrays"].is_null() && plain["quantities"] == json["quantities"]);
}

#[test]
fn entries_that_do_not_fit_have_names_and_matrices_that_do_not_are_lists() {
    let shown = |width: &str| {
        let file = robot("planar_2r");
        let command = ["equations", &file, "--form", "grouped", "--format", "latex", "--width"];
        output(&[&command[..], &[width]].concat(), "")
    };
    let wide = shown("16cm");
    assert!(wide.contains(r"\begin{bmatrix} m_1 r_1^{2}") && !wide.contains("M_{11}"), "{wide}");
    let narrow = shown("12cm");
    assert!(narrow.contains(r"\begin{bmatrix} M_{11} & m_2 r_2"), "{narrow}");
    assert!(narrow.contains("\n  M_{11} &= "), "{narrow}");
    let file = robot("trttr1");
    let command = ["equations", &file, "--form", "grouped", "--format", "latex", "--width", "6"];
    let list = output(&command, "");
    assert!(list.contains("\n  H_{12} &= ") && list.contains("\n  H_{55} &= "), "{list}");
    assert!(!list.contains(r"H\left(q\right) &= "), "{list}");
    // The column of gravity still fits.
    assert!(list.contains(r"g\left(q\right) &= \begin{bmatrix} 0"), "{list}");
}

#[test]
fn a_layout_without_effect_is_refused() {
    let file = robot("trttr1");
    let errors = complaint(2, &["equations", &file, "--layout", "vectors"], "");
    assert!(errors.contains("--layout vectors has no effect on these equations"), "{errors}");
    // Equations for each entry are what this form has.
    let plain = output(&["equations", &file], "");
    assert_eq!(output(&["equations", &file, "--layout", "scalars"], ""), plain);
    let errors = complaint(2, &["equations", &file, "--style", "paper", "--trig", "short"], "");
    assert!(errors.contains("--style"), "{errors}");
}

/// The vectors of the paper are printed in its order, (9) to (24) outward and (31) to (39) inward, each as a column;
/// the moments (45) to (51), which fill pages, by components; then the joint torques (53) to (61). Quantities of the
/// recursion that are 0 or equal another one are left out.
#[test]
fn the_vectors_of_trttr1_are_in_the_shape_and_the_order_of_the_paper() {
    let file = robot("trttr1");
    let paper = output(&["equations", &file, "--style", "paper", "--format", "latex"], "");
    let lefts: Vec<&str> =
        paper.lines().filter_map(|line| Some(line.trim().split_once(" &= ")?.0)).collect();
    // The relation of each vector is printed before it.
    let both = |letter: &str, link: usize| [relation(letter, link), column(letter, link)];
    let outward = |letter: &'static str| (1..=5).flat_map(move |link| both(letter, link));
    let mut expected: Vec<String> = ["a_c", "F", "M_c"].into_iter().flat_map(outward).collect();
    expected.extend((1..=5).rev().flat_map(|link| both("F_l", link)));
    expected.extend((3..=5).rev().flat_map(|link| both("M_l", link)));
    for link in [2, 1] {
        expected.push(relation("M_l", link));
        expected.extend(["x", "y", "z"].map(|axis| format!("M_{{l_{axis}}}^{{{link}}}")));
    }
    for joint in 1..=5 {
        // The relation, and the torque.
        expected.extend([format!("Q_m^{{{joint}}}"), format!("Q_m^{{{joint}}}")]);
    }
    assert_eq!(lefts, expected);
    for line in [
        // (11), (12), (17), (26), (36), (54)
        r"\bar{a}_{c_4}^{4} &= \bar{a}_4^{4} + \bar{\varepsilon}_4^{4} \times \bar{r}_{c_4}^{4} + \bar{\omega}_4^{4} \times ",
        r" &= \begin{bmatrix} sq_2 \ddot{q}_1 - \dot{q}_2^{2} q_4 - \dot{q}_2^{2} l_4 + \ddot{q}_4 \\ ",
        r"-M_4 \left(-sq_2 \ddot{q}_1 + \dot{q}_2^{2} q_4 + \dot{q}_2^{2} l_4 - \ddot{q}_4\right) \\ ",
        r"\bar{F}_{l_5}^{5} &= \left[R\right]_6^{5} \cdot \bar{F}_{l_6}^{6} + \bar{F}_5^{5} ",
        r" + \bar{r}_{c_5}^{5} \times \bar{F}_5^{5} + \bar{r}_6^{5} \times \left[R\right]_6^{5} \cdot \bar{F}_{l_6}^{6} + ",
        r"Q_m^{2} &= \left[\bar{M}_{l_{o_2}}^{2}\right]^T \cdot \bar{k}_2^{2} = \begin{bmatrix} M_{l_x}^{2} & ",
    ] {
        assert!(paper.contains(line), "{line}\n{paper}");
    }
    // Relations are not infix text.
    let text = output(&["equations", &file, "--style", "paper"], "");
    assert!(text.contains("F3 = [ M3*sin(q2)*qdd1") && !text.contains("relation"), "{text}");
    let recursion = output(&["equations", &file, "--form", "recursive", "--format", "latex"], "");
    assert!(!recursion.contains("&= 0") && !recursion.contains(r"\bar{a}_c"), "{recursion}");
    assert!(
        recursion.contains(r"\bar{F}_l^{3} &= \begin{bmatrix} F_x^{3} + F_{l_x}^{4} \\ "),
        "{recursion}"
    );
}

/// `\bar{F}_{l_5}^{5}`, `\bar{M}_{l_{o_5}}^{5}`, `\bar{F}_5^{5}`
fn relation(name: &str, link: usize) -> String {
    match name.split_once('_') {
        Some(("M", "l")) => format!(r"\bar{{M}}_{{l_{{o_{link}}}}}^{{{link}}}"),
        Some((letter, index)) => format!(r"\bar{{{letter}}}_{{{index}_{link}}}^{{{link}}}"),
        None => format!(r"\bar{{{name}}}_{link}^{{{link}}}"),
    }
}

/// `\left[\bar{F}_l\right]_5^{5}`, `\left[\bar{M}_l\right]_{O_5}^{5}`, `\left[\bar{F}\right]_5^{5}`
fn column(name: &str, link: usize) -> String {
    let below = if name == "M_l" { format!("{{O_{link}}}") } else { link.to_string() };
    match name.split_once('_') {
        Some((letter, index)) => {
            format!(r"\left[\bar{{{letter}}}_{index}\right]_{below}^{{{link}}}")
        }
        None => format!(r"\left[\bar{{{name}}}\right]_{below}^{{{link}}}"),
    }
}
