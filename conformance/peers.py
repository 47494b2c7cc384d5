#!/usr/bin/env python3
"""Runs Pinocchio and MuJoCo on the rows of the conformance suite and writes docs/conformance.md.

    pip install -r conformance/requirements.txt && python conformance/peers.py

Every row runs in a process of its own, so that a crash is a result and does not end the run. Everything that a program
writes to its standard output and error counts as a message.
"""

import json
import os
import select
import signal
import sys
import tempfile
import tomllib
from pathlib import Path

import mujoco
import numpy as np
import pinocchio

HERE = Path(__file__).resolve().parent
PAGE = HERE.parent / "docs" / "conformance.md"
FILES = ["inertia", "joints", "structure", "text"]
HEADINGS = {
    "inertia": "Masses and inertias",
    "joints": "Joints",
    "structure": "Links and joints together",
    "text": "Spelling, numbers, XML",
}
TOLERANCE = 1e-9
SECONDS = 20


def pinocchio_torques(row):
    """Returns the torques of the row's joints by Pinocchio with its defaults, and its numbers of velocities and positions."""
    model = pinocchio.buildModelFromXML(row["urdf"])
    data = model.createData()
    joints = row.get("joints") or list(model.names)[1:]
    zeros = [0.0] * len(joints)
    q, v, a = pinocchio.neutral(model), np.zeros(model.nv), np.zeros(model.nv)
    places = []
    states = zip(joints, row.get("q", zeros), row.get("qd", zeros), row.get("qdd", [1.0] * len(joints)))
    for name, position, velocity, acceleration in states:
        joint = model.joints[model.getJointId(name)]
        if joint.nq == 2:
            q[joint.idx_q : joint.idx_q + 2] = [np.cos(position), np.sin(position)]
        elif joint.nq == 1:
            q[joint.idx_q] = position
        v[joint.idx_v], a[joint.idx_v] = velocity, acceleration
        places.append(joint.idx_v)
    tau = pinocchio.rnea(model, data, q, v, a)
    return [tau[place] for place in places], model.nv, model.nq


def mujoco_torques(row):
    """Returns the same by MuJoCo: inverse dynamics, which in MuJoCo includes passive forces and friction."""
    model = mujoco.MjModel.from_xml_string(row["urdf"])
    data = mujoco.MjData(model)
    joints = row.get("joints") or [model.joint(index).name for index in range(model.njnt)]
    zeros = [0.0] * len(joints)
    places = []
    states = zip(joints, row.get("q", zeros), row.get("qd", zeros), row.get("qdd", [1.0] * len(joints)))
    for name, position, velocity, acceleration in states:
        joint = model.joint(name)
        data.qpos[joint.qposadr[0]] = position
        data.qvel[joint.dofadr[0]], data.qacc[joint.dofadr[0]] = velocity, acceleration
        places.append(joint.dofadr[0])
    mujoco.mj_inverse(model, data)
    return [data.qfrc_inverse[place] for place in places], model.nv, model.nq


def apart(function, row):
    """Runs a function in a process of its own; returns its result and whether it wrote anything."""
    with tempfile.TemporaryFile() as said, tempfile.TemporaryDirectory() as folder:
        reader, writer = os.pipe()
        child = os.fork()
        if child == 0:
            os.chdir(folder)
            os.dup2(said.fileno(), 1)
            os.dup2(said.fileno(), 2)
            try:
                answer = ["torques", *function(row)]
            except Exception as error:  # any exception counts as a refusal
                answer = ["refuses", str(error)]
            os.write(writer, json.dumps(answer, default=float).encode())
            sys.stdout.flush()
            os._exit(0)
        os.close(writer)
        ready, _, _ = select.select([reader], [], [], SECONDS)
        text = os.read(reader, 1 << 16) if ready else b""
        os.close(reader)
        if not ready:
            os.kill(child, signal.SIGKILL)
        _, status = os.waitpid(child, 0)
        said.seek(0)
        messages = bool(said.read().strip())
    if not ready:
        return ["hangs"], messages
    if not text:
        return ["crashes", f"signal {os.WTERMSIG(status)}"], messages
    return json.loads(text), messages


