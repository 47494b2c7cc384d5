//! A comparison as Markdown: small tables of the differences, with typeset terms.

use std::fmt::Write as _;

use robot_check::errata::{Comparison, Difference, Evidence, Mistake};
use robot_document::math::Math;
use robot_document::{SymbolTable, Trigonometry, latex};
use robot_dynamics::quantity::{Kind, Symbol};
use robot_model::robot::Robot;
use robot_symbolic::{Formula, Graph};

use super::show::{name, summary};

/// The color of printed factors that are not derived.
const PRINTED: &str = "red";
/// The color of derived factors that are not printed.
const DERIVED: &str = "teal";
/// The space between factors.
const FACTORS: &str = r" \, ";

/// Prints tables of the differences, and a summary. Neighboring differences of an equation by the same mistake share
/// a table.
pub(super) fn markdown(comparison: &Comparison, robot: &Robot) -> String {
    let signs = Signs::of(robot);
    let same = |one: &Difference, next: &Difference| {
        name(one) == name(next) && one.mistakes == next.mistakes
    };
    let tables = comparison.differences.chunk_by(same).map(|group| table(group, &signs) + "\n");
    tables.collect::<String>() + &summary(comparison) + "\n"
}

/// The table of differences of one equation by the same mistake. Evidence about all of them is printed once.
fn table(group: &[Difference], signs: &Signs) -> String {
    let Some((first, others)) = group.split_first() else { return String::new() };
    let mistakes = first.mistakes.iter().map(|mistake| signs.mistake(mistake));
    let mistakes = mistakes.collect::<Vec<_>>().join(", ");
    let mut shown = format!("| {} | {mistakes} |\n|:--|:--|\n", text(&name(first)));
    let is_common = |evidence: &&Evidence| {
        !others.is_empty() && others.iter().all(|other| other.evidence.contains(evidence))
    };
    let common: Vec<&Evidence> = first.evidence.iter().filter(is_common).collect();
    let mut row = |title: &str, cell: &str| {
        // Writing to a string does not fail.
        let _ = writeln!(shown, "| {title} | {cell} |");
    };
    for difference in group {
        let [printed, derived] = signs.pair(difference);
        row("printed", &printed);
        row("derived", &derived);
        let own: Vec<&Evidence> =
            difference.evidence.iter().filter(|one| !common.contains(one)).collect();
        if !own.is_empty() {
            row("evidence", &joined(&own));
        }
    }
    if !common.is_empty() {
        row("each", &joined(&common));
    }
    shown
}

fn joined(evidence: &[&Evidence]) -> String {
    let all: Vec<String> = evidence.iter().map(|one| text(&one.to_string())).collect();
    all.join("; ")
}

/// Text for a cell: characters that Markdown would take for markup are escaped.
fn text(text: &str) -> String {
    let mut shown = String::new();
    for character in text.chars() {
        if matches!(character, '\\' | '|' | '*' | '`' | '<' | '&' | '[' | '$') {
            shown.push('\\');
        }
        shown.push(character);
    }
    shown
}

/// The printed forms of a robot's symbols and quantities.
struct Signs {
    graph: Graph,
    /// `None` if two symbols of the robot look the same; terms are then printed as text.
    symbols: Option<SymbolTable>,
}

impl Signs {
    fn of(robot: &Robot) -> Signs {
        let mut symbols = SymbolTable::new(robot, Trigonometry::Named).ok();
        for kind in Kind::ALL {
            for number in 1..=robot.links.len() {
                for component in 0..3 {
                    let component = kind.is_vector().then_some(component);
                    let symbol = Symbol { kind, number, component };
                    // A quantity that looks like a symbol of the robot keeps the layout of its name.
                    let _ = symbols
                        .as_mut()
                        .map(|symbols| symbols.define(&symbol.to_string(), Math::quantity(symbol)));
                }
            }
        }
        Signs { graph: Graph::new(), symbols }
    }

