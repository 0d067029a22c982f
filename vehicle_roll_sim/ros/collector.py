"""The sets that a running simulator publishes, put together again and made into a history."""

import bisect
import math
from collections.abc import Callable, Iterator

import numpy as np
from rclpy.node import Node

from vehicle_roll_sim.analysis.sampled_events import events_of as events_of
from vehicle_roll_sim.model.frames import body_to_yawed
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.ros.messages import COMMAND_LABELS
from vehicle_roll_sim.ros.topics import STATE_SET, recording_qos
from vehicle_roll_sim.simulation.history import COLUMNS, History

STATE, COMMAND, IMU, LOADS = "state", "applied_command", "imu", "tire_normal_forces"
COLLECTED = (STATE, COMMAND, IMU, LOADS)


class Collector:
    """Keeps what a simulator publishes from the last reset on.

    A set begins with its `state` and one process sends it in order, so whatever was sent between
    two states belongs to the first of them. on_state is told every `state` kept, by name.
    """

    def __init__(self, node: Node, on_state: Callable[[dict], None]):
        self._on_state = on_state
        self.subscriptions = [
            node.create_subscription(
                topic.type, topic.name, self._listener(topic.name), recording_qos(topic)
            )
            for topic in STATE_SET
            if topic.name in COLLECTED
        ]
        self.forget()

    def forget(self) -> None:
        """Drop everything, and wait for the state at time 0 that a reset brings."""
        self._kept = {name: [] for name in COLLECTED}

    def _listener(self, name: str):
        def listen(message, info: dict) -> None:
            if name == STATE:
                self._keep_state(by_name(message), info["source_timestamp"])
            else:
                self._kept[name].append((info["source_timestamp"], message))

        return listen

    def _keep_state(self, state: dict, sent: int) -> None:
        if state["time"] == 0.0:
            self._kept[STATE] = []
        elif not self._kept[STATE]:
            return
        self._kept[STATE].append((sent, state))
        self._on_state(state)

    def is_complete(self) -> bool:
        """Whether all messages of the last set have come."""
        sent = self._kept[STATE][-1][0]
        return all(self._sent_between(name, sent, math.inf) for name in COLLECTED[1:])

    def history(self) -> History:
        """One row for every complete set; columns that no topic carries are nan."""
        rows = [_row(*parts) for parts in self._sets()]
        return History(rows)

    def _sets(self) -> Iterator[tuple]:
        """(state, applied_command, imu, tire_normal_forces) of every complete set."""
        states = self._kept[STATE]
        ends = [sent for sent, _ in states[1:]] + [math.inf]
        for (sent, state), end in zip(states, ends, strict=True):
            parts = [self._sent_between(name, sent, end) for name in COLLECTED[1:]]
            if None not in parts:
                yield (state, *parts)

    def _sent_between(self, name: str, start: int, end: float):
        """The message of a topic that was sent between two times, None if there was none."""
        kept = self._kept[name]
        place = bisect.bisect_left(kept, start, key=lambda entry: entry[0])
        if place < len(kept) and kept[place][0] < end:
            return kept[place][1]
        return None


def by_name(message) -> dict[str, float]:
    """The values of a labelled multi-array."""
    labels = (dimension.label for dimension in message.layout.dim)
    return dict(zip(labels, message.data, strict=True))


def _row(state: dict, command, imu, loads) -> np.ndarray:
    row = np.full(len(COLUMNS), np.nan)
    for name, value in state.items():
        if name in COLUMNS:
            row[COLUMNS.index(name)] = value
    first = COLUMNS.index(f"normal_force_{WHEELS[0]}")
    row[first : first + len(WHEELS)] = loads.data
    row[COLUMNS.index("steering")] = command.data[COMMAND_LABELS.index("steering")]
    row[COLUMNS.index("lateral_acceleration")] = _lateral_acceleration(state, imu)
    return row


def _lateral_acceleration(state: dict, imu) -> float:
    """Along the y axis of frame 2, where gravity has no share of the specific force."""
    roll, pitch = state["roll"], state.get("pitch", 0.0)
    attitude = (np.sin(roll), np.cos(roll), np.sin(pitch), np.cos(pitch))
    specific = imu.linear_acceleration
    return body_to_yawed(attitude, specific.x, specific.y, specific.z)[1]
