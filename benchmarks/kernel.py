"""Computing time of the equations: a derivative in compiled code, and a step called from Python."""

import dataclasses
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np

from benchmarks.drive import SLIPS, evaluate, repeated, slalom, slalom_start
from benchmarks.report import MICRO, NANO, median
from vehicle_roll_sim import Command, Options, Road, Vehicle, load_tire, preset
from vehicle_roll_sim.declaration import OFF, ON
from vehicle_roll_sim.model.compiled.addresses import address_of
from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.integration.derivatives import derivatives_at
from vehicle_roll_sim.model.records import OUTPUTS, STATE_SIZE
from vehicle_roll_sim.simulation.plant import Plant

TITLE = "The model"
ABOUT = (
    "Derivative: evaluated in a compiled loop along a recorded slalom (20 m/s, 2° at 0.4 Hz, up to "
    "400 N m at each wheel, so that all four tires are in combined slip); a sample is the mean "
    "over its 2000 states. The variants are measured in turn; ratio: median of the ratios to the "
    "first one. Version 6.1: a tire file in which every coefficient counts, with and without "
    "tire moments. Roads: class B of ISO 8608, and a patch of friction under all wheels. "
    "Step: `Simulation.step` of 1 ms, called from Python with a constant "
    "command; a sample is the mean of 100 steps."
)
COLUMNS = {
    "what": "",
    "unit": "unit",
    "median": "median",
    "minimum": "minimum",
    "calls": "calls",
    "ratio": "ratio",
}
TORQUE = 400.0
"""N m"""
STATES = 2000
"""Recorded states, one every STEP: 10 s."""
STEP = 0.005
"""s"""
REPETITIONS, QUICK = 300, 30
STEPS = 100
"""Calls of `Simulation.step` per repetition."""
MODEL_1, MODEL_2 = Options(), Options(model="2")
MODELS = {
    **{f"model 1, {slip} slip": options for slip, options in SLIPS.items()},
    "model 2": MODEL_2,
    "8 DOF": Options(model="8dof"),
}
TIRE_6_1 = Path(__file__).parents[1] / "test/model/tire/data/mf61.tir"
WITH_TIRE_6_1 = {
    f"model 1, tire of 6.1 {moments}": Options(tire_moments=switch)
    for moments, switch in {"without moments": OFF, "with moments": ON}.items()
}

ON_ROADS = {
    "model 1, random road": (MODEL_1, {"kind": "random_profile", "start": 0.0}),
    "model 1, patch": (MODEL_1, {"kind": "patch", "start": 0.0, "friction": 0.8}),
    "model 2, random road": (MODEL_2, {"kind": "random_profile", "start": 0.0}),
}
"""Model and the only feature of the road."""


def measure(quick: bool) -> list[dict]:
    """Rows of the table."""
    repetitions = QUICK if quick else REPETITIONS
    other = dataclasses.replace(preset(), tire=load_tire(TIRE_6_1))
    calls = {name: derivatives_of(preset(), options) for name, options in MODELS.items()}
    calls |= {name: derivatives_of(other, options) for name, options in WITH_TIRE_6_1.items()}
    for name, (options, feature) in ON_ROADS.items():
        road = Road.from_values({"features": [feature]})
        calls[name] = derivatives_of(preset(), options, road)
    took = np.array([[repeated(call, 1)[0] for call in calls.values()] for _ in range(repetitions)])
    took /= STATES
    rows = [
        _row(f"derivative, {name}", "ns", times * NANO, STATES, median(times / took[:, 0]))
        for name, times in zip(calls, took.T, strict=True)
    ]
    for name, options in MODELS.items():
        took = step_times(options, repetitions)
        rows.append(_row(f"step of 1 ms, {name}", "µs", took * MICRO, STEPS))
    return rows


def _row(what: str, unit: str, took: np.ndarray, calls: int, ratio: float = math.nan) -> dict:
    return {
        "what": what,
        "unit": unit,
        "median": median(took),
        "minimum": float(took.min()),
        "calls": calls * len(took),
        "ratio": ratio,
    }


def driven_slalom(times: np.ndarray) -> np.ndarray:
    return slalom(times, TORQUE)


def derivatives_of(
    vehicle: Vehicle, options: Options, road: Road | None = None
) -> Callable[[], None]:
    """A function that evaluates the derivatives at all recorded states."""
    simulation = slalom_start(options, vehicle=vehicle, road=road)
    states, outputs = np.empty((STATES, STATE_SIZE)), np.empty(1, OUTPUTS)
    for row in states:
        simulation.step(driven_slalom, STEP)
        row[:] = simulation.state_vector
    outputs[0] = simulation.outputs
    commands = driven_slalom(STEP * np.arange(1, STATES + 1))
    plant, rates = Plant.of(vehicle, options, road).arguments(), np.empty(STATE_SIZE)
    parts = (plant, kernel_argument(outputs), rates)
    first = (states[0], commands[:1], *parts, False)
    derivatives_at(*first)
    arguments = (address_of(derivatives_at, first), states, commands, *parts)
    evaluate(*arguments)  # compiles
    return lambda: evaluate(*arguments)


def step_times(options: Options, repetitions: int) -> np.ndarray:
    """Time per step (s), shape (repetitions,); each is the mean over STEPS steps."""
    simulation, command = slalom_start(options), Command(steering=0.02)

    def some_steps():
        for _ in range(STEPS):
            simulation.step(command, 1e-3)

    return repeated(some_steps, repetitions) / STEPS
