"""Rewrites an SVG by Typst in fewer bytes, without a visible change."""

import re

# Attributes with their initial values.
INITIAL = re.compile(
    r' (?:x="0"|y="0"|fill="#000000"|fill-rule="nonzero"|stroke-linecap="butt"|stroke-linejoin="miter"'
    r'|stroke-miterlimit="4"|stroke-dashoffset="0"|xmlns:xlink="[^"]*"|xmlns:h5="[^"]*"|overflow="visible")'
)
NUMBER = re.compile(r"-?\d+\.\d{4,}")


def path(found):
    """Returns the data of a path without unnecessary characters."""
    data = re.sub(r"^M 0 0m ", "M", found[1])
    data = re.sub(r" ?([a-zA-Z]) ?", r"\1", data)
    data = re.sub(r"(?<![\d.])(-?)0\.(?=\d)", r"\1.", data)
    data = re.sub(r" (?=-)", "", data)
    return f' d="{data.strip()}"'


def smaller(svg):
    names = {}
    for name in re.findall(r'id="(g[0-9A-F]+)"', svg):
        names[name] = f"g{len(names):x}"
    svg = re.sub(r'(id="|href="#)(g[0-9A-F]+)"', lambda found: f'{found[1]}{names[found[2]]}"', svg)
    symbols = re.sub(r"<symbol id=(\"\w+\")[^>]*><path ([^>]*)/></symbol>", r"<path id=\1 \2/>", svg)
    svg = INITIAL.sub("", symbols).replace("xlink:href", "href")
    svg = NUMBER.sub(lambda found: f"{float(found[0]):.3f}".rstrip("0").rstrip("."), svg)
    return re.sub(r' d="([^"]*)"', path, svg)
