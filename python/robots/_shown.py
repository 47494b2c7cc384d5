"""Robots and equations as parts of a page."""

from __future__ import annotations

import base64
import html
from collections.abc import Sequence


def picture(svg: str, described: str) -> str:
    """Returns a picture as an image element, so that its styles and names do not affect the page."""
    data = base64.b64encode(svg.encode()).decode()
    return f'<img alt="{html.escape(described)}" src="data:image/svg+xml;base64,{data}">'


def table(rows: Sequence[Sequence[str]]) -> str:
    """Returns a table whose first row is its title, without columns that are empty below the title; an empty text if there are no rows."""
    kept = [column for column in range(len(rows[0])) if any(row[column] for row in rows[1:])]
    lines = []
    for index, row in enumerate(rows):
        kind = "td" if index else "th"
        cells = "".join(f'<{kind} style="text-align: left">{html.escape(row[column])}</{kind}>' for column in kept)
        lines.append(f"<tr>{cells}</tr>")
    return f"<table>{''.join(lines)}</table>" if len(rows) > 1 else ""


def block(title: str, remark: str | None, parts: Sequence[str]) -> str:
    """Returns a title, a remark and parts, one below the other."""
    said = f"<p>{html.escape(remark)}</p>" if remark else ""
    return f"<div><p><b>{html.escape(title)}</b></p>{said}{''.join(parts)}</div>"
