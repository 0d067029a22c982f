"""Edges of friction: what changes there is the friction of the tire, and nothing else jumps."""

import functools

import numpy as np
import pytest
from programmes import Evaluation, ramp_and_hold, record_run, with_tire
from road_kinds import FEATURES, road

from vehicle_roll_sim import Options, Simulation
from vehicle_roll_sim.model.records import WHEELS

STEP = 1e-3
"""s"""
FEW = 5
"""Steps before an edge, whose changes are the usual ones; and edges that are looked at."""
SMOOTH = 20.0
"""N: beside twice the usual change. Wheels that crossed the edge just before shake the others."""
ACROSS = {"kind": "patch", "start": 10.0, "friction": 0.3}
SQUARES = np.where(np.arange(40)[:, None] // 8 % 2, 0.4, 1.0) + np.zeros((40, 2))
EDGES = {
    "into a patch": ACROSS,
    "out of a patch": {**ACROSS, "start": -100.0, "length": 110.0},
    "a chessboard": {**FEATURES["chessboard"], "start": 10.0, "left": 90.0, "right": -90.0},
    "a grid": {
        "kind": "grid",
        "start": 10.0,
        "spacing": 0.25,
        "side_spacing": 200.0,
        "right": -100.0,
        "heights": np.zeros((40, 2)).tolist(),
        "frictions": SQUARES.tolist(),
    },
}
COMMANDS = ramp_and_hold(0.1, 20.0, 4.0), ramp_and_hold(0.1, 20.0, 3.0, brake_torque=700.0)
"""Near the limit of the tires on the better road, where friction is what counts."""
NOTED = ("tire_longitudinal", "tire_lateral", "support")


def noted(outputs) -> np.ndarray:
    """Forces of the tires along and across them and their loads, shape (..., 4, 3) (N)."""
    return np.stack([outputs[name] for name in NOTED], -1)


@pytest.mark.parametrize("model", ["1", "2"])
@pytest.mark.parametrize("name", EDGES)
def test_a_force_jumps_at_an_edge_as_that_of_a_tire_whose_friction_changes(reference, name, model):
    """In the step over an edge, a tire with the friction before it goes on smoothly in the same
    state, and one with that behind it has the force behind it."""

    @functools.cache
    def with_friction(factor: float) -> Evaluation:
        scaled = {name: factor * reference.tire.coefficients[name] for name in ("LMUX", "LMUY")}
        return Evaluation(with_tire(reference, **scaled), Options(model))

    largest = 0.0
    for command in COMMANDS:
        simulation = Simulation(reference, Options(model), step=STEP, road=road(EDGES[name]))
        simulation.reset(14.0)
        run = record_run(simulation, command, 1.2)
        forces, friction = noted(run.outputs), run.outputs["road_friction"]
        for wheel in range(len(WHEELS)):
            for at in np.flatnonzero(np.diff(friction[:, wheel]))[:FEW]:
                now = command(run.time[[at + 1]])[0]
                before, behind = (with_friction(friction[k, wheel]) for k in (at, at + 1))
                found = []
                for each in (before, behind):
                    each.rates(run.state[at + 1], now)
                    found.append(noted(each.outputs)[wheel])
                usual = np.abs(np.diff(forces[at - FEW : at + 1, wheel], axis=0)).max(axis=0)
                goes_on = np.abs(found[0] - forces[at, wheel])
                assert (goes_on <= 2.0 * usual + SMOOTH).all()
                assert found[1] == pytest.approx(forces[at + 1, wheel], rel=1e-9, abs=1e-6)
                largest = max(largest, np.abs(found[1] - found[0]).max())
    assert largest > (10.0 if name == "a grid" else 1000.0)  # N: there was something to see
