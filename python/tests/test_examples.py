"""What the documentation shows: the examples of docstrings, of the README and of the book's page."""

import doctest
import importlib
import pkgutil
import re
import shutil
import sys
import subprocess
from pathlib import Path

import numpy as np
import pytest

import robots

ROOT = Path(__file__).resolve().parents[2]
FILES = ROOT / "robots"


def failures(examples, name, names):
    """Runs examples one after the other; how many there are, and what is wrong with them."""
    test = doctest.DocTest(examples, {}, name, None, None, None)
    test.globs = names  # Not a copy: the next block of a page goes on with them.
    said = []
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    runner.run(test, out=said.append, clear_globs=False)
    return len(examples), "".join(said)


def test_docstrings(monkeypatch):
    pytest.importorskip("sympy")
    pytest.importorskip("pyarrow")
    monkeypatch.chdir(FILES)
    count = 0
    for found in pkgutil.iter_modules(robots.__path__):
        if found.name in ("__main__", "_native"):
            continue
        module = importlib.import_module(f"robots.{found.name}")
        for test in doctest.DocTestFinder().find(module, extraglobs={"robots": robots, "np": np}):
            ran, wrong = failures(test.examples, test.name, test.globs)
            count += ran
            assert not wrong, wrong
    assert count >= 20, count


@pytest.mark.parametrize("page", ["python/README.md", "docs/users/python.md"])
def test_pages(page, tmp_path, monkeypatch):
    """Blocks of Python are run in their order, those of `sh` that begin with `python -m robots` too, in a folder with the robots."""
    pytest.importorskip("sympy")
    pytest.importorskip("polars")
    monkeypatch.chdir(tmp_path)
    shutil.copytree(FILES, tmp_path / "robots")
    text, names, count = (ROOT / page).read_text(), {}, 0
    for language, block in re.findall(r"```(\w+)[^\n]*\n(.*?)```", text, re.DOTALL):
        if language == "sh":
            for line in block.splitlines():
                if line.startswith("python -m robots "):
                    subprocess.run([sys.executable, *line.split()[1:]], check=True, capture_output=True)
        elif language == "python":
            examples = doctest.DocTestParser().get_examples(block)
            assert examples, block
            ran, wrong = failures(examples, page, names)
            count += ran
            assert not wrong, wrong
    assert count >= 5, count
