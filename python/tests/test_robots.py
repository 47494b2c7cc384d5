"""The package as users see it. Robot files are those of the repository."""

import importlib.util
import pickle
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import robots

FILES = Path(__file__).resolve().parents[2] / "robots"


FORMS = ["expanded", "collected", "grouped", "compact", "recursive", "regrouped"]
# The others have no expanded form, or one of a hundred pages.
SHORT = {"planar_2r", "planar_3r", "scara", "trttr1", "puma560"}


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
        (lambda r, q: r.identify(q[:0], q[:0], q[:0], q[:0]), "no states"),
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


@pytest.mark.parametrize("form", FORMS)
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


def test_standard_errors_are_those_of_repeated_measurements():
    robot, random = arm("scara"), np.random.default_rng(4)
    q, qd, qdd = states(robot, 60)
    exact, noise = robot.inverse_dynamics(q, qd, qdd), np.array([0.3, 0.1, 0.5, 0.02])
    measured = [exact + noise * random.standard_normal(exact.shape) for _ in range(400)]
    found = [robot.identify(q, qd, qdd, tau, noise=noise) for tau in measured]
    spread = np.std([one.values for one in found], axis=0)
    # The standard deviation of 400 values is known to 3.5 %; four of those.
    assert np.allclose(spread, found[0].errors, rtol=0.15)
    alike = robot.identify(q, qd, qdd, exact + 0.1 * random.standard_normal(exact.shape))
    same = robot.identify(q, qd, qdd, exact, noise=[0.1] * 4)
    assert np.allclose(alike.errors, same.errors, rtol=0.25)
    still = robot.identify(q[:1].repeat(9, 0), qd[:1].repeat(9, 0), qdd[:1].repeat(9, 0), exact[:1].repeat(9, 0))
    assert still.rank < 8 and np.isinf(still.errors).all()
    for wrong in ([0.1] * 3, [0.0] * 4, [np.nan] * 4):
        with pytest.raises(robots.RobotError, match="noise must be 4 positive"):
            robot.identify(q, qd, qdd, exact, noise=wrong)


def test_doors(tmp_path):
    robot = arm("planar_2r")
    assert robot.check()["errors"] == 0
    assert robot.base_parameters()["base"]
    assert robot.diff(arm("scara"))
    shown = robot._repr_html_()
    assert "data:image/svg+xml" in shown and "revolute about (0, 0, 1)" in shown and "mass of link 2" in shown
    assert "fn inverse_dynamics" in robot.source() and "double" in robot.source("c")
    assert "def inverse_dynamics" not in robot.source("python", function="gravity")
    assert "float" in robot.source("c", scalar="f32") and "float" not in robot.source("c")
    for language in ("rust", "cpp", "matlab", "javascript", "wasm"):
        made = robot.package(tmp_path / language, language)
        assert sum(file.stat().st_size for file in made.rglob("*") if file.is_file()) > 5000, language
    assert "documentclass" in robot.document(tmp_path / "arm.tex").read_text()
    assert "inverse_dynamics" in dir(robot) and robot.inverse_dynamics.__doc__
    motion = robot.simulate(1.0, q0=[0.5, 0.1], step=0.1)
    assert motion["t"].shape == (11,) and motion["q"].shape == (11, 2)
    done = subprocess.run([sys.executable, "-m", "robots", "--version"], capture_output=True, text=True, env={"PATH": ""})
    assert done.returncode == 0 and done.stdout
    assert subprocess.run([sys.executable, "-m", "robots", "nothing"], capture_output=True).returncode == 2


