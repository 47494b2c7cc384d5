//! The properties of a robot on which a plan depends, as text; the hash of this text is the fingerprint of a pinned
//! plan.
//!
//! A [search](crate::economical::search) derives inverse dynamics without wrench and friction for each candidate,
//! counts its operations, and compares its torques with those of the paper's iterations. The robot's parameters remain
//! symbols. The result therefore depends on
//!
//! - the tree of links, the kinds of the joints, and the coordinate that moves each joint;
//! - gravity, placements, axes, ratios and offsets, bodies and drives as expressions, in which constant angles are
//!   snapped as the file specifies: forms differ by which entries are zero, equal or constant.
//!
//! It does not depend on the following properties, and the text does not contain them:
//!
//! - remarks, documentation, units, LaTeX and the order of keys: they do not occur in expressions;
//! - the names of the robot, of links, joints and frames, and limits: they do not occur in expressions either;
//! - nominal values of parameters: a search only uses symbols;
//! - the names of parameters and their order in the file: symbols are numbered in the order of their first use in the
//!   mechanism, so that merging two parameters gives another mechanism, but renaming one does not;
//! - friction, named frames and tips: they are added to the torques whose operations the search counts.
//!
//! A number that is used instead of a parameter is significant to its last digit, even if it is a mass of 2 or 3. Most
//! digits do not change the form, but 0 and 1, equal numbers and numbers that cancel do, and the torques were compared
//! at these numbers. For values that change without changing the form, use parameters.
//!
//! Irrational constants remain symbolic here ([`MechanismOptions::EXACT`]), because the sine of an angle in floating
//! point may differ by a bit between platforms.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use robot_model::robot::{Friction, JointKind, Link, Robot};
use robot_symbolic::{Expr, Graph, Id, Number, View, walk};

use crate::mechanism::{Mechanism, MechanismLink, MechanismOptions};

/// The maximum number of expressions of a mechanism; larger mechanisms cannot be converted to code.
const MAX_NODES: usize = 500_000;

/// The text of everything on which a plan for the robot depends: robots with equal texts have equal plans.
///
/// There is one line for each expression, which refers to its operands by number, then one line for gravity and one for
/// each link.
#[must_use]
pub fn mechanics(robot: &Robot) -> String {
    let graph = Graph::limited(MAX_NODES);
    let bare = bare(robot);
    let mechanism = Mechanism::new(&bare, &graph, &MechanismOptions::EXACT.with_snap(None, &bare));
    let mut roots = vec![mechanism.gravity.0.to_vec()];
    roots.extend(mechanism.links.iter().map(expressions));

    let mut text = String::new();
    let mut numbers: BTreeMap<Id, usize> = BTreeMap::new();
    for expr in walk::reachable(&roots.concat()) {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{}", line(expr, &numbers));
        numbers.insert(expr.id(), numbers.len());
    }
    let joints = mechanism.links.iter().map(joint);
    for (title, exprs) in std::iter::once("gravity".to_owned()).chain(joints).zip(roots) {
        let places = exprs.iter().map(|expr| numbers[&expr.id()].to_string());
        let _ = writeln!(text, "{title}: {}", places.collect::<Vec<_>>().join(" "));
    }
    text
}

/// The robot without properties that may occur in expressions but do not affect a plan.
fn bare(robot: &Robot) -> Robot {
    let links = robot.links.iter().map(|link| Link { friction: Friction::none(), ..link.clone() });
    // Parameters that are not declared become symbols in the order of their first use.
    Robot { parameters: vec![], frames: vec![], links: links.collect(), ..robot.clone() }
}

/// The text for a joint, such as `link 0 revolute q2`, which begins with its parent, or with `base`.
fn joint(link: &MechanismLink<'_>) -> String {
    let parent = link.parent.map_or("base".to_owned(), |parent| format!("link {parent}"));
    let kind = match link.kind {
        JointKind::Revolute => "revolute",
        JointKind::Prismatic => "prismatic",
    };
    format!("{parent} {kind} q{}", link.coordinate + 1)
}

/// The expressions of a link in a fixed order.
fn expressions<'g>(link: &MechanismLink<'g>) -> Vec<Expr<'g>> {
    let matrices = [link.rotation, link.inertia].map(|matrix| matrix.0.concat()).concat();
    let vectors = [link.translation, link.axis, link.center_of_mass].map(|vector| vector.0);
    let MechanismLink { ratio, position, mass, reflected_inertia, rotor_coupling, .. } = *link;
    let scalars = [ratio, position, mass, reflected_inertia, rotor_coupling];
    [matrices, vectors.concat(), scalars.to_vec()].concat()
}

/// An expression as text, in which operands are given by their numbers.
fn line(expr: Expr<'_>, numbers: &BTreeMap<Id, usize>) -> String {
    let at = |operand: Expr<'_>| numbers[&operand.id()];
    match expr.view() {
        View::Number(Number::Rational(value)) => value.to_string(),
        View::Number(Number::Real(real)) => format!("real {:016x}", real.value().to_bits()),
        View::Pi => "pi".to_owned(),
        View::Symbol(symbol) => format!("symbol {}", symbol.index()),
        View::Add(a, b) => format!("{} + {}", at(a), at(b)),
        View::Sub(a, b) => format!("{} - {}", at(a), at(b)),
        View::Mul(a, b) => format!("{} * {}", at(a), at(b)),
        View::Div(a, b) => format!("{} / {}", at(a), at(b)),
        View::Neg(a) => format!("-{}", at(a)),
        View::Call(function, a) => format!("{} {}", function.name(), at(a)),
    }
}
