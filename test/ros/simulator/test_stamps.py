"""Without /clock, stamps increase and are the times at which sets were due on the node's clock."""

import itertools
import os
import re
import signal
import time
from unittest.mock import Mock

import pytest
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from std_srvs.srv import SetBool, Trigger

from vehicle_roll_sim import Simulation, preset
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.messages.covariances import Covariances
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.ros.simulator.publications import Publications
from vehicle_roll_sim.ros.simulator.settings import Settings
from vehicle_roll_sim.ros.simulator.stamps import Stamps

MS, SECOND = 1_000_000, 1_000_000_000
PERIOD = 10 * MS
CLOSE = 5 * MS
"""ns by which stamps may be off the clock once what was missed has been made up for."""
STANDSTILL, PAUSE = 2.0, 1.5
"""s"""
STOOD_STILL = (STANDSTILL - 0.1) * SECOND / PERIOD - 2
"""Fewest periods that are skipped in a standstill: those beyond 0.1 s, which are made up for."""
A_YEAR_SINCE_1970 = 31_536_000 * SECOND


class TwoClocks:
    """A clock on the wall, which can be set, and a steady one; both go on by hand."""

    def __init__(self):
        self.wall_ns, self.steady_ns = A_YEAR_SINCE_1970, 123_456_789

    def pass_by(self, ns: int) -> None:
        self.wall_ns += ns
        self.steady_ns += ns


@pytest.fixture
def clocks():
    return TwoClocks()


@pytest.fixture
def stamps(clocks):
    return Stamps(lambda: clocks.wall_ns, lambda: clocks.steady_ns)


def test_a_set_is_stamped_with_the_time_at_which_it_was_due(clocks, stamps):
    due_ns, due_on_the_wall = clocks.steady_ns, clocks.wall_ns
    clocks.pass_by(7 * MS)  # it is anchored late
    stamps.anchor(30 * MS, due_ns)
    assert stamps.of(30 * MS) == due_on_the_wall
    assert stamps.of(40 * MS) == due_on_the_wall + PERIOD  # whatever time it is


def test_an_anchor_in_the_past_does_not_turn_stamps_back(clocks, stamps):
    stamps.anchor(0, clocks.steady_ns)
    last = stamps.of(PERIOD)
    stamps.anchor(0, clocks.steady_ns)
    assert [stamps.of(0), stamps.of(PERIOD)] == [last + 1, last + 1 + PERIOD]


def test_a_clock_that_is_set_back_is_told_of_until_stamps_are_anchored_behind_it(clocks, stamps):
    last = stamps.of(0)
    clocks.pass_by(PERIOD)
    clocks.wall_ns -= 60 * SECOND
    assert stamps.follow() == 0
    assert stamps.of(PERIOD) == last + PERIOD
    assert stamps.lead_ns() == 60 * SECOND
    stamps.anchor(0, clocks.steady_ns)
    assert stamps.of(0) == last + PERIOD + 1
    assert stamps.lead_ns() == 60 * SECOND + 1
    clocks.pass_by(61 * SECOND)  # in a pause
    stamps.anchor(0, clocks.steady_ns)
    assert stamps.of(0) == clocks.wall_ns
    assert stamps.lead_ns() == 0


def test_what_a_clock_gains_by_being_set_or_on_a_suspended_host_is_made_up_for_once(clocks, stamps):
    stamps.anchor(0, clocks.steady_ns)
    clocks.pass_by(PERIOD)
    clocks.wall_ns += 3600 * SECOND
    assert [stamps.follow(), stamps.follow()] == [3600 * SECOND, 0]
    assert stamps.of(PERIOD) == clocks.wall_ns


def test_a_clock_that_was_set_back_and_forth_has_gained_nothing(clocks, stamps):
    clocks.wall_ns -= 60 * SECOND
    assert stamps.follow() == 0
    clocks.wall_ns += 60 * SECOND
    assert stamps.follow() == 0
    assert stamps.lead_ns() == 0


def test_a_thread_that_is_interrupted_between_two_clocks_does_not_take_that_for_a_gain(clocks):
    interruptions = iter([0, 8 * MS, 0, 0, 0, 30 * MS, 0, 0])

    def wall() -> int:
        clocks.pass_by(next(interruptions, 0))
        return clocks.wall_ns

    stamps = Stamps(wall, lambda: clocks.steady_ns)
    assert [stamps.follow() for _ in range(4)] == [0] * 4
    assert stamps.lead_ns() == 0


