"""The entry points of the executables: signal handlers are installed before any large import.

`python -m vehicle_roll_sim.ros.executables NAME` runs one as well.
"""

import sys

from vehicle_roll_sim import early_signals

INTERRUPTED = 130
"""Exit status of a command after Ctrl-C (the convention of shells)."""

MODULES = {
    "simulator": "simulator.node",
    "manoeuvre": "clients.manoeuvre",
    "recorder": "clients.recorder",
    "live_view": "clients.live_view",
    "demo": "orchestration.demo",
    "compare": "orchestration.compare",
}
"""Where the main function of each executable is."""


def simulator() -> int:
    return _run("simulator")


def manoeuvre() -> int:
    return _run("manoeuvre")


def recorder() -> int:
    return _run("recorder")


def live_view() -> int:
    return _run("live_view")


def demo() -> int:
    return _run("demo", INTERRUPTED)


def compare() -> int:
    return _run("compare", INTERRUPTED)


def _run(name: str, interrupted: int = 0) -> int:
    """Run the main function of an executable; return the exit status.

    interrupted: exit status after a signal during the imports.
    """
    early_signals.end_node_at_once(interrupted, even_ignored=not interrupted)
    import importlib

    from vehicle_roll_sim.ros import availability

    if not availability.is_ros_installed():
        return availability.end_without_ros(name)
    try:
        module = importlib.import_module(f"vehicle_roll_sim.ros.{MODULES[name]}")
    except ImportError as error:
        return availability.end_without_ros(name, error)
    return module.main()


if __name__ == "__main__":
    entries = (simulator, manoeuvre, recorder, live_view, demo, compare)
    sys.exit({each.__name__: each for each in entries}[sys.argv.pop(1)]())
