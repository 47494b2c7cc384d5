//! The joint torques as linear functions of the links' inertial parameters.
//!
//! A unit of each of a link's ten parameters ([`crate::body`]) requires a wrench, which is propagated inward and
//! projected on the joints. Not all ten wrenches are needed: a parameter that a joint cannot distinguish from the
//! parent's own parameters (for a revolute joint about z the mass and the moments along z, for a prismatic joint the
//! whole tensor) has the same contribution as the equivalent parameters of the parent. This is the regrouping of Khalil
//! and Dombre (Modeling, Identification and Control of Robots, section 9.4), used in reverse: there it eliminates
//! parameters, here it saves the computation of columns.
//!
//! The last six parameters of a link are the entries of its inertia tensor or its second moments ([`Moments`]). The
//! wrenches of second moments have more zeros and share more products: with them instead of the tensor, the base
//! regressor of an arm with seven joints needs 52 fewer of its more than a thousand operations.

use robot_model::robot::JointKind;
use robot_model::robot::LINK_PARAMETERS;
use robot_symbolic::Expr;

use crate::body::{Body, FIRST_MOMENT, Moments, TENSOR};
use crate::economical::Recursion;
use crate::economical::composite::projection::{Propagated, projections};
use crate::economical::frames::Frames;
use crate::economical::frames::chain::ChainLink;
use crate::economical::plan::{LinkPlan, Origin, Place, Plan, Turn};
use crate::economical::recursion::outward::{self, Accelerations, LinkState};
use crate::economical::spatial::Wrench;
use crate::economical::spatial::rotation::Plane;
use crate::mechanism::Mechanism;
use crate::vector::{Matrix, Vector};

/// The indices of the parameters that a rotation about z distinguishes from the parent's; I_yy is left out.
const IDENTIFIABLE_BY_ROTATION: [usize; 7] = [1, 2, 4, 5, 7, 8, 9];
/// The same indices if the last six parameters are second moments.
const IDENTIFIABLE_SECOND_MOMENTS: [usize; 7] = [1, 2, 4, 5, 6, 7, 8];
/// The indices of the parameters that a translation distinguishes from the parent's.
const IDENTIFIABLE_BY_TRANSLATION: [usize; 4] = [0, 1, 2, 3];

/// The options of the recursion for regressors: those that need the fewest operations for most arms. The regressor does
/// not use the options of the plan, because its parameters always refer to the links' frames.
const REGRESSOR_PLAN: LinkPlan = LinkPlan {
    origin: Origin::File,
    turn: Turn::File,
    angle_sum: true,
    column: true,
    diagonal: true,
    ..LinkPlan::BASIC
};
/// The group of parallel joints, counted from the base, to whose axes the wrenches of links farther outward are
/// propagated. The motions of the joints inward of it are transformed to these axes once for all wrenches.
const PROJECTION_GROUP: usize = 3;

/// The contribution of a unit of one parameter to each joint torque.
pub type Column<'g> = Vec<Expr<'g>>;

/// The columns of a regressor.
#[derive(Clone, Debug)]
pub struct RegressorColumns<'g> {
    /// Ten columns for each link: for the parameters about the origin and in the axes of the link's frame.
    pub links: Vec<Column<'g>>,
    /// One column for each link: for the coupling of its drive's rotor with the link that carries the rotor
    /// ([`crate::mechanism::MechanismLink::rotor_coupling`]); 0 if the base carries the rotor.
    pub rotors: Vec<Column<'g>>,
}

/// A unit of the mass (0), first moment (1) or second moment (2) of masses on the line through `p` along the unit
/// vector `z`; distances on the line are measured from `p`.
fn rod<'g>(kind: usize, z: Vector<'g>, p: Vector<'g>, moments: Moments) -> Body<'g> {
    let graph = z.0[0].graph();
    let (zero, one, none) = (graph.zero(), graph.one(), Vector::zero(graph));
    let (mass, first, second) = match kind {
        0 => (one, p, Matrix::outer(p, p)),
        1 => (zero, z, Matrix::outer(z, p) + Matrix::outer(p, z)),
        _ => (zero, none, Matrix::outer(z, z)),
    };
    Body { mass, first, tensor: moments.of_second(second) }
}

