"""Functions from record batches to record batches, for Spark, Ray, Polars and DuckDB."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ._function import Function
from ._native import RobotError


OUTPUTS = ("fixed_lists", "lists", "columns")


class BatchFunction:
    """A function over record batches, or over tables of any library with Arrow's PyCapsule interface.

    For each input (`q`, `qd`, …), a batch has a column of that name with lists of constant length, or columns `q1` … of numbers. The result has the
    columns of the batch that `keep` names, and then the outputs. For each output, `output` selects a column of lists of fixed length ("fixed_lists"), a
    column of lists of any length ("lists", which Spark needs), or columns of numbers `tau1` … ("columns"). The function can be pickled: another process
    reads the robot file again.
    """

    def __init__(self, path: str, names: tuple[str, ...], options: dict[str, bool], output: str, keep: tuple[str, ...]) -> None:
        from ._robot import load

        if output not in OUTPUTS:
            raise RobotError(f"output must be one of {', '.join(OUTPUTS)}, not {output!r}")
        self._given = (path, names, options, output, keep)
        self._output, self._keep = output, keep
        self._function: Function = load(path, **options).function(*names)

    def __reduce__(self) -> Any:
        return (BatchFunction, self._given)

    def __call__(self, batch: Any) -> Any:
        """Computes the outputs at the rows of a batch."""
        import pyarrow as pa

        if not isinstance(batch, (pa.RecordBatch, pa.Table)):
            batch = pa.table(batch) if hasattr(batch, "__arrow_c_stream__") else pa.record_batch(batch)
        inputs = {name: _column(batch, name, size) for name, size in self._function.inputs if not name.startswith("wrench")}
        results = self._function(**inputs)
        columns = {}
        for name in self._keep:
            if name not in batch.schema.names:
                raise RobotError(f"the batch has no column `{name}` to keep; it has {', '.join(batch.schema.names)}")
            columns[name] = batch.column(name)
        for (name, _), result in zip(self._function.outputs, results if isinstance(results, tuple) else (results,)):
            found = self._columns(name, result)
            if both := sorted(columns.keys() & found.keys()):
                raise RobotError(f"`{both[0]}` is a column of the result and cannot be kept beside it")
            columns |= found
        made = pa.table if isinstance(batch, pa.Table) else pa.record_batch
        return made(list(columns.values()), list(columns))

    def _columns(self, name: str, result: Any) -> dict[str, Any]:
        import pyarrow as pa

        if result.ndim == 1:
            return {name: pa.array(result)}
        table = result.reshape(len(result), int(np.prod(result.shape[1:])))
        if self._output == "columns":
            return {f"{name}{index + 1}": pa.array(np.ascontiguousarray(table[:, index])) for index in range(table.shape[1])}
        flat, size = pa.array(np.ascontiguousarray(table).reshape(-1)), table.shape[1]
        if self._output == "fixed_lists":
            return {name: pa.FixedSizeListArray.from_arrays(flat, size)}
        if flat.nbytes // 8 > np.iinfo(np.int32).max:
            raise RobotError(f"`{name}` has too many entries for one column of lists; give smaller batches")
        return {name: pa.ListArray.from_arrays(np.arange(0, (len(table) + 1) * size, size, dtype=np.int32), flat)}

    def batches(self, batches: Iterator[Any]) -> Iterator[Any]:
        """Computes the outputs for each batch of an iterator, as Spark's `mapInArrow` needs it."""
        return map(self, batches)


def _column(batch: Any, name: str, size: int) -> Any:
    """Returns an input as a table, from a column of lists or from columns of numbers."""
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
