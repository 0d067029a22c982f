"""The standard for simulators, in terms of a session: states, resets, steps and the entity."""

import threading

import pytest

from vehicle_roll_sim import Simulation, preset
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.live.simulation_interfaces import INVALID_POSE, Code, Scope, State
from vehicle_roll_sim.live.standard_simulator import VEHICLE, StandardSimulator

PERIOD_NS = 10_000_000
AHEAD = ((12.0, 0.0, 0.0), (0.0, 0.0, 0.0))
HERE = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))


class Bench:
    """A session, controlled as the node does it."""

    def __init__(self):
        self.session = Session(Simulation(preset()), CommandInbox(0.0), PERIOD_NS, 20.0)
        self.standard = StandardSimulator(self.session, self, threading.Lock())
        self.is_reset_refused = False

    def reset(self):
        if self.is_reset_refused:
            return False, "the step is too large"
        self.session.reset(20.0)
        return True, ""

    def pause(self, wanted):
        self.session.paused = wanted
        return True, ""

    def step(self):
        if not self.session.paused:
            return False, "running: pause first"
        self.session.run_period()
        return True, ""


@pytest.fixture
def bench() -> Bench:
    return Bench()


TRANSITIONS = [
    (State.PLAYING, State.PAUSED),
    (State.PLAYING, State.STOPPED),
    (State.PAUSED, State.PLAYING),
    (State.PAUSED, State.STOPPED),
    (State.STOPPED, State.PLAYING),
    (State.STOPPED, State.PAUSED),
]


@pytest.mark.parametrize(("begin", "end"), TRANSITIONS)
def test_every_transition_leads_to_its_state_and_only_a_stop_resets(bench, begin, end):
    bench.session.run_period()
    if begin is not State.PLAYING:
        assert bench.standard.set_state(begin).code == Code.OK
    assert bench.standard.state() is begin
    time_ns = bench.session.simulation.time_ns
    assert bench.standard.set_state(end) == (Code.OK, "")
    assert bench.standard.state() is end
    assert bench.session.simulation.time_ns == (0 if end is State.STOPPED else time_ns)
    assert bench.session.paused is (end is not State.PLAYING)
    assert bench.standard.set_state(end).code == Code.ALREADY_IN_TARGET_STATE


def test_a_stopped_simulation_that_is_stepped_is_paused(bench):
    bench.standard.set_state(State.STOPPED)
    assert bench.standard.step().code == Code.OK
    assert bench.standard.state() is State.PAUSED
    bench.reset()
    assert bench.standard.state() is State.STOPPED


@pytest.mark.parametrize(
    ("wanted", "code"),
    [
        (State.QUITTING, Code.STATE_TRANSITION_ERROR),
        (4, Code.INCORRECT_TRANSITION),
        (5, Code.INCORRECT_TRANSITION),
        (255, Code.INCORRECT_TRANSITION),
    ],
)
def test_a_state_that_cannot_be_set_is_refused_and_nothing_changes(bench, wanted, code):
    verdict = bench.standard.set_state(wanted)
    assert verdict.code == code
    assert verdict.message
    assert bench.standard.state() is State.PLAYING


def test_a_reset_that_is_refused_is_no_stop(bench):
    bench.session.run_period()
    bench.is_reset_refused = True
    expected = (Code.STATE_TRANSITION_ERROR, "the step is too large")
    assert bench.standard.set_state(State.STOPPED) == expected
    assert bench.standard.state() is State.PAUSED
    assert bench.standard.reset(0) == (Code.OPERATION_FAILED, "the step is too large")


def test_scopes_with_time_and_state_reset_and_others_do_not(bench):
    """All 256 values of the bit field; 0 means all, and spawned entities there are none."""
    for scope in range(256):
        bench.session.run_period()
        code = bench.standard.reset(scope).code
        both = scope & Scope.TIME and scope & Scope.STATE
        if scope == 0 or both:
            assert (code, bench.session.simulation.time_ns) == (Code.OK, 0)
        else:
            assert code == (Code.OK if scope == Scope.SPAWNED else Code.FEATURE_UNSUPPORTED)
            assert bench.session.simulation.time_ns > 0


