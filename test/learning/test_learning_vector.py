"""Environments that are stepped together are single environments, to the bit."""

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium", reason="gymnasium is not installed")

from gymnasium.error import ResetNeeded  # noqa: E402

import vehicle_roll_sim.learning  # noqa: E402, F401
from vehicle_roll_sim import InputError  # noqa: E402

COUNT = 4
MIXED = {
    "manoeuvre": ["nhtsa_fishhook", "iso_double_lane_change"],
    "actions": ["brake", "normal_force"],
    "limits": {"brake_limit": 2000.0, "normal_force_limit": 1500.0},
    "fixed": {"manoeuvre.duration": 1.5},
    "factors": {
        "manoeuvre.speed": {"distribution": "normal", "mean": 18.0, "sd": 2.0},
        "road.bank": [0.0, 0.02],
    },
    "stop_roll": 3.0,
    "period": 0.05,
    "step": 0.005,
}
"""Some episodes of these end in a rollover, so called, and some with the time."""


def differences(one, other, place: str = "") -> list[str]:
    """Where two results of an environment differ in any bit, type or name."""
    if type(one) is not type(other):
        return [f"{place}: {type(one)} and {type(other)}"]
    if isinstance(one, tuple):
        pairs = {str(i): pair for i, pair in enumerate(zip(one, other, strict=True))}
    elif isinstance(one, dict):
        if one.keys() != other.keys():
            return [f"{place}: {sorted(one.keys() ^ other.keys())}"]
        pairs = {name: (one[name], other[name]) for name in one}
    else:
        if isinstance(one, np.ndarray) and one.dtype.hasobject:
            same = repr(one.tolist()) == repr(other.tolist())
        elif isinstance(one, np.ndarray):
            same = (one.dtype, one.tobytes()) == (other.dtype, other.tobytes())
        else:
            same = one == other
        return [] if same else [f"{place}: {one} and {other}"]
    return [each for name in pairs for each in differences(*pairs[name], f"{place}/{name}")]


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
def test_they_are_those_that_gymnasium_steps_one_by_one(mode):
    ours = gymnasium.make_vec("VehicleRoll-v0", COUNT, autoreset_mode=mode, workers=2, **MIXED)
    theirs = gymnasium.make_vec(
        "VehicleRoll-v0",
        COUNT,
        vectorization_mode="sync",
        vector_kwargs={"autoreset_mode": mode},
        **MIXED,
    )
    assert ours.metadata == theirs.metadata
    for name in ("single_action_space", "action_space", "single_observation_space"):
        assert getattr(ours, name) == getattr(theirs, name)
    assert ours.observation_space == theirs.observation_space
    assert differences(ours.reset(seed=3), theirs.reset(seed=3)) == []
    theirs.action_space.seed(1)
    terminations = truncations = 0
    for _ in range(100):
        actions = theirs.action_space.sample()
        found, expected = ours.step(actions), theirs.step(actions)
        assert differences(found, expected) == []
        terminations, truncations = terminations + found[2].sum(), truncations + found[3].sum()
    assert min(terminations, truncations) > 2
    level = {"road.bank": 0.0}
    assert differences(ours.reset(options=level), theirs.reset(options=level)) == []
    ours.close()
    theirs.close()


def test_without_autoreset_what_has_ended_must_be_reset_by_name():
    factors = {"manoeuvre.duration": [0.4]}
    given = {"autoreset_mode": "Disabled", "period": 0.02, "factors": factors}
    envs = gymnasium.make_vec("VehicleRoll-v0", 2, **given)
    actions = np.zeros(envs.action_space.shape, np.float32)
    with pytest.raises(ResetNeeded):
        envs.step(actions)
    with pytest.raises(InputError, match=r"^reset_mask: .* not in the first reset"):
        envs.reset(options={"reset_mask": np.array([True, False])})
    second = np.array([False, True])
    envs.reset(seed=0)
    envs.reset(options={"reset_mask": second, "manoeuvre.duration": 0.04})
    for _ in range(2):
        observations, _, _, truncated, _ = envs.step(actions)
    assert truncated.tolist() == second.tolist()
    with pytest.raises(
        InputError, match=r"^step: the episodes \[1\] have ended: only after a reset"
    ):
        envs.step(actions)
    again, infos = envs.reset(options={"reset_mask": second})
    assert (again[0] == observations[0]).all()
    assert infos["_time"].tolist() == second.tolist()
    *_, infos = envs.step(actions)
    assert infos["time"].tolist() == [0.06, 0.02]
    with pytest.raises(InputError, match=r"^reset_mask: .* a boolean array of shape \(2,\)"):
        envs.reset(options={"reset_mask": np.array([1, 0])})
    envs.close()
