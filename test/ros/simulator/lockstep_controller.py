"""A controller program in lockstep: answers every state and reports the messages received.

usage: lockstep_controller.py PERIODS. Prints, by topic, how many messages came and a digest of
all of them in order, and the last state.
"""

import hashlib
import json
import sys

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

from vehicle_roll_sim.messages.command_topics import COMMANDS
from vehicle_roll_sim.messages.topics import CLOCK, ROLLOVER, STATE_SET
from vehicle_roll_sim.ros.topics import COMMANDING, message_class, offered_qos

ROLL, ROLL_RATE = 4, 10
"""Places in `state`, whose first element is the time."""


def answers(state) -> dict[str, object]:
    """The commands that follow from a state: hard to the left, the body pushed against the roll.

    The wind from the left becomes stronger with time.
    """
    push = 20_000.0 * state[ROLL] + 2_000.0 * state[ROLL_RATE]
    return {
        "steering_cmd": min(0.2, 0.4 * state[0]),
        "normal_force_cmd": [-push, push, -push, push],
        "wind_cmd": [1.0, -5.0 * state[0]],
    }


class Controller(Node):
    def __init__(self, periods: int):
        super().__init__("controller")
        self.periods = periods
        self.commands = {}
        for topic in COMMANDS:
            if topic.name in ("steering_cmd", "normal_force_cmd", "wind_cmd"):
                kind = message_class(topic.type)
                publisher = self.create_publisher(kind, topic.name, COMMANDING)
                self.commands[topic.name] = publisher, kind
        self.counts, self.digests, self.state = {}, {}, None
        for topic in (*STATE_SET, ROLLOVER, CLOCK):
            self.counts[topic.name], self.digests[topic.name] = 0, hashlib.sha256()
            kind, qos = message_class(topic.type), offered_qos(topic)
            self.create_subscription(kind, topic.name, self.listener(topic.name), qos)

    def listener(self, name: str):
        def listen(message):
            self.counts[name] += 1
            self.digests[name].update(repr(message).encode())
            if name == "state":
                self.answer(list(message.data))

        return listen

    def answer(self, state: list[float]) -> None:
        self.state = state
        if self.counts["state"] <= self.periods:
            for name, value in answers(state).items():
                publisher, kind = self.commands[name]
                publisher.publish(kind(data=value))

    @property
    def finished(self) -> bool:
        """Whether the set after the last answer is complete."""
        every_set = (count for name, count in self.counts.items() if name != ROLLOVER.name)
        return min(every_set) > self.periods


def main() -> None:
    rclpy.init()
    try:
        controller = Controller(int(sys.argv[1]))
        while not controller.finished:
            rclpy.spin_once(controller, timeout_sec=0.1)
        digests = {name: digest.hexdigest() for name, digest in controller.digests.items()}
        heard = {"counts": controller.counts, "digests": digests, "state": controller.state}
        print(json.dumps(heard))
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
