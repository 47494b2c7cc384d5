"""Makes the pictures of the README and the book: make.py COMMAND [--check].

Typst draws them, with letters as outlines, so that they need no font. The metadata of each picture list its sources
and their checksums; a test of the command compares the checksums.
"""

import hashlib
import re
import subprocess
import sys
from pathlib import Path

import typst

import chart
from smaller import smaller

FOLDER = Path(__file__).parent
PAGE = '#set page(width: auto, height: auto, margin: {margin}, fill: {fill})\n#set text(font: "New Computer Modern", size: 10pt)\n'
# White in light and in dark pages.
CARD = 'box(fill: white, stroke: 0.6pt + rgb("#d0d7de"), radius: 5pt, inset: {inset})'


class Pictures:
    """The pictures by name, and the sources of the picture that is being made."""

    def __init__(self, command):
        self.command, self.sources, self.made = command, [], {}

    def printed(self, arguments):
        """Returns the output of the command, which becomes a source of the next picture."""
        run = subprocess.run([self.command, *arguments.split()], capture_output=True, text=True, check=True)
        self.is_from(f"robot-symbolic {arguments}", run.stdout)
        return run.stdout

    def is_from(self, name, text):
        self.sources.append((name, hashlib.sha256(text.encode()).hexdigest()))

    def add(self, name, body, title, fill="none", margin="0pt"):
        source = PAGE.format(fill=fill, margin=margin) + body
        self.add_all([name], typst.compile(source.encode(), format="svg"), title)

    def add_all(self, names, drawings, title):
        drawings = drawings if isinstance(drawings, list) else [drawings]
        assert len(names) <= len(drawings), names
        made = "".join(f"{name} sha256 {total}\n" for name, total in self.sources)
        head = f"<title>{title}</title><metadata>\n{made}</metadata>"
        for name, drawing in zip(names, drawings):
            self.made[name] = re.sub(r"(<svg[^>]*>)", rf"\1{head}", smaller(drawing.decode()), count=1) + "\n"
        self.sources = []


def scheme(document):
    """Returns the drawing of the robot in a document, and the function that its labels need."""
    label, box = re.search(r"(#let label\(.*?)\n(#box\(width.*?\n\])\n", document, re.S).groups()
    return f"{label}\n#let scheme = {box[1:]}\n"


def equations(printed, *titles):
    """Returns the equations of the groups with these titles; without titles, all equations."""
    groups = dict(re.findall(r"^// ([^\n]*)\n#\[\n(.*?)\n\]$", printed, re.S | re.M)) if titles else {"": printed}
    found = []
    for title in titles or [""]:
        found += re.findall(r"^\$ (.*?) \$$", groups.get(title, ""), re.S | re.M)
    return found


def aligned(found):
    return "#set math.equation(numbering: none)\n#show math.equation: set text(font: \"New Computer Modern Math\")\n$ " + " \\\n ".join(found) + " $"


def card(inside, inset="10pt"):
    return f"#{CARD.format(inset=inset)}[\n{inside}\n]"


def beside(drawing, text, width, height):
    """Returns a robot, at most of this width and height, beside its equations."""
    scaled = f"#context {{ let size = measure(scheme); let by = calc.min({width} / size.width, {height} / size.height) * 100%; scale(x: by, y: by, reflow: true, scheme) }}"
    return drawing + card(f"#grid(columns: 2, column-gutter: 14pt, align: horizon, [{scaled}], [{text}])")


def readme(pictures):
    file = "robots/trttr1.toml"
    drawing = scheme(pictures.printed(f"document {file} --format typst"))
    found = equations(pictures.printed(f"equations {file} --form collected --quantity Q --format typst --width 11.4cm"))
    # The first equation is left out because it is as long as the others together.
    body = beside(drawing, "#set text(size: 11.5pt)\n" + aligned(found[1:]), "190pt", "270pt")
    pictures.add("readme", body, "The robot TRTTR1 and four of its equations of motion")


GALLERY = {
    "planar_2r": ["Mass matrix", "Gravity"],
    "planar_3r": ["Mass matrix", "Gravity"],
    "scara": ["Mass matrix", "Gravity"],
    "trttr1": ["Mass matrix", "Gravity"],
    "ur5": ["Gravity"],
    "puma560": ["Gravity"],
}


def gallery(pictures):
    for name, titles in GALLERY.items():
        drawing = scheme(pictures.printed(f"document robots/{name}.toml --format typst --form recursive"))
        found = equations(pictures.printed(f"equations robots/{name}.toml --form grouped --format typst --width 12cm"), *titles)
        assert found, name
        words = " and ".join(title.lower() for title in titles)
        pictures.add(f"gallery-{name}", beside(drawing, aligned(found), "230pt", "230pt"), f"{name}: {words}")


def forms(pictures):
    file = "robots/trttr1.toml"
    found = equations(pictures.printed(f"equations {file} --style paper --format typst --width 15cm"))
    # A relation and a column each, of link 4's acceleration, link 4's force, and the force in joint 5.
    chosen = [found[place] for place in (6, 7, 16, 17, 30, 31)]
    pictures.add("gallery-paper", card(aligned(chosen)), "Equations of TRTTR1 in the style of the paper")
    found = equations(pictures.printed(f"equations {file} --form compact --letters field --format typst --width 14cm"),
                      "Expressions of the state", "Equations of motion, compact")
    pictures.add("gallery-compact", card(aligned(found)), "TRTTR1: compact equations")


def schemes(pictures):
    drawing = scheme(pictures.printed("document robots/ur5.toml --format typst --form recursive"))
    pictures.add("scheme-ur5", drawing + card("#scheme"), "The kinematic scheme of the UR5")


def author(pictures):
    document = pictures.printed("document robots/trttr1.toml --form grouped --trig paper --format typst")
    pictures.add_all(["author-1", "author-2"], typst.compile(document.encode(), format="svg"), "A page of the document about TRTTR1")


def speed(pictures):
    page = (FOLDER.parent / "performance.md").read_text()
    tables = "".join(line + "\n" for line in page.splitlines() if line.startswith("|"))
    pictures.is_from("docs/performance.md", tables)
    pictures.add("speed", card(chart.drawn(page), "12pt"), "Speed-up over Pinocchio and CasADi, and operations")


def main():
    pictures = Pictures(sys.argv[1])
    for make in (readme, gallery, forms, schemes, author, speed):
        make(pictures)
    stale = []
    for name, drawing in pictures.made.items():
        path = FOLDER / f"{name}.svg"
        if not path.exists() or path.read_text() != drawing:
            stale.append(path.name)
            if "--check" not in sys.argv:
                path.write_text(drawing)
    unknown = {path.stem for path in FOLDER.glob("*.svg")} - set(pictures.made)
    if "--check" in sys.argv and (stale or unknown):
        sys.exit(f"not as docs/pictures/make makes them: {' '.join([*stale, *sorted(unknown)])}")
    print(f"{len(pictures.made)} pictures, {sum(map(len, pictures.made.values())) // 1000} kB")


if __name__ == "__main__":
    main()
