"""The tables of docs/performance.md from the lines of a run.   table.py RESULTS.jsonl

A time is the median over the rounds; a ratio is the geometric mean over four robots. The ratios of the
fastest rounds are printed beside them: on a shared processor they change less from run to run.
"""

import json
import math
import platform
import statistics
import subprocess
import sys
from collections import defaultdict

ROBOTS = ["puma560", "ur5", "iiwa", "panda"]
FUNCTIONS = [
    "inverse_dynamics",
    "mass_matrix",
    "forward_dynamics",
    "inverse_dynamics_derivatives",
    "forward_dynamics_derivatives",
    "bias",
    "gravity",
    "regressor",
    "pose_and_jacobian",
]
PEERS = ["pinocchio", "casadi"]
OURS = ["native standard", "native polynomial"]


def read(path):
    figures, errors = defaultdict(list), {}
    for line in open(path):
        row = json.loads(line)
        if "ns" in row:
            key = (row["peer"], row["robot"], row["function"])
            figures[key].append(row["ns"])
            if "error" in row:
                errors[key] = row["error"]
    return figures, errors


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def table(heads, rows):
    print("| " + " | ".join(heads) + " |")
    print("|---" * len(heads) + "|")
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def command(*words):
    return subprocess.run(words, capture_output=True, text=True).stdout.splitlines()[0]


# The goals: a description, and either the factor over another program or ns per state; measured on a Zen 4.
LEAST = [
    ("default build, default options, inverse dynamics, four arms, over Pinocchio", "plain default", "inverse_dynamics", ROBOTS, "pinocchio", 10),
    ("the same, native", "native default", "inverse_dynamics", ROBOTS, "pinocchio", 12),
    ("the same, default build, `fused`", "plain polynomial", "inverse_dynamics", ROBOTS, "pinocchio", 10),
    ("the same, native, `fused`", "native polynomial", "inverse_dynamics", ROBOTS, "pinocchio", 12),
    ("inverse dynamics' derivatives, four arms, over Pinocchio", "native polynomial", "inverse_dynamics_derivatives", ROBOTS, "pinocchio", 15),
    ("the same over CasADi", "native polynomial", "inverse_dynamics_derivatives", ROBOTS, "casadi", 8.5),
    ("forward dynamics' derivatives, four arms, over Pinocchio", "native polynomial", "forward_dynamics_derivatives", ROBOTS, "pinocchio", 12),
    ("quadruped of 12 joints, inverse dynamics, over Pinocchio", "native large", "inverse_dynamics", ["quadruped"], "pinocchio", 28),
    ("humanoid of 29 joints, derivatives, over Pinocchio", "native large", "inverse_dynamics_derivatives", ["humanoid"], "pinocchio", 6),
    ("chain of 60 joints, mass matrix, over Pinocchio", "native large", "mass_matrix", ["chain"], "pinocchio", 2),
]
MOST = [
    ("UR5 over 8 lanes, f64, ns a state", "native polynomial", "ur5", "inverse_dynamics_lanes", 9.2),
    ("UR5 in columns, f64, ns a state, native", "native polynomial", "ur5", "inverse_dynamics_columns", 9.2),
    ("the same, default build", "plain polynomial", "ur5", "inverse_dynamics_columns", 10.1),
    ("UR5 in columns, f32, ns a state, native", "native polynomial", "ur5", "inverse_dynamics_columns_f32", 3.9),
    ("the same, default build", "plain polynomial", "ur5", "inverse_dynamics_columns_f32", 4.3),
    ("quadruped of 12 joints, inverse dynamics, ns", "native large", "quadruped", "inverse_dynamics", 30),
]


