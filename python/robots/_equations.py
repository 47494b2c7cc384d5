"""Equations of motion for notebooks and other programs."""

from __future__ import annotations

import json
import re
from typing import Any

from ._command import run


class Equations:
    """The equations of a robot in one form; each notation is made when it is asked for."""

    def __init__(self, arguments: list[str]) -> None:
        self._arguments = arguments

    def _as(self, notation: str) -> str:
        return run([*self._arguments, "--format", notation])

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
    def formulas(self) -> dict[str, str]:
        """The joint torques as infix text, by name: exact, and readable by other programs."""
        quantities: dict[str, str] = json.loads(self._as("json"))["quantities"]
        return quantities

    @property
    def sympy(self) -> Any:
        """A column of SymPy expressions over symbols of the names in `formulas`."""
        import sympy

        return sympy.Matrix([_sympy(text) for text in self.formulas.values()])

    def __repr__(self) -> str:
        return self.text

    def _repr_latex_(self) -> str:
        return self.latex

    def _repr_html_(self) -> str:
        page = self._as("mathml")
        start, end = page.find("<body"), page.rfind("</body>")
        return page[page.index(">", start) + 1 : end] if start >= 0 else page


_NAME = re.compile(r"[^\W\d]\w*")
_FUNCTIONS = {"sin", "cos", "tan", "sqrt", "exp", "tanh", "sign", "abs", "pi"}


def _sympy(text: str) -> Any:
    """Infix text as an expression; decimals stay exact. Symbols stand under names of our own while the text is read, so that no name has
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
        known[stand] = sympy.Symbol(name)
        return stand

    # The exponent of a decimal, 1e-3, is no name: a name begins after what is neither a letter nor a digit.
    safe_text = re.sub(r"(?<![\w.])" + _NAME.pattern, safe, text).replace("^", "**")
    return parse_expr(safe_text, local_dict=known, transformations=(*standard_transformations, rationalize))
