"""Accuracy against cost: position error after a slalom and computing time, by integration step."""

import math
from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.drive import SLIPS, SPEED, repeated, slalom, slalom_start
from benchmarks.report import MILLI, median
from vehicle_roll_sim import Condition, Options, preset
from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.integration.derivatives import derivatives_at
from vehicle_roll_sim.model.records import OUTPUTS, STATE_SIZE
from vehicle_roll_sim.simulation.plant import Plant

TITLE = "Work and precision"
ABOUT = (
    "Slalom at 20 m/s, wheels rolling freely, front steering 2° sin(2π t / 2.5 s). Error: distance "
    "of the c.g. from its position in a reference solution (SciPy's DOP853 on the same derivative, "
    "relative tolerance 1e-12). Wall time: median for 10 s of driving in one call of "
    "`Simulation.step`, with the steering of every stage evaluated beforehand. The error of the "
    "reference itself is its distance from a solution with a tolerance of 1e-10."
)
COLUMNS = {
    "slip": "slip",
    "method": "method",
    "error_10s_m": "error at 10 s (m)",
    "error_20s_m": "error at 20 s (m)",
    "wall_ms": "wall time of 10 s (ms)",
    "times_real_time": "times real time",
}
STEPS_MS = (10.0, 5.0, 2.5, 2.0, 1.0, 0.5)
HALF, WHOLE = 10.0, 20.0
"""s"""
REPETITIONS, QUICK = 25, 3
TOLERANCES = (1e-12, 1e-10)
SMALLEST = 1e-14
"""Absolute tolerance of the reference solution, in the unit of each state."""


def measure(quick: bool) -> list[dict]:
    """Rows of the table."""
    rows = []
    for slip, options in SLIPS.items():
        reference, rougher = (reference_positions(options, each) for each in TOLERANCES)
        own = np.linalg.norm(rougher - reference, axis=1)
        rows.append(_row(slip, "reference", own, math.nan))
        for step_ms in STEPS_MS:
            step = step_ms / MILLI
            error = np.linalg.norm(positions(options, step) - reference, axis=1)
            wall = median(wall_times(options, step, QUICK if quick else REPETITIONS))
            rows.append(_row(slip, f"RK4, {step_ms:g} ms", error, wall))
    return rows


def _row(slip: str, method: str, error: np.ndarray, wall: float) -> dict:
    return {
        "slip": slip,
        "method": method,
        "error_10s_m": float(error[0]),
        "error_20s_m": float(error[1]),
        "wall_ms": wall * MILLI,
        "times_real_time": HALF / wall,
    }


def reference_positions(options: Options, tolerance: float) -> np.ndarray:
    """x and y of the c.g. (m) at both times, shape (2, 2), from another integrator."""
    start = slalom_start(options).state_vector.copy()
    known = np.isfinite(start)
    parts, outputs = Plant.of(preset(), options).arguments(), kernel_argument(np.zeros(1, OUTPUTS))
    state, rates = start.copy(), np.empty(STATE_SIZE)

    def derivative(time: float, values: np.ndarray) -> np.ndarray:
        state[known] = values
        command = slalom(np.array([time]))
        derivatives_at(state, command, parts, outputs, rates, False)
        return rates[known]

    times = (HALF, WHOLE)
    solution = solve_ivp(
        derivative,
        (0.0, WHOLE),
        start[known],
        method="DOP853",
        t_eval=times,
        rtol=tolerance,
        atol=SMALLEST,
    )
    return solution.y[:2].T


def prepared(step: float, begin: float) -> Callable[[np.ndarray], np.ndarray]:
    """The steering for 10 s from `begin` (s), evaluated in advance for every stage."""
    stages = 2 * round(HALF / step) + 1
    halves = np.arange(stages) * round(step * NANOSECONDS / 2) / NANOSECONDS
    commands = slalom(begin + halves)
    return lambda times: commands


def positions(options: Options, step: float) -> np.ndarray:
    """x and y of the c.g. (m) at both times, shape (2, 2); nan if the run has stopped by then."""
    simulation = slalom_start(options, step)
    found = []
    for begin in (0.0, HALF):
        simulation.step(prepared(step, begin), HALF)
        runs = simulation.condition is Condition.RUNNING
        found.append([simulation.state["x"], simulation.state["y"]] if runs else [math.nan] * 2)
    return np.array(found)


def wall_times(options: Options, step: float, repetitions: int) -> np.ndarray:
    """Wall times (s) of 10 s of driving."""
    simulation, programme = slalom_start(options, step), prepared(step, 0.0)
    return repeated(
        lambda: simulation.step(programme, HALF),
        repetitions,
        prepare=lambda: simulation.reset(SPEED),
    )
