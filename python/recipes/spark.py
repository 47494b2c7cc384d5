"""Inverse dynamics of a table of any length by Spark: `python spark.py ROBOT ROWS [--kill]`.

Two workers, each a process of its own with one core and 1 GB. With `--kill` one is killed when a quarter of the work is done; the sums must be right all the
same. Needs pyspark, pyarrow, psutil and a Java of at least 17.
"""

import argparse
import os
import signal
import sys
import threading
import time

import psutil
import robots
from memory import Watch
from pyspark.sql import SparkSession, functions as F
from table import MODULUS, SCALE, answer, columns

EXECUTOR = "CoarseGrainedExecutorBackend"


def executors():
    found = []
    for process in psutil.Process().children(recursive=True):
        try:
            if EXECUTOR in " ".join(process.cmdline()) and process.name() == "java":
                found.append(process)
        except psutil.Error:
            continue
    return found


def kill_one(tracker, parts, done):
    """Waits until a quarter of the parts are done, and kills a worker."""
    while not done.wait(0.2):
        stages = [tracker.getStageInfo(stage) for stage in tracker.getActiveStageIds()]
        if any(stage and stage.numCompletedTasks >= parts // 4 for stage in stages):
            victim = executors()[0]
            os.kill(victim.pid, signal.SIGKILL)
            print(f"killed worker {victim.pid}", flush=True)
            return


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("robot")
    parser.add_argument("rows", type=float)
    parser.add_argument("--kill", action="store_true")
    options = parser.parse_args()
    rows, arm = int(options.rows), robots.load(os.path.abspath(options.robot))
    joints = arm.degrees_of_freedom
    parts = max(8, rows // 1_000_000)
    # Workers run this Python, and all talk within this machine.
    os.environ.update(PYSPARK_PYTHON=sys.executable, SPARK_LOCAL_IP="127.0.0.1")
    spark = (
        SparkSession.builder.master("local-cluster[2,1,1024]")
        .config("spark.executor.memory", "1g")
        .config("spark.executorEnv.PYTHONPATH", os.path.dirname(os.path.abspath(__file__)))
        .config("spark.sql.execution.arrow.maxRecordsPerBatch", 10_000)
        .config("spark.ui.enabled", "false")
        .getOrCreate()
    )
    spark.sparkContext.setLogLevel("ERROR")

    # The recipe itself: columns q1 …, qd1 …, qdd1 … of any table, and a function that each worker reads again from the robot file.
    made = [(F.pmod(F.col("id") * step, F.lit(MODULUS)).cast("double") / MODULUS * 2.0 - 1.0).alias(name) for name, step in columns(joints).items()]
    table = spark.range(0, rows, 1, parts).select("id", *made)
    function = arm.arrow("inverse_dynamics", output="columns")
    schema = ", ".join(f"tau{joint + 1} double" for joint in range(joints))
    torques = table.mapInArrow(function.batches, schema)

    sums = [F.sum(F.floor(F.col(f"tau{joint + 1}") * SCALE)).alias(f"sum{joint + 1}") for joint in range(joints)]
    done, start = threading.Event(), time.perf_counter()
    if options.kill:
        threading.Thread(target=kill_one, args=(spark.sparkContext.statusTracker(), parts, done), daemon=True).start()
    with Watch([EXECUTOR, "pyspark.daemon"]) as watch:
        row = torques.agg(F.count("*").alias("rows"), *sums).first()
    done.set()
    took = time.perf_counter() - start
    found, wanted = [int(value) for value in row[1:]], answer(arm, rows)
    print(f"{row['rows']} rows, {parts} parts, {took:.0f} s; largest memory of a process: {watch.text()}")
    print("right" if row["rows"] == rows and found == wanted else f"WRONG: {found}, not {wanted}")
    spark.stop()
    sys.exit(0 if row["rows"] == rows and found == wanted else 1)


if __name__ == "__main__":
    main()
