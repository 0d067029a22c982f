"""The findings on the claims, and the numbers of all models, as text and as Markdown."""

import math
import re

import numpy as np
import pytest
from scipy.signal import find_peaks
from studies import Rerun

from vehicle_roll_sim.analysis.paper import figures
from vehicle_roll_sim.analysis.paper.claim import (
    FAILS,
    HOLDS,
    NOT_CHECKED,
    Claim,
    Finding,
    Measured,
    percent_more,
)
from vehicle_roll_sim.analysis.paper.report import (
    CLAIMS,
    HEADER,
    NO_ENGINE,
    WIDTH,
    as_markdown,
    as_text,
    check_claims,
    lift_off_thresholds,
    numbers_as_markdown,
    numbers_as_text,
    tally,
)
from vehicle_roll_sim.analysis.paper.study import (
    ENGINE,
    RUNS,
)
from vehicle_roll_sim.vehicle.parameters import GRAVITY

HEAD = re.compile(r" {1,2}(\d+)  (holds      |fails      |not checked)  (.+) \[(.+)\]")


def test_one_number_that_fails_fails_the_claim():
    right, wrong = Measured("a", 1.0, "N", above=0.0), Measured("b", 1.0, "N", below=0.0)
    for measured, verdict in (([right], HOLDS), ([right, wrong], FAILS), ([wrong, right], FAILS)):
        finding = Claim(1, "2", "text", lambda _, found=measured: found).check(None)
        assert (finding.verdict, finding.measured) == (verdict, measured)


@pytest.mark.parametrize(
    ("limits", "criterion", "holding", "failing"),
    [
        ({"above": 2.0}, "> 2", [2.1, math.inf], [2.0, -3.0, math.nan]),
        ({"below": 0.05}, "< 0.05", [0.04, -math.inf], [0.05, 1.0, math.nan]),
        ({"above": 0.0}, "> 0", [1e-9], [0.0, -1e-9]),
        ({"above": -1.5, "below": 1.5}, "-1.5 … 1.5", [-1.4, 1.4], [-1.5, 1.5, math.nan]),
        ({"below": 1e-6}, "< 1e-06", [0.0], [1e-6]),
        ({}, "", [-1e9, 0.0, math.inf, math.nan], []),
    ],
)
def test_a_number_holds_between_its_limits_which_its_criterion_says(
    limits, criterion, holding, failing
):
    for value in (*holding, *failing):
        measured = Measured("name", value, "unit", **limits)
        assert measured.criterion == criterion
        assert measured.is_judged == bool(limits)
        assert measured.holds == (value in holding)


@pytest.mark.parametrize(
    ("measured", "text"),
    [
        (Measured("roll apart", 0.018912, "deg", below=0.05), "roll apart: 0.0189 deg (< 0.05)"),
        (Measured("roll", -4.899, "%", -5.0, 5.0), "roll: -4.9 % (-5 … 5)"),
        (Measured("1b", 5.411234, "s"), "1b: 5.41 s"),
        (Measured("85°", math.nan, "s", above=0.0), "85°: never (> 0)"),
        (Measured("yet lr lifts", math.nan, "s"), "yet lr lifts: never"),
    ],
)
def test_a_number_is_written_to_three_digits_with_unit_and_criterion(measured, text):
    assert str(measured) == text


@pytest.mark.parametrize(("value", "other", "more"), [(3.0, 2.0, 50.0), (1.0, 2.0, -50.0)])
def test_percent_more(value, other, more):
    assert percent_more(value, other) == more


def test_without_the_engine_claim_22_is_not_checked_and_all_others_are(without_engine, findings):
    found = check_claims(without_engine)
    assert (found[-1].verdict, found[-1].measured) == (NOT_CHECKED, [])
    assert found[:-1] == findings[:-1]
    assert NO_ENGINE in as_text(found).splitlines()[-3]
    assert tally(found) == "22 claims: 21 hold, 0 fail, 1 not checked"
    assert as_markdown(found).splitlines()[-1].endswith(f"{NO_ENGINE} | **not checked** |")
    assert "model 1" in numbers_as_text(without_engine)
    assert ENGINE not in {case for _, case in without_engine.runs + list(without_engine.asked)}
    assert len(without_engine.runs) == len(RUNS) - 1


