"""The sine of rising frequency, and the response, which the linear model has in closed form."""

import dataclasses
import math

import numpy as np
import pytest

from vehicle_roll_sim import Options, Simulation, preset
from vehicle_roll_sim.analysis.linear_model import linearize
from vehicle_roll_sim.analysis.trim import find_trim
from vehicle_roll_sim.manoeuvres.driving import history_of
from vehicle_roll_sim.manoeuvres.swept_steer import SWEPT_STEER, frequency_response
from vehicle_roll_sim.runs.columns import COLUMNS
from vehicle_roll_sim.runs.history import History

SMALL = 0.02
"""deg: the tires stay linear to a thousandth."""
LOWEST, HIGHEST = 0.3, 2.8
"""Hz, within the sweep: at its ends the steering has little of any frequency."""
ACCURACY = 0.01
"""Of the largest response: the spectrum of the sweep ripples, and samples are 10 ms apart."""


@pytest.fixture(scope="module")
def driven():
    manoeuvre = dataclasses.replace(SWEPT_STEER, amplitude=SMALL)
    simulation = Simulation(preset())
    simulation.reset(manoeuvre.speed)
    ready = manoeuvre.for_vehicle(simulation.vehicle, Options())
    return history_of(simulation, ready.driver(), ready.duration)


@pytest.mark.parametrize("name", ["roll", "yaw_rate", "lateral_acceleration"])
def test_the_response_of_a_small_sweep_is_that_of_the_linear_model(driven, name):
    model = linearize(find_trim(preset(), speed=SWEPT_STEER.speed))
    row, column = model.output_names.index(name), model.input_names.index("steering")
    frequencies, found = frequency_response(driven, name)
    expected = []
    for frequency in frequencies:
        inverse = np.linalg.solve(
            2j * math.pi * frequency * np.eye(len(model.a)) - model.a, model.b[:, column]
        )
        expected.append(model.c[row] @ inverse + model.d[row, column])
    within = (frequencies > LOWEST) & (frequencies < HIGHEST)
    apart = np.abs(found - expected)[within]
    assert apart.max() < ACCURACY * np.abs(expected)[within].max()


def test_the_frequency_rises_from_the_lowest_to_the_highest_and_ends_at_rest():
    times = np.linspace(0.0, SWEPT_STEER.duration, 190_001)
    ready = dataclasses.replace(SWEPT_STEER, speed_hold=0.0)
    angle = np.degrees(ready(times)["steering"])
    assert np.abs(angle).max() == pytest.approx(0.5, rel=1e-6)
    begin, end = SWEPT_STEER.start, SWEPT_STEER.start + SWEPT_STEER.sweep
    assert not angle[(times < begin) | (times >= end)].any()
    crossed = np.flatnonzero(np.diff(np.sign(angle)) != 0)
    crossings = times[crossed][(times[crossed] > begin + 0.1) & (times[crossed] < end - 0.01)]
    low, high = SWEPT_STEER.lowest_frequency, SWEPT_STEER.highest_frequency
    rise = (high - low) / SWEPT_STEER.sweep
    halves = np.arange(1, len(crossings) + 1)  # low t + rise t^2 / 2 = halves / 2
    assert len(crossings) == int((low + high) * SWEPT_STEER.sweep)
    expected = begin + (np.sqrt(low**2 + rise * halves) - low) / rise
    assert np.abs(crossings - expected).max() <= times[1]


def test_there_is_no_response_without_steering():
    rows = np.zeros((100, len(COLUMNS)))
    rows[:, 0] = np.arange(100) * 0.01
    _, found = frequency_response(History(rows), "roll")
    assert np.isnan(found).all()
