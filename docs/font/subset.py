"""The subset of a math font that equations need: FONT FOLDER [--check]. Same input, same bytes."""

import io
import sys
from pathlib import Path

from fontTools import subset
from fontTools.ttLib import TTFont

# A font that was changed does not go by the name of the original.
NAME = "Robot Equations Math"


def characters(text):
    """The code points of a list of ranges."""
    found = set()
    for line in text.splitlines():
        if line.startswith("#"):
            continue
        first, _, last = line.split()[0].partition("-")
        found.update(range(int(first, 16), int(last or first, 16) + 1))
    return found


def renamed(font):
    """The font under its own name; copyright, license and version of the original stay."""
    names = {1: NAME, 3: NAME, 4: NAME, 6: NAME.replace(" ", ""), 16: NAME}
    for record in font["name"].names:
        if record.nameID in names:
            record.string = names[record.nameID]
    return font


def made(path, wanted):
    font = TTFont(path, recalcTimestamp=False)
    missing = wanted - set(font.getBestCmap())
    if missing:
        sys.exit("the font lacks " + " ".join(f"{code:04x}" for code in sorted(missing)))
    options = subset.Options(hinting=False, glyph_names=False, notdef_outline=True)
    # Smaller shapes of indices, and where marks belong on letters.
    options.layout_features = ["ssty", "mark", "mkmk", "ccmp"]
    options.name_IDs = [0, 1, 2, 3, 4, 5, 6, 13, 14]
    task = subset.Subsetter(options)
    task.populate(unicodes=wanted)
    task.subset(font)
    font.flavor = "woff2"
    data = io.BytesIO()
    renamed(font).save(data)
    return data.getvalue()


if __name__ == "__main__":
    folder = Path(sys.argv[2])
    data = made(sys.argv[1], characters((folder / "characters.txt").read_text()))
    if "--check" not in sys.argv:
        (folder / "math.woff2").write_bytes(data)
    elif (folder / "math.woff2").read_bytes() != data:
        sys.exit("math.woff2 is not what docs/font/make makes of characters.txt")
    print(f"the font of equations: {len(data)} bytes")
