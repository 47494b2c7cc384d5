"""Times the kernels of CUDA packages on a device, and compares the results with those of the Python
package of the same robot.

    python3 measure.py FOLDER ROBOT...

FOLDER contains the packages ROBOT_f32, ROBOT_f64 and ROBOT_python, with the same functions.
"""

import json
import math
import pathlib
import re
import sys

import cupy
import numpy

STATES = 1 << 24
COMPARED = 1000
THREADS = [64, 128, 256]
ROUNDS = 15


def median_time(work):
    """The median time of a call, s, measured with CUDA events, after three calls that are not counted."""
    for _ in range(3):
        work()
    times = []
    for _ in range(ROUNDS):
        start, end = cupy.cuda.Event(), cupy.cuda.Event()
        start.record()
        work()
        end.record()
        end.synchronize()
        times.append(cupy.cuda.get_elapsed_time(start, end) / 1e3)
    return sorted(times)[ROUNDS // 2]


def copy_bandwidth():
    """Bytes a second that a copy within the device's memory reads and writes."""
    source = cupy.random.random(1 << 28, dtype=cupy.float64)
    target = cupy.empty_like(source)
    return 2 * source.nbytes / median_time(lambda: cupy.copyto(target, source))


def kernel_text(header, name):
    """The text of a kernel."""
    start = header.index(f"{name}_kernel(")
    return header[start : header.index("\n}\n", start)]


def touched(text, arrays):
    """The number of entries of these arrays that a kernel reads or writes for a state."""
    names = "|".join(re.escape(array["name"]) for array in arrays)
    return len(set(re.findall(rf"\b(?:{names})\[(?:\d+ \* )?(?:stride \+ )?i\]", text)))


def columns(arrays, dtype, make):
    lengths = [len(array["entries"]) if "entries" in array else math.prod(array["shape"]) for array in arrays]
    return [make((length, STATES), dtype) for length in lengths]


def uniform(shape, dtype):
    return cupy.random.uniform(-3.0, 3.0, shape, dtype=dtype)


def filled_with_nan(shape, dtype):
    return cupy.full(shape, cupy.nan, dtype=dtype)


def differences(host, function, inputs, outputs):
    """The number of results at the first states with other bits than on the host, and the largest difference, relative to
    the function's largest output."""
    taken = [numpy.asarray(array[:, :COMPARED].get(), dtype=numpy.float64) for array in inputs]
    stated = getattr(host, function["name"])(*taken)
    stated = list(stated.values()) if isinstance(stated, dict) else [stated]
    found = [numpy.asarray(array[:, :COMPARED].get(), dtype=numpy.float64) for array in outputs]
    stated = numpy.concatenate([numpy.asarray(array).reshape(-1, COMPARED) for array in stated])
    found = numpy.concatenate(found)
    return int((stated.view("uint64") != found.view("uint64")).sum()), float(abs(stated - found).max() / abs(stated).max())


def measured(folder, robot, scalar, bandwidth):
    """Times every kernel of a package, with and without fused operations, and prints a row for each; returns whether the
    results in double precision without fused operations have the bits of the host."""
    package = folder / f"{robot}_{scalar}"
    header = (package / f"{robot}.cuh").read_text()
    dtype = {"f32": "float32", "f64": "float64"}[scalar]
    described = json.loads((package / "robot.json").read_text())
    sys.path.insert(0, str(folder / f"{robot}_python"))
    host = __import__(robot)
    same = True
    for fused in [False, True]:
        options = ("--std=c++17",) if fused else ("--std=c++17", "-fmad=false")
        module = cupy.RawModule(code=header, options=options)
        for function in described["functions"]:
            kernel = module.get_function(f"{robot}_{function['name']}_kernel")
            text = kernel_text(header, f"{robot}_{function['name']}")
            entries = touched(text, function["inputs"] + function["outputs"])
            inputs = columns(function["inputs"], dtype, uniform)
            outputs = columns(function["outputs"], dtype, filled_with_nan)
            times = []
            for threads in THREADS:
                arguments = (numpy.uint64(STATES), numpy.uint64(STATES), *inputs, *outputs)
                grid = ((STATES + threads - 1) // threads,)
                times.append(median_time(lambda: kernel(grid, (threads,), arguments)))
            assert not any(bool(cupy.isnan(array).any()) for array in outputs), "an output was not written"
            others, largest = differences(host, function, inputs, outputs)
            if scalar == "f64" and not fused:
                same &= others == 0
            # The host computes in double precision.
            others = others if scalar == "f64" else "-"
            seconds = times[THREADS.index(128)]
            bytes_of_state = entries * numpy.dtype(dtype).itemsize
            print(
                f"| {robot} | {function['name']} | {scalar} | {'yes' if fused else 'no'} | {STATES / seconds:.2e} | "
                f"{STATES / min(times):.2e} ({THREADS[times.index(min(times))]}) | {bytes_of_state} | "
                f"{bytes_of_state * STATES / seconds / bandwidth:.0%} | {kernel.num_regs} | "
                f"{kernel.local_size_bytes} | {others} | {largest:.1e} |",
                flush=True,
            )
            del inputs, outputs, arguments
            cupy.get_default_memory_pool().free_all_blocks()
    return same


def main():
    folder, robots = pathlib.Path(sys.argv[1]), sys.argv[2:]
    name = cupy.cuda.runtime.getDeviceProperties(0)["name"].decode()
    bandwidth = copy_bandwidth()
    print(f"{name}, {STATES} states; a copy reads and writes {bandwidth / 1e12:.2f} TB/s")
    print(
        "| robot | function | type | fused | states/s, 128 threads a block | best (threads) | bytes of a state | of the "
        "copy's bandwidth | registers | bytes of local memory | other bits | largest difference |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    same = [measured(folder, robot, scalar, bandwidth) for robot in robots for scalar in ["f32", "f64"]]
    return 0 if all(same) else 1


if __name__ == "__main__":
    sys.exit(main())
