//! The values of functions by the numeric solver, and states and inputs for the comparison.

use nalgebra::{DMatrix, Vector3};
use robot_model::functions::{Effects, FrameRef, FunctionKind, coupled};
use robot_model::robot::LINK_PARAMETERS;
use robot_model::robot::{Friction, Robot};
use robot_model::variable::JointVariable;
use robot_numeric::random::{Random, State};
use robot_numeric::{self, Loads, Mechanism};

use crate::joint_values;

/// A random state with wrenches only on the tips.
pub fn state(random: &mut Random, solver: &Mechanism, robot: &Robot) -> State {
    let mut state = random.state(solver);
    for (wrench, frame) in state.wrenches.iter_mut().zip(&robot.frames) {
        if frame.wrench.is_none() {
            *wrench = robot_numeric::Wrench::zero();
        }
    }
    state
}

/// The values of inputs in a state, by the names of the inputs; wrenches are in the order of the tips.
pub fn inputs(
    robot: &Robot,
    names: impl Iterator<Item = String>,
    state: &State,
) -> Vec<(String, Vec<f64>)> {
    let frames = robot.frames.iter().zip(&state.wrenches);
    let tips = frames.filter(|(frame, _)| frame.wrench.is_some());
    let mut wrenches = tips.map(|(_, w)| w.force.iter().chain(&w.moment).copied().collect());
    let value = |name: String| {
        let values = match JointVariable::from_name(&name) {
            Some(variable) => joint_values(state, variable).to_vec(),
            None => wrenches.next().unwrap(),
        };
        (name, values)
    };
    names.map(value).collect()
}

/// The values of the functions of a kind by the numeric solver, one after another; of the regressor, only the columns
/// of the links.
pub fn expected(robot: &Robot, solver: &Mechanism, kind: FunctionKind, state: &State) -> Vec<f64> {
    let State { q, qd, qdd, tau, wrenches } = state;
    let Effects { friction, wrench } = kind.effects();
    let exerted = if wrench { &wrenches[..] } else { &[] };
    let jacobian = |frame: FrameRef| {
        let found = match frame {
            FrameRef::Named(index) => solver.frame_jacobian(q, index),
            FrameRef::Link(index) => solver.link_jacobian(q, index),
        };
        found.unwrap().transpose().as_slice().to_vec()
    };
    let drift = |frame: FrameRef| {
        let found = match frame {
            FrameRef::Named(index) => solver.frame_jacobian_dot_qd(q, qd, index),
            FrameRef::Link(index) => solver.link_jacobian_dot_qd(q, qd, index),
        };
        found.unwrap().as_slice().to_vec()
    };
    let frames = FrameRef::usual(robot).into_iter();
    // In the solver, gyroscopic rotors are additional links after those of the robot.
    let links = robot.links.len();
    match kind {
        FunctionKind::InverseDynamics(_) => {
            let loads = Loads { wrenches: exerted.to_vec(), friction };
            solver.inverse_dynamics_with(q, qd, qdd, &loads).unwrap().as_slice().to_vec()
        }
        FunctionKind::LinkWrenches => {
            contacts(&solver.link_dynamics(q, qd, qdd, wrenches).unwrap()[..links])
        }
        FunctionKind::MassMatrix => rows(&solver.mass_matrix(q).unwrap()),
        FunctionKind::MassMatrixLower => lower(robot, &solver.mass_matrix(q).unwrap()),
        FunctionKind::Bias => solver.bias(q, qd).unwrap().as_slice().to_vec(),
        FunctionKind::Gravity => solver.gravity_torques(q).unwrap().as_slice().to_vec(),
        FunctionKind::ForwardDynamics(_) if friction => {
            with_friction(robot, solver, state, exerted)
        }
        FunctionKind::ForwardDynamics(_) => {
            solver.forward_dynamics(q, qd, tau, exerted).unwrap().as_slice().to_vec()
        }
        FunctionKind::ForwardKinematics => {
            poses(&solver.forward_kinematics(q).unwrap().links[..links])
        }
        FunctionKind::FramePoses => poses(&solver.forward_kinematics(q).unwrap().frames),
        FunctionKind::Jacobian => frames.flat_map(jacobian).collect(),
        FunctionKind::JacobianOf(frame) => jacobian(frame),
        FunctionKind::JacobianDotQd => frames.flat_map(drift).collect(),
        FunctionKind::JacobianDotQdOf(frame) => drift(frame),
        FunctionKind::Energies => energies(solver, state),
        FunctionKind::CoriolisMatrix => rows(&solver.coriolis_matrix(q, qd).unwrap()),
        FunctionKind::InverseDynamicsDerivatives => inverse_derivatives(solver, state),
        FunctionKind::ForwardDynamicsDerivatives => forward_derivatives(solver, state),
        FunctionKind::Regressor => link_columns(&solver.regressor(q, qd, qdd).unwrap(), links),
        other => panic!("nothing to hold `{}` against", other.name()),
    }
}

