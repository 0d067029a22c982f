"""Compilation of the model, once, in a separate process that survives an interruption.

Programs that start at the same time on a fresh machine all wait for the same compilation. If one of
them is interrupted, the compiling process continues to its end (about 40 s).
"""

import subprocess
import sys
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.model.compiled import jit
from vehicle_roll_sim.model.frames import quaternion
from vehicle_roll_sim.model.integration.derivatives import derivatives_at
from vehicle_roll_sim.model.integration.events import no_events, note_lift_offs
from vehicle_roll_sim.model.records import OUTPUTS, STATE_SIZE, WHEEL_COUNT
from vehicle_roll_sim.model.road.banked_curve import advanced
from vehicle_roll_sim.model.road.layout import PLANE
from vehicle_roll_sim.model.road.surface import sample, surface
from vehicle_roll_sim.model.roll_plane import RollPlane
from vehicle_roll_sim.model.tire.radii import free_spin, loaded_radius
from vehicle_roll_sim.simulation.command import Command
from vehicle_roll_sim.simulation.driving import compile_actuators, compile_loop
from vehicle_roll_sim.simulation.plant import Plant
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.tire_evaluation import evaluate
from vehicle_roll_sim.vehicle.vehicle_file import preset

COMPILING = "compiling the model, once for this version: about 40 s"
LOCK = "lock"
"""The file that a compiling process locks; the operating system unlocks it when it ends."""
LOOK = 0.05
"""s: interval at which the compiling process is polled."""
COMPILE = f"""
import fcntl, os, sys
complete, sys.path[:] = sys.argv[1], sys.argv[2:]
folder = os.path.dirname(complete)
with open(os.path.join(folder, {LOCK!r}), "w") as lock:
    fcntl.flock(lock, fcntl.LOCK_EX)
    if not os.path.exists(complete):
        from vehicle_roll_sim.simulation.compilation import fill_cache
        fill_cache(folder)
"""
"""Most processes find the work done once they hold the lock, and then import nothing large."""


def compile_model(wait: Callable[[subprocess.Popen], None] = subprocess.Popen.wait) -> None:
    """Compile the model, or load it from the cache, before timing matters.

    Prints a line to stderr if it must be compiled. wait: function that waits for the compiling
    process; its exceptions propagate, and the process continues.
    """
    if compiling := begin_compiling():
        wait(compiling)
    Simulation(preset())


def begin_compiling() -> subprocess.Popen | None:
    """Have the model compiled in the background, by a process that nobody needs to wait for.

    Prints a line to stderr if it must be compiled. Returns the compiling process; None if there is
    nothing to compile, or no process can be started.
    """
    if not (jit.CACHE and jit.is_to_be_compiled()):
        return None
    print(COMPILING, file=sys.stderr, flush=True)
    return _compiling_process()


def _compiling_process() -> subprocess.Popen | None:
    """Start a compiling process in its own session, so that signals to this one do not reach it.

    Returns None if no process can be started.
    """
    if not sys.executable:
        return None
    complete = jit.CACHE / jit.code_cache.COMPLETE
    words = [sys.executable, "-c", COMPILE, str(complete), *sys.path]
    nothing = subprocess.DEVNULL
    try:
        return subprocess.Popen(
            words, stdin=nothing, stdout=nothing, stderr=nothing, start_new_session=True
        )
    except OSError:
        return None


def fill_cache(folder: str) -> None:
    """Compile the model in the compiling process, unless another one has done it already."""
    if jit.is_to_be_compiled() and str(jit.CACHE) == folder:
        call_every_kernel()
        jit.note_complete()


def call_every_kernel() -> None:
    """Call all kernels that the package calls from Python, so that none is left to be compiled.

    Those that others call as well come first.
    """
    simulation = Simulation(preset())
    simulation.reset()
    plant = Plant.of(simulation.vehicle, simulation.options).arguments()
    seen, rates = jit.kernel_argument(np.zeros(1, OUTPUTS)), np.zeros(STATE_SIZE)
    idle = jit.kernel_argument(Command().records())
    derivatives_at(simulation.state_vector.copy(), idle, plant, seen, rates, True)
    compile_actuators(simulation)
    compile_loop(simulation)
    Simulation(preset().with_values({"imu_period": 1.0}))
    evaluate(preset().tire, 1.0, 0.0, 0.0)
    tire = jit.kernel_argument(preset().tire.record())[0]
    loaded_radius(1.0, free_spin(1.0, 1.0, tire), 0.0, 0.0, 0.0, tire)
    surface(0.0, 0.0, PLANE)
    sample(np.zeros((1, 2)), PLANE, np.zeros((1, 3)))
    advanced(0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.01)
    RollPlane(preset().record())
    quaternion(0.0, 0.0, 0.0)
    note_lift_offs(0.0, 0.0, np.ones(WHEEL_COUNT), jit.kernel_argument(no_events())[0])
