//! Compares planar arms with formulas of the textbooks, derived by hand: the differences of M, C, g and the tip's
//! Jacobian from those of the functions expand to zero.

use robot_dynamics::economical::Plan;
use robot_dynamics::economical::plan::LinkPlan;
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::functions::FunctionKind;
use robot_symbolic::polynomial::equal;
use robot_symbolic::{Expr, Formula, Graph};

/// The entries of a function according to the textbook.
type Entries = (FunctionKind, Vec<String>);

/// Compares functions with formulas, for the default plan of the recursion and for a uniform basic plan.
fn hold(name: &str, textbook: &[Entries]) {
    let robot = robot_testing::robot(name);
    let graph = Graph::new();
    let derivation = Derivation::new(&robot, &graph, &MechanismOptions::EXACT, None);
    let basic = derivation.with_plan(&Plan::uniform(robot.links.len(), &LinkPlan::BASIC));
    for (kind, entries) in textbook {
        let expected: Vec<Expr<'_>> = entries.iter().map(|text| expression(&graph, text)).collect();
        for derivation in [&derivation, &basic] {
            let mut functions = derivation.functions(*kind);
            assert_eq!(functions.len(), 1, "{name}: {}", kind.name());
            let found = functions.remove(0).outputs.remove(0).values;
            assert_eq!(found.len(), expected.len(), "{name}: {}", kind.name());
            for (index, (found, expected)) in found.iter().zip(&expected).enumerate() {
                let equal = equal(*found, *expected).unwrap();
                assert!(equal, "{name}: entry {index} of {} is another", kind.name());
            }
        }
    }
}

fn expression<'g>(graph: &'g Graph, text: &str) -> Expr<'g> {
    let formula = Formula::parse(text).unwrap_or_else(|error| panic!("{text}: {}", error.message));
    formula.lower(graph, &mut |name| graph.symbol(name))
}

fn texts(entries: &[&str]) -> Vec<String> {
    entries.iter().map(|&entry| entry.to_owned()).collect()
}

/// The planar elbow manipulator of M. W. Spong, S. Hutchinson, M. Vidyasagar, "Robot Modeling and
/// Control", Wiley 2006, section 7.4, with r for the distances of the centers of mass.
#[test]
fn the_planar_elbow_arm() {
    let h = "(-m2*l1*r2*sin(q2))";
    hold(
        "planar_2r",
        &[
            (
                FunctionKind::MassMatrix,
                texts(&[
                    "m1*r1^2 + m2*(l1^2 + r2^2 + 2*l1*r2*cos(q2)) + I1 + I2",
                    "m2*(r2^2 + l1*r2*cos(q2)) + I2",
                    "m2*(r2^2 + l1*r2*cos(q2)) + I2",
                    "m2*r2^2 + I2",
                ]),
            ),
            (
                FunctionKind::CoriolisMatrix,
                vec![
                    format!("{h}*qd2"),
                    format!("{h}*(qd1 + qd2)"),
                    format!("-{h}*qd1"),
                    "0".to_owned(),
                ],
            ),
            (
                FunctionKind::Gravity,
                texts(&[
                    "(m1*r1 + m2*l1)*g*cos(q1) + m2*r2*g*cos(q1 + q2)",
                    "m2*r2*g*cos(q1 + q2)",
                ]),
            ),
            (
                FunctionKind::Bias,
                vec![
                    format!(
                        "{h}*(2*qd1*qd2 + qd2^2) + (m1*r1 + m2*l1)*g*cos(q1) + m2*r2*g*cos(q1 + q2)"
                    ),
                    format!("-{h}*qd1^2 + m2*r2*g*cos(q1 + q2)"),
                ],
            ),
        ],
    );
}

