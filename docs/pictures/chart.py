"""Makes the bar chart of the README from the tables of docs/performance.md."""

NAMES = {
    "inverse_dynamics": "inverse dynamics",
    "mass_matrix": "mass matrix",
    "forward_dynamics": "forward dynamics",
    "inverse_dynamics_derivatives": "∂(inverse dynamics)",
    "forward_dynamics_derivatives": "∂(forward dynamics)",
    "regressor": "regressor",
}
# The length of a speed-up of 1 in points, and the colors of the other programs.
UNIT, PINOCCHIO, CASADI = 13.5, "#0b57a4", "#a84300"


def table(page, first):
    """Returns the rows of the table whose header begins with these cells, by their first cell."""
    lines = iter(page.splitlines())
    for line in lines:
        if line.startswith(first):
            next(lines)
            break
    else:
        raise ValueError(f"docs/performance.md has no table {first}")
    rows = {}
    for line in lines:
        if not line.startswith("|"):
            break
        name, *cells = (cell.strip() for cell in line.strip("|").split("|"))
        rows[name] = cells
    return rows


def bar(value, color):
    width = float(value) * UNIT
    return (
        f'#stack(dir: ltr, spacing: 3pt, rect(width: {width:.1f}pt, height: 7pt, fill: rgb("{color}")), '
        f'box(height: 7pt, align(horizon, text(size: 8pt)[{float(value):.1f}×])))'
    )


def drawn(page):
    speed = table(page, "| function | standard sine, Pinocchio |")
    rows = []
    for key, words in NAMES.items():
        pinocchio, casadi = speed[key][2:4]
        bars = f"#stack(spacing: 2pt, [{bar(pinocchio, PINOCCHIO)}], [{bar(casadi, CASADI)}])"
        rows.append(f"[{words}], [{bars}]")
    numbers = table(page, "| robot, numbers built in |")
    symbols = table(page, "| | M | A | M + A | OpenSYMORO")
    operations = [f"[{name}], [{cells[2]}], [{cells[3]}]" for name, cells in symbols.items()]
    plain = speed["inverse_dynamics"]
    ours = ", ".join(f"{name} {numbers[name][2]}" for name in ("ur5", "puma560", "iiwa", "panda"))
    square = lambda color: f'#box(width: 7pt, height: 7pt, fill: rgb("{color}"))'
    return f"""#set text(size: 9pt)
#show table.cell.where(y: 0): strong
#grid(columns: (auto, auto), column-gutter: 22pt,
[*Calls per second, times those of* {square(PINOCCHIO)} Pinocchio #h(4pt) {square(CASADI)} CasADi
#grid(columns: 2, column-gutter: 8pt, row-gutter: 6pt, align: (right + horizon, left + horizon), {", ".join(rows)})],
[*Multiplications and additions of inverse dynamics*
#table(columns: 3, stroke: none, inset: (x: 4pt, y: 2.6pt), align: (left, right, right), table.hline(stroke: 0.4pt), [all parameters symbols], [here], [OpenSYMORO], table.hline(stroke: 0.4pt), {", ".join(operations)}, table.hline(stroke: 0.4pt))
#text(size: 8pt)[Modified Denavit–Hartenberg arms. With numbers:\\ {ours}.]
#v(4pt)
#text(size: 8pt)[Speed: geometric mean of puma560, ur5, iiwa and panda, single calls\\ with the runtime's sine, all compiled for the machine at hand; inverse\\ dynamics with the standard library's sine: {plain[0]}× and {plain[1]}×.]])"""
