//! Composite inertias: each link with all that it carries, as one rigid body.

use super::inertia::PseudoInertia;
use super::rotation::Plane;
use super::spatial::{Ways, Wrench};
use crate::vector::{Matrix, Vector};

/// The composite pseudo-inertia of every link about its origin, in its home axes.
///
/// Mass that was regrouped is where it was regrouped to, so that behind rotations a composite has
/// no mass: only its action on the joint axes is that of the robot.
pub(crate) fn composites<'g>(ways: &Ways<'_, 'g>) -> Vec<PseudoInertia<'g>> {
    let chain = ways.chain;
    // What children hand over, in the link's own axes and in its home axes.
    let none = PseudoInertia::zero(chain.graph);
    let mut own: Vec<PseudoInertia<'g>> = chain.links.iter().map(|link| link.inertia).collect();
    let mut handed = vec![none; chain.links.len()];
    let mut at_home = vec![none; chain.links.len()];
    let mut composites = vec![none; chain.links.len()];
    for (index, link) in chain.links.iter().enumerate().rev() {
        let posture = &ways.postures[index];
        let in_own_axes = own[index].plus(handed[index]);
        composites[index] = turned(&in_own_axes, &posture.group_turn).plus(at_home[index]);
        let Some(parent) = link.parent else { continue };
        let composite = composites[index];
        if ways.is_joined(index) {
            let (constant, rest) = moved(&composite, ways.arm_at_home(index));
            at_home[parent] = at_home[parent].plus(rest.plus(constant));
        } else {
            let outer = PseudoInertia {
                second: link.rotation.forward_symmetric(composite.second),
                first: link.rotation.forward(composite.first),
                mass: composite.mass,
            };
            let (constant, rest) = moved(&outer, posture.origin);
            // Constants first, so that they fold into the parent's own.
            own[parent] = own[parent].plus(constant);
            handed[parent] = handed[parent].plus(rest);
        }
    }
    composites
}

fn turned<'g>(inertia: &PseudoInertia<'g>, plane: &Plane<'g>) -> PseudoInertia<'g> {
    PseudoInertia {
        second: plane.forward_symmetric(inertia.second),
        first: plane.forward(inertia.first),
        mass: inertia.mass,
    }
}

/// The inertia about an origin from which its own lies at `arm`: what the mass alone brings, and
/// the rest, Σ + h pᵀ + p hᵀ and h.
fn moved<'g>(
    inertia: &PseudoInertia<'g>,
    arm: Vector<'g>,
) -> (PseudoInertia<'g>, PseudoInertia<'g>) {
    let (Vector(h), Vector(p)) = (inertia.first, arm);
    let shift = arm * inertia.mass;
    let mass = PseudoInertia {
        second: symmetric(|a, b| shift.0[a] * p[b]),
        first: shift,
        mass: inertia.mass,
    };
    let Matrix(s) = inertia.second;
    let second = symmetric(|a, b| match a == b {
        true => s[a][a] + h[a] * (p[a] * 2),
        false => s[a][b] + (h[a] * p[b] + p[a] * h[b]),
    });
    let zero = inertia.mass.graph().zero();
    (mass, PseudoInertia { second, first: inertia.first, mass: zero })
}

fn symmetric<'g>(entry: impl Fn(usize, usize) -> robot_symbolic::Expr<'g>) -> Matrix<'g> {
    Matrix::from_fn(|a, b| entry(a.min(b), a.max(b)))
}

/// The wrench that a unit acceleration of a link's joint asks of all that the link carries, in the
/// link's home axes: P ẑ.
pub(crate) fn unit_wrench<'g>(
    ways: &Ways<'_, 'g>,
    link: usize,
    composite: &PseudoInertia<'g>,
) -> Wrench<'g> {
    let zero = ways.chain.graph.zero();
    let (Vector(h), Matrix(s)) = (composite.first, composite.second);
    if ways.chain.links[link].is_revolute() {
        // U = [z]×: F = U h, and the moment of r × U r over the body.
        return Wrench {
            force: Vector([-h[1], h[0], zero]),
            moment: Vector([-s[0][2], -s[1][2], s[0][0] + s[1][1]]),
        };
    }
    let per_metre = |vector: Vector<'g>| vector.map(|entry| entry / ways.chain.unit);
    Wrench {
        force: per_metre(Vector([zero, zero, composite.mass])),
        moment: per_metre(Vector([h[1], -h[0], zero])),
    }
}
