use robot_model::description::read_toml;

use super::*;

pub(super) fn robot(name: &str) -> Robot {
    let path = format!("{}/../../robots/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    read_toml("robot.toml", &std::fs::read_to_string(path).unwrap()).unwrap().robot
}

pub(super) fn compared(robot: &Robot, text: &str) -> Result<Comparison, Diagnostics> {
    let source = Source { name: "printed".to_owned(), text: text.to_owned() };
    compare(robot, &source, &Options::default())
}

/// The second equation of the planar arm, as a list of terms.
const TERMS: [&str; 7] = [
    "- m2*g*r2*sin(q1)*sin(q2)",
    "+ m2*g*r2*cos(q1)*cos(q2)",
    "+ m2*l1*r2*sin(q2)*qd1^2",
    "+ m2*l1*r2*cos(q2)*qdd1",
    "+ m2*r2^2*qdd1",
    "+ m2*r2^2*qdd2",
    "+ I2*(qdd1 + qdd2)",
];

/// The differences of the equation in which the term `from` is replaced by `to`.
fn spoiled(from: &str, to: &str) -> Vec<Difference> {
    let text = TERMS.map(|term| if term == from { to } else { term }).join("\n  ");
    assert!(TERMS.contains(&from));
    compared(&robot("planar_2r"), &format!("(2) Q2 = {text}\n")).unwrap().differences
}

#[test]
fn right_equations_have_no_differences() {
    assert_eq!(spoiled(TERMS[0], TERMS[0]), []);
    // Like terms are separate and in any order, and the cosine of a sum replaces its expansion.
    let text = "Q2 = m2*r2^2*(qdd1 + qdd2)/2 + I2*qdd2 + m2*g*r2*cos(q1 + q2) + m2*l1*r2*cos(q2)*qdd1\n  \
        + m2*r2^2*qdd2/2 + m2*r2^2*qdd1/2 + I2*qdd1 + m2*l1*r2*sin(q2)*qd1^2";
    let found = compared(&robot("planar_2r"), text).unwrap();
    assert_eq!((found.equations, found.names, found.differences.len()), (1, 0, 0));
}

#[test]
fn terms_without_a_value_are_errors_at_their_place() {
    let robot = robot("planar_2r");
    for term in ["m1/0*qdd1", "0/0", "sqrt(-1)*qdd1", "I2/(q1 - q1)"] {
        let text = format!("Q1 = I2*qdd2 - {term}\n");
        let errors = compared(&robot, &text).unwrap_err();
        let found: Vec<_> = errors.iter().collect();
        assert_eq!((found.len(), found[0].code), (1, code::NUMBER), "{term}");
        let place = &found[0].primary.as_ref().unwrap().span;
        assert_eq!(&text[place.clone()], format!("- {term}"));
    }
    let latex = r"$ Q_1 = I_2 \ddot q_2 + \frac{m_1}{0} \ddot q_1 $".replace('$', "");
    let errors = compared(&robot, latex.trim()).unwrap_err();
    assert!(errors.to_string().contains("the term does not have a finite value"), "{errors}");
}

#[test]
fn every_kind_of_mistake_is_reported() {
    let cases = [
        (3, "", "missing term"),
        (3, "- m2*l1*r2*cos(q2)*qdd1", "sign"),
        (3, "+ 2*m2*l1*r2*cos(q2)*qdd1", "coefficient: 2 for 1"),
        (3, "+ m2*l1*r2*cos(q2)*qd1", "dot: qd1 for qdd1"),
        (3, "+ m1*l1*r2*cos(q2)*qdd1", "index: m1 for m2"),
        (3, "+ m2*l1*r2*cos(q1)*qdd1", "index: cos(q1) for cos(q2)"),
        (3, "+ m2*l1*r2*sin(q2)*qdd1", "function: sin(q2) for cos(q2)"),
        (2, "+ m2*l1*r2*sin(q2)*qd1^3", "power: qd1^3 for qd1^2"),
        (2, "+ m2*l1*r2*sin(q2)*qd1*qd2", "index: qd2 for qd1"),
        (3, "+ m2*l1*r2*qdd1", "missing factor: cos(q2)"),
        (3, "+ m2*l1*r2*g*cos(q2)*qdd1", "extra factor: g"),
        (3, "+ I2*l1*r2*cos(q2)*qdd1", "factor: I2 for m2"),
        (3, "+ m2*l1*r2*sin(q1)*qdd1", "factor: sin(q1) for cos(q2)"),
        (3, "+ m2*q1*r2*cos(q2)*qdd1", "factor: q1 for l1"),
    ];
    for (place, wrong, mistake) in cases {
        let found = spoiled(TERMS[place], wrong);
        assert_eq!(found.len(), 1, "{wrong}: {found:?}");
        let mistakes: Vec<String> = found[0].mistakes.iter().map(Mistake::to_string).collect();
        assert_eq!(mistakes, [mistake], "{wrong}");
        assert_eq!((found[0].number.as_str(), found[0].line), ("2", 1));
    }
    let extra = spoiled(TERMS[6], "+ I2*(qdd1 + qdd2) + m2*l1*r2*cos(q2)*qdd2");
    assert_eq!((extra.len(), extra[0].mistakes[0].kind), (1, MistakeKind::ExtraTerm));
    assert_eq!(extra[0].nearest.as_deref(), Some("qdd1*l1*r2*m2*cos(q2)"));
}

#[test]
fn like_terms_may_be_printed_apart() {
    // If one of two like terms is right, only the other one is reported.
    let found = spoiled(TERMS[4], "+ m2*r2^2*qdd1 + 2*m2*r2^2*qdd1");
    let [extra] = &found[..] else { panic!("{found:?}") };
    assert_eq!(extra.mistakes[0].kind, MistakeKind::ExtraTerm);
    assert_eq!((extra.printed.as_deref(), &extra.derived), (Some("2*qdd1*r2^2*m2"), &None));
    // No terms of this kind are derived, and the printed ones add up to zero.
    assert_eq!(spoiled(TERMS[4], "+ m2*r2^2*qdd1 + m1*r1^2*qdd2 - m1*r1^2*qdd2"), []);
    let found = spoiled(TERMS[4], "+ m2*r2^2*qdd1 + m1*r1^2*qdd2 - 2*m1*r1^2*qdd2");
    assert_eq!(found.len(), 2, "{found:?}");
}

/// For every term of an equation and every kind of change, the difference is reported with a mistake.
#[test]
fn no_difference_is_without_a_mistake() {
    let ways =
        ["0*({})", "-({})", "2*({})", "({})/2 + ({})/3", "({})*qd2", "({})*m1 + {}", "{} - 3*({})"];
    for term in TERMS {
        for way in ways {
            let bare = term.trim_start_matches("+ ");
            let found =
                spoiled(term, &format!("+ {}", way.replace("{}", bare)).replace("+ -", "-"));
            assert!(!found.is_empty(), "{term}, {way}");
            for one in found {
                assert!(!one.mistakes.is_empty(), "{term}, {way}: {one:?}");
                assert_ne!(one.printed, one.derived, "{term}, {way}");
            }
        }
    }
}

/// Of two derived terms whose factors differ equally from those of a printed term, the one with the same coefficient is
/// its counterpart.
#[test]
fn a_coefficient_counts_in_what_a_term_resembles() {
    let others = "m1*g*r1*cos(q1) + m1*r1^2*qdd1 + I1*qdd1 + m2*g*l1*cos(q1) + m2*g*r2*cos(q1 + q2) \
        + m2*l1^2*qdd1 - m2*l1*r2*sin(q2)*(2*qd1*qd2 + qd2^2) + (m2*r2^2 + I2)*(qdd1 + qdd2)";
    let mistakes = |term: &str| -> Vec<String> {
        let found = compared(&robot("planar_2r"), &format!("Q1 = {others} + {term}")).unwrap();
        found.differences.iter().flat_map(|one| &one.mistakes).map(Mistake::to_string).collect()
    };
    let right = "2*m2*l1*r2*cos(q2)*qdd1 + m2*l1*r2*cos(q2)*qdd2";
    assert_eq!(mistakes(right), Vec::<String>::new());
    let (first, second) = ("2*m2*l1*r2*cos(q2)*q1", "m2*l1*r2*cos(q2)*q1");
    assert_eq!(mistakes(first), ["dot: q1 for qdd1", "missing term"]);
    assert_eq!(mistakes(second), ["factor: q1 for qdd2", "missing term"]);
}

#[test]
fn the_distance_of_terms_counts_factors_and_one_for_the_coefficient() {
    let graph = Graph::new();
    let distance = |one: &str, other: &str| {
        let terms = term::terms_of(&[one, other].map(|text| graph.parse(text).unwrap()), &LIMITS);
        let terms = terms.unwrap();
        terms[0][0].distance(&terms[1][0])
    };
    let cases = [
        ("a*b*c", "a*b*c", 0),
        ("a*b*c", "a*b", 1),
        ("a*b", "a*b*c", 1),
        ("a*b", "a*c", 2),
        ("a^3", "a", 2),
        ("a", "a^2*b", 2),
        ("2*a*b", "a*c", 3),
        ("-a", "a", 1),
    ];
    for (one, other, expected) in cases {
        assert_eq!(distance(one, other), expected, "{one} and {other}");
    }
}

/// A torque within the equation of another one stands for its terms, unless it is itself the mistake.
#[test]
fn quantities_in_sums_are_written_out() {
    let robot = robot("planar_2r");
    let differences = |text: &str| compared(&robot, text).unwrap().differences;
    let first = "Q1 = m1*r1*(g*cos(q1) + r1*qdd1) + I1*qdd1 + Q2 + m2*l1*(g*cos(q1) + l1*qdd1 \
                 - r2*(qd1 + qd2)^2*sin(q2) + r2*(qdd1 + qdd2)*cos(q2)) + Fx*l1*sin(q2) + Fy*l1*cos(q2)";
    assert_eq!(differences(first), []);
    let [difference] = differences(&first.replace("I1*qdd1", "I1*qd1")).try_into().unwrap();
    assert_eq!(difference.printed.as_deref(), Some("qd1*I1"));
    let wrong = differences("Q2 = Q1");
    assert!(wrong.len() > 3, "{wrong:?}");
    // The name of the wrench's component Mz was replaced by that of a torque.
    let one = "Q2 = m2*r2*(g*cos(q1 + q2) + l1*sin(q2)*qd1^2 + l1*cos(q2)*qdd1) \
               + (m2*r2^2 + I2)*(qdd1 + qdd2) + Fy*l2 + Q1";
    let [difference] = differences(one).try_into().unwrap();
    assert_eq!(difference.printed.as_deref(), Some("Q1"));
}

#[test]
fn terms_that_are_not_torques_are_reported() {
    let evidence = |wrong: &str| -> Vec<String> {
        spoiled(TERMS[3], wrong)[0].evidence.iter().map(ToString::to_string).collect()
    };
    let dot = "has units kg m^2 s^-1, but a torque has kg m^2 s^-2: a time derivative is missing";
    assert_eq!(evidence("+ m2*l1*r2*cos(q2)*qd1"), [dot]);
    assert_eq!(
        evidence("+ m2*l1*cos(q2)*qdd1"),
        ["has units kg m s^-2, but a torque has kg m^2 s^-2"]
    );
    assert_eq!(evidence("+ k*l1*r2*cos(q2)*qdd1"), ["the robot does not have the symbol k"]);
    let quantity = "Q1 is another quantity and not a symbol of the robot";
    assert_eq!(evidence("+ Q1"), [quantity]);
    for (wrong, unit, dots) in [
        ("", "kg m^2", "2 time derivatives are missing"),
        ("*qd1*qdd1", "kg m^2 s^-3", "one time derivative too many"),
        ("*qdd1^2", "kg m^2 s^-4", "2 time derivatives too many"),
    ] {
        let expected = format!("has units {unit}, but a torque has kg m^2 s^-2: {dots}");
        assert_eq!(evidence(&format!("+ m2*l1*r2*cos(q2){wrong}")), [expected]);
    }
    // If dimensions other than time differ, dots cannot be the reason.
    for (wrong, dimension) in [("qd1", "kg^2 m^2 s^-1"), ("qd1*qdd1", "kg^2 m^2 s^-3")] {
        let expected = format!("has units {dimension}, but a torque has kg m^2 s^-2");
        assert_eq!(evidence(&format!("+ m1*m2*l1*r2*cos(q2)*{wrong}")), [expected]);
    }
    let mut nameless = robot("planar_2r");
    for parameter in &mut nameless.parameters {
        parameter.unit = None;
    }
    let text = "Q2 = m1*qd1";
    assert!(
        compared(&nameless, text).unwrap().differences.iter().all(|one| one.evidence.is_empty())
    );
}

/// A quantity with a number stands for its terms, as a quantity alone does; `tau2` is the joint torque Q2.
#[test]
fn torques_on_the_right_stand_for_their_terms() {
    let robot = robot("planar_2r");
    let of = |text: &str| compared(&robot, text).unwrap();
    let factors = |text: &str| -> Vec<String> {
        let mistakes = of(text).differences.into_iter().flat_map(|one| one.mistakes);
        mistakes.map(|one| one.to_string()).collect()
    };
    for text in ["Q2 = Q1", "Q2 = -Q1", "Q2 = 2*Q1", "Q1 = Q2/2", "Q1 = tau2", "tau1 = 3*tau2 - Q2"]
    {
        let found = of(text);
        assert_eq!((found.names, found.terms), (1, 0), "{text}");
        assert!(!factors(text).iter().any(|one| one.contains('Q')), "{text}");
    }
    let own = "m1*r1*(g*cos(q1) + r1*qdd1) + I1*qdd1 + m2*l1*(g*cos(q1) + l1*qdd1 - \
        r2*(2*qd1 + qd2)*sin(q2)*qd2 + r2*(qdd1 + qdd2)*cos(q2) - r2*sin(q2)*qd1^2)";
    let [by_name, by_letter] = ["Q2", "tau2"].map(|torque| of(&format!("Q1 = {torque} + {own}")));
    assert_eq!((by_name.names, by_letter.differences), (0, by_name.differences));
}

#[test]
fn latex_is_compared_as_text_is() {
    let robot = robot("trttr1");
    let text = r"\begin{align}
  F_{l_y}^5 &= F_{l_y}^6 + M_5 cq_2 \dot{q}_1 + M_5 \ddot q_2 (q_4 + l_4 + l_5) \\ % a mistake: one dot
  &\quad + 2 M_5 \dot q_4 \dot q_2 \tag{31} \\
  \bar{M}_c^{5} &= \left[\begin{array}{c}
    - J_x^{*5} (s_5 \ddot q_2 + \dot q_5 c_5 \dot q_2) - c_5 \dot q_2 \dot q_5 (J_y^{*5} - J_z^{*5}) \\
    J_y^{*5} \ddot q_5 - \cos q_5 \dot q_2^2 J_x^{*5} \sin q_5 + sq_5 \dot q_2^2 J_z^{*5} cq_5 \\
    J_z^{*5} (c_5 \ddot q_2 - \dot q_5 s_5 \dot q_2) + \dot q_5 \dot q_2 s_5 (J_x^{*5} - J_y^{*5})
  \end{array}\right]
\end{align}";
    let found = compared(&robot, text).unwrap();
    assert_eq!((found.equations, found.differences.len()), (4, 1), "{found:#?}");
    assert_eq!(found.differences[0].mistakes[0].to_string(), "dot: qd1 for qdd1");
    assert_eq!((found.differences[0].number.as_str(), found.differences[0].line), ("31", 2));
}

/// A byte order mark, which some editors put before a text, is ignored.
#[test]
fn a_byte_order_mark_is_not_part_of_the_equations() {
    let robot = robot("planar_2r");
    let equation = "Q2 = m2*r2^2*qdd1 @ # a comment\n";
    for (text, notation) in [
        ("# The equations, \\emph{as printed}.\n(2) Q2 = I2*(qdd1 + qdd2)\n", Notation::Text),
        ("(2) Q2 = I2*(qdd1 + qdd2) # as \\emph{printed}\n", Notation::Text),
        ("Q_{2} = I_2*(qdd1 + qdd2)\n", Notation::Latex),
        ("(2) $Q_2 = I_2 (\\ddot q_1 + \\ddot q_2)$\n", Notation::Latex),
        ("% As printed.\n\\[ Q_2 = I_2 (\\ddot q_1 + \\ddot q_2) \\]\n", Notation::Latex),
    ] {
        let marked = format!("\u{feff}{text}");
        assert_eq!([Notation::detect(text), Notation::detect(&marked)], [notation; 2], "{text}");
        let [plain, found] = [text, &marked].map(|text| compared(&robot, text).unwrap());
        assert!(!plain.differences.is_empty(), "{text}");
        assert_eq!(found.differences, plain.differences, "{text}");
    }
    let shown = compared(&robot, &format!("\u{feff}{equation}")).unwrap_err().to_string();
    assert!(shown.contains("printed:1:"), "{shown}");
}

/// `Q_2`, `Q_m^2` and `\tau_2` denote the joint torque of the second joint.
#[test]
fn a_joint_torque_is_known_by_its_usual_letters() {
    let right = r"(m_2 r_2^2 + I_2) (\ddot q_1 + \ddot q_2) + m_2 l_1 r_2 \cos q_2 \ddot q_1
        + m_2 l_1 r_2 \sin q_2 \dot q_1^2 + m_2 g r_2 \cos(q_1 + q_2)";
    for left in ["Q_{2}", "Q_m^2", r"\tau_2"] {
        let text = format!(r"\[ {left} = {right} + m_1 \]");
        let found = compared(&robot("planar_2r"), &text);
        let found = found.unwrap_or_else(|error| panic!("{left}: {error}")).differences;
        let shown: Vec<_> =
            found.iter().map(|one| (&*one.quantity, one.printed.as_deref())).collect();
        assert_eq!(shown, [("Q2", Some("m1"))], "{left}");
    }
}

/// The sign of an exponent does not begin a new term.
#[test]
fn numbers_have_signed_exponents() {
    for one in ["1e-3*1e+3", "2.5e-1*4", "1E-2*1e2"] {
        assert_eq!(spoiled(TERMS[4], &format!("+ {one}*m2*r2^2*qdd1")), [], "{one}");
    }
}

#[test]
fn the_order_of_a_sum_is_taken_and_a_single_term_has_none() {
    let order = |text: &str| {
        let source = Source { name: "printed".to_owned(), text: text.to_owned() };
        term_order(&robot("planar_2r"), &source, &Options::default()).unwrap()
    };
    assert!(order("F_l1.x = F1.x\nQ2 = I2*qdd2\n").is_empty());
    let [forth, back] =
        ["I2*qdd2 + I2*qdd1", "I2*qdd1 + I2*qdd2"].map(|sum| order(&format!("Q2 = {sum}\n")));
    assert!(!forth.is_empty());
    assert_ne!(forth, back);
    // If a quantity is printed twice, the later equation counts.
    assert_eq!(order("Q2 = I2*qdd1 + I2*qdd2\nQ2 = I2*qdd2 + I2*qdd1\n"), forth);
}

/// A line begins after the line end of the preceding line, which belongs to that line.
#[test]
fn every_byte_is_in_its_line() {
    for text in ["a\nbc\n\nd", "\n\na", "abc", "", "é\nq\n"] {
        let lines = Lines::of(text);
        let mut line = 1;
        for (place, byte) in text.bytes().enumerate() {
            assert_eq!(lines.at(place), line, "{text:?}, {place}");
            line += usize::from(byte == b'\n');
        }
        assert_eq!(lines.at(text.len()), line, "{text:?}");
    }
}

#[test]
fn mistakes_are_counted_in_words() {
    let counted = [(MistakeKind::Sign, 1), (MistakeKind::Index, 9), (MistakeKind::Dot, 2)]
        .map(|(kind, count)| kind.counted(count));
    assert_eq!(counted, ["1 sign", "9 indices", "2 dots"]);
}

/// A planar arm of one link with a formula or number for its mass, the place of its center of mass and its moment of
/// inertia.
pub(super) fn link(mass: &str, center: &str, inertia: &str) -> Robot {
    let text = format!(
        "format = 1\n[robot]\nname = \"link\"\ngravity = [0, 0, 0]\n[parameters]\nm1 = {{ unit = \"kg\" }}\n\
        mt = {{ unit = \"kg\" }}\nr1 = {{ unit = \"m\" }}\n[[link]]\nname = \"1\"\n\
        joint = {{ type = \"revolute\", axis = \"z\" }}\norigin = {{ xyz = [0, 0, 0] }}\nmass = \"{mass}\"\n\
        center_of_mass = [\"{center}\", 0, 0]\ninertia = {{ zz = \"{inertia}\", unchecked = true }}\n"
    );
    read_toml("robot.toml", &text).unwrap_or_else(|error| panic!("{error}")).robot
}

#[test]
fn sums_in_terms_are_in_parentheses() {
    let robot = link("m1", "r1*m1/(m1 + mt)", "0");
    let found = compared(&robot, "Q1 = 0\n").unwrap().differences;
    let derived: Vec<_> = found.iter().filter_map(|one| one.derived.as_deref()).collect();
    assert_eq!(derived, ["qdd1*m1^3*r1^2*(m1 + mt)^-2"]);
    let found = compared(&robot, "Q1 = m1^3*r1^2*qdd1/(m1 + mt)\n").unwrap().differences;
    let mistakes: Vec<_> = found[0].mistakes.iter().map(Mistake::to_string).collect();
    assert_eq!(mistakes, ["power: (m1 + mt)^-1 for (m1 + mt)^-2"]);
    // The units of the sum are not known, and neither are those of the term.
    assert_eq!(found[0].evidence, []);
}

/// If derived coefficients have dimensions, those of a printed term's symbols say nothing.
#[test]
fn numbers_with_units_are_no_evidence() {
    let evidence = |robot: &Robot, text: &str| -> Vec<Vec<String>> {
        let found = compared(robot, text).unwrap().differences.into_iter();
        found.map(|one| one.evidence.iter().map(ToString::to_string).collect()).collect()
    };
    let none: Vec<Vec<String>> = vec![vec![]];
    assert_eq!(evidence(&link("1", "0", "0.13"), "Q1 = 0.12*qdd1\n"), none);
    // One number with a unit in one of the equations is enough; nothing is known where nothing is derived.
    let (mixed, symbols) = (link("m1", "r1", "0.13"), link("m1", "r1", "0"));
    let acceleration = "a_c1.x = -r1*qd1\n";
    assert_eq!(evidence(&mixed, &format!("{acceleration}Q1 = m1*r1^2*qdd1 + 0.13*qdd1\n")), none);
    assert_eq!(evidence(&symbols, "F_l1.z = m1*qdd1\n"), none);
    let dot = "has units m s^-1, but an acceleration has m s^-2: a time derivative is missing";
    assert_eq!(evidence(&symbols, acceleration), [[dot]]);
    let unknown = evidence(&mixed, "Q1 = m1*r1^2*qdd1 + 0.13*k*qdd1\n");
    assert_eq!(unknown, [["the robot does not have the symbol k"]]);
}

#[test]
fn a_joint_torque_in_text_may_be_tau() {
    for left in ["tau2", "tau_2", "Q_2"] {
        let found = compared(&robot("planar_2r"), &format!("(2) {left} = I2*qdd1\n")).unwrap();
        assert!(found.differences.iter().all(|one| one.quantity == "Q2"));
    }
    let shown = compared(&robot("planar_2r"), "tau3 = 0\n").unwrap_err().to_string();
    assert!(shown.contains("does not have the quantity `tau3`"), "{shown}");
}

/// A root in a denominator to a high power is a power of its argument, with one root if the power is odd.
#[test]
fn powers_of_roots_in_denominators_are_those_of_their_arguments() {
    for (power, same) in [
        (1, "sqrt(m1)"),
        (2, "m1"),
        (3, "m1*sqrt(m1)"),
        (4, "m1^2"),
        (5, "m1^2*sqrt(m1)"),
        (7, "m1^3*sqrt(m1)"),
    ] {
        let robot = link("1", "0", &format!("r1/sqrt(m1)^{power}"));
        let found = compared(&robot, &format!("Q1 = r1*qdd1/({same})\n")).unwrap().differences;
        assert_eq!(found, [], "{power}");
    }
}

/// Names that differ in one of several letters after the first are likely those of each other's index.
#[test]
fn names_that_differ_in_one_letter_have_another_index() {
    let text = "format = 1\n[robot]\nname = \"arm\"\n[parameters]\nIabc = 1.0\nIabd = 1.0\nIbbd = 1.0\n\
        [[link]]\nname = \"1\"\njoint = { type = \"revolute\", axis = \"z\" }\nmass = \"Iabd + Ibbd\"\n\
        center_of_mass = [0, 0, 0]\ninertia = { zz = \"Iabc\", unchecked = true }\n";
    let robot = read_toml("arm.toml", text).unwrap_or_else(|error| panic!("{error}")).robot;
    for (name, mistake) in [("Iabd", "index: Iabd for Iabc"), ("Ibbd", "factor: Ibbd for Iabc")] {
        let found = compared(&robot, &format!("Q1 = {name}*qdd1\n")).unwrap().differences;
        let mistakes: Vec<_> = found[0].mistakes.iter().map(Mistake::to_string).collect();
        assert_eq!(mistakes, [mistake]);
    }
}

/// Equations in environments that are not displays, and in sentences, are counted if displays are read.
#[test]
fn equations_outside_of_displays_are_counted() {
    let robot = link("1", "0", "m1*r1^2");
    let right = "\\[ Q_1 = m_1 r_1^2 \\ddot q_1 \\]\n";
    let wrong = "Q_1 &= 7 r_1 \\ddot q_1";
    for outside in [
        "with $Q_1 = 7 r_1 \\ddot q_1$",
        "is \\(\\tau_1 = 7\\).",
        "\\begin{own}[x]{rCl} Q_1 &=& 7 r_1 \\end{own}",
        "\\begin{own}\n Q_1 &=& 7 r_1 \\end{own}",
        "$x = 3$, $(3)\\ Q_1 = 7$",
    ] {
        let found = compared(&robot, &format!("{right}{outside}\n")).unwrap();
        let line = if outside.contains("own}\n") { 3 } else { 2 };
        assert_eq!((found.equations, found.unread), (1, vec![line]), "{outside}");
    }
    for outside in
        ["$x = 3$", "% $Q_1 = 7$", "\\begin{comment}$Q_1 = 7$\\end{comment}", "$Q_1$ = 3"]
    {
        let found = compared(&robot, &format!("{right}{outside}\n")).unwrap();
        assert_eq!(found.unread, [0; 0], "{outside}");
    }
    for display in [
        "{IEEEeqnarray}{rCl}",
        "{IEEEeqnarray*}[x]{rCl}",
        "{dmath}",
        "{dmath*}[label={eq:a}]",
        "{empheq}[left=x]{align}",
    ] {
        let name = display.split_inclusive('}').next().unwrap_or_default();
        let text = format!("{right}\\begin{display} {wrong} \\IEEEyesnumber \\end{name}\n");
        let found = compared(&robot, &text).unwrap();
        assert_eq!(
            (found.equations, found.differences.len(), found.unread.len()),
            (2, 1, 0),
            "{text}"
        );
    }
}
