"""The package as users see it. Robot files are those of the repository."""

import os
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import robots

FILES = Path(__file__).resolve().parents[2] / "robots"


def arm(name):
    return robots.load(FILES / f"{name}.toml")


def states(robot, count, seed=1):
    random = np.random.default_rng(seed)
    return [random.uniform(-1, 1, (count, robot.degrees_of_freedom)) for _ in range(3)]


def test_batches_are_single_calls():
    for name in ("planar_2r", "puma560", "panda"):
        robot = arm(name)
        q, qd, qdd = states(robot, 131)
        tau = robot.inverse_dynamics(q, qd, qdd)
        assert np.array_equal(tau, [robot.inverse_dynamics(*row) for row in zip(q, qd, qdd)])
        assert np.array_equal(tau, robot.inverse_dynamics(q, qd, qdd, threads=3))


def test_one_state_is_that_of_a_batch():
    robot = arm("puma560")
    q, qd, qdd = (array[0] for array in states(robot, 1))
    robot.inverse_dynamics(q, qd, qdd)  # Compiled with the first call; later ones take the short way.
    tau = robot.inverse_dynamics(q[None], qd[None], qdd[None])[0]
    wide = np.zeros(12)
    wide[::2] = qd
    assert np.array_equal(tau, robot.inverse_dynamics(q, wide[::2], qdd[::-1][::-1]))
    assert np.array_equal(tau, robot.inverse_dynamics(list(q), tuple(qd), qdd))
    assert np.array_equal(tau, robot.inverse_dynamics(q, qd=qd, qdd=qdd))
    narrow = robot.inverse_dynamics(*(array.astype(np.float32) for array in (q, qd, qdd)))
    assert narrow.dtype == np.float32 and np.allclose(narrow, tau, rtol=1e-4)
    assert robot.inverse_dynamics(q, qd, 0).shape == (6,)
    assert robot.mass_matrix(q).shape == robot.mass_matrix(q).shape == (6, 6)
    assert np.array_equal(robot.mass_matrix(q), robot.mass_matrix(q[None])[0])
    energies = robot.energies
    assert energies(q, qd) == energies(q, qd) and all(np.ndim(energy) == 0 for energy in energies(q, qd))
    for given in ((q[:5], qd, qdd), (q, qd), (q, qd, qdd, q), (q.astype(complex), qd, qdd), (q, qd, None)):
        with pytest.raises(robots.RobotError):
            robot.inverse_dynamics(*given)


def test_functions_agree():
    robot = arm("puma560")
    q, qd, qdd = states(robot, 50)
    mass, bias = robot.call("mass_matrix", "bias", q=q, qd=qd)
    tau = np.einsum("nij,nj->ni", mass, qdd) + bias
    assert np.allclose(tau, robot.inverse_dynamics(q, qd, qdd), rtol=1e-10, atol=1e-10)
    assert np.allclose(robot.forward_dynamics(q, qd, tau), qdd, rtol=1e-8, atol=1e-8)