/// The contribution of a body to the joint torques, computed from the contributions of unit parameters in the same
/// frame.
fn combination<'g>(body: &Body<'g>, units: &[Column<'g>]) -> Column<'g> {
    let mut combination: Column<'g> = vec![];
    for (amount, unit) in body.parameters().into_iter().zip(units) {
        if combination.is_empty() {
            combination = vec![amount.graph().zero(); unit.len()];
        }
        for (sum, entry) in combination.iter_mut().zip(unit) {
            *sum += amount * *entry;
        }
    }
    combination
}

/// The wrenches, about the origin, that a unit of each parameter requires at given U, ω, ε and acceleration of the
/// origin: f = m a + U h, n = h × a + I ε + ω × I ω.
///
/// With `diagonal`, differences of squared angular velocities are computed from the diagonal of U.
pub(crate) fn unit_wrenches<'g>(
    tensor: Matrix<'g>,
    omega: Vector<'g>,
    epsilon: Vector<'g>,
    acceleration: Vector<'g>,
    diagonal: bool,
) -> [Wrench<'g>; LINK_PARAMETERS] {
    let (Matrix(u), Vector(w), Vector(e)) = (tensor, omega, epsilon);
    let graph = w[0].graph();
    let (zero, none) = (graph.zero(), Vector::zero(graph));
    let unit = Matrix::identity(graph);
    // ω_a² − ω_b²
    let difference = |a: usize, b: usize| match diagonal {
        true => u[a][a] - u[b][b],
        false => w[a] * w[a] - w[b] * w[b],
    };
    let [xy, xz, yz] = [w[0] * w[1], w[0] * w[2], w[1] * w[2]];
    let first =
        |k: usize| Wrench { force: tensor.column(k), moment: unit.column(k).cross(acceleration) };
    let moment = |x, y, z| Wrench { force: none, moment: Vector([x, y, z]) };
    [
        Wrench { force: acceleration, moment: Vector([zero; 3]) },
        first(0),
        first(1),
        first(2),
        moment(e[0], xz, -xy),
        // U_zx = ω_x ω_z − ε_y and so on
        moment(-u[2][0], u[2][1], difference(0, 1)),
        moment(-yz, e[1], xy),
        moment(u[1][0], difference(2, 0), -u[1][2]),
        moment(difference(1, 2), -u[0][1], u[0][2]),
        moment(yz, -xz, e[2]),
    ]
}

/// The unit wrenches if the last six parameters are second moments: n = ∫ r × U r dm.
fn second_moment_wrenches<'g>(state: &LinkState<'g>) -> [Wrench<'g>; LINK_PARAMETERS] {
    let (Matrix(u), Vector(w)) = (state.tensor, state.angular_velocity);
    let graph = w[0].graph();
    let (zero, none, unit) = (graph.zero(), Vector::zero(graph), Matrix::identity(graph));
    let moment = |x, y, z| Wrench { force: none, moment: Vector([x, y, z]) };
    let first = |k: usize| Wrench {
        force: state.tensor.column(k),
        moment: unit.column(k).cross(state.acceleration),
    };
    [
        Wrench { force: state.acceleration, moment: none },
        first(0),
        first(1),
        first(2),
        moment(zero, -u[2][0], u[1][0]),
        moment(u[2][0], -u[2][1], u[1][1] - u[0][0]),
        moment(u[2][1], zero, -u[0][1]),
        // U_xx − U_zz = ω_x² − ω_z²; these squares are also used to compute U_xx.
        moment(-u[1][0], w[0] * w[0] - w[2] * w[2], u[1][2]),
        moment(u[2][2] - u[1][1], u[0][1], -u[0][2]),
        moment(-u[1][2], u[0][2], zero),
    ]
}

