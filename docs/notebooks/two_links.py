# %% [markdown]
# # Notebook: two links, from the picture to energy
#
# A planar arm with two links is the smallest robot that shows the main effects of robot dynamics: inertia that depends on
# the configuration, torques from the velocities of other joints, and gravity. This notebook prints its equations, takes them
# apart, and checks them on a motion.

# %%
import matplotlib.pyplot as plt
import numpy as np
import robots
import sympy

arm = robots.load("robots/planar_2r.toml")
arm

# %% [markdown]
# Every value of the file is a symbol, so the equations are those of a textbook. `form="grouped"` groups the terms by
# acceleration, velocity and gravity. The equations also contain w, here the joint torques that the wrench at the tip requires; the
# wrench is 0 unless a call sets it.

# %%
equations = arm.equations(form="grouped")
equations

# %% [markdown]
# ## What depends on what
#
# `sympy` returns the torques as expressions. The entries of the mass matrix are their derivatives with respect to the
# accelerations.

# %%
torques = arm.equations().sympy
q1, q2, qd1, qd2, qdd1, qdd2 = sympy.symbols("q1 q2 qd1 qd2 qdd1 qdd2")
M = torques.jacobian([qdd1, qdd2]).applyfunc(sympy.factor_terms)
M

# %% [markdown]
# The position of the first joint does not occur: turning the whole arm changes neither the distances between its masses nor those from the first axis. The
# matrix is symmetric, and it is positive definite for all masses that a body can have. Its eigenvalues at the values
# of the file show how much harder it is to turn the stretched arm (q₂ = 0) than the folded one (q₂ = π).

# %%
for q in ([0, 0], [0, np.pi / 2], [0, np.pi]):
    print(f"q2 = {q[1]:.2f}: eigenvalues", np.linalg.eigvalsh(arm.mass_matrix(np.array(q))).round(3))

# %% [markdown]
# The same mass matrix determines the Coriolis and centrifugal terms. With their matrix C, Ṁ − 2 C
# is skew-symmetric, so q̇ᵀ C q̇ = ½ q̇ᵀ Ṁ q̇: without gravity, the kinetic energy changes only by the work of the joint
# torques. That is a claim about all states, so SymPy should prove it, with C from the Christoffel symbols.

# %%
q, qd = sympy.Matrix([q1, q2]), sympy.Matrix([qd1, qd2])
C = sympy.zeros(2)
for i in range(2):
    for j in range(2):
        C[i, j] = sum((M[i, j].diff(q[k]) + M[i, k].diff(q[j]) - M[j, k].diff(q[i])) * qd[k] / 2 for k in range(2))
M_dot = sum((M.diff(q[k]) * qd[k] for k in range(2)), sympy.zeros(2))
S = (M_dot - 2 * C).applyfunc(sympy.simplify)
print("the sum with its transpose:", (S + S.T).applyfunc(sympy.simplify))

# %% [markdown]
# The Coriolis and centrifugal terms of the printed equations are C q̇. The difference between the two is

# %%
coriolis_terms = torques - torques.subs({qd1: 0, qd2: 0})
print((C * qd - coriolis_terms).applyfunc(lambda entry: sympy.simplify(sympy.expand(entry))))

# %% [markdown]
# ## On a motion
#
# The arm is released from a raised configuration and swings without friction. Its total energy must not change,
# although the energy of each link changes all the time.

# %%
motion = arm.simulate(4.0, q0=[1.2, 0.6], step=0.01)
t, energy = motion["t"], motion["energy"]
print(f"energy: {energy[0]:.3f} J; changes by less than 1e-6 J: {np.ptp(energy) < 1e-6}")

figure, axes = plt.subplots(2, 1, sharex=True, figsize=(7, 5))
axes[0].plot(t, motion["q"], label=["q₁", "q₂"])
axes[0].set_ylabel("joint position, rad")
axes[1].plot(t, motion["kinetic"], label="kinetic")
axes[1].plot(t, motion["potential"], label="potential")
axes[1].plot(t, energy, "k--", label="sum")
axes[1].set(xlabel="t, s", ylabel="energy, J")
for one in axes:
    one.legend()

# %% [markdown]
# ## Which term matters
#
# No drive acts during the motion, so inertia, Coriolis and centrifugal terms and gravity add up to 0 at every instant. Their sizes
# show which terms a simplified model could omit.

# %%
inertia = np.einsum("nij,nj->ni", arm.mass_matrix(motion["q"]), motion["qdd"])
gravity = arm.gravity(motion["q"])
coriolis = arm.bias(motion["q"], motion["qd"]) - gravity
print("sum below 1e-9 N m:", bool(np.abs(inertia + coriolis + gravity).max() < 1e-9))
for name, part in (("inertia", inertia), ("Coriolis", coriolis), ("gravity", gravity)):
    print(f"{name:9}", np.sqrt(np.mean(part**2, axis=0)).round(1), "N m, root mean square of joints 1 and 2")

# %% [markdown]
# Exercises: Set `m2=0.0` in a call of `arm.mass_matrix` and explain what remains of M₁₂. Show that the arm stays at
# rest if it hangs straight down. Release the arm from `q0=[1.2001, 0.6]` instead and plot both motions for ten
# seconds.
