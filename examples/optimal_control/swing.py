"""Finds the swing of the UR5 between two configurations that needs the least torque, with CasADi and IPOPT.

The unknowns are the accelerations of 20 steps, and the positions and velocities that follow from them. The cost is the
sum of the squares of the joint torques, computed by generated inverse dynamics with its exact Jacobian, and of the
accelerations. To run it:

    robot-symbolic crate robots/ur5.toml --language c --function all -o ur5_c
    cc -std=c99 -O2 -ffp-contract=off -shared -fPIC ur5_c/ur5_casadi.c -o libur5_casadi.so -lm
    pip install casadi
    python examples/optimal_control/swing.py ./libur5_casadi.so

Given the robot's URDF file, or a function that CasADi saved (benches/peers/run saves Pinocchio's as
target/peers/c/ur5_inverse_dynamics.casadi), the problem is also solved with Pinocchio's inverse dynamics, and the
optimal costs are compared.
"""

import sys
import time

import casadi

STEPS, DURATION = 20, 1.0
START = [0.0, -1.2, 1.0, -0.5, 0.3, 0.0]
END = [1.0, -0.6, 0.4, 0.5, -0.3, 0.5]
# The largest torques of the UR5's three large and three small joints, N m.
LIMITS = [150.0, 150.0, 150.0, 28.0, 28.0, 28.0]
# The largest speed of the joints, rad/s.
SPEED = 3.14


def problem(inverse_dynamics):
    """Returns the problem, its positions and its torques."""
    opti = casadi.Opti()
    step = DURATION / STEPS
    q, qd = opti.variable(6, STEPS + 1), opti.variable(6, STEPS + 1)
    qdd = opti.variable(6, STEPS)
    opti.subject_to(q[:, 0] == START)
    opti.subject_to(q[:, STEPS] == END)
    opti.subject_to(qd[:, 0] == 0)
    opti.subject_to(qd[:, STEPS] == 0)
    torques = []
    for k in range(STEPS):
        opti.subject_to(qd[:, k + 1] == qd[:, k] + step * qdd[:, k])
        opti.subject_to(q[:, k + 1] == q[:, k] + step * qd[:, k] + step**2 / 2 * qdd[:, k])
        torque = inverse_dynamics(q[:, k], qd[:, k], qdd[:, k])
        opti.subject_to(opti.bounded(-casadi.DM(LIMITS), torque, LIMITS))
        torques.append(torque)
        part = k / STEPS
        opti.set_initial(q[:, k], [(1 - part) * a + part * b for a, b in zip(START, END)])
    torques = casadi.horzcat(*torques)
    # The accelerations are part of the cost so that the Hessian is regular.
    residuals = casadi.vertcat(casadi.vec(torques), casadi.vec(qdd))
    opti.subject_to(opti.bounded(-SPEED, casadi.vec(qd), SPEED))
    opti.minimize(step * casadi.sumsqr(residuals))
    # The functions have no second derivatives, so the Hessian is that of Gauss and Newton, from the exact Jacobian.
    jacobian = casadi.jacobian(residuals, opti.x)
    factor, multipliers = casadi.MX.sym("factor"), casadi.MX.sym("multipliers", opti.ng)
    hessian = casadi.triu(2 * step * factor * (jacobian.T @ jacobian))
    hessian = casadi.Function("nlp_hess_l", [opti.x, opti.p, factor, multipliers], [hessian])
    options = {"print_level": 0, "sb": "yes"}
    opti.solver("ipopt", {"print_time": False, "hess_lag": hessian}, options)
    return opti, q, torques


def solve(name, inverse_dynamics):
    """Solves the problem, prints times, and returns the optimal cost."""
    opti, q, torques = problem(inverse_dynamics)
    start = time.perf_counter()
    solution = opti.solve()
    seconds = time.perf_counter() - start
    statistics = solution.stats()
    cost = solution.value(opti.f)
    within = sum(value for key, value in statistics.items() if key.startswith("t_wall_nlp"))
    largest = abs(solution.value(torques)).max()
    print(
        f"{name}: {statistics['return_status']}, {statistics['iter_count']} iterations, {seconds * 1e3:.1f} ms, "
        f"{within * 1e3:.1f} ms of them in the functions, cost {cost:.9g}, largest torque {largest:.2f} N m"
    )
    return cost


def pinocchio_dynamics(path):
    """Returns Pinocchio's inverse dynamics as CasADi expressions: those that a file has, or those that Pinocchio makes
    from a URDF file, if its build can."""
    if path.endswith(".casadi"):
        return casadi.Function.load(path)
    try:
        import pinocchio
        import pinocchio.casadi
    except ImportError as error:
        print(f"Pinocchio: not run, {error}")
        return None
    model = pinocchio.casadi.Model(pinocchio.buildModelFromUrdf(path))
    names = [casadi.SX.sym(name, model.nv) for name in ["q", "qd", "qdd"]]
    return casadi.Function("pinocchio", names, [pinocchio.casadi.rnea(model, model.createData(), *names)])


def main():
    if len(sys.argv) < 2:
        sys.exit("usage: swing.py LIBRARY [ROBOT.urdf or FUNCTION.casadi]")
    generated = casadi.external("casadi_ur5_inverse_dynamics", sys.argv[1])
    cost = solve("generated", generated)
    peer = pinocchio_dynamics(sys.argv[2]) if len(sys.argv) > 2 else None
    if peer is not None:
        other = solve("Pinocchio", peer)
        print(f"the costs differ by {abs(other - cost) / cost:.1e} of one")


main()
