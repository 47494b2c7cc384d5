//! Articulated bodies: solves M x = b with a number of operations that is proportional to the number of links instead
//! of its third power.
//!
//! The method is that of R. Featherstone, "Rigid Body Dynamics Algorithms", 2008, section 7.2, for a mechanism at rest
//! and without gravity: the effects of motion and gravity are all contained in b. The joints are eliminated from the
//! tips inward; each elimination uses the inertia of the link and of everything that it carries.

use robot_model::robot::JointKind;
use robot_symbolic::{Expr, Graph};

use crate::economical::composite::symmetric;
use crate::economical::frames::Frames;
use crate::economical::frames::chain::{Chain, ChainLink};
use crate::economical::plan::{LinkPlan, Place};
use crate::economical::spatial::inertia::PseudoInertia;
use crate::economical::spatial::rotation::{ConstantRotation, Plane};
use crate::economical::spatial::{Twist, Wrench};
use crate::matrix::Pivots;
use crate::vector::{Matrix, Vector};

/// The inertia of a link and everything that it carries, with respect to its joint, if the joints farther outward are
/// free.
///
/// Unlike the mass of a rigid body, its mass may depend on the direction: a motion (ω, v) requires the moment I ω + H v
/// and the force Hᵀ ω + M v.
#[derive(Clone, Copy, Debug)]
struct ArticulatedInertia<'g> {
    /// The rotational part I, symmetric.
    turning: Matrix<'g>,
    /// The coupling H.
    coupling: Matrix<'g>,
    /// The mass M, symmetric.
    mass: Matrix<'g>,
}

/// An eliminated joint.
#[derive(Clone, Debug)]
struct Eliminated<'g> {
    /// U = I S plus the moment of the drive's gyroscopic rotor: the wrench that a unit acceleration of the joint
    /// requires from the parent, in home axes.
    required: Wrench<'g>,
    /// The pivot D = Sᵀ U plus the drive's reflected inertia.
    pivot: Expr<'g>,
    /// The reciprocal 1/D.
    reciprocal: Expr<'g>,
    /// The remaining force u = b − Sᵀ p.
    force: Expr<'g>,
}

/// The form in which inertias are transformed from a link's axes to its parent's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Turns {
    /// The form with the fewest operations.
    Cheap,
    /// A form that preserves the significant digits of small moments, for robots whose pivots may be small.
    Exact,
}

/// The options of the elimination of joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Method {
    pub(crate) turns: Turns,
    pub(crate) pivots: Pivots,
}

/// Whether each coordinate moves exactly one joint; otherwise joints cannot be eliminated one by one.
pub(crate) fn applies(chain: &Chain<'_>) -> bool {
    (0..chain.links.len()).all(|link| chain.drives_alone(link))
}

/// Solves M x = b, both ordered by coordinates, with one division for each joint. M must be positive definite.
pub(crate) fn solve<'g>(
    chain: &Chain<'g>,
    plans: &[LinkPlan],
    right: &[Expr<'g>],
    method: Method,
) -> Vec<Expr<'g>> {
    let frames = Frames::new(chain, |index| plans[index].composite_sum);
    let joints = inward(&frames, right, method);
    outward(&frames, &joints)
}

/// The pivot D of each coordinate: the inertia with respect to its joint if the joints farther outward are free.
pub(crate) fn pivots<'g>(chain: &Chain<'g>, plans: &[LinkPlan], method: Method) -> Vec<Expr<'g>> {
    let frames = Frames::new(chain, |index| plans[index].composite_sum);
    let mut pivots = vec![chain.graph.zero(); chain.degrees_of_freedom];
    let joints = inward(&frames, &pivots, method);
    for (link, joint) in chain.links.iter().zip(joints) {
        pivots[link.coordinate] = joint.pivot * link.ratio * link.ratio;
    }
    pivots
}

/// Eliminates the joints from the tips to the base.
fn inward<'g>(frames: &Frames<'_, 'g>, right: &[Expr<'g>], method: Method) -> Vec<Eliminated<'g>> {
    let chain = frames.chain;
    let zero = Carried::zero(chain.graph);
    // The sums over the children, separately in the link's own axes and in its home axes.
    let mut own: Vec<Carried<'g>> = chain
        .links
        .iter()
        .map(|link| Carried { inertia: ArticulatedInertia::of(&link.inertia), ..zero })
        .collect();
    let mut at_home = vec![zero; chain.links.len()];
    let mut joints = vec![];
    for (index, link) in chain.links.iter().enumerate().rev() {
        let joint_frame = &frames.joint_frames[index];
        let carried =
            own[index].turned(&joint_frame.group_turn, method.turns).plus(&at_home[index]);
        let joint = carried.joint(frames, index, right[link.coordinate], method.pivots);
        if let Some(parent) = link.parent {
            let rest = carried.without(&joint, link, chain.unit);
            if frames.is_joined(index) {
                at_home[parent] = at_home[parent].plus(&rest.moved(frames.arm_at_home(index)));
            } else {
                let moved = rest.rotated(&link.rotation, method.turns).moved(joint_frame.origin);
                own[parent] = own[parent].plus(&moved);
            }
        }
        joints.push(joint);
    }
    joints.reverse();
    joints
}

