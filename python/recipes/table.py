"""The table of the recipes: states that any engine can make by exact arithmetic, and the answer that it must find.

State `id` has the positions, velocities and accelerations −1 + 2 (id · step mod 2²⁰) / 2²⁰, with an odd step for each column, so that all doubles are the same
in SQL and in NumPy. The answer is a sum of whole numbers, ⌊10⁶ τ⌋ of each joint, so that no order of summation changes it.
"""

import numpy as np
import pyarrow as pa

MODULUS = 1 << 20
SCALE = 1_000_000.0


def columns(joints):
    """The steps of the columns q1 …, qd1 …, qdd1 …, by name."""
    names = [f"{kind}{joint + 1}" for kind in ("q", "qd", "qdd") for joint in range(joints)]
    return {name: 2 * (7919 * index + 104_729) + 1 for index, name in enumerate(names)}


def states(ids, joints):
    """A record batch of states, and their ids."""
    ids = np.asarray(ids, np.int64)
    made = {name: (ids * step % MODULUS).astype(np.float64) / MODULUS * 2.0 - 1.0 for name, step in columns(joints).items()}
    return pa.record_batch({"id": ids, **made})


def answer(arm, rows, chunk=1 << 16):
    """The sums of the table of so many rows, one for each joint, computed here and now."""
    function = arm.arrow("inverse_dynamics", output="columns")
    total = np.zeros(arm.degrees_of_freedom, np.int64)
    for start in range(0, rows, chunk):
        torques = function(states(np.arange(start, min(start + chunk, rows)), arm.degrees_of_freedom))
        total += [int(np.floor(np.asarray(column) * SCALE).astype(np.int64).sum()) for column in torques.columns]
    return total.tolist()
