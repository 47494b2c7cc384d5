//! The page that compares the equations of the paper's text with the derived ones, term by term.
//!
//! `UPDATE_SNAPSHOTS=1` writes it again.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::{Outcome, complaint, folder, output, robot, run};

const PAGE: &str = "docs/trttr1-equations.md";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// The equations of the transcription, each with number, name and right side.
fn transcribed() -> Vec<(String, String, String)> {
    let text = std::fs::read_to_string(root().join("docs/trttr1.printed")).unwrap();
    let mut all: Vec<(String, String, String)> = vec![];
    for line in text.lines().filter(|line| !line.starts_with('#') && !line.trim().is_empty()) {
        if line.starts_with("  ") {
            let (.., right) = all.last_mut().unwrap();
            *right = format!("{right} {}", line.trim());
            continue;
        }
        let (left, right) = line.split_once(" = ").unwrap();
        let (number, name) = left.split_once(' ').unwrap();
        all.push((number.to_owned(), name.to_owned(), right.to_owned()));
    }
    all
}

/// The derived equations in the paper's style by their names.
fn derived() -> BTreeMap<String, String> {
    printed(&["--style", "paper"])
}

/// The derived equations in the order of the text.
fn alike() -> BTreeMap<String, String> {
    let text = root().join("docs/trttr1.printed");
    printed(&["--like", text.to_str().unwrap()])
}

fn printed(style: &[&str]) -> BTreeMap<String, String> {
    let robot = robot("trttr1");
    let arguments = ["equations", &robot, "--format", "json"];
    let shown = output(&[arguments.as_slice(), style].concat(), "");
    let shown: serde_json::Value = serde_json::from_str(&shown).unwrap();
    let quantities = shown["quantities"].as_object().unwrap();
    let text = |text: &serde_json::Value| text.as_str().unwrap().to_owned();
    quantities.iter().map(|(name, value)| (name.clone(), text(value))).collect()
}

/// The terms of a sum outside of brackets, each with its sign.
fn terms(sum: &str) -> Vec<String> {
    let (mut all, mut depth): (Vec<String>, i32) = (vec![String::new()], 0);
    for character in sum.chars().filter(|character| *character != ' ') {
        depth += i32::from(character == '(') - i32::from(character == ')');
        match character {
            '+' | '-' if depth == 0 && !all.last().unwrap().is_empty() => {
                all.push(character.to_string());
            }
            _ => all.last_mut().unwrap().push(character),
        }
    }
    let plain = |term: String| term.strip_prefix('+').map_or(term.clone(), str::to_owned);
    all.into_iter().map(plain).collect()
}

/// The factors of a product outside of brackets.
fn factors(product: &str) -> Vec<String> {
    let (mut all, mut depth) = (vec![String::new()], 0);
    for character in product.chars() {
        depth += i32::from(character == '(') - i32::from(character == ')');
        match character {
            '*' if depth == 0 => all.push(String::new()),
            _ => all.last_mut().unwrap().push(character),
        }
    }
    all
}

/// A symbol of the paper, with an exponent or without.
fn symbol(name: &str, power: &str) -> String {
    let digits = name.trim_start_matches(|letter: char| !letter.is_ascii_digit());
    let (link, axis) = digits.split_once('.').unwrap_or((digits, ""));
    let letters = &name[..name.len() - digits.len()];
    match letters {
        "q" => format!("q_{link}{power}"),
        "qd" => format!(r"\dot{{q}}_{link}{power}"),
        "qdd" => format!(r"\ddot{{q}}_{link}{power}"),
        "l" | "M" if axis.is_empty() => format!("{letters}_{link}{power}"),
        "Jx" | "Jy" | "Jz" => format!("J_{}^{{*{link}}}", &letters[1..]),
        "Fx" | "Fy" | "Fz" | "Mx" | "My" | "Mz" => {
            format!("{}_{{l_{}}}^{link}", &letters[..1], &letters[1..])
        }
        "F_l" | "M_l" => format!("{}_{{l_{axis}}}^{link}", &letters[..1]),
        "a_c" | "M_c" => format!("{}_{{c_{axis}}}^{link}", &letters[..1]),
        "F" => format!("F_{axis}^{link}"),
        "Q" => format!("Q_m^{link}"),
        _ => name.to_owned() + power,
    }
}

