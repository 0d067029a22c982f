"""The speed controller: reaches, holds and stops, on any slope, within its limits."""

import numpy as np
import pytest

from vehicle_roll_sim import Command, Options, Simulation, preset
from vehicle_roll_sim.simulation.command_inbox import CommandInbox
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.session import Session
from vehicle_roll_sim.simulation.speed_controller import STANDING, SpeedController
from vehicle_roll_sim.vehicle.parameters import Vehicle

PERIOD_NS = 10_000_000
SLOPES = (0.0, 0.2, -0.2)
CLOSE = 0.02
"""Relative: the integral part settles in some seconds; seen 0.5 %."""


OVERSHOOT = 0.15
"""Of a step of the target: 1/e^2 = 13.5 % with the double pole and the zero of the control."""
ROCKING = 0.01
"""m/s: more, for a vehicle that has begun to settle on the slope when its wheels begin to turn."""
ROLL_BACK = 0.01
"""m: the tires wind up and the suspension settles first; seen 0.1 mm (7 mm with heavy wheels)."""
SETTLING = 0.05
"""m: what a vehicle that begins with springs as on the level sinks back against locked wheels."""


def on_slope(
    grade: float,
    vehicle: Vehicle | None = None,
    options: Options | None = None,
    initial_speed: float = 0.0,
    period_ns: int = PERIOD_NS,
    **limits: float,
) -> Session:
    """A vehicle on a slope, for ever listening; limits: of its speed controller."""
    vehicle = vehicle or preset()
    simulation = Simulation(vehicle, options, road=Road(grade=grade))
    controller = SpeedController(vehicle, **limits)
    return Session(simulation, CommandInbox(timeout=0.0), period_ns, initial_speed, controller)


@pytest.fixture(params=SLOPES)
def session(request) -> Session:
    """A vehicle at rest."""
    return on_slope(request.param)


def drive(session: Session, speed: float, seconds: float) -> list[Command]:
    """Command a speed (m/s) for some time; the commands that were applied."""
    session.inbox.receive("speed_cmd", [speed], session.simulation.time_ns)
    applied = []
    for _ in range(round(seconds * 1e9 / session.period_ns)):
        session.run_period()
        applied.append(session.applied)
    return applied


def watch(session: Session, speed: float, seconds: float) -> tuple[np.ndarray, np.ndarray]:
    """Command a speed (m/s) for some time; position (m) and speed after every period."""
    rows = []
    for _ in range(round(seconds * 1e9 / session.period_ns)):
        drive(session, speed, session.period_ns / 1e9)
        rows.append((session.simulation.state.x, session.simulation.state.u))
    return np.array(rows).T


def assert_starts_well(session: Session, speed: float) -> None:
    """From rest: no roll-back, little overshoot, the speed in the end."""
    places, speeds = watch(session, speed, 10.0)
    direction = np.sign(speed)
    assert (direction * places).min() > -ROLL_BACK
    assert (direction * speeds).max() < (1.0 + OVERSHOOT) * abs(speed) + ROCKING
    assert speeds[-1] == pytest.approx(speed, rel=CLOSE)


def wheel_slip(session: Session) -> float:
    """Largest slip ratio of a wheel (absolute)."""
    return float(np.abs(session.simulation.outputs.slip_ratio).max())


@pytest.mark.parametrize("speed", [0.1, 0.3, 0.5, 1.0, 5.0, -0.1, -0.5, -3.0])
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


@pytest.mark.parametrize("speed", [0.5, -0.5])
def test_a_vehicle_whose_drive_is_too_weak_for_the_slope_is_held_by_its_brakes(speed):
    session = on_slope(np.copysign(0.2, speed), drive_limit=50.0)
    places, _ = watch(session, speed, 60.0)
    assert (np.sign(speed) * places).min() > -SETTLING
    assert abs(places[-1] - places[2000]) < 1e-3  # m: no creeping
    session.controller.drive_limit = 800.0
    _, speeds = watch(session, speed, 10.0)
    assert np.abs(speeds).max() < (1.0 + OVERSHOOT) * abs(speed)  # nothing has wound up


@pytest.mark.parametrize("speed", [0.3, 10.0])
def test_the_brakes_alone_hold_a_speed_downhill(speed):
    session = on_slope(-0.2, drive_limit=0.0)
    assert_starts_well(session, speed)


@pytest.mark.parametrize("grade", SLOPES)
def test_a_vehicle_without_brakes_stops_and_stands_by_its_drive(grade):
    session = on_slope(grade, initial_speed=5.0, brake_limit=0.0)
    places, speeds = watch(session, 0.0, 30.0)
    assert abs(speeds[-1]) < 1e-6
    assert abs(places[-1] - places[-500]) < 1e-3  # m


