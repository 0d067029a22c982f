"""From columns to signals: units, signs, parts, plausibility, contradictions."""

import numpy as np
import pytest

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.logs.log import log_of
from vehicle_roll_sim.logs.map_file import map_of
from vehicle_roll_sim.logs.raw_log import RawLog
from vehicle_roll_sim.logs.settings import Conditioning

pytest.importorskip("pint", reason="the units of the log need pint")
TIME = np.arange(0.0, 6.0, 0.02)
RATE = 0.3 * np.sin(2.0 * TIME)
COLUMNS = {
    "t": TIME + 1.7e9,
    "v": np.full(len(TIME), 72.0),
    "d": 2.0 * np.sin(2.0 * TIME),
    "r": RATE,
    "a": 20.0 * RATE / 9.80665,
    "phi": 0.02 * 20.0 * RATE,
}
MAP = {
    "time": {"column": "t", "unit": "s"},
    "speed": {"column": "v", "unit": "km/h"},
    "steering": {"column": "d", "unit": "deg"},
    "yaw_rate": {"column": "r", "unit": "rad/s"},
    "lateral_acceleration": {"column": "a", "unit": "g"},
    "roll": {"column": "phi", "unit": "rad"},
}


def read(columns=None, axes="iso", settings=None, **entries):
    """A log; entries: of the map, None to leave one out."""
    mapped = {name: MAP.get(name, {}) | (each or {}) for name, each in entries.items() if each}
    kept = {name: each for name, each in MAP.items() if name not in entries} | mapped
    found = map_of({"axes": axes, "columns": kept})
    raw = RawLog({name: each.copy() for name, each in (COLUMNS | (columns or {})).items()})
    return log_of(raw, found, Conditioning(**{"cutoff": 0.0} | (settings or {})))


def test_values_are_in_si_units_and_times_from_the_first_row_on():
    log = read()
    np.testing.assert_allclose(log.time, TIME, atol=1e-6)
    np.testing.assert_allclose(log.signals["speed"], 20.0, rtol=1e-12)
    np.testing.assert_allclose(log.signals["lateral_acceleration"], 20.0 * RATE, atol=1e-12)
    np.testing.assert_allclose(log.inputs["steering"][1], np.radians(COLUMNS["d"]), atol=1e-15)
    assert log.doubts == []
    assert log.compared == ["yaw_rate", "lateral_acceleration", "roll"]


def test_a_log_with_z_down_becomes_one_with_z_up():
    turned = {name: -COLUMNS[name] for name in ("d", "r", "a")}
    log, usual = read(turned, axes="sae"), read()
    for name, values in usual.signals.items():
        np.testing.assert_array_equal(log.signals[name], values)
    assert log.doubts == []


def test_a_log_with_z_down_that_is_not_said_to_be_one_is_doubted():
    """Roll is about x, which both axes have: it alone keeps its sign."""
    turned = {name: -COLUMNS[name] for name in ("d", "r", "a")}
    assert any("roll has the opposite sign" in each for each in read(turned).doubts)


def test_a_log_that_hardly_turns_says_nothing_about_signs_and_units():
    wrong = {"lateral_acceleration": {"unit": "m/s^2"}, "roll": {"sign": -1}}
    assert len(read(**wrong).doubts) == 2
    slight = {name: 0.05 * COLUMNS[name] for name in ("d", "r", "a", "phi")}
    assert read(slight, **wrong).doubts == []


@pytest.mark.parametrize(
    ("entries", "columns", "doubt"),
    [
        ({"yaw_rate": {"unit": "deg/s"}}, {}, "times yaw_rate times speed"),
        ({"roll": {"sign": -1}}, {}, "roll has the opposite sign of lateral_acceleration"),
        ({"steering": {"sign": -1}}, {}, "yaw_rate has the opposite sign of steering"),
        ({"yaw_rate": {"sign": -1}}, {}, "lateral_acceleration has the opposite sign of yaw_rate"),
        ({"lateral_acceleration": {"unit": "m/s^2"}}, {}, "is 0.102 times yaw_rate times speed"),
        ({"speed": {"unit": "m/s"}}, {}, "is 0.278 times yaw_rate times speed"),
        ({"steering": {"column": "w", "unit": "deg"}}, {"w": 35 * COLUMNS["d"]}, "steering of the"),
        (
            {"roll_rate": {"column": "p", "unit": "rad/s"}},
            {"p": -np.gradient(COLUMNS["phi"], TIME)},
            "roll_rate has the opposite sign of the derivative of roll",
        ),
    ],
)
def test_swapped_signs_and_wrong_units_are_doubted(entries, columns, doubt):
    assert any(doubt in each for each in read(columns, **entries).doubts)


