"""What a program says where ROS 2, or a part of it, is not installed.

It imports little: every program runs it before its signal handlers are installed.
"""

import importlib.util

PACKAGE = "vehicle_roll_sim"
REMEDY = (
    "install ROS 2 (Jazzy or newer), source its setup.bash and use its Python; "
    f"`{PACKAGE}` itself needs none of it"
)


def is_ros_installed() -> bool:
    """Whether there is a rclpy on the path; it is not imported."""
    return importlib.util.find_spec("rclpy") is not None


def end_without_ros(program: str, error: ImportError | None = None) -> int:
    """Say in one line on stderr what is missing and what to install; the exit status.

    An import of this package's own that fails is a fault and raised again.
    """
    from vehicle_roll_sim.arguments import exit_status
    from vehicle_roll_sim.declaration import InputError

    library = (error.name if error else "rclpy") or "rclpy"
    if library.partition(".")[0] == PACKAGE:
        raise error
    problem = f"no Python package {library}"
    if error and not isinstance(error, ModuleNotFoundError):
        problem = str(error).partition("\n")[0]  # such as one that another Python compiled

    def refuse() -> int:
        raise InputError("ROS 2", "", REMEDY, problem)

    return exit_status(refuse, program)