def test_a_clock_that_is_set_is_told_of_and_a_stopped_model_keeps_its_stamp(
    peer, clocks, monkeypatch
):
    session = Session(Simulation(preset()), CommandInbox(), PERIOD, 13.9)
    publications = Publications(peer.node, session, Settings(), Covariances())
    publications._stamps = Stamps(lambda: clocks.wall_ns, lambda: clocks.steady_ns)
    publications._unnoticed_ns, logger = 0, Mock()
    monkeypatch.setattr(peer.node, "get_logger", lambda: logger)
    clocks.wall_ns += 60 * SECOND
    publications.publish_set()
    logger.warning.assert_called_once_with("the clock was set 60.000 s ahead: stamps follow it")
    assert publications._messages.stamp == divmod(clocks.wall_ns, SECOND)
    assert publications.clock_trouble() == ""
    clocks.wall_ns -= 3600 * SECOND
    assert "stamps keep increasing, 3600.000 s ahead of it" in publications.clock_trouble()
    stamp = publications._messages.stamp
    session.simulation.condition = Condition.ROLLED_OVER
    clocks.wall_ns += 7200 * SECOND
    publications.publish_set()
    assert publications._messages.stamp == stamp


def stamps_and_sent(peer) -> list[tuple[int, int]]:
    """(stamp, when it was sent) of every imu so far, ns on the clock."""
    return [
        (message.header.stamp.sec * SECOND + message.header.stamp.nanosec, sent)
        for sent, message in peer.received["imu"]
    ]


def skipped(text: str) -> int:
    """All periods that are said to have been skipped; a busy machine may skip some before."""
    return sum(int(count) for count in re.findall(r"too slow: (\d+) periods skipped", text))


def diagnoses(peer) -> list[str]:
    return [message.status[0].message for _, message in peer.received["/diagnostics"]]


def sent_since(peer, began_ns: int) -> list[tuple[int, int]]:
    return [(stamp, sent) for stamp, sent in stamps_and_sent(peer) if sent > began_ns]


def wait_until_close(peer, what: str) -> None:
    """Until a set that is sent from now on bears the time at which it is sent.

    A set that is not caught up or is sent late by a busy machine is behind, so the best one counts.
    """
    began = time.time_ns()

    def found():
        peer.newest("imu")
        return any(abs(sent - stamp) < CLOSE for stamp, sent in sent_since(peer, began))

    peer.wait(found, f"stamps at the clock {what}")


def pause(peer, is_paused: bool) -> None:
    assert peer.call(SetBool, "simulator/pause", SetBool.Request(data=is_paused)).success


def test_stamps_are_at_the_clock_after_start_pause_reset_and_standstill(start, peer):
    simulator = start("simulator")
    peer.listen("imu", "/diagnostics")
    wait_until_close(peer, "after the start")
    pause(peer, True)
    time.sleep(PAUSE)  # the pause itself is what is tried
    asked = time.time_ns()
    assert peer.call(Trigger, "simulator/step").success
    stamp, sent = peer.wait(lambda: sent_since(peer, asked), "the set of a single step")[0]
    assert 0 <= sent - stamp < 0.5 * PAUSE * SECOND  # one set alone may be sent late
    pause(peer, False)
    wait_until_close(peer, "after a pause")
    assert peer.call(Trigger, "simulator/reset").success
    wait_until_close(peer, "after a reset")
    os.kill(simulator.process.pid, signal.SIGSTOP)
    time.sleep(STANDSTILL)  # the standstill itself is what is tried
    os.kill(simulator.process.pid, signal.SIGCONT)
    wait_until_close(peer, "after a standstill")
    peer.wait(lambda: skipped(" ".join(diagnoses(peer))) >= STOOD_STILL, "skipped periods")
    found = stamps_and_sent(peer)
    assert all(after > before for (before, _), (after, _) in itertools.pairwise(found))
    assert all(stamp - sent < CLOSE for stamp, sent in found)  # none is of the future
    _, _, err = simulator.finish(2)
    assert skipped(err) >= STOOD_STILL


def test_a_simulator_that_should_go_by_a_clock_is_refused_with_the_reason(start):
    status, out, err = start("simulator", "--ros-args", "-p", "use_sim_time:=true").finish()
    assert (status, out) == (2, "")
    (line,) = err.splitlines()
    assert line.startswith("simulator: error: use_sim_time: true is not allowed: false, because")
    assert "publish_clock" in line


def test_nor_can_it_be_told_to_while_it_runs(start, peer):
    start("simulator")
    peer.listen("imu")

    def answer_to(value: bool):
        parameter = Parameter("use_sim_time", value=value).to_parameter_msg()
        request = SetParameters.Request(parameters=[parameter])
        return peer.call(SetParameters, "simulator/set_parameters", request).results[0]

    refused = answer_to(True)
    assert not refused.successful
    assert "the simulator is the source of time" in refused.reason
    assert answer_to(False).successful
    assert peer.node.count_subscribers("/clock") == 0
    wait_until_close(peer, "as before")
