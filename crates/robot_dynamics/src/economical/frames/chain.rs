//! The mechanism prepared for the economical recursion: working frames and regrouped inertias.

use robot_model::robot::JointKind;
use robot_symbolic::{Expr, Graph};

use crate::economical::frames::working::{self, WorkingFrame};
use crate::economical::plan::{Entry, LinkPlan, Plan};
use crate::economical::recursion::inward::TipWrench;
use crate::economical::spatial::inertia::PseudoInertia;
use crate::economical::spatial::rotation::ConstantRotation;
use crate::mechanism::{BaseMotion, Mechanism};
use crate::vector::{Matrix, Vector};

/// The factor that limits residuals and shifts, because differences of large numbers would lose digits. A residual may
/// be at most this many times the robot's own mass, first moment or second moment, and the origin of a working frame
/// may be at most this many times the robot's reach away.
const GROWTH_CAP: f64 = 3.0;

/// A mechanism in working frames.
#[derive(Clone, Debug)]
pub(crate) struct Chain<'g> {
    pub(crate) graph: &'g Graph,
    /// The acceleration of gravity in the base frame, in the plan's unit of length.
    pub(crate) gravity: Vector<'g>,
    pub(crate) links: Vec<ChainLink<'g>>,
    pub(crate) frames: Vec<WorkingFrame<'g>>,
    pub(crate) degrees_of_freedom: usize,
    /// The first moment that regrouping moved to the base, in the base frame.
    pub(crate) fixed_moment: Vector<'g>,
    /// The unit of length, m.
    pub(crate) unit: Expr<'g>,
    /// The motion of the base; `None` if it is at rest.
    pub(crate) base: Option<BaseMotion<'g>>,
}

/// The motion of a joint about or along z. For a prismatic joint, it is in the plan's unit of length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JointMotion<'g> {
    pub(crate) position: Expr<'g>,
    pub(crate) velocity: Expr<'g>,
    pub(crate) acceleration: Expr<'g>,
}

impl<'g> JointMotion<'g> {
    fn map(self, change: impl Fn(Expr<'g>) -> Expr<'g>) -> JointMotion<'g> {
        JointMotion {
            position: change(self.position),
            velocity: change(self.velocity),
            acceleration: change(self.acceleration),
        }
    }
}

/// A link in its working frame. Lengths are in the plan's unit.
#[derive(Clone, Debug)]
pub(crate) struct ChainLink<'g> {
    pub(crate) parent: Option<usize>,
    pub(crate) kind: JointKind,
    pub(crate) coordinate: usize,
    /// The joint's motion about or along z for a unit of the coordinate, including its sign.
    pub(crate) ratio: Expr<'g>,
    pub(crate) motion: JointMotion<'g>,
    /// The rotation from the parent's working frame to this one at joint position 0.
    pub(crate) rotation: ConstantRotation<'g>,
    /// The origin at joint position 0, in the parent's working frame.
    pub(crate) translation: Vector<'g>,
    /// The joint axis in the parent's working frame.
    pub(crate) axis: Vector<'g>,
    /// The regrouped pseudo-inertia.
    pub(crate) inertia: PseudoInertia<'g>,
    /// The reflected inertia of the drive, kg m² or kg.
    pub(crate) reflected_inertia: Expr<'g>,
    /// The angular momentum of a gyroscopic rotor at unit joint velocity, kg m² or kg m.
    pub(crate) rotor_coupling: Expr<'g>,
}

impl<'g> ChainLink<'g> {
    /// Whether the joint turns the link about an axis of symmetry of its mass, so that the rotation has no effect.
    fn turns_idly(&self) -> bool {
        match self.kind {
            JointKind::Revolute => self.is_symmetric(),
            JointKind::Prismatic => false,
        }
    }

    /// Whether the link's mass is axisymmetric about the joint axis.
    fn is_symmetric(&self) -> bool {
        let Matrix(second) = self.inertia.second;
        let [x, y, _] = self.inertia.first.0;
        let even = (second[0][0] - second[1][1]).is_zero();
        even && [second[0][1], second[0][2], second[1][2], x, y].iter().all(|entry| entry.is_zero())
    }