/// The columns of the robot's links, row by row.
fn link_columns(columns: &DMatrix<f64>, links: usize) -> Vec<f64> {
    rows(&columns.columns(0, LINK_PARAMETERS * links).into_owned())
}

/// The entries of the lower triangle that can be nonzero for the robot's structure.
fn lower(robot: &Robot, matrix: &DMatrix<f64>) -> Vec<f64> {
    coupled(robot).into_iter().map(|[row, column]| matrix[(row, column)]).collect()
}

/// The forces that the joints of the links transmit, then the moments.
fn contacts(links: &[robot_numeric::LinkDynamics]) -> Vec<f64> {
    let entries = |vector: Vector3<f64>| vector.as_slice().to_vec();
    let forces = links.iter().flat_map(|link| entries(link.contact_force));
    forces.chain(links.iter().flat_map(|link| entries(link.contact_moment))).collect()
}

fn energies(solver: &Mechanism, state: &State) -> Vec<f64> {
    let found = solver.energies(&state.q, &state.qd).unwrap();
    vec![found.kinetic, found.potential]
}

fn inverse_derivatives(solver: &Mechanism, state: &State) -> Vec<f64> {
    let State { q, qd, qdd, .. } = state;
    let found = solver.inverse_dynamics_derivatives(q, qd, qdd, &[]).unwrap();
    [rows(&found.dq), rows(&found.dqd)].concat()
}

fn forward_derivatives(solver: &Mechanism, state: &State) -> Vec<f64> {
    let State { q, qd, tau, .. } = state;
    let found = solver.forward_dynamics_derivatives(q, qd, tau, &[]).unwrap();
    [rows(&found.dq), rows(&found.dqd), rows(&found.dtau)].concat()
}

/// The accelerations q̈ with friction, by the same iterations as in the generated functions if friction depends on the
/// load.
fn with_friction(
    robot: &Robot,
    solver: &Mechanism,
    state: &State,
    wrenches: &[robot_numeric::Wrench],
) -> Vec<f64> {
    let State { q, qd, tau, .. } = state;
    let none = Friction::none();
    let by_load = robot.links.iter().any(|link| link.friction.coulomb != none.coulomb);
    let mut qdd = match by_load {
        true => solver.forward_dynamics(q, qd, tau, wrenches).unwrap().as_slice().to_vec(),
        false => tau.clone(),
    };
    for _ in 0..if by_load { 8 } else { 1 } {
        let friction = solver.friction_torques(q, qd, &qdd, wrenches).unwrap();
        let driving: Vec<f64> = tau.iter().zip(&friction).map(|(tau, f)| tau - f).collect();
        qdd = solver.forward_dynamics(q, qd, &driving, wrenches).unwrap().as_slice().to_vec();
    }
    qdd
}

/// The rotations, row by row, then the origins.
fn poses(poses: &[robot_numeric::Pose]) -> Vec<f64> {
    let rotations = poses.iter().flat_map(|pose| pose.rotation.transpose().as_slice().to_vec());
    let origins = poses.iter().flat_map(|pose| pose.translation.as_slice().to_vec());
    rotations.chain(origins).collect()
}

fn rows(matrix: &DMatrix<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}
