"""Every model and option against a second evaluation of its equations, and its properties."""

import numpy as np
import pytest
import variant_equations
from mechanics import along, external, momenta, slope
from programmes import Evaluation
from random_states import random_command, random_state, wheel_centres
from test_momentum import close

from vehicle_roll_sim import Command, Options, Simulation
from vehicle_roll_sim.simulation.options import MODELS

pytestmark = [pytest.mark.slow, pytest.mark.unmeasured]

STATES = 50
"""Random states per variant: half of them at moderate angles, half at anything up to 70 degrees."""
MODERATE = 0.15
"""Share of the spread of roll and pitch that makes up to 10 and 4 degrees of them."""
RELATIVE = 1e-10
"""Of the largest rate of a quantity: two orders of summation and a 6 x 6 solution, seen 4e-14."""
ACCELERATIONS = ("u", "v", "w", "roll_rate", "pitch_rate", "yaw_rate")
VARIANTS = [
    *(
        {"model": model, "no_roll_centre": none}
        for model in MODELS
        if model != "2" and not model.startswith("8dof")
        for none in (False, True)
    ),
    {"tire_normal_to_ground": True},
    {"tire_normal_to_ground": True, "no_roll_centre": True},
    {"link_load_transfer": "asymmetric"},
    {"link_load_transfer": "asymmetric", "tire_normal_to_ground": True},
    {"euler_terms": True},
    {"link_load_transfer": "asymmetric", "tire_normal_to_ground": True, "euler_terms": True},
]


def in_words(variant: dict) -> str:
    values = [str(value) for value in variant.values() if isinstance(value, str)]
    return " ".join(values + [name for name, value in variant.items() if value is True])


def states(vehicle, seed: int):
    """Pairs of STATE and COMMAND records; every second state has moderate roll and pitch."""
    rng = np.random.default_rng(seed)
    for number in range(STATES):
        state, command = random_state(vehicle, rng), random_command(rng)
        command["speed_hold_gain"], command["speed_hold_target"] = rng.uniform(0, (2000, 30))
        if number % 2:
            state["roll"] *= MODERATE
            state["pitch"] *= MODERATE
            state["tire_compression"] = vehicle.tire_radius - wheel_centres(vehicle, state)[:, 2]
        yield state, command


def accelerations(rates) -> np.ndarray:
    return np.array([rates[name] for name in ACCELERATIONS])


@pytest.fixture(params=VARIANTS, ids=in_words)
def options(request) -> Options:
    return Options(**request.param, steady_state_slip=True)


def test_rates_are_those_of_the_equations_of_the_variant(vehicle, options):
    evaluation = Evaluation(vehicle, options)
    for state, command in states(vehicle, seed=1):
        rates = evaluation.rates(state, command)
        expected = variant_equations.rates(vehicle, options, state, command)
        close_to(accelerations(rates), accelerations(expected), "accelerations")
        for name in expected.keys() - ACCELERATIONS:
            close_to(rates[name], expected[name], name)


def close_to(mine, expected, name: str):
    largest = max(np.abs(expected).max(), 1.0)  # 1 m/s, rad/s or their rates where all are small
    np.testing.assert_allclose(mine, expected, rtol=0, atol=RELATIVE * largest, err_msg=name)


def test_the_states_lift_wheels_of_one_side_of_both_and_of_none(vehicle):
    lifted = [state["tire_compression"] <= 0 for state, _ in states(vehicle, seed=1)]
    assert {0, 1, 2, 3, 4} == {int(wheels.sum()) for wheels in lifted}


def test_nothing_accelerates_at_rest_in_any_variant(vehicle, options):
    state = Simulation(vehicle, options).state
    rates = Evaluation(vehicle, options).rates(state, Command().records()[0])
    # m/s^2, rad/s^2: forces of 1e4 N cancel to 1e-11 N
    assert np.abs(accelerations(rates)).max() < 1e-9
    assert np.abs(rates["unsprung_velocity"]).max() < 1e-9


@pytest.mark.parametrize("link_load_transfer", ["symmetric", "asymmetric"])
def test_link_load_transfer_leaves_the_momenta_to_the_tires_and_weights(
    vehicle, link_load_transfer
):
    """The sum of Fdz lifts the body as much as it presses the wheels, with its moments."""
    variant = Options(link_load_transfer=link_load_transfer, euler_terms=True)
    evaluation = Evaluation(vehicle, variant)
    for state, command in states(vehicle, seed=2):
        rates = evaluation.rates(state, command)
        linear, angular = momenta(vehicle, along(state, rates))
        forces, points = external(vehicle, state, evaluation.outputs)
        assert close(slope(linear), forces), state
        assert close(slope(angular), np.cross(points, forces)), state


def test_link_load_transfer_lifts_the_body_only_where_it_is_asymmetric(vehicle):
    state, command = next(states(vehicle, seed=3))
    sums = {}
    for kind in ("symmetric", "asymmetric"):
        evaluation = Evaluation(vehicle, Options(link_load_transfer=kind, steady_state_slip=True))
        evaluation.rates(state, command)
        axles = evaluation.outputs["link_load_transfer"].reshape(2, 2)
        sums[kind] = np.abs(axles.sum(axis=1)) / np.abs(axles).max()
    assert sums["symmetric"].max() < 1e-12  # of the larger force: rounding
    assert sums["asymmetric"].min() > 0.01


def with_model(model: str) -> Options:
    return Options(model=model, steady_state_slip=True)


def second_order_difference(vehicle, state, command, share: float) -> float:
    """Between the accelerations of models 1 and 1a with all small quantities at a share of them."""
    nearer = state.copy()
    for name in ("roll", "pitch", "w", "unsprung_velocity"):
        nearer[name] *= share  # the wheels' vertical velocity on a road is of the angles' order
    exact, small = (
        accelerations(Evaluation(vehicle, with_model(model)).rates(nearer, command))
        for model in ("1", "1a")
    )
    return np.abs(exact - small).max()


def test_small_angles_differ_from_model_1_in_second_order(vehicle):
    """Halving angles of 0.002 rad divides the difference by 4, but for the third order's share."""
    for state, command in states(vehicle, seed=4):
        state["roll"], state["pitch"] = np.copysign(0.002, (state["roll"], state["pitch"]))
        state["unsprung_velocity"] *= 0.005
        whole, half = (
            second_order_difference(vehicle, state, command, share) for share in (1.0, 0.5)
        )
        assert 0.0 < half < whole / 3.8


def test_the_default_is_model_1_with_every_flag_off(vehicle):
    assert Options() == Options(model="1")
    record = Options().record()[0]
    assert not any(record[name] for name in record.dtype.names)
    default, named = Evaluation(vehicle, Options()), Evaluation(vehicle, Options(model="1"))
    for state, command in states(vehicle, seed=5):
        assert default.rates(state, command).tobytes() == named.rates(state, command).tobytes()


def test_every_variant_is_another_than_every_other(reference):
    """At a state with two wheels off the ground: no option is without effect."""
    lifted = (
        (state, command)
        for state, command in states(reference, seed=6)
        if (state["tire_compression"] <= 0).sum() == 2
    )
    state, command = next(lifted)
    results = {
        Evaluation(reference, Options(**variant, steady_state_slip=steady))
        .rates(state, command)
        .tobytes()
        for variant in VARIANTS
        for steady in (False, True)
    }
    assert len(results) == 2 * len(VARIANTS)