    /// Whether the joint axis is parallel to the parent's.
    pub(crate) fn is_parallel(&self) -> bool {
        self.axis.0[0].is_zero() && self.axis.0[1].is_zero() && self.axis.0[2].is_one()
    }
}

/// The part that does not depend on a plan: frames at the links' own origins, and the inertias of the links in them,
/// both original and regrouped.
#[derive(Clone, Debug)]
pub(crate) struct Base<'g> {
    file: Vec<WorkingFrame<'g>>,
    /// The inertias of the links, followed by that of the base, which is initially zero.
    inertias: Vec<PseudoInertia<'g>>,
    regrouped: Vec<PseudoInertia<'g>>,
    limits: Limits,
}

/// Limits on a plan, derived from the size of the robot.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// The maximum shift of an origin along its joint axis, m.
    pub(super) shift: f64,
    /// The maximum mass, first moment and second moment of a residual.
    residual: [f64; 3],
}

impl Limits {
    pub(super) fn of(mechanism: &Mechanism<'_>) -> Limits {
        let size = |expr: Expr<'_>| expr.as_number().map_or(0.0, |number| number.to_f64().abs());
        let links = &mechanism.links;
        let mass: f64 = links.iter().map(|link| size(link.mass)).sum();
        let lengths = links.iter().flat_map(|link| link.translation.0);
        let reach = lengths.map(size).sum::<f64>().max(1e-3);
        Limits {
            shift: GROWTH_CAP * reach,
            residual: [0, 1, 2].map(|power| GROWTH_CAP * mass * reach.powi(power)),
        }
    }
}

