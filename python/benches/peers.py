"""This package beside Pinocchio, dynibo and frax in one process: `python peers.py ROBOT.urdf [STATES]`.

Needs the packages `pin`, and `dynibo` and `frax` if they are to be in the table. All contenders compute the same random states, and their results are compared
first. Each round runs all of them in turn, and the least time of a contender counts. Times are those of the processor for this process, which other work on the
machine does not lengthen as it does the time on the clock; each contender has one thread.
"""

import os
import sys
import time

# Before the libraries start their threads.
os.environ.update(
    OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", JAX_ENABLE_X64="1", JAX_PLATFORMS="cpu",
    XLA_FLAGS="--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1",
)  # fmt: skip

import numpy as np
import pinocchio as pin
import robots

# Random states of the table of calls, and rounds.
CALLS, ROUNDS, BATCH_ROUNDS = 1000, 30, 7
ONE_CALL = "this package, all states in one call"


def least(contenders, rounds):
    """The least processor time of each contender, s."""
    found = dict.fromkeys(contenders, np.inf)
    for _ in range(rounds):
        for name, run in contenders.items():
            start = time.process_time()
            run()
            found[name] = min(found[name], time.process_time() - start)
    return found


def compare(title, results):
    """Stops if a contender's result is not that of the first. The acceleration of gravity of dynibo is 9.80665 m/s², that of the others 9.81."""
    (_, first), *others = results.items()
    for name, result in others:
        error = np.abs(np.asarray(result) - first).max() / np.abs(first).max()
        has_gravity = title in ("inverse_dynamics", "bias", "gravity", "forward_dynamics")
        if not error < (1e-3 if name == "dynibo" and has_gravity else 1e-9):
            sys.exit(f"{title}: {name} differs from this package by {error:.1e} of the largest value")


def table(title, times, states):
    """Nanoseconds a state, and how many times the first contender's time that is."""
    own = next(iter(times.values()))
    print(f"\n{title}")
    for name, value in times.items():
        print(f"  {name:42} {value / states * 1e9:10.1f} ns   {value / own:8.2f}")


def optional(make):
    """A contender that may not be installed, or may not read the robot."""
    try:
        return make()
    except Exception as error:  # noqa: BLE001 - whatever a peer raises is said
        print(f"left out: {type(error).__name__}: {str(error).splitlines()[0]}")
        return {}


def of_pinocchio(path, tip):
    model = pin.buildModelFromUrdf(path)
    data = model.createData()
    frame, axes = model.getFrameId(tip), pin.LOCAL_WORLD_ALIGNED
    zero = np.zeros(model.nv)

    def pose(q):
        pin.framesForwardKinematics(model, data, q)
        return data.oMf[frame].translation

    def acceleration(q, qd):
        pin.forwardKinematics(model, data, q, qd, zero)
        return pin.getFrameClassicalAcceleration(model, data, frame, axes).vector

    return model, {
        "inverse_dynamics": lambda q, qd, x: pin.rnea(model, data, q, qd, x),
        "mass_matrix": lambda q, qd, x: pin.crba(model, data, q),
        "bias": lambda q, qd, x: pin.nonLinearEffects(model, data, q, qd),
        "gravity": lambda q, qd, x: pin.computeGeneralizedGravity(model, data, q),
        "forward_dynamics": lambda q, qd, x: pin.aba(model, data, q, qd, x),
        "pose": lambda q, qd, x: pose(q),
        "jacobian": lambda q, qd, x: pin.computeFrameJacobian(model, data, q, frame, axes),
        "jacobian_dot_qd": lambda q, qd, x: acceleration(q, qd),
    }


def of_dynibo(path, tip):
    import dynibo

    robot = dynibo.Robot.from_urdf(path)
    n, tip = robot.joint_count, robot.link_id(tip)
    # Its columns have the angular velocity first.
    rows = [3, 4, 5, 0, 1, 2]
    return {
        "inverse_dynamics": lambda q, qd, x: robot.inverse_dynamics(q, qd, x),
        "mass_matrix": lambda q, qd, x: robot.mass_matrix(q).reshape(n, n),
        "bias": lambda q, qd, x: robot.velocity_product_forces(q, qd) + robot.gravity(q),
        "gravity": lambda q, qd, x: robot.gravity(q),
        "forward_dynamics": lambda q, qd, x: robot.forward_dynamics(q, qd, x),
        "pose": lambda q, qd, x: robot.forward_kinematics(q, tip).translation,
        "jacobian": lambda q, qd, x: robot.jacobian(q, tip).reshape(n, 6).T[rows],
        "jacobian_dot_qd": lambda q, qd, x: (qd @ robot.jacobian_derivative(q, qd, tip).reshape(n, 6))[rows],
    }


