use super::*;
use crate::random::Random;

fn at(text: &str, values: &[(&str, f64)]) -> f64 {
    let formula = Formula::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let value = |name: &str| {
        let known = values.iter().find(|(known, _)| *known == name);
        known.unwrap_or_else(|| panic!("{name} in {text}")).1
    };
    let direct = formula.evaluate(value);
    let graph = Graph::new();
    let lowered = formula
        .lower(&graph, &mut |name| graph.symbol(name))
        .evaluate(|symbol| value(&graph.symbol_name(symbol)));
    let same = (direct - lowered).abs() <= 1e-14 * direct.abs();
    assert!(same, "{text}: {direct} {lowered}");
    direct
}

#[test]
fn precedence_is_the_usual() {
    let x = &[("x", 3.0)];
    for (text, value) in [
        ("1+2*3", 7.0),
        ("(1+2)*3", 9.0),
        ("8-4-2", 2.0),
        ("8/4/2", 1.0),
        ("8/4*2", 4.0),
        ("-x^2", -9.0),
        ("(-x)^2", 9.0),
        ("2*-x", -6.0),
        ("2 - -x", 5.0),
        ("--x", 3.0),
        ("x^2^3", 6561.0),
        ("x^-2", 1.0 / 9.0),
        ("x^-1*2", 2.0 / 3.0),
        ("x^(1+1)", 9.0),
        ("x^-(6/3)", 1.0 / 9.0),
        ("-x*x-x", -12.0),
        ("2^3*x", 24.0),
        (".5*x + 5.", 6.5),
        ("1.5e1*x", 45.0),
    ] {
        assert_eq!(at(text, x), value, "{text}");
    }
}

#[test]
fn functions_apply() {
    let values = &[("x", 0.3), ("y", -0.4)];
    assert_eq!(at("sin(x)*cos (y)", values), 0.3_f64.sin() * 0.4_f64.cos());
    assert_eq!(at("tan(x)", values), 0.3_f64.tan());
    assert_eq!(at("-abs(y)^2", values), -(0.4 * 0.4));
    assert_eq!(at("sign(y) + tanh(x)", values), 0.3_f64.tanh() - 1.0);
    assert_eq!(at("sqrt(x - y/2)", values), (0.5_f64).sqrt());
    assert_eq!(at("pi/2", values), std::f64::consts::FRAC_PI_2);
}

#[test]
fn constants_are_exact() {
    let number = |text: &str| Formula::parse(text).unwrap().as_number();
    assert_eq!(number("0.1 + 0.2"), number("0.3"));
    assert_eq!(number("1/3"), Rational::new(1, 3).map(Number::Rational));
    assert_eq!(number("-2"), Some(Number::integer(-2)));
    assert_eq!(number("sin(pi/2)"), Some(Number::integer(1)));
    assert_eq!(number("sqrt(9/4)"), number("3/2"));
    assert_eq!(number("pi"), None);
    assert_eq!(number("x - x"), None);
    assert!(number("1/0").unwrap().to_f64().is_nan());
}

#[test]
fn a_formula_of_a_number_is_the_formula_of_its_text() {
    for text in ["0.35", "-0.35", "12"] {
        let value = Rational::from_decimal(text).unwrap();
        assert_eq!(Formula::number(&value), Formula::parse(text).unwrap());
    }
    let third = Rational::new(-1, 3).unwrap();
    assert_eq!(Formula::number(&third).text(), "-1/3");
    assert_eq!(Formula::number(&third).as_number(), Some(Number::Rational(third)));
    assert_eq!(Formula::symbol("l1"), Formula::parse("l1").unwrap());
}

#[test]
fn symbols_come_with_their_places() {
    let text = "l1 + 2*sin( q_2 )*l1 - pi";
    let formula = Formula::parse(text).unwrap();
    let found: Vec<_> = formula.symbols().collect();
    assert_eq!(found, [("l1", 0..2), ("q_2", 12..15), ("l1", 18..20)]);
    assert!(!formula.is_constant());
}

