//! Checks the text of the paper against itself. With the 34 terms of `docs/trttr1.md` replaced, its equations satisfy
//! the paper's own relations; if any one of these terms is not replaced, a relation that the table names fails. Of the
//! derivation, only the replacement terms are used.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Matrix3, Vector3};
use robot_numeric::random::Random;
use robot_symbolic::Graph;

/// The maximum difference of the two sides of an equation whose values are about 1.
const TOLERANCE: f64 = 1e-9;

fn project(file: &str) -> String {
    std::fs::read_to_string(format!("{}/../../{file}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// A value for a symbol, derived from its name.
fn value(symbol: &str) -> f64 {
    let seed = symbol.bytes().fold(7, |seed, byte| 31 * seed + u64::from(byte));
    Random::new(seed).uniform(0.3, 1.7)
}

/// The value of an expression in infix notation, in which `F_l5.y` would not be a valid name.
fn evaluate(text: &str) -> f64 {
    let graph = Graph::new();
    let expr = graph.parse(&text.replace("F_l5.y", "Fl5y")).unwrap();
    expr.evaluate(|symbol| value(&graph.symbol_name(symbol)))
}

/// The right sides of the paper's equations by number and quantity, such as `(39) M_l4.z`.
fn equations() -> Vec<(String, String)> {
    let mut equations: Vec<(String, String)> = vec![];
    for line in project("docs/trttr1.printed").lines() {
        match line.split_once(" = ") {
            _ if line.starts_with('#') => {}
            Some((name, terms)) if line.starts_with('(') => {
                equations.push((name.to_owned(), terms.to_owned()));
            }
            _ => equations.last_mut().into_iter().for_each(|(_, terms)| terms.push_str(line)),
        }
    }
    equations
}

/// A difference in `docs/trttr1.md` with its grade.
struct Grade {
    equation: String,
    printed: String,
    derived: String,
    relations: String,
}

fn grades() -> Vec<Grade> {
    let page = project("docs/trttr1.md");
    let (mut grades, mut equation, mut printed, mut derived) = (vec![], "", "", "");
    for line in page.lines().filter(|line| line.starts_with("| ")) {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        match cells[..] {
            ["printed", term] => printed = term,
            ["derived", term] => derived = term,
            ["grade", grade] => grades.push(Grade {
                equation: equation.to_owned(),
                printed: infix(printed),
                derived: infix(derived),
                relations: grade.split_once("contradicted by ").unwrap().1.to_owned(),
            }),
            [name, _] if name.starts_with('(') => equation = name,
            _ => {}
        }
    }
    grades
}

/// A typeset term as infix text: ``$`-\dot{q}_2^{2} \, l_5`$`` is `-qd2^2*l5`.
fn infix(term: &str) -> String {
    let Some(latex) = term.strip_prefix("$`").and_then(|rest| rest.strip_suffix("`$")) else {
        assert_eq!(term, "—");
        return "0".to_owned();
    };
    let latex = latex.replace(r"\textcolor{red}", "").replace(r"\textcolor{teal}", "");
    let kept = |factor: &str| -> String {
        factor.chars().filter(|sign| !r"\{}_* +".contains(*sign)).collect()
    };
    let factors: Vec<String> = latex.split(r" \, ").map(kept).collect();
    let (sign, first) = match factors[0].strip_prefix('-') {
        Some(first) => ("-", first),
        None => ("", &*factors[0]),
    };
    let rest = factors[1..].iter().map(String::as_str);
    let factors: Vec<String> = std::iter::once(first).chain(rest).map(factor).collect();
    format!("{sign}{}", factors.join("*"))
}

/// A factor without the marks of LaTeX as infix text: `cos^2q5` is `cos(q5)^2`, and `Fly^6` is `Fy6`.
fn factor(text: &str) -> String {
    if text.starts_with("sin") || text.starts_with("cos") {
        let (function, power) = text.split_once('q').map(|(head, _)| head.split_at(3)).unwrap();
        let angle = &text[3 + power.len()..];
        return format!("{function}({angle}){power}");
    }
    let (base, upper) = text.split_once('^').unwrap_or((text, ""));
    match base.as_bytes() {
        [b'J', _] => format!("{base}{upper}"),
        [letter, b'l', axis] => {
            let (letter, axis) = (char::from(*letter), char::from(*axis));
            match upper {
                "6" => format!("{letter}{axis}6"),
                _ => format!("{letter}_l{upper}.{axis}"),
            }
        }
        _ => text.replace("ddotq", "qdd").replace("dotq", "qd"),
    }
}

/// The values of the paper's equations, with some terms corrected.
#[derive(Default)]
struct Text {
    quantities: BTreeMap<String, f64>,
    /// Values by equation number, for quantities that the paper prints twice, such as `(53) Q1` in addition to
    /// `(52) Q1`.
    numbered: BTreeMap<String, f64>,
    failed: BTreeSet<String>,
}

impl Text {
    /// Computes the values; equations that refer to other quantities by name are left to [`Text::check`].
    fn new(corrections: &[&Grade]) -> Text {
        let mut text = Text::default();
        for (name, terms) in equations() {
            let (_, quantity) = name.split_once(' ').unwrap();
            if !terms.contains(['*', '+']) && terms.contains("_l") {
                continue;
            }
            let mut value = evaluate(&terms);
            for grade in corrections.iter().filter(|grade| grade.equation == name) {
                value += evaluate(&grade.derived) - evaluate(&grade.printed);
            }
            text.quantities.insert(quantity.to_owned(), value);
            text.numbered.insert(name, value);
        }
        text
    }

    fn vector(&self, name: &str) -> Vector3<f64> {
        Vector3::from(["x", "y", "z"].map(|axis| self.quantities[&format!("{name}.{axis}")]))
    }

    fn compare(&mut self, relation: &str, left: &[f64], right: &[f64]) {
        if left.iter().zip(right).any(|(a, b)| (a - b).abs() > TOLERANCE) {
            self.failed.insert(relation.to_owned());
        }
    }

    fn compare_vector(&mut self, relation: &str, left: &str, right: Vector3<f64>) {
        let left = self.vector(left);
        self.compare(relation, left.as_slice(), right.as_slice());
    }

    /// Returns the relations that do not hold.
    fn check(mut self) -> BTreeSet<String> {
        let [q2, q5] = ["q2", "q5"].map(value);
        let [about_z, about_y] = [
            Matrix3::new(q2.cos(), -q2.sin(), 0.0, q2.sin(), q2.cos(), 0.0, 0.0, 0.0, 1.0),
            Matrix3::new(q5.cos(), 0.0, q5.sin(), 0.0, 1.0, 0.0, -q5.sin(), 0.0, q5.cos()),
        ];
        let one = Matrix3::identity();
        for (index, relation) in (1..).zip(["(14)", "(15)", "(16)", "(17)", "(18)"]) {
            let mass = value(&format!("M{index}"));
            let force = self.vector(&format!("a_c{index}")) * mass;
            self.compare_vector(relation, &format!("F{index}"), force);
        }
        let tip = Vector3::from(["Fx6", "Fy6", "Fz6"].map(value));
        let tip_moment = Vector3::from(["Mx6", "My6", "Mz6"].map(value));
        let reach = value("q4") + value("l4");
        let height = value("q3") + value("l2");
        // For each link: its relations, the rotation from the next link's axes, and the position r of the next link.
        let links = [
            (5, "(26)", "(36)", one, Vector3::new(value("l6"), 0.0, 0.0)),
            (4, "(27)", "(38)", about_y, Vector3::new(value("l5"), 0.0, 0.0)),
            (3, "(28)", "(40)", one, Vector3::new(reach, 0.0, value("l3"))),
            (2, "(29)", "(44)", one, Vector3::new(0.0, 0.0, height)),
            (1, "(30)", "(48)", about_z, Vector3::new(0.0, 0.0, value("l1"))),
        ];
        for (link, of_forces, of_moments, turn, r) in links {
            let (force, moment) = match link {
                5 => (tip, tip_moment),
                _ => (
                    self.vector(&format!("F_l{}", link + 1)),
                    self.vector(&format!("M_l{}", link + 1)),
                ),
            };
            let own = (self.vector(&format!("F{link}")), self.vector(&format!("M_c{link}")));
            self.compare_vector(of_forces, &format!("F_l{link}"), turn * force + own.0);
            let sum = turn * moment + r.cross(&(turn * force)) + own.1;
            self.compare_vector(of_moments, &format!("M_l{link}"), sum);
        }
        let driving = [
            ("(52)", "(53) Q1", "F_l1.y"),
            ("(54)", "(55) Q2", "M_l2.z"),
            ("(56)", "(57) Q3", "F_l3.z"),
            ("(58)", "(59) Q4", "F_l4.x"),
            ("(60)", "(61) Q5", "M_l5.y"),
        ];
        for (relation, driving, component) in driving {
            let (left, right) = (self.numbered[driving], self.quantities[component]);
            self.compare(relation, &[left], &[right]);
        }
        self.failed
    }
}

/// The relations that do not hold if all terms, or all except one, are replaced.
fn failures(grades: &[Grade], but: Option<usize>) -> BTreeSet<String> {
    let others = grades.iter().enumerate().filter(|(index, _)| Some(*index) != but);
    let corrections: Vec<&Grade> = others.map(|(_, grade)| grade).collect();
    Text::new(&corrections).check()
}

#[test]
fn with_all_terms_replaced_the_text_satisfies_its_own_relations() {
    assert_eq!(failures(&grades(), None), BTreeSet::new());
}

#[test]
fn each_term_left_fails_a_relation_named_beside_it() {
    let grades = grades();
    assert_eq!(grades.len(), 34);
    for (index, grade) in grades.iter().enumerate() {
        let failed = failures(&grades, Some(index));
        let named = failed.iter().any(|relation| grade.relations.contains(relation.as_str()));
        let Grade { equation, printed, relations, .. } = grade;
        assert!(named, "{equation} with `{printed}` fails {failed:?}, the page names {relations}");
    }
}
