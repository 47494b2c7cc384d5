//! The driving forces as linear functions of the links' inertial parameters.
//!
//! A unit of each of a link's ten parameters ([`crate::body`]) asks for a wrench, which goes inward to meet the joints. Not all ten have to go: what a joint cannot tell from the
//! parent's own (for a rotation about z the mass and the moments along z, for a translation the
//! whole tensor) makes the same share as the parent's parameters that it is equal to. That is the
//! regrouping of Khalil and Dombre (Modeling, Identification and Control of Robots, section 9.4) read
//! backwards: it saves columns here where there it removes them.

use robot_symbolic::Expr;

use super::Recursion;
use super::chain::ChainLink;
use super::encounter::{Traveller, encounters};
use super::outward::{self, Accelerations, LinkState};
use super::plan::{LinkPlan, Origin, Plan, Turn};
use super::rotation::Plane;
use super::spatial::{Ways, Wrench};
use crate::body::{Body, FIRST_MOMENT, TENSOR};
use crate::mechanism::Mechanism;
use crate::numeric::LINK_PARAMETERS;
use crate::vector::{Matrix, Vector};

/// The places of the parameters that a rotation about z tells from the parent's, but for I_yy.
const TOLD_BY_ROTATION: [usize; 7] = [1, 2, 4, 5, 7, 8, 9];
/// The places of the parameters that a translation tells from the parent's.
const TOLD_BY_TRANSLATION: [usize; 4] = [0, 1, 2, 3];

/// The share of a unit of a parameter in each driving force.
pub type Column<'g> = Vec<Expr<'g>>;

/// The columns of a regressor.
#[derive(Clone, Debug)]
pub struct RegressorColumns<'g> {
    /// Ten per link: parameters about the origin and in the axes of the link's frame in the file.
    pub links: Vec<Column<'g>>,
    /// One per link: the coupling of its drive's rotor with the link that carries the rotor
    /// ([`crate::mechanism::MechanismLink::rotor_coupling`]), 0 where the base does.
    pub rotors: Vec<Column<'g>>,
}

/// A unit of the mass (0), the first moment (1) or the second moment (2) of masses on the line
/// through `p` along the unit vector `z`, both counted from `p`.
fn rod<'g>(kind: usize, z: Vector<'g>, p: Vector<'g>) -> Body<'g> {
    let graph = z.0[0].graph();
    let (zero, identity) = (graph.zero(), Matrix::identity(graph));
    match kind {
        0 => {
            Body { mass: graph.one(), first: p, tensor: identity * p.dot(p) - Matrix::outer(p, p) }
        }
        1 => {
            let mixed = Matrix::outer(z, p) + Matrix::outer(p, z);
            Body { mass: zero, first: z, tensor: identity * (z.dot(p) * 2) - mixed }
        }
        _ => {
            Body { mass: zero, first: Vector::zero(graph), tensor: identity - Matrix::outer(z, z) }
        }
    }
}

