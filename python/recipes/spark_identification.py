"""Identification over a log of any length by Spark: `python spark_identification.py ROBOT LOG [ESTIMATES]`.

The log is a folder of Parquet files with columns of lists q, qd, qdd and tau, as `robot-query generate` writes them. Each part of it becomes the triangle of its
[Y tau] (QR decomposition, so that nothing is squared), and the triangles become one. ESTIMATES is the CSV file of `robot-query identify ROBOT LOG --noise 1 -o
ESTIMATES`: the base parameters must be the same to 1e-9 of the largest. Needs pyspark, pandas, pyarrow and a Java of at least 17.
"""

import argparse
import csv
import os
import sys

import numpy as np
import pyarrow as pa
import robots
from pyspark.sql import SparkSession

# Of the largest base parameter.
TOLERANCE = 1e-9


class Fold:
    """Batches of a part of the log to the triangle of its [Y tau], a row of the answer. Each worker reads the robot file again."""

    def __init__(self, arm):
        self.regressor = arm.arrow("regressor_base", keep=["tau"])

    def __call__(self, batches):
        triangle = None
        for batch in batches:
            found = self.regressor(batch)
            tau = found.column("tau").flatten().to_numpy()
            regressor = found.column("regressor_base").flatten().to_numpy().reshape(tau.size, -1)
            rows = np.column_stack([regressor, tau])
            triangle = np.linalg.qr(rows if triangle is None else np.vstack([triangle, rows]), mode="r")
        if triangle is not None:
            yield pa.record_batch({"triangle": pa.array([triangle.ravel()]), "columns": [triangle.shape[1]]})


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("robot")
    parser.add_argument("log")
    parser.add_argument("estimates", nargs="?")
    options = parser.parse_args()
    arm = robots.load(os.path.abspath(options.robot))
    # Workers run this Python, and all talk within this machine.
    os.environ.update(PYSPARK_PYTHON=sys.executable, SPARK_LOCAL_IP="127.0.0.1")
    spark = (
        SparkSession.builder.master("local[2]")
        .config("spark.sql.execution.arrow.maxRecordsPerBatch", 10_000)
        .config("spark.ui.enabled", "false")
        .getOrCreate()
    )
    spark.sparkContext.setLogLevel("ERROR")

    # The recipe itself.
    log = spark.read.parquet(os.path.abspath(options.log)).select("q", "qd", "qdd", "tau")
    parts = log.mapInArrow(Fold(arm), "triangle array<double>, columns long").collect()
    triangles = [np.reshape(part["triangle"], (-1, part["columns"])) for part in parts]
    triangle = np.linalg.qr(np.vstack(triangles), mode="r")
    found, _, rank, singular = np.linalg.lstsq(triangle[:, :-1], triangle[:, -1], rcond=1e-12)

    names = [parameter["name"] for parameter in arm.base_parameters()["base"]]
    print(f"{len(parts)} parts, {rank} of {len(names)} parameters, condition {singular[0] / singular[-1]:.3g}")
    right = True
    if options.estimates is None:
        for name, value in zip(names, found, strict=True):
            print(f"{name} {value:.6f}")
    else:
        with open(options.estimates) as lines:
            wanted = {line["name"]: float(line["value"]) for line in csv.DictReader(lines)}
        values = np.array([wanted[name] for name in names])
        difference = np.abs(found - values).max() / np.abs(values).max()
        right = rank == len(names) == len(wanted) and difference < TOLERANCE
        print(f"{'right' if right else 'WRONG'}: within {difference:.1e} of the estimates")
    spark.stop()
    sys.exit(0 if right else 1)


if __name__ == "__main__":
    main()