#[test]
fn dotted_names_are_for_printed_equations() {
    let formula = Formula::parse_with_dots("F_l5.y*l6 + 1.5*a_c3.y").unwrap();
    let names: Vec<_> = formula.symbols().map(|(name, _)| name).collect();
    assert_eq!(names, ["F_l5.y", "l6", "a_c3.y"]);
    let error = Formula::parse("F_l5.y*l6").unwrap_err();
    assert_eq!(error.span, 0..5);
}

/// For each text: the bytes in error, a part of the message and a part of the help.
const BROKEN: &[(&str, Range<usize>, &str, &str)] = &[
    ("", 0..0, "found nothing", "l1 + l2/2"),
    ("  ", 0..2, "found nothing", "l1 + l2/2"),
    ("1 +", 2..3, "after `+`, found the end", "complete"),
    ("-", 0..1, "after `-`", "complete"),
    ("(1 + 2", 0..1, "not closed", "add `)`"),
    ("sin(x", 0..4, "not closed", "add `)`"),
    ("1 + 2)", 5..6, "closes nothing", "remove it"),
    ("()", 0..2, "between the parentheses", "write an expression there"),
    ("sin()", 3..5, "between the parentheses", "write an expression there"),
    ("2q", 0..2, "operator between `2` and `q`", "`2*q`"),
    ("a b", 0..3, "operator between `a` and `b`", "`a*b`"),
    ("2(a)", 0..2, "operator between `2` and `(`", "`2*(…)`"),
    ("(a)(b)", 2..4, "operator between `)` and `(`", "`(…)*(…)`"),
    ("(a)b", 2..4, "operator between `)` and `b`", "`(…)*b`"),
    ("a(b)", 0..1, "`a` is not a function", "product write `a*(…)`"),
    ("sine(x)", 0..4, "`sine` is not a function", "did you mean `sin(…)`"),
    ("Cos(x)", 0..3, "`Cos` is not a function", "did you mean `cos(…)`"),
    ("sin q", 0..3, "`(` after the function `sin`", "`sin(…)`"),
    ("1,5", 1..2, "use a decimal point", "`1.5`"),
    ("atan2(y, x)", 0..5, "not a function", "sin, cos, tan"),
    ("(y, x)", 2..3, "`,` has no meaning", "one argument"),
    ("1e999", 0..5, "outside the range", "1.79e308"),
    ("2*1e309", 2..7, "outside the range", "1.79e308"),
    ("1e-399", 0..6, "outside the range", "5e-324"),
    ("1.2.3", 0..5, "`1.2.3` is not a number", "one point"),
    ("1_000", 0..5, "cannot contain `_`", "`1000`"),
    (".", 0..1, "`.` is not a number", "0.35"),
    ("x**2", 1..3, "`**` is not an operator", "`x^2`"),
    ("x^y", 2..3, "integer as the exponent", "sqrt"),
    ("x^(1/2)", 2..7, "integer as the exponent", "sqrt"),
    ("x^0.5", 2..5, "integer as the exponent", "sqrt"),
    ("x^65", 2..4, "exponent 65 is beyond ±64", "product"),
    ("x^99999999999999999999", 2..22, "exponent 99999999999999999999 is beyond ±64", "product"),
    ("x^-99999999999999999999", 2..23, "exponent -99999999999999999999 is beyond ±64", "quotient"),
    ("x^-65", 2..5, "exponent -65 is beyond ±64", "quotient"),
    ("x^(40*2)", 2..8, "exponent 80 is beyond ±64", "product"),
    ("2^-x", 2..4, "integer as the exponent", "sqrt"),
    ("a*/b", 2..3, "found `/`", "operand on both sides"),
    ("+a", 0..1, "found `+`", "leading"),
    ("a ++ b", 3..4, "found `+`", "one of the two signs"),
    ("l₁", 1..4, "`₁` has no meaning", "ASCII"),
    ("2×q", 1..3, "`×` has no meaning", "`a*b`"),
    ("π/2", 0..2, "`π` has no meaning", "`pi`"),
    ("a − b", 2..5, "`−` has no meaning", "keyboard"),
    ("x\u{0}", 1..2, "has no meaning", "ASCII"),
    ("}fn x(){}", 0..1, "`}` has no meaning", "parentheses"),
    ("x; y", 1..2, "`;` has no meaning", "one by one"),
];

