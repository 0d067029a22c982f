"""A page that follows a run that goes on, in a real browser."""

import pytest
from viewed_runs import ROAD, fishhook, scene

from vehicle_roll_sim.viewer.live_run import LiveRun
from vehicle_roll_sim.viewer.live_server import LiveServer

pytestmark = pytest.mark.unmeasured

LIT = "[...document.querySelectorAll('.lamp.on')].length"


@pytest.fixture
def server():
    server = LiveServer(0)
    server.start()
    yield server
    server.close()


def test_a_page_follows_the_run_until_another_time_is_chosen(server, opened_at):
    history, places = fishhook().history, fishhook().history["time"]
    page = opened_at(server.address)
    assert "Waiting for a simulator" in page("document.body.textContent")
    server.run = live = LiveRun("fishhook", scene(), 1.4, ROAD)
    live.add(history.part(places < 1.0))
    page.wait_for("window.viewer && window.viewer.state().isFollowing")
    live.add(history.part(places >= 1.0))
    end = float(places[-1])
    page.wait_for(f"window.viewer.state().time === {end!r}")
    assert page(LIT) == 5
    assert page("document.querySelectorAll('#event-list li').length") >= 5
    assert page("document.querySelectorAll('#surfaces li').length") == 2

    page("window.viewer.play(false)")
    assert not page.at(1.5)["isFollowing"]
    live.add(history.part(places < 0.5))  # a reset
    page.wait_for("window.viewer.state().time < 0.5")
    page("document.getElementById('live').click()")
    page.wait_for("window.viewer.state().isFollowing")
    assert page.complaints == []