/// A term in LaTeX, with the sign that it starts with.
fn term(text: &str) -> String {
    let (sign, product) = text.strip_prefix('-').map_or(("", text), |rest| ("-", rest));
    let factor = |factor: &String| {
        if let Some(inside) = factor.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')) {
            return format!("({})", line(&terms(inside), &[]));
        }
        let (base, power) = factor.split_once('^').unwrap_or((factor, ""));
        let power = if power.is_empty() { String::new() } else { format!("^{power}") };
        let angle = |name| base.strip_prefix(name)?.strip_suffix(')');
        match (angle("sin("), angle("cos(")) {
            (Some(angle), _) => format!("s{power}{}", symbol(angle, "")),
            (_, Some(angle)) => format!("c{power}{}", symbol(angle, "")),
            _ => symbol(base, &power),
        }
    };
    format!("{sign}{}", factors(product).iter().map(factor).collect::<Vec<_>>().join(" "))
}

/// Prints terms next to each other; marked terms are red.
fn line(terms: &[String], marked: &[bool]) -> String {
    let one = |(place, text): (usize, &String)| {
        let shown = term(text);
        let shown = if place == 0 || shown.starts_with('-') { shown } else { format!("+{shown}") };
        match marked.get(place) {
            Some(true) => format!(r"\textcolor{{red}}{{{shown}}}"),
            _ => shown,
        }
    };
    terms.iter().enumerate().map(one).collect::<Vec<_>>().join(" ")
}

/// The number of characters of infix text in a line of a formula.
const LINE: usize = 95;

/// Prints a right side on several lines, after the text before it.
fn lines(before: &str, terms: &[String], others: &[String]) -> String {
    let marked: Vec<bool> =
        terms.iter().map(|one| !others.iter().any(|other| key(other) == key(one))).collect();
    let (mut all, mut start, mut length) = (vec![], 0, 0);
    for (place, one) in terms.iter().enumerate() {
        if length + one.len() > LINE && place > start {
            all.push(start..place);
            (start, length) = (place, 0);
        }
        length += one.len() + 2;
    }
    all.push(start..terms.len());
    let shown = all.into_iter().map(|range| {
        let text = line(&terms[range.clone()], &marked[range.clone()]);
        let goes_on = range.start > 0 && !terms[range.start].starts_with('-');
        if goes_on { format!("+{text}") } else { text }
    });
    format!("{before} & {}", shown.collect::<Vec<_>>().join(" \\\\\n& \\quad "))
}

/// The sign and the sorted factors of a term, which do not depend on the order of the factors.
fn key(term: &str) -> (bool, Vec<String>) {
    let negative = term.starts_with('-');
    let mut factors = factors(term.trim_start_matches('-'));
    factors.sort();
    (negative, factors)
}

/// Whether the common terms have the same order, and their factors too.
fn in_order(text: &[String], ours: &[String]) -> bool {
    let common = |of: &[String], other: &[String]| -> Vec<String> {
        of.iter().filter(|one| other.iter().any(|two| key(two) == key(one))).cloned().collect()
    };
    common(text, ours) == common(ours, text)
}

#[derive(Default)]
struct Counts {
    same: usize,
    differing: usize,
    reordered: usize,
    names: usize,
}

fn page() -> (String, Counts) {
    let derived = alike();
    let (mut counts, mut body) = (Counts::default(), String::new());
    for group in transcribed().chunk_by(|one, next| one.0 == next.0) {
        let rows = group.iter().flat_map(|(_, name, right)| {
            rows(&symbol(name, ""), &terms(right), &terms(&derived[name]), &mut counts)
        });
        let rows = rows.collect::<Vec<_>>().join(" \\\\[4pt]\n");
        let number = &group[0].0;
        body.push_str(&format!(
            "\n### {number}\n\n```math\n\\begin{{aligned}}\n{rows}\n\\end{{aligned}}\n```\n"
        ));
    }
    (body, counts)
}

/// Prints an equation once if both versions are identical, otherwise the text's and ours.
fn rows(left: &str, text: &[String], ours: &[String], counts: &mut Counts) -> Vec<String> {
    let is_name = text.len() == 1 && text[0].starts_with(['F', 'M']) && text[0].contains('.');
    if is_name {
        counts.names += 1;
        return vec![lines(&format!("{left} ="), text, text)];
    }
    if text == ours {
        counts.same += 1;
        return vec![lines(&format!("{left} ="), ours, ours)];
    }
    let count = match in_order(text, ours) {
        true => &mut counts.differing,
        false => &mut counts.reordered,
    };
    *count += 1;
    let of = |who: &str| format!(r"\text{{{who}:}}\quad {left} =");
    vec![lines(&of("text"), text, ours), lines(&of("ours"), ours, text)]
}

