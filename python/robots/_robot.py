"""Robots that were read from files."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from . import _pdf, _shown
from ._arrow import BatchFunction
from ._command import run
from ._equations import Equations
from ._function import Function
from ._native import RobotError, RobotSource


def load(
    path: str | os.PathLike[str], *, search: bool = False, allow_massless: bool = False, allow_unphysical: bool = False
) -> Robot:
    """Reads a robot file, TOML or URDF, and the plan pinned beside it, if there is one.

    If no plan is pinned, `search` searches for the plan with the fewest operations, which takes about a second. `allow_massless` accepts moving links
    without mass, and `allow_unphysical` accepts physically impossible inertias. A single RobotError reports all errors of the file; `arm.check()` returns
    the warnings.

    >>> arm = robots.load("planar_2r.toml")
    >>> arm
    <robot planar_2r, 2 coordinates, planar_2r.toml>
    """
    return Robot(os.fspath(path), search=search, allow_massless=allow_massless, allow_unphysical=allow_unphysical)


class Robot:
    """A robot. Its functions, `arm.functions`, are methods: ``arm.inverse_dynamics(q, qd, qdd)``.

    >>> arm = robots.load("planar_2r.toml")
    >>> arm.gravity([0.0, 0.0])
    array([65.727, 11.772])
    >>> arm.gravity([[0.0, 0.0], [np.pi / 2, 0.0]], m2=0.0).round(3)
    array([[24.525,  0.   ],
           [ 0.   ,  0.   ]])
    """

    def __init__(self, path: str, *, search: bool = False, allow_massless: bool = False, allow_unphysical: bool = False) -> None:
        self._path = path
        self._options = {"search": search, "allow_massless": allow_massless, "allow_unphysical": allow_unphysical}
        self._flags = ["--allow-massless"] * allow_massless + ["--allow-unphysical"] * allow_unphysical
        self._source = RobotSource(path, search, allow_massless, allow_unphysical)
        self._made: dict[tuple[str, ...], Function] = {}
        self.name: str = self._source.robot
        self.degrees_of_freedom: int = self._source.degrees_of_freedom

    @property
    def functions(self) -> list[str]:
        """The names of the functions."""
        return self._source.functions()

    @property
    def parameters(self) -> dict[str, float | None]:
        """The parameters and their nominal values."""
        return dict(self._source.parameters())

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.functions]

    def __getattr__(self, name: str) -> Function:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            found = self.function(name)
        except RobotError as error:
            raise AttributeError(str(error)) from None
        self.__dict__[name] = found
        return found

    def function(self, *names: str) -> Function:
        """Returns a function, or one that computes several functions in one call and shares their work; it is derived on first use."""
        if not names:
            raise RobotError("name at least one function")
        if names not in self._made:
            self._made[names] = Function(self._source, list(names))
        return self._made[names]

    def call(self, *names: str, **inputs: Any) -> Any:
        """Computes several functions in one call, which shares their work.

        >>> arm = robots.load("planar_2r.toml")
        >>> M, h = arm.call("mass_matrix", "bias", q=[0.0, 0.0], qd=[1.0, 0.0])
        >>> M.shape, h.shape
        ((2, 2), (2,))
        """
        return self.function(*names)(**inputs)

    def _run(self, name: str, *arguments: str, allowed: tuple[int, ...] = (0,)) -> str:
        """Runs a command on the robot's file."""
        return run([name, self._path, *self._flags, *arguments], allowed)

    def equations(self, *, form: str = "expanded", quantities: str = "Q", **options: Any) -> Equations:
        """Returns the equations of motion in a form: expanded, collected, grouped, compact, recursive or regrouped.

        `options` are those of the command `equations`: `friction=True`, `letters="tau,M,C,g"`, `digits=4`, ….

        >>> arm = robots.load("planar_2r.toml")
        >>> print(arm.equations(quantities="Q", form="grouped").formulas["Q2"])
        M_1_2*qdd1 + M_2_2*qdd2 - b_1_2_2*qd1^2 + g_2 + w_2
        """
        found = Equations(["equations", self._path, *self._flags, "--form", form, "--quantity", quantities, *_flags(options)])
        _ = found.text  # Errors are raised now.
        return found

    def base_parameters(self) -> dict[str, Any]:
        """Returns the base parameters: names, formulas in the standard parameters, and values.

        >>> arm = robots.load("planar_2r.toml")
        >>> [entry["name"] for entry in arm.base_parameters()["base"]]
        ['MXR_1', 'MY_1', 'ZZR_1', 'MX_2', 'MY_2', 'ZZ_2']
        """
        found: dict[str, Any] = json.loads(self._run("base", "--format", "json"))
        return found

    def check(self) -> dict[str, Any]:
        """Returns errors, warnings and notes about the file.

        >>> robots.load("planar_2r.toml").check()["errors"]
        0
        """
        found: dict[str, Any] = json.loads(self._run("check", "--format", "json", allowed=(0, 1)))
        return found

    def diff(self, other: Robot) -> dict[str, Any]:
        """Shows how another robot differs: parameters, terms, operations, torques."""
        if not isinstance(other, Robot):
            raise RobotError(f"diff takes another robot from robots.load, not {other!r}")
        flags = sorted({*self._flags, *other._flags})
        found: dict[str, Any] = json.loads(run(["diff", self._path, other._path, *flags, "--format", "json"], (0, 1)))
        return found

    def document(self, path: str | os.PathLike[str], *, force: bool = False, by: str | None = None, **options: Any) -> Path:
        """Writes a document in the format of the path's extension: .pdf, .tex, .typ, .md, or .html for a page in which the robot moves.

        A PDF is typeset by Typst (`pip install typst`, or the program) or, without it, by pdflatex; `by="typst"` or `by="latex"` chooses one. `options` are those of the
        command `document`, or `report` for a page: `form="grouped,recursive"`, `title="…"`, …. An existing file that this package did
        not write is replaced only with `force`.
        """
        target = Path(path)
        notation = {".tex": "latex", ".typ": "typst", ".md": "markdown"}.get(target.suffix)
        flags = _flags(options)
        if by is not None and target.suffix != ".pdf":
            raise RobotError(f"{target}: `by` is only for documents with the extension .pdf")
        if target.suffix == ".html":
            run(["report", self._path, *self._flags, "--without-compiler", "-o", str(target), *flags, *["--force"] * force])
        elif target.suffix == ".pdf":
            if target.exists() and not force:
                raise RobotError(f"{target} exists; choose another name, or replace it with force=True")
            _pdf.typeset(lambda kind, file: self._document(kind, file, flags), target, by)
        elif notation is not None:
            self._document(notation, target, [*flags, *["--force"] * force])
        else:
            raise RobotError(f"{target}: the extension must be .pdf, .tex, .typ, .md or .html")
        return target

    def _document(self, notation: str, target: Path, flags: list[str]) -> None:
        self._run("document", "--format", notation, "-o", str(target), *flags)

    def source(self, language: str = "rust", **options: Any) -> str:
        """Returns code of the robot's usual functions in a language that needs only one file: rust, c, cuda, python or wgsl. `package` writes other languages.

        `options` are those of the command `generate`: `function="gravity"`, `scalar="f32"`, ….

        >>> "planar_2r_inverse_dynamics(" in robots.load("planar_2r.toml").source("c")
        True
        """
        return self._run("generate", f"--language={language}", *_flags(options))

    def package(self, folder: str | os.PathLike[str], language: str = "rust", *, force: bool = False, **options: Any) -> Path:
        """Writes a package with the code, in Rust a crate; the languages are rust, c, cpp, arduino, cuda, matlab, python, javascript, wasm and wgsl.

        `options` are those of the command `crate`. Files that this package did not write are replaced only with `force`.
        """
        self._run("crate", f"--language={language}", "-o", os.fspath(folder), *_flags(options), *["--force"] * force)
        return Path(folder)

    def simulate(
        self,
        time: float = 10.0,
        *,
        q0: Any = None,
        qd0: Any = None,
        step: float = 0.01,
        torques: Mapping[str | int, str] | None = None,
        friction: bool = False,
        parameters: Mapping[str, float] | None = None,
    ) -> dict[str, Any]:
        """Simulates the motion from a state; returns arrays `t`, `q`, `qd`, `qdd`, `tau` and energies, with a row for each time.

        `torques` contains an expression in t, q1 …, qd1 … and the parameters for each driven joint, by number or name.

        >>> motion = robots.load("planar_2r.toml").simulate(1.0, q0=[0.5, 0.1], step=0.1)
        >>> motion["t"].shape, motion["q"].shape
        ((11,), (11, 2))
        """
        arguments = ["--time", repr(float(time)), "--step", repr(float(step))]
        for option, value in (("--q0", q0), ("--qd0", qd0)):
            if value is not None:
                arguments.append(f"{option}={','.join(repr(float(entry)) for entry in np.ravel(value))}")
        for joint, expression in (torques or {}).items():
            arguments += ["--torque", f"{joint}={expression}"]
        for name, number in (parameters or {}).items():
            arguments.append(f"--set={name}={float(number)!r}")
        lines = self._run("simulate", *arguments, *["--friction"] * friction).splitlines()
        head = next(index for index, line in enumerate(lines) if not line.startswith("#"))
        table = np.array([[float(entry) for entry in line.split(",")] for line in lines[head + 1 :]])
        found: dict[str, Any] = {}
        columns = lines[head].split(",")
        for kind in ("q", "qd", "qdd", "tau"):
            found[kind] = table[:, [index for index, name in enumerate(columns) if name.rstrip("0123456789") == kind]]
        rest = {name: table[:, index] for index, name in enumerate(columns) if name.rstrip("0123456789") not in found}
        return {**rest, **found}

    def identify(
        self, q: Any, qd: Any, qdd: Any, tau: Any, *, noise: Any = None, parameters: Mapping[str, float] | None = None
    ) -> Identification:
        """Estimates the base parameters from joint torques, by least squares over all rows.

        `noise` is the standard deviation of the noise in each joint's torques, (n,), in N m or N; each row is then divided by it. Without `noise` all rows have the same weight.

        >>> arm = robots.load("planar_2r.toml")
        >>> q, qd, qdd = np.random.default_rng(1).uniform(-1, 1, (3, 50, 2))
        >>> found = arm.identify(q, qd, qdd, arm.inverse_dynamics(q, qd, qdd))
        >>> found.rank, round(found.as_dict()["MX_2"], 9)
        (6, 1.2)
        """
        regressor = self.regressor_base(q, qd, qdd, parameters=parameters)
        measured = np.asarray(tau, np.float64)
        if regressor.ndim != 3 or measured.shape != regressor.shape[:2]:
            raise RobotError(f"tau has the shape {measured.shape}; it must be (N, {self.degrees_of_freedom}) as the states are")
        if measured.size == 0:
            raise RobotError("there are no states; identification needs at least one")
        weights = 1.0 / np.broadcast_to(_noise(noise, self.degrees_of_freedom), measured.shape).ravel()
        matrix, torques = regressor.reshape(-1, regressor.shape[2]), measured.ravel()
        if not (np.isfinite(matrix).all() and np.isfinite(torques).all()):
            raise RobotError("the states and torques must be finite")
        weighted = matrix * weights[:, None]
        values, _, rank, singular = np.linalg.lstsq(weighted, torques * weights, rcond=None)
        residuals = torques - matrix @ values
        free = len(torques) - int(rank)
        spread = 1.0 if noise is not None else float(np.sqrt(residuals @ residuals / free)) if free > 0 else np.inf
        names = [entry["name"] for entry in self.base_parameters()["base"]]
        errors = spread * _standard_errors(weighted) if rank == len(values) else np.full(len(values), np.inf)
        return Identification(names, values, errors, int(rank), singular, float(np.sqrt(np.mean(residuals**2))))

    def arrow(self, *names: str, output: str = "fixed_lists", keep: Sequence[str] = ()) -> BatchFunction:
        """Returns a function that turns a record batch of pyarrow, or a table of any library with Arrow's PyCapsule interface, into another.

        >>> import pyarrow as pa
        >>> arm = robots.load("planar_2r.toml")
        >>> batch = pa.record_batch({"id": [7], "q1": [0.0], "q2": [0.0]})
        >>> arm.arrow("gravity", output="columns", keep=["id"])(batch).schema.names
        ['id', 'tau1', 'tau2']
        """
        return BatchFunction(os.path.abspath(self._path), names, self._options, output, tuple(keep))

    def __reduce__(self) -> Any:
        """Pickles the path and the options; another process reads the file again."""
        return (_of_file, (os.path.abspath(self._path), self._options))

    def __repr__(self) -> str:
        return f"<robot {self.name}, {self.degrees_of_freedom} coordinates, {self._path}>"

    def _repr_html_(self) -> str:
        scheme = _shown.picture(self._run("scheme"), f"scheme of {self.name}")
        tables = [_shown.table(self._source.links()), _shown.table(self._source.parameter_rows())]
        return _shown.block(self.name, self._source.description, [scheme, *tables])


