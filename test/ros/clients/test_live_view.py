"""The node that serves the page of a running simulator."""

import json
import re
import signal
import urllib.request

import pytest

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.ros.clients.live_view import port_of
from vehicle_roll_sim.viewer.live_server import FEED

pytestmark = pytest.mark.unmeasured


@pytest.fixture
def view(start):
    return start("live_view", "--port", "0")


def address_of(view) -> str:
    return re.search(r"http://127\.0\.0\.1:\d+/", view.process.stdout.readline())[0]


def updates(address):
    with urllib.request.urlopen(address + FEED[1:]) as feed:
        for line in feed:
            if line.startswith(b"data: "):
                yield json.loads(line[len(b"data: ") :])


def test_a_page_gets_the_samples_of_a_simulator_that_starts_later(view, start, peer):
    address = address_of(view)
    assert "Waiting" in urllib.request.urlopen(address).read().decode()
    start("simulator", "--ros-args", "-p", "initial_speed:=20.0")
    peer.listen("state")
    peer.wait(lambda: b"roll angle" in urllib.request.urlopen(address).read(), "a page with a run")
    feed = updates(address)
    first, second = next(feed), next(feed)
    assert first["run"] == second["run"]
    assert second["begin"] <= first["begin"] + 30
    feed.close()
    view.process.send_signal(signal.SIGINT)
    assert view.process.wait(timeout=60) == 0


@pytest.mark.parametrize("text", ["x", "80", "-1", "65536", "2000.5", "nan", ""])
def test_a_port_that_is_none_is_refused(text):
    with pytest.raises(InputError, match=r"--port.*a whole number from 1024 to 65535"):
        port_of(text)
