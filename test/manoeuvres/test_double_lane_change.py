"""Double lane changes: path following, throttle, mirror images, and the report."""

import dataclasses
import math

import numpy as np
import pytest

from vehicle_roll_sim import InputError, Options, Simulation, preset
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.options import MODELS

pytestmark = pytest.mark.unmeasured

SEVERE, PLAIN = "iso_severe_double_lane_change", "iso_double_lane_change"
BOTH = (SEVERE, PLAIN)
KMH = 1 / 3.6
PERIOD = 0.01
"""s"""


def ready(name: str, options: Options | None = None, values: dict | None = None, **changes):
    vehicle = preset().with_values(values or {})
    return dataclasses.replace(STANDARD[name], **changes).for_vehicle(vehicle, options or Options())


_driven = {}


def driven_as(name: str, **changes):
    """Manoeuvre, history and driver of a run that several tests look at, which is made once."""
    key = name, *changes.items()
    if key not in _driven:
        manoeuvre = ready(name, **changes)
        _driven[key] = (manoeuvre, *driven(manoeuvre))
    return _driven[key]


def driven(manoeuvre, options: Options | None = None, **settings):
    """History of a run with the driver that drove it."""
    simulation, driver = Simulation(preset(), options), manoeuvre.driver()
    simulation.reset(manoeuvre.speed)
    return run(simulation, driver, manoeuvre.duration, **settings), driver


@pytest.mark.parametrize("name", BOTH)
def test_slowly_driven_with_a_short_preview_the_path_is_followed_within_5_cm(name):
    # the preview is two metres of path: what is cut off a bend grows with its square
    slow = ready(name, speed=20 * KMH, preview_time=0.35, duration=28.0)
    history, _ = driven(slow)
    assert slow.result(history).deviation < 0.05
    assert slow.result(history).is_passed


@pytest.mark.parametrize("name", BOTH)
def test_the_deviation_is_the_largest_distance_from_the_path_on_the_track(name):
    manoeuvre, history, _ = driven_as(name)
    result = manoeuvre.result(history)
    on_track = history["x"] - manoeuvre.track_begins
    sideways = np.abs(history["y"] - manoeuvre.track.path(on_track))
    there = (on_track >= 0.0) & (on_track <= manoeuvre.track.end)
    assert result.deviation == sideways[there].max()
    assert sideways[on_track == result.deviation_at] == [result.deviation]


@pytest.mark.parametrize("name", BOTH)
def test_at_the_standard_speed_the_reference_vehicle_gets_through(name):
    manoeuvre, history, _ = driven_as(name)
    result = manoeuvre.result(history)
    assert (result.struck, len(result.strikes)) == (0, 18)
    assert result.is_passed


@pytest.mark.parametrize("name", BOTH)
def test_to_the_other_side_all_is_mirrored(name):
    left, one, _ = driven_as(name)
    right, other, _ = driven_as(name, side="right")
    # 1e-7: rounding, after ten seconds at the limit
    for signal in ("y", "yaw", "roll", "steering", "lateral_acceleration"):
        np.testing.assert_allclose(one[signal], -other[signal], rtol=0, atol=1e-7)
    for signal in ("x", "u"):
        np.testing.assert_allclose(one[signal], other[signal], rtol=0, atol=1e-7)
    deviations = [left.result(one).deviation, right.result(other).deviation]
    assert deviations[0] == pytest.approx(deviations[1], abs=1e-7)


def test_too_fast_it_strikes_the_same_cones_to_either_side():
    strikes = []
    for side in ("left", "right"):
        manoeuvre, history, _ = driven_as(SEVERE, side=side, speed=62 * KMH)
        result = manoeuvre.result(history)
        assert result.struck > 0
        assert not result.is_passed
        strikes.append(result.strikes)
    np.testing.assert_allclose(*strikes, rtol=0, atol=1e-6)


@pytest.mark.parametrize("name", BOTH)
def test_a_command_period_of_10_ms_is_what_it_is_driven_with_and_runs_repeat_to_the_last_bit(name):
    manoeuvre = ready(name, duration=4.0)
    plain, again, told = (driven(manoeuvre, command_period=p)[0] for p in (0.0, 0.0, PERIOD))
    np.testing.assert_array_equal(plain.rows, again.rows)
    np.testing.assert_array_equal(plain.rows, told.rows)


