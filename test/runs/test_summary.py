"""The summary of a run, for given events."""

import pytest

from vehicle_roll_sim import Condition
from vehicle_roll_sim.model.integration.events import no_events
from vehicle_roll_sim.runs.summary import line, summary_lines

UNEVENTFUL = """\
peak roll angle:            0.000 deg
peak lateral acceleration:  0.000 m/s^2
lift-off lf:                none
lift-off rf:                none
lift-off lr:                none
lift-off rr:                none
rollover:                   none
end:                        2.000 s, complete"""
EVENTFUL = """\
peak roll angle:            -57.296 deg at 2.500 s
peak lateral acceleration:  9.119 m/s^2 at 2.163 s
lift-off lf:                1.572 s
lift-off rf:                none
lift-off lr:                1.395 s
lift-off rr:                3.120 s
rollover:                   3.130 s
slip ratio out of range:    from 1.700 s: outside the range of the tire file
tire load out of range:     from 2.250 s: outside the range of the tire file
inclination out of range:   from 2.500 s: outside the range of the tire file
end:                        3.131 s, rolled over"""


@pytest.fixture
def events():
    return no_events()[0]


@pytest.fixture
def eventful(events):
    events.peak_roll = (-1.0, 2.5)  # rad, s
    events.peak_lateral_acceleration = (9.1194, 2.1626)
    events.lift_off_time[[0, 2, 3]] = 1.5719, 1.3951, 3.1196
    events.rollover_time = 3.1304
    events.out_of_range_time[[0, 2, 3]] = 1.7, 2.25, 2.5
    return events


def test_of_a_run_without_events_it_says_so(events):
    assert summary_lines(events, 2.0, Condition.RUNNING) == UNEVENTFUL.splitlines()


def test_of_an_eventful_run_it_says_what_happened_and_when(eventful):
    assert summary_lines(eventful, 3.131, Condition.ROLLED_OVER) == EVENTFUL.splitlines()


@pytest.mark.parametrize(
    ("condition", "note", "words"),
    [
        (Condition.RUNNING, "", ["complete"]),
        (Condition.ROLLED_OVER, "", ["rolled over"]),
        (Condition.TOO_SLOW, "", ["too slow", "3.5 m/s"]),
        (Condition.DIVERGED, "wheel_speed_lf", ["diverged", "wheel_speed_lf"]),
    ],
)
def test_the_last_line_says_how_the_run_ended(events, condition, note, words):
    last = summary_lines(events, 1.25, condition, note)[-1]
    assert last.startswith("end:")
    assert "1.250 s" in last
    for word in words:
        assert word in last


def test_lines_of_other_results_stand_in_the_same_columns(events):
    column = UNEVENTFUL.index("0.000")
    assert line("CSV", "run.csv").index("run.csv") == column
