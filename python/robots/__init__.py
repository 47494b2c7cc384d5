"""Equations of motion and dynamics of robots, from robot files (TOML or URDF).

``arm = robots.load("panda.urdf")`` reads a file; the functions of the robot are methods of ``arm``.
"""

from ._native import RobotError
from ._payload import Payload
from ._robot import Identification, Robot, load

__all__ = ["Identification", "Payload", "Robot", "RobotError", "load"]
