"""Compiles each Typst file of a folder: no error, no warning, no ink in the right margin."""

import re
import struct
import sys
import zlib
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import typst

# Points outside of the text block that letters may reach into, and pixels per inch.
TOLERANCE, PPI = 1.5, 20


def rows(png):
    """The rows of a PNG of 8 bits and 4 channels, as bytes."""
    place, data, size = 8, b"", None
    while place < len(png):
        length, kind = struct.unpack(">I4s", png[place : place + 8])
        body = png[place + 8 : place + 8 + length]
        if kind == b"IHDR":
            size = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            data += body
        place += length + 12
    width, height, depth, color = size[:4]
    assert (depth, color) == (8, 6), "another kind of PNG"
    data, stride, before = zlib.decompress(data), 4 * width, bytearray(4 * width)
    for row in range(height):
        start = row * (stride + 1)
        kind, line = data[start], bytearray(data[start + 1 : start + 1 + stride])
        for i in range(stride):
            left = line[i - 4] if i >= 4 else 0
            up, corner = before[i], before[i - 4] if i >= 4 else 0
            if kind == 1:
                line[i] = (line[i] + left) & 255
            elif kind == 2:
                line[i] = (line[i] + up) & 255
            elif kind == 3:
                line[i] = (line[i] + (left + up) // 2) & 255
            elif kind == 4:
                p = left + up - corner
                a, b, c = abs(p - left), abs(p - up), abs(p - corner)
                line[i] = (line[i] + (left if a <= b and a <= c else up if b <= c else corner)) & 255
        before = line
        yield line


def check(path):
    source = path.read_text()
    pdf, warnings = typst.Compiler(str(path), root=str(path.parent)).compile_with_warnings()
    path.with_suffix(".pdf").write_bytes(pdf)
    faults = [str(warning) for warning in warnings]
    width, margin = (float(found) for found in re.search(r"width: ([\d.]+)cm.*?x: ([\d.]+)cm", source).groups())
    pages = typst.compile(str(path), root=str(path.parent), format="png", ppi=PPI)
    pages = pages if isinstance(pages, list) else [pages]
    edge = int((width - margin) / 2.54 * PPI + TOLERANCE * PPI / 72) + 1
    for number, page in enumerate(pages, 1):
        if any(min(line[4 * edge :], default=255) < 250 for line in rows(page)):
            faults.append(f"page {number} has ink right of the text")
    return [f"{path.name}: {fault}" for fault in faults]


def checked(path):
    try:
        return check(path)
    except typst.TypstError as error:
        return [f"{path.name}: {error}"]


if __name__ == "__main__":
    files = sorted(Path(sys.argv[1]).glob("*.typ"))
    with ProcessPoolExecutor() as pool:
        faults = [fault for found in pool.map(checked, files) for fault in found]
    print("\n".join(faults) or f"{len(files)} Typst documents compile, nothing is in the right margin")
    sys.exit(1 if faults else 0)