/// The torque a · ε that a rotor requires at its joint for a unit of its coupling, and the moment q̈ a + q̇ ω × a that
/// it requires from the link that carries it. All vectors are in the carrier's axes: a is the joint axis, and ω and ε
/// are those of the carrier.
pub(crate) fn unit_rotor<'g>(
    axis: Vector<'g>,
    [velocity, acceleration]: [Expr<'g>; 2],
    omega: Vector<'g>,
    epsilon: Vector<'g>,
) -> (Expr<'g>, Vector<'g>) {
    (axis.dot(epsilon), axis * acceleration + omega.cross(axis) * velocity)
}

/// The contributions of the rotors and of the links' inertial parameters to the joint torques; the parameters are about
/// the origins and in the axes of the links' frames. `None` if a joint axis depends on parameters.
pub(crate) fn regressor<'g>(
    mechanism: &Mechanism<'g>,
    moments: Moments,
) -> Option<RegressorColumns<'g>> {
    let mut own =
        Recursion::new(mechanism, &Plan::uniform(mechanism.links.len(), &REGRESSOR_PLAN))?;
    let projected_at = projection_places(&own.frames());
    for (plan, projected_at) in own.plans.iter_mut().zip(projected_at) {
        plan.projected_at = projected_at;
    }
    let (chain, frames) = (&own.chain, own.frames());
    let states = outward::outward(chain, &own.plans, Accelerations::Given);
    let of_link = |(link, units): (usize, Vec<Column<'g>>)| {
        let back = chain.frames[link].axes.transpose();
        let body = move |parameter| Body::unit(chain.graph, parameter).turned(back);
        (0..LINK_PARAMETERS).map(move |parameter| combination(&body(parameter), &units))
    };
    let units = own.unit_columns(&frames, &states, moments);
    let links = units.into_iter().enumerate().flat_map(of_link).collect();
    let rotors = (0..chain.links.len()).map(|link| own.rotor_column(&frames, &states, link));
    Some(RegressorColumns { links, rotors: rotors.collect() })
}

/// For each link, the place at which its wrenches are projected on the motions of the joints inward of
/// [`PROJECTION_GROUP`].
fn projection_places(frames: &Frames<'_, '_>) -> Vec<Option<Place>> {
    // For each link, the number of groups from the base, and the place of projection.
    let mut found: Vec<(usize, Option<Place>)> = vec![];
    for (link, joint) in frames.chain.links.iter().enumerate() {
        let carrier = joint.parent.map(|parent| (parent, found[parent]));
        let (depth, place) = match carrier {
            Some((_, (depth, place))) if frames.is_joined(link) => (depth, place),
            Some((parent, (PROJECTION_GROUP, _))) => {
                (PROJECTION_GROUP + 1, Some(Place { link: parent, turned: true }))
            }
            Some((_, (depth, place))) => (depth + 1, place),
            None => (1, None),
        };
        let at_home = Some(Place { link, turned: false });
        found.push((depth, if depth == PROJECTION_GROUP { at_home } else { place }));
    }
    found.into_iter().map(|(_, place)| place).collect()
}

