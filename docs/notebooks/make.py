"""Runs the notebooks and writes their pages: `make.py [--check]`, called by docs/notebooks/make.

A notebook is a Python file in jupytext's percent format, NAME.py. Its page NAME.md contains the cells and their outputs, and its pictures are
stored beside it as NAME-1.svg and so on. With `--check` nothing is written, and a page that is out of date is an error. Numbers in pictures may
differ a little, because those of a solver differ between processors.
"""

import base64
import re
import shutil
import sys
import tempfile
from pathlib import Path

import jupytext
import nbformat
from nbclient import NotebookClient

HERE = Path(__file__).resolve().parent
ROBOTS = HERE.parents[1] / "robots"
# Pictures contain no dates and no random names, and their letters are text.
SETUP = """
import matplotlib
from matplotlib_inline.backend_inline import set_matplotlib_formats
set_matplotlib_formats("svg", metadata={"Date": None})
matplotlib.rcParams.update({
    "svg.hashsalt": "robots", "svg.fonttype": "none", "figure.constrained_layout.use": True,
    "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False, "savefig.facecolor": "white",
})
"""
DISPLAY = re.compile(r"(?:^% ([^\n]*)\n)?(\\begin\{(align\*?)\}.*?\\end\{\3\})", re.DOTALL | re.MULTILINE)
SCHEME = re.compile(r'src="data:image/svg\+xml;base64,([^"]*)"')
NUMBER = re.compile(r"-?\d+\.?\d*(?:e-?\d+)?")


class Page:
    """The page of a notebook: its text in parts, and its pictures by the names of their files."""

    def __init__(self, name):
        self.name, self.parts, self.pictures = name, [], {}

    def add(self, text):
        self.parts.append(text.strip("\n"))

    def text(self, kind, text):
        self.add(f"```{kind}\n{text.strip(chr(10)).rstrip()}\n```")

    def picture(self, svg):
        """Stores a picture and returns the name of its file."""
        file = f"{self.name}-{len(self.pictures) + 1}.svg"
        self.pictures[file] = "\n".join(line.rstrip() for line in svg.strip().splitlines()) + "\n"
        return file

    def latex(self, latex):
        """Adds formulas, one by one, below their headings."""
        displays = DISPLAY.findall(latex)
        for heading, display, _ in displays:
            if heading:
                self.add(f"*{heading}*")
            self.text("math", display)
        if not displays:
            self.text("math", latex.strip().strip("$").removeprefix(r"\displaystyle").strip())

    def output(self, output):
        """Adds an output of a cell, in the richest form that the book supports."""
        if output.output_type == "stream":
            self.text("text", output.text)
            return
        data = output.data
        if "image/svg+xml" in data:
            self.add(f"![plot]({self.picture(data['image/svg+xml'])})")
        elif "text/latex" in data:
            self.latex(data["text/latex"])
        elif "text/html" in data:
            self.add(SCHEME.sub(lambda found: f'src="{self.picture(base64.b64decode(found[1]).decode())}"', data["text/html"]))
        elif "<matplotlib" not in data["text/plain"]:
            self.text("text", data["text/plain"])


def joined(outputs):
    """Returns the outputs with consecutive texts joined, because a kernel splits a printed text in an arbitrary way."""
    found = []
    for output in outputs:
        if found and output.output_type == "stream" == found[-1].output_type:
            found[-1].text += output.text
        else:
            found.append(output)
    return found


def made(source):
    """Runs a notebook in a folder with the robots and returns its page; a cell that fails is an error."""
    notebook = jupytext.read(source)
    notebook.cells.insert(0, nbformat.v4.new_code_cell(SETUP))
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(ROBOTS, Path(folder) / "robots")
        NotebookClient(notebook, timeout=900, kernel_name="python3", resources={"metadata": {"path": folder}}).execute()
    page = Page(source.stem)
    for cell in notebook.cells[1:]:
        if cell.cell_type == "markdown":
            page.add(cell.source)
            continue
        page.text("python", cell.source)
        for output in joined(cell.outputs):
            page.output(output)
    page.parts.insert(1, f"*The notebook [{source.name}]({source.name}), run with the package: see [Python](../users/python.md).*")
    return page


def same(shown, found):
    """Returns whether two pictures differ at most in the last digits of their numbers."""
    if NUMBER.sub("", shown) != NUMBER.sub("", found):
        return False
    pairs = zip(NUMBER.findall(shown), NUMBER.findall(found))
    return all(abs(float(one) - float(other)) <= 0.01 for one, other in pairs)


def main():
    stale = []
    for source in sorted(HERE.glob("*.py")):
        if source.name == "make.py":
            continue
        page = made(source)
        files = {f"{page.name}.md": "\n\n".join(page.parts) + "\n", **page.pictures}
        known = {file.name for file in HERE.glob(f"{page.name}-*.svg")}
        if "--check" not in sys.argv[1:]:
            for file in known - files.keys():
                (HERE / file).unlink()
            for file, text in files.items():
                (HERE / file).write_text(text)
            continue
        stale += sorted(known - files.keys())
        for file, text in files.items():
            shown = (HERE / file).read_text() if (HERE / file).exists() else ""
            if shown != text and not (file.endswith(".svg") and same(shown, text)):
                stale.append(file)
                (Path(tempfile.gettempdir()) / file).write_text(text)
    if stale:
        sys.exit(f"not as made by docs/notebooks/make: {', '.join(stale)}; what was made lies in {tempfile.gettempdir()}")


if __name__ == "__main__":
    main()
