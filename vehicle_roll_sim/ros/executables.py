"""The entry points of the executables: signal handlers are installed before any large import.

`python -m vehicle_roll_sim.ros.executables NAME` runs one as well.
"""

import importlib
import signal
import sys

from vehicle_roll_sim.ros import ending, missing


def simulator() -> int:
    return _run("simulator")


def manoeuvre() -> int:
    return _run("manoeuvre")


def recorder() -> int:
    return _run("recorder")


def demo() -> int:
    return _run("demo", 128 + signal.SIGINT)  # the shells' convention


def compare() -> int:
    return _run("compare", 128 + signal.SIGINT)


def _run(name: str, interrupted: int = 0) -> int:
    """Run the main function of a module in this folder; return the exit status.

    interrupted: exit status after a signal during the imports.
    """
    ending.at_once(interrupted)
    if not missing.is_ros_installed():
        return missing.end_without_ros(name)
    try:
        module = importlib.import_module(f"vehicle_roll_sim.ros.{name}")
    except ImportError as error:
        return missing.end_without_ros(name, error)
    return module.main()


if __name__ == "__main__":
    functions = {each.__name__: each for each in (simulator, manoeuvre, recorder, demo, compare)}
    sys.exit(functions[sys.argv.pop(1)]())
