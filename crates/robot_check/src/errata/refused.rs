//! Tests of what is refused, and of the messages.

use super::tests::{compared, robot};

#[test]
fn errors_show_the_place() {
    let message = |text: &str| compared(&robot("planar_2r"), text).unwrap_err().to_string();
    let shown = message("Q1 = m1*\nQ2 = m2 +* g\nQ7 = 0\n");
    for part in ["printed:1:8", "printed:2:10", "R0302"] {
        assert!(shown.contains(part), "{shown}");
    }
    let shown = message("(4) Q7 = 0\nF_l1.w = 0");
    for part in ["printed:1:1", "not have the quantity `Q7`", "a_c1.x to a_c2.z", "F_l1.w"] {
        assert!(shown.contains(part), "{shown}");
    }
    assert!(message("\\[ Q_1 = \\frac{m_1}{ \\]").contains("printed:1:"));
    let column = "\\begin{bmatrix} 0 \\\\ 0 \\\\ 0 \\end{bmatrix}";
    for beside in [format!("{column} + m_1"), format!("m_1 {column}")] {
        let shown = message(&format!("\\[ F_{{1}}^{{1}} = {beside} \\]"));
        assert!(shown.contains("stand outside the column vector"), "{shown}");
    }
    let matrix = "\\begin{bmatrix} m_1 & 0 \\\\ 0 & m_2 \\end{bmatrix}";
    for right in [format!("{matrix} \\ddot q"), format!("{column} + {column}")] {
        let shown = message(&format!("\\[ \\tau = {right} \\]"));
        assert!(shown.contains("an equation of matrices or vectors"), "{shown}");
    }
    assert!(message("").contains("no equations"));
}

/// A short text can have more terms than anyone compares.
#[test]
fn powers_of_sums_are_refused() {
    let power = "Q1 = ((m1+m2)^8+l1)^8*((r1+r2)^8+g)^8";
    let shown = compared(&robot("planar_2r"), power).unwrap_err().to_string();
    assert!(shown.contains("88209 of 88209 printed terms are not among"), "{shown}");
}

#[test]
fn equations_without_end_are_refused() {
    let planar = robot("planar_2r");
    let long = "Q1 = (m1+m2+l1+r1+r2+g+I1+I2+q1+q2+qd1+qd2)^24";
    assert!(compared(&planar, long).unwrap_err().to_string().contains("too long"));
    let deep = format!("Q1 = {}m1{}", "(".repeat(5000), ")".repeat(5000));
    assert!(compared(&planar, &deep).unwrap_err().to_string().contains("nested"));
    let many = format!("Q1 = {}", "+ m1*q1".repeat(20_000));
    assert_eq!(compared(&planar, &many).map(|found| found.terms), Ok(20_000));
    let strange: String = (0..200_000).map(|index| format!("+ x{index}")).collect();
    let shown = compared(&planar, &format!("Q1 = {strange}")).unwrap_err().to_string();
    assert!(shown.contains("check that the equations are of this robot"), "{shown}");
    for part in [
        "\\begin{split}",
        "\\tag{",
        "$$",
        "\\[",
        "\\\\[",
        "\\begin{align}",
        "Q1=",
        "{",
        "\\begin{bmatrix}",
    ] {
        let _ = compared(&planar, &part.repeat(10_000));
        let _ = compared(&planar, &format!("$$Q_1 = {}$$", part.repeat(10_000)));
    }
    let parts = [
        "Q_1",
        "=",
        "\\\\",
        "&",
        "\\begin{align}",
        "\\end{align}",
        "$$",
        "%",
        "\n",
        " ",
        "m_1",
        "+",
        "\\tag{",
        "}",
        "{",
        "é",
        "\\",
        "#",
        "(",
        ")",
        "\\begin{bmatrix}",
        "\\end{bmatrix}",
        "[",
        "sin",
        "1e-3",
    ];
    for seed in 0..1000 {
        let mut random = robot_numeric::robots::Random::new(seed);
        let text: String =
            (0..random.index(40)).map(|_| parts[random.index(parts.len())]).collect();
        if let Err(errors) = compared(&planar, &text) {
            assert!(!errors.to_string().is_empty(), "seed {seed}");
        }
    }
}

#[test]
fn a_heading_is_an_error_that_says_what_can_be_read() {
    let planar = robot("planar_2r");
    let shown = compared(&planar, "Link 1, outward\n\nomega1.x = 0\n").unwrap_err().to_string();
    assert!(shown.contains("begin a heading with `#`") && shown.contains("`expanded`"), "{shown}");
    let shown = compared(&planar, "Q1 - m1\n").unwrap_err().to_string();
    assert!(shown.contains("write `quantity = terms`") && !shown.contains("heading"), "{shown}");
    let shown = compared(&planar, "Q1 = m1\n+ m2\n").unwrap_err().to_string();
    assert!(shown.contains("begin a line that continues an equation with a space"), "{shown}");
    let shown = compared(&planar, "We find $Q_1 = m_1$\n").unwrap_err().to_string();
    assert!(shown.contains("on a line of its own"), "{shown}");
    let shown = compared(&planar, "0 = m1\n").unwrap_err().to_string();
    assert!(shown.contains("the left side is a number"), "{shown}");
}

/// A table with `Q1 = Q1` would agree with every robot.
#[test]
fn an_equation_that_is_its_own_left_side_is_an_error() {
    for text in ["Q1 = Q1", "Q1 = (Q1)", "Q1 = 2*Q1 - Q1", "$Q_1 = Q_1$"] {
        let error = compared(&robot("planar_2r"), text).unwrap_err();
        assert!(error.to_string().contains("the right side contains `Q1`"), "{text}: {error}");
    }
}

