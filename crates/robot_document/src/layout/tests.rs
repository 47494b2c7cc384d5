use robot_model::description::read_toml;
use robot_model::robot::Robot;
use robot_symbolic::print::{check_length, default_rank};
use robot_symbolic::{Expr, Function, Graph, Polynomial, PolynomialOptions, Random};

use super::math::Math;
use super::meaning::{Looks, meaning};
use super::{SymbolTable, Trigonometry, polynomial};
use crate::error::Error;
use crate::latex::formula;

const STYLES: [Trigonometry; 3] = [Trigonometry::Named, Trigonometry::Short, Trigonometry::Paper];

#[test]
fn names_are_spelled() {
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
        assert_eq!(formula(&Math::spelled(name)), latex, "{name}");
    }
}

fn expression(source: &str, trigonometry: Trigonometry) -> String {
    let graph = Graph::new();
    let table = SymbolTable::spelled(trigonometry);
    formula(&table.expression(graph.parse(source).unwrap()).unwrap())
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
        (
            "2*mp*lp^2*x*(mp + lp)",
            r"2\, \mathrm{mp}\, \mathrm{lp}^{2}\, x \left(\mathrm{mp} + \mathrm{lp}\right)",
        ),
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
        ("cos(2)", [r"\cos\left(2\right)", r"\cos\left(2\right)", r"c\left(2\right)"]),
    ] {
        for (style, latex) in STYLES.into_iter().zip(styles) {
            assert_eq!(expression(source, style), latex, "{source} {style:?}");
        }
    }
}

fn polynomial(source: &str, trigonometry: Trigonometry) -> String {
    let graph = Graph::new();
    let value = Polynomial::of(graph.parse(source).unwrap(), &PolynomialOptions::default());
    let terms = value.unwrap().arranged(default_rank);
    formula(&polynomial::sum(&terms, &SymbolTable::spelled(trigonometry)).unwrap())
}

#[test]
fn polynomials_are_sums_of_terms() {
    let source =
        "l4*(M5*sin(q2)*qdd1 - 2*M4*qd2^2)/3 + cos(q5)^2*Jx5 - 1/(2*x) + 0.35/y^2 - 1/(x + y)";
    assert_eq!(
        polynomial(source, Trigonometry::Paper),
        r"\frac{1}{3} l_4 M_5 \ddot{q}_1 sq_2 - \frac{2}{3} l_4 M_4 \dot{q}_2^{2} + J_{x5} c^{2}q_5 - \frac{1}{x + y} + \frac{0.35}{y^{2}} - \frac{0.5}{x}"
    );
    for (source, latex) in [
        ("sin(q2)*cos(q3)*tanh(x)", r"\sin q_2 \cos q_3 \cdot \tanh\left(x\right)"),
        ("tanh(x^2)^3*y", r"y \tanh^{3} \left(x^{2}\right)"),
        ("1/((x^2 + y)^2*z)", r"\frac{1}{z \left(x^{2} + y\right)^{2}}"),
        ("2*x/(3*y)", r"\frac{2}{3} \frac{x}{y}"),
        ("x - x", "0"),
    ] {
        assert_eq!(polynomial(source, Trigonometry::Named), latex, "{source}");
    }
}

/// Every name becomes one symbol that is printed without other effects.
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
        let graph = Graph::new();
        let table = SymbolTable::spelled(Trigonometry::Named);
        let latex = formula(&table.expression(graph.symbol(name)).unwrap());
        let mut bare = latex.replace(r"\mathrm", "");
        for special in ["$", "%", "&", "#", "_", "{", "}"] {
            bare = bare.replace(&format!("\\{special}"), "");
        }
        assert!(!bare.contains(['\\', '$', '%', '&', '#', '~', '\n']), "{name:?}: {latex}");
        assert_eq!(bare.matches('{').count(), bare.matches('}').count(), "{name:?}: {latex}");
        assert!(bare.matches('_').count() <= 1 && bare.is_ascii(), "{name:?}: {latex}");
    }
}

#[test]
fn looks_that_could_do_more_than_print_are_not_used() {
    let text = |latex: &str| {
        format!(
            "format = 1\n[robot]\nname = \"a\"\n[parameters]\nm = {{ value = 1, latex = 'M_{{a}}' }}\n\
             {latex}[[link]]\nname = \"b\"\njoint = {{ type = \"revolute\", axis = \"z\" }}\nmass = \"m\"\n\
             center_of_mass = [0.1, 0, 0]\ninertia = {{ xx = 1, yy = 1, zz = 1 }}\n"
        )
    };
    let mut robot = read_toml("a.toml", &text("")).unwrap().robot;
    let shown =
        |robot: &Robot| formula(&SymbolTable::new(robot, Trigonometry::Named).unwrap().look("m"));
    assert_eq!(shown(&robot), "M_a");
    robot.parameters[0].latex = Some(r"\input{x}".to_owned());
    assert_eq!(shown(&robot), "m");
    // A space before an index is ignored.
    robot.parameters[0].latex = Some("J _x ^2".to_owned());
    assert_eq!(shown(&robot), "J_x^{2}");
}

