"""Robots that were read from files."""

from __future__ import annotations

import html
import json
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ._command import run
from ._equations import Equations
from ._function import Function
from ._native import RobotError, RobotSource


def load(path: str | os.PathLike[str], *, search: bool = False) -> Robot:
    """Reads a robot file, TOML or URDF, and the plan that is pinned beside it, if there is one.

    `search` looks for the cheapest form of the recursion, for a second or so, if no plan is pinned. Everything that is wrong with the file is in
    one RobotError.
    """
    return Robot(os.fspath(path), search=search)


class Robot:
    """A robot. Its functions (`robot.functions`) are methods: ``robot.inverse_dynamics(q, qd, qdd)``."""

    def __init__(self, path: str, *, search: bool = False) -> None:
        self._path = path
        self._source = RobotSource(path, search)
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
        """A function, or several in one call that share their work; derived on first use."""
        if not names:
            raise RobotError("name at least one function")
        if names not in self._made:
            self._made[names] = Function(self._source, list(names))
        return self._made[names]

    def call(self, *names: str, **inputs: Any) -> Any:
        """Several functions in one call: ``robot.call("mass_matrix", "bias", q=q, qd=qd)``."""
        return self.function(*names)(**inputs)

    def equations(self, *, form: str = "expanded", quantities: str = "Q", friction: bool = False) -> Equations:
        """The equations of motion in a form: expanded, collected, grouped, compact, recursive or regrouped."""
        more = ["--friction"] if friction else []
        found = Equations(["equations", self._path, "--form", form, "--quantity", quantities, *more])
        _ = found.text  # What is wrong is told now.
        return found

    def base_parameters(self) -> dict[str, Any]:
        """The base parameters: names, formulas over the standard parameters, values."""
        found: dict[str, Any] = json.loads(run(["base", self._path, "--format", "json"]))
        return found

    def check(self) -> dict[str, Any]:
        """Errors, warnings and notes about the file."""
        found: dict[str, Any] = json.loads(run(["check", self._path, "--format", "json"], (0, 1)))
        return found

    def diff(self, other: Robot) -> dict[str, Any]:
        """How another robot differs: parameters, terms, operations, torques."""
        found: dict[str, Any] = json.loads(run(["diff", self._path, other._path, "--format", "json"], (0, 1)))
        return found

    def document(self, path: str | os.PathLike[str], *, force: bool = False, **options: str) -> Path:
        """Writes a document, in the notation that the ending of the path says: .tex, .typ, .md or .html."""
        target = Path(path)
        notation = {".tex": "latex", ".typ": "typst", ".md": "markdown", ".html": "html"}.get(target.suffix)
        if notation is None:
            raise RobotError(f"{target}: the ending must be .tex, .typ, .md or .html; a PDF is made of one of the first two by LaTeX or Typst")
        more = [text for name, value in options.items() for text in (f"--{name.replace('_', '-')}", value)]
        run(["document", self._path, "--format", notation, "-o", str(target), *more, *(["--force"] if force else [])])
        return target

    def source(self, language: str = "rust") -> str:
        """Code of the robot's usual functions: rust, c, cpp, python and the command's other languages of one file."""
        if language == "rust":
            return run(["generate", self._path])
        with tempfile.TemporaryDirectory() as folder:
            run(["crate", self._path, "--language", language, "-o", os.path.join(folder, "code")])
            ending = {"c": ".h", "cpp": ".hpp", "cuda": ".cuh", "octave": ".m", "matlab": ".m", "javascript": ".js", "python": ".py"}.get(language, "")
            files = sorted(file for file in Path(folder).rglob(f"*{ending}") if file.is_file())
            return "\n".join(file.read_text() for file in files)

    def simulate(
        self,
        time: float = 10.0,
        *,
        q0: Any = None,
        qd0: Any = None,
        step: float = 0.01,
        torques: Mapping[str, str] | None = None,
        friction: bool = False,
        parameters: Mapping[str, float] | None = None,
    ) -> dict[str, Any]:
        """The motion from a state: arrays `t`, `q`, `qd`, `qdd`, `tau` and energies, a row for each time.

        `torques` has an expression over t, q1 …, qd1 … and parameters for each driven joint, by its number or name.
        """
        arguments = ["simulate", self._path, "--time", repr(float(time)), "--step", repr(float(step))]
        for option, value in (("--q0", q0), ("--qd0", qd0)):
            if value is not None:
                arguments.append(f"{option}={','.join(repr(float(entry)) for entry in np.ravel(value))}")
        for joint, expression in (torques or {}).items():
            arguments += ["--torque", f"{joint}={expression}"]
        for name, number in (parameters or {}).items():
            arguments.append(f"--set={name}={float(number)!r}")
        lines = run([*arguments, *(["--friction"] if friction else [])]).splitlines()
        head = next(index for index, line in enumerate(lines) if not line.startswith("#"))
        table = np.array([[float(entry) for entry in line.split(",")] for line in lines[head + 1 :]])
        found: dict[str, Any] = {}
        columns = lines[head].split(",")
        for kind in ("q", "qd", "qdd", "tau"):
            found[kind] = table[:, [index for index, name in enumerate(columns) if name.rstrip("0123456789") == kind]]
        rest = {name: table[:, index] for index, name in enumerate(columns) if name.rstrip("0123456789") not in found}
        return {**rest, **found}

    def identify(self, q: Any, qd: Any, qdd: Any, tau: Any, *, parameters: Mapping[str, float] | None = None) -> Identification:
        """The base parameters that explain joint torques best, by least squares over all rows."""
        regressor = self.regressor_base(q, qd, qdd, parameters=parameters)
        measured = np.asarray(tau, np.float64)
        if regressor.ndim != 3 or measured.shape != regressor.shape[:2]:
            raise RobotError(f"tau has the shape {measured.shape}; it must be (N, {self.degrees_of_freedom}) as the states are")
        matrix = regressor.reshape(-1, regressor.shape[2])
        if not (np.isfinite(matrix).all() and np.isfinite(measured).all()):
            raise RobotError("the states and torques must be finite")
        values, _, rank, singular = np.linalg.lstsq(matrix, measured.ravel(), rcond=None)
        residual = measured.ravel() - matrix @ values
        names = [entry["name"] for entry in self.base_parameters()["base"]]
        return Identification(names, values, int(rank), singular, float(np.sqrt(np.mean(residual**2))))

    def arrow(self, *names: str) -> Any:
        """A function from a record batch to a record batch: see `robots._arrow.BatchFunction`."""
        from ._arrow import BatchFunction

        return BatchFunction(self._path, names)

    def __repr__(self) -> str:
        return f"<robot {self.name}, {self.degrees_of_freedom} coordinates, {self._path}>"

    def _repr_html_(self) -> str:
        scheme = run(["scheme", self._path])
        rows = "".join(
            f"<tr><td>{html.escape(name)}</td><td>{'' if value is None else f'{value:g}'}</td></tr>" for name, value in self.parameters.items()
        )
        head = f"<b>{html.escape(self.name)}</b>, {self.degrees_of_freedom} coordinates"
        return f"<div>{head}{scheme}<table><tr><th>parameter</th><th>value</th></tr>{rows}</table></div>"


class Identification:
    """Base parameters that were identified."""

    def __init__(self, names: list[str], values: Any, rank: int, singular_values: Any, residual: float) -> None:
        self.names = names
        self.values = values
        self.rank = rank
        self.singular_values = singular_values
        self.residual = residual
        """The root of the mean square of what is left of the torques."""

    @property
    def condition(self) -> float:
        """The largest singular value of the regressor by the smallest."""
        smallest = self.singular_values[-1]
        return float(self.singular_values[0] / smallest) if smallest else float("inf")

    def as_dict(self) -> dict[str, float]:
        """Values by name."""
        return dict(zip(self.names, map(float, self.values)))
