"""The model is compiled once, by a process of its own that whoever waits for it may abandon.

Several programs that start together on a fresh machine wait for the same compilation, and one that
is interrupted loses nothing of it: the compiling process goes on to its end (15 to 30 s).
"""

import subprocess
import sys
from collections.abc import Callable

from vehicle_roll_sim.model.compiled import jit
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.vehicle_file import preset

COMPILING = "compiling the model, once for this version: up to 30 s"
LOCK = "lock"
"""The file that a compiling process locks; the system unlocks it when the process ends."""
LOOK = 0.05
"""s between two looks at the compiling process."""
COMPILE = f"""
import fcntl, os, sys
folder, sys.path[:] = sys.argv[1], sys.argv[2:]
with open(os.path.join(folder, {LOCK!r}), "w") as lock:
    fcntl.flock(lock, fcntl.LOCK_EX)
    from vehicle_roll_sim.simulation.compilation import fill_cache
    fill_cache(folder)
"""
"""Nothing large is imported before the lock is held: most who want it find the work done."""


def compile_model(wait: Callable[[subprocess.Popen], None] = subprocess.Popen.wait) -> None:
    """Have the model compiled, or read from the cache, before time matters; says so if it lasts.

    wait: waits for the compiling process; what it raises comes through, and the process goes on.
    """
    if jit.CACHE and jit.is_to_be_compiled():
        print(COMPILING, file=sys.stderr, flush=True)
        if compiling := _compiling_process():
            wait(compiling)
    Simulation(preset())


def _compiling_process() -> subprocess.Popen | None:
    """One that a signal to this process and its group does not reach; None where none can be."""
    if not sys.executable:
        return None
    words = [sys.executable, "-c", COMPILE, str(jit.CACHE), *sys.path]
    nothing = subprocess.DEVNULL
    try:
        return subprocess.Popen(
            words, stdin=nothing, stdout=nothing, stderr=nothing, start_new_session=True
        )
    except OSError:
        return None


def fill_cache(folder: str) -> None:
    """What the compiling process does: nothing if another one has been here before."""
    if jit.is_to_be_compiled() and str(jit.CACHE) == folder:
        Simulation(preset())
        jit.note_complete()
