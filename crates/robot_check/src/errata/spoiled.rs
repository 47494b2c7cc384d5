//! Compares the messages about corrupted equations, and the translation of LaTeX, with committed texts: `spoiled.txt`,
//! `read.txt`.

use std::fmt::Write as _;

use super::latex::{symbol_key, to_infix};
use super::tests::{compared, robot};
use super::*;
use crate::tests::assert_snapshot;

/// The terms of the second equation of the planar arm, which is also the moment in its second joint.
const TERMS: [&str; 8] = [
    "-m2*g*r2*sin(q1)*sin(q2)",
    "m2*g*r2*cos(q1)*cos(q2)",
    "m2*l1*r2*sin(q2)*qd1^2",
    "m2*l1*r2*cos(q2)*qdd1",
    "m2*r2^2*qdd1",
    "m2*r2^2*qdd2",
    "I2*qdd1",
    "I2*qdd2",
];

/// Factors that may replace another one.
const OTHERS: [&str; 8] = ["", "qd1", "qdd1", "m1", "r2", "sin(q2)", "cos(q1)", "k7"];

/// Other printed equations, some of which contain terms like those of [`TERMS`] and other mistakes.
const BESIDE: &str = "(3) F2.y = m2*r2*qdd1 + m2*r2*qdd2 - m2*l1*cos(q2)*qdd1 + m2*g*cos(q1)*cos(q2)\n\
    (4) Q1 = m2*l1*r2*cos(q2)*qdd1*g + I2*qdd1*qd2 + 2*I2*qdd2\n\
    M_c2.z = I2*qdd1 + I2*qdd2\n(5) M_l2.z = Q2\n";

/// Corrupted versions of a term: without a factor, with a factor replaced or squared, and so on.
fn spoiled(term: &str) -> Vec<String> {
    let (sign, bare) = match term.strip_prefix('-') {
        Some(bare) => ("-", bare),
        None => ("", term),
    };
    let parts: Vec<&str> = bare.split('*').collect();
    let mut all = vec![
        String::new(),
        format!("-({term})"),
        format!("3*({term})"),
        format!("({term})/2"),
        format!("{term} + {term}"),
        format!("({term})*qd1"),
        format!("({term})/l1"),
    ];
    for place in 0..parts.len() {
        let with = |other: &str| {
            let mut parts = parts.clone();
            parts[place] = other;
            parts.retain(|part| !part.is_empty());
            let product = if parts.is_empty() { "1".to_owned() } else { parts.join("*") };
            format!("{sign}{product}")
        };
        all.extend(OTHERS.into_iter().filter(|other| *other != parts[place]).map(with));
        all.push(with(&format!("{0}*{0}", parts[place])));
    }
    all
}

/// The messages about the equation with the number 2.
fn messages(text: &str) -> String {
    let found = compared(&robot("planar_2r"), text).unwrap_or_else(|error| panic!("{text}{error}"));
    let mut shown = String::new();
    for one in found.differences.into_iter().filter(|one| one.number == "2") {
        let mistakes: Vec<String> = one.mistakes.iter().map(ToString::to_string).collect();
        let of = |text: Option<String>| text.unwrap_or("none".to_owned());
        let [printed, derived, nearest] = [one.printed, one.derived, one.nearest].map(of);
        let (quantity, line, mistakes) = (one.quantity, one.line, mistakes.join(", "));
        let _ = writeln!(
            shown,
            "  {quantity}, line {line}: {printed} for {derived}, nearest {nearest}: {mistakes}"
        );
        for evidence in one.evidence {
            let _ = writeln!(shown, "    {evidence}");
        }
    }
    shown
}

#[test]
fn messages_about_spoiled_terms() {
    let mut shown = String::new();
    for (place, term) in TERMS.iter().enumerate().filter(|(place, _)| [0, 2, 3, 5].contains(place))
    {
        for (number, wrong) in spoiled(term).into_iter().enumerate() {
            let mut own: Vec<&str> = TERMS.to_vec();
            own[place] = &wrong;
            own.retain(|term| !term.is_empty());
            // A sign after another sign is not a valid formula.
            let text = format!("# As printed.\n(2) Q2 = {}\n{BESIDE}", own.join("\n  + "));
            let text = text.replace("+ -", "- ");
            let _ = write!(shown, "{term} as {wrong}\n{}", messages(&text));
            if number < 4 {
                let whole =
                    format!("(6) M_l2.z = {}\n{text}", TERMS.join(" + ")).replace("+ -", "- ");
                let _ = write!(shown, "  with the same term elsewhere\n{}", messages(&whole));
            }
        }
    }
    assert_snapshot("errata/spoiled.txt", &shown);
}

