//! What a plan depends on: the text whose hash is a pin's fingerprint.
//!
//! A [search](crate::economical::search) generates inverse dynamics without wrench and friction under each
//! candidate, counts its operations, holds its torques against the paper's iterations, and leaves the robot's
//! parameters free. So its result depends on
//!
//! - the tree of links, the kinds of joints and which coordinate moves each;
//! - gravity, placements, axes, ratios and offsets, bodies and drives as expressions, constant angles snapped as
//!   the file says: forms differ by which entries are zero, equal or constant.
//!
//! It does not depend on, and the text leaves out,
//!
//! - remarks, docs, units, LaTeX, the order of keys: no expression contains them;
//! - names of the robot, of links, joints and frames, and limits: no expression contains these either;
//! - nominal values of parameters: a search sees symbols;
//! - names of parameters and their order in the file: symbols are numbered in the order of their first use in
//!   the mechanism, so that merging two parameters gives another mechanism, and renaming one does not;
//! - friction, named frames and tips: they are added to the searched torques.
//!
//! Numbers in the place of a parameter count to the last digit, a mass of 2 or 3 as well. Most digits
//! change no form, but 0 and 1 do, numbers that are equal or cancel do, and the comparison of the torques was one
//! at those numbers. For values that change without changing the form, use parameters.
//!
//! Irrational constants stay symbols here ([`MechanismOptions::EXACT`]): the sine of an angle in floating point
//! may differ in a bit between platforms.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use robot_model::robot::{Friction, JointKind, Link, Robot};
use robot_symbolic::{Expr, Graph, Id, Number, View, walk};

use crate::mechanism::{Mechanism, MechanismLink, MechanismOptions};

/// Mechanisms with more expressions than this cannot become code.
const MAX_NODES: usize = 500_000;

/// All that a plan for the robot depends on, as text: equal texts mean equal plans.
///
/// A line for each expression, by the numbers of its operands, then a line for gravity and one for each link.
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

/// The robot without the properties that no plan depends on but expressions might contain.
fn bare(robot: &Robot) -> Robot {
    let links = robot.links.iter().map(|link| Link { friction: Friction::none(), ..link.clone() });
    // Parameters that are not listed become symbols in the order of their first use.
    Robot { parameters: vec![], frames: vec![], links: links.collect(), ..robot.clone() }
}

/// `link 0 revolute q2`, with the parent's number; `base` for none.
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

/// An expression by the numbers of its operands.
fn line(expr: Expr<'_>, numbers: &BTreeMap<Id, usize>) -> String {
    let at = |operand: Expr<'_>| numbers[&operand.id()];
    match expr.view() {
        View::Number(Number::Rational(value)) => value.to_string(),
        View::Number(Number::Real(value)) => format!("real {:016x}", value.to_bits()),
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
