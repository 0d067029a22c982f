"""Test series: the runs that the standards require, their end and their verdict."""

import math

import pytest

from vehicle_roll_sim import InputError, Options, preset
from vehicle_roll_sim.manoeuvres.handwheel import largest_handwheel
from vehicle_roll_sim.manoeuvres.series.catalogue import SERIES, ladder, series_named
from vehicle_roll_sim.manoeuvres.slowly_increasing_steer import steering_at_03g

MPH = 0.44704
"""m/s"""
SPEEDS = {"nhtsa_j_turn": [35, 40, 45, 50, 55, 60], "nhtsa_fishhook": [35, 40, 45, 47.5, 50]}
STABLE, TIPPING = {"cg_height": 0.5}, {"cg_height": 0.62}
TIPS_AT = {"nhtsa_j_turn": 50.0, "nhtsa_fishhook": 45.0}
"""mph: found by runs of their own (docs/manoeuvres.md)."""


def rows_of(name: str, **values) -> list[tuple]:
    return list(SERIES[name].rows(preset().with_values(values), Options()))


@pytest.mark.parametrize("name", SPEEDS)
def test_without_two_wheel_lift_every_entry_speed_is_driven_to_both_sides(name):
    rows = rows_of(name, **STABLE)
    assert [row[:2] for row in rows] == [(d, s) for d in ("left", "right") for s in SPEEDS[name]]
    assert all(math.isnan(row[4]) for row in rows)
    verdict = SERIES[name].verdict(rows)
    assert verdict == f"no two-wheel lift up to {SPEEDS[name][-1]:g} mph"


@pytest.mark.parametrize("name", SPEEDS)
def test_the_first_two_wheel_lift_ends_the_runs_to_a_side(name):
    rows, last = rows_of(name, **TIPPING), TIPS_AT[name]
    driven = [speed for speed in SPEEDS[name] if speed <= last]
    assert [row[:2] for row in rows] == [(d, s) for d in ("left", "right") for s in driven]
    for row in rows:
        assert math.isnan(row[4]) == (row[1] < last)
    for side in ("left", "right"):
        assert f"two-wheel lift at {last:g} mph to the {side}" in SERIES[name].verdict(rows)


def test_runs_to_the_right_mirror_those_to_the_left():
    rows = rows_of("nhtsa_fishhook", **TIPPING)
    half = len(rows) // 2
    for left, right in zip(rows[:half], rows[half:], strict=True):
        assert left[1] == right[1]
        assert right[2:4] == pytest.approx([-left[2], -left[3]], abs=1e-6)
        assert right[4] == pytest.approx(left[4], nan_ok=True)


def test_a_model_without_wheel_heights_has_no_two_wheel_lift_to_look_for():
    with pytest.raises(InputError) as refusal:
        list(SERIES["nhtsa_j_turn"].rows(preset(), Options(model="8dof")))
    assert "8dof" in str(refusal.value)


@pytest.mark.parametrize(
    ("angle", "final"), [(20.0, 270.0), (41.0, 270.0), (44.0, 286.0), (60.0, 300.0)]
)
def test_the_ladder_climbs_by_half_an_angle_to_its_final_amplitude(angle, final):
    rungs = ladder(angle)
    assert rungs[0] == 1.5
    assert rungs[:-1] == [1.5 + 0.5 * k for k in range(len(rungs) - 1)]
    assert rungs[-1] * angle == pytest.approx(final, rel=1e-12)
    assert 0.0 < rungs[-1] - rungs[-2] <= 0.5 + 1e-9


def test_the_sine_with_dwell_is_judged_at_every_amplitude_and_as_a_whole():
    rows = rows_of("sine_with_dwell", **STABLE)
    angle = steering_at_03g(preset().with_values(STABLE), Options())
    left = [row for row in rows if row[0] == "left"]
    assert [row[1] for row in left] == ladder(angle)
    assert [row[2] for row in left] == pytest.approx([s * angle for s in ladder(angle)])
    for row in rows:
        is_stable = row[3] <= 0.35 and row[4] <= 0.20
        assert (row[6] == "passed") == (is_stable and (row[1] < 5.0 or row[5] >= 1.83))
    passed = [row for row in rows if row[6] == "passed"]
    assert 0 < len(passed) < len(rows)
    assert SERIES["sine_with_dwell"].verdict(passed) == "passed"
    verdict = SERIES["sine_with_dwell"].verdict(rows)
    assert verdict.startswith("failed from")
    assert verdict.endswith(f"{len(rows) - len(passed)} of {len(rows)} runs")


@pytest.mark.parametrize(("ratio", "end"), [(12.0, 270.0), (4.0, 240.0), (4.6, 276.0)])
def test_amplitudes_end_where_the_wheels_turn_no_further_and_it_is_said(ratio, end):
    angle = 1.21 * ratio if end != 276.0 else 45.0  # 6.5 times 45 deg are 292.5 deg
    rungs = ladder(angle, largest_handwheel(ratio))
    assert rungs[-1] * angle == pytest.approx(end, rel=1e-12)
    rows = [("left", s, s * angle, 0.1, 0.1, 2.0, "passed") for s in rungs]
    vehicle = preset().with_values({"steering_ratio": ratio})
    remarks = SERIES["sine_with_dwell"].remarks(vehicle, rows)
    if end == 270.0:
        assert remarks == {}
    else:
        text = remarks["amplitudes end at"]
        assert text.startswith(f"{end:g} deg, which is 60 deg at the road wheels")
        assert f"steering_ratio {ratio:g}" in text
        assert text.endswith("270 deg" if end == 240.0 else "292.5 deg")


def test_a_run_that_did_not_get_to_its_end_does_not_pass_for_one_without_lift():
    broken = ("left", 40.0, 150.0, 3.0, math.nan, "diverged")
    assert SERIES["nhtsa_j_turn"].verdict([broken]) == "diverged at 40 mph to the left"


def test_a_verdict_names_the_side_that_failed():
    failed = ("right", 2.0, -40.0, 0.5, 0.1, 1.0, "failed")
    passed = ("left", 2.0, 40.0, 0.1, 0.1, 1.0, "passed")
    verdict = SERIES["sine_with_dwell"].verdict([passed, failed])
    assert verdict == "failed from 40.0 deg to the right: 1 of 2 runs"


def test_a_manoeuvre_without_a_series_is_refused():
    with pytest.raises(InputError) as refusal:
        series_named("constant_radius_circle")
    assert "constant_radius_circle" in str(refusal.value)