/// Tests the counts of one comparison, and the number of differences of each equation.
#[test]
fn what_is_counted() {
    let found = compared(&robot("planar_2r"), BESIDE).unwrap();
    let by_equation =
        |quantity: &str| found.differences.iter().filter(|one| one.quantity == quantity).count();
    assert_eq!((found.equations, found.names, found.terms, found.wrench), (4, 1, 9, false));
    assert_eq!((by_equation("M_c2.z"), by_equation("M_l2.z")), (0, 0));
    assert!(by_equation("F2.y") > 0 && by_equation("Q1") > 0);
    let wrench = compared(&robot("planar_2r"), "F_l2.y = Fy\n").unwrap();
    assert!(wrench.wrench);
}

/// Texts whose arrangement is read: the quantity, the number and the terms of each equation.
const ARRANGED: &[&str] = &[
    "Q1 = a\n(2) Q2 = b - c\n  + d\n# no\nQ3 = (a - b)*c + sin(a + b) - 1e-3*d\n",
    "( 7 ) Q1 = a +b -c\r\n\tcontinued + d\r\n",
    "\\[ Q_1 = a \\]",
    "$$ Q_1 = a $$ text $$ Q_2 = b $$",
    "\\begin{equation} Q_1 = a \\tag{5a} \\end{equation} prose = none",
    "\\begin{equation*}\\label{x} Q_1 = a + % not b\n b \\end{equation*}",
    "\\begin{gather} Q_1 = a \\\\ Q_2 = b, \\\\* Q_3 = c; \\end{gather}",
    "\\begin{multline} Q_1 = a + b \\\\ - c - d \\\\[2pt] + e. \\end{multline}",
    "\\begin{eqnarray} Q_1 &=& a \\nonumber \\\\ && + b \\end{eqnarray}",
    "\\begin{alignat}{2} Q_1 &= a \\quad & Q \\\\ Q_2 &= b \\end{alignat}",
    "\\begin{flalign*} Q_1 &= a \\tag*{(9)} \\\\[3mm] Q_2 &= 50\\% \\end{flalign*}",
    "\\begin{equation} \\begin{split} Q_1 &= a \\\\ &+ b \\end{split} \\end{equation}",
    "\\begin{align} \\begin{aligned} Q_1 = a \\end{aligned} \\\\ \\begin{gathered} Q_2 = b \\end{gathered} \\end{align}",
    "\\[ F_1^1 = \\begin{pmatrix} a \\\\ b \\\\ c \\end{pmatrix} \\]",
    "\\[ \\bar F_{1}^{1} = \\left[ \\begin{array}{c} a \\\\[1ex] \\frac{b}{c} \\\\ -c \\\\ \\end{array} \\right], \\]",
    "\\[ F_1^1 = \\begin{bmatrix} a \\\\ b \\end{bmatrix} \\]",
    "\\[ \\tau = \\begin{bmatrix} a \\\\ b \\\\ c \\end{bmatrix} \\]",
    "\\[ M(q) = \\begin{bmatrix} a & b \\\\ b & c \\\\ c & a \\end{bmatrix} \\]",
    "\\[ \\tau_1 - a = 0 \\]",
    "\\[ F_1^1 = \\begin{bmatrix} a \\\\ b \\\\ c \\]",
    "\\[ F_1^1 = 2 \\begin{bmatrix} a \\\\ b \\\\ c \\end{bmatrix} \\]",
    "\\begin{align} Q_1 = a \\end{align} \\begin{align} \\phantom{Q_1} + b \\\\ Q_2 = c \\end{align}",
    "\\begin{displaymath} (3) \\tau_{1} = a + \\\\ + b \\end{displaymath}",
    "\\begin{align} Q_1 = a",
    "\\begin{align} = a \\end{align}",
    "\\begin{align} Q_1 \\end{align}",
    "\\begin{align} Q_1 = \\end{align}",
    "Q_1 = a \\cdot b\n(4) Q_2 = c\n  \\ddot q_1",
    "= a\n",
    "Q1 Q2 = a\n",
    "Q1 = a b\n",
    "Q1 = a*(b\n",
    "Q1 = 2..5 + 1e+2 - 1E-2*a - .5\n",
];

