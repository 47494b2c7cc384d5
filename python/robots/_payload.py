"""Bodies that robots carry."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._native import RobotError

_AXES = {"xx": (0, 0), "yy": (1, 1), "zz": (2, 2), "xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}


@dataclass(frozen=True)
class Payload:
    """A body that a robot carries: `arm.gravity(q, payload=robots.Payload(2.0, [0, 0, 0.1]))`.

    `mass` is in kg; `center_of_mass` is in m, in the frame that the `[payload]` table of the robot file names. `inertia` is the tensor about the center of
    mass in the axes of that frame, in kg m²: xx, yy, zz, xy, xz, yz, or three rows of three numbers. By default the body is a point mass.
    """

    mass: float
    center_of_mass: Any = (0.0, 0.0, 0.0)
    inertia: Any = (0.0,) * 6

    def values(self) -> list[float]:
        """Returns mass, center of mass and inertia as ten numbers."""
        parts = [_numbers("mass", self.mass, ()), _numbers("center_of_mass", self.center_of_mass, (3,))]
        if np.shape(self.inertia) == (3, 3):
            tensor = _numbers("inertia", self.inertia, (3, 3))
            if not np.array_equal(tensor, tensor.T):
                raise RobotError("the payload's inertia is not symmetric")
            parts.append(np.array([tensor[place] for place in _AXES.values()]))
        else:
            parts.append(_numbers("inertia", self.inertia, (6,)))
        return [float(value) for part in parts for value in part.ravel()]


def _numbers(what: str, given: Any, shape: tuple[int, ...]) -> Any:
    try:
        array = np.asarray(given, np.float64)
    except (TypeError, ValueError):
        raise RobotError(f"the payload's {what} must be numbers, not {given!r}") from None
    if array.shape != shape:
        wanted = "a number" if not shape else " or ".join(["6 numbers", "3 rows of 3"] if what == "inertia" else ["3 numbers"])
        raise RobotError(f"the payload's {what} must be {wanted}; it has the shape {array.shape}")
    return array
