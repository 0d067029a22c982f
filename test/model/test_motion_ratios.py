"""Springs and dampers that are not at the wheel: their forces by virtual work."""

import numpy as np
import pytest
from programmes import Evaluation
from random_states import random_command, random_state

from vehicle_roll_sim import Command, InputError, Options, Simulation, Vehicle, preset

FRONT, REAR = (0.7, 0.8), (1.2, 0.6)
"""Motion ratios of spring and damper."""
ROUNDING = 1e-9
"""Relative, after a second of motion that is not chaotic."""


def with_ratios() -> Vehicle:
    names = ("spring_motion_ratio", "damper_motion_ratio")
    ratios = {"front": FRONT, "rear": REAR}
    return preset().with_values(
        {f"{axle}_{n}": r for axle in ratios for n, r in zip(names, ratios[axle], strict=True)}
    )


def at_the_wheels() -> Vehicle:
    given = preset().given
    return preset().with_values(
        {
            "front_spring_stiffness": given["front_spring_stiffness"] * FRONT[0] ** 2,
            "rear_spring_stiffness": given["rear_spring_stiffness"] * REAR[0] ** 2,
            "front_damping": given["front_damping"] * FRONT[1] ** 2,
            "rear_damping": given["rear_damping"] * REAR[1] ** 2,
        }
    )


@pytest.mark.parametrize("model", ["1", "1b", "2", "8dof"])
def test_with_constant_ratios_the_wheels_have_rates_times_their_squares(model):
    ends = []
    for vehicle in (with_ratios(), at_the_wheels()):
        simulation = Simulation(vehicle, Options(model=model))
        simulation.step(Command(steering=0.05), 1.0)
        ends.append([simulation.state.roll, simulation.state.yaw_rate, *simulation.state.u[None]])
    assert ends[0] == pytest.approx(ends[1], rel=ROUNDING)
    assert abs(ends[0][0]) > 0.05  # rad


RATIO, CHANGE = 0.8, 0.9
"""m/m and 1/m: a spring is compressed by RATIO q + CHANGE q^2 / 2."""
TABLE = tuple((float(q), float(RATIO * q + CHANGE * q**2 / 2)) for q in np.linspace(-0.6, 0.6, 25))


@pytest.fixture(scope="module")
def progressive() -> Vehicle:
    return preset().with_values(
        {"front_spring_motion_ratio": TABLE, "front_damper_motion_ratio": TABLE}
    )


@pytest.mark.parametrize("model", ["1", "2"])
def test_with_a_table_a_force_is_that_of_the_spring_times_the_present_ratio(progressive, model):
    evaluation = Evaluation(progressive, Options(model=model))
    rng, k, b = np.random.default_rng(3), 35e3, 2500.0  # N/m, N s/m
    load = 1440.0 * 9.81 * 1.524 / 2.54 / 2
    at_rest = progressive.static_suspension_compression[0]
    for _ in range(10):
        state, command = random_state(progressive, rng), random_command(rng)
        evaluation.rates(state, command)
        travel = state["suspension_compression"][:2] - at_rest
        rate = evaluation.outputs["suspension_rate"][:2]
        ratio = RATIO + CHANGE * travel
        spring = k * (RATIO * travel + CHANGE * travel**2 / 2) + load / RATIO
        expected = ratio * spring + ratio**2 * b * rate + command.normal_force[:2]
        np.testing.assert_allclose(evaluation.outputs["strut_force"][:2], expected, rtol=1e-7)


def test_linear_models_have_the_wheel_rate_at_rest(progressive):
    load, k = 1440.0 * 9.81 * 1.524 / 2.54 / 2, 35e3
    rate = k * RATIO**2 + load / RATIO * CHANGE
    assert progressive.per_wheel("spring_stiffness")[0] == pytest.approx(rate, rel=1e-7)


def test_a_vehicle_with_tables_stays_at_rest(progressive):
    simulation = Simulation(progressive, Options(model="2"))
    simulation.reset(0.0)
    before = simulation.state_vector.copy()
    simulation.step(Command(), 3.0)
    np.testing.assert_allclose(simulation.state_vector, before, atol=1e-9)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"front_spring_motion_ratio": 0.0}, "front_spring_motion_ratio.*at least 0.01"),
        ({"rear_damper_motion_ratio": ((0.0, 0.0), (0.1, -0.1))}, "rear_damper_.*rise"),
        (
            {"front_spring_motion_ratio": ((-0.1, -0.1), (0.0, 0.0), (0.1, 0.05))},
            "front_spring_motion_ratio.*stiffness at the wheel -",
        ),
    ],
)
def test_what_would_not_carry_is_refused(values, words):
    with pytest.raises(InputError, match=words):
        preset().with_values(values)


def test_a_model_without_wheel_travel_refuses_a_table(progressive):
    with pytest.raises(InputError, match=r"front_spring_motion_ratio.*14 DOF"):
        Simulation(progressive, Options(model="8dof"))