def test_the_runs_are_those_that_claims_figures_and_thresholds_ask_for(study, tmp_path):
    asked = Rerun(study)
    check_claims(asked)
    lift_off_thresholds(asked)
    figures.draw_roll_plane(asked, tmp_path)
    shown = (*figures.FIGURES, figures.LAG)
    drawn = {(figure.manoeuvre, case) for figure in shown for case in figure.cases}
    assert (asked.asked | drawn) - {("j_turn", ENGINE)} == set(RUNS) - {("j_turn", ENGINE)}
    assert asked.asked <= set(study.runs)
    assert len(RUNS) == len(set(RUNS))


@pytest.fixture(params=["as it is", "with failures"])
def reported(request, study, findings) -> list[Finding]:
    if request.param == "as it is":
        return findings
    return check_claims(Rerun(study, {"1a": "1c-i", "8dof": "8dof-rigid-tires"}))


def test_the_text_has_every_claim_once_in_order_with_verdict_and_numbers(reported):
    *lines, blank, last = as_text(reported).splitlines()
    assert (blank, last) == ("", tally(reported))
    heads, numbers = [], {}
    for line in lines:
        if head := HEAD.fullmatch(line):
            number, verdict, text, place = head.groups()
            heads.append((int(number), verdict.strip(), text, place))
            numbers[int(number)] = []
        else:
            assert len(line) <= WIDTH
            assert line.startswith("     ")
            numbers[heads[-1][0]].append(line.strip())
    claims = [finding.claim for finding in reported]
    verdicts = [finding.verdict for finding in reported]
    expected = [(c.number, v, c.text, c.place) for c, v in zip(claims, verdicts, strict=True)]
    assert heads == expected
    for finding in reported:
        assert " ".join(numbers[finding.claim.number]) == numbers_of(finding)


def numbers_of(finding: Finding) -> str:
    return "; ".join(str(measured) for measured in finding.measured) or NO_ENGINE


def test_the_markdown_is_a_table_with_every_claim_in_a_row(reported):
    lines = as_markdown(reported).splitlines()
    cells = [[cell.strip() for cell in line.split("|")] for line in lines]
    assert {len(row) for row in cells} == {len(HEADER) + 2}
    assert all((row[0], row[-1]) == ("", "") for row in cells)
    header, rule, *rows = (tuple(row[1:-1]) for row in cells)
    assert (header, rule) == (HEADER, ("---",) * len(HEADER))
    for row, finding in zip(rows, reported, strict=True):
        about = finding.claim
        verdict = HOLDS if finding.verdict == HOLDS else f"**{finding.verdict}**"
        assert row == (str(about.number), about.place, about.text, numbers_of(finding), verdict)


def test_a_claim_that_fails_is_shown_as_failing_with_its_numbers(study):
    found = check_claims(Rerun(study, {"1a": "1c-i"}))
    (apart,) = found[0].measured
    assert apart.value > 0.05
    shown = f"roll apart: {apart.value:.3g} deg (< 0.05)"
    first, second = as_text(found).splitlines()[:2]
    assert (first[:10].split(), second.strip()) == (["1", "fails"], shown)
    row = as_markdown(found).splitlines()[2]
    assert row.endswith(f"| {shown} | **fails** |")


def test_the_tally_counts_verdicts():
    verdicts = [HOLDS, FAILS, HOLDS, NOT_CHECKED, HOLDS, FAILS]
    assert tally([Finding(CLAIMS[0], verdict, []) for verdict in verdicts]) == (
        "6 claims: 3 hold, 2 fail, 1 not checked"
    )


def test_a_rigid_vehicle_lifts_a_wheel_at_its_static_stability_factor(study):
    """Half the track over the height of the centre of gravity of the whole vehicle at rest."""
    vehicle = study.vehicle
    wheelbase = vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
    moment = vehicle.sprung_mass * vehicle.cg_height
    for axle, to_the_other in (("front", vehicle.cg_to_rear_axle), ("rear", None)):
        share = (to_the_other or vehicle.cg_to_front_axle) / wheelbase
        unsprung = getattr(vehicle, f"{axle}_unsprung_mass")
        load = GRAVITY * (vehicle.sprung_mass * share / 2 + unsprung)
        height = vehicle.tire_radius - load / getattr(vehicle, f"{axle}_tire_stiffness")
        moment += 2 * unsprung * height
    factor = vehicle.front_track / 2 / (moment / (study.weight / GRAVITY))
    rigid = lift_off_thresholds(study)["rigid roll plane (static stability factor)"]
    assert rigid == pytest.approx(factor, rel=1e-12)


def test_with_springs_and_then_with_a_transient_the_first_wheel_lifts_at_less(study):
    rigid, suspended, *simulated = lift_off_thresholds(study).values()
    assert len(simulated) == 2
    assert rigid > suspended > max(simulated) > 0.5


