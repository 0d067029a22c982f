"""A batch gives the numbers of single runs, whatever becomes of its other runs."""

import dataclasses
import itertools
import math
import os
import subprocess
import sys

import numpy as np
import pytest
from actuated import actuated
from patience import PATIENCE

from vehicle_roll_sim import (
    Batch,
    Condition,
    Feedback,
    InputError,
    Options,
    PlausibilityWarning,
    Road,
    preset,
    run,
)
from vehicle_roll_sim.batch.case import Case
from vehicle_roll_sim.batch.evaluate import AHEAD, evaluate, outcomes
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.manoeuvres.command_file import command_table
from vehicle_roll_sim.model.records import STATE_NAMES
from vehicle_roll_sim.model.variants import MODELS

FISHHOOK = dataclasses.replace(STANDARD["nhtsa_fishhook"], steering_at_03g=20.0)
J_TURN = STANDARD["j_turn"]
SHORT = {"duration": 0.2, "step": 0.002}
TURNED = command_table({"time": [0.0, 0.1, 0.2005], "steering": [0.0, 0.05, 0.05]})
"""Its duration is no multiple of the step."""
OPTIONS = (
    *(Options(model=name) for name in MODELS),
    Options(no_roll_centre=True),
    Options(steady_state_slip=True, tire_moments="off"),
    Options(wheel_gyroscopics=True, euler_terms=True, link_load_transfer="asymmetric"),
)
VARIED = [
    *({"options": each, "manoeuvre": TURNED} for each in OPTIONS),
    {"manoeuvre": FISHHOOK, "duration": 2.5, "speed": 14.0},
    {"manoeuvre": FISHHOOK, "duration": 4.0, "vehicle": preset("suv"), "step": 0.005},
    {"manoeuvre": STANDARD["iso_double_lane_change"], "duration": 1.2, "step": 0.002},
    {"manoeuvre": J_TURN, "speed": 25.0, "road": Road(bank=-0.05), "step": 0.005},
    {"manoeuvre": J_TURN, "rollover_angle": 0.05, "vehicle": preset("van"), "step": 0.005},
    {"manoeuvre": FISHHOOK, "duration": 1.5, "vehicle": actuated("suv")},
]
"""What distinguishes the runs of one batch."""


@pytest.fixture(scope="module")
def varied():
    """The batch of VARIED and its result, with histories."""
    columns = {name: [each.get(name) for each in VARIED] for name in ("options", "road")}
    for name, default in {"step": 0.001, "rollover_angle": 1.4, "speed": 12.0}.items():
        columns[name] = [each.get(name, default) for each in VARIED]
    batch = Batch(
        [each.get("vehicle", preset()) for each in VARIED],
        manoeuvre=[each["manoeuvre"] for each in VARIED],
        duration=[each.get("duration") for each in VARIED],
        **columns,
    )
    return batch, batch.run(workers=3, histories=True)


@pytest.mark.parametrize("i", range(len(VARIED)))
def test_a_run_of_a_batch_is_a_single_run_to_the_last_bit(varied, i):
    batch, result = varied
    case = batch[i]
    values = {"speed": case.speed} | ({"duration": case.duration} if case.duration else {})
    about = {"options": case.options, "road": case.road, "step": case.step}
    single = run(
        case.manoeuvre, case.vehicle, rollover_angle=case.rollover_angle, **about, **values
    )
    assert (result.failures[i], result.conditions[i]) == ("", single.condition)
    assert (
        np.array([result[name][i] for name in result.columns]).tobytes()
        == np.array(list(single.metrics.values())).tobytes()
    )
    assert tuple(single.metrics) == result.columns
    assert result.histories[i].rows.tobytes() == single.history.rows.tobytes()
    assert result.histories[i].commands.tobytes() == single.history.commands.tobytes()
    assert result.final_states["yaw"][i] == single["yaw"][-1]


def test_the_batch_contains_every_ending(varied):
    _, result = varied
    assert {*result.conditions} == {Condition.RUNNING, Condition.ROLLED_OVER}
    assert np.isnan(result["rollover_time"]).any()
    assert not np.isnan(result["two_wheel_lift_time"]).all()


@dataclasses.dataclass(frozen=True, kw_only=True)
class Broken(Manoeuvre):
    """A driver of a user's own, with a fault."""

    def driver(self) -> Feedback:
        return Faulty()


class Faulty(Feedback):
    def command(self, time, state):
        raise ZeroDivisionError("by\nnothing")


