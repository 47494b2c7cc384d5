use super::*;
use crate::print::default_rank;
use crate::random_expressions::{self as random, Kind, Random};
use crate::{Expr, Graph, Polynomial, PolynomialOptions};

const STYLES: [Trigonometry; 3] = [Trigonometry::Named, Trigonometry::Short, Trigonometry::Paper];

#[test]
fn names_are_spelt() {
    for (name, latex) in [
        ("q2", "q_2"),
        ("qd2", r"\dot{q}_2"),
        ("qdd12", r"\ddot{q}_{12}"),
        ("qd", r"\dot{q}"),
        ("l4", "l_4"),
        ("g", "g"),
        ("M5", "M_5"),
        ("Jx1", "J_{x1}"),
        ("Ixx", "I_{xx}"),
        ("Fx6", "F_{x6}"),
        ("alpha", r"\alpha"),
        ("theta1", r"\theta_1"),
        ("Omega_z", r"\Omega_z"),
        ("v_max", r"v_{\mathrm{max}}"),
        ("F_l5.y", "F_{l5,y}"),
        ("payload", r"\mathrm{payload}"),
        ("payload_x2", r"\mathrm{payload}_{x2}"),
        ("a_theta", r"a_{\theta}"),
    ] {
        assert_eq!(symbol_latex(name), latex, "{name}");
    }
}

#[test]
fn hostile_names_are_harmless() {
    for name in [
        r"\input{/etc/passwd}",
        r"x}\write18{rm}",
        "%",
        "$x$",
        "a&b#c",
        "",
        "_",
        "ä€",
        "x^2",
        "x\n\nend",
        "~",
    ] {
        let latex = symbol_latex(name);
        assert!(!latex.is_empty() && latex.is_ascii(), "{name:?}: {latex}");
        let mut bare = latex.replace(r"\backslash{}", "").replace(r"\mathrm", "");
        for special in ["$", "%", "&", "#", "_", "{", "}"] {
            bare = bare.replace(&format!("\\{special}"), "");
        }
        assert!(!bare.contains(['\\', '$', '%', '&', '#', '~', '\n']), "{name:?}: {latex}");
        assert_eq!(bare.matches('{').count(), bare.matches('}').count(), "{name:?}: {latex}");
        assert!(bare.matches('_').count() <= 1, "{name:?}: {latex}");
        let graph = Graph::new();
        let style = LatexStyle::default();
        assert_eq!(to_latex(graph.symbol(name), &style).unwrap(), latex);
    }
}

