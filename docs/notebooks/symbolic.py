# %% [markdown]
# # Notebook: the same equations derived with SymPy
#
# A program that prints equations must be checked by an independent program. Here SymPy derives the equations of a
# planar arm with three links by Lagrange's method, using only the positions of the centers of mass. The notebook then
# simplifies the difference from the printed equations.

# %%
import numpy as np
import robots
import sympy

arm = robots.load("robots/planar_3r.toml")
printed = arm.equations().sympy
print(len(arm.parameters), "parameters:", ", ".join(arm.parameters))

# %% [markdown]
# ## Lagrange
#
# The positions follow from the geometry: each link begins at the end of the link before it.

# %%
n = 3
time = sympy.Symbol("t")
q = [sympy.Function(f"q{i + 1}")(time) for i in range(n)]
g = sympy.Symbol("g")
m, l, r, I = ([sympy.Symbol(f"{name}{i + 1}") for i in range(n)] for name in "mlrI")

joint, angle, T, V = sympy.zeros(2, 1), 0, 0, 0
for i in range(n):
    angle += q[i]
    along = sympy.Matrix([sympy.cos(angle), sympy.sin(angle)])
    center = joint + r[i] * along
    speed = center.diff(time)
    T += m[i] * speed.dot(speed) / 2 + I[i] * angle.diff(time) ** 2 / 2
    V += m[i] * g * center[1]
    joint += l[i] * along

L = T - V
by_lagrange = sympy.Matrix([L.diff(x.diff(time)).diff(time) - L.diff(x) for x in q])

# %% [markdown]
# The derivatives with respect to time become the symbols of the printed equations.

# %%
names = {}
for i, x in enumerate(q):
    names[x.diff(time, 2)] = sympy.Symbol(f"qdd{i + 1}")
    names[x.diff(time)] = sympy.Symbol(f"qd{i + 1}")
    names[x] = sympy.Symbol(f"q{i + 1}")
by_lagrange = by_lagrange.subs([(old, new) for old, new in names.items()])

# %% [markdown]
# ## The difference
#
# The printed equations also contain a wrench at the tip, which Lagrange's method omits here, so the wrench is set
# to 0. The difference must be 0 for *all* values, so no numbers are substituted. SymPy multiplies out, expands
# sines of sums and replaces sin² + cos² by 1; that is enough, since both sides are polynomials in the sines and
# cosines of single angles.

# %%
wrench = {symbol: 0 for symbol in printed.free_symbols if symbol.name in ("Fx", "Fy", "Fz", "Mx", "My", "Mz")}
difference = by_lagrange - printed.subs(wrench)
print("difference:", difference.applyfunc(lambda entry: sympy.trigsimp(sympy.expand(sympy.expand_trig(entry)))))

# %% [markdown]
# ## The length of the equations
#
# Both are the same function, but they differ in the effort to read and to compute them.

# %%
grouped, compact = (arm.equations(form=form).expressions for form in ("grouped", "compact"))
print("by Lagrange:       ", sympy.count_ops(by_lagrange), "operations")
print("after simplify:    ", sympy.count_ops(sympy.simplify(by_lagrange[2])), "in the last of the three alone")
print("printed, expanded: ", sympy.count_ops(printed))
print("printed, grouped:  ", sum(map(sympy.count_ops, grouped.values())))
print("printed, compact:  ", sum(map(sympy.count_ops, compact.values())))
arm.equations(form="compact")

# %% [markdown]
# ## As numbers
#
# `lambdify` turns the expressions into a function. Its results must agree with those of the package's own function,
# which is derived by another recursion, over working frames, and does not use these formulas. We compare them for the
# planar arm, for the PUMA 560, and for TRTTR1, which has revolute and prismatic joints.


# %%
def difference_of(name, states=100):
    robot = robots.load(f"robots/{name}.toml")
    column = robot.equations().sympy
    count = robot.degrees_of_freedom
    variables = [sympy.Symbol(f"{kind}{i + 1}") for kind in ("q", "qd", "qdd") for i in range(count)]
    others = sorted(column.free_symbols - set(variables), key=str)
    function = sympy.lambdify([variables, others], column, "numpy")
    values = [robot.parameters.get(str(symbol), 0.0) for symbol in others]  # Wrenches are 0.
    q, qd, qdd = np.random.default_rng(3).uniform(-1, 1, (3, states, count))
    tau = robot.inverse_dynamics(q, qd, qdd)
    by_sympy = [function([*row[0], *row[1], *row[2]], values)[:, 0] for row in zip(q, qd, qdd)]
    return np.abs(by_sympy - tau).max() / np.abs(tau).max()


for name in ("planar_3r", "puma560", "trttr1"):
    print(f"{name:10} agrees to 1e-12 of the largest torque:", bool(difference_of(name) < 1e-12))