def test_what_fails_is_said_and_the_others_go_on():
    torque = command_table({"time": [0.0, 0.1, 0.3], "wheel_torque_lf": [0.0, 1e12, 1e12]})
    good = Case(vehicle=preset(), manoeuvre=J_TURN, **SHORT)
    bad = {
        "refused: speed: -1.0 is not allowed: ": {"speed": -1.0},
        "refused: step: 0.05 is not allowed: at most ": {"step": 0.05},
        "refused: duration: 0.2001 is not allowed: a multiple ": {"duration": 0.2001},
        "refused: model: '9' is not allowed: one of 1, ": {"model": "9"},
        "refused: vehicle: 'van' is not allowed: an instance of Vehicle": {"vehicle": "van"},
        "refused: road: 1.0 is not allowed: an instance of Road": {"road": 1.0},
        "refused: manoeuvre: 'j_turn' is not allowed: ": {"manoeuvre": "j_turn"},
        "diverged at 0.0": {"manoeuvre": torque, "duration": None},
        "failed: ZeroDivisionError: by nothing": {"manoeuvre": Broken(duration=1.0)},
    }
    cases = [good, *(dataclasses.replace(good, **values) for values in bad.values()), good]
    first, *failed, last = evaluate(cases, workers=2)
    for outcome, expected in zip(failed, bad, strict=True):
        assert outcome.failure.startswith(expected)
        assert outcome.metrics == {}
        diverged = expected.startswith("diverged")
        assert outcome.condition is (Condition.DIVERGED if diverged else None)
        assert math.isnan(outcome.final_state.u) is not diverged
    assert (first.failure, first.condition) == ("", Condition.RUNNING)
    assert repr(first.metrics) == repr(last.metrics)  # nan equals nan


def test_cases_without_end_are_run_as_their_outcomes_are_wanted():
    given = 0

    def cases():
        nonlocal given
        for given in itertools.count(1):
            yield Case(vehicle=preset(), manoeuvre=J_TURN, speed=1.0 + given, **SHORT)

    found = outcomes(cases(), workers=2)
    speeds = [next(found).final_state.u for _ in range(3)]
    found.close()
    assert speeds == pytest.approx([2.0, 3.0, 4.0], abs=0.1)
    assert given <= 2 * AHEAD + 3


@pytest.mark.parametrize(
    ("values", "problem"),
    [
        ({"speed": [10.0, 11.0]}, "speed: 2 values, but 3 of vehicles: one value, or one for each"),
        ({"speed": [10.0] * 2, "step": [1e-3] * 2}, "vehicles: 3 values, but 2 of speed: one val"),
        ({"manoeuvre": "j_trn"}, "manoeuvre: 'j_trn' is unknown: did you mean j_turn?"),
        ({"manoeuvre": ["j_turn", "x", "j_turn"]}, "manoeuvre: 'x' is unknown: one of "),
    ],
)
def test_a_batch_that_does_not_fit_together_is_refused(values, problem):
    with pytest.raises(InputError) as raised:
        Batch([preset()] * 3, **{"manoeuvre": "j_turn"} | values)
    assert str(raised.value).startswith(problem)


@pytest.mark.parametrize("workers", [0, 1.5, True])
def test_a_number_of_workers_that_is_none_is_refused(workers):
    with pytest.raises(InputError, match=r"^workers: .*: a whole number of at least 1$"):
        Batch(preset(), manoeuvre="j_turn").run(workers=workers)


def test_the_result_is_a_table_of_metrics_by_name():
    batch = Batch(preset(), manoeuvre="j_turn", speed=np.array([10.0, -1.0]), **SHORT)
    result = batch.run(workers=1)
    assert len(batch) == len(result) == 2
    assert [case.speed for case in batch] == [10.0, -1.0]
    table = result.to_numpy()
    assert table.dtype.names == result.columns == (*result.units,)
    assert table["end_time"][0] == result["end_time"][0] == 0.2
    assert np.isnan(result["end_time"][1])
    assert result.units["peak_roll"] == "rad"
    assert result.histories == []
    with pytest.raises(KeyError, match="no metric 'rol': one of peak_roll, "):
        result["rol"]
    with pytest.raises(IndexError):
        batch[2]


@pytest.mark.filterwarnings("error")
def test_implausible_vehicles_of_a_batch_are_not_warned_of_one_by_one():
    low = preset().with_values({"cg_height": 0.55})
    batch = Batch(low, manoeuvre="j_turn", **SHORT)
    assert batch.run(workers=1).failures == [""]
    with pytest.raises(PlausibilityWarning):
        run("j_turn", low, **SHORT)


PLAIN = """
import dataclasses
from vehicle_roll_sim import Batch, preset
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
fishhook = dataclasses.replace(STANDARD["nhtsa_fishhook"], steering_at_03g=20.0, start=0.01)
both = [dataclasses.replace(STANDARD["j_turn"], start=0.01), fishhook]
result = Batch(preset(), manoeuvre=both, duration=0.06, step=0.005).run()
print(*result.final_states.view(float), *result.to_numpy().view(float))
"""


def test_without_numba_a_batch_gives_the_same_numbers():
    """But for the order of sums in compiled code. Seen: no difference."""
    found = [
        subprocess.run(
            [sys.executable, "-c", PLAIN],
            env=os.environ | environment,
            timeout=PATIENCE,
            capture_output=True,
            text=True,
            check=True,
        ).stdout.split()
        for environment in ({}, {"NUMBA_DISABLE_JIT": "1"})
    ]
    compiled, plain = (np.array(each, float) for each in found)
    assert np.isfinite(compiled).sum() > 2 * len(STATE_NAMES) - 1
    np.testing.assert_allclose(plain, compiled, rtol=1e-9, atol=1e-12)
