"""The speed controller: reaches, holds and stops, on any slope, whatever is commanded."""

import numpy as np
import pytest
from slopes import CLOSE, OVERSHOOT, PERIOD_NS, SLOPES, drive, on_slope, watch

from vehicle_roll_sim import Command, Options, Simulation, preset
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.simulation.road import Road

pytestmark = pytest.mark.unmeasured

ROCKING = 0.01
"""m/s beyond `OVERSHOOT`: it has begun to settle on the slope when its wheels begin to turn."""
ROLL_BACK = 0.01
"""m: the tires wind up and the suspension settles first; seen 0.1 mm (7 mm with heavy wheels)."""


@pytest.fixture(params=SLOPES)
def session(request) -> Session:
    """A vehicle at rest."""
    return on_slope(request.param)


def assert_starts_well(session: Session, speed: float) -> None:
    """From rest: no roll-back, little overshoot, the speed in the end."""
    places, speeds = watch(session, speed, 10.0)
    direction = np.sign(speed)
    assert (direction * places).min() > -ROLL_BACK
    assert (direction * speeds).max() < (1.0 + OVERSHOOT) * abs(speed) + ROCKING
    assert speeds[-1] == pytest.approx(speed, rel=CLOSE)


@pytest.mark.parametrize("speed", [0.1, 0.3, 1.0, 5.0, -0.1, -3.0])
def test_a_start_rolls_back_and_overshoots_hardly_on_any_slope(session, speed):
    assert_starts_well(session, speed)


@pytest.mark.parametrize("model", ["1a", "1b", "1c-ii", "1c-iii", "8dof"])
@pytest.mark.parametrize("grade", [0.2, -0.2])
def test_so_does_a_start_of_a_simpler_model(model, grade):
    assert_starts_well(on_slope(grade, options=Options(model=model)), 0.3)


@pytest.mark.parametrize(
    "changes",
    [
        {"wheel_inertia": 0.1},
        {"wheel_inertia": 100.0},
        {"sprung_mass": 500.0},
        {"sprung_mass": 2500.0},
        {"rolling_resistance_coefficient": 0.2},
        {"drag_area": 2.0},
    ],
    ids=str,
)
@pytest.mark.parametrize("speed", [0.2, -0.2, 10.0])
def test_so_does_a_start_of_another_vehicle(changes, speed):
    session = on_slope(0.2, preset().with_values(changes))
    assert_starts_well(session, speed)


@pytest.mark.parametrize("period", [0.001, 0.2, 1.0])
def test_long_and_short_periods_bring_no_oscillation(period):
    session = on_slope(0.2, period_ns=round(period * 1e9))
    places, speeds = watch(session, 0.3, 20.0)
    assert places.min() > -ROLL_BACK
    assert speeds.max() < 0.3 * 1.2  # the sampling costs some damping; seen 17 %
    assert speeds[-1] == pytest.approx(0.3, rel=CLOSE)


@pytest.mark.parametrize("speed", [0.3, 10.0])
def test_the_brakes_alone_hold_a_speed_downhill(speed):
    session = on_slope(-0.2, drive_limit=0.0)
    assert_starts_well(session, speed)


@pytest.mark.parametrize("target", [1e308, -1e308, 5e-324, -0.0])
def test_any_number_is_a_target(target):
    session = on_slope(0.2)
    for command in drive(session, target, 3.0):
        assert np.abs(command.wheel_torque).max() <= 800.0
    assert not session.stopped


def test_a_speed_is_held_in_a_circle_that_goes_up_and_down_a_slope():
    session = on_slope(0.2)
    session.inbox.receive("steering_cmd", [0.15], 0)
    _, speeds = watch(session, 5.0, 40.0)
    assert speeds[1500:] == pytest.approx(5.0, rel=CLOSE)  # seen 1 %, and 10 % unless carried


def test_a_target_that_changes_every_period_shakes_nothing():
    session = on_slope(0.2)
    for target in np.random.default_rng(1).uniform(-1.0, 1.0, 1000):
        drive(session, target, 0.01)
        assert abs(session.simulation.state.u) < 0.3  # their mean is 0; seen 0.17
    drive(session, 1.0, 10.0)
    assert session.simulation.state.u == pytest.approx(1.0, rel=CLOSE)


@pytest.mark.parametrize("speed", [20.0, 5.0, -3.0])
def test_a_speed_is_reached_and_held_on_any_slope(session, speed):
    drive(session, speed, 20.0)
    assert session.simulation.state.u == pytest.approx(speed, rel=CLOSE)


def test_a_vehicle_that_shall_stand_stops_and_stays(session):
    drive(session, 15.0, 8.0)
    drive(session, 0.0, 10.0)
    start = session.simulation.state.x
    drive(session, 0.0, 20.0)
    assert abs(session.simulation.state.x - start) < 1e-3  # m
    assert (session.simulation.state.wheel_speed == 0.0).all()


def test_a_commanded_wheel_torque_is_not_touched(session):
    session.inbox.receive("wheel_torque_cmd", [10.0, 20.0, 30.0, 40.0], 0)
    (applied, *_) = drive(session, 15.0, 0.1)
    assert applied == Command(wheel_torque=(10.0, 20.0, 30.0, 40.0))


def test_a_silent_speed_command_is_given_up(session):
    session.inbox.timeout = 0.5
    applied = drive(session, 15.0, 1.0)
    assert applied[10].wheel_torque[0] > 0.0
    assert applied[-1] == Command()


@pytest.mark.parametrize("speed", [1.0, 2.0, 5.0, 10.0])
@pytest.mark.parametrize("grade", [0.2, -0.2])
def test_from_any_speed_a_vehicle_stops_on_a_slope_and_does_not_roll_away(speed, grade):
    inbox = CommandInbox(timeout=0.0)
    simulation = Simulation(preset(), road=Road(grade=grade))
    session = Session(simulation, inbox, PERIOD_NS, speed)
    inbox.receive("speed_cmd", [0.0], 0)
    places = []
    for _ in range(1500):
        session.run_period()
        places.append(simulation.state.x)
    assert max(places) - places[-1] < 0.3  # m: it springs back on its tires and suspension
    assert abs(places[-1] - places[-500]) < 1e-2