def test_the_throttle_is_released_in_the_first_period_with_the_front_2_m_in_the_first_lane():
    manoeuvre = ready(SEVERE)
    driver, commands = manoeuvre.driver(), []
    begins = 10.0 + 2.0  # approach, and 2 m; the front is ahead of the c.g., where the run begins
    for k in range(120):
        way = 0.1 * k + 1.016 + 0.8
        state = {"x": 0.1 * k, "y": 0.0, "yaw": 0.0, "u": 10.0, "v": 0.0, "yaw_rate": 0.0}
        (command,) = driver.command(k * PERIOD, state)
        commands.append((way, float(command.speed_hold_gain), float(command.speed_hold_target)))
    front = 1.016 + 0.8
    for way, gain, target in commands:
        # 1e-9: sums of tenths; the run begins with the front 10 m ahead of the track
        is_released = way - front >= begins - 1e-9
        assert (gain == 0.0) == is_released
        assert target == 50 * KMH


def test_once_released_the_throttle_stays_so_though_the_vehicle_spins():
    driver = ready(SEVERE).driver()
    state = {"x": 15.0, "y": 0.0, "yaw": 0.0, "u": 10.0, "v": 0.0, "yaw_rate": 0.0}
    assert driver.command(0.0, state)[0].speed_hold_gain == 0.0
    assert driver.command(PERIOD, state | {"x": 10.0, "yaw": 3.0})[0].speed_hold_gain == 0.0


def test_in_the_double_lane_change_the_speed_is_held_throughout():
    _, history, driver = driven_as(PLAIN)
    assert driver.released == math.inf
    assert np.abs(history["u"] - 80 * KMH).max() < 0.2  # m/s: what 2000 N m s/m let go in the turns


@pytest.mark.parametrize(
    ("name", "model"), [*((SEVERE, model) for model in MODELS), (PLAIN, "1"), (PLAIN, "8dof")]
)
def test_every_model_is_driven_through_them(name, model):
    options = Options(model=model)
    manoeuvre = ready(name, options, speed=40 * KMH)
    result = manoeuvre.result(driven(manoeuvre, options)[0])
    assert result.is_passed


@pytest.mark.parametrize("name", BOTH)
def test_a_run_that_ends_on_the_track_is_not_passed_and_says_so(name):
    manoeuvre = ready(name, duration=2.0)
    history, driver = driven(manoeuvre)
    report = manoeuvre.report(history, driver)
    assert report["end of the track"] == "not reached"
    assert report["verdict"] == "failed"


@pytest.mark.parametrize("side", ["left", "right"])
def test_straight_on_no_cone_is_struck_but_the_second_lane_is_missed(side):
    # who looks 5 s ahead, beyond the track, cuts all of it off
    straight = ready(SEVERE, speed=300 * KMH, preview_time=5.0, duration=1.5, side=side)
    result = straight.result(driven(straight)[0])
    assert (result.struck, result.missed) == (0, 1)
    assert not result.is_passed


def test_with_samples_too_far_apart_it_says_that_it_does_not_know():
    manoeuvre = ready(SEVERE)
    for sample, is_known in ((0.05, True), (0.1, False)):
        history, driver = driven(manoeuvre, sample=sample)
        report = manoeuvre.report(history, driver)
        assert report["verdict"] == ("passed" if is_known else "unknown")
        assert ("unknown" in report["cones struck"]) != is_known


def test_a_run_that_does_not_get_to_the_track_has_no_deviation():
    manoeuvre = ready(SEVERE, duration=0.2)
    history, driver = driven(manoeuvre)
    assert manoeuvre.report(history, driver)["deviation from the path"] == "not on the track"


def test_the_report_names_the_first_cone():
    manoeuvre, history, driver = driven_as(SEVERE, side="left", speed=62 * KMH)
    result, report = manoeuvre.result(history), manoeuvre.report(history, driver)
    first = int(np.nanargmin(result.strikes))
    x, y = manoeuvre.track.cones[first]
    text = f"{result.struck} of 18, first at {result.strikes[first]:.3f} s: x {x:.1f} m, "
    assert report["cones struck"] == f"{text}y {y:.2f} m"
    assert report["vehicle width"] == "1.705 m"
    assert report["verdict"] == "failed"


def test_a_wider_vehicle_has_wider_lanes_and_another_path():
    wide, plain = ready(SEVERE, vehicle_width=2.0), ready(SEVERE)
    assert wide.outline.width == 2.0
    assert wide.track.lanes[0].left == pytest.approx((1.1 * 2.0 + 0.25) / 2)
    assert wide.track.lanes[1].middle > plain.track.lanes[1].middle


def test_the_handwheel_goes_no_further_than_60_deg_at_the_road_wheels():
    quick = ready(SEVERE, values={"steering_ratio": 2.0})
    assert quick.steering().limit == pytest.approx(math.radians(60.0))
    assert quick.steering().rate == pytest.approx(math.radians(1000.0 / 2.0))


def test_a_body_narrower_than_the_track_is_refused():
    with pytest.raises(InputError, match="vehicle_width"):
        ready(SEVERE, vehicle_width=1.0)
