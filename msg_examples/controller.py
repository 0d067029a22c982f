"""What the controllers here have in common: one answer for every message of one topic.

That is all that lockstep wants. The answer's publisher is made when the topic that is listened to
has one, because lockstep begins as soon as all commands have publishers; so a chain of controllers
connects from the simulator on, and the first set finds all of them.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

LOOK = 0.02
"""s between two looks for a publisher."""
KEPT = 10
"""Messages that wait to be handled; in lockstep there is never more than one."""


class Controller(Node):
    """A node `name` that answers messages of a topic; both topics as (name, message type)."""

    def __init__(self, name: str, heard: tuple[str, type], said: tuple[str, type]):
        super().__init__(name)
        self._said, self._publisher = said, None
        self._heard = self.create_subscription(heard[1], heard[0], self._listen, KEPT)

    def answer(self, message):
        """The data of the answer to a message; to be written by the controller."""
        raise NotImplementedError

    def parameter(self, name: str, default: float) -> float:
        """The value of a ROS parameter, which may be given as an integer."""
        return float(self.declare_parameter(name, default).value)

    def prepare(self) -> None:
        """What is to be done between the first publisher and the first message."""

    def run(self) -> None:
        """Connect, then answer until the end."""
        while not self._heard.get_publisher_count():
            rclpy.spin_once(self, timeout_sec=LOOK)
        self.prepare()
        self._publisher = self.create_publisher(self._said[1], self._said[0], KEPT)
        rclpy.spin(self)

    def _listen(self, message) -> None:
        if self._publisher:
            self._publisher.publish(self._said[1](data=self.answer(message)))


def run(kind: type[Controller]) -> None:
    """Run a controller until SIGINT or SIGTERM."""
    rclpy.init()
    try:
        kind().run()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
