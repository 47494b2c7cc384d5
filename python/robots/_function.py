"""Functions of a robot over arrays."""

from __future__ import annotations

import inspect
import operator
from collections.abc import Mapping
from typing import Any

import numpy as np

from ._native import Engine, Program, RobotError, RobotSource
from ._payload import Payload

# The number of sets of parameters for which a function keeps its compiled code.
_KEPT = 16


class Function:
    """A function of a robot, or several in one call.

    Inputs are arrays of the shape ``(entries,)`` for one state or ``(N, entries)`` for N states, of any layout, in f64 or f32. An input of one state is
    combined with each of the N states. The number 0 is used as an array of zeros, and a wrench that is omitted is 0. The calculation is in f64; the result
    has the type f32 if all arrays are f32.

    Parameters of the robot file are set for a call by name, ``m2=3.0``, or with ``parameters={"m2": 3.0}``; ``payload`` is the body that the robot
    carries, if its file has a `[payload]` table.
    """

    def __init__(self, source: RobotSource, names: list[str]) -> None:
        self._program: Program = source.program(names)
        self._engines: dict[tuple[tuple[str, float], ...], Engine] = {}
        self._nominal: Engine | None = None
        self._parameters = {name for name, _ in source.parameters()}
        self._payload = source.payload()
        self._robot = source.robot
        self.name = names[0] if len(names) == 1 else "joined"
        self.names = tuple(names)
        inputs, outputs = self._program.inputs(), self._program.outputs()
        self.inputs: list[tuple[str, int]] = [(name, size) for name, size, _, _ in inputs]
        self.outputs: list[tuple[str, tuple[int, ...]]] = [(name, tuple(shape)) for name, shape, _, _ in outputs]
        self.__doc__ = _documentation(self._program.doc, inputs, outputs)
        self.__name__ = self.name
        self.__signature__ = _signature(self.inputs)

    def __repr__(self) -> str:
        given = ", ".join(f"{name}[{size}]" for name, size in self.inputs)
        found = ", ".join(name + (str(list(shape)) if shape else "") for name, shape in self.outputs)
        return f"<{self.name}({given}) -> {found} of the robot {self._robot}>"

    def _engine(self, values: Mapping[str, float]) -> Engine:
        key = tuple(sorted(values.items()))
        found = self._engines.get(key)
        if found is None:
            found = self._program.compile(list(key))
            if len(self._engines) >= _KEPT:
                self._engines.pop(next(iter(self._engines)), None)
            self._engines[key] = found
        if not key:
            self._nominal = found
        return found

    def __call__(
        self,
        *given: Any,
        payload: Payload | None = None,
        parameters: Mapping[str, float] | None = None,
        out: Any = None,
        threads: int = 1,
        **named: Any,
    ) -> Any:
        """Computes the outputs at the states: an array, or a tuple of arrays if there are several outputs."""
        # A single state of f64, as in a control loop, is checked and computed in one native call.
        if self._nominal is not None and payload is None and parameters is None and out is None and not named and threads == 1:
            found = self._nominal.state(given)
            if found is not None:
                return found
        engine = self._engine(self._values(payload, parameters, named))
        arrays, single, states, dtype = self._arrays(given, named)
        shapes = [shape if single else (states, *shape) for _, shape in self.outputs]
        results = self._results(out, shapes, dtype)
        tables = []
        for result, (_, shape) in zip(results, self.outputs):
            size = int(np.prod(shape))
            fits = result.dtype == np.float64 and result.flags.aligned and (len(shape) == 1 or result.flags.c_contiguous)
            tables.append(result.reshape(states, size) if fits else np.empty((states, size)))
        if out is not None:
            # As in NumPy's own functions, an input must not change when an output in the same memory is written.
            arrays = [array.copy() if any(np.may_share_memory(array, table) for table in tables) else array for array in arrays]
        engine.call(arrays, tables, _count(threads))
        for result, table in zip(results, tables):
            if not np.may_share_memory(result, table):
                result[...] = table.reshape(result.shape)
        return self._one_or_all(results, out is not None)

    @staticmethod
    def _one_or_all(results: list[Any], keeps_arrays: bool) -> Any:
        if len(results) == 1:
            return results[0] if results[0].ndim or keeps_arrays else results[0][()]
        return tuple(results)

    def _values(self, payload: Payload | None, parameters: Mapping[str, float] | None, named: dict[str, Any]) -> dict[str, float]:
        """Returns the parameters that are set for a call, and removes parameters from the named arguments."""
        inputs = {name for name, _ in self.inputs}
        by_name = {name: named.pop(name) for name in list(named) if name in self._parameters and name not in inputs}
        if not by_name and payload is None and parameters is None:
            return {}
        if not isinstance(parameters, (Mapping, type(None))):
            raise RobotError(f"parameters must be values by name, not {parameters!r}")
        given = [dict(parameters or {}), by_name]
        if payload is not None:
            if not isinstance(payload, Payload):
                raise RobotError(f"payload must be a robots.Payload, not {payload!r}")
            if self._payload is None:
                message = "its file needs a table `[payload]` (`python -m robots import` makes such a file of a URDF file)"
                raise RobotError(f"the robot {self._robot} carries no payload: {message}")
            given.append(dict(zip(self._payload, payload.values())))
        values: dict[str, float] = {}
        for part in given:
            for name, value in part.items():
                if name in values:
                    raise RobotError(f"the parameter `{name}` is given twice")
                values[name] = _parameter(name, value)
        return values

    def _arrays(self, given: tuple[Any, ...], named: dict[str, Any]) -> Any:
        names = [name for name, _ in self.inputs]
        if len(given) > len(names):
            raise RobotError(f"{self.name} takes {len(names)} inputs ({', '.join(names)}), not {len(given)}")
        values = dict(zip(names, given))
        for name, value in named.items():
            if name not in names:
                raise RobotError(f"{self.name} has no input `{name}`; its inputs are {', '.join(names)}, and {self._robot} has no such parameter")
            if name in values:
                raise RobotError(f"the input `{name}` is given twice")
            values[name] = value
        if missing := [name for name in names if name not in values and not name.startswith("wrench")]:
            raise RobotError(f"{self.name} needs the input{'s' * (len(missing) > 1)} {', '.join(f'`{name}`' for name in missing)}")
        found, kinds = [], []
        for name, size in self.inputs:
            array = _array(name, values.get(name, 0), size)
            if array is None:
                array = np.zeros(size, np.float32)
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
            if array.dtype != np.float64 or not array.flags.aligned:
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
        for index, (array, shape) in enumerate(zip(given, shapes)):
            if not isinstance(array, np.ndarray) or array.dtype not in (np.float64, np.float32):
                raise RobotError("out must be an array of f64 or f32")
            if array.shape != shape:
                raise RobotError(f"out has the shape {array.shape}, not {shape}")
            if not array.flags.writeable:
                raise RobotError("out is read-only")
            if any(np.may_share_memory(array, other) for other in given[:index]):
                raise RobotError("the arrays of out overlap")
        return given


