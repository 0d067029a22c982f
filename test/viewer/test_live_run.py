"""What a page is told of a running simulator, put together again, is the run."""

import base64
import itertools
import json
import threading
import urllib.error
import urllib.request

import numpy as np
import pytest
from viewed_runs import fishhook, of_columns, scene

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.viewer.live_run import WINDOW, LiveRun
from vehicle_roll_sim.viewer.live_server import FEED, LiveServer

ANGLE = 1.4
"""rad: of a rollover."""
TURN = "wheel_angle_lf"


class KnownToAPage:
    """Does with the updates what the page does with them."""

    def __init__(self, run):
        self._updates, self.time, self.run = run.updates(), None, None

    def take(self) -> dict:
        told = json.loads(next(self._updates))
        time = np.frombuffer(base64.b64decode(told["time"]), "<f8")
        values = np.frombuffer(base64.b64decode(told["values"]), "<f4")
        columns = dict(zip(told["columns"], values.reshape(-1, len(time)), strict=True))
        if told["run"] != self.run:
            self.time, self.columns, self.run = time, columns, told["run"]
            return told
        assert time[0] == self.time[-1]
        kept = self.time[:-1] >= told["begin"]
        for name, added in columns.items():
            before = self.columns[name]
            shift = before[-1] if name.startswith("wheel_angle") else 0
            self.columns[name] = np.concatenate((before[:-1][kept], added + shift))
        self.time = np.concatenate((self.time[:-1][kept], time))
        return told


@pytest.fixture
def live():
    return LiveRun("a run", scene(), ANGLE)


def rows(history: History, begin: int, end: int) -> History:
    places = np.arange(len(history.rows))
    return history.part((places >= begin) & (places < end))


def test_pieces_put_together_are_the_run(live):
    history = fishhook().history
    edges = [0, 1, 40, 41, 150, len(history.rows)]
    known = None
    for begin, end in itertools.pairwise(edges):
        live.add(rows(history, begin, end))
        known = known or KnownToAPage(live)
        told = known.take()
    np.testing.assert_array_equal(known.time, history["time"])
    np.testing.assert_array_equal(known.columns["roll"], history["roll"].astype("f4"))
    speed, time = history.wheels("wheel_speed")[:, 0], history["time"]
    turned = np.sum((speed[1:] + speed[:-1]) / 2 * np.diff(time))
    assert known.columns[TURN][-1] == pytest.approx(turned, abs=1e-3)  # sums of 32-bit numbers
    lift_offs = {each["time"] for each in told["events"] if "lifts off" in each["name"]}
    expected = fishhook().events.lift_off_time
    assert sorted(lift_offs) == pytest.approx(sorted(expected[~np.isnan(expected)]), abs=1e-3)
    assert told["rollover"] is not None


def test_a_page_that_comes_later_gets_the_whole_window(live):
    live.add(of_columns(100))
    live.add(later(of_columns(100), 1.0))
    known = KnownToAPage(live)
    known.take()
    assert len(known.time) == 200


def later(history: History, by: float) -> History:
    history.rows[:, 0] += by
    return history


def test_only_the_last_of_the_run_is_kept_but_its_rollover_is_remembered(live):
    live.add(of_columns(100, roll=np.linspace(0, 1.5, 100)))
    known = KnownToAPage(live)
    known.take()
    live.add(later(of_columns(int(100 * WINDOW)), 1.0))
    told = known.take()
    assert known.time[-1] - known.time[0] == pytest.approx(WINDOW, abs=0.011)  # one sample
    assert told["rollover"] < 1.0


def test_a_reset_begins_another_run_and_a_standstill_adds_nothing(live):
    live.add(of_columns(100))
    known = KnownToAPage(live)
    known.take()
    live.add(rows(of_columns(100), 99, 100))
    assert next(known._updates) == ""
    live.add(of_columns(3))
    known.take()
    assert known.run == 2
    assert len(known.time) == 3


def test_a_command_that_begins_later_gets_its_panel_by_another_page_and_keeps_it(live):
    def given(torque):
        history = later(of_columns(10), live.window.viewed.history["time"][-1] + 0.01)
        history.commands = np.full((10, 13), torque)
        return history

    live.add(of_columns(10))
    first = live.window.page
    live.add(given(0.0))
    assert live.window.page == first
    live.add(given(5.0))
    second = live.window.page
    assert second != first
    assert "wheel torque" in live.page(FEED)
    live.add(later(of_columns(10), 100.0))  # which leaves the torques behind
    assert live.window.page == second
    assert "wheel torque" in live.page(FEED)


@pytest.fixture
def server():
    server = LiveServer(0)
    server.start()
    yield server
    server.close()


def test_the_server_answers_this_machine_only_and_under_its_own_name_only(server):
    def status(path, **headers):
        try:
            request = urllib.request.Request(server.address + path, headers=headers)
            return urllib.request.urlopen(request).status
        except urllib.error.HTTPError as error:
            return error.code

    assert server.server_address[0] == "127.0.0.1"
    assert status("") == 200
    assert status("", Host=f"localhost:{server.server_port}") == 200
    assert status("", Host="elsewhere.example") == 403
    assert status(FEED[1:]) == 404  # no run yet
    assert status("../etc/passwd") == 404


def test_a_port_that_is_taken_is_refused(server):
    with pytest.raises(InputError, match=f"--port: {server.server_port} is taken"):
        LiveServer(server.server_port)


def test_updates_end_with_the_run(server, live):
    live.add(of_columns(10))
    server.run = live
    with urllib.request.urlopen(server.address + FEED[1:]) as feed:
        assert feed.headers["Content-Type"] == "text/event-stream"
        assert json.loads(feed.readline().decode().removeprefix("data: "))["label"] == "a run"
        threading.Timer(0, live.close).start()
        assert feed.read().strip(b":\n") == b""  # nothing but signs of life, and the end
