"""What a simulator publishes: a set of messages every period, and a few beside them."""

import time
from collections.abc import Callable

from builtin_interfaces.msg import Time
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.node import Node
from std_msgs.msg import Bool, String

from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.ros.messages import Messages
from vehicle_roll_sim.ros.topics import (
    CLOCK,
    ROBOT_DESCRIPTION,
    ROLLOVER,
    STATE_SET,
    TRANSFORMS,
    Topic,
)
from vehicle_roll_sim.simulation.session import Session

LONGEST_UNNOTICED_NS = 50_000_000
"""Wall time (ns) for which real time may not notice a new listener: looking costs like sending."""


class Publications:
    """The publishers of `node` for the messages of a session.

    own_clock: stamps are simulated time and published on /clock; else they begin at the time of
    the start. unnoticed_ns: wall time for which a new listener may go unnoticed. sets: how many
    have been published.
    """

    def __init__(
        self,
        node: Node,
        session: Session,
        *,
        frame_prefix: str,
        own_clock: bool,
        unnoticed_ns: int,
        robot_description: str,
    ):
        self._node, self._session = node, session
        self._messages = Messages(session, frame_prefix)
        self._stamps_begin_ns = 0 if own_clock else node.get_clock().now().nanoseconds
        self._last_stamp_ns = self._stamps_begin_ns
        self.sets = 0
        topics = (CLOCK, *STATE_SET) if own_clock else STATE_SET
        self._own_clock, self._unnoticed_ns = own_clock, unnoticed_ns
        self._set = {topic.name: (self.publisher(topic), self._builder(topic)) for topic in topics}
        self._transforms = [(self.publisher(topic), topic.type) for topic in TRANSFORMS]
        self._prepare()
        self._rollover = self.publisher(ROLLOVER)
        self._description = self.publisher(ROBOT_DESCRIPTION)
        self._description.publish(String(data=robot_description))

    def _prepare(self) -> None:
        """Build everything once, so that nothing has to be compiled when time matters."""
        for _, build in self._set.values():
            build()
        self.look_for_listeners()

    def publisher(self, topic: Topic):
        """One without event handlers: each would be one more thing for every wait to watch."""
        return self._node.create_publisher(
            topic.type,
            topic.name,
            topic.publisher_qos,
            event_callbacks=PublisherEventCallbacks(use_default_callbacks=False),
        )

    def _builder(self, topic: Topic) -> Callable[[], bytes]:
        """The method that brings the message of a topic up to date."""
        family, _, wheel = topic.name.lstrip("/").partition("/")
        if family == "tire_forces":
            index = WHEELS.index(wheel)
            return lambda: self._messages.tire_force(index)
        return getattr(self._messages, family)

    def look_for_listeners(self) -> None:
        """Find out to which topics of the set somebody listens."""
        self._heard = [
            (publisher, build)
            for publisher, build in self._set.values()
            if publisher.get_subscription_count()
        ]
        self._transforms_heard = [
            (publisher, kind)
            for publisher, kind in self._transforms
            if publisher.get_subscription_count()
        ]
        self._looked_ns = time.monotonic_ns()

    def publish_set(self) -> None:
        """The messages of the present that somebody listens to."""
        stamp_ns = self._stamps_begin_ns + self._session.simulation.time_ns
        self._messages.set_time(stamp_ns)
        if time.monotonic_ns() - self._looked_ns >= self._unnoticed_ns:
            self.look_for_listeners()
        for publisher, build in self._heard:
            publisher.publish(build())
        if not self._session.stopped:  # tf2 complains of a transform that comes twice
            for publisher, kind in self._transforms_heard:
                publisher.publish(kind(transforms=self._messages.transforms()))
        self._last_stamp_ns = stamp_ns
        self.sets += 1

    def publish_rollover(self) -> None:
        self._rollover.publish(Bool(data=self._session.rolled_over))

    def after_reset(self) -> None:
        """Stamps go on rising, unless they are simulated time, which begins anew."""
        if not self._own_clock:
            self._stamps_begin_ns = self._last_stamp_ns + self._session.period_ns

    def present_stamp(self):
        """For messages of no set: the time on the clock that subscribers go by."""
        if self._own_clock:
            return Time(sec=self._messages.stamp.sec, nanosec=self._messages.stamp.nanosec)
        return self._node.get_clock().now().to_msg()

    def listeners(self, name: str) -> int:
        """How many listen to a topic of the set."""
        return self._set[name][0].get_subscription_count()
