"""Processes of a benchmark: ended by their ids whatever happens, and looked at from outside."""

import contextlib
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from vehicle_roll_sim.ros.orchestration.demo import LOCAL, stop

SIMULATOR = "vehicle_roll_sim.ros.simulator.node"
ENDING = (signal.SIGINT, signal.SIGTERM)
"""What ends the benchmarks, and with them their processes."""
TICKS = os.sysconf("SC_CLK_TCK")
"""Of processor time in a second."""
MEBI = 1024.0
"""KiB in a MiB."""


@contextlib.contextmanager
def signals_held() -> Iterator[None]:
    """Ctrl-C and SIGTERM are noted, and raised at the end: no process is lost half started."""
    noted = []
    usual = {signum: signal.signal(signum, lambda *_: noted.append(True)) for signum in ENDING}
    try:
        yield
    finally:
        for signum, handler in usual.items():
            signal.signal(signum, handler)
    if noted:
        raise KeyboardInterrupt


@contextlib.contextmanager
def running(
    module: str, *words: str, domain: int, environment: dict[str, str] | None = None
) -> Iterator[subprocess.Popen]:
    """A module as a process in a ROS domain, for as long as the block lasts.

    A TimeoutError of the block is raised with what the process said last.
    """
    process = None
    where = LOCAL | os.environ | {"ROS_DOMAIN_ID": str(domain)} | (environment or {})
    with tempfile.TemporaryFile("w+") as said:
        try:
            with signals_held():
                process = subprocess.Popen(
                    [sys.executable, "-m", module, *words],
                    env=where,
                    start_new_session=True,
                    stdout=said,
                    stderr=said,
                )
            yield process
        except TimeoutError as error:
            said.seek(0)
            last = ([module, *said.read().splitlines()])[-1]
            raise TimeoutError(f"{error}; {module} said: {last}") from None
        finally:
            if process:
                with signals_held():
                    stop(process)


def simulator(domain: int, *parameters: str, environment: dict[str, str] | None = None):
    """A simulator with parameters given as NAME:=VALUE, as `running` has it."""
    words = [word for each in parameters for word in ("-p", each)]
    return running(SIMULATOR, "--ros-args", *words, domain=domain, environment=environment)


def processor_seconds(pid: int) -> float:
    """Time that a process has had on processors, its own and the system's for it (s)."""
    text = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8")
    user, system = text.rpartition(")")[2].split()[11:13]
    return (int(user) + int(system)) / TICKS


def peak_memory(pid: int) -> float:
    """Most memory that a process has had so far (MiB)."""
    lines = Path(f"/proc/{pid}/status").read_text(encoding="utf-8").splitlines()
    (size,) = (line.split()[1] for line in lines if line.startswith("VmHWM:"))
    return int(size) / MEBI
