# %% [markdown]
# # Notebook: identification from motions and torques
#
# The masses and inertias of a data sheet are guesses, or they are missing. The parameters that affect the joint
# torques can be measured: move the robot, record motions and torques, and solve a linear system. This notebook does
# this for the SCARA, with noise, and estimates how accurate the result is.

# %%
import matplotlib.pyplot as plt
import numpy as np
import robots

arm = robots.load("robots/scara.toml")
arm

# %% [markdown]
# ## What is identifiable
#
# Most parameters of this arm have no effect: no motion turns its first link about a horizontal axis, for example.
# The joint torques determine only the *base parameters*; each of them is a sum of parameters that act together.

# %%
for entry in arm.base_parameters()["base"]:
    print(f"{entry['name']:7} = {entry['formula']}")

# %% [markdown]
# ## A measurement
#
# The motion of each joint is a sum of sines, 20 seconds long at 100 Hz, with derivatives in closed form. The torques
# are those of the arm with its nominal values, plus noise of the size that is usual for current sensors.

# %%
random = np.random.default_rng(7)
t = np.arange(0, 20, 0.01)
n = arm.degrees_of_freedom


def excitation(amplitude, harmonics=5, base=2 * np.pi * 0.1):
    """Joint positions, velocities and accelerations of random sums of sines."""
    a, b = random.uniform(-1, 1, (2, harmonics, n)) * amplitude / harmonics
    w = base * np.arange(1, harmonics + 1)
    s, c = np.sin(np.outer(t, w)), np.cos(np.outer(t, w))
    return s @ a + c @ b, (c * w) @ a - (s * w) @ b, -(s * w**2) @ a - (c * w**2) @ b


q, qd, qdd = excitation(np.array([2.0, 2.0, 0.1, 2.0]))
noise = np.array([0.3, 0.2, 0.5, 0.02])
tau = arm.inverse_dynamics(q, qd, qdd) + noise * random.standard_normal((len(t), n))

# %% [markdown]
# The joints differ in their noise; the third joint is prismatic, and its noise is a force in newtons. With `noise`, each
# row is weighted by the inverse of its noise. `identify` uses only the regressor Y, with τ = Y β, and solves a linear
# system; it also returns the standard errors.

# %%
found = arm.identify(q, qd, qdd, tau, noise=noise)
unweighted = arm.identify(q, qd, qdd, tau)
true = np.array([float(entry["value"]) for entry in arm.base_parameters()["base"]])
print(f"rank {found.rank} of {len(found.names)}, condition {found.condition:.0f}")
print("parameter      true       unweighted   weighted ± its standard error")
for name, *row in zip(found.names, true, unweighted.values, found.values, found.errors):
    print(f"{name:9} {row[0]:9.4f} {row[1]:16.4f} {row[2]:10.4f} ± {row[3]:.4f}")

# %% [markdown]
# The noise explains the errors: the differences from the true values, divided by the standard errors, should be like
# numbers from the standard normal distribution.

# %%
print("differences in standard errors:", ((found.values - true) / found.errors).round(1))

# %% [markdown]
# ## A motion that is too small looks as good
#
# We repeat this with a tenth of the amplitude. The residuals are as small as before, because they are the noise. Only
# the standard errors show that the motion is too small.

# %%
slow = excitation(np.array([0.2, 0.2, 0.01, 0.2]))
measured = arm.inverse_dynamics(*slow) + noise * random.standard_normal((len(t), n))
poor = arm.identify(*slow, measured, noise=noise)
print(f"residual {found.residual:.3f} and {poor.residual:.3f} N m, N")
print("standard errors grow by the factors", (poor.errors / found.errors).round(0))

# %% [markdown]
# ## The test that counts
#
# Both results predict the torques of a motion that was not used to identify them.

# %%
other = excitation(np.array([2.0, 2.0, 0.1, 2.0]))
expected = arm.inverse_dynamics(*other)
regressor = arm.regressor_base(*other)
figure, axes = plt.subplots(figsize=(7, 4))
axes.plot(t, expected[:, 0], "k", label="true")
for name, beta in (("identified", found.values), ("from the small motion", poor.values)):
    predicted = regressor @ beta
    axes.plot(t, predicted[:, 0], "--", label=name)
    print(f"{name:20} root mean square error", np.sqrt(np.mean((predicted - expected) ** 2, axis=0)).round(3))
axes.set(xlabel="t, s", ylabel="torque of joint 1, N m", xlim=(0, 10))
axes.legend()

# %% [markdown]
# For logs of millions of rows, and for identified values that must be physically consistent, see
# [logs](../users/logs.md).