/// Formulas as in papers.
const FORMULAS: &[&str] = &[
    "a_1 b_{2} c^2 d^{-3}",
    "\\frac{a}{b}^2 \\dfrac12 \\tfrac{1}{2}a \\frac1{23}",
    "\\sqrt{a b}^2 \\sqrt a",
    "\\left( a + b \\right)^2 \\bigl[ c \\bigr] \\{d\\} \\lvert e \\rvert \\left| f \\right|",
    "\\sin^2 q_1 \\cos(q_1 - q_2) \\tan\\left(q_1\\right) \\tanh{x} \\sgn x \\sin 2 q_1 \\sin 2",
    "s_1 c_2 s_{12} c_{1-2} s_{-1} s_{1,2} c_{10,2} s_{\\alpha} c^2_2 s_2^{2}",
    "s q_1 c q_2 sq_3 s^2q_4 c(q_1) s \\left( q_1 \\right)",
    "\\dot q_1^2 \\ddot{q}_{12} {\\dot q}_3 \\dot{\\theta}_1 \\dddot q_1",
    "M_{1x}^* J_{xx}^{*3} \\mathbf{x}_1 \\mathrm{ab}_c \\bm v \\text{mass} \\hat k \\vec{r}_1",
    "a + \\\\ + b - \\\\ c - \\\\ - d \\\\ + e + \\\\ - f",
    "a \\cdot b \\times c \\ast d * e / f",
    "a {} b \\, c \\; d ~ e & f \\quad g \\displaystyle h",
    "+ a - + b",
    "2 a 3 b 1.5 c 10^{-3}",
    "\\pi \\alpha_1 \\Omega \\lambda^2",
    "\\operatorname{sin} a \\operatorname{sgn}(b) \\mathop{cos} c",
    "\\operatorname{max} a",
    "a^{x}",
    "a^2^3",
    "(a)^2^3",
    "a_1_2",
    "a^",
    "a_",
    "a_12",
    "\\frac{a}",
    "\\sqrt",
    "( a",
    "a )",
    "{ a",
    "a }",
    "\\left( a",
    "\\unknown{a}",
    "a ! b",
    "\\sin q_1^2",
    "\\sin",
    "\\dot",
    "a @ b",
    "|a|",
    "\\lvert a",
    "x_{a b}^{c} \\_ y",
    "\\left",
    "\\frac a b \\frac ab",
    "1e3 a",
    "a = b",
];

#[test]
fn how_latex_is_read() {
    let mut shown = String::new();
    let robot = robot("planar_2r");
    let names = |key: &str| match key {
        "J_xx^*3" => Some("Jxx3".to_owned()),
        "\\dotq_1" => Some("qd1".to_owned()),
        "\\ddotq_12" => Some("qdd12".to_owned()),
        "c_2" => None,
        _ => None,
    };
    for formula in FORMULAS {
        let _ = match to_infix(formula, &names) {
            Ok(infix) => {
                let text = infix.text();
                let place = |place: usize| &formula[infix.source(&(place..place + 1))];
                let middle = (0..=text.len() / 2).rev().find(|at| text.is_char_boundary(*at));
                let middle = middle.unwrap_or_default();
                let (first, last) = (place(0), place(text.len().saturating_sub(1)));
                writeln!(
                    shown,
                    "{formula}\n  {text}\n  `{first}`, `{}`, `{last}`; {}",
                    place(middle),
                    symbol_key(formula)
                )
            }
            Err(error) => writeln!(
                shown,
                "{formula}\n  error at `{}` {:?}: {}; {}",
                &formula[error.span.clone()],
                error.span,
                error.message,
                error.help.unwrap_or_default()
            ),
        };
    }
    let options = Options::default();
    let graph = Graph::new();
    let mechanism = Mechanism::new(&robot, &graph, &MechanismOptions::EXACT);
    for text in ARRANGED {
        let source = Source { name: "printed".to_owned(), text: (*text).to_owned() };
        let _ = writeln!(shown, "{text}");
        match read(&robot, &source, &options, &mechanism) {
            Ok((equations, _)) => {
                for one in equations {
                    let terms: Vec<&str> = one.terms.iter().map(Formula::text).collect();
                    let left = &text[one.span.clone()];
                    let (number, quantity) = (one.number, one.quantity);
                    let _ = writeln!(shown, "  `{left}` ({number}) {quantity}: {terms:?}");
                }
            }
            Err(errors) => {
                let errors = Diagnostics::new(source.clone(), errors);
                let _ = writeln!(shown, "{errors}");
            }
        }
    }
    assert_snapshot("errata/read.txt", &shown);
}