def number(value):
    return "0" if abs(value) < 5e-13 else f"{value:.6g}"


def numbers(values):
    return ", ".join(number(value) for value in values)


def right(row):
    return numbers(row["tau"]) if "tau" in row else "refused"


def ours(row):
    """Returns the result that `tests/derivations/conformance.rs` demands of this project."""
    if "refused" in row:
        return "refuses, " + " ".join(row["refused"])
    warned = row.get("warned", [])
    return numbers(row["tau"]) + (", warns " + " ".join(warned) if warned else "")


def judge(row, answer, messages):
    """Returns the cell for a result, and whether the result is 'right', 'said' or 'silent'."""
    if answer[0] == "refuses":
        return ("refuses", "right") if "refused" in row else ("**refuses**", "said")
    if answer[0] != "torques":
        return f"**{answer[0]}**", "said"
    _, torques, coordinates, positions = answer
    finite = all(np.isfinite(torques))
    cell = numbers(torques) if finite else "not a number"
    if "tau" in row:
        size = max(1.0, max(abs(value) for value in row["tau"]))
        same = len(torques) == len(row["tau"]) and coordinates == len(row["tau"])
        if same and finite and max(abs(np.subtract(torques, row["tau"]))) <= TOLERANCE * size:
            odd = f", {positions} positions" if positions != coordinates else ""
            return cell + odd, "right"
        if coordinates != len(row["tau"]):
            cell = f"{coordinates} coordinates"
    elif row.get("scope"):
        return "reads it", "right"
    elif not torques:
        cell = "no coordinate"
    how = "said" if messages else "silent"
    return f"**{cell}**, {'with a message' if messages else 'silent'}", how


def main():
    versions = {"Pinocchio": pinocchio.__version__, "MuJoCo": mujoco.__version__}
    peers = {"Pinocchio": pinocchio_torques, "MuJoCo": mujoco_torques}
    tally = {peer: {"right": 0, "said": 0, "silent": 0} for peer in peers}
    tables, count = [], 0
    for file in FILES:
        rows = tomllib.loads((HERE / f"{file}.toml").read_text())["row"]
        lines = [f"## {HEADINGS[file]}", ""]
        lines += ["| row | input | right | here | Pinocchio | MuJoCo |", "|---|---|---|---|---|---|"]
        for row in rows:
            cells = []
            for peer, function in peers.items():
                cell, how = judge(row, *apart(function, row))
                tally[peer][how] += 1
                cells.append(cell)
            count += 1
            lines.append(f"| {row['name']} | {row['title']} | {right(row)} | {ours(row)} | {' | '.join(cells)} |")
        tables.append("\n".join(lines))
    PAGE.write_text(head(count, versions, tally) + "\n\n".join(tables) + "\n")
    print(f"{count} rows, {tally}")


def head(count, versions, tally):
    summary = "\n".join(
        f"| {peer} {versions[peer]} | {found['right']} | {found['said']} | {found['silent']} |"
        for peer, found in tally.items()
    )
    return f"""# Conformance: how programs read a robot description

Each row is a small URDF file with a state and the right torques, derived by hand, or the reason for refusing the file.
The rows are in [conformance/](../conformance/README.md), where anybody can run them. `conformance/peers.py` writes this page;
`tests/derivations/conformance.rs` tests the column *here*. Torques are in N m, forces in N.
Bold marks an answer that differs from the right one. *Silent* means that the program wrote nothing to standard output or error.

A difference is not always a fault. *Reads it* marks files that this project refuses because of its own limits; it counts as right. Pinocchio and MuJoCo leave
checks to others; MuJoCo includes damping and friction in inverse dynamics by design, and both read mimic joints as constraints or not at all
by default. All programs run with their defaults.

| {count} rows | as the row says | differs, with a message | differs silently |
|---|---|---|---|
| here | {count} | 0 | 0 |
{summary}

"""


if __name__ == "__main__":
    main()
