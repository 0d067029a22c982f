"""Processes of a benchmark: always ended, and observed from outside."""

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
"""Signals that end the benchmarks, and with them their processes."""
TICKS = os.sysconf("SC_CLK_TCK")
"""Clock ticks of CPU time per second."""
MEBI = 1024.0
"""KiB in a MiB."""


@contextlib.contextmanager
def signals_held() -> Iterator[None]:
    """Defer SIGINT and SIGTERM to the end of the block: no process is started and then lost."""
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
    """Run a module as a process in a ROS domain for the duration of the block.

    A TimeoutError in the block is raised again with the last output line of the process.
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
    """Run a simulator (see `running`). parameters: NAME:=VALUE each."""
    words = [word for each in parameters for word in ("-p", each)]
    return running(SIMULATOR, "--ros-args", *words, domain=domain, environment=environment)


def processor_seconds(pid: int) -> float:
    """CPU time of a process so far, user and system (s)."""
    text = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8")
    user, system = text.rpartition(")")[2].split()[11:13]
    return (int(user) + int(system)) / TICKS


def peak_memory(pid: int) -> float:
    """Peak resident memory of a process so far (MiB)."""
    lines = Path(f"/proc/{pid}/status").read_text(encoding="utf-8").splitlines()
    (size,) = (line.split()[1] for line in lines if line.startswith("VmHWM:"))
    return int(size) / MEBI
