"""Springs, dampers, stops and steering as a vehicle file may have them; refusals in one line."""

import numpy as np
import pytest
from vehicle_files import refused

from vehicle_roll_sim import Options, Simulation, Vehicle, preset
from vehicle_roll_sim.analysis.linear_model import linearize
from vehicle_roll_sim.analysis.trim import find_trim
from vehicle_roll_sim.simulation.description import describe, described
from vehicle_roll_sim.simulation.suspension_use import GUIDANCE

STOP = {"front_bump_stop_clearance": 0.05, "front_bump_stop_stiffness": 8e4}
SPRING = ((0.0, 0.0), (0.1, 3000.0), (0.2, 8000.0))
DAMPER = ((-1.0, -3000.0), (0.0, 0.0), (0.2, 500.0), (1.0, 900.0))
STEERED = {
    "rear_roll_steer": 0.05,
    "front_lateral_force_steer": -1e-6,
    "front_toe_change": 0.1,
}


def test_a_preloaded_spring_has_its_force_at_no_compression():
    """1500 N of preload and 30 N/mm carry the front of the vehicle at 0.091 m."""
    table = ((0.0, 1500.0), (0.2, 7500.0))
    vehicle = preset().with_values({"front_spring_force": table})
    load = 1440.0 * 9.81 * 0.3
    at_rest = vehicle.static_suspension_compression
    np.testing.assert_allclose(at_rest[:2], (load - 1500.0) / 30e3, rtol=1e-12)
    np.testing.assert_array_equal(at_rest[2:], preset().static_suspension_compression[2:])


def test_linear_models_have_the_stiffness_at_rest_and_the_mean_damping():
    values = {"front_spring_force": ((0.0, 0.0), (0.2, 7000.0)), "rear_rebound_damping": 3000.0}
    vehicle = preset().with_values(values)
    np.testing.assert_allclose(vehicle.per_wheel("spring_stiffness"), [35e3, 35e3, 30e3, 30e3])
    np.testing.assert_allclose(vehicle.per_wheel("damping"), [2500.0, 2500.0, 2500.0, 2500.0])


def test_a_table_replaces_its_coefficient_and_the_other_way_round():
    tabulated = preset().with_values({"rear_damper_force": DAMPER})
    assert tabulated.rear_damping is None
    assert tabulated.with_values({"rear_damping": 2000.0}) == preset()


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"front_spring_force": 30e3}, ["front_spring_force", "pairs [compression, value]"]),
        ({"front_spring_force": ((0.0, 0.0), (0.1, 0.0))}, ["front_spring_force", "rise"]),
        ({"rear_damper_force": ((0.1, 0.0), (1.0, 1.0))}, ["rear_damper_force", "point [0, 0]"]),
        ({"rear_damper_force": ((0.0, 0.0), (1.0, -1.0))}, ["rear_damper_force", "do not fall"]),
        ({"rear_damper_force": ((0.0, 0.0), (30.0, 1.0))}, ["pairs [velocity, value]"]),
        (
            {"rear_damper_force": DAMPER, "rear_rebound_damping": 1.0},
            ["rear_rebound_damping", "rear_damper_force"],
        ),
        ({"front_bump_stop_stiffness": 1e4}, ["front_bump_stop_clearance", "required"]),
        ({"rear_rebound_stop_clearance": 0.1}, ["rear_rebound_stop_stiffness", "above 0"]),
        ({"front_spring_force": ((0.0, 0.0), (0.1, 1.0))}, ["front_spring_force", "sprung mass"]),
    ],
)
def test_what_does_not_make_sense_is_refused(values, words):
    with refused(*words):
        preset().with_values(values)


@pytest.mark.parametrize(
    "values",
    [STOP, {"rear_rebound_damping": 1.0}, *({name: value} for name, value in STEERED.items())],
)
def test_the_8_dof_model_refuses_what_needs_struts_or_wheel_travel(values):
    with refused(*list(values)[:1], "8dof"):
        Simulation(preset().with_values(values), Options(model="8dof"))


@pytest.mark.parametrize("model", ["1", "1a", "8dof"])
@pytest.mark.parametrize("name", GUIDANCE)
def test_models_without_guided_wheels_refuse_their_curves(model, name):
    with refused(f"rear_{name}", "model 2"):
        Simulation(preset().with_values({f"rear_{name}": 0.1}), Options(model=model))


def test_compliance_by_aligning_moment_needs_the_moment():
    vehicle = preset().with_values({"front_aligning_moment_steer": 1e-5})
    with refused("front_aligning_moment_steer", "tire_moments"):
        Simulation(vehicle, Options(tire_moments="off"))
    Simulation(vehicle, Options(tire_moments="on"))


def test_compliance_camber_needs_a_tire_that_inclines():
    vehicle = preset().with_values({"rear_lateral_force_camber": 1e-6})
    with refused("rear_lateral_force_camber", "depends on inclination"):
        Simulation(vehicle)
    with refused("rear_lateral_force_camber", "14 DOF"):
        Simulation(vehicle, Options(model="8dof"))


def test_a_description_has_every_detail():
    vehicle: Vehicle = preset().with_values(
        {**STOP, **STEERED, "front_spring_force": SPRING, "rear_damper_force": DAMPER}
        | {"ackermann_percentage": 50.0, "engine_drag": 1.0, "rear_toe": 0.001}
    )
    simulation = Simulation(vehicle, Options(wheel_gyroscopics=True))
    again = described(describe(simulation, 10_000_000)).simulation
    assert again.vehicle.given == simulation.vehicle.given
    assert again.options == simulation.options


def test_a_linear_model_has_the_mean_of_bump_and_rebound():
    both = {"front_damping": 1500.0, "front_rebound_damping": 3500.0}
    asymmetric, mean = preset().with_values(both), preset().with_values({"front_damping": 2500.0})
    models = [
        linearize(find_trim(vehicle, speed=15.0, lateral_acceleration=2.0))
        for vehicle in (asymmetric, mean)
    ]
    np.testing.assert_allclose(models[0].a, models[1].a, rtol=1e-9, atol=1e-9)
