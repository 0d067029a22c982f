"""Steps per second of the gymnasium environment, one by one and together."""

import time

import gymnasium
import numpy as np

import vehicle_roll_sim.learning  # noqa: F401  registers the environment
from benchmarks.report import MICRO, median

TITLE = "Reinforcement learning"
ABOUT = (
    "Calls of `step` of `VehicleRoll-v0` with its defaults (fishhook, four brakes, periods of "
    "10 ms in four integration steps), without an agent. A step counts once for each environment. "
    "Single: one environment; sync: gymnasium's SyncVectorEnv; together: this package's vector "
    "environment. Medians over repetitions of 100 calls, resets left out."
)
COLUMNS = {
    "what": "",
    "environments": "environments",
    "threads": "threads",
    "steps_per_s": "steps per second",
    "step_us": "µs per step",
}
SYNC = {"vectorization_mode": "sync"}
KINDS = {
    "single": (1, 1, None),
    "sync": (64, 1, SYNC),
    "together": (64, 1, {"workers": 1}),
    "together, two threads": (64, 2, {"workers": 2}),
    "together, many": (512, 2, {"workers": 2}),
}
"""Number of environments and of threads, and arguments of `make_vec`, None for a single one."""
CALLS, REPETITIONS, QUICK = 100, 9, 3


def measure(quick: bool) -> list[dict]:
    """Rows of the table."""
    rows = []
    for what, (count, threads, arguments) in KINDS.items():
        seconds = _seconds(count, arguments, QUICK if quick else REPETITIONS) / (count * CALLS)
        row = {"what": what, "environments": count, "threads": threads}
        rows.append(row | {"steps_per_s": 1.0 / seconds, "step_us": seconds * MICRO})
    return rows


def _seconds(count: int, arguments: dict | None, repetitions: int) -> float:
    """Wall time of CALLS calls: the median."""
    name = "VehicleRoll-v0"
    one = arguments is None
    env = gymnasium.make(name).unwrapped if one else gymnasium.make_vec(name, count, **arguments)
    actions = np.zeros(env.action_space.shape, np.float32)
    found = []
    for _ in range(repetitions):
        env.reset(seed=0)
        begun = time.perf_counter()
        for _ in range(CALLS):
            env.step(actions)
        found.append(time.perf_counter() - begun)
    env.close()
    return median(found)