#[test]
fn what_is_wrong_is_shown_and_helped() {
    for (text, span, message, help) in BROKEN {
        let error = Formula::parse(text).expect_err(text);
        assert_eq!(error.span, *span, "{text:?}: {error:?}");
        assert!(error.message.contains(message), "{text:?}: {error:?}");
        let found = error.help.clone().unwrap_or_default();
        assert!(found.contains(help), "{text:?}: {error:?}");
        assert!(text.get(error.span.clone()).is_some(), "{text:?} splits");
    }
}

#[test]
fn hostile_sizes_end_in_clear_errors() {
    let deep = "(".repeat(100_000);
    let error = Formula::parse(&deep).unwrap_err();
    assert_eq!(error.span, MAX_DEPTH..MAX_DEPTH + 1);
    for unit in ["-", "sin(", "2^", "1+("] {
        let error = Formula::parse(&unit.repeat(100_000)).unwrap_err();
        assert!(error.message.contains("nested deeper"), "{unit} {error}");
    }
    let long = format!("1{}", "+1".repeat(100_000));
    let error = Formula::parse(&long).unwrap_err();
    assert!(error.message.contains("longer than 100000"), "{error}");
    let wide = format!("x{}", "*x+1".repeat(20_000));
    let formula = Formula::parse(&wide).unwrap();
    assert_eq!(formula.evaluate(|_| 1.0), 20_001.0);
    let digits = "9".repeat(3000);
    let error = Formula::parse(&digits).unwrap_err();
    assert_eq!(error.span, 0..3000);
    let name = "x".repeat(1_000_000);
    let error = Formula::parse(&format!("2{name}")).unwrap_err();
    assert!(error.message.len() < 200);
}

#[test]
fn depth_is_given_back() {
    let flat = vec!["(x)^2*-sin(x)"; 1000].join("+");
    assert!(Formula::parse(&flat).is_ok());
    let nested = format!("{}x{}", "(".repeat(MAX_DEPTH), ")".repeat(MAX_DEPTH));
    assert_eq!(at(&nested, &[("x", 2.0)]), 2.0);
}

#[test]
fn reserved_names_are_not_symbols() {
    assert!(is_symbol_name("l_5") && is_symbol_name("_x") && is_symbol_name("Pi"));
    for name in ["pi", "sin", "tan", "", "5l", "a.b", "a-b", "ä"] {
        assert!(!is_symbol_name(name), "{name}");
    }
}

/// Every text gives either a formula that can be lowered and evaluated, or an error with a place in the text and a
/// remedy.
#[test]
fn random_texts_give_a_formula_or_an_error() {
    const TOKENS: [&str; 33] = [
        "x", "l_1", "pi", "sin", "cos(", "tan(", "sqrt(", "(", ")", "(", ")", "+", "-", "*", "/",
        "^", "**", "2", "0.5", "1e3", "1e-400", ".", ",", " ", "\t", "\n", "é", "²", "−", "q", "3",
        "-", "_",
    ];
    let mut formulas = 0;
    for seed in 0..20_000 {
        let mut random = Random::new(seed);
        let length = 1 + random.index(12);
        let text: String = (0..length).map(|_| TOKENS[random.index(TOKENS.len())]).collect();
        match Formula::parse(&text) {
            Ok(formula) => {
                formulas += 1;
                assert_eq!(formula.text(), text);
                let graph = Graph::new();
                let expr = formula.lower(&graph, &mut |name| graph.symbol(name));
                let (direct, lowered) = (formula.evaluate(|_| 0.7), expr.evaluate(|_| 0.7));
                // If a quotient overflows, the exact rules can give a finite value and the direct evaluation not.
                let same = (direct - lowered).abs() <= 1e-9 * direct.abs();
                assert!(same || !direct.is_finite() || !lowered.is_finite(), "seed {seed}: {text}");
                for (name, span) in formula.symbols() {
                    assert_eq!(&text[span], name);
                }
            }
            Err(error) => {
                assert!(text.get(error.span.clone()).is_some(), "seed {seed}: {text:?} {error:?}");
                assert!(error.help.is_some(), "seed {seed}: {text:?} {error:?}");
            }
        }
    }
    assert!(formulas > 500, "{formulas}");
}
