"""Functions of a robot over arrays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ._native import Engine, Program, RobotError, RobotSource


class Function:
    """A function of a robot, or several in one call.

    Inputs are arrays of the shape ``(entries,)`` for one state or ``(N, entries)`` for N, of any layout, in f64 or f32; an input of one
    state goes with each of N states. An input that is 0 may be the number 0; a wrench that is left out is 0. The result has the type f32 if all arrays are f32; the
    calculation is in f64.
    """

    def __init__(self, source: RobotSource, names: list[str]) -> None:
        self._program: Program = source.program(names)
        self._engines: dict[tuple[tuple[str, float], ...], Engine] = {}
        self.name = names[0] if len(names) == 1 else "joined"
        self.names = tuple(names)
        self.__doc__ = self._program.doc
        self._nominal: Engine | None = None
        self.inputs: list[tuple[str, int]] = []
        self.outputs: list[tuple[str, tuple[int, ...]]] = []

    def _engine(self, parameters: Mapping[str, float] | None) -> Engine:
        if parameters is None and self._nominal is not None:
            return self._nominal
        key = tuple(sorted((name, float(value)) for name, value in (parameters or {}).items()))
        found = self._engines.get(key)
        if found is None:
            if any(not np.isfinite(value) for _, value in key):
                raise RobotError("a parameter must be a finite number")
            found = self._program.compile(list(key))
            if len(self._engines) >= 16:
                self._engines.pop(next(iter(self._engines)))
            self._engines[key] = found
            self.inputs = found.inputs()
            self.outputs = [(name, tuple(shape)) for name, shape in found.outputs()]
        if not key:
            self._nominal = found
        return found

    def __call__(
        self,
        *given: Any,
        parameters: Mapping[str, float] | None = None,
        out: Any = None,
        threads: int = 1,
        **named: Any,
    ) -> Any:
        """Computes the outputs at the states: an array, or a tuple of arrays if there are several outputs."""
        # One state of f64, which is what control loops have, is checked and computed at once.
        if self._nominal is not None and parameters is None and out is None and not named and threads == 1:
            results = [np.empty(shape) for _, shape in self.outputs]
            # A number has no shape that a buffer could state.
            if self._nominal.state(given, [result if result.ndim else result.reshape(1) for result in results]):
                return self._one_or_all(results, False)
        engine = self._engine(parameters)
        arrays, single, states, dtype = self._arrays(given, named)
        shapes = [shape if single else (states, *shape) for _, shape in self.outputs]
        results = self._results(out, shapes, dtype)
        tables = []
        for result, (_, shape) in zip(results, self.outputs):
            size = int(np.prod(shape))
            fits = result.dtype == np.float64 and (len(shape) == 1 or result.flags.c_contiguous)
            tables.append(result.reshape(states, size) if fits else np.empty((states, size)))
        if not isinstance(threads, int) or threads < 1:
            raise RobotError(f"threads must be a whole number of at least 1, not {threads!r}")
        engine.call(arrays, tables, threads)
        for result, table in zip(results, tables):
            if not np.may_share_memory(result, table):
                result[...] = table.reshape(result.shape)
        return self._one_or_all(results, out is not None)

    @staticmethod
    def _one_or_all(results: list[Any], keeps_arrays: bool) -> Any:
        if len(results) == 1:
            return results[0] if results[0].ndim or keeps_arrays else results[0][()]
        return tuple(results)

    def _arrays(self, given: tuple[Any, ...], named: dict[str, Any]) -> Any:
        names = [name for name, _ in self.inputs]
        if len(given) > len(names):
            raise RobotError(f"{self.name} takes {len(names)} inputs ({', '.join(names)}), not {len(given)}")
        values = dict(zip(names, given))
        for name, value in named.items():
            if name not in names:
                raise RobotError(f"{self.name} has no input `{name}`; its inputs are {', '.join(names)}")
            if name in values:
                raise RobotError(f"the input `{name}` is given twice")
            values[name] = value
        found, kinds = [], []
        for name, size in self.inputs:
            if name not in values and not name.startswith("wrench"):
                raise RobotError(f"{self.name} needs the input `{name}`")
            array = np.asarray(values.get(name, 0))
            if array.dtype.kind not in "fiu":
                raise RobotError(f"`{name}` must be an array of real numbers, not of {array.dtype}")
            if array.ndim == 0 and array == 0:
                array = np.zeros(size, np.float32)
            elif array.ndim not in (1, 2) or array.shape[-1] != size:
                raise RobotError(f"`{name}` has the shape {array.shape}; it must be ({size},) or (N, {size})")
            else:
                kinds.append(array.dtype)
            found.append(array)
        single = all(array.ndim == 1 for array in found)
        counts = {array.shape[0] for array in found if array.ndim == 2}
        if len(counts) > 1:
            raise RobotError(f"the inputs differ in their numbers of states: {sorted(counts)}")
        states = counts.pop() if counts else 1
        tables = []
        for array in found:
            if array.dtype != np.float64:
                array = array.astype(np.float64)
            tables.append(array[None, :] if single else np.broadcast_to(array, (states, array.shape[-1])))
        narrow = bool(kinds) and all(kind == np.float32 for kind in kinds)
        return tables, single, states, np.float32 if narrow else np.float64

    def _results(self, out: Any, shapes: list[tuple[int, ...]], dtype: Any) -> list[Any]:
        if out is None:
            return [np.empty(shape, dtype) for shape in shapes]
        given = list(out) if isinstance(out, (tuple, list)) else [out]
        if len(given) != len(shapes):
            raise RobotError(f"out must have {len(shapes)} arrays, not {len(given)}")
        for array, shape in zip(given, shapes):
            if not isinstance(array, np.ndarray) or array.dtype not in (np.float64, np.float32):
                raise RobotError("out must be an array of f64 or f32")
            if array.shape != shape:
                raise RobotError(f"out has the shape {array.shape}, not {shape}")
            if not array.flags.writeable:
                raise RobotError("out is read-only")
        return given
