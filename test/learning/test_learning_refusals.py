"""What an environment refuses, in one line each."""

import importlib
import sys

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium", reason="gymnasium is not installed")

import vehicle_roll_sim.learning  # noqa: E402
from vehicle_roll_sim import InputError  # noqa: E402

REFUSED = {
    "manoeuvre: 'fishhook' is unknown: did you mean": {"manoeuvre": "fishhook"},
    "manoeuvre: [] is not allowed: a list of one or more of": {"manoeuvre": []},
    "vehicle: ": {"vehicle": "no_such_car"},
    "actions: 'brakes' is unknown: did you mean brake?": {"actions": ["brakes"]},
    "actions: 'brake' is not allowed: a list of one or more of": {"actions": "brake"},
    "actions: brake is given twice: each name once": {"actions": ["brake", "brake"]},
    "actions: 'steering' is not allowed: with manoeuvre=None only": {"actions": ["steering"]},
    "observations: 'rol' is unknown: did you mean roll?": {"observations": ["rol"]},
    "observations: 'pitch' is not allowed: a quantity that the model, or a sensor, has": {
        "observations": ["roll", "pitch"],
        "model": "8dof",
    },
    "factors: vehicle.cg_hight: 'cg_hight' is unknown": {"factors": {"vehicle.cg_hight": [0.7]}},
    "factors: 3 is not allowed: values by name": {"factors": 3},
    "fixed: manoeuvre.duration: -1 is not allowed": {"fixed": {"manoeuvre.duration": -1}},
    "duration: 0.001 is not allowed: a multiple": {"fixed": {"manoeuvre.duration": 0.001}},
    "period: 0.001 is not allowed: a multiple of the step": {"period": 0.001},
    "step: 1 is not allowed: a number from": {"step": 1},
    "stop_roll: 100 is not allowed": {"stop_roll": 100},
    "limits.brake_torque_limit: -1 is not allowed": {"limits": {"brake_torque_limit": -1}},
    "limits.brake_limit: 1.0 is not allowed: a limit of one of the actions": {
        "limits": {"brake_limit": 1.0}
    },
    "limits: 3 is not allowed: values by name": {"limits": 3},
    "limits.name: 'brake' is unknown": {"limits": {"brake": 1.0}},
    "limits.name: 1 is unknown": {"limits": {1: 1.0}},
    "step: b'x' is not allowed": {"step": b"x"},
    "correlations: <object": {"correlations": object()},
    "reward: 1.0 is not allowed: a function": {"reward": 1.0},
}


@pytest.mark.parametrize("expected", REFUSED)
def test_an_argument_is_refused_in_one_line_that_names_it(expected):
    with pytest.raises(InputError) as raised:
        gymnasium.make("VehicleRoll-v0", **REFUSED[expected])
    message = str(raised.value)
    assert expected in message
    assert message.startswith(expected.partition(":")[0])
    assert "\n" not in message


@pytest.mark.parametrize(
    ("expected", "action"),
    [
        (
            r"^action: nan is not allowed: finite numbers of shape \(1, 4\)$",
            [0.0, 0.0, np.nan, 0.0],
        ),
        (r"^action: shape \(1, 3\): finite numbers of shape \(1, 4\)$", [0.0, 0.0, 0.0]),
        (r"^action: .* is not allowed: finite numbers", ["a", "b", "c", "d"]),
    ],
)
def test_an_action_is_refused_that_is_not_one(expected, action):
    env = gymnasium.make("VehicleRoll-v0").unwrapped
    env.reset(seed=0)
    with pytest.raises(InputError, match=expected):
        env.step(action)


def test_a_reset_refuses_what_is_no_factor_and_values_out_of_range():
    env = gymnasium.make("VehicleRoll-v0").unwrapped
    with pytest.raises(InputError, match=r"^options: 'speed' is unknown"):
        env.reset(options={"speed": 20.0})
    with pytest.raises(InputError, match=r"^options: manoeuvre.speed: -3.0 is not allowed"):
        env.reset(options={"manoeuvre.speed": -3.0})


@pytest.mark.parametrize("options", [0, "", [], np.zeros(2)])
def test_a_reset_refuses_options_that_are_no_mapping(options):
    for env in (gymnasium.make("VehicleRoll-v0").unwrapped, gymnasium.make_vec("VehicleRoll-v0")):
        with pytest.raises(InputError, match=r"^options: .* is not allowed: values by name"):
            env.reset(options=options)


@pytest.mark.parametrize("seed", [1.5, "ab", [1], np.array([1, 2]), {1: 2, 2: 3}])
def test_seeds_are_whole_numbers_as_many_as_environments(seed):
    env = gymnasium.make_vec("VehicleRoll-v0", 2)
    with pytest.raises(InputError, match=r"^seed: .* a whole number, or a list of 2 of them$"):
        env.reset(seed=seed)


@pytest.mark.parametrize(
    ("expected", "given"),
    [
        ("num_envs: 0 is not allowed", {"num_envs": 0}),
        ("autoreset_mode: 'never' is not allowed: one of", {"autoreset_mode": "never"}),
        ("workers: 0 is not allowed", {"workers": 0}),
    ],
)
def test_arguments_of_many_environments(expected, given):
    with pytest.raises(InputError) as raised:
        gymnasium.make_vec("VehicleRoll-v0", **{"num_envs": 1} | given)
    assert str(raised.value).startswith(expected)


@pytest.mark.parametrize(("reward", "returned"), [(1.0, r"shape \(\)"), (["a"], r"\['a'\]")])
def test_a_reward_of_another_shape_or_kind_is_refused(reward, returned):
    env = gymnasium.make("VehicleRoll-v0", reward=lambda *_: reward).unwrapped
    env.reset(seed=0)
    with pytest.raises(InputError, match=f"^reward: returned {returned}: an array of 1 numbers$"):
        env.step(np.zeros(4, np.float32))


def test_without_gymnasium_one_line_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "gymnasium", None)
    with pytest.raises(InputError, match=r"^VehicleRoll-v0: no Python package gymnasium: pip inst"):
        importlib.reload(vehicle_roll_sim.learning)
