"""Drive and brakes of the speed controller: within limits, never both at once."""

import numpy as np
import pytest
from slopes import CLOSE, OVERSHOOT, SLOPES, drive, on_slope, watch

from vehicle_roll_sim import Command, Simulation, preset
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.simulation.speed_controller import STANDING, SpeedController

SETTLING = 0.05
"""m: what a vehicle that begins with springs as on the level sinks back against locked wheels."""


def wheel_slip(session: Session) -> float:
    """Largest slip ratio of a wheel (absolute)."""
    return float(np.abs(session.simulation.outputs.slip_ratio).max())


@pytest.mark.parametrize("speed", [0.5, -0.5])
def test_a_vehicle_whose_drive_is_too_weak_for_the_slope_is_held_by_its_brakes(speed):
    session = on_slope(np.copysign(0.2, speed), drive_limit=50.0)
    places, _ = watch(session, speed, 60.0)
    assert (np.sign(speed) * places).min() > -SETTLING
    assert abs(places[-1] - places[2000]) < 1e-3  # m: no creeping
    session.controller.drive_limit = 800.0
    _, speeds = watch(session, speed, 10.0)
    assert np.abs(speeds).max() < (1.0 + OVERSHOOT) * abs(speed)  # nothing has wound up


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


def test_a_commanded_brake_is_stronger_than_a_commanded_speed():
    controller = SpeedController(preset())
    braked = Command(brake_torque=(900.0, 0.0, 0.0, 0.0))
    applied = controller.drive(braked, 20.0, 10.0, 0.01)
    assert applied.brake_torque == (900.0, 0.0, 0.0, 0.0)
    assert applied.wheel_torque == (0.0,) * 4
    slowing = controller.drive(braked, 9.0, 10.0, 0.01)
    assert slowing.brake_torque[0] == 900.0
    assert 0.0 < slowing.brake_torque[1] < 900.0