    /// The LaTeX of a factor.
    fn factor(&self, text: &str) -> Option<String> {
        let formula = Formula::parse_with_dots(text).ok()?;
        let value = formula.lower(&self.graph, &mut |name| self.graph.symbol(name));
        let math = self.symbols.as_ref()?.expression(value).ok()?;
        // GitHub does not support \operatorname, and a bar would end the cell.
        Some(latex::formula(&math).replace(r"\operatorname{", r"\mathrm{").replace('|', r"\vert "))
    }

    /// A product as a formula, or as text if a factor cannot be typeset. Factors that `other` lacks, and a sign that
    /// differs, are colored; if `other` is empty, the whole product is.
    fn shown(&self, product: &str, factors: &[&str], other: Option<&str>, color: &str) -> String {
        let typeset: Option<Vec<String>> =
            factors.iter().map(|factor| self.factor(factor)).collect();
        let Some(mut typeset) = typeset else {
            return format!("`{}`", product.replace('|', r"\|"));
        };
        let mut sign = split(product).0.to_owned();
        let colored = |latex: &str| format!(r"\textcolor{{{color}}}{{{latex}}}");
        match other {
            None => {}
            Some("") => return format!("$`{}`$", colored(&(sign + &typeset.join(FACTORS)))),
            Some(other) => {
                let (other_sign, others) = split(other);
                let both = typeset.iter_mut().zip(factors);
                for (latex, _) in both.filter(|(_, factor)| !others.contains(factor)) {
                    *latex = colored(latex);
                }
                if sign != other_sign {
                    sign = colored(if sign.is_empty() { "+" } else { "-" });
                }
            }
        }
        format!("$`{sign}{}`$", typeset.join(FACTORS))
    }

    /// The printed term and the derived one, with the factors that differ in color and the others at the same places.
    fn pair(&self, difference: &Difference) -> [String; 2] {
        let (printed, derived) = (difference.printed.as_deref(), difference.derived.as_deref());
        let missing = || "—".to_owned();
        let left = printed.map_or_else(missing, |term| {
            let other = derived.unwrap_or_default();
            let factors = alongside(&split(term).1, &split(other).1);
            self.shown(term, &factors, Some(other), PRINTED)
        });
        let right = match (derived, &difference.nearest) {
            (Some(term), _) => {
                self.shown(term, &split(term).1, Some(printed.unwrap_or_default()), DERIVED)
            }
            (None, Some(nearest)) => format!("— (nearest: {})", self.plain(nearest)),
            (None, None) => missing(),
        };
        [left, right]
    }

    /// A term or factor without colors.
    fn plain(&self, product: &str) -> String {
        self.shown(product, &split(product).1, None, PRINTED)
    }

    /// A mistake such as `dot: $`\dot{q}_1`$ for $`\ddot{q}_1`$`.
    fn mistake(&self, mistake: &Mistake) -> String {
        let kind = mistake.kind.name();
        match (&mistake.printed, &mistake.derived) {
            (Some(printed), Some(derived)) => {
                format!("{kind}: {} for {}", self.plain(printed), self.plain(derived))
            }
            (Some(one), None) | (None, Some(one)) => format!("{kind}: {}", self.plain(one)),
            (None, None) => kind.to_owned(),
        }
    }
}