fn introduction(counts: &Counts) -> String {
    let Counts { same, differing, reordered, names } = counts;
    let all = same + differing + reordered + names;
    format!(
        "# TRTTR1, equation by equation\n\n\
         This page shows the scalar equations among (9) to (61) of the [text that we have of the paper](trttr1.md) beside those that\n\
         `robot-symbolic equations robots/trttr1.toml --like docs/trttr1.printed` prints. A test checks that this\n\
         page is up to date.\n\n\
         Of {all} scalar equations:\n\n\
         - {same} are the same, letter by letter, and are shown once;\n\
         - {differing} have the same order, but one or more terms differ and are red;\n\
         - {reordered} have their terms or factors in another order;\n\
         - {names} only name another quantity.\n\n\
         The order of the terms is the text's; only their values are derived. With `--style paper`, the text is not read:\n\
         terms are in the order in which the paper's relations (8) to (60) yield them. The terms of a product of sums\n\
         follow one another, and like terms are joined at the place of the first. The text has the same order except in\n\
         (35) and in (42) to (55); there it follows no rule that we know.\n"
    )
}

#[test]
fn the_equations_of_the_text_are_beside_the_derived_ones() {
    let (body, counts) = page();
    let shown = introduction(&counts) + &body;
    let path = root().join(PAGE);
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        std::fs::write(&path, &shown).unwrap();
    }
    assert_eq!(std::fs::read_to_string(path).unwrap(), shown, "{PAGE} is out of date");
}