impl<'g> Recursion<'g> {
    /// The columns of each link's parameters in its working frame.
    fn unit_columns(
        &self,
        frames: &Frames<'_, 'g>,
        states: &[LinkState<'g>],
        moments: Moments,
    ) -> Vec<Vec<Column<'g>>> {
        let chain = &self.chain;
        let nothing = vec![vec![chain.graph.zero(); chain.degrees_of_freedom]; LINK_PARAMETERS];
        let mut columns: Vec<Vec<Column<'g>>> = vec![];
        for (index, link) in chain.links.iter().enumerate() {
            let state = &states[index];
            let wrenches = match moments {
                Moments::Inertia => unit_wrenches(
                    state.tensor,
                    state.angular_velocity,
                    state.angular_acceleration,
                    state.acceleration,
                    self.plans[index].diagonal,
                ),
                Moments::Second => second_moment_wrenches(state),
            };
            let mut own = nothing.clone();
            let identifiable: &[usize] = match (link.kind, moments) {
                (JointKind::Revolute, Moments::Inertia) => &IDENTIFIABLE_BY_ROTATION,
                (JointKind::Revolute, Moments::Second) => &IDENTIFIABLE_SECOND_MOMENTS,
                (JointKind::Prismatic, _) => &IDENTIFIABLE_BY_TRANSLATION,
            };
            for parameter in identifiable {
                own[*parameter] = self.column(frames, index, &wrenches[*parameter]);
            }
            // The base does not move, so parameters that are equivalent to the base's contribute nothing.
            let carrier = link.parent.map_or(&nothing, |parent| &columns[parent]);
            regrouped(link, carrier, &mut own, moments);
            columns.push(own);
        }
        columns
    }

    /// The contributions of a unit of a link's rotor coupling.
    fn rotor_column(
        &self,
        frames: &Frames<'_, 'g>,
        states: &[LinkState<'g>],
        index: usize,
    ) -> Column<'g> {
        let (graph, link) = (self.chain.graph, &self.chain.links[index]);
        let Some(parent) = link.parent else {
            return vec![graph.zero(); self.chain.degrees_of_freedom];
        };
        let carrier = &states[parent];
        let (torque, moment) = unit_rotor(
            link.axis,
            [link.motion.velocity, link.motion.acceleration],
            carrier.angular_velocity,
            carrier.angular_acceleration,
        );
        let wrench = Wrench { force: Vector::zero(graph), moment };
        let mut column = self.column(frames, parent, &wrench);
        column[link.coordinate] += torque * link.ratio;
        column
    }

    /// The contributions of a wrench on a link, given in the link's own axes, to the joint torques.
    fn column(&self, frames: &Frames<'_, 'g>, index: usize, wrench: &Wrench<'g>) -> Column<'g> {
        let chain = &self.chain;
        let mut column = vec![chain.graph.zero(); chain.degrees_of_freedom];
        let at_home = wrench.turned_forward(&frames.joint_frames[index].group_turn);
        let mut propagated = Propagated::from_home(index, at_home);
        for projection in projections(frames, index, self.plans[index].projected_at) {
            propagated.propagate_to(frames, projection.place);
            let inner = &chain.links[projection.inner];
            let twist = projection.twist(frames, &frames.joint_twist(projection.inner));
            column[inner.coordinate] += twist.dot(&propagated.load) * inner.ratio;
        }
        column
    }
}

/// Computes the columns of the parameters that the link's joint cannot distinguish from those of its carrier.
fn regrouped<'g>(
    link: &ChainLink<'g>,
    carrier: &[Column<'g>],
    own: &mut [Column<'g>],
    moments: Moments,
) {
    match link.kind {
        JointKind::Revolute => {
            let rod = |kind| combination(&rod(kind, link.axis, link.translation, moments), carrier);
            own[0] = rod(0);
            own[FIRST_MOMENT + 2] = rod(1);
            if moments == Moments::Second {
                own[TENSOR + 5] = rod(2);
                return;
            }
            // A unit of Σ_zz is a unit of I_xx plus a unit of I_yy.
            let xx = own[TENSOR].iter();
            own[TENSOR + 2] = rod(2).into_iter().zip(xx).map(|(both, xx)| both - *xx).collect();
        }
        JointKind::Prismatic => {
            let graph = link.ratio.graph();
            let (sine, cosine) = link.rotation.turn;
            let turn = Plane::z(sine, cosine);
            let axis = |k| link.rotation.forward(turn.forward(Matrix::identity(graph).column(k))).0;
            let rotation = Matrix([0, 1, 2].map(axis)).transpose();
            for (parameter, column) in own.iter_mut().enumerate().skip(TENSOR) {
                *column = combination(&Body::unit(graph, parameter).turned(rotation), carrier);
            }
        }
    }
}
