"""The executable `demo`, run by `make run`: drives and records a J-turn with a live simulator."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

from vehicle_roll_sim.arguments import OneLineParser, exit_status
from vehicle_roll_sim.bags import need_library
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.ros import signals
from vehicle_roll_sim.runs.summary import line
from vehicle_roll_sim.simulation.compilation import compile_model

PATIENCE = 10.0
"""Time (s) that a process may take to end."""
POLL = 0.05
"""s"""
ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""Signals that end the demonstration, and with it the nodes."""


LOCAL = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
"""Default environment of the nodes: discovery stays on this machine."""


def start(module: str, *words: str, **options) -> subprocess.Popen:
    """Start a node of this package in its own session, out of reach of Ctrl-C."""
    command = [sys.executable, "-m", "vehicle_roll_sim.ros.executables", module, *words]
    environment = LOCAL | os.environ
    return subprocess.Popen(command, env=environment, start_new_session=True, **options)


def stop(process: subprocess.Popen) -> int:
    """End a node, even if it is still starting; return its exit status."""
    if process.poll() is None:
        process.terminate()
    try:
        return process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        process.kill()
        return process.wait()


def demonstrate(folder: Path) -> int:
    """Run simulator, recorder and manoeuvre until the manoeuvre is over; return the exit status."""
    need_library("recorder")
    bag, plot = folder / "bag", folder / "j_turn.png"
    try:
        folder.mkdir(parents=True)
    except OSError as error:
        problem = f"{folder}: {error.strerror}"
        raise InputError(
            "--output", str(folder), "a new folder that can be created", problem
        ) from None
    compile_model()
    interrupted = threading.Event()
    # only set an event: an exception could lose a node between its start and its entry in the list
    for signum in signals.not_ignored(ENDING):
        signal.signal(signum, lambda *_: interrupted.set())
    nodes, statuses = [], []
    try:
        nodes.append(start("simulator"))
        nodes.append(start("recorder", "--output", str(bag), stdout=subprocess.PIPE, text=True))
        nodes[-1].stdout.readline()  # printed once it is recording
        print("a J-turn at 50 km/h, in real time:", flush=True)
        driver = start("manoeuvre", "j_turn", "--plot", str(plot))
        nodes.append(driver)
        while driver.poll() is None and not interrupted.is_set():
            interrupted.wait(POLL)
    finally:
        statuses += [stop(node) for node in reversed(nodes)]
    if interrupted.is_set():
        raise KeyboardInterrupt
    if any(statuses):
        return 1
    print(line("bag", bag))
    return 0


def main() -> int:
    """Entry point of the executable."""
    parser = OneLineParser(
        prog="demo",
        description="Start a simulator, drive it through a J-turn in real time and record a bag.",
    )
    parser.add_argument(
        "--output",
        metavar="DIR",
        default=time.strftime("run/%Y-%m-%d-%H%M%S"),
        help="folder for the bag and the plot; must not exist yet (default: run/DATE-TIME)",
    )

    def command() -> int:
        return demonstrate(Path(parser.parse_args().output))

    return exit_status(command, parser.prog)


if __name__ == "__main__":
    sys.exit(main())