/// The order of terms and factors is that of the paper wherever its relations were evaluated one after the other;
/// elsewhere each correct term of the text is one of ours.
#[test]
fn terms_are_in_the_order_of_the_paper() {
    let derived = derived();
    let mut wrong = vec![];
    let mut differing = 0;
    for (number, name, right) in transcribed() {
        let (text, ours) = (terms(&right), terms(&derived[&name]));
        let is_shuffled = name.starts_with("F_l1") && !name.ends_with('z')
            || name.starts_with("M_l1")
            || name.starts_with("M_l2")
            || ["M_l3.y", "M_l3.z", "Q1", "Q2"].contains(&name.as_str());
        if text.len() > 1 && !is_shuffled && !in_order(&text, &ours) {
            wrong.push(format!("{number} {name}\n{text:?}\n{ours:?}"));
        }
        if text.len() > 1 {
            differing +=
                text.iter().filter(|one| ours.iter().all(|two| key(two) != key(one))).count();
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    // 34 terms differ, and one of these is missing in the text (docs/trttr1.md). No term in brackets, (16) to (19),
    // differs.
    assert_eq!(differing, 33);
}

/// With `--like`, equations have the order of a published text, whatever it is.
#[test]
fn terms_are_in_the_order_of_the_text() {
    let (derived, alike) = (derived(), alike());
    for (number, name, right) in transcribed() {
        let (text, ours) = (terms(&right), terms(&alike[&name]));
        assert!(text.len() < 2 || in_order(&text, &ours), "{number} {name}\n{text:?}\n{ours:?}");
        let sorted = |all: &str| {
            let mut keys: Vec<_> = terms(all).iter().map(|term| key(term)).collect();
            keys.sort();
            keys
        };
        assert_eq!(sorted(&derived[&name]), sorted(&alike[&name]), "{number} {name}");
    }
}

/// The number of a column is the number that the text gives to all of its components.
#[test]
fn equations_have_the_numbers_of_the_text() {
    let text = root().join("docs/trttr1.printed");
    let numbered = |format: &str| {
        let like = ["--like", text.to_str().unwrap(), "--numbers"];
        let arguments = ["equations", &robot("trttr1"), "--format", format];
        output(&[arguments.as_slice(), &like].concat(), "")
    };
    let latex = numbered("latex");
    for (number, label) in [("13", "a-c5"), ("17", "F4"), ("35", "F-l1"), ("53", "Q1")] {
        let end = format!(r" \tag{{{number}}} \label{{eq:{label}}}");
        assert_eq!(latex.matches(&end).count(), 1, "{end} is not in {latex}");
    }
    let relation = latex.lines().find(|line| line.starts_with(r"  \bar{a}_{c_1}^{1} &= "));
    assert!(relation.unwrap().ends_with(r" \notag \\"), "{latex}");
    let typst = numbered("typst");
    let set = "#[#set math.equation(numbering: _ => [(17)])\n$ ";
    assert!(typst.contains(set) && typst.contains("$ <eq:F4>]"), "{typst}");
    assert!(numbered("mathml").contains("<mtext>(17)</mtext>"));
    assert!(!latex.contains(r"\label{eq:relation"), "{latex}");
}

/// Published LaTeX also has an order; equations that it does not contain keep the order of the style.
#[test]
fn the_order_of_latex_is_kept() {
    let expanded = |format: &str| output(&["equations", &robot("trttr1"), "--format", format], "");
    let path = folder("like").join("published.tex");
    std::fs::write(&path, expanded("latex")).unwrap();
    let alike = printed(&["--like", path.to_str().unwrap()]);
    let usual: serde_json::Value = serde_json::from_str(&expanded("json")).unwrap();
    for (name, text) in usual["quantities"].as_object().unwrap() {
        assert_eq!(alike[name], text.as_str().unwrap(), "{name}");
    }
    assert_eq!(alike["M_l2.z"], derived()["M_l2.z"]);
    let found =
        complaint(1, &["equations", &robot("planar_2r"), "--like", path.to_str().unwrap()], "");
    assert!(found.contains("does not have the quantity"), "{found}");
}

#[test]
fn terms_and_factors_are_read() {
    assert_eq!(terms("-M4*(a - b) + 2*c - d"), ["-M4*(a-b)", "2*c", "-d"]);
    assert_eq!(factors("M4*(a-b*c)*cos(q5)^2"), ["M4", "(a-b*c)", "cos(q5)^2"]);
    assert_eq!(term("-M4*(a-qd2^2*Jx5)*cos(q5)^2"), r"-M_4 (a -\dot{q}_2^2 J_x^{*5}) c^2q_5");
    let of = |text: &str| terms(text);
    assert!(in_order(&of("a + x + c"), &of("a + c + d")) && !in_order(&of("a + c"), &of("c + a")));
    assert!(!in_order(&of("a*b + c"), &of("b*a + c")));
}

/// The text of another robot is noticed.
#[test]
fn equations_unlike_those_of_the_text_are_counted() {
    let text = root().join("docs/trttr1.printed");
    let text = text.to_str().unwrap();
    let errors_of = |command: &str, robot_name: &str| {
        let arguments = [command, &robot(robot_name), "--like", text, "--digits", "17"];
        let Outcome { code, errors, .. } = run(&arguments);
        assert_eq!(code, 0, "{errors}");
        errors
    };
    for command in ["equations", "document"] {
        let shown = errors_of(command, "puma560");
        assert!(shown.starts_with("warning: "), "{shown}");
        assert!(shown.contains("docs/trttr1.printed have no term in common with"), "{shown}");
        let words = shown.split_whitespace();
        let numbers: Vec<usize> = words.filter_map(|word| word.parse().ok()).collect();
        assert!(numbers[0] > 20 && numbers[0] < numbers[1] && numbers[1] <= 85, "{shown}");
        assert_eq!(errors_of(command, "trttr1"), "");
    }
}

/// A letter of the equations that a parameter has can be changed by an option, unless a style determines it.
#[test]
fn the_remedy_for_a_taken_letter_is_the_option_for_letters() {
    let link = |name: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\njoint = {{ type = \"revolute\", axis = \"z\" }}\nmass = \"Q\"\n\
             center_of_mass = [1, 0, 0]\ninertia = {{ xx = 1, yy = 1, zz = 1 }}\n"
        )
    };
    let text = format!(
        "format = 1\n[robot]\nname = \"arm\"\n[parameters]\nQ = 1\n{}{}",
        link("a"),
        link("b")
    );
    let path = folder("taken-letter").join("arm.toml");
    std::fs::write(&path, text).unwrap();
    let grouped = ["equations", path.to_str().unwrap(), "--form", "grouped", "--format", "latex"];
    let shown = complaint(1, &grouped, "");
    assert!(
        shown
            .ends_with("choose another letter for the joint torques or the matrices (--letters)\n"),
        "{shown}"
    );
    output(&[&grouped[..], &["--letters", "tau,M,C,g"]].concat(), "");
}

/// The remedy for equations that are too long is an option that can be added to the command.
#[test]
fn the_remedy_for_a_long_style_is_another_form() {
    let shown = complaint(1, &["equations", &robot("panda"), "--style", "paper"], "");
    let remedy = "choose the form `grouped`, `recursive` or `compact` (--form, without --style)\n";
    assert!(shown.ends_with(remedy), "{shown}");
    // The remedy is said once, and the form that was asked for is named.
    let shown = complaint(1, &["equations", &robot("panda"), "--form", "collected"], "");
    assert!(shown.contains("in the forms `expanded` and `collected`"), "{shown}");
    assert!(shown.ends_with("`recursive` or `compact` (--form)\n"), "{shown}");
    let path = folder("long-like").join("one.printed");
    std::fs::write(&path, "(1) Q7 = qdd7 + qdd6\n").unwrap();
    let arguments = ["equations", &robot("panda"), "--like", path.to_str().unwrap()];
    let shown = complaint(1, &arguments, "");
    assert!(shown.contains("(--form, without --like)"), "{shown}");
}
