"""Runs the command within this process and returns its output as text."""

from ._native import RobotError, command


def run(arguments: list[str], allowed: tuple[int, ...] = (0,)) -> str:
    """Returns the standard output of the command; raises RobotError with its messages if it fails."""
    code, output, errors = command(arguments, b"")
    if code not in allowed:
        raise RobotError(errors.decode().strip())
    return output.decode()