def test_layouts_and_types():
    robot = arm("puma560")
    q, qd, qdd = states(robot, 64)
    tau = robot.inverse_dynamics(q, qd, qdd)
    wide = np.zeros((128, 12))
    wide[::2, ::2] = q
    assert np.array_equal(tau, robot.inverse_dynamics(wide[::2, ::2], np.asfortranarray(qd), qdd[::-1][::-1]))
    assert np.array_equal(robot.inverse_dynamics(q[::-1], qd[::-1], qdd[::-1]), tau[::-1])
    out = np.zeros((64, 12))[:, ::2]
    assert robot.inverse_dynamics(q, qd, qdd, out=out) is out
    assert np.array_equal(out, tau)
    narrow = robot.inverse_dynamics(*(array.astype(np.float32) for array in (q, qd, qdd)))
    assert narrow.dtype == np.float32 and np.allclose(narrow, tau, rtol=1e-4, atol=1e-4)
    assert np.array_equal(robot.inverse_dynamics(q, 0, 0), robot.inverse_dynamics(q, 0 * q, 0 * q))
    assert robot.inverse_dynamics(q[:0], qd[:0], qdd[:0]).shape == (0, 6)
    assert np.isnan(robot.inverse_dynamics(q * np.nan, qd, qdd)).any()


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda r, q: r.inverse_dynamics(q[:, :5], q, q), "shape"),
        (lambda r, q: r.inverse_dynamics(q, q[:3], q), "numbers of states"),
        (lambda r, q: r.inverse_dynamics(q, q), "needs the input `qdd`"),
        (lambda r, q: r.inverse_dynamics(q, q, q, q), "takes 3 inputs"),
        (lambda r, q: r.inverse_dynamics(q, q, q, qq=q), "no input `qq`"),
        (lambda r, q: r.inverse_dynamics(q, q, qd=q), "given twice"),
        (lambda r, q: r.inverse_dynamics(q.astype(complex), q, q), "real numbers"),
        (lambda r, q: r.inverse_dynamics(q[None], q, q), "shape"),
        (lambda r, q: r.inverse_dynamics(q, q, q, out=np.zeros((3, 3))), "out has the shape"),
        (lambda r, q: r.inverse_dynamics(q, q, q, out=np.broadcast_to(np.zeros(6), q.shape)), "read-only"),
        (lambda r, q: r.inverse_dynamics(q, q, q, parameters={"nothing": 1.0}), "nothing"),
        (lambda r, q: r.inverse_dynamics(q, q, q, threads=0), "threads"),
        (lambda r, q: r.function("inverse"), "inverse"),
        (lambda r, q: r.equations(form="none"), "none"),
        (lambda r, q: r.identify(q, q, q, q[:2]), "shape"),
        (lambda r, q: robots.load("absent.toml"), "absent.toml"),
    ],
)
def test_what_is_wrong_is_told(call, message):
    robot = arm("puma560")
    with pytest.raises(robots.RobotError, match=message):
        call(robot, states(robot, 8)[0])


def test_all_diagnostics_are_in_one_error(tmp_path):
    text = (FILES / "planar_2r.toml").read_text()
    file = tmp_path / "broken.toml"
    file.write_text(text.replace("[robot]", "[robot]\nfirst = 1\nsecond = 2"))
    with pytest.raises(robots.RobotError) as error:
        robots.load(file)
    assert "first" in str(error.value) and "second" in str(error.value)


def test_parameters():
    robot = arm("planar_2r")
    q, qd, qdd = states(robot, 4)
    name, value = next((name, value) for name, value in robot.parameters.items() if name == "m2")
    same = robot.inverse_dynamics(q, qd, qdd, parameters={name: value})
    other = robot.inverse_dynamics(q, qd, qdd, parameters={name: 2 * value + 1})
    assert np.array_equal(same, robot.inverse_dynamics(q, qd, qdd))
    assert not np.array_equal(other, same)


@pytest.mark.parametrize("name", ["trttr1", "planar_3r", "puma560"])
def test_sympy_agrees(name):
    sympy = pytest.importorskip("sympy")
    robot = arm(name)
    n = robot.degrees_of_freedom
    symbols = [f"{kind}{index + 1}" for kind in ("q", "qd", "qdd") for index in range(n)]
    matrix = robot.equations().sympy
    assert matrix.shape == (n, 1)
    known = robot.parameters
    names = sorted(str(symbol) for symbol in matrix.free_symbols)
    # Wrenches at the tip are 0 in the function without them.
    wrench = [name for name in names if name not in symbols and name not in known]
    assert all(name[0] in "FM" for name in wrench), wrench
    compiled = sympy.lambdify([sympy.Symbol(name) for name in names], matrix, "numpy")
    for q, qd, qdd in zip(*states(robot, 20)):
        values = dict(zip(symbols, [*q, *qd, *qdd])) | dict.fromkeys(wrench, 0.0)
        found = compiled(*(values.get(name, known.get(name)) for name in names))
        tau = robot.inverse_dynamics(q, qd, qdd)
        assert np.abs(found[:, 0] - tau).max() <= 1e-12 * max(1.0, np.abs(tau).max())


