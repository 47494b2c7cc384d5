"""Inverse dynamics of a table of any length by Ray: `python ray_data.py ROBOT ROWS`, with two workers. Needs ray, pyarrow and psutil."""

import argparse
import os
import sys
import time

import numpy as np
import pyarrow as pa
import ray
import robots
from memory import Watch
from table import SCALE, answer, states


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("robot")
    parser.add_argument("rows", type=float)
    options = parser.parse_args()
    rows, path = int(options.rows), os.path.abspath(options.robot)
    arm = robots.load(path)
    joints = arm.degrees_of_freedom
    here = os.path.dirname(os.path.abspath(__file__))
    ray.init(num_cpus=2, runtime_env={"env_vars": {"PYTHONPATH": here}}, include_dashboard=False, log_to_driver=False)
    ray.data.DataContext.get_current().enable_progress_bars = False

    # The recipe itself: batches of pyarrow, and a function that each worker reads again from the robot file.
    function = arm.arrow("inverse_dynamics", output="columns")
    table = ray.data.range(rows, override_num_blocks=max(8, rows // 250_000)).map_batches(made, batch_format="pyarrow", fn_args=[joints])
    torques = table.map_batches(function, batch_format="pyarrow", batch_size=10_000)

    start, sums, count = time.perf_counter(), np.zeros(joints, np.int64), 0
    with Watch(["ray::", "raylet"]) as watch:
        for batch in torques.map_batches(summed, batch_format="pyarrow").iter_batches(batch_format="pyarrow", batch_size=None):
            sums += [int(np.asarray(column).sum()) for column in batch.columns[:-1]]
            count += int(np.asarray(batch.columns[-1]).sum())
    took = time.perf_counter() - start
    wanted = answer(arm, rows)
    print(f"{count} rows, {took:.0f} s; largest memory of a process: {watch.text()}")
    is_right = count == rows and sums.tolist() == wanted
    print("right" if is_right else f"WRONG: {sums.tolist()}, not {wanted}")
    sys.exit(0 if is_right else 1)


def made(batch, joints):
    return pa.Table.from_batches([states(np.asarray(batch["id"]), joints)])


def summed(batch):
    """The sums of a batch of torques, and its number of rows."""
    sums = {name: [int(np.floor(np.asarray(batch[name]) * SCALE).astype(np.int64).sum())] for name in batch.column_names}
    return pa.table({**sums, "rows": [batch.num_rows]})


if __name__ == "__main__":
    main()
