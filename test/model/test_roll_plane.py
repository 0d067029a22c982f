"""Roll-plane models: the number in the paper, closed forms, and model 1 in slow cornering."""

import numpy as np
import pytest
from tire_springs import tire_compressions, tire_slopes

from vehicle_roll_sim import LF, LR, Command, RollPlane, Simulation, Vehicle
from vehicle_roll_sim.runs.metrics import load_transfer_ratio

G = 9.81
FIRM = 1e8
"""N/m: springs and tires that do not give."""


def static_loads(vehicle: Vehicle) -> np.ndarray:
    """Load on every tire at rest, shape (4,) (N)."""
    m, a, b = vehicle.sprung_mass, vehicle.cg_to_front_axle, vehicle.cg_to_rear_axle
    return (m * np.array([b, b, a, a]) / (a + b) / 2 + vehicle.per_wheel("unsprung_mass")) * G


def whole_vehicle_cg_height(vehicle: Vehicle) -> float:
    """By moments about the ground, the unsprung masses at the centres of their wheels (m)."""
    m, mf, mr = vehicle.sprung_mass, vehicle.front_unsprung_mass, vehicle.rear_unsprung_mass
    compression = tire_compressions(vehicle, static_loads(vehicle))
    front, rear = vehicle.tire_radius - compression[[LF, LR]]
    return (m * vehicle.cg_height + 2 * mf * front + 2 * mr * rear) / (m + 2 * mf + 2 * mr)


def test_the_static_stability_factor_of_the_reference_vehicle_is_the_known_one(reference):
    factor = RollPlane(reference.record()).static_stability_factor
    assert 1.133 <= factor < 1.134  # the three decimals of the source's value, 1.133


def test_the_rigid_vehicle_lifts_where_its_weight_passes_the_outer_wheels(vehicle):
    rigid = RollPlane(vehicle.record(), suspended=False)
    half_track = (vehicle.front_track + vehicle.rear_track) / 4
    threshold = G * half_track / whole_vehicle_cg_height(vehicle)
    assert rigid.lift_off_threshold == pytest.approx(threshold, rel=1e-12)
    assert rigid.lift_off_threshold == pytest.approx(G * rigid.static_stability_factor, rel=1e-12)
    assert rigid.roll(5.0) == 0.0


def test_the_suspended_vehicle_is_in_balance_at_its_threshold(vehicle):
    """Roll moment of the body about its axis, then moments of all about the ground."""
    model = RollPlane(vehicle.record())
    ay = model.lift_off_threshold
    a, b, m = vehicle.cg_to_front_axle, vehicle.cg_to_rear_axle, vehicle.sprung_mass
    depth = (vehicle.front_roll_centre_depth * b + vehicle.rear_roll_centre_depth * a) / (a + b)
    springs = vehicle.per_wheel("spring_stiffness")
    tires = tire_slopes(vehicle, tire_compressions(vehicle, static_loads(vehicle)))
    series = 1 / (1 / springs + 1 / tires)
    stiffness = (vehicle.per_wheel("track") ** 2 / 4 * series).sum()
    roll = model.roll(ay)
    assert stiffness * roll == pytest.approx(m * depth * (ay + G * roll), rel=1e-12)
    overturning = model.weight / G * ay * whole_vehicle_cg_height(vehicle) + m * G * depth * roll
    half_track = (vehicle.front_track + vehicle.rear_track) / 4
    assert overturning == pytest.approx(model.weight * half_track, rel=1e-12)


def test_the_suspended_vehicle_lifts_before_the_rigid_one_and_is_it_without_springs(reference):
    rigid = RollPlane(reference.record(), suspended=False)
    assert RollPlane(reference.record()).lift_off_threshold < rigid.lift_off_threshold
    names = ("spring_stiffness", "tire_stiffness")
    firm = {f"{end}_{name}": FIRM for end in ("front", "rear") for name in names}
    vehicle = reference.with_values(firm).record()
    firm_rigid, firm_suspended = RollPlane(vehicle, suspended=False), RollPlane(vehicle)
    # the roll gradient left over is that of 1e8 N/m: 2e-4 of the reference's
    expected = pytest.approx(firm_rigid.lift_off_threshold, rel=1e-3)
    assert firm_suspended.lift_off_threshold == expected


def test_springs_that_cannot_hold_the_body_upright_leave_nothing_to_corner_with(reference):
    soft = reference.with_values({"front_spring_stiffness": 1e3, "rear_spring_stiffness": 1e3})
    model = RollPlane(soft.record())
    assert model.roll_gradient == np.inf
    assert model.lift_off_threshold == 0.0


def test_the_load_transfer_ratio_grows_to_1_at_the_threshold_and_stays_there(vehicle):
    model = RollPlane(vehicle.record())
    ay = model.lift_off_threshold * np.array([-2.0, -1.0, -0.5, 0.0, 0.25, 1.0, 3.0])
    ratios = model.load_transfer_ratio(ay)
    np.testing.assert_allclose(ratios, [-1.0, -1.0, -0.5, 0.0, 0.25, 1.0, 1.0], rtol=1e-12)


def test_in_slow_cornering_it_is_close_to_what_model_1_settles_to(vehicle):
    """In model 1 the wheels go with the body's z axis, so that its weight leans out by the height
    of the c.g. instead of the depth of the roll axis: 3 to 6 % more load transfer at 0.25 g."""
    simulation, model = Simulation(vehicle), RollPlane(vehicle.record())
    simulation.step(Command(steering=0.03, speed_hold_gain=2000.0, speed_hold_target=50 / 3.6), 6.0)
    ay = simulation.outputs.acceleration[1]
    ratio = load_transfer_ratio(simulation.outputs.normal_force)
    assert model.load_transfer_ratio(ay) == pytest.approx(ratio, rel=0.08)
    assert model.roll(ay) == pytest.approx(simulation.state.roll, rel=0.1)