#[test]
fn what_ends_an_equation_is_not_a_term() {
    let planar = robot("planar_2r");
    for end in [r"\,.", r"\;,", r"\ .", r"\,,", r"\, .", r"\;", r"\quad .", "~,", r"\, \\", ""] {
        let text = format!(r"\begin{{align}} \tau_1 &= \tau_1 m_1 {end} \end{{align}}");
        let shown = compared(&planar, &text).unwrap_err().to_string();
        assert!(shown.contains("the right side contains `Q1`"), "{end}: {shown}");
    }
}

#[test]
fn systems_in_a_brace_and_words_between_equations_are_read() {
    let planar = robot("planar_2r");
    let rows = r"\tau_1 &= m_1 \\ \intertext{and} \tau_2 &= m_2";
    for (open, close) in [
        (r"\left\{\begin{aligned}", r"\end{aligned}\right."),
        (r"\begin{cases}", r"\end{cases}"),
        (r"\begin{aligned}", r"\end{aligned}"),
    ] {
        let found = compared(&planar, &format!("\\[ {open} {rows} {close} \\]")).unwrap();
        assert_eq!(found.equations, 2, "{open}");
    }
}

#[test]
fn what_is_not_read_has_a_remedy() {
    let planar = robot("planar_2r");
    for (text, part) in [
        ("Q1 = 2*m2*g*sin(q1/2)*cos(q1/2)\n", "of parts of an angle are not compared"),
        (r"$Q_1 = m_2 g \cos\frac{q_1}{2}$", "of parts of an angle are not compared"),
        ("\\[ Q_1 = m_1 \\\\ = m_2 \\]", "a chain `Q1 = a = b` is not read"),
        (r"$Q_1 = m_2 g sin q_1$", r"write `\sin`"),
        ("\\[ tau2 = m_1 \\]", "this is not LaTeX"),
        ("Words here\n$Q_1 = m_1$\n", "begin a line of words with `%`"),
    ] {
        let shown = compared(&planar, text).unwrap_err().to_string();
        assert!(shown.contains(part), "{text}: {shown}");
    }
    // Every symbol that the robot does not have is named.
    let found = compared(&planar, "Q1 = M2*L1*qdd1\n").unwrap();
    let shown: Vec<String> =
        found.differences.iter().flat_map(|one| &one.evidence).map(ToString::to_string).collect();
    let lacks = |name: &str| shown.contains(&format!("the robot does not have the symbol {name}"));
    assert!(lacks("M2") && lacks("L1"), "{shown:?}");
}

#[test]
fn equations_may_be_repeated_but_not_without_end() {
    let planar = robot("planar_2r");
    // Five vectors of each link, and the joint torques.
    let most = 8 * (2 * 15 + 2);
    let text = |count: usize| "Q1 = I1*qdd1\n".repeat(count);
    assert_eq!(compared(&planar, &text(most)).unwrap().equations, most);
    let shown = compared(&planar, &text(most + 1)).unwrap_err().to_string();
    assert!(shown.contains("more than 8 equations for each quantity"), "{shown}");
}

/// What LaTeX prints beside an equation, or not at all, is neither a factor nor an equation.
#[test]
fn what_stands_beside_an_equation_is_not_a_factor() {
    let planar = robot("planar_2r");
    let message = |text: &str| compared(&planar, text).map_err(|errors| errors.to_string());
    for number in [
        r"\qquad (2)",
        r"\quad(2a)",
        r"\hfill (2)",
        "& (2)",
        " (2)",
        r"\\ & (2)",
        r"\quad [2]",
        r"\quad (2-2)",
        r"\quad (3.2a)",
    ] {
        let shown = message(&format!(r"\[ Q_2 = \frac12 m_2 {number} \]")).unwrap_err();
        assert!(shown.contains("the number of the equation"), "{number}: {shown}");
    }
    for right in [r"m_2 \cos (2)", r"m_2 (2)(3)", r"m_2 + (2)", r"m_2 \cdot (2)"] {
        assert!(message(&format!(r"\[ Q_2 = {right} \]")).is_ok(), "{right}");
    }
    for (text, part) in [
        (r"\[ Q_2 = \begin{cases} m_1 \\ + m_2 \end{cases} \]", "alternatives are not compared"),
        (r"\[ Q_2 = m_2 g \sin\frac12 q_2 \]", "follows the fraction"),
        (r"\[ Q_2 = m_2 \quad\text{and} \]", "words are not a factor"),
        (r"\[ Q_2 = \tau_1 = m_2 \]", "leave one right side"),
        (r"\[ Q_2 = m_2 \iffalse m_1 \else + m_1 \fi \]", r"`\fi` is not supported here"),
    ] {
        let shown = message(text).unwrap_err();
        assert!(shown.contains(part), "{text}: {shown}");
    }
    for text in [
        r"\begin{comment}\[ Q_2 = 0 \]\end{comment} \[ Q_2 = m_2 \]",
        r"\iffalse \[ Q_2 = 0 \] \fi \[ Q_2 = m_2 \]",
        r"\[ Q_2 = \begin{aligned}[t] m_2 \end{aligned} \]",
        r"\begin{align} Q_2 &= m_2, \nonumber \end{align}",
    ] {
        let found = message(text).unwrap();
        assert_eq!((found.equations, found.terms), (1, 1), "{text}");
    }
}
