"""Each claim of the paper holds, with the numbers of another implementation, and could fail."""

import collections
import dataclasses
import importlib.util
import math
from decimal import Decimal

import numpy as np
import pytest
from scipy.signal import find_peaks
from studies import Rerun

from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.paper.claim import (
    FAILS,
    HOLDS,
    Claim,
    percent_more,
)
from vehicle_roll_sim.paper.report import (
    CLAIMS,
    as_text,
    check_claims,
)
from vehicle_roll_sim.paper.study import (
    ASYMMETRIC_LINKS,
    NO_ROLL_CENTRE,
    RUNS,
    SAME_AS_ENGINE,
    UPRIGHT_TIRES,
    Response,
    Study,
)
from vehicle_roll_sim.runs.history import History

HAS_ENGINE = importlib.util.find_spec("mujoco") is not None
NUMBERS = [claim.number for claim in CLAIMS]
CHECKED = [claim.number for claim in CLAIMS if HAS_ENGINE or not claim.needs_engine]
SEEN = {
    (1, "roll difference"): "0.02",
    (2, "roll difference up to 8°"): "0.05",
    (2, "at 15°"): "0.9",
    (3, "peak roll above 1a"): "4.6",
    (4, "1b"): "5.41",
    (5, "85° earlier than 1b"): "0.36",
    (6, "peak roll above 1b"): "16",
    (8, "peak roll of 1c-i"): "11.1",
    (9, "steady loads below the weight"): "3.4",
    (9, "steady roll changed by"): "0.9",
    (10, "steady loads above the weight"): "3.5",
    (10, "peak roll in the ramp"): "14.2",
    (10, "lift-off of lr"): "3.30",
    (12, "roll difference from 1b until lift-off"): "0.23",
    (13, "roll difference from 1b until lift-off"): "0.06",
    (14, "steady roll"): "21",
    (14, "overshoot of rf's load"): "38",
    (17, "steady roll"): "0.9",
    (20, "rms of roll"): "2.7",
    (21, "peak roll of 8dof"): "9.05",
}
"""What another implementation saw: claim and name of the number, and its magnitude as printed.

Two of its numbers are left out, because they depend on more than is said of them. Claim 3: 0.2 to
0.4 % more peak front load transfer; here 0.48, without the speed held 0.40, with the steering
turned in 0.2 s 0.23. Claim 11: 0.93 and 1.26 Hz; here 0.91 and 1.30, without the speed held 0.93
and 1.32, at 2 degrees 0.89 and 1.24. That the claims hold is tested all the same. Claims 16 and 19:
RAMP_EVENTS; the frequency of claim 17 has a test of its own.
"""
RAMP_EVENTS = {
    (NO_ROLL_CENTRE, "first_lift_off"): "2.99",
    (NO_ROLL_CENTRE, "rollover"): "5.60",
    (ASYMMETRIC_LINKS, "rollover"): "5.10",
}
"""s: what it saw for claims 16 and 19, whose numbers are differences from model 1."""
WRONG = {
    1: ("1a", "1c-i"),
    2: ("1a", "1"),
    3: ("1b", "1a"),
    4: ("1b", "1c-i"),
    5: ("1b-turning-kept", "1b"),
    6: ("1b-mass-lumped", "1b"),
    7: ("1c-i", "1b"),
    8: ("1c-i", "1b"),
    9: ("1c-ii", "1b"),
    10: ("1c-iii", "1b"),
    11: ("1c-iv", "1b"),
    12: ("1c-iv", "1c-iii"),
    13: ("1b-no-strut", "1c-iv"),
    14: (NO_ROLL_CENTRE, "1"),
    15: (NO_ROLL_CENTRE, UPRIGHT_TIRES),
    16: (NO_ROLL_CENTRE, "1"),
    17: (UPRIGHT_TIRES, "1"),
    18: (UPRIGHT_TIRES, "1"),
    19: (ASYMMETRIC_LINKS, NO_ROLL_CENTRE),
    20: ("8dof", "8dof-rigid-tires"),
    21: ("8dof", "1"),
    22: (SAME_AS_ENGINE, "1"),
}
"""For each claim the case that it is about, and one of which it is not true."""


def rounded_to(printed: str):
    """Whatever is printed so, to the digits that there are."""
    half_a_digit = 0.5 * 10.0 ** Decimal(printed).as_tuple().exponent
    return pytest.approx(float(printed), abs=half_a_digit)


def claim(number: int) -> Claim:
    return CLAIMS[NUMBERS.index(number)]


def test_there_are_22_claims_in_order():
    assert list(range(1, 23)) == NUMBERS


@pytest.mark.parametrize("number", CHECKED)
def test_every_claim_holds(study, number):
    finding = claim(number).check(study)
    assert finding.verdict == HOLDS, as_text([finding])


@pytest.mark.parametrize(("number", "name"), SEEN)
def test_its_numbers_are_those_of_another_implementation(study, number, name):
    (value,) = (m.value for m in claim(number).measure(study) if m.name == name)
    assert abs(value) == rounded_to(SEEN[number, name])