def of_frax(path, offset):
    import warnings

    import jax

    warnings.filterwarnings("ignore", module="frax")
    import frax

    robot = frax.Manipulator(path, ee_offset=offset)
    up = np.array([0, 0, 9.81, 0, 0, 0])  # The acceleration of the base that stands for gravity.
    traced = {
        "inverse_dynamics": lambda q, qd, x: robot.rnea(q, qd, x, up, None),
        "mass_matrix": lambda q, qd, x: robot.mass_matrix(q),
        "bias": lambda q, qd, x: robot.nonlinear_bias(q, qd),
        "gravity": lambda q, qd, x: robot.gravity_vector(q),
        "forward_dynamics": lambda q, qd, x: robot.forward_dynamics(q, qd, x, None),
        "pose": lambda q, qd, x: robot.ee_transform(q)[:3, 3],
        "jacobian": lambda q, qd, x: robot.ee_jacobian(q),
        "jacobian_dot_qd": lambda q, qd, x: robot.ee_jacobian_and_derivative(q, qd)[1] @ qd,
    }
    compiled = {name: jax.jit(function) for name, function in traced.items()}
    state = np.zeros(robot.num_joints)
    for function in compiled.values():
        function(state, state, state).block_until_ready()
    calls = {name: lambda q, qd, x, function=function: np.asarray(function(q, qd, x)) for name, function in compiled.items()}
    batch = jax.jit(jax.vmap(traced["inverse_dynamics"]))
    return calls | {"batch": lambda q, qd, x: np.asarray(batch(q, qd, x))}


def of_package(arm, tip):
    poses, jacobian, jacobian_dot_qd = arm.frame_poses, getattr(arm, f"jacobian_{tip}"), getattr(arm, f"jacobian_dot_qd_{tip}")
    return {
        "inverse_dynamics": lambda q, qd, x: arm.inverse_dynamics(q, qd, x),
        "mass_matrix": lambda q, qd, x: arm.mass_matrix(q),
        "bias": lambda q, qd, x: arm.bias(q, qd),
        "gravity": lambda q, qd, x: arm.gravity(q),
        "forward_dynamics": lambda q, qd, x: arm.forward_dynamics(q, qd, x),
        # The poses of all frames, the last of which is the tip's.
        "pose": lambda q, qd, x: poses(q)[1][..., -1, :],
        "jacobian": lambda q, qd, x: jacobian(q),
        "jacobian_dot_qd": lambda q, qd, x: jacobian_dot_qd(q, qd),
    }


def upper(matrix):
    """Pinocchio fills the upper triangle of the mass matrix alone."""
    return np.triu(matrix) if np.ndim(matrix) == 2 and len(matrix) == len(matrix[0]) else matrix


def calls(arm, contenders, random):
    q, qd, x = random.uniform(-1, 1, (3, CALLS, arm.degrees_of_freedom))
    for name in contenders["this package"]:
        having = {who: functions[name] for who, functions in contenders.items() if name in functions}
        for state in range(10):
            compare(name, {who: upper(run(q[state], qd[state], x[state])) for who, run in having.items()})
        loops = {who: (lambda run=run: [run(*row) for row in zip(q, qd, x)]) for who, run in having.items()}
        # Twenty times, so that it is as long as the others.
        loops[ONE_CALL] = lambda name=name: [contenders["this package"][name](q, qd, x) for _ in range(20)]
        times = least(loops, ROUNDS)
        times[ONE_CALL] /= 20
        table(f"{name}, a call for each of {CALLS} states", times, CALLS)


def batches(arm, model, pinocchio, frax, states, random):
    """Inverse dynamics of many states in one call, and what a call each of Pinocchio costs."""
    q, qd, qdd = random.uniform(-1, 1, (3, states, arm.degrees_of_freedom))
    pool = pin.ModelPool(model, 1)
    columns = [np.asfortranarray(array.T) for array in (q, qd, qdd)]
    out, theirs = np.empty_like(q), np.asfortranarray(np.empty_like(q.T))
    loop = pinocchio["inverse_dynamics"]
    few = list(zip(q[:CALLS], qd[:CALLS], qdd[:CALLS]))
    contenders = {
        "this package": lambda: arm.inverse_dynamics(q, qd, qdd, out=out),
        "pin.rneaInParallel, one thread": lambda: pin.rneaInParallel(1, pool, *columns, theirs),
    }
    if frax:
        contenders["frax, jit(vmap(rnea))"] = lambda: frax["batch"](q, qd, qdd)
    made = {name: run() for name, run in contenders.items()}
    compare("batch", {"this package": out, "pin.rneaInParallel": theirs.T, **{name: found for name, found in made.items() if "frax" in name}})
    times = least(contenders, BATCH_ROUNDS)
    times["pin.rnea, a call for each state"] = least({"": lambda: [loop(*row) for row in few]}, ROUNDS)[""] * states / CALLS
    table(f"inverse_dynamics, {states} states in one call", times, states)


def main():
    path = os.path.abspath(sys.argv[1])
    states = int(float(sys.argv[2])) if len(sys.argv) > 2 else 1_000_000
    arm, random = robots.load(path), np.random.default_rng(1)
    tip = [name for name in arm.functions if name.startswith("jacobian_dot_qd_")][-1].removeprefix("jacobian_dot_qd_")
    model, functions = of_pinocchio(path, tip)
    offset = model.frames[model.getFrameId(tip)].placement.homogeneous
    contenders = {"this package": of_package(arm, tip), "pin": functions}
    contenders |= {"dynibo": found} if (found := optional(lambda: of_dynibo(path, tip))) else {}
    contenders |= {"frax": found} if (found := optional(lambda: of_frax(path, offset))) else {}
    print(f"the tip is {tip}")
    batches(arm, model, functions, contenders.get("frax"), states, random)
    calls(arm, contenders, random)


if __name__ == "__main__":
    main()