@pytest.mark.parametrize("case", ["1", "8dof"])
def test_the_threshold_of_a_simulation_is_its_acceleration_when_the_first_wheel_lifts(study, case):
    threshold = lift_off_thresholds(study)[f"model {case}, ramp steer"]
    response = study.ramp(case)
    unloaded = np.flatnonzero((response.loads <= 0.0).any(axis=1))[0]
    around = response.history["lateral_acceleration"][unloaded - 1 : unloaded + 1] / GRAVITY
    assert around.min() <= threshold <= around.max()


@pytest.fixture(scope="module")
def tables(study) -> list[list[tuple[str, ...]]]:
    """Cells of the two tables of numbers, each with its header and without the rule."""
    found = []
    for table in numbers_as_markdown(study).split("\n\n"):
        header, rule, *rows = (
            tuple(cell.strip() for cell in line.strip("|").split("|"))
            for line in table.splitlines()
        )
        assert set(rule) == {"---"}
        assert {len(line) for line in (rule, *rows)} == {len(header)}
        found.append([header, *rows])
    return found


def test_the_responses_of_every_model_are_what_is_read_off_its_runs(study, tables):
    header, *rows = tables[0]
    both = [
        case for _, case in RUNS if {(m, case) for m in ("step_steer", "ramp_steer")} <= {*RUNS}
    ]
    assert [case for case, *_ in rows] == list(dict.fromkeys(both))
    wheelbase = study.vehicle.cg_to_front_axle + study.vehicle.cg_to_rear_axle
    for case, *cells in rows:
        step, ramp = study.step(case), study.ramp(case)
        history, acceleration = ramp.history, ramp.history["lateral_acceleration"]
        turning = slice(*(np.flatnonzero(acceleration > limit)[0] for limit in (1.0, 4.0)))
        beyond_ackermann = history["steering"] - wheelbase * history["yaw_rate"] / history["u"]
        roll, understeer = (
            np.polyfit(acceleration[turning] / GRAVITY, angle[turning], 1)[0]
            for angle in (ramp.roll, np.degrees(beyond_ackermann))
        )
        steady = step.roll[-500:].mean()
        swings = step.roll[find_peaks(step.roll)[0][0]], step.roll[find_peaks(-step.roll)[0][0]]
        decrement = math.log((swings[0] - steady) / (steady - swings[1]))
        expected = {
            "peak roll (deg)": step.roll.max(),
            "steady (deg)": steady,
            "frequency (Hz)": step.frequency,
            "damping ratio": decrement / math.hypot(math.pi, decrement),
            "roll gradient (deg/g)": roll,
            "understeer (deg/g)": understeer,
            "first lift-off (s)": np.nanmin(ramp.lift_offs),
            "85° of roll (s)": ramp.rollover,
        }
        shown = dict(zip(header[1:], cells, strict=True))
        assert list(shown) == list(expected)
        for name, value in expected.items():
            assert shown[name] == ("-" if math.isnan(value) else f"{value:.3f}")


def test_those_of_model_1_are_the_reference_numbers(tables):
    header, first, *_ = tables[0]
    shown = dict(zip(header, first, strict=True))
    assert shown["model"] == "1"
    for name, value in (
        ("peak roll (deg)", 5.619),
        ("steady (deg)", 5.008),
        ("first lift-off (s)", 3.020),
        ("85° of roll (s)", 5.217),
    ):  # certain to 0.001, and rounded to it
        assert float(shown[name]) == pytest.approx(value, abs=0.0015)


def test_thresholds_are_shown_to_three_decimals(study, tables):
    thresholds = lift_off_thresholds(study)
    assert tables[1][1:] == [(name, f"{g:.3f}") for name, g in thresholds.items()]


def test_the_text_has_the_same_numbers_in_columns_below_their_headings(study, tables):
    for text, table in zip(numbers_as_text(study).split("\n\n"), tables, strict=True):
        headings, units, *lines = text.splitlines()
        assert [tuple(re.split(r"\s{2,}", line)) for line in lines] == table[1:]
        names = re.split(r"\s{2,}", headings)
        assert names == [name.partition(" (")[0] for name in table[0]]
        assert units.split() == re.findall(r"\(.+?\)", " ".join(table[0]))
        for name in names[1:]:  # to the right
            end = headings.index(name) + len(name)
            assert all(line[end - 1 : end + 1].strip() == line[end - 1] for line in lines)
