use robot_document::math::Math;
use robot_document::{SymbolTable, Trigonometry, latex};
use robot_symbolic::formula::MAX_DEPTH;
use robot_symbolic::{Formula, Graph, Random, polynomial};

use super::{symbol_key, to_infix};

const NAMES: [(&str, &str); 6] = [
    (r"J_x^{*5}", "Jx5"),
    (r"F_{l_x}^6", "Fx6"),
    (r"F_{l_y}^{5}", "F_l5.y"),
    (r"\mathrm{payload}", "payload"),
    (r"v_{\mathrm{max}}", "v_max"),
    (r"\bar{c}_2", "c_bar"),
];

fn names(key: &str) -> Option<String> {
    let motions = ["q", "qd", "qdd"].map(|prefix| (1..13).map(move |n| format!("{prefix}{n}")));
    let spelt = motions.into_iter().flatten().chain(["l6", "M5", "g"].map(str::to_owned));
    let mut spelt = spelt.map(|name| (latex::formula(&Math::spelled(&name)), name));
    let given = NAMES.map(|(latex, name)| (latex.to_owned(), name.to_owned()));
    let found = spelt.find(|(latex, _)| symbol_key(latex) == key);
    found.or(given.into_iter().find(|(latex, _)| symbol_key(latex) == key)).map(|(_, name)| name)
}

fn infix(latex: &str) -> String {
    let infix = to_infix(latex, &names).unwrap_or_else(|error| panic!("{latex}: {error:?}"));
    Formula::parse_with_dots(infix.text()).unwrap_or_else(|error| panic!("{latex}: {error:?}"));
    infix.text().to_owned()
}

#[test]
fn what_papers_print_is_read() {
    for (latex, text) in [
        (r"M_5\,sq_2 \ddot{q}_1", "M5*sin(q2)*qdd1"),
        (r"c^2q_5 J_x^{*5} \dot q_2^2", "cos(q5)^2*Jx5*qd2^2"),
        (r"l_6 F_{l_x}^6 - l_6\cdot F_{l_y}^{5}", "l6*Fx6-l6*F_l5.y"),
        (r"2 s_2 c_{23}^{2} s_{2-3} c_{2,10}", "2*sin(q2)*cos(q2+q3)^2*sin(q2-q3)*cos(q2+q10)"),
        (r"\sin q_2 \cos^{2}\left(q_2 + q_3\right)", "sin(q2)*cos(q2+q3)^2"),
        (r"\sin 2q_2 + \sin\left(q_1\right)", "sin(2*q2)+sin(q1)"),
        (r"s(q_2+q_3) s_{\theta} s_{2 q_1}", "sin(q2+q3)*sin(theta)*sin(2*q1)"),
        (r"\frac{1}{3} q_1 + \frac12 q_2", "((1)/(3))*q1+((1)/(2))*q2"),
        (
            r"\sqrt{q_1} \left|q_1\right| \operatorname{sgn}\left(\dot{q}_1\right)",
            "sqrt(q1)*abs(q1)*sign(qd1)",
        ),
        (r"a + \\ &\quad + b - \\ - c", "a+b-c"),
        (r"- \Bigl[ {q_1} - (q_2) \Bigr]^{2}", "-((q1)-(q2))^2"),
        (r"k_3 \mu_{ab}^{-2} \mathrm{payload} v_{\mathrm{max}}", "k3*muab^(-2)*payload*v_max"),
        (r"\bar c_2 c_2 {\ddot q}_{1}", "c_bar*cos(q2)*qdd1"),
        (r"1.5 \cdot 10^{-3} g \pi", "1.5*10^(-3)*g*pi"),
        (r"\tan g \tanh^2 g \sgn g \operatorname{tan} g", "tan(g)*tanh(g)^2*sign(g)*tan(g)"),
        (r"\mathrm{sgn} g \mathrm{sin}^2 q_1 \text{cos} q_1", "sign(g)*sin(q1)^2*cos(q1)"),
        (r"\overrightarrow{g} \bm{g} \textit{l}_6", "overrightarrowg*g*l6"),
    ] {
        assert_eq!(
            infix(latex)
                .replace("((q1))", "(q1)")
                .replace("((q2+q3))", "(q2+q3)")
                .replace("((qd1))", "(qd1)"),
            text,
            "{latex}"
        );
    }
}