/// Computes the accelerations of the joints from the base to the tips.
fn outward<'g>(frames: &Frames<'_, 'g>, joints: &[Eliminated<'g>]) -> Vec<Expr<'g>> {
    let chain = frames.chain;
    let mut solution = vec![chain.graph.zero(); chain.degrees_of_freedom];
    // The acceleration of each link, in its home axes.
    let mut motions: Vec<Twist<'g>> = vec![];
    for (index, (link, joint)) in chain.links.iter().zip(joints).enumerate() {
        let carried = link.parent.map(|parent| {
            let place = Place { link: parent, turned: true };
            let own = match frames.is_joined(index) {
                true => motions[parent],
                false => frames.twist_outward(place, &motions[parent]),
            };
            frames.twist_outward(Place { link: index, turned: false }, &own)
        });
        // s = (u − Uᵀ A) / D
        let of_carrier = carried.map(|motion| motion.dot(&joint.required));
        let rate = of_carrier.map_or(joint.force, |of_carrier| joint.force - of_carrier)
            * joint.reciprocal;
        solution[link.coordinate] = rate / link.ratio;
        let by_joint = frames.joint_twist(index).times(rate);
        motions.push(carried.map_or(by_joint, |motion| motion.plus(&by_joint)));
    }
    solution
}

/// An articulated body: the inertia of a link and all that it carries, and a bias wrench.
#[derive(Clone, Copy, Debug)]
struct Carried<'g> {
    inertia: ArticulatedInertia<'g>,
    wrench: Wrench<'g>,
}

impl<'g> Carried<'g> {
    fn joint(
        &self,
        frames: &Frames<'_, 'g>,
        index: usize,
        right: Expr<'g>,
        pivots: Pivots,
    ) -> Eliminated<'g> {
        let link = &frames.chain.links[index];
        let direction = frames.joint_twist(index);
        let mut required = self.inertia.required_wrench(&direction);
        let pivot = direction.dot(&required) + link.reflected_inertia;
        required.moment.0[2] += link.rotor_coupling;
        Eliminated {
            required,
            pivot,
            reciprocal: pivots.reciprocal(pivot),
            force: right / link.ratio - direction.dot(&self.wrench),
        }
    }

    /// The remaining inertia and wrench after the joint is eliminated: I − U Uᵀ/D and p + U u/D.
    fn without(&self, joint: &Eliminated<'g>, link: &ChainLink<'g>, unit: Expr<'g>) -> Carried<'g> {
        let Eliminated { required, reciprocal, force, .. } = joint;
        let scaled =
            Wrench { force: required.force * *reciprocal, moment: required.moment * *reciprocal };
        let inertia = self.inertia.minus_product(required, &scaled);
        // (I − U Uᵀ/D) S = U (r − k)/D − k ẑ, with the reflected inertia r and the rotor coupling k; k does not affect
        // a prismatic joint itself. Without a drive, the product is 0.
        let own_coupling = match link.kind {
            JointKind::Revolute => link.rotor_coupling,
            JointKind::Prismatic => unit.graph().zero(),
        };
        let kept = (link.reflected_inertia - own_coupling) * *reciprocal;
        let mut along = Wrench { force: required.force * kept, moment: required.moment * kept };
        along.moment.0[2] -= link.rotor_coupling;
        let wrench = Wrench { force: scaled.force * *force, moment: scaled.moment * *force };
        Carried {
            inertia: inertia.with_along_joint(&along, link.kind, unit),
            wrench: self.wrench.plus(&wrench),
        }
    }
}

/// The transformations on the way to the parent.
impl<'g> Carried<'g> {
    fn zero(graph: &'g Graph) -> Self {
        Carried { inertia: ArticulatedInertia::zero(graph), wrench: Wrench::zero(graph) }
    }

    fn plus(&self, other: &Self) -> Self {
        let (a, b) = (&self.inertia, &other.inertia);
        let inertia = ArticulatedInertia {
            turning: a.turning + b.turning,
            coupling: a.coupling + b.coupling,
            mass: a.mass + b.mass,
        };
        Carried { inertia, wrench: self.wrench.plus(&other.wrench) }
    }