def _array(name: str, given: Any, size: int) -> Any:
    """Returns an input as an array of one or two dimensions, or None for the number 0."""
    try:
        array = np.asarray(given)
    except ValueError as error:
        raise RobotError(f"`{name}` is not an array: {error}") from None
    if np.any(getattr(given, "mask", False)):
        raise RobotError(f"`{name}` has masked entries, which have no value")
    if array.dtype.kind not in "fiu":
        raise RobotError(f"`{name}` must be an array of real numbers, not of {array.dtype}")
    if array.ndim == 0 and array == 0:
        return None
    if array.ndim not in (1, 2) or array.shape[-1] != size:
        raise RobotError(f"`{name}` has the shape {array.shape}; it must be ({size},) or (N, {size})")
    return array


def _parameter(name: str, given: Any) -> float:
    try:
        value = float(given)
    except (TypeError, ValueError):
        raise RobotError(f"the parameter `{name}` must be one number, not {given!r}; it holds for all states of a call") from None
    if not np.isfinite(value):
        raise RobotError(f"the parameter `{name}` must be a finite number, not {value}")
    return value


def _count(threads: Any) -> int:
    try:
        count = operator.index(threads)
    except TypeError:
        count = 0
    if count < 1:
        raise RobotError(f"threads must be a whole number of at least 1, not {threads!r}")
    return count


def _documentation(doc: str, inputs: list[tuple[str, int, str, str]], outputs: list[tuple[str, list[int], str, str]]) -> str:
    """Returns the function's own documentation, followed by the shapes of its arrays."""
    lines = [doc, "", "Inputs, for one state or (N, …) for N:"]
    lines += [_quantity(name, (size,), meaning, unit) for name, size, meaning, unit in inputs]
    lines += ["", "Outputs:"]
    lines += [_quantity(name, tuple(shape), meaning, unit) for name, shape, meaning, unit in outputs]
    return "\n".join(lines)


def _quantity(name: str, shape: tuple[int, ...], meaning: str, unit: str) -> str:
    text = f"- {name} {shape if shape else '()'}"
    text += f": {meaning}" if meaning else ""
    return text + (f", in {unit}" if unit else "")


def _signature(inputs: list[tuple[str, int]]) -> inspect.Signature:
    """Returns the signature that editors show."""
    kind = inspect.Parameter
    can_be_left = [name.startswith("wrench") for name, _ in inputs]
    known = [
        kind(name, kind.POSITIONAL_OR_KEYWORD, default=0 if all(can_be_left[index:]) else kind.empty) for index, (name, _) in enumerate(inputs)
    ]
    options = [kind(name, kind.KEYWORD_ONLY, default=default) for name, default in (("payload", None), ("parameters", None), ("out", None), ("threads", 1))]
    return inspect.Signature([*known, *options, kind("values", kind.VAR_KEYWORD)])
