"""What pushes wheels from the side: the face of a curb, and the furrow in soft soil."""

import math

import numpy as np
import pytest
from road_kinds import road

from vehicle_roll_sim import LF, LR, RF, RR, Command, Condition, Options, Simulation

SOIL = {"kind": "soft_soil", "start": -50.0, "stiffness": 8e4, "cohesion": 4e3}
CURB = {"kind": "curb", "start": -50.0, "length": 200.0, "height": 0.15, "side_distance": 0.1}
ICE = {"kind": "patch", "start": -100.0, "friction": 0.1}
TO_COME_TO_REST = 6.0
"""s"""


def total_mass(vehicle) -> float:
    return vehicle.sprung_mass + vehicle.per_wheel("unsprung_mass").sum()


@pytest.mark.parametrize("model", ["1", "2"])
def test_a_vehicle_sinks_into_soft_soil_by_its_load_over_the_stiffness(reference, model):
    simulation = Simulation(reference, Options(model), step=2e-3, road=road(SOIL))
    simulation.reset(0.0)
    height = simulation.state.z
    simulation.step(Command(brake_torque=(5e3,) * 4), TO_COME_TO_REST)
    load, sinkage = simulation.outputs["normal_force"], simulation.outputs["road_terms"]["sinkage"]
    # it still rocks a little
    assert load.sum() == pytest.approx(9.81 * total_mass(reference), rel=1e-3)
    assert sinkage == pytest.approx(load / 8e4, rel=1e-6)
    if model == "1":  # in model 2 the tires also scrub sideways as the body sinks
        by_axle = 0.6 * sinkage[LF] + 0.4 * sinkage[LR]  # 1.524 and 1.016 of a wheelbase of 2.54
        assert height - simulation.state.z == pytest.approx(by_axle, rel=1e-2)


def test_a_furrow_resists_with_the_passive_earth_pressure_of_rankine(reference):
    simulation = Simulation(reference, step=1e-3, road=road({**SOIL, "friction_angle": 30.0}))
    simulation.reset(0.0)
    simulation.step(Command(), 1.0)
    simulation.state.v = 3.0
    simulation.step(Command(), 0.01)
    terms = simulation.outputs["road_terms"]
    z, passive = terms["sinkage"], 3.0  # tan^2 of 60 degrees
    pressure = 0.2 * (2 * 4e3 * math.sqrt(passive) * z + 1.6e4 * passive * z**2 / 2)
    assert (z > 0.02).all()
    assert terms["side_y"] == pytest.approx(-pressure, rel=1e-9)  # it slides to the left
    assert (terms["side_height"] < z / 2).all()
    assert (terms["side_height"] > z / 3).all()


@pytest.mark.parametrize("raised", ["left", "right"])
def test_the_face_of_a_curb_is_a_spring_against_the_side_wall(reference, raised):
    side = 1.0 if raised == "left" else -1.0
    foot = side * (reference.front_track / 2 + 0.06)  # 40 mm less than the sidewall is away
    curb = {**CURB, "raised": raised, "offset": foot, "stiffness": 2e5}
    simulation = Simulation(reference, road=road(curb))
    terms = simulation.outputs["road_terms"]
    near, far = ([LF, LR], [RF, RR]) if raised == "left" else ([RF, RR], [LF, LR])
    assert terms["side_y"][near] == pytest.approx([-side * 2e5 * 0.04] * 2, rel=1e-9)
    assert terms["side_y"][far].tolist() == [0.0, 0.0]
    assert terms["side_x"] == pytest.approx([0.0] * 4, abs=1e-9)
    assert terms["side_height"][near] == pytest.approx([0.075, 0.075])


def test_a_curb_ahead_does_not_push_the_side_of_a_wheel(reference):
    across = {**CURB, "start": 1.1, "offset": -50.0, "heading": 90.0, "raised": "right"}
    simulation = Simulation(reference, road=road(across))
    assert np.abs(simulation.outputs["road_terms"]["side_x"]).max() == 0.0


def critical_speed(vehicle) -> float:
    """That of a rigid block whose lower edge is stopped: plastic impact, then energy (m/s).

    m v h = Jo w about the edge, and Jo w^2 / 2 = m g (r - h) with r from the edge to the c.g.
    """
    m, half = total_mass(vehicle), vehicle.front_track / 2
    masses = vehicle.per_wheel("unsprung_mass")
    wheel = vehicle.tire_radius - 0.02
    height = (vehicle.sprung_mass * vehicle.cg_height + masses.sum() * wheel) / m
    inertia = vehicle.roll_inertia + vehicle.sprung_mass * (vehicle.cg_height - height) ** 2
    inertia += (masses * (half**2 + (height - wheel) ** 2)).sum()
    reach = math.hypot(half, height)
    about_edge = inertia + m * reach**2
    return math.sqrt(2 * 9.81 * (reach - height) * about_edge / m) / height


@pytest.mark.parametrize("model", ["1", "2"])
def test_a_curb_trips_a_sliding_vehicle_at_about_the_critical_speed_of_a_block(reference, model):
    """Springs and sidewalls give back what the impact of a block would lose: a little sooner."""
    critical = critical_speed(reference)
    assert critical == pytest.approx(5.0, abs=0.1)
    trips = {}
    for share in (0.7, 1.05):
        curb = {**CURB, "offset": 2.0}
        simulation = Simulation(reference, Options(model), road=road(curb, ICE))
        simulation.reset(0.0)
        simulation.state.v = share * critical
        simulation.step(Command(), 2.5)
        trips[share] = simulation.condition
    assert trips == {0.7: Condition.RUNNING, 1.05: Condition.ROLLED_OVER}
