"""The error message of a program when ROS 2, or a part of it, is not installed.

This module imports little, since every program checks for ROS 2 before any large import.
"""

import importlib.util

PACKAGE = "vehicle_roll_sim"
REMEDY = (
    "install ROS 2 (Jazzy or newer), source its setup.bash and use its Python; "
    f"only the command `{PACKAGE}` works without it"
)


def is_ros_installed() -> bool:
    """Whether rclpy can be found; it is not imported."""
    return importlib.util.find_spec("rclpy") is not None


def end_without_ros(program: str, error: ImportError | None = None) -> int:
    """Print one line on stderr on what is missing and how to install it; return the exit status.

    A failed import of this package's own modules is a bug, and is raised again.
    """
    from vehicle_roll_sim.arguments import exit_status
    from vehicle_roll_sim.declaration import InputError

    library = (error.name if error else "rclpy") or "rclpy"
    if library.partition(".")[0] == PACKAGE:
        raise error
    problem = f"no Python package {library}"
    if error and not isinstance(error, ModuleNotFoundError):
        problem = str(error).partition("\n")[0]  # such as one that was compiled for another Python

    def refuse() -> int:
        raise InputError("ROS 2", "", REMEDY, problem)

    return exit_status(refuse, program)
