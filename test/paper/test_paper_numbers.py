"""The numbers of all models: thresholds of lift-off and responses, as text and as Markdown."""

import math
import re

import numpy as np
import pytest
from scipy.signal import find_peaks

from vehicle_roll_sim.paper.report import (
    lift_off_thresholds,
    numbers_as_markdown,
    numbers_as_text,
)
from vehicle_roll_sim.paper.study import RUNS
from vehicle_roll_sim.vehicle.derived_values import GRAVITY


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
