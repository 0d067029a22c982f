"""`wind_cmd`: it reaches the air forces, ends with silence, and is ignored without air forces."""

import pytest

from vehicle_roll_sim import Simulation, preset
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.live.status import command_troubles

PERIOD_NS = 10_000_000
WIND = (2.0, -9.0)
IGNORED = ["wind_cmd: ignored, the vehicle has no air forces"]


def session_of(**values) -> Session:
    return Session(Simulation(preset().with_values(values)), CommandInbox(), PERIOD_NS, 20.0)


@pytest.mark.parametrize("area", [0.0, 3.0])
def test_a_wind_blows_on_a_vehicle_with_air_forces_until_its_topic_is_silent(area):
    session = session_of(side_force_area=area)
    session.inbox.receive("wind_cmd", WIND, 0)
    session.run_period()
    assert session.applied.wind == WIND
    assert session.simulation.outputs["air_velocity"] == pytest.approx((18.0, 9.0), rel=0.02)
    assert command_troubles(session, {}) == []
    for _ in range(51):
        session.run_period()
    assert session.applied.wind == (0.0, 0.0)
    (trouble,) = command_troubles(session, {})
    assert trouble == "wind_cmd: no message within 0.5 s of simulation: 0 is applied"


def test_a_vehicle_without_air_forces_ignores_the_wind_and_the_status_says_so():
    session, calm = session_of(), session_of()
    session.inbox.receive("wind_cmd", WIND, 0)
    assert command_troubles(session, {}) == IGNORED
    for each in (session, calm):
        each.run_period()
    assert session.applied == calm.applied
    assert session.simulation.model_state.tolist() == calm.simulation.model_state.tolist()


def test_both_components_are_clamped_to_the_limit():
    session = session_of(side_force_area=3.0)
    session.inbox.limits.wind_limit = 5.0
    problem = session.inbox.receive("wind_cmd", WIND, 0)
    assert problem == "clamped: -9 is beyond wind_limit, 5 m/s"
    session.run_period()
    assert session.applied.wind == (2.0, -5.0)


def test_a_vehicle_held_at_its_speed_keeps_the_wind():
    session = session_of(side_force_area=3.0)
    session.inbox.receive("wind_cmd", WIND, 0)
    session.inbox.receive("speed_cmd", (20.0,), 0)
    session.inbox.receive("brake_cmd", (10.0,), 0)
    session.run_period()
    assert session.applied.wind == WIND
    assert sum(session.applied.brake_torque) > 0.0
