"""Requests are repeated, and an answer counts however late it comes; in time of the test's own."""

import pytest
from rclpy.task import Future

from vehicle_roll_sim.ros.clients import simulator_client
from vehicle_roll_sim.ros.clients.simulator_client import (
    ASK_AGAIN,
    PATIENCE,
    NoAnswerError,
    SimulatorClient,
)

LOOK = 0.05
"""s: by which each look of the executor moves the time on."""


class Server:
    """Answers one request after the other, each `delay` (s) after it was begun.

    Those that come before `discovered` (s) get no answer. It stands for the client, too, and for
    the executor that the client spins.
    """

    def __init__(self, delay: float, discovered: float = 0.0):
        self.now, self.free = 0.0, 0.0
        self._delay, self._discovered = delay, discovered
        self.asked, self._due, self.pending = [], [], []

    def service_is_ready(self) -> bool:
        return True

    def call_async(self, request) -> Future:
        future = Future()
        self.asked.append(self.now)
        self.pending.append(future)
        self.free = max(self.now, self.free) + self._delay
        if self.now >= self._discovered:
            self._due.append((self.free, future, len(self.asked)))
        return future

    def remove_pending_request(self, future: Future) -> None:
        self.pending.remove(future)

    def spin_once(self, timeout_sec: float) -> None:
        self.now += LOOK
        for due, future, number in self._due:
            if due <= self.now and future in self.pending and not future.done():
                future.set_result(number)


@pytest.fixture
def ask(monkeypatch):
    """ask(server): the number of the request whose answer counts, and how many were sent."""

    def ask_it(server: Server) -> tuple[int, int]:
        monkeypatch.setattr(simulator_client.time, "monotonic", lambda: server.now)
        client = SimulatorClient.__new__(SimulatorClient)
        client.name, client._executor = "simulator", server
        client._compilations = type("Quiet", (), {"is_running": lambda self: False})()
        begun = []
        answer = client._call(server, None, "a reset", lambda: begun.append(server.now))
        assert begun == server.asked
        assert not server.pending
        return answer, len(server.asked)

    return ask_it


def test_an_answer_in_time_is_that_of_the_only_request(ask):
    assert ask(Server(delay=0.5)) == (1, 1)


def test_answers_that_take_longer_than_a_repetition_arrive_all_the_same(ask):
    """The last request counts: a reset that is asked for twice is done twice, then driven."""
    assert ask(Server(delay=1.4 * ASK_AGAIN)) == (2, 2)
    assert ask(Server(delay=0.9 * PATIENCE)) == (5, 5)


def test_a_server_that_had_not_discovered_the_client_is_asked_again(ask):
    assert ask(Server(delay=0.1, discovered=1.5 * ASK_AGAIN)) == (3, 3)


def test_a_server_that_never_answers_is_given_up_after_the_patience(ask):
    server = Server(delay=0.1, discovered=1e3)
    with pytest.raises(NoAnswerError, match=r"no answer from `simulator` within 10 s; .* a reset"):
        ask(server)
    assert PATIENCE <= server.now < PATIENCE + ASK_AGAIN
    assert not server.pending
