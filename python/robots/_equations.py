"""Equations of motion for notebooks and other programs."""

from __future__ import annotations

import json
import re
from typing import Any

from ._command import run


class Equations:
    """The equations of a robot in one form; each notation is printed when it is first needed.

    A notebook shows them as formulas.

    >>> equations = robots.load("planar_2r.toml").equations(form="collected")
    >>> equations.formulas["Q2"]
    'm2*r2*(g*cos(q1 + q2) + l1*sin(q2)*qd1^2 + l1*cos(q2)*qdd1) + (m2*r2^2 + I2)*(qdd1 + qdd2) + Fy*l2 + Mz'
    """

    def __init__(self, arguments: list[str]) -> None:
        self._arguments = arguments
        self._made: dict[str, str] = {}

    def _as(self, notation: str) -> str:
        if notation not in self._made:
            self._made[notation] = run([*self._arguments, "--format", notation])
        return self._made[notation]

    @property
    def text(self) -> str:
        """Infix text."""
        return self._as("text")

    @property
    def latex(self) -> str:
        """LaTeX, for the package amsmath."""
        return self._as("latex")

    @property
    def typst(self) -> str:
        """Typst."""
        return self._as("typst")

    @property
    def definitions(self) -> dict[str, str]:
        """The named expressions of the form, such as the entries of the mass matrix, as infix text; each can contain earlier ones."""
        found: dict[str, str] = json.loads(self._as("json")).get("definitions", {})
        return found

    @property
    def formulas(self) -> dict[str, str]:
        """The quantities, usually the joint torques Q1, Q2, …, as infix text by name: exact, and readable by other programs."""
        quantities: dict[str, str] = json.loads(self._as("json"))["quantities"]
        # A form can define a joint torque by a later one. Here the torques are in the order of the joints.
        numbers = {name: re.fullmatch(r"(\D+)(\d+)", name) for name in quantities}
        order = {name: int(found[2]) for name, found in numbers.items() if found}
        stems = {found and found[1] for found in numbers.values()}
        return dict(sorted(quantities.items(), key=lambda item: order[item[0]])) if len(stems) == 1 and order else quantities

    @property
    def expressions(self) -> dict[str, Any]:
        """`definitions` and `formulas` as SymPy expressions in symbols with the printed names."""
        return {name: _sympy(text, {}) for name, text in {**self.definitions, **self.formulas}.items()}

    @property
    def sympy(self) -> Any:
        """The entries of `formulas` as a column of SymPy expressions, with the form's named expressions substituted.

        >>> torques = robots.load("planar_2r.toml").equations().sympy
        >>> torques.shape
        (2, 1)
        >>> torques[1].coeff("qdd2")
        I2 + m2*r2**2
        """
        import sympy

        known: dict[str, Any] = {}
        for name, text in {**self.definitions, **json.loads(self._as("json"))["quantities"]}.items():
            known[name] = _sympy(text, known)
        return sympy.Matrix([known[name] for name in self.formulas])

    def __repr__(self) -> str:
        return self.text

    def _repr_latex_(self) -> str:
        return self.latex

    def _repr_html_(self) -> str:
        page = self._as("mathml")
        start, end = page.find("<body"), page.rfind("</body>")
        return page[page.index(">", start) + 1 : end] if start >= 0 else page


# A name, such as `q1`, or an entry of a vector, `F1.x`.
_NAME = re.compile(r"[^\W\d]\w*(?:\.[^\W\d]\w*)?")
_FUNCTIONS = {"sin", "cos", "tan", "sqrt", "exp", "tanh", "sign", "abs", "pi"}


def _sympy(text: str, defined: dict[str, Any]) -> Any:
    """Returns infix text as an expression with exact decimals. While SymPy reads the text, symbols have other names, so that no name has
    another meaning (`I`, `E`, `lambda`)."""
    import sympy
    from sympy.parsing.sympy_parser import parse_expr, rationalize, standard_transformations

    known: dict[str, Any] = {name: getattr(sympy, name) for name in _FUNCTIONS - {"abs"}}
    known["abs"] = sympy.Abs
    stands: dict[str, str] = {}

    def safe(found: re.Match[str]) -> str:
        name = found.group()
        if name in known:
            return name
        stand = stands.setdefault(name, f"symbol_{len(stands)}")
        known[stand] = defined[name] if name in defined else sympy.Symbol(name)
        return stand

    # A name begins after a character that is neither a letter nor a digit, so the exponent of a decimal, 1e-3, is not a name.
    safe_text = re.sub(r"(?<![\w.])" + _NAME.pattern, safe, text).replace("^", "**")
    return parse_expr(safe_text, local_dict=known, transformations=(*standard_transformations, rationalize))
