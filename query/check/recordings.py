"""Recordings written and read by their own libraries, and converted by `robot-query`: recordings.py ROBOT-QUERY.

The same joint states are written as MCAP by the library of Foxglove, with its encoder of ROS 2 messages, and as a data set
in the layout of LeRobot 3 by PyArrow. Both are read again by these libraries. The logs that `robot-query convert` makes of
them must have the same positions and torques, bit for bit, and velocities near the derivatives.
"""

import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from mcap.reader import make_reader
from mcap.writer import CompressionType
from mcap_ros2.decoder import DecoderFactory
from mcap_ros2.writer import Writer

ROBOT = Path(__file__).parents[2] / "robots" / "planar_2r.toml"
ROWS, STEP, TOPIC = 500, 0.01, "/joint_states"
START = 1_700_000_000

# sensor_msgs/msg/JointState and the messages in it, as the ROS 2 interface definitions have them.
SCHEMA = """std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""


def motion(row: int) -> tuple[list[float], list[float]]:
    """Positions and velocities of the joints `1` and `2`."""
    time = STEP * row
    return [math.sin(time), math.sin(2 * time)], [math.cos(time), 2 * math.cos(2 * time)]


def effort(row: int) -> list[float]:
    return [0.5 * row, -0.25 * row]


def write_mcap(path: Path, compression: CompressionType) -> None:
    with open(path, "wb") as file:
        writer = Writer(file, compression=compression)
        schema = writer.register_msgdef("sensor_msgs/msg/JointState", SCHEMA)
        for row in range(ROWS):
            nanoseconds = round(STEP * row * 1e9)
            stamp = {"sec": START + nanoseconds // 10**9, "nanosec": nanoseconds % 10**9}
            position, _ = motion(row)
            message = {
                "header": {"stamp": stamp, "frame_id": "base"},
                # The second joint first: joints are found by their names.
                "name": ["2", "1"],
                "position": position[::-1],
                "velocity": [],
                "effort": effort(row)[::-1],
            }
            writer.write_message(TOPIC, schema, message, log_time=START * 10**9 + nanoseconds)
        writer.finish()


def read_mcap(path: Path) -> np.ndarray:
    """Positions and torques of the joints `1` and `2`."""
    rows = []
    with open(path, "rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        for _, _, _, message in reader.iter_decoded_messages(topics=[TOPIC]):
            places = [list(message.name).index(name) for name in ("1", "2")]
            rows.append([values[place] for values in (message.position, message.effort) for place in places])
    return np.array(rows)


def write_data_set(folder: Path) -> None:
    names = ["1.pos", "2.pos"]
    feature = {"dtype": "float32", "shape": [2], "names": names}
    info = {"codebase_version": "v3.0", "fps": 100, "features": {"observation.state": feature, "observation.effort": feature}}
    (folder / "meta").mkdir(parents=True)
    (folder / "meta" / "info.json").write_text(json.dumps(info))
    (folder / "data" / "chunk-000").mkdir(parents=True)
    lists = pa.list_(pa.float32())
    table = pa.table(
        {
            "observation.state": pa.array([motion(row % 250)[0] for row in range(ROWS)], lists),
            "observation.effort": pa.array([effort(row) for row in range(ROWS)], lists),
            "timestamp": pa.array([STEP * (row % 250) for row in range(ROWS)], pa.float32()),
            "frame_index": pa.array([row % 250 for row in range(ROWS)], pa.int64()),
            "episode_index": pa.array([row // 250 for row in range(ROWS)], pa.int64()),
        }
    )
    pq.write_table(table, folder / "data" / "chunk-000" / "file-000.parquet")


def read_data_set(folder: Path) -> np.ndarray:
    table = pq.read_table(folder / "data")
    columns = [np.array(table[name].to_pylist()) for name in ("observation.state", "observation.effort")]
    return np.hstack(columns)


def convert(command: str, recording: Path, log: Path, *more: str) -> pa.Table:
    subprocess.run([command, "convert", ROBOT, recording, "-o", log, "--window", "11", *more], check=True)
    return pq.read_table(log)


def compare(name: str, log: pa.Table, wanted: np.ndarray, episode: int) -> None:
    found = {column: np.array(log[column].to_pylist()) for column in ("q", "qd", "tau")}
    assert np.array_equal(np.hstack([found["q"], found["tau"]]), wanted), name
    velocities = np.array([motion(row % episode)[1] for row in range(ROWS)])
    error = np.abs(found["qd"] - velocities).max()
    assert error < 0.05, (name, error)
    print(f"{name}: {len(log)} rows, positions and torques bit for bit; velocities within {error:.1e} rad/s")


def main() -> None:
    command = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        path = folder / "plain.mcap"
        write_mcap(path, CompressionType.NONE)
        log = convert(command, path, folder / "plain.parquet")
        compare("MCAP", log, read_mcap(path), ROWS)
        for compression in (CompressionType.ZSTD, CompressionType.LZ4):
            kind = compression.name.lower()
            path = folder / f"{kind}.mcap"
            write_mcap(path, compression)
            log = convert(command, path, folder / f"{kind}.parquet")
            compare(f"MCAP ({kind})", log, read_mcap(path), ROWS)
        write_data_set(folder / "set")
        log = convert(command, folder / "set", folder / "set.parquet", "--tau", "observation.effort")
        compare("LeRobot", log, read_data_set(folder / "set"), 250)


main()