def targets(figures):
    rows = []
    for words, own, function, robots, peer, least in LEAST:
        # Pinocchio's mass matrix is a triangle.
        ours = "mass_matrix_lower" if robots == ["chain"] else function
        pairs = [(figures.get((peer, robot, function)), figures.get((own, robot, ours))) for robot in robots]
        found = "" if any(None in pair for pair in pairs) else f"{geometric_mean([a / b for a, b in pairs]):.2f}"
        rows.append([words, found, f"at least {least}"])
    for words, own, robot, function, most in MOST:
        figure = figures.get((own, robot, function))
        rows.append([words, "" if figure is None else f"{figure:.1f}", f"at most {most}"])
    return rows


def main():
    rounds, errors = read(sys.argv[1])
    figures = {key: statistics.median(values) for key, values in rounds.items()}
    fastest = {key: min(values) for key, values in rounds.items()}
    processor = next(line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name"))
    print(f"{processor}, {platform.libc_ver()[0]} {platform.libc_ver()[1]}, {command('rustc', '--version')}, "
          f"{command('clang++', '--version')}, {command('gcc', '--version')}\n")

    def cell(peer, robot, function):
        figure = figures.get((peer, robot, function))
        return "" if figure is None else f"{figure:.0f}" if figure >= 100 else f"{figure:.1f}"

    def ratio(chosen, ours, peer, function):
        pairs = [(chosen.get((peer, robot, function)), chosen.get((ours, robot, function))) for robot in ROBOTS]
        if any(None in pair for pair in pairs):
            return ""
        return f"{geometric_mean([theirs / own for theirs, own in pairs]):.2f}"

    print("Targets, medians of the rounds:\n")
    table(["", "found", "target"], targets(figures))

    latencies = [f"{function} latency" for function in FUNCTIONS[:4]]
    heads = ["function"] + [f"{own.split()[1]} / {peer}" for own in OURS for peer in PEERS]
    for name, chosen in [("medians of the rounds", figures), ("fastest rounds", fastest)]:
        print(f"How many times faster, {name}, geometric mean over {', '.join(ROBOTS)}:\n")
        rows = []
        for function in FUNCTIONS + latencies:
            row = [ratio(chosen, own, peer, function) for own in OURS for peer in PEERS]
            if any(row):
                rows.append([function] + row)
        table(heads, rows)

    print("Nanoseconds per call:\n")
    contenders = sorted({peer for peer, _, _ in figures}, key=lambda peer: (peer in PEERS, peer))
    for function in FUNCTIONS + latencies:
        rows = [[robot] + [cell(peer, robot, function) for peer in contenders] for robot in ROBOTS + ["stanford", "scara"]]
        if any(any(row[1:]) for row in rows):
            print(f"`{function}`\n")
            table(["robot"] + contenders, rows)

    batches = [(peer, robot, function) for peer, robot, function in figures if function.endswith("_batch")]
    if batches:
        print("Batches of 512 states, nanoseconds per state, and the single call of the same kind over it:\n")
        rows = []
        for peer, robot, function in batches:
            single = figures.get((peer, robot, function.removesuffix("_batch")))
            figure = figures[peer, robot, function]
            rows.append([f"{peer}: {function}", robot, f"{figure:.1f}", "" if single is None else f"{single / figure:.2f}"])
        table(["", "robot", "ns per state", "single / batch"], rows)

    for trigonometry in ["standard", "polynomial"]:
        pairs = [(figures.get((f"plain {trigonometry}", robot, "inverse_dynamics")),
                  figures.get((f"native {trigonometry}", robot, "inverse_dynamics"))) for robot in ROBOTS]
        if not any(None in pair for pair in pairs):
            mean = geometric_mean([plain / native for plain, native in pairs])
            print(f"Compiled for any machine of the kind over compiled for this one, {trigonometry} sine: {mean:.2f}")
    print("\nLargest difference of torques from the numeric solver, relative to the largest torque: "
          + ", ".join(f"{peer} {max(error for (who, _, _), error in errors.items() if who == peer):.0e}"
                      for peer in sorted({peer for peer, _, _ in errors})))


if __name__ == "__main__":
    main()
