"""Typesets documents as PDF, with Typst or LaTeX, whichever is installed."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path

from ._native import RobotError

# The notation of a document, and the function that typesets it.
Typesetter = tuple[str, Callable[[Path, Path], None]]


def typesetter(by: str | None) -> Typesetter:
    """Returns the first typesetter that is installed: the package `typst`, the program `typst`, or `pdflatex`; `by`, "typst" or "latex", allows only that one."""
    if by not in (None, "typst", "latex"):
        raise RobotError(f'by must be "typst" or "latex", not {by!r}')
    if by != "latex":
        if importlib.util.find_spec("typst") is not None:
            return "typst", _by_typst_package
        if shutil.which("typst") is not None:
            return "typst", _by_typst_program
    if by != "typst" and shutil.which("pdflatex") is not None:
        return "latex", _by_pdflatex
    wanted = {"typst": "Typst, which is", "latex": "LaTeX, which is"}.get(by or "", "Typst or LaTeX, neither of which is")
    remedy = "install `pdflatex`" if by == "latex" else "`pip install typst` is enough"
    raise RobotError(f"a PDF needs {wanted} installed: {remedy}; a document with the extension .tex, .typ, .md or .html needs nothing")


def _by_typst_package(source: Path, target: Path) -> None:
    import typst

    try:
        typst.compile(str(source), output=str(target))
    except RuntimeError as error:
        raise RobotError(f"Typst failed: {error}") from None


def _by_typst_program(source: Path, target: Path) -> None:
    _run(["typst", "compile", str(source), str(target)], source.parent)


def _by_pdflatex(source: Path, target: Path) -> None:
    # References need a second run. The variables keep the document from reading or writing files outside of the folder.
    arguments = ["pdflatex", "-no-shell-escape", "-interaction=nonstopmode", "-halt-on-error", source.name]
    for _ in range(2):
        _run(arguments, source.parent, openin_any="p", openout_any="p")
    shutil.move(source.with_suffix(".pdf"), target)


def _run(arguments: list[str], folder: Path, **variables: str) -> None:
    done = subprocess.run(arguments, cwd=folder, env={**os.environ, **variables}, capture_output=True, text=True, errors="replace", check=False)
    if done.returncode != 0:
        said = (done.stderr or done.stdout).strip().splitlines()[-12:]
        raise RobotError("\n".join([f"{arguments[0]} failed:", *said]))


def _replace(made: Path, target: Path) -> None:
    # A copy to another file system can end in the middle, for example on a full disk; a rename cannot.
    beside = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        shutil.copyfile(made, beside)
        os.replace(beside, target)
    finally:
        beside.unlink(missing_ok=True)


def typeset(write: Callable[[str, Path], None], target: Path, by: str | None) -> None:
    """Writes a PDF; `write` writes its source in a notation."""
    notation, run = typesetter(by)
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / ("document.typ" if notation == "typst" else "document.tex")
        write(notation, source)
        made = Path(folder) / "made.pdf"
        run(source, made)
        _replace(made, target)