/// Beside components of vectors, a square of `F_y` would look like that of link 2.
#[test]
fn powers_are_not_printed_like_components() {
    let graph = Graph::new();
    let expr = graph.parse("F_y^2 + Ixx^2*m_1^2 + sqrt(1 + F_y^2)").unwrap();
    let table = SymbolTable::spelled(Trigonometry::Named);
    let both = |table: &SymbolTable| {
        let sum = Polynomial::of(expr, &PolynomialOptions::default()).unwrap();
        let terms = sum.arranged(default_rank);
        [table.terms(&terms), table.expression(expr)].map(|one| formula(&one.unwrap()))
    };
    for latex in both(&table) {
        assert!(latex.contains("F_y^{2}") && !latex.contains(r"F_y\right)"), "{latex}");
    }
    for latex in both(&table.beside_components(true)) {
        assert!(!latex.contains("F_y^{2}") && latex.contains(r"m_1^{2}"), "{latex}");
        assert_eq!(latex.matches(r"F_y\right)^{2}").count(), 2, "{latex}");
        assert!(latex.contains(r"I_{xx}\right)^{2}"), "{latex}");
    }
}

/// A number within a product is printed first, so that there is a dot between it and a number before.
#[test]
fn numbers_do_not_meet() {
    let graph = Graph::new();
    let [x, y] = ["x", "y"].map(|name| graph.symbol(name));
    let table = SymbolTable::spelled(Trigonometry::Named);
    let shown = |expr| formula(&table.expression(expr).unwrap());
    let number = |text| graph.parse(text).unwrap();
    let inner = x * (number("0.1") * y);
    assert_eq!(shown(number("0.8") * (inner + 0)), r"0.8 \cdot 0.1 y x");
    // A sine is last if it is printed last.
    assert_eq!(shown(x.sin() * number("0.5") * y), r"0.5 \sin x \cdot y");
}

#[test]
fn nesting_ends_somewhere() {
    let graph = Graph::new();
    let mut expr = graph.symbol("x");
    for _ in 0..300 {
        expr = (expr + 1).sqrt();
    }
    let table = SymbolTable::spelled(Trigonometry::Named);
    assert_eq!(table.expression(expr), Err(Error::TooDeep { limit: 200 }));
}

const SYMBOLS: [&str; 7] = ["x", "qd2", "l_1", "q1", "q2", "q12", "payload"];

/// A table in which every symbol can be recognized by its layout.
fn table(trigonometry: Trigonometry) -> SymbolTable {
    let mut table = SymbolTable::spelled(trigonometry);
    for name in SYMBOLS {
        table.define(name, Math::spelled(name)).unwrap();
    }
    let power = r"J_x^{*5}";
    table.define("y", crate::latex::read(power).unwrap()).unwrap();
    table
}

/// Sums, products, quotients, powers and functions of the symbols, with shared parts.
fn random_expression<'g>(graph: &'g Graph, random: &mut Random) -> Expr<'g> {
    let symbols = SYMBOLS.iter().chain(&["y"]);
    let mut parts: Vec<Expr<'g>> = symbols.map(|name| graph.symbol(name)).collect();
    let constants = ["2", "0.35", "-1/3", "pi", "-7"].map(|text| graph.parse(text).unwrap());
    for _ in 0..10 {
        let a = parts[parts.len() - 1 - random.index(3)];
        let b = parts[random.index(parts.len())];
        parts.push(match random.index(12) {
            0 => a + b,
            1 => a - b,
            2 | 3 => a * b,
            4 => b - a * constants[random.index(5)],
            5 => a / (b * b + 1),
            6 => a.powi(2 + random.index(4) as i32),
            7 => a.apply(Function::ALL[random.index(6)]) * b,
            8 => b * (graph.symbol("q1") - graph.symbol("q2")).sin().powi(2),
            9 => b * graph.symbol(SYMBOLS[3 + random.index(3)]).cos(),
            _ => -a,
        });
    }
    parts[parts.len() - 1]
}

/// All that is printed can be read as LaTeX and stands for the expression from which it was printed.
#[test]
fn what_is_printed_means_the_expression() {
    let limits = PolynomialOptions { max_terms: 60, max_products: 400, ..Default::default() };
    let mut compared = 0;
    for seed in 0..400 {
        let mut random = Random::new(seed);
        let graph = Graph::new();
        let expr = random_expression(&graph, &mut random);
        let (Ok(()), Ok(sum)) = (check_length(expr, 150), Polynomial::of(expr, &limits)) else {
            continue;
        };
        compared += 1;
        for table in STYLES.map(table) {
            let looks = Looks::new(&table).unwrap();
            let whole = table.expression(expr).unwrap();
            let expanded = polynomial::sum(&sum.arranged(default_rank), &table).unwrap();
            for printed in [whole, expanded] {
                let latex = formula(&printed);
                let read =
                    crate::latex::read(&latex).unwrap_or_else(|error| panic!("{error}: {latex}"));
                let meant = meaning(&read, &graph, &looks)
                    .unwrap_or_else(|error| panic!("seed {seed}: {error}: {latex}"));
                let at = |symbol| {
                    0.3 + 0.1
                        * f64::from(
                            graph.symbol_name(symbol).bytes().map(u32::from).sum::<u32>() % 11,
                        )
                };
                let (found, expected) = (meant.evaluate(at), expr.evaluate(at));
                let error = (found - expected).abs();
                assert!(
                    error <= 1e-9 * expected.abs().max(1.0) || !expected.is_finite(),
                    "seed {seed}: {found} {expected}: {latex}"
                );
            }
        }
    }
    assert!(compared > 200, "{compared}");
}