impl<'g> Base<'g> {
    /// Creates the base; `None` if a joint axis is not constant.
    pub(crate) fn new(mechanism: &Mechanism<'g>) -> Option<Base<'g>> {
        let file = working::file_frames(mechanism)?;
        let links = mechanism.links.iter().zip(&file);
        let inertias: Vec<_> = links
            .map(|(link, frame)| PseudoInertia::of_link(link).seen_in(frame.axes, frame.origin))
            .chain([PseudoInertia::zero(mechanism.graph)])
            .collect();
        let mut regrouped = inertias.clone();
        regroup(mechanism, &displacements(mechanism, &file), &mut regrouped);
        Some(Base { file, inertias, regrouped, limits: Limits::of(mechanism) })
    }
}

/// Prepares the mechanism for a plan.
pub(crate) fn prepare<'g>(mechanism: &Mechanism<'g>, base: &Base<'g>, plan: &Plan) -> Chain<'g> {
    let placed =
        working::place(mechanism, &plan.links, &base.file, &base.regrouped, base.limits.shift);
    let mut inertias = base.inertias.clone();
    for (inertia, (frame, file)) in inertias.iter_mut().zip(placed.iter().zip(&base.file)) {
        let back = file.axes.transpose();
        *inertia = inertia.seen_in(back * frame.axes, back * (frame.origin - file.origin));
    }
    let displacements = displacements(mechanism, &placed);
    regroup(mechanism, &displacements, &mut inertias);
    leave_residuals(mechanism, &plan.links, &displacements, &mut inertias, base.limits.residual);

    let mut chain = assemble(mechanism, &placed, &displacements, &inertias);
    if let Some((link, component)) = plan.unit_length {
        chain.rescale(link, component);
    }
    chain
}

impl<'g> Chain<'g> {
    /// The chain without rotations that do not affect any joint torque: those of last links that are axisymmetric about
    /// their joint axes and on which no wrench acts. The working frame of such a link need not turn with it, because
    /// velocities are the same vectors and the inertia has the same entries.
    pub(crate) fn without_idle_turns(&self, tips: &[TipWrench<'g>]) -> Chain<'g> {
        let mut chain = self.clone();
        let (zero, one) = (self.graph.zero(), self.graph.one());
        for (index, link) in chain.links.iter_mut().enumerate() {
            let is_last = self.links.iter().all(|other| other.parent != Some(index));
            let is_loaded = tips.iter().any(|tip| tip.link == index);
            if is_last && link.turns_idly() && !is_loaded {
                link.motion.position = zero;
                link.rotation.turn = (zero, one);
            }
        }
        chain
    }
}

type Displacement<'g> = (Matrix<'g>, Vector<'g>);

fn displacements<'g>(
    mechanism: &Mechanism<'g>,
    frames: &[WorkingFrame<'g>],
) -> Vec<Displacement<'g>> {
    let links = mechanism.links.iter().zip(frames);
    links
        .map(|(link, own)| working::between(link, own, link.parent.map(|parent| &frames[parent])))
        .collect()
}

/// Moves to each parent the inertia that the joint cannot distinguish from the parent's: for a revolute joint about z,
/// the mass and the moments along z; for a prismatic joint, all second moments.
fn regroup<'g>(
    mechanism: &Mechanism<'g>,
    displacements: &[Displacement<'g>],
    inertias: &mut [PseudoInertia<'g>],
) {
    for index in (0..mechanism.links.len()).rev() {
        move_inward(mechanism, displacements, inertias, index);
    }
}

fn move_inward<'g>(
    mechanism: &Mechanism<'g>,
    displacements: &[Displacement<'g>],
    inertias: &mut [PseudoInertia<'g>],
    index: usize,
) {
    let graph = mechanism.graph;
    let link = &mechanism.links[index];
    let own = inertias[index];
    let zero = PseudoInertia::zero(graph);
    let (moved, kept) = match link.kind {
        JointKind::Revolute => {
            let z = Matrix::identity(graph).column(2);
            let moved = PseudoInertia::rod(own.along_z(), z);
            (moved, own.with_along_z([graph.zero(); 3]))
        }
        JointKind::Prismatic => {
            let moved = PseudoInertia { second: own.second, ..zero };
            (moved, PseudoInertia { second: zero.second, ..own })
        }
    };
    inertias[index] = kept;
    // The base follows the links.
    let parent = link.parent.unwrap_or(mechanism.links.len());
    let (rotation, origin) = displacements[index];
    inertias[parent] = inertias[parent].plus(moved.seen_from(rotation, origin));
}

/// Moves some inertia back to the links, from the tips to the base, so that chosen entries of the parents vanish.
fn leave_residuals<'g>(
    mechanism: &Mechanism<'g>,
    plans: &[LinkPlan],
    displacements: &[Displacement<'g>],
    inertias: &mut [PseudoInertia<'g>],
    limits: [f64; 3],
) {
    for index in (0..mechanism.links.len()).rev() {
        let link = &mechanism.links[index];
        // The residuals of the children may have added inertia along this link's own axis.
        move_inward(mechanism, displacements, inertias, index);
        let parent = match link.kind {
            JointKind::Revolute => link.parent,
            JointKind::Prismatic => None,
        };
        let Some(parent) = parent else {
            continue;
        };
        let mut residual = [mechanism.graph.zero(); 3];
        for (kind, target) in plans[index].residual.iter().enumerate() {
            let Some(target) = target else { continue };
            let place = displacements[index];
            if let Some(amount) = solve(&inertias[parent], place, kind, *target, limits[kind]) {
                let mut rod = [mechanism.graph.zero(); 3];
                rod[kind] = amount;
                let taken = rod_at(rod, place);
                inertias[parent] = inertias[parent].minus(taken);
                inertias[parent].clear(*target);
                residual[kind] = amount;
            }
        }
        inertias[index] = inertias[index].with_along_z(residual);
    }
}

/// The inertia of a child along its joint axis, in the parent's working frame.
fn rod_at<'g>(rod: [Expr<'g>; 3], (rotation, origin): Displacement<'g>) -> PseudoInertia<'g> {
    PseudoInertia::rod(rod, Matrix::identity(rod[0].graph()).column(2)).seen_from(rotation, origin)
}

/// The amount of a kind (0: mass, 1: first moment, 2: second moment along the axis) that makes the parent's entry
/// vanish. `None` if no amount does, if the entry is already zero, or if the amount exceeds `limit`.
fn solve<'g>(
    parent: &PseudoInertia<'g>,
    place: Displacement<'g>,
    kind: usize,
    target: Entry,
    limit: f64,
) -> Option<Expr<'g>> {
    let wanted = parent.entry(target);
    if wanted.is_zero() {
        return None;
    }
    let graph = wanted.graph();
    let mut unit = [graph.zero(); 3];
    unit[kind] = graph.one();
    let effect = rod_at(unit, place).entry(target);
    let size = effect.as_number()?.to_f64().abs();
    if size < 1e-3 {
        return None;
    }
    let amount = wanted / effect;
    let acceptable = amount.as_number().is_none_or(|number| number.to_f64().abs() <= limit);
    acceptable.then_some(amount)
}

fn assemble<'g>(
    mechanism: &Mechanism<'g>,
    placed: &[WorkingFrame<'g>],
    displacements: &[Displacement<'g>],
    inertias: &[PseudoInertia<'g>],
) -> Chain<'g> {
    let links = mechanism.links.iter().enumerate().map(|(index, link)| {
        let (rotation, translation) = displacements[index];
        let along = |value: Expr<'g>| if placed[index].flipped { -value } else { value };
        let rotation = working::constant_rotation(rotation);
        ChainLink {
            parent: link.parent,
            kind: link.kind,
            coordinate: link.coordinate,
            ratio: along(link.ratio),
            motion: JointMotion {
                position: link.position,
                velocity: link.velocity,
                acceleration: link.acceleration,
            }
            .map(along),
            axis: rotation.axis(),
            rotation,
            translation,
            inertia: inertias[index].clean(),
            reflected_inertia: link.reflected_inertia,
            rotor_coupling: link.rotor_coupling,
        }
    });
    Chain {
        graph: mechanism.graph,
        gravity: mechanism.gravity,
        links: links.collect(),
        frames: placed.to_vec(),
        degrees_of_freedom: mechanism.degrees_of_freedom,
        fixed_moment: inertias[mechanism.links.len()].first,
        unit: mechanism.graph.one(),
        base: mechanism.base,
    }
}

impl<'g> Chain<'g> {
    /// The links whose parent is `link`.
    pub(crate) fn children(&self, link: usize) -> impl Iterator<Item = usize> {
        (link + 1..self.links.len()).filter(move |child| self.links[*child].parent == Some(link))
    }

    /// Converts a joint's position, velocity or acceleration from the plan's unit of length to rad or m.
    pub(crate) fn in_meters(&self, link: &ChainLink<'g>, motion: Expr<'g>) -> Expr<'g> {
        match link.kind {
            JointKind::Revolute => motion,
            JointKind::Prismatic => motion * self.unit,
        }
    }

    /// Whether any link carries a gyroscopic rotor.
    pub(crate) fn is_gyroscopic(&self) -> bool {
        self.links.iter().any(|link| !link.rotor_coupling.is_zero())
    }

    /// Whether the coordinate of this joint moves no other joint.
    pub(crate) fn drives_alone(&self, link: usize) -> bool {
        let coordinate = self.links[link].coordinate;
        self.links.iter().filter(|other| other.coordinate == coordinate).count() == 1
            && self.links[link].ratio.as_number().is_some_and(|ratio| !ratio.is_zero())
    }

    /// Makes a component of a link's position the unit of length. Second moments and torques remain in meters: r and a
    /// are divided by the unit, h is multiplied by it, and m by its square.
    fn rescale(&mut self, link: usize, component: usize) {
        let Some(length) = self.links.get(link).map(|link| link.translation.0[component]) else {
            return;
        };
        let usable = length.as_number().is_some_and(|number| number.to_f64().abs() > 1e-3);
        if !usable {
            return;
        }
        self.unit = length;
        self.gravity = self.gravity.map(|entry| entry / length);
        if let Some(base) = &mut self.base {
            base.acceleration = base.acceleration.map(|entry| entry / length);
        }
        self.fixed_moment = self.fixed_moment * length;
        for link in &mut self.links {
            link.translation = link.translation.map(|entry| entry / length);
            link.inertia.first = link.inertia.first * length;
            link.inertia.mass = link.inertia.mass * length * length;
            match link.kind {
                JointKind::Revolute => {}
                JointKind::Prismatic => link.motion = link.motion.map(|value| value / length),
            }
        }
    }
}