def _of_file(path: str, options: dict[str, bool]) -> Robot:
    return Robot(path, **options)


def _flags(options: Mapping[str, Any]) -> list[str]:
    """Returns the options of a command: True adds an option without a value, False and None add nothing."""
    flags: list[str] = []
    for name, value in options.items():
        option = f"--{name.replace('_', '-')}"
        if value is True:
            flags.append(option)
        elif value is not False and value is not None:
            flags.append(f"{option}={value}")
    return flags


def _noise(given: Any, joints: int) -> Any:
    if given is None:
        return np.ones(joints)
    noise = np.asarray(given, np.float64)
    if noise.shape != (joints,) or not (np.isfinite(noise).all() and (noise > 0).all()):
        raise RobotError(f"noise must be {joints} positive numbers, one for each joint")
    return noise


def _standard_errors(matrix: Any) -> Any:
    """Returns the square roots of the diagonal of (Aᵀ A)⁻¹, from a triangle R with Rᵀ R = Aᵀ A; Aᵀ A is not formed."""
    triangle = np.linalg.qr(matrix, mode="r")
    return np.linalg.norm(np.linalg.inv(triangle), axis=1)


class Identification:
    """Base parameters that were identified."""

    def __init__(self, names: list[str], values: Any, errors: Any, rank: int, singular_values: Any, residual: float) -> None:
        self.names = names
        self.values = values
        self.errors = errors
        """The standard errors of the values, for the given noise; without it, for noise of the size of the residuals, the same in all rows."""
        self.rank = rank
        self.singular_values = singular_values
        self.residual = residual
        """The root mean square of the residuals of the torques."""

    @property
    def condition(self) -> float:
        """The ratio of the largest to the smallest singular value of the regressor."""
        smallest = self.singular_values[-1]
        return float(self.singular_values[0] / smallest) if smallest else float("inf")

    def as_dict(self) -> dict[str, float]:
        """Returns the values by name."""
        return dict(zip(self.names, map(float, self.values)))