/// A chain of n links in a plane, described by the absolute angles θᵢ = q₁ + … + qᵢ of its links. Link j has the mass
/// mⱼ, the distance rⱼ of the center of mass and the length lⱼ, and Lᵢ = lᵢ Σ mₖ over k > i is the first moment of what
/// link i carries. The kinetic energy is ½ Σ aᵢⱼ cos(θᵢ − θⱼ) θ̇ᵢ θ̇ⱼ with aᵢᵢ = Iᵢ + mᵢ rᵢ² + lᵢ Lᵢ and aᵢⱼ = lᵢ (mⱼ
/// rⱼ + Lⱼ) for i < j. The Christoffel symbols give Cᵢⱼ = aᵢⱼ sin(θᵢ − θⱼ) θ̇ⱼ, and gravity contributes (mᵢ rᵢ + Lᵢ) g
/// cos θᵢ. A change of qᵢ changes θ of link i and all links farther outward, so the entries of the matrices for q are
/// sums over these links.
struct PlanarChain {
    links: usize,
}

impl PlanarChain {
    fn carried(&self, link: usize) -> String {
        let masses: Vec<String> =
            (link + 1..=self.links).map(|other| format!("m{other}")).collect();
        if masses.is_empty() { "0".to_owned() } else { format!("l{link}*({})", masses.join(" + ")) }
    }

    /// The coefficient aᵢⱼ.
    fn inertia(&self, i: usize, j: usize) -> String {
        let (inner, outer) = (i.min(j), i.max(j));
        match inner == outer {
            true if i == self.links => format!("(I{i} + m{i}*r{i}^2)"),
            true => format!("(I{i} + m{i}*r{i}^2 + l{i}*{})", self.carried(i)),
            false => format!("l{inner}*(m{outer}*r{outer} + {})", self.carried(outer)),
        }
    }

    /// The sum of entries over all links from `row` and from `column` outward.
    fn sum(&self, row: usize, column: usize, entry: impl Fn(usize, usize) -> String) -> String {
        let pairs = (row..=self.links).flat_map(|i| (column..=self.links).map(move |j| (i, j)));
        pairs.map(|(i, j)| entry(i, j)).collect::<Vec<_>>().join(" + ")
    }

    fn matrix(&self, entry: impl Fn(usize, usize) -> String) -> Vec<String> {
        let entries = (1..=self.links).flat_map(|row| (1..=self.links).map(move |c| (row, c)));
        entries.map(|(row, column)| self.sum(row, column, &entry)).collect()
    }

    fn entries(&self) -> Vec<Entries> {
        let angle = |link: usize| added("q", link);
        let weights = |joint: usize| -> String {
            let weight =
                |i: usize| format!("(m{i}*r{i} + {})*g*cos({})", self.carried(i), angle(i));
            (joint..=self.links).map(weight).collect::<Vec<_>>().join(" + ")
        };
        vec![
            (
                FunctionKind::MassMatrix,
                self.matrix(|i, j| {
                    format!("{}*cos({} - ({}))", self.inertia(i, j), angle(i), angle(j))
                }),
            ),
            (
                FunctionKind::CoriolisMatrix,
                self.matrix(|i, j| {
                    let inertia = self.inertia(i, j);
                    format!("{inertia}*sin({} - ({}))*({})", angle(i), angle(j), added("qd", j))
                }),
            ),
            (FunctionKind::Gravity, (1..=self.links).map(weights).collect()),
            (FunctionKind::Jacobian, self.jacobian()),
        ]
    }

    /// The Jacobian of the tip, whose position is Σ lᵢ (cos θᵢ, sin θᵢ).
    fn jacobian(&self) -> Vec<String> {
        let sum = |joint: usize, function: &str| -> String {
            let term = |i: usize| format!("l{i}*{function}({})", added("q", i));
            (joint..=self.links).map(term).collect::<Vec<_>>().join(" + ")
        };
        let rows: [&dyn Fn(usize) -> String; 6] = [
            &|joint| format!("-({})", sum(joint, "sin")),
            &|joint| sum(joint, "cos"),
            &|_| "0".to_owned(),
            &|_| "0".to_owned(),
            &|_| "0".to_owned(),
            &|_| "1".to_owned(),
        ];
        rows.iter().flat_map(|row| (1..=self.links).map(row)).collect()
    }
}

/// The sum q1 + q2 + … up to the given link.
fn added(prefix: &str, link: usize) -> String {
    (1..=link).map(|number| format!("{prefix}{number}")).collect::<Vec<_>>().join(" + ")
}

#[test]
fn planar_chains() {
    for (name, links) in [("planar_2r", 2), ("planar_3r", 3)] {
        hold(name, &PlanarChain { links }.entries());
    }
}