#[test]
fn given_names_are_checked() {
    for latex in [
        "q_2",
        r"J_z^{*2}",
        r"\dot{q}_2",
        r"\ddot{q}_{1}",
        r"\bar{\omega}_i^i",
        "x'",
        r"\mathrm{Fx}^{6}",
        r"l_{1,2}",
        r"a^*",
        r"{J_z^{*2}}_x",
    ] {
        assert_eq!(check_name(latex), Ok(()), "{latex}");
    }
    for (latex, span) in [
        ("", 0..0),
        (r"\input{x}", 0..6),
        (r"a\write18", 1..7),
        (r"\", 0..1),
        (r"\é", 0..3),
        ("{x", 0..1),
        ("x}", 1..2),
        ("x$y", 1..2),
        ("x%", 1..2),
        ("x&y", 1..2),
        ("xé", 1..3),
        ("x_", 1..2),
        ("x^", 1..2),
        (r"\dot", 0..4),
        ("x^2^3", 3..4),
        ("x_{a}_b", 5..6),
        ("x'^2", 2..3),
    ] {
        assert_eq!(check_name(latex).expect_err(latex).span, span, "{latex}");
    }
    let graph = Graph::new();
    let given = |name: &str| match name {
        "Jz2" => Some(r"J_z^{*2}".to_owned()),
        "x" => Some(r"\input{x}".to_owned()),
        _ => None,
    };
    let style = LatexStyle::default().with_names(&given);
    let latex = to_latex(graph.parse("Jz2^2*x*y").unwrap(), &style).unwrap();
    assert_eq!(latex, r"\left(J_z^{*2}\right)^{2} x y");
}

fn expression(source: &str, trigonometry: Trigonometry) -> String {
    let graph = Graph::new();
    to_latex(graph.parse(source).unwrap(), &LatexStyle::new(trigonometry)).unwrap()
}

#[test]
fn expressions_are_set() {
    for (source, latex) in [
        ("a + b - (c - d)", r"a + b - \left(c - d\right)"),
        ("a*(b + c)^2", r"a \left(b + c\right)^{2}"),
        ("(a + b)/(2*c)", r"\frac{a + b}{2 c}"),
        ("-a/3 + 2/3", r"\frac{2}{3} - \frac{1}{3} a"),
        ("a*(2*b)", "2 b a"),
        ("sqrt(a)*abs(b)", r"\sqrt{a} \left|b\right|"),
        ("sign(qd1)*tanh(x)", r"\operatorname{sgn}\left(\dot{q}_1\right) \tanh\left(x\right)"),
        ("qd2^2*0.35", r"0.35 \dot{q}_2^{2}"),
        ("pi*x", r"\pi x"),
        ("sin(q2)^2*cos(q3)*x", r"\sin^{2} q_2 \cdot \cos q_3 \cdot x"),
        ("x*sin(q2 + q3)", r"x \sin\left(q_2 + q_3\right)"),
        ("(a/b)^2", r"\left(\frac{a}{b}\right)^{2}"),
    ] {
        assert_eq!(expression(source, Trigonometry::Named), latex, "{source}");
    }
}

#[test]
fn trigonometry_has_three_styles() {
    for (source, styles) in [
        ("sin(q2)", [r"\sin q_2", "s_2", "sq_2"]),
        ("cos(q5)^2", [r"\cos^{2} q_5", "c_5^{2}", "c^{2}q_5"]),
        ("sin(q2 + q3)", [r"\sin\left(q_2 + q_3\right)", "s_{23}", r"s\left(q_2 + q_3\right)"]),
        ("cos(q2 - q3)", [r"\cos\left(q_2 - q_3\right)", "c_{2-3}", r"c\left(q_2 - q_3\right)"]),
        (
            "cos(q9 + q10)",
            [r"\cos\left(q_9 + q_{10}\right)", "c_{9,10}", r"c\left(q_9 + q_{10}\right)"],
        ),
        ("sin(q12)", [r"\sin q_{12}", "s_{q_{12}}", "sq_{12}"]),
        ("sin(theta)", [r"\sin \theta", r"s_{\theta}", r"s\theta"]),
    ] {
        for (style, latex) in STYLES.into_iter().zip(styles) {
            assert_eq!(expression(source, style), latex, "{source} {style:?}");
        }
    }
}

#[test]
fn polynomials_are_sums_of_terms() {
    let graph = Graph::new();
    let source =
        "l4*(M5*sin(q2)*qdd1 - 2*M4*qd2^2)/3 + cos(q5)^2*Jx5 - 1/(2*x) + 0.35/y^2 - 1/(x + y)";
    let expr = graph.parse(source).unwrap();
    let polynomial = Polynomial::of(expr, &PolynomialOptions::default()).unwrap();
    let set =
        |style| polynomial_to_latex(&polynomial, &LatexStyle::new(style), default_rank).unwrap();
    assert_eq!(
        set(Trigonometry::Paper),
        r"\frac{1}{3} l_4 M_5 \ddot{q}_1 sq_2 - \frac{2}{3} l_4 M_4 \dot{q}_2^{2} + J_{x5} c^{2}q_5 - \frac{1}{x + y} + \frac{0.35}{y^{2}} - \frac{0.5}{x}"
    );
    let sines_first = |atom: Expr<'_>| u8::from(atom.as_symbol().is_some());
    let terms = polynomial_terms(&polynomial, &LatexStyle::default(), sines_first).unwrap();
    assert_eq!(terms[0].text, r"\frac{1}{3} \sin q_2 \cdot l_4 M_5 \ddot{q}_1");
    assert!(!terms[0].negative);
    let zero = Polynomial::zero(&graph, &PolynomialOptions::default());
    let terms = polynomial_terms(&zero, &LatexStyle::default(), default_rank).unwrap();
    assert_eq!(terms, [LatexTerm { negative: false, text: "0".to_owned() }]);
}

/// Braces and \left … \right balance, and no superscript follows another, whatever is printed.
#[test]
fn what_is_printed_is_well_formed() {
    for seed in 0..300 {
        let mut random = Random::new(seed);
        let graph = Graph::new();
        let expr = random::expression(&graph, &mut random, Kind::Any, 12);
        let polynomial = Polynomial::of(expr, &PolynomialOptions::default()).unwrap();
        for style in STYLES.map(LatexStyle::new) {
            let whole = to_latex(expr, &style).unwrap();
            let sum = polynomial_to_latex(&polynomial, &style, default_rank).unwrap();
            for latex in [whole, sum] {
                let count = |part: &str| latex.matches(part).count();
                assert_eq!(count("{"), count("}"), "seed {seed}: {latex}");
                assert_eq!(count(r"\left"), count(r"\right"), "seed {seed}: {latex}");
                assert!(!latex.contains("}^{") || !repeated(&latex), "seed {seed}: {latex}");
                assert!(!latex.contains("  "), "seed {seed}: {latex}");
            }
        }
    }
}

/// Whether `^{…}^` occurs.
fn repeated(latex: &str) -> bool {
    latex.match_indices("^{").any(|(start, _)| {
        let rest = &latex[start + 2..];
        let end = rest.find('}').unwrap_or_default();
        rest[end + 1..].starts_with('^')
    })
}
