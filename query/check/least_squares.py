"""Compares estimates of `robot-query` with numpy.linalg.lstsq: least_squares.py ROBOT-QUERY [ROWS]."""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq

ROBOT = Path(__file__).parents[2] / "robots" / "ur5.toml"


def run(command: str, *arguments: object) -> None:
    subprocess.run([command, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)


def column(table, name: str) -> np.ndarray:
    """A column of lists, however nested, as one row of numbers for each row."""
    values = table[name].combine_chunks()
    while hasattr(values, "flatten") and "list" in str(values.type):
        values = values.flatten()
    return values.to_numpy().reshape(table.num_rows, -1)


def main() -> None:
    command, rows = sys.argv[1], int(float(sys.argv[2])) if len(sys.argv) > 2 else 100_000
    with tempfile.TemporaryDirectory() as folder:
        log, regressor, found = (Path(folder) / name for name in ("log", "regressor", "found.csv"))
        run(command, "generate", ROBOT, "--rows", rows, "--noise", 0.5, "-o", log)
        query = f"SELECT regressor_base('{ROBOT}', q, qd, qdd) AS y, tau FROM log"
        run(command, "sql", query, "--log", log, "-o", regressor)
        run(command, "identify", ROBOT, log, "--noise", 1, "-o", found)
        table = pq.read_table(regressor)
        y, tau = column(table, "y"), column(table, "tau").ravel()
        wanted, _, rank, singular = np.linalg.lstsq(y.reshape(tau.size, -1), tau, rcond=None)
        with open(found) as lines:
            estimates = list(csv.DictReader(lines))
        values = np.array([float(line["value"]) for line in estimates])
        truth = np.array([float(line["robot_file"]) for line in estimates])
        deviations = np.array([float(line["deviation"]) for line in estimates])
    error = np.abs(values - wanted).max() / np.abs(wanted).max()
    sigmas = np.abs(values - truth) / deviations
    print(
        f"{rows} rows, {rank} parameters, condition {singular[0] / singular[-1]:.3g}: {error:.2e} from "
        f"numpy.linalg.lstsq; {(sigmas > 3).sum()} parameters beyond 3 deviations, the largest {sigmas.max():.2f}"
    )
    assert error < 1e-9, error
    assert sigmas.max() < 4.5, sigmas


main()