@pytest.mark.parametrize("grade", SLOPES)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_wheels_neither_spin_nor_lock_however_strong_drive_and_brake_are(grade, sign):
    session = on_slope(grade, drive_limit=1e5, brake_limit=1e5)
    slips = []
    for target in (20.0, 2.0):
        for _ in range(1500):
            drive(session, sign * target, 0.01)
            if abs(session.simulation.state.u) > 1.0:
                slips.append(wheel_slip(session))
        assert session.simulation.state.u == pytest.approx(sign * target, rel=CLOSE)
    assert max(slips) < 0.1  # the tires give most at about 0.1


def test_a_weak_commanded_brake_lets_no_vehicle_roll_back():
    """Nothing drives against it, so that the brakes have to hold."""
    session = on_slope(0.2)
    session.inbox.receive("brake_torque_cmd", [10.0] * 4, 0)
    places, _ = watch(session, 1.0, 10.0)
    assert places.min() > -SETTLING
    assert session.applied.wheel_torque == (0.0,) * 4


@pytest.mark.parametrize("slope", [-2.0, 0.0, 2.0])
def test_the_torque_at_the_target_is_what_carries_the_vehicle_on_the_slope(slope):
    """Before the integral part has anything: m g sin / 4 of the lever, four wheels."""
    vehicle = preset()
    (drive_torque, *_) = (
        SpeedController(vehicle).drive(Command(), 0.1, 0.1, 0.01, slope).wheel_torque
    )
    mass = vehicle.sprung_mass + 4 * vehicle.front_unsprung_mass
    radius = Simulation(vehicle).outputs.loaded_radius.mean()
    assert drive_torque == pytest.approx(-mass * slope * radius / 4, rel=1e-6, abs=1e-9)


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


def test_torques_are_the_same_at_all_wheels_and_within_the_limits():
    session = on_slope(0.0, initial_speed=10.0, drive_limit=300.0, brake_limit=400.0)
    applied = [*drive(session, 15.0, 5.0), *drive(session, 3.0, 3.0)]
    drives = np.array([command.wheel_torque for command in applied])
    brakes = np.array([command.brake_torque for command in applied])
    assert np.ptp(drives, axis=1).max() == np.ptp(brakes, axis=1).max() == 0.0
    assert drives.max() == 300.0
    assert np.abs(drives).max() <= 300.0
    assert (brakes.min(), brakes.max()) == (0.0, 400.0)
    assert (drives[brakes > 0.0] <= 0.0).all()  # nothing drives against a brake
    assert (brakes[drives < 0.0] == 400.0).all()  # and the drive slows only where it must help


def test_a_commanded_wheel_torque_is_not_touched(session):
    session.inbox.receive("wheel_torque_cmd", [10.0, 20.0, 30.0, 40.0], 0)
    (applied, *_) = drive(session, 15.0, 0.1)
    assert applied == Command(wheel_torque=(10.0, 20.0, 30.0, 40.0))


def test_a_silent_speed_command_is_given_up(session):
    session.inbox.timeout = 0.5
    applied = drive(session, 15.0, 1.0)
    assert applied[10].wheel_torque[0] > 0.0
    assert applied[-1] == Command()


def test_the_integral_does_not_wind_up_at_a_limit():
    """A minute against a wall of a limit, then a speed that is there already."""
    controller = SpeedController(preset(), drive_limit=100.0)
    for _ in range(6000):
        assert controller.drive(Command(), 30.0, 5.0, 0.01).wheel_torque[0] == 100.0
    assert abs(controller.drive(Command(), 5.0, 5.0, 0.01).wheel_torque[0]) < 1.0


def test_the_brakes_hold_only_a_vehicle_that_stands_and_shall_stand():
    controller = SpeedController(preset(), brake_limit=1234.0)
    held = controller.drive(Command(), 0.0, STANDING / 2, 0.01)
    assert (held.brake_torque[0], held.wheel_torque[0]) == (1234.0, 0.0)
    assert controller.drive(Command(), 1.0, STANDING / 2, 0.01).brake_torque[0] == 0.0


@pytest.mark.parametrize("speed", [1.0, 2.0, 3.0, 5.0, 8.0, 10.0])
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


def test_a_commanded_brake_is_stronger_than_a_commanded_speed():
    controller = SpeedController(preset())
    braked = Command(brake_torque=(900.0, 0.0, 0.0, 0.0))
    applied = controller.drive(braked, 20.0, 10.0, 0.01)
    assert applied.brake_torque == (900.0, 0.0, 0.0, 0.0)
    assert applied.wheel_torque == (0.0,) * 4
    slowing = controller.drive(braked, 9.0, 10.0, 0.01)
    assert slowing.brake_torque[0] == 900.0
    assert 0.0 < slowing.brake_torque[1] < 900.0