    /// The inertia in the axes from which a turn in the given plane leads to its own axes.
    fn turned(&self, plane: &Plane<'g>, turns: Turns) -> Self {
        let symmetric_tensor = |tensor| match turns {
            Turns::Cheap => plane.forward_symmetric(tensor),
            Turns::Exact => upper(plane.forward_entries(tensor)),
        };
        let inertia = ArticulatedInertia {
            turning: symmetric_tensor(self.inertia.turning),
            coupling: match turns {
                Turns::Cheap => plane.forward_tensor(self.inertia.coupling),
                Turns::Exact => plane.forward_entries(self.inertia.coupling),
            },
            mass: symmetric_tensor(self.inertia.mass),
        };
        Carried { inertia, wrench: self.wrench.turned_forward(plane) }
    }

    /// The inertia in the axes from which the given rotation leads to its own axes.
    fn rotated(&self, rotation: &ConstantRotation<'g>, turns: Turns) -> Self {
        let symmetric_tensor = |tensor| match turns {
            Turns::Cheap => rotation.forward_symmetric(tensor),
            Turns::Exact => upper(rotation.forward_entries(tensor)),
        };
        let inertia = ArticulatedInertia {
            turning: symmetric_tensor(self.inertia.turning),
            coupling: match turns {
                Turns::Cheap => rotation.forward_tensor(self.inertia.coupling),
                Turns::Exact => rotation.forward_entries(self.inertia.coupling),
            },
            mass: symmetric_tensor(self.inertia.mass),
        };
        let Wrench { force, moment } = self.wrench;
        let wrench = Wrench { force: rotation.forward(force), moment: rotation.forward(moment) };
        Carried { inertia, wrench }
    }

    /// The inertia about another origin; `arm` is the position of its own origin relative to that one.
    fn moved(&self, arm: Vector<'g>) -> Self {
        Carried { inertia: self.inertia.about(arm), wrench: self.wrench.about(arm) }
    }
}

/// The symmetric matrix with the upper triangle of the given one.
fn upper(Matrix(entries): Matrix<'_>) -> Matrix<'_> {
    symmetric(|i, j| entries[i][j])
}

impl<'g> ArticulatedInertia<'g> {
    fn zero(graph: &'g Graph) -> Self {
        let zero = Matrix::zero(graph);
        ArticulatedInertia { turning: zero, coupling: zero, mass: zero }
    }

    /// The inertia of one rigid body: I = tr(Σ) 1 − Σ, H = \[h\]×, M = m 1.
    fn of(body: &PseudoInertia<'g>) -> Self {
        let one = Matrix::identity(body.mass.graph());
        ArticulatedInertia {
            turning: one * body.second.trace() - body.second,
            coupling: Matrix::skew(body.first),
            mass: one * body.mass,
        }
    }

    fn required_wrench(&self, motion: &Twist<'g>) -> Wrench<'g> {
        let Twist { angular, linear } = *motion;
        Wrench {
            force: self.coupling.transpose() * angular + self.mass * linear,
            moment: self.turning * angular + self.coupling * linear,
        }
    }

    /// Subtracts the product of two wrenches, one a multiple of the other.
    fn minus_product(&self, a: &Wrench<'g>, b: &Wrench<'g>) -> Self {
        let minus = |Matrix(entries): Matrix<'g>, a: Vector<'g>, b: Vector<'g>| {
            move |i: usize, j: usize| entries[i][j] - a.0[i] * b.0[j]
        };
        ArticulatedInertia {
            turning: symmetric(minus(self.turning, a.moment, b.moment)),
            coupling: Matrix::from_fn(minus(self.coupling, a.moment, b.force)),
            mass: symmetric(minus(self.mass, a.force, b.force)),
        }
    }

    /// Replaces the wrench that a unit acceleration along the joint requires by its known value.
    fn with_along_joint(mut self, along: &Wrench<'g>, kind: JointKind, unit: Expr<'g>) -> Self {
        let Wrench { force, moment } = *along;
        for k in 0..3 {
            match kind {
                JointKind::Revolute => {
                    (self.turning.0[k][2], self.turning.0[2][k]) = (moment.0[k], moment.0[k]);
                    self.coupling.0[2][k] = force.0[k];
                }
                JointKind::Prismatic => {
                    // In the chain's unit of length, a translation of one meter is 1/unit.
                    self.coupling.0[k][2] = moment.0[k] * unit;
                    let entry = force.0[k] * unit;
                    (self.mass.0[k][2], self.mass.0[2][k]) = (entry, entry);
                }
            }
        }
        self
    }

    /// The inertia about another origin, with P = \[p\]× and the position p = `arm` of its own origin relative to that
    /// one: H + P M and I − H P + P (H + P M)ᵀ.
    fn about(&self, arm: Vector<'g>) -> Self {
        let p = Matrix::skew(arm);
        let coupling = self.coupling + p * self.mass;
        let (Matrix(before), Matrix(after)) = (self.coupling * p, p * coupling.transpose());
        let Matrix(turning) = self.turning;
        ArticulatedInertia {
            turning: symmetric(|i, j| turning[i][j] - before[i][j] + after[i][j]),
            coupling,
            mass: self.mass,
        }
    }
}
