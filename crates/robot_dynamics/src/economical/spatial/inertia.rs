//! The pseudo-inertias of links.

use robot_symbolic::{Expr, Graph};

use crate::economical::plan::Entry;
use crate::economical::spatial::Twist;
use crate::mechanism::MechanismLink;
use crate::vector::{Matrix, Vector};

/// The maximum rounding error of a moment that should vanish, relative to the largest moment.
const ROUNDING: f64 = 1e-14;

/// The mass distribution of a body in some frame: the blocks of the 4 × 4 pseudo-inertia P = \[\[Σ, h\], \[hᵀ, m\]\].
#[derive(Clone, Copy, Debug)]
pub(crate) struct PseudoInertia<'g> {
    /// Second moments Σ = ∫ r rᵀ dm, kg m²; the inertia tensor is tr(Σ) 1 − Σ.
    pub(crate) second: Matrix<'g>,
    /// First moment h = ∫ r dm, kg m.
    pub(crate) first: Vector<'g>,
    /// Mass m = ∫ dm, kg.
    pub(crate) mass: Expr<'g>,
}

impl<'g> PseudoInertia<'g> {
    pub(crate) fn zero(graph: &'g Graph) -> PseudoInertia<'g> {
        PseudoInertia {
            second: Matrix::zero(graph),
            first: Vector::zero(graph),
            mass: graph.zero(),
        }
    }

    /// The pseudo-inertia of a link, in the link's frame.
    pub(crate) fn of_link(link: &MechanismLink<'g>) -> PseudoInertia<'g> {
        let graph = link.mass.graph();
        let (inertia, center) = (link.inertia, link.center_of_mass);
        // About the center of mass, J = tr(Σ) 1 − Σ, and therefore tr J = 2 tr Σ.
        let central = Matrix::identity(graph) * (inertia.trace() / 2) - inertia;
        let first = center * link.mass;
        PseudoInertia { second: central + Matrix::outer(first, center), first, mass: link.mass }
    }

    /// The pseudo-inertia of masses on a line through the origin, given by the mass and the first and second moment
    /// along a unit vector.
    pub(crate) fn rod([mass, first, second]: [Expr<'g>; 3], direction: Vector<'g>) -> Self {
        PseudoInertia {
            second: Matrix::outer(direction, direction) * second,
            first: direction * first,
            mass,
        }
    }

    /// This body in a frame relative to which its own frame is at `origin` and rotated by `rotation`: T P Tᵀ.
    pub(crate) fn seen_from(self, rotation: Matrix<'g>, origin: Vector<'g>) -> PseudoInertia<'g> {
        let turned = rotation * self.first;
        let mixed = Matrix::outer(turned, origin);
        let second = rotation * self.second * rotation.transpose()
            + (mixed + mixed.transpose())
            + Matrix::outer(origin * self.mass, origin);
        PseudoInertia { second, first: turned + origin * self.mass, mass: self.mass }.symmetric()
    }

    /// This body in a frame that is at `origin` and rotated by `rotation` relative to its own frame.
    pub(crate) fn seen_in(self, rotation: Matrix<'g>, origin: Vector<'g>) -> PseudoInertia<'g> {
        let back = rotation.transpose();
        self.seen_from(back, -(back * origin))
    }

    pub(crate) fn plus(self, other: PseudoInertia<'g>) -> PseudoInertia<'g> {
        PseudoInertia {
            second: self.second + other.second,
            first: self.first + other.first,
            mass: self.mass + other.mass,
        }
    }

    pub(crate) fn minus(self, other: PseudoInertia<'g>) -> PseudoInertia<'g> {
        PseudoInertia {
            second: self.second - other.second,
            first: self.first - other.first,
            mass: self.mass - other.mass,
        }
    }

    /// The time derivative of P in axes at rest if the body moves with the twist: V P + P Vᵀ.
    pub(crate) fn rate(&self, motion: &Twist<'g>) -> PseudoInertia<'g> {
        let Twist { angular, linear } = *motion;
        let half = Matrix::skew(angular) * self.second + Matrix::outer(linear, self.first);
        let zero = self.mass.graph().zero();
        PseudoInertia {
            second: half + half.transpose(),
            first: angular.cross(self.first) + linear * self.mass,
            mass: zero,
        }
        .symmetric()
    }

    /// The entries that a rotation about z cannot distinguish from those of the parent: m, h_z and Σzz.
    pub(crate) fn along_z(self) -> [Expr<'g>; 3] {
        [self.mass, self.first.0[2], self.second.0[2][2]]
    }

    /// This body with other values of m, h_z and Σzz.
    pub(crate) fn with_along_z(mut self, [mass, first, second]: [Expr<'g>; 3]) -> Self {
        (self.mass, self.first.0[2], self.second.0[2][2]) = (mass, first, second);
        self
    }

    pub(crate) fn entry(&self, entry: Entry) -> Expr<'g> {
        let (Vector(h), Matrix(s)) = (self.first, self.second);
        match entry {
            Entry::X => h[0],
            Entry::Y => h[1],
            Entry::Xx => s[0][0],
            Entry::Yy => s[1][1],
            Entry::Xy => s[0][1],
            Entry::Xz => s[0][2],
            Entry::Yz => s[1][2],
            Entry::XxYy => s[0][0] - s[1][1],
        }
    }

    /// Sets an entry to exactly 0 that was made to vanish, because rounding would leave a residue.
    pub(crate) fn clear(&mut self, entry: Entry) {
        let zero = self.mass.graph().zero();
        let (Vector(h), Matrix(s)) = (&mut self.first, &mut self.second);
        match entry {
            Entry::X => h[0] = zero,
            Entry::Y => h[1] = zero,
            Entry::Xx => s[0][0] = zero,
            Entry::Yy => s[1][1] = zero,
            Entry::Xy => (s[0][1], s[1][0]) = (zero, zero),
            Entry::Xz => (s[0][2], s[2][0]) = (zero, zero),
            Entry::Yz => (s[1][2], s[2][1]) = (zero, zero),
            Entry::XxYy => s[1][1] = s[0][0],
        }
    }

    /// Sets moments to 0 that are small relative to the largest of their kind. They are rounding errors after a
    /// rotation by an angle that makes them vanish.
    pub(crate) fn clean(mut self) -> PseudoInertia<'g> {
        let zero = self.mass.graph().zero();
        let clean = |entries: &mut dyn Iterator<Item = &mut Expr<'g>>| {
            let mut entries: Vec<_> = entries.collect();
            let size = |entry: &Expr<'g>| entry.as_number().map_or(0.0, |n| n.to_f64().abs());
            let largest = entries.iter().map(|entry| size(entry)).fold(0.0, f64::max);
            for entry in &mut entries {
                let rounded = entry.as_number().is_some_and(|n| n.as_rational().is_none());
                if rounded && size(entry) < ROUNDING * largest {
                    **entry = zero;
                }
            }
        };
        clean(&mut self.first.0.iter_mut());
        clean(&mut self.second.0.iter_mut().flatten());
        self
    }

    /// Copies the upper triangle to the lower, so that both contain the same expressions.
    fn symmetric(mut self) -> PseudoInertia<'g> {
        let Matrix(s) = &mut self.second;
        (s[1][0], s[2][0], s[2][1]) = (s[0][1], s[0][2], s[1][2]);
        self
    }
}