/// The minus sign, if there is one, and the factors of a product.
fn split(product: &str) -> (&str, Vec<&str>) {
    let (sign, product) = match product.strip_prefix('-') {
        Some(rest) => ("-", rest),
        None => ("", product),
    };
    let mut depth = 0_u32;
    let factors = product.split(|sign| {
        match sign {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        sign == '*' && depth == 0
    });
    (sign, factors.collect())
}

/// The factors of a term. Those that another term also has stand in the same places as there; numbers come first.
fn alongside<'t>(factors: &[&'t str], others: &[&'t str]) -> Vec<&'t str> {
    let mut odd = factors.iter().copied().filter(|factor| !others.contains(factor));
    let mut placed: Vec<&str> = vec![];
    for other in others {
        match factors.contains(other) {
            true => placed.push(other),
            false => placed.extend(odd.next()),
        }
    }
    placed.extend(odd);
    placed.sort_by_key(|factor| !factor.starts_with(|sign: char| sign.is_ascii_digit()));
    placed
}

#[cfg(test)]
mod tests {
    use robot_check::errata::MistakeKind;

    use super::*;

    fn difference(printed: &str, derived: &str, kind: MistakeKind) -> Difference {
        let some = |text: &str| (!text.is_empty()).then(|| text.to_owned());
        Difference {
            number: String::new(),
            quantity: "Q1".to_owned(),
            line: 7,
            printed: some(printed),
            derived: some(derived),
            nearest: None,
            mistakes: vec![Mistake { kind, printed: None, derived: None }],
            evidence: vec![],
        }
    }

    fn comparison(differences: Vec<Difference>) -> Comparison {
        Comparison {
            equations: 1,
            names: 0,
            terms: 1,
            wrench: true,
            rounded: 0,
            unread: vec![],
            differences,
        }
    }

    fn planar_2r() -> Robot {
        robot_testing::robot("planar_2r")
    }

    /// The printed and the derived term of a table.
    fn pair(printed: &str, derived: &str) -> [String; 2] {
        Signs::of(&planar_2r()).pair(&difference(printed, derived, MistakeKind::Factor))
    }

    #[test]
    fn factors_that_differ_have_a_color_and_the_others_one_place() {
        assert_eq!(
            pair("qd1*m1*cos(q2)", "m1*cos(q2)*qdd1"),
            [
                r"$`m_1 \, \cos q_2 \, \textcolor{red}{\dot{q}_1}`$",
                r"$`m_1 \, \cos q_2 \, \textcolor{teal}{\ddot{q}_1}`$"
            ]
        );
        // A sign is colored, too, and a number stays in front.
        assert_eq!(
            pair("-3*m1*l1", "m1*qd2^2"),
            [
                r"$`\textcolor{red}{-}\textcolor{red}{3} \, m_1 \, \textcolor{red}{l_1}`$",
                r"$`\textcolor{teal}{+}m_1 \, \textcolor{teal}{\dot{q}_2^{2}}`$"
            ]
        );
        // All of a term without a counterpart is colored. Quantities look as in equations.
        let [printed, derived] = pair("", "F_l2.y*m1");
        assert_eq!(printed, "—");
        assert_eq!(derived, r"$`\textcolor{teal}{F_{l_y}^{2} \, m_1}`$");
    }

    #[test]
    fn differences_of_one_equation_by_one_mistake_share_a_table() {
        let units = Evidence::UnknownSymbol("a|b".to_owned());
        let of = |printed: &str, own: &str| Difference {
            evidence: vec![units.clone(), Evidence::SameTerm(vec![own.to_owned()])],
            ..difference(printed, "m2", MistakeKind::Index)
        };
        let extra = Difference {
            number: "3|4".to_owned(),
            derived: None,
            nearest: Some("m2".to_owned()),
            ..difference("m1", "", MistakeKind::ExtraTerm)
        };
        let all = comparison(vec![of("m1", "Q1"), of("l1", "Q2"), extra]);
        let shown = markdown(&all, &planar_2r());
        let expected = [
            "| Q1 | index |",
            "|:--|:--|",
            r"| printed | $`\textcolor{red}{m_1}`$ |",
            r"| derived | $`\textcolor{teal}{m_2}`$ |",
            "| evidence | the derived term appears in Q1 |",
            r"| printed | $`\textcolor{red}{l_1}`$ |",
            r"| derived | $`\textcolor{teal}{m_2}`$ |",
            "| evidence | the derived term appears in Q2 |",
            r"| each | the robot does not have the symbol a\|b |",
            "",
            r"| (3\|4) Q1 | extra term |",
            "|:--|:--|",
            r"| printed | $`\textcolor{red}{m_1}`$ |",
            "| derived | — (nearest: $`m_2`$) |",
            "",
            &summary(&all),
        ];
        assert_eq!(shown.lines().collect::<Vec<_>>(), expected);
        let none = comparison(vec![]);
        assert_eq!(markdown(&none, &planar_2r()), summary(&none) + "\n");
    }

    #[test]
    fn a_term_that_cannot_be_typeset_is_text() {
        let signs = Signs { graph: Graph::new(), symbols: None };
        assert_eq!(signs.plain("-m1*l1"), "`-m1*l1`");
    }
}