#[test]
fn keys_tell_symbols_apart() {
    let read = |latex: &str| to_infix(latex, &|_| None).unwrap().text().to_owned();
    for (one, other) in
        [("m_1", "m_1^*"), ("m_1^*", "m_1^+"), ("m_1^+", "m_1^-"), ("m_{1}", r"\bar m_1")]
    {
        assert_ne!(read(one), read(other));
    }
    assert_eq!(read("F_{l_6}"), "Fl6");
    assert_eq!(symbol_key(r"F_{l_x}^{5}"), "F_l_x^5");
    assert_eq!(symbol_key(r"\ddot{q}_{1}"), symbol_key(r"\ddot q_1"));
}

#[test]
fn errors_name_their_place() {
    for (latex, place, part) in [
        (r"q_1 + \foo q_2", r"\foo", "is not supported here"),
        (r"q_1 (q_2 + q_3", "q_2 + q_3".split(' ').next().unwrap(), "not closed"),
        (r"l_6 q_10", "10", "without braces"),
        (r"\sin q_2^2", "q_2^2", "a power of the function"),
        (r"\sin^{-1} q_2", "^{-1}", "the inverse function or a quotient?"),
        (r"0{,}5 q_2", ",", "is not supported here"),
        (r"q_1^{a}^2", "^", "second subscript"),
        (r"(q_1)^{x}", "^{x}", "integer"),
        // The operators of an exponent or an index are not lost: none of these is m_{12} or q_{12}.
        (r"m_1^{2-}", "^{2-}", "integer"),
        (r"m_1^{(2)}", "^{(2)}", "integer"),
        (r"m_1^{4/2}", "^{4/2}", "integer"),
        (r"q_1^{2^{3}}", "^{2^{3}}", "integer"),
        (r"m_1^{2_3}", "^{2_3}", "integer"),
        (r"m_{1-2}", "_{1-2}", "not the index"),
        (r"m_{1^2}", "_{1^2}", "not the index"),
        (r"\cos q_{1-2}", "_{1-2}", "not the index"),
        (r"q_1 é", "é", "is not supported here"),
        (r"\sqrt[3]{q_1}", "[", "a root with an index"),
        (r"q_1 \pm q_2", r"\pm", "is not supported here"),
        (r"m_1 \circ q_2", r"\circ", "is not supported here"),
        (r"q_2 + 1\,000 q_1", "000", "a number follows a number"),
        (r"2 3 q_1", "3", "a number follows a number"),
        (r"m_1/2 q_1", "q_1", "a factor without a sign follows a divisor"),
        (r"\frac{1}", "", "incomplete"),
        (r"\frac{d}{dt}(m_1 \dot q_1)", r"\frac{d}{dt}", "derivatives are not read"),
        (
            r"\frac{\mathrm{d}^2 q_1}{\mathrm dt^2}",
            r"\frac{\mathrm{d}^2 q_1}{\mathrm dt^2}",
            "derivatives",
        ),
        (r"q_1 \quad \text{gravity last}", r"\text{gravity last}", "words are not a factor"),
        (r"q_1 \text{(1)}", r"\text{(1)}", "words are not a factor"),
        (r"{\rm cos} q_1", r"\rm cos", "only before one letter"),
        (r"g {\rm m2}", r"\rm m2", "only before one letter"),
        (r"{\rm 2} g", r"\rm 2", "only before one letter"),
        (r"q_1 {\rm +} g", r"\rm", "only before one letter"),
        (r"\mathrm{2} g", r"\mathrm{2}", "around a number or a sign"),
        (r"q_1 \mathrm{+} g", r"\mathrm{+}", "around a number or a sign"),
        (r"a_{b", "{", "not closed"),
        (r"q_1 = 2", "=", "is not supported here"),
    ] {
        let error = to_infix(latex, &names).unwrap_err();
        assert!(error.message.contains(part), "{latex}: {error:?}");
        let found = &latex[error.span.clone()];
        assert!(
            found == place || latex.rfind(place) == Some(error.span.start),
            "{latex}: {error:?}"
        );
        assert!(error.help.is_some());
    }
    let infix = to_infix(r"q_1 + 1 \cdot / q_2", &names).unwrap();
    let error = Formula::parse_with_dots(infix.text()).unwrap_err();
    assert_eq!(infix.source(&error.span), 14..15);
}