@pytest.mark.parametrize(("case", "event"), RAMP_EVENTS)
def test_events_of_the_ramp_steer_are_those_of_another_implementation(study, case, event):
    assert getattr(study.ramp(case), event) == rounded_to(RAMP_EVENTS[case, event])


def peaks_of_roll(response) -> np.ndarray:
    """Times (s) of the largest roll of each swing."""
    return response.time[find_peaks(response.roll)[0]]


def test_the_frequency_of_claim_17_is_that_of_another_implementation_read_from_the_roll(study):
    """The claim's is read from the roll rate, which is about the axis of the body: 17.8 %."""
    periods = [np.diff(peaks_of_roll(study.step(case)))[0] for case in ("1", UPRIGHT_TIRES)]
    assert percent_more(*periods) == rounded_to("17")


@pytest.mark.parametrize("case", ["1", "1b", "1c-iv", "1b-no-strut", NO_ROLL_CENTRE, UPRIGHT_TIRES])
def test_a_frequency_is_that_of_the_first_period_after_the_steering_is_held(study, case):
    response = study.step(case)
    turns = response.time[1:][np.diff(np.sign(response.history["roll_rate"])) != 0.0]
    first, _, third, *_ = turns[turns > 1.1]
    assert first == pytest.approx(peaks_of_roll(response)[0], abs=0.005)
    # Of a period of 0.7 to 1.2 s, of which each end is a sample of 1 ms.
    assert response.frequency == pytest.approx(1 / (third - first), rel=2e-3)


def test_what_never_comes_is_later_than_any_event_of_model_1(study):
    """Of claim 18."""
    never = study.ramp(UPRIGHT_TIRES).events.copy()
    never["lift_off_time"], never["rollover_time"] = math.nan, math.nan
    stable = dataclasses.replace(study.ramp(UPRIGHT_TIRES), events=never)

    class Stable(Rerun):
        def ramp(self, case):
            return stable if case == UPRIGHT_TIRES else super().ramp(case)

    finding = claim(18).check(Stable(study))
    assert finding.verdict == HOLDS, as_text([finding])


def test_the_8_dof_model_needs_the_tires_in_series_to_follow_the_roll(study):
    (rigid,) = (m for m in claim(20).measure(study) if "without tires in series" in m.name)
    assert not rigid.is_judged
    assert rigid.value > 10.0


@pytest.mark.parametrize("number", CHECKED)
def test_no_claim_holds_for_a_model_of_which_it_is_not_true(study, number):
    case, wrong = WRONG[number]
    assert claim(number).check(Rerun(study, {case: wrong})).verdict == FAILS


@pytest.mark.parametrize("number", CHECKED)
def test_each_number_that_a_claim_is_judged_by_fails_for_some_wrong_model(study, number):
    asked = Rerun(study)
    judged = {m.name for m in claim(number).check(asked).measured if m.is_judged}
    assert judged
    manoeuvres = collections.defaultdict(set)
    for manoeuvre, case in asked.asked:
        manoeuvres[case].add(manoeuvre)
    failing = set()
    for case, driven in manoeuvres.items():
        for wrong in {other for _, other in study.runs} - {case}:
            if all((manoeuvre, wrong) in study.runs for manoeuvre in driven):
                measured = claim(number).measure(Rerun(study, {case: wrong}))
                failing |= {m.name for m in measured if not m.holds}
    assert failing == judged


@pytest.mark.parametrize("number", CHECKED)
def test_each_number_that_a_claim_is_judged_by_fails_beyond_its_limits_and_if_it_is_nan(
    study, number
):
    for measured in claim(number).measure(study):
        if measured.is_judged:
            limits = [x for x in (measured.above, measured.below) if math.isfinite(x)]
            assert limits
            for value in (math.nan, *limits):
                assert not dataclasses.replace(measured, value=value).holds
            beyond = dataclasses.replace(measured, value=measured.above - 1.0).holds
            assert not (math.isfinite(measured.above) and beyond)
            beyond = dataclasses.replace(measured, value=measured.below + 1.0).holds
            assert not (math.isfinite(measured.below) and beyond)


class BrokenOff(Rerun):
    """A study in which runs of some cases, or of all, diverge after 2.5 s."""

    def __init__(self, study: Study, *cases: str):
        super().__init__(study)
        self._cases = cases or {case for _, case in RUNS}

    def response(self, manoeuvre: str, case: str) -> Response:
        whole = super().response(manoeuvre, case)
        if case not in self._cases:
            return whole
        rows = History(whole.history.rows[:2500])
        return dataclasses.replace(whole, history=rows, condition=Condition.DIVERGED)


def test_runs_that_broke_off_are_no_proof_that_a_vehicle_stays_upright(study):
    verdicts = {f.claim.number: f.verdict for f in check_claims(BrokenOff(study))}
    assert [verdicts[number] for number in (8, 10, 21)] == [FAILS] * 3


@pytest.mark.parametrize("case", ["1", "8dof", "8dof-rigid-tires"])
def test_one_that_broke_off_is_no_proof_that_another_follows(study, case):
    roll = claim(20).measure(BrokenOff(study, case))[3 if "rigid" in case else 0]
    assert math.isnan(roll.value)
