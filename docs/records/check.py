"""Counts and runs the programs of inverse dynamics beside this file:   python3 docs/records/check.py [FOLDER]

It does not use this project's code. For each NAME.program it counts multiplications, additions, sines and cosines, and computes
the joint torques at the states of NAME.states, whose torques come from a numeric solver. It fails if a torque differs by more
than 1e-13 of the largest.
"""

import math
import pathlib
import re
import sys

ASSIGNMENT = re.compile(r"(v\d+) = (.+?)(  ; constant)?$")


def section(lines, head):
    """Returns the lines below `head:`, to the next empty line."""
    if f"{head}:" not in lines:
        return []
    below = lines[lines.index(f"{head}:") + 1:]
    return below[:below.index("")]


def run(lines, loads, count):
    """Computes the results of a section from the arrays that it loads from, and counts its operations."""
    values, constants = {}, {}
    for line in lines:
        if line.startswith("results: "):
            return [values[name] for name in line.removeprefix("results: ").split(", ")]
        name, text, constant = ASSIGNMENT.fullmatch(line).groups()
        words = text.split(" ")
        load = re.fullmatch(r"(\w+)\[(\d+)\]", text)
        if load:
            values[name] = loads[load[1]][int(load[2])]
            kind = {"sin": "sin", "cos": "cos"}.get(load[1])
        elif len(words) == 3:
            a, b = values[words[0]], values[words[2]]
            values[name] = {"+": a + b, "-": a - b, "*": a * b}[words[1]]
            # 2 a is a + a.
            twice = words[1] == "*" and 2.0 in (constants.get(words[0]), constants.get(words[2]))
            kind = None if constant else "add" if twice else {"+": "add", "-": "add", "*": "mul"}[words[1]]
        elif text.startswith("-v"):
            values[name], kind = -values[text[1:]], None
        else:
            values[name], kind = float(text), None
            constants[name] = values[name]
        if kind:
            count[kind] = count.get(kind, 0) + 1
    raise ValueError("a section without results")


def check(path):
    lines = path.read_text().splitlines()
    states = [line.split() for line in path.with_suffix(".states").read_text().splitlines()]
    states = [(words[0], [float(word) for word in words[1:]]) for words in states]
    worst = largest = 0.0
    for first in range(0, len(states), 4):
        state = dict(states[first:first + 4])
        inputs = state["q"] + state["qd"] + state["qdd"]
        count = {}
        angles = run(section(lines, "angles"), {"input": inputs}, count)
        loads = {"input": inputs, "sin": [math.sin(a) for a in angles], "cos": [math.cos(a) for a in angles]}
        torques = run(section(lines, "core"), loads, count)
        largest = max(largest, *map(abs, state["tau"]))
        worst = max(worst, *(abs(a - b) for a, b in zip(torques, state["tau"], strict=True)))
    mul, add = count["mul"], count["add"]
    print(f"{path.stem}: {mul} M + {add} A = {mul + add}, {count['sin']} sin + {count['cos']} cos, "
          f"torques within {worst / largest:.0e} of the largest")
    return worst <= 1e-13 * largest


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__)
    folder = folder if folder.is_dir() else folder.parent
    paths = sorted(folder.glob("*.program"))
    if not paths:
        sys.exit(f"no NAME.program in {folder}")
    results = [check(path) for path in paths]
    if not all(results):
        sys.exit("torques differ")


if __name__ == "__main__":
    main()
