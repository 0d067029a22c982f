"""What a running simulator publishes, kept from the last reset on."""

from collections.abc import Callable

from rclpy.node import Node

from vehicle_roll_sim.messages.collected import COLLECTED, STATE, Collected, by_name, is_ours
from vehicle_roll_sim.ros.qos_overrides import make_subscription
from vehicle_roll_sim.ros.topics import message_class, recording_qos
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.road import Road

NUMBER = "publication_sequence_number"
"""In what is known of a message: which of its publisher's it is, from 1."""


class Collector:
    """Listens to the sets of a simulator; what cannot be of one is passed over.

    on_state is told every `state` kept, by name. is_mixed: whether what came on a topic since the
    last `forget` is known to be of two publishers, by the numbers that each of them counts.
    """

    def __init__(self, node: Node, on_state: Callable[[dict], None]):
        self._on_state = on_state
        self.subscriptions = [
            make_subscription(
                node,
                message_class(topic.type),
                topic.name,
                self._listener(topic.name),
                recording_qos(topic),
            )
            for topic in COLLECTED
        ]
        self.forget()

    def forget(self) -> None:
        """Drop everything, and wait for the state at time 0 that a reset brings."""
        self._kept = Collected()
        self.is_mixed, self._numbers = False, {}

    def _listener(self, name: str):
        def listen(message, info: dict) -> None:
            if not is_ours(name, message):
                return
            self._note_number(name, info.get(NUMBER))
            if name == STATE:
                self._keep_state(by_name(message), info["source_timestamp"])
            else:
                self._kept.keep(name, info["source_timestamp"], message)

        return listen

    def _note_number(self, name: str, number: int | None) -> None:
        """One publisher counts its messages up; not every middleware passes the numbers on."""
        if number is None:
            return
        self.is_mixed = self.is_mixed or number <= self._numbers.get(name, 0)
        self._numbers[name] = number

    def simulators(self) -> int:
        """How many nodes, as far as is known, publish all that a simulator does."""
        return min(each.get_publisher_count() for each in self.subscriptions)

    def _keep_state(self, state: dict, sent: int) -> None:
        if state["time"] == 0.0:
            self._kept.states.clear()
        elif not self._kept.states:
            return
        self._kept.states.append((sent, state))
        self._on_state(state)

    def is_complete(self) -> bool:
        """Whether all messages of the last set have come."""
        return self._kept.is_complete()

    def history(self, road: Road) -> History:
        """One row for every complete set (`Collected.history`)."""
        return self._kept.history(road)