def test_documents(tmp_path, monkeypatch):
    robot = arm("planar_2r")
    for ending, start in ((".tex", "% @generated"), (".typ", "// @generated"), (".md", "<!-- @generated"), (".html", "<!DOCTYPE html>")):
        assert robot.document(tmp_path / f"arm{ending}").read_text().startswith(start)
    assert "Planar" in robot.document(tmp_path / "titled.tex", title="Planar", form="grouped,recursive").read_text()
    monkeypatch.setenv("PATH", "")
    monkeypatch.setitem(sys.modules, "typst", None)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    for by, remedy in ((None, "pip install typst"), ("typst", "pip install typst"), ("latex", "pdflatex")):
        with pytest.raises(robots.RobotError, match=remedy):
            robot.document(tmp_path / "arm.pdf", by=by)
    assert not (tmp_path / "arm.pdf").exists()


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="no pdflatex")
@pytest.mark.parametrize("name", sorted(file.stem for file in FILES.glob("*.toml")))
def test_what_notebooks_show_compiles(tmp_path, name):
    """Each form as a notebook gives it to LaTeX, with amsmath alone."""
    forms = FORMS if name in SHORT else ["compact", "recursive"]
    shown = [arm(name).equations(form=form)._repr_latex_() for form in forms]
    head = "\\documentclass{article}\n\\usepackage{amsmath}\n\\allowdisplaybreaks\n\\begin{document}\n"
    (tmp_path / "shown.tex").write_text(head + "\n\n".join(shown) + "\n\\end{document}\n")
    command = ["pdflatex", "-no-shell-escape", "-draftmode", "-interaction=nonstopmode", "-halt-on-error", "shown.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, errors="replace")
    assert done.returncode == 0, done.stdout[-2000:]


@pytest.mark.parametrize("by", ["typst", "latex"])
def test_documents_as_pdf(tmp_path, by):
    if by == "typst":
        pytest.importorskip("typst")
    elif shutil.which("pdflatex") is None:
        pytest.skip("no pdflatex")
    robot, target = arm("planar_2r"), tmp_path / "arm.pdf"
    assert robot.document(target, by=by) == target
    made = target.read_bytes()
    assert made.startswith(b"%PDF") and len(made) > 20_000
    with pytest.raises(robots.RobotError, match="force=True"):
        robot.document(target, by=by)
    assert robot.document(target, by=by, force=True).read_bytes().startswith(b"%PDF")
    assert [file.name for file in tmp_path.iterdir()] == ["arm.pdf"]


def test_every_form_is_the_same_function():
    """Joint torques out of each form, with what it defines put in, in the order of the joints."""
    sympy = pytest.importorskip("sympy")
    robot = arm("planar_2r")
    torques = robot.equations().sympy
    values = {symbol: 0.3 + 0.1 * index for index, symbol in enumerate(sorted(torques.free_symbols, key=str))}
    expected = np.array(torques.subs(values), float)
    for form in ("collected", "grouped", "compact", "recursive", "regrouped"):
        found = np.array(robot.equations(form=form).sympy.subs(values), float)
        assert np.allclose(found, expected, rtol=1e-12), form
    both = robot.equations(quantities="a_c,Q").formulas
    assert list(both)[:2] == ["a_c1.x", "a_c1.y"] and list(both)[-2:] == ["Q1", "Q2"]


def test_arrow_for_other_engines():
    pa = pytest.importorskip("pyarrow")
    robot = arm("planar_2r")
    q, qd, _ = states(robot, 5)
    batch = pa.record_batch({"id": range(5), **{f"q{i + 1}": q[:, i] for i in range(2)}, "qd": qd.tolist()})
    M, energy = robot.mass_matrix(q), robot.energies(q, qd)
    columns = robot.arrow("mass_matrix", "energies", output="columns", keep=["id"])(batch)
    assert columns.schema.names == ["id", *(f"mass_matrix{i + 1}" for i in range(4)), "kinetic", "potential"]
    assert np.array_equal(np.stack([columns[f"mass_matrix{i + 1}"] for i in range(4)], axis=1), M.reshape(5, 4))
    assert np.allclose(columns["kinetic"], energy[0], rtol=1e-12)
    lists = pickle.loads(pickle.dumps(robot.arrow("mass_matrix", output="lists")))(batch.slice(2))
    assert pa.types.is_list(lists["mass_matrix"].type) and np.array_equal(lists["mass_matrix"].to_pylist(), M[2:].reshape(3, 4))
    assert robot.arrow("mass_matrix", output="lists")(batch.slice(5)).num_rows == 0
    for keep, message in ((["name"], "no column `name`"), (["qd", "q1"], None)):
        if message:
            with pytest.raises(robots.RobotError, match=message):
                robot.arrow("mass_matrix", keep=keep)(batch)
        else:
            assert robot.arrow("mass_matrix", keep=keep)(batch).schema.names == [*keep, "mass_matrix"]


def test_unphysical_files_are_taken_if_that_is_said(tmp_path):
    file = tmp_path / "light.toml"
    file.write_text((FILES / "planar_2r.toml").read_text().replace('m2 = { value = 3.0', 'm2 = { value = -3.0'))
    with pytest.raises(robots.RobotError, match="-3"):
        robots.load(file)
    robot = robots.load(file, allow_unphysical=True)
    assert np.isfinite(robot.gravity([0.0, 0.0])).all() and "m2" in robot.equations().text
    assert robot.check()["warnings"] > 0
    pytest.importorskip("pyarrow")
    pickle.loads(pickle.dumps(robot.arrow("gravity")))


def test_other_processes_read_the_file_again(tmp_path, monkeypatch):
    """A worker may run in another folder."""
    monkeypatch.chdir(FILES)
    robot = robots.load("planar_2r.toml")
    made = [pickle.dumps(robot)]
    if importlib.util.find_spec("pyarrow"):
        made.append(pickle.dumps(robot.arrow("gravity")))
    monkeypatch.chdir(tmp_path)
    assert np.array_equal(pickle.loads(made[0]).gravity([0.1, 0.2]), robot.gravity([0.1, 0.2]))
    for text in made:
        pickle.loads(text)


def test_what_editors_show():
    import inspect

    robot = arm("puma560")
    assert list(inspect.signature(robot.inverse_dynamics).parameters)[:3] == ["q", "qd", "qdd"]
    doc = robot.inverse_dynamics.__doc__
    assert "- q (6,): " in doc and "rad/s" in doc and "Outputs:" in doc
    assert repr(robot.gravity) == "<gravity(q[6]) -> tau[6] of the robot puma560>"
    for name in robot.functions:
        if name in ("gravity", "energies", "jacobian", "mass_matrix"):
            assert inspect.signature(robot.function(name)) and robot.function(name).__doc__


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