@pytest.mark.parametrize("form", ["expanded", "collected", "grouped", "compact", "recursive", "regrouped"])
def test_equations_are_shown(form):
    for name in ("planar_2r", "trttr1"):
        equations = arm(name).equations(form=form)
        latex = equations._repr_latex_()
        assert latex.count("{") == latex.count("}") > 0
        assert latex.count("\\begin{") == latex.count("\\end{") > 0
        assert "<math" in equations._repr_html_() and equations.typst


def test_identification_finds_the_parameters():
    robot = arm("puma560")
    q, qd, qdd = states(robot, 200)
    tau = robot.inverse_dynamics(q, qd, qdd)
    found = robot.identify(q, qd, qdd, tau)
    assert found.rank == len(found.names) == len(found.as_dict())
    fresh = states(robot, 20, seed=2)
    torques = robot.regressor_base(*fresh) @ found.values
    assert np.allclose(torques, robot.inverse_dynamics(*fresh), rtol=1e-8, atol=1e-8)


def test_doors(tmp_path):
    robot = arm("planar_2r")
    assert robot.check()["errors"] == 0
    assert robot.base_parameters()["base"]
    assert robot.diff(arm("scara"))
    assert "<svg" in robot._repr_html_()
    assert "fn inverse_dynamics" in robot.source() and "double" in robot.source("c")
    assert "documentclass" in robot.document(tmp_path / "arm.tex").read_text()
    assert "inverse_dynamics" in dir(robot) and robot.inverse_dynamics.__doc__
    motion = robot.simulate(1.0, q0=[0.5, 0.1], step=0.1)
    assert motion["t"].shape == (11,) and motion["q"].shape == (11, 2)
    done = subprocess.run([sys.executable, "-m", "robots", "--version"], capture_output=True, text=True, env={"PATH": ""})
    assert done.returncode == 0 and done.stdout
    assert subprocess.run([sys.executable, "-m", "robots", "nothing"], capture_output=True).returncode == 2


def test_arrow():
    pa = pytest.importorskip("pyarrow")
    robot = arm("puma560")
    inputs = dict(zip(("q", "qd", "qdd"), states(robot, 100)))
    tau = robot.inverse_dynamics(**inputs)
    fixed = {name: pa.FixedSizeListArray.from_arrays(pa.array(array.ravel()), 6) for name, array in inputs.items()}
    lists = {name: pa.array(array.tolist()) for name, array in inputs.items()}
    scalars = {f"{name}{i + 1}": pa.array(array[:, i]) for name, array in inputs.items() for i in range(6)}
    function = pickle.loads(pickle.dumps(robot.arrow("inverse_dynamics")))
    for columns in (fixed, lists, scalars):
        batch = pa.record_batch(columns)
        for part, rows in ((batch, tau), (batch.slice(7, 50), tau[7:57])):
            assert np.array_equal(function(part).column(0).to_pylist(), rows)
    with pytest.raises(robots.RobotError, match="no column `qdd`"):
        function(pa.record_batch({name: fixed[name] for name in ("q", "qd")}))
    lists["q"] = pa.array([[0.0]] * 100)
    with pytest.raises(robots.RobotError, match="6 entries"):
        function(pa.record_batch(lists))


def test_polars_and_duckdb():
    polars, duckdb = pytest.importorskip("polars"), pytest.importorskip("duckdb")
    robot = arm("planar_2r")
    inputs = dict(zip(("q", "qd", "qdd"), states(robot, 10)))
    tau = robot.inverse_dynamics(**inputs)
    frame = polars.DataFrame({name: array.tolist() for name, array in inputs.items()})
    function = robot.arrow("inverse_dynamics")
    assert np.array_equal(function(frame).column(0).to_pylist(), tau)
    table = duckdb.sql("SELECT * FROM frame")
    assert np.array_equal(function(table.to_arrow_table()).column(0).to_pylist(), tau)