/// A body's share in the driving forces, from those of units in the same frame.
fn share<'g>(body: &Body<'g>, units: &[Column<'g>]) -> Column<'g> {
    let mut share: Column<'g> = vec![];
    for (amount, unit) in body.parameters().into_iter().zip(units) {
        if share.is_empty() {
            share = vec![amount.graph().zero(); unit.len()];
        }
        for (sum, entry) in share.iter_mut().zip(unit) {
            *sum += amount * *entry;
        }
    }
    share
}

/// The wrenches, about the origin, that move a unit of each parameter with U, ω, ε and the
/// acceleration of the origin: f = m a + U h, n = h × a + I ε + ω × I ω.
///
/// `diagonal` takes differences of squared angular velocities from the diagonal of U.
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

/// What a rotor asks of its joint per unit of its coupling, a · ε, and of the link that carries it,
/// q̈ a + q̇ ω × a: with the joint axis a, its velocity and acceleration, and ω and ε of the carrier,
/// in the carrier's axes.
pub(crate) fn unit_rotor<'g>(
    axis: Vector<'g>,
    [velocity, acceleration]: [Expr<'g>; 2],
    omega: Vector<'g>,
    epsilon: Vector<'g>,
) -> (Expr<'g>, Vector<'g>) {
    (axis.dot(epsilon), axis * acceleration + omega.cross(axis) * velocity)
}

impl<'g> Recursion<'g> {
    /// The shares of the links' inertial parameters and of the rotors in the driving forces.
    ///
    /// The recursion's options hold, but for its frames, for which the file's are taken. `None` where
    /// a joint axis depends on parameters.
    #[must_use]
    pub fn regressor(&self, mechanism: &Mechanism<'g>) -> Option<RegressorColumns<'g>> {
        let in_file_frame = |plan: &LinkPlan| LinkPlan {
            origin: Origin::File,
            turn: Turn::File,
            residual: [None; 3],
            ..plan.clone()
        };
        let links = self.plans.iter().map(in_file_frame).collect();
        let own = Recursion::new(mechanism, &Plan { links, unit_length: None })?;
        let chain = &own.chain;
        let states = outward::outward(chain, &own.plans, Accelerations::Given);
        let ways = Ways::new(chain, |index| own.plans[index].composite_sum);
        let of_link = |(link, units): (usize, Vec<Column<'g>>)| {
            let back = chain.frames[link].axes.transpose();
            let body = move |parameter| Body::unit(self.graph(), parameter).turned(back);
            (0..LINK_PARAMETERS).map(move |parameter| share(&body(parameter), &units))
        };
        let links = own.unit_columns(&ways, &states).into_iter().enumerate().flat_map(of_link);
        let rotors = (0..chain.links.len()).map(|link| own.rotor_column(&ways, &states, link));
        Some(RegressorColumns { links: links.collect(), rotors: rotors.collect() })
    }

    /// Per link, the columns of its parameters in its working frame.
    fn unit_columns(&self, ways: &Ways<'_, 'g>, states: &[LinkState<'g>]) -> Vec<Vec<Column<'g>>> {
        let chain = &self.chain;
        let nothing = vec![vec![chain.graph.zero(); chain.degrees_of_freedom]; LINK_PARAMETERS];
        let mut columns: Vec<Vec<Column<'g>>> = vec![];
        for (index, link) in chain.links.iter().enumerate() {
            let state = &states[index];
            let wrenches = unit_wrenches(
                state.tensor,
                state.angular_velocity,
                state.angular_acceleration,
                state.acceleration,
                self.plans[index].diagonal,
            );
            let mut own = nothing.clone();
            let told: &[usize] =
                if link.is_revolute() { &TOLD_BY_ROTATION } else { &TOLD_BY_TRANSLATION };
            for parameter in told {
                own[*parameter] = self.column(ways, index, &wrenches[*parameter]);
            }
            // The base does not move: what is equal to parameters of the base has no share.
            let carrier = link.parent.map_or(&nothing, |parent| &columns[parent]);
            regrouped(link, carrier, &mut own);
            columns.push(own);
        }
        columns
    }

    /// The shares of a unit of a link's rotor coupling.
    fn rotor_column(
        &self,
        ways: &Ways<'_, 'g>,
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
            [link.motion[1], link.motion[2]],
            carrier.angular_velocity,
            carrier.angular_acceleration,
        );
        let wrench = Wrench { force: Vector::zero(graph), moment };
        let mut column = self.column(ways, parent, &wrench);
        column[link.coordinate] += torque * link.ratio;
        column
    }

    /// The shares of a wrench on a link, in its own axes, in the driving forces.
    fn column(&self, ways: &Ways<'_, 'g>, index: usize, wrench: &Wrench<'g>) -> Column<'g> {
        let chain = &self.chain;
        let mut column = vec![chain.graph.zero(); chain.degrees_of_freedom];
        let at_home = wrench.turned_forward(&ways.postures[index].group_turn);
        let mut traveller = Traveller::from_home(index, at_home);
        for encounter in encounters(ways, index, self.plans[index].meeting) {
            traveller.go_to(ways, encounter.place);
            let inner = &chain.links[encounter.inner];
            let twist = encounter.twist(ways, &ways.joint_twist(encounter.inner));
            column[inner.coordinate] += twist.dot(&traveller.load) * inner.ratio;
        }
        column
    }
}

/// The columns of the parameters that the link's joint cannot tell from those of its carrier.
fn regrouped<'g>(link: &ChainLink<'g>, carrier: &[Column<'g>], own: &mut [Column<'g>]) {
    if link.is_revolute() {
        let rod = |kind| share(&rod(kind, link.axis, link.translation), carrier);
        own[0] = rod(0);
        own[FIRST_MOMENT + 2] = rod(1);
        // A unit of Σ_zz is one of I_xx and one of I_yy.
        let xx = own[TENSOR].iter();
        own[TENSOR + 2] = rod(2).into_iter().zip(xx).map(|(both, xx)| both - *xx).collect();
        return;
    }
    let graph = link.ratio.graph();
    let (sine, cosine) = link.rotation.turn;
    let turn = Plane::z(sine, cosine);
    let axis = |k| link.rotation.forward(turn.forward(Matrix::identity(graph).column(k))).0;
    let rotation = Matrix([0, 1, 2].map(axis)).transpose();
    for (parameter, column) in own.iter_mut().enumerate().skip(TENSOR) {
        *column = share(&Body::unit(graph, parameter).turned(rotation), carrier);
    }
}