def test_a_step_is_a_period_and_needs_a_pause(bench):
    assert bench.standard.step() == (Code.OPERATION_FAILED, "running: pause first")
    bench.standard.set_state(State.PAUSED)
    assert bench.standard.step() == (Code.OK, "")
    assert bench.session.simulation.time_ns == PERIOD_NS


@pytest.mark.parametrize(
    ("pattern", "found"), [("", True), ("^veh", True), ("vehicle|car", True), ("^car$", False)]
)
def test_the_vehicle_is_found_by_a_regular_expression(bench, pattern, found):
    verdict, names = bench.standard.entities(pattern, False)
    assert verdict.code == Code.OK
    assert names == ([VEHICLE] if found else [])


@pytest.mark.parametrize("pattern", ["(", "*", "a{99999999999999999999}", "(" * 5000])
def test_what_is_no_regular_expression_is_refused(bench, pattern):
    verdict, names = bench.standard.entities(pattern, False)
    assert (verdict.code, names) == (Code.OPERATION_FAILED, [])


def test_other_filters_and_spawning_are_not_supported(bench):
    assert bench.standard.entities("", True)[0].code == Code.FEATURE_UNSUPPORTED
    assert bench.standard.spawn().code == Code.FEATURE_UNSUPPORTED


def test_an_unknown_entity_is_not_found(bench):
    for name in ("", "robot", "x" * 10_000, "v\n"):
        verdict, state = bench.standard.entity_state(name)
        assert (verdict.code, state) == (Code.NOT_FOUND, None)
        assert len(verdict.message) < 200
        assert verdict.message.isprintable()
        assert bench.standard.set_entity_state(name, HERE, None, False).code == Code.NOT_FOUND


def test_pose_and_twist_are_set_together_or_not_at_all(bench):
    bench.session.run_period()
    bench.session.inbox.receive("steering_cmd", [0.01], PERIOD_NS)
    moved = ((7.0, 8.0, 0.0), HERE[1])
    before = bench.session.snapshot()
    sideways = ((0.0, 12.0, 0.0), AHEAD[1])
    verdict = bench.standard.set_entity_state(VEHICLE, moved, sideways, False)
    assert verdict.code == Code.OPERATION_FAILED
    assert bench.session.snapshot() == before
    assert bench.standard.set_entity_state(VEHICLE, moved, AHEAD, False).code == Code.OK
    _, state = bench.standard.entity_state(VEHICLE)
    assert state.position[:2] == pytest.approx((7.0, 8.0))
    assert state.velocity == pytest.approx((12.0, 0.0, 0.0), abs=1e-9)
    assert bench.session.inbox.command(PERIOD_NS).steering == 0.01


def test_what_cannot_be_set_says_so(bench):
    upside_down = (HERE[0], (1.0, 0.0, 0.0, 0.0))
    set_state = bench.standard.set_entity_state
    assert set_state(VEHICLE, upside_down, None, False).code == INVALID_POSE
    assert set_state(VEHICLE, None, None, True).code == Code.FEATURE_UNSUPPORTED
    bench.session.inbox.receive("steering_cmd", [0.2], 0)
    while not bench.session.stopped:
        bench.session.run_period()
    assert set_state(VEHICLE, HERE, None, False).code == Code.INCORRECT_STATE
    assert set_state(VEHICLE, None, None, False).code == Code.INCORRECT_STATE
    assert set_state(VEHICLE, HERE, None, True).code == Code.FEATURE_UNSUPPORTED


def test_it_tells_its_version_and_the_length_of_a_step(bench):
    assert "0.01 s" in bench.standard.about
    assert VEHICLE in bench.standard.about
