"""The findings on the claims, as text and as Markdown."""

import math
import re

import pytest
from studies import Rerun

from vehicle_roll_sim.paper import figures
from vehicle_roll_sim.paper.claim import (
    FAILS,
    HOLDS,
    NOT_CHECKED,
    Claim,
    Finding,
    Measured,
    percent_more,
)
from vehicle_roll_sim.paper.report import (
    CLAIMS,
    HEADER,
    NO_ENGINE,
    WIDTH,
    as_markdown,
    as_text,
    check_claims,
    lift_off_thresholds,
    numbers_as_text,
    tally,
)
from vehicle_roll_sim.paper.study import ENGINE, RUNS

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
        (
            Measured("roll difference", 0.018912, "deg", below=0.05),
            "roll difference: 0.0189 deg (< 0.05)",
        ),
        (Measured("roll", -4.899, "%", -5.0, 5.0), "roll: -4.9 % (-5 … 5)"),
        (Measured("1b", 5.411234, "s"), "1b: 5.41 s"),
        (Measured("85°", math.nan, "s", above=0.0), "85°: never (> 0)"),
        (Measured("lift-off of lr", math.nan, "s"), "lift-off of lr: never"),
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
    shown = f"roll difference: {apart.value:.3g} deg (< 0.05)"
    first, second = as_text(found).splitlines()[:2]
    assert (first[:10].split(), second.strip()) == (["1", "fails"], shown)
    row = as_markdown(found).splitlines()[2]
    assert row.endswith(f"| {shown} | **fails** |")


def test_the_tally_counts_verdicts():
    verdicts = [HOLDS, FAILS, HOLDS, NOT_CHECKED, HOLDS, FAILS]
    assert tally([Finding(CLAIMS[0], verdict, []) for verdict in verdicts]) == (
        "6 claims: 3 hold, 2 fail, 1 not checked"
    )
