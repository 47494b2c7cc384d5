"""Functions from record batches to record batches, for Spark, Ray, Polars and DuckDB."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ._function import Function
from ._native import RobotError


class BatchFunction:
    """A function over record batches, or whatever has Arrow's PyCapsule interface.

    A batch has a column for each input, named as it (`q`, `qd`, …): a list of constant length, or columns `q1` … of numbers. The result has a column of
    lists of fixed length for each output. It can be pickled: another process reads the robot file again.
    """

    def __init__(self, path: str, names: tuple[str, ...]) -> None:
        from ._robot import load

        self._path, self._names = path, names
        self._function: Function = load(path).function(*names)
        self._function._engine(None)

    def __reduce__(self) -> Any:
        return (BatchFunction, (self._path, self._names))

    def __call__(self, batch: Any) -> Any:
        """The outputs at the rows of a batch."""
        import pyarrow as pa

        if not isinstance(batch, (pa.RecordBatch, pa.Table)):
            batch = pa.table(batch) if hasattr(batch, "__arrow_c_stream__") else pa.record_batch(batch)
        is_table = isinstance(batch, pa.Table)
        inputs = {name: _column(batch, name, size) for name, size in self._function.inputs if not name.startswith("wrench")}
        results = self._function(**inputs)
        arrays = []
        for result in results if isinstance(results, tuple) else (results,):
            flat = pa.array(np.ascontiguousarray(result).reshape(-1))
            size = int(np.prod(result.shape[1:]))
            arrays.append(flat if result.ndim == 1 else pa.FixedSizeListArray.from_arrays(flat, size))
        names = [name for name, _ in self._function.outputs]
        return pa.table(arrays, names) if is_table else pa.record_batch(arrays, names)

    def batches(self, batches: Iterator[Any]) -> Iterator[Any]:
        """Over an iterator, as Spark's `mapInArrow` calls it."""
        return map(self, batches)


def _column(batch: Any, name: str, size: int) -> Any:
    """A column of lists as a table, or columns of numbers."""
    import pyarrow as pa

    known = batch.schema.names
    if name not in known:
        parts = [f"{name}{index + 1}" for index in range(size)]
        if missing := [part for part in parts if part not in known]:
            raise RobotError(f"the batch has no column `{name}`, and no {', '.join(missing)}; it has {', '.join(known)}")
        columns = [_numbers(batch.column(part), part) for part in parts]
        return np.stack(columns, axis=1)
    array = batch.column(name)
    if isinstance(array, pa.ChunkedArray):
        array = array.combine_chunks()
    kind = array.type
    if not (pa.types.is_fixed_size_list(kind) or pa.types.is_list(kind) or pa.types.is_large_list(kind)):
        raise RobotError(f"the column `{name}` has the type {kind}; it must be a list of {size} numbers")
    if array.null_count:
        raise RobotError(f"the column `{name}` has null rows")
    values = _numbers(array.flatten(), name)
    lengths_wrong = not pa.types.is_fixed_size_list(kind) and any(length != size for length in set(array.value_lengths().to_pylist()))
    if lengths_wrong or values.size != len(array) * size:
        raise RobotError(f"a row of the column `{name}` does not have {size} entries")
    return values.reshape(len(array), size)


def _numbers(array: Any, name: str) -> Any:
    if array.null_count:
        raise RobotError(f"the column `{name}` has nulls")
    return np.asarray(array.to_numpy(zero_copy_only=False) if not hasattr(array, "chunks") else array.to_numpy())
