"""Model 2: runs whose numbers are known from another implementation, and what has to stay as is."""

import numpy as np
import pytest
from programmes import ramp_and_hold, record_run
from swing_axles import on_swing_axles, with_lateral_force_alone

from vehicle_roll_sim import Command, Condition, Options, Simulation, Vehicle
from vehicle_roll_sim.model.records import STATE

KINEMATIC = Options(model="2", steady_state_slip=True)
LEVEL = {"front_half_track_change": 0.0, "rear_half_track_change": 0.0}
BARS = {"front_anti_roll_bar_rate": 10_000.0, "rear_anti_roll_bar_rate": 8_000.0}
CASES = {
    "swing axles": (
        lambda vehicle: on_swing_axles(with_lateral_force_alone(vehicle)),
        9.0,
        {
            1.5: (6.4642, -0.0636, 0.78023, 39.1431, (699.59, 9557.28, 92.88, 7093.81)),
            2.0: (7.5787, 1.4346, 0.83044, 40.0638, (100.36, 10517.87, 0.0, 6747.72)),
            2.5: (13.2789, 1.8284, 0.89176, 37.7307, (0.0, 11335.54, 0.0, 7047.52)),
        },
    ),
    "straight paths": (
        lambda vehicle: vehicle,
        10.0,
        {
            1.5: (9.4829, 0.2684, 0.77143, 40.8390, (17.52, 10456.64, 0.0, 7759.83)),
            2.0: (13.2655, 1.5291, 0.83338, 41.7056, (0.0, 11523.00, 0.0, 7122.84)),
            2.5: (34.0747, 0.2214, 1.03199, 40.6963, (0.0, 10652.04, 0.0, 6977.27)),
        },
    ),
    "vertical paths": (
        lambda vehicle: vehicle.with_values(LEVEL),
        10.0,
        {2.0: (15.9495, 1.4319, 0.83391, 42.1519, (0.0, 11171.22, 0.0, 6741.43))},
    ),
    "anti-roll bars": (
        lambda vehicle: vehicle.with_values(BARS),
        4.0,
        {
            1.5: (3.5960, 0.0551, 0.75458, 19.6284, (2666.18, 7481.06, 1494.28, 5693.05)),
            2.5: (3.4799, 0.1250, 0.75813, 20.6983, (2795.03, 7314.74, 1548.43, 5547.86)),
        },
    ),
}
"""Vehicle, road-wheel angle (deg), and at times (s): roll, pitch (deg), z (m), yaw rate (deg/s),
loads (N)."""
DEGREES, METRES, NEWTONS = 1e-4, 1e-5, 0.05


def turn(angle: float):
    """From 0 to the angle (deg) between 1.0 and 1.25 s."""
    return ramp_and_hold(1.0, 4 * angle, angle)


@pytest.mark.parametrize("case", CASES)
def test_the_numbers_of_another_implementation(reference: Vehicle, case):
    build, angle, expected = CASES[case]
    simulation, programme = Simulation(build(reference), KINEMATIC), turn(angle)
    for time, (roll, pitch, z, yaw_rate, loads) in expected.items():
        simulation.step(programme, time - simulation.time)
        state = simulation.state
        angles = np.degrees([state.roll, state.pitch, state.yaw_rate])
        np.testing.assert_allclose(angles, [roll, pitch, yaw_rate], rtol=0, atol=DEGREES)
        assert state.z == pytest.approx(z, abs=METRES)
        np.testing.assert_allclose(simulation.outputs.normal_force, loads, rtol=0, atol=NEWTONS)


@pytest.fixture(params=[Options(model="2"), KINEMATIC], ids=["transient slip", "steady-state slip"])
def options(request) -> Options:
    return request.param