#[test]
fn what_is_printed_reads_back() {
    let graph = Graph::new();
    let texts = [
        "M5*sin(q2)*qdd1 - qd2^2*l6/3",
        "-Jx5*cos(q5)^2*(q1 + l6*(q2 - q3))^3/(q4 + 2)",
        "cos(q2 + q3)*sin(2*q1 - q3)^2*sin(q10)",
        "abs(qd1)*sign(qd2)*tanh(qd1/v_max) + sqrt(q1 + 1)*pi",
        "Fx6*payload^2*Jx5^2",
    ];
    for text in texts {
        let expr = graph.parse(text).unwrap();
        for trigonometry in [Trigonometry::Named, Trigonometry::Short, Trigonometry::Paper] {
            let mut table = SymbolTable::spelled(trigonometry);
            for (look, name) in NAMES {
                table.define(name, latex::read(look).unwrap()).unwrap();
            }
            let latex = latex::formula(&table.expression(expr).unwrap());
            let read = graph.parse(&infix(&latex)).unwrap();
            assert!(polynomial::equal(read, expr).unwrap(), "{text}: {latex}");
        }
    }
}

#[test]
fn hostile_text_ends_in_an_error_or_a_formula() {
    let deep = [r"\frac", r"\sqrt", r"\sin ", "(", "{", r"\left(", r"\dot", "s", "c^2", r"\mathrm"];
    for part in deep {
        let error = to_infix(&part.repeat(50_000), &names).unwrap_err();
        assert!(error.span.end <= part.len() * 50_000);
    }
    for part in [r"\left", "x_{", "^", "_", "}", r"\\", "+", "q_1"] {
        let _ = to_infix(&part.repeat(90_000), &names).map(|infix| infix.text().len());
    }
    let parts = [
        r"\frac", "{", "}", "^", "_", "q", "1", "2", r"\sin", r"\left", r"\right", "(", ")", "s",
        "c", r"\dot", r"\\", "+", "-", "é", "\u{202e}", r"\", "&", "*", " ", "|", r"\mathrm", "=",
        ".",
    ];
    for seed in 0..3000 {
        let mut random = Random::new(seed);
        let latex: String =
            (0..random.index(30)).map(|_| parts[random.index(parts.len())]).collect();
        match to_infix(&latex, &names) {
            Ok(infix) => {
                if let Err(error) = Formula::parse_with_dots(infix.text()) {
                    assert!(latex.get(infix.source(&error.span)).is_some(), "seed {seed}: {latex}");
                }
            }
            Err(error) => assert!(latex.get(error.span).is_some(), "seed {seed}: {latex}"),
        }
    }
}

/// The depth of a formula depends on the nesting of brackets and arguments, not on their number.
#[test]
fn a_long_formula_is_not_a_deep_one() {
    for part in [r"\sin q_1", r"\cos(q_1)", "(q_1)", r"\frac{q_1}{q_2}", r"q_1 \left[ q_2 \right]"]
    {
        let sum = vec![part; 2000].join(" + ");
        let read = to_infix(&sum, &names);
        assert!(read.is_ok(), "{part}: {:?}", read.err());
    }
    let deep = format!("{}q_1{}", "(".repeat(2000), ")".repeat(2000));
    assert!(to_infix(&deep, &names).unwrap_err().message.contains("nested deeper"));
}

/// As many levels as are allowed are read, the sum itself among them, and one more is not.
#[test]
fn the_deepest_formula_is_read() {
    let brackets = |count: usize| format!("{}q_1{}", "(".repeat(count), ")".repeat(count));
    let roots = |count: usize| format!("{}q_1{}", r"\sqrt{".repeat(count), "}".repeat(count));
    assert!(to_infix(&brackets(MAX_DEPTH - 1), &names).is_ok());
    assert!(to_infix(&brackets(MAX_DEPTH), &names).is_err());
    // An argument is a level, and the sum in it another.
    assert!(to_infix(&roots((MAX_DEPTH - 1) / 2), &names).is_ok());
    assert!(to_infix(&roots(MAX_DEPTH / 2), &names).is_err());
}
