"""`road_height_cmd` and `road_friction_cmd`: the road under the wheels comes from outside."""

import pytest
from road_kinds import road

from vehicle_roll_sim import Simulation, preset
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.live.status import command_troubles

PERIOD_NS = 10_000_000
HEIGHTS, FRICTIONS = (0.01, -0.02, 0.03, 0.0), (0.3, 1.0, 0.5, 0.9)


def session_on(*features: dict) -> Session:
    session = Session(Simulation(preset(), road=road(*features)), CommandInbox(), PERIOD_NS, 20.0)
    session.inbox.receive("road_height_cmd", HEIGHTS, 0)
    session.inbox.receive("road_friction_cmd", FRICTIONS, 0)
    return session


def test_the_road_is_as_it_was_commanded_and_stays_so_in_silence():
    session = session_on({"kind": "commanded"})
    for _ in range(60):
        session.run_period()
    outputs = session.simulation.outputs
    assert outputs["road_height"].tolist() == list(HEIGHTS)
    assert outputs["road_friction"] == pytest.approx(FRICTIONS)
    silent = "no message within 0.5 s of simulation: the road stays as it is"
    assert command_troubles(session, {}) == [
        f"road_height_cmd: {silent}",
        f"road_friction_cmd: {silent}",
    ]


def test_another_road_ignores_them_and_the_status_says_so():
    session = session_on()
    assert command_troubles(session, {}) == [
        "road_height_cmd: ignored, the road does not take it",
        "road_friction_cmd: ignored, the road does not take it",
    ]
    session.run_period()
    assert session.applied.road_height == (0.0,) * 4
    assert session.simulation.outputs["road_friction"].tolist() == [1.0] * 4


def test_values_beyond_the_limits_are_clamped_and_frictions_below_0_dropped():
    session = session_on({"kind": "commanded"})
    problem = session.inbox.receive("road_height_cmd", (0.0, -3.0, 0.0, 0.0), 0)
    assert problem == "clamped: -3 is beyond road_height_limit, 1 m"
    problem = session.inbox.receive("road_friction_cmd", (20.0, 1.0, 1.0, 1.0), 0)
    assert problem == "clamped: 20 is beyond road_friction_limit, 10"
    problem = session.inbox.receive("road_friction_cmd", (-0.1, 1.0, 1.0, 1.0), 0)
    assert problem == "message dropped: [-0.1, 1.0, 1.0, 1.0]: no value may be below 0"
    session.run_period()
    assert session.applied.road_height == (0.0, -1.0, 0.0, 0.0)
    assert session.applied.road_friction == (10.0, 1.0, 1.0, 1.0)
