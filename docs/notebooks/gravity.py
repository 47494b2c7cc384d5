# %% [markdown]
# # Notebook: gravity compensation of a small arm
#
# A small arm with weak drives should stay in the configuration in which it is left, so that a person can guide it by
# hand. The drives then carry the weight of the links, and nothing else: τ = g(q). The arm in this notebook has three
# joints: one turns it about the vertical, and two raise it.

# %%
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import robots

Path("small.toml").write_text("""format = 1

[robot]
name = "small"
description = "Desk arm of three joints: turn, shoulder, elbow."
gravity = [0, 0, "-g"]

[parameters]
g = { value = 9.81, unit = "m/s^2" }
l = { value = 0.25, unit = "m", doc = "length of the upper arm" }
r2 = { value = 0.11, unit = "m", doc = "center of mass of the upper arm from the shoulder" }
m2 = { value = 0.6, unit = "kg", doc = "mass of the upper arm" }
r3 = { value = 0.09, unit = "m", doc = "center of mass of the forearm from the elbow" }
m3 = { value = 0.4, unit = "kg", doc = "mass of the forearm" }

[[link]]
name = "turn"
joint = { type = "revolute", axis = "z" }
mass = 0.5
center_of_mass = [0, 0, 0]
inertia = { xx = 0.0006, yy = 0.0006, zz = 0.0008 }

[[link]]
name = "upper"
joint = { type = "revolute", axis = "-y" }
origin = { xyz = [0, 0, 0.1] }
mass = "m2"
center_of_mass = ["r2", 0, 0]
inertia = { xx = 0.0002, yy = 0.003, zz = 0.003 }
friction = { viscous = 0.05 }

[[link]]
name = "fore"
joint = { type = "revolute", axis = "-y" }
origin = { xyz = ["l", 0, 0] }
mass = "m3"
center_of_mass = ["r3", 0, 0]
inertia = { xx = 0.0001, yy = 0.0015, zz = 0.0015 }
friction = { viscous = 0.03 }

[payload]
parent = "fore"
""")
arm = robots.load("small.toml")
arm

# %% [markdown]
# ## The control law
#
# The controller needs only the gravity terms. On a microcontroller they take only a few operations;
# `arm.source("c", function="gravity")` prints them as C.

# %%
equations = arm.equations(form="grouped", quantities="Q")
for name, formula in equations.definitions.items():
    if name.startswith("g_"):
        print(name, "=", formula)

# %% [markdown]
# Gravity has no moment about the vertical axis, so there is no g₁. The terms contain the parameters of the payload,
# which are 0 unless a call sets them.
#
# In Python the control law is one call. This is the configuration in which the arm is stretched out horizontally:

# %%
out = np.array([0.0, 0.0, 0.0])
print("empty:          ", arm.gravity(out).round(3), "N m")
carried = robots.Payload(mass=0.2, center_of_mass=[0.2, 0, 0])
print("with 0.2 kg:    ", arm.gravity(out, payload=carried).round(3), "N m")

# %% [markdown]
# How strong must the shoulder be? One call computes the torques of ten thousand random configurations, and the
# largest of them is an estimate:

# %%
configurations = np.random.default_rng(1).uniform(-np.pi, np.pi, (10_000, 3))
print("largest torques:", np.abs(arm.gravity(configurations, payload=carried)).max(axis=0).round(2), "N m")

# %% [markdown]
# ## Does it hold?
#
# `simulate` takes torques as formulas over `q1`, `q2`, `q3` and the parameters, so it can apply the law. The arm
# starts raised and at rest. The arm has friction, and the law does not include it. We compare four cases: no
# compensation; the right law; a law with a forearm that is 20 % too heavy; and the right law with a payload
# that is not in the law.

# %%
# The law of the arm without a payload.
law = {name: formula for name, formula in equations.definitions.items() if name in ("g_2", "g_3")}
empty = {name: "0" for name in arm.parameters if name.startswith("payload")}


def with_values(formula, values):
    for name, value in values.items():
        formula = formula.replace(name, f"({value})")
    return formula


torques = {"2": with_values(law["g_2"], empty), "3": with_values(law["g_3"], empty)}
heavier = {joint: with_values(formula, {"m3": 1.2 * arm.parameters["m3"]}) for joint, formula in torques.items()}
payload = {"payload_mass": 0.2, "payload_x": 0.2}
cases = {
    "no compensation": {},
    "right": {"torques": torques},
    "forearm thought 20 % heavier": {"torques": heavier},
    "unknown payload": {"torques": torques, "parameters": payload},
}
start = [0.0, 0.9, -0.6]
motions = {name: arm.simulate(3.0, q0=start, friction=True, **case) for name, case in cases.items()}

figure, axes = plt.subplots(figsize=(7, 4))
for name, motion in motions.items():
    axes.plot(motion["t"], motion["q"][:, 1], label=name)
    print(f"{name:30} shoulder moves by {round(motion['q'][-1, 1] - start[1], 3) + 0.0:+.3f} rad in 3 s")
axes.set(xlabel="t, s", ylabel="shoulder q₂, rad")
figure.legend(loc="outside upper center", ncols=2)

# %% [markdown]
# With the right law the arm stays at rest to the last digit that is shown, because nothing accelerates it. If the
# mass of the forearm is wrong by 20 %, the law pushes the arm up, and only friction slows it. A payload that is not
# in the law pulls the arm down. Gravity compensation is only as accurate as its parameters. The next notebook
# identifies those of another robot from motions and torques.
