"""Rows in a second and memory of `robot-query` over logs of growing size, beside NumPy with Pinocchio over the same files:
throughput.py ROBOT-QUERY [MOST-ROWS [FOLDER]] [--single].

All read the same Parquet files, a column for each joint, from the same disk, in turn. Pinocchio's torques are
`rneaInParallel` where the package has it, else `rnea` row by row; its regressor is `computeJointTorqueRegressor`, folded by
NumPy's QR decomposition, a block at a time. They take PEER rows at most, since they are far slower. `--single` has the
logs in single precision: half as much to read. All compute in double precision.
"""

import argparse
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

import numpy as np
import pinocchio as pin
import pyarrow.parquet as pq

ROBOT = Path(__file__).parents[2] / "robots" / "ur5.toml"
JOINTS = 6
PEER = 1_000_000
# At which number of rows the torques are written to files, too.
WRITTEN = 10_000_000
BLOCK = 4096


def run(command: str, *arguments: object) -> tuple[float, float, float]:
    """Seconds, those of all cores together, and the most memory in MiB."""
    with tempfile.TemporaryFile("w+") as output:
        start = time.perf_counter()
        child = subprocess.Popen([command, *map(str, arguments)], stdout=output, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(child.pid, 0)
        seconds = time.perf_counter() - start
        output.seek(0)
        text = output.read()
    if status:
        sys.exit(f"{command} {arguments}: {text}")
    return seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def number(value: object) -> float:
    """A number of a robot file, which may be a fraction of pi."""
    numerator, *denominators = str(value).replace("pi", str(math.pi)).split("/")
    return float(numerator) / math.prod(map(float, denominators))


def model_of(path: Path) -> pin.Model:
    """The robot of a file with a chain of revolute joints."""
    robot = tomllib.loads(path.read_text())
    model, parent = pin.Model(), 0
    model.gravity.linear = np.array([number(part) for part in robot["robot"]["gravity"]])
    kinds = {"x": pin.JointModelRX, "y": pin.JointModelRY, "z": pin.JointModelRZ}
    for link in robot["link"]:
        origin, tensor = link.get("origin", {}), link["inertia"]
        angles = [number(angle) for angle in origin.get("rpy", [0, 0, 0])]
        shift = np.array([number(part) for part in origin.get("xyz", [0, 0, 0])])
        placement = pin.SE3(pin.rpy.rpyToMatrix(*angles), shift)
        entry = lambda name: number(tensor.get(name, 0))
        matrix = np.array([[entry("".join(sorted(a + b))) for b in "xyz"] for a in "xyz"])
        center = np.array([number(part) for part in link["center_of_mass"]])
        inertia = pin.Inertia(number(link["mass"]), center, matrix)
        parent = model.addJoint(parent, kinds[link["joint"]["axis"]](), placement, link["name"])
        model.appendBodyToJoint(parent, inertia, pin.SE3.Identity())
    return model


def blocks(files: list[Path], names: list[str], most: int):
    """Blocks of rows of the files, a column of numbers for each name."""
    seen = 0
    for file in files:
        for batch in pq.ParquetFile(file).iter_batches(BLOCK, columns=names):
            batch = batch.slice(0, most - seen)
            seen += batch.num_rows
            yield np.column_stack([batch[name].to_numpy().astype(float) for name in names])
            if seen == most:
                return


def now() -> np.ndarray:
    """Seconds, and those of all cores together."""
    return np.array([time.perf_counter(), time.process_time()])


def columns(variables: list[str]) -> list[str]:
    return [f"{variable}_{joint + 1}" for variable in variables for joint in range(JOINTS)]


def pinocchio_torques(model: pin.Model, files: list[Path], most: int) -> tuple[float, float, np.ndarray]:
    parallel = getattr(pin, "rneaInParallel", None)
    threads = os.cpu_count() or 1
    pool = pin.ModelPool(model, threads) if parallel else None
    data, last, start = model.createData(), None, now()
    for block in blocks(files, columns(["q", "qd", "qdd"]), most):
        q, qd, qdd = (np.asfortranarray(block[:, part * JOINTS : (part + 1) * JOINTS].T) for part in range(3))
        if parallel:
            last = parallel(threads, pool, q, qd, qdd)[:, -1]
        else:
            for row in range(block.shape[0]):
                last = pin.rnea(model, data, q[:, row], qd[:, row], qdd[:, row])
    return *(now() - start), last


def pinocchio_regressor(model: pin.Model, files: list[Path], most: int) -> tuple[float, float, np.ndarray]:
    data, triangle, start = model.createData(), None, now()
    for block in blocks(files, columns(["q", "qd", "qdd", "tau"]), most):
        rows = np.empty((block.shape[0], JOINTS, 10 * model.nv + 1))
        for row, (q, qd, qdd, tau) in enumerate(block.reshape(-1, 4, JOINTS)):
            rows[row, :, :-1] = pin.computeJointTorqueRegressor(model, data, q, qd, qdd)
            rows[row, :, -1] = tau
        rows = rows.reshape(-1, rows.shape[-1])
        triangle = np.linalg.qr(rows if triangle is None else np.vstack([triangle, rows]), mode="r")
    return *(now() - start), triangle


def same(command: str, log: Path, rows: int, last: np.ndarray, triangle: np.ndarray) -> None:
    """That both computed the same: the torques of the last row, and what the best parameters leave of all torques."""
    states, all_columns = ", ".join(columns(["q", "qd", "qdd"])), ", ".join(columns(["q", "qd", "qdd", "tau"]))
    query = (
        f"SELECT inverse_dynamics('{ROBOT}', {states}) AS torque, "
        f"(SELECT identify('{ROBOT}', {all_columns}, 1.0)['scale'] FROM log) AS scale "
        "FROM log ORDER BY episode DESC, t DESC LIMIT 1"
    )
    with tempfile.TemporaryDirectory() as folder:
        answer = Path(folder) / "answer.parquet"
        run(command, "sql", query, "--log", log, "-o", answer)
        found = pq.read_table(answer).to_pylist()[0]
    # Of the 60 standard parameters, 36 combinations act.
    table, torque = triangle[:, :-1], triangle[:, -1]
    best, _, rank, _ = np.linalg.lstsq(table, torque, rcond=1e-10)
    scale = np.linalg.norm(table @ best - torque) / math.sqrt(rows * JOINTS - rank)
    errors = np.abs(np.array(found["torque"]) - last).max(), abs(found["scale"] / scale - 1)
    print(f"{'':11} the same torques within {errors[0]:.1e} N m, the same residual within {errors[1]:.1e} of it")
    assert errors[0] < 1e-9 and errors[1] < 1e-9, errors


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("command")
    parser.add_argument("most", type=float, nargs="?", default=1e6)
    parser.add_argument("folder", type=Path, nargs="?")
    parser.add_argument("--single", action="store_true")
    options = parser.parse_args()
    command, most, folder = options.command, int(options.most), options.folder or Path(tempfile.mkdtemp())
    model = model_of(ROBOT)
    print(f"{'rows':>11} {'what':28} {'seconds':>9} {'CPU':>9} {'rows/s':>11} {'rows/CPU s':>11} {'MiB':>7}")

    def row(rows: int, what: str, seconds: float, cpu: float, memory: float | None = None) -> None:
        shown = f"{memory:7.0f}" if memory else ""
        print(f"{rows:11} {what:28} {seconds:9.3f} {cpu:9.3f} {rows / seconds:11.3e} {rows / cpu:11.3e} {shown}", flush=True)

    rows = 100_000
    while rows <= most:
        log = folder / f"log-{rows}"
        if not log.exists():
            files = max(2, rows // 5_000_000)
            arguments = ["--noise", 0.5, "--layout", "columns", "--files", files, "-o", log]
            arguments += ["--single"] if options.single else []
            row(rows, "generate", *run(command, "generate", ROBOT, "--rows", rows, *arguments))
        files = sorted(log.iterdir())
        states = columns(["q", "qd", "qdd"])
        torques = f"inverse_dynamics('{ROBOT}', {', '.join(states)})"
        row(rows, "robot-query torques", *run(command, "sql", f"SELECT count({torques}) FROM log", "--log", log))
        if rows == WRITTEN:
            answer = folder / "answer"
            written = run(command, "torques", ROBOT, log, "--columns", "episode,t", "-o", answer)
            row(rows, "robot-query torques, written", *written)
            shutil.rmtree(answer)
        row(rows, "robot-query identify", *run(command, "identify", ROBOT, log, "--noise", 1))
        if rows <= PEER:
            seconds, cpu, last = pinocchio_torques(model, files, rows)
            row(rows, "Pinocchio torques", seconds, cpu)
        if rows <= PEER // 10:
            seconds, cpu, triangle = pinocchio_regressor(model, files, rows)
            row(rows, "Pinocchio and NumPy identify", seconds, cpu)
            same(command, log, rows, last, triangle)
        rows *= 10
    if options.folder is None:
        shutil.rmtree(folder)


main()