def test_static_equilibrium_stays(vehicle, options):
    suspended = on_swing_axles(vehicle)
    simulation = Simulation(suspended, options)
    start = simulation.state.copy()
    simulation.step(Command(), 20.0)
    moving = ("x", "wheel_angle")
    drift = {
        name: float(np.abs(simulation.state[name] - start[name]).max())
        for name in STATE.names
        if name not in moving and not np.isnan(start[name]).any()
    }
    assert max(drift.values()) < 1e-9, drift


def test_on_leaning_wheels_tires_that_stiffen_carry_it_from_the_first_instant(unequal_axles):
    leaning = unequal_axles.with_values({"front_camber": -0.2, "rear_camber": 0.1})
    simulation = Simulation(leaning, Options(model="2"))
    simulation.reset(0.0)
    weight = 9.81 * leaning.mass
    assert simulation.outputs.normal_force.sum() == pytest.approx(weight, rel=1e-12)
    height = float(simulation.state.z)
    simulation.step(Command(), 1.0)
    assert simulation.state.z == pytest.approx(height, abs=1e-9)


def test_leaning_wheels_begin_to_roll_freely(unequal_axles):
    leaning = unequal_axles.with_values({"front_camber": -0.2, "rear_camber": 0.1})
    simulation = Simulation(leaning, Options(model="2"))
    simulation.reset(20.0)
    outputs = simulation.outputs
    np.testing.assert_allclose(outputs.tread, outputs.rolling, rtol=1e-14)  # rounding
    np.testing.assert_allclose(outputs.rolling, 20.0, rtol=1e-14)


def test_the_roll_centre_of_straight_paths_is_that_of_the_vehicle_file_at_rest(vehicle):
    outputs = Simulation(vehicle, KINEMATIC).outputs
    heights = [vehicle.roll_centre_height[0], vehicle.roll_centre_height[2]]
    np.testing.assert_allclose(outputs["roll_centre_height"], heights, rtol=0, atol=1e-12)
    np.testing.assert_allclose(outputs["roll_centre_place"], 0.0, rtol=0, atol=1e-12)


def test_that_of_swing_axles_is_on_the_lines_from_contact_points_to_pivots(reference):
    """Half the track over the length of the arm across, times the height of the pivot."""
    outputs = Simulation(on_swing_axles(reference), KINEMATIC).outputs
    heights = [0.25 * 0.75 / 0.6, 0.28 * 0.75 / 0.6]
    np.testing.assert_allclose(outputs["roll_centre_height"], heights, rtol=0, atol=1e-6)


def test_vertical_paths_have_no_roll_centre(reference):
    outputs = Simulation(reference.with_values(LEVEL), KINEMATIC).outputs
    assert np.isnan(outputs["roll_centre_height"]).all()
    assert np.isnan(outputs["roll_centre_place"]).all()


def test_the_tire_compression_of_the_state_is_that_of_the_geometry_also_when_steering_steps(
    vehicle,
):
    simulation = Simulation(on_swing_axles(vehicle), Options(model="2"))
    for angle in (0.0, 0.3, -0.2):
        simulation.step(Command(steering=angle), 0.2)
        outputs, state = simulation.outputs, simulation.state
        loaded = outputs["normal_force"] > 0.0
        height = vehicle.tire_radius * np.cos(outputs["inclination"]) - state["tire_compression"]
        radius = height / np.cos(outputs["inclination"])
        np.testing.assert_allclose(radius[loaded], outputs["loaded_radius"][loaded], rtol=1e-12)


def test_a_wheel_is_off_the_road_exactly_where_its_compression_is_negative(reference):
    run = record_run(Simulation(reference, Options(model="2")), turn(10.0), 3.0)
    lifted = run.outputs["normal_force"] == 0.0
    assert lifted.any()
    np.testing.assert_array_equal(lifted, run.state["tire_compression"] <= 0.0)


def test_it_rolls_over_and_stops_there(reference):
    simulation = Simulation(reference, Options(model="2"))
    assert simulation.step(turn(10.0), 5.0) is Condition.ROLLED_OVER
    assert simulation.events.rollover_time[0] == pytest.approx(simulation.time, abs=1e-3)