@pytest.mark.parametrize(
    ("entries", "columns", "problem"),
    [
        (
            {"yaw_rate": {"column": "w"}},
            {"w": 57.3 * RATE},
            "17.1.* rad/s: at most 12 rad/s: is the",
        ),
        (
            {"speed": {"unit": "km/s"}},
            {},
            "columns: speed: 7.2e.04 m/s: at most 100 m/s: is the un",
        ),
        (
            {"roll": {"unit": "rad"}},
            {"phi": np.degrees(COLUMNS["phi"])},
            "roll: 6.875 rad: at most 3.142 rad: is the unit rad",
        ),
        ({"speed": {"unit": "deg"}}, {}, "columns: speed: unit: Cannot convert .*: a unit that"),
        ({"speed": {"unit": None}}, {}, "columns: speed: unit: missing: that of the column, such"),
        (
            {"brake": {"column": "b", "unit": "N m"}},
            {"b": -TIME},
            "brake: -5.98 N m: at least 0: is",
        ),
        ({"speed": None}, {}, "columns: speed: missing: the column of the forward speed"),
        ({"steering": None}, {}, "columns: steering: missing: the column of steering or handwh"),
        ({"handwheel": {"column": "d", "unit": "deg"}}, {}, "handwheel: together with steering"),
        ({"time": None}, {}, "columns: time: missing: the column of times"),
        (
            {"yaw_rate": None, "lateral_acceleration": None, "roll": None},
            {},
            "nothing to compare: one or more of yaw_rate, lat",
        ),
        ({"time": {"unit": "min"}}, {}, "columns: time: a row every 1.2 s: at most 0.1 s between"),
        (
            {"lateral_acceleration": {"place": [1, 0, 0]}},
            {},
            "lateral_acceleration: place: no roll_rate: roll_rate in the log, or no place",
        ),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(entries, columns, problem):
    with pytest.raises(InputError, match=problem) as raised:
        read(columns, **entries)
    assert "\n" not in str(raised.value)


def test_a_part_is_chosen_and_its_times_stay_those_of_the_log():
    log = read(settings={"begin": 1.0, "end": 3.0})
    assert log.time[0] == pytest.approx(1.0, abs=1e-6)
    assert log.time[-1] == pytest.approx(3.0, abs=1e-6)
    with pytest.raises(InputError, match=r"begin: 5 rows of speed from 5.9 s: at least 20 rows"):
        read(settings={"begin": 5.9})
    with pytest.raises(InputError, match=r"end: 1\.0 is not allowed: more than begin, 2"):
        read(settings={"begin": 2.0, "end": 1.0})


def test_a_gap_outside_the_chosen_part_does_not_matter():
    late = np.where(TIME > 5.0, TIME + 2.0, TIME)
    with pytest.raises(InputError, match=r"a gap of 2.02 s after 5 s"):
        read({"t": late})
    assert read({"t": late}, settings={"end": 4.0}).time[-1] == pytest.approx(4.0)


def test_uneven_rows_are_resampled_and_told():
    shaken = TIME + np.random.default_rng(5).uniform(0.0, 0.004, len(TIME))
    notes = read({"t": shaken}).notes
    assert any("by the last value, at most 0.0" in each for each in notes)
    assert not any("resampled" in each for each in read().notes)


def test_the_cutoff_is_the_usual_one_or_what_the_sampling_allows():
    assert read(settings={"cutoff": None}).cutoff == 10.0
    assert "filter of both sides: none" in read().notes
    with pytest.raises(InputError, match=r"cutoff: 30\.0 is not allowed: at most 20 Hz for a row"):
        read(settings={"cutoff": 30.0})


def test_rows_with_their_own_times_need_no_column_of_times():
    names = {each["column"] for name, each in MAP.items() if name != "time"}
    raw = RawLog(
        {name: COLUMNS[name] for name in names},
        times={name: TIME + 0.001 * len(name) for name in names},
        units={"v": "km/h"},
    )
    kept = {name: each for name, each in MAP.items() if name != "time"}
    kept["speed"] = {"column": "v"}
    log = log_of(raw, map_of({"columns": kept}), Conditioning())
    assert log.time[0] == pytest.approx(0.002)
    assert log.signals["speed"] == pytest.approx(20.0)
    with pytest.raises(
        InputError, match="columns: time: 't' is not allowed: nothing: the file has"
    ):
        log_of(raw, map_of({"columns": MAP}), Conditioning())
