"""What a simulator publishes: a set of messages every period, and a few other topics."""

import time
from collections.abc import Collection

from builtin_interfaces.msg import Time
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.node import Node
from rclpy.publisher import Publisher

from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.messages.covariances import Covariances
from vehicle_roll_sim.messages.measured import messages_of
from vehicle_roll_sim.messages.road_marker import road_marker
from vehicle_roll_sim.messages.stamped import builder
from vehicle_roll_sim.messages.topic import Topic
from vehicle_roll_sim.messages.topics import (
    CLOCK,
    DIAGNOSTICS,
    ROAD,
    ROBOT_DESCRIPTION,
    ROLLOVER,
    SIMULATION_DESCRIPTION,
    TRANSFORMS,
    set_of,
)
from vehicle_roll_sim.messages.urdf import robot_description
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.ros.encoding import encode
from vehicle_roll_sim.ros.qos_overrides import make_publisher
from vehicle_roll_sim.ros.simulator.settings import Settings
from vehicle_roll_sim.ros.simulator.stamps import Stamps
from vehicle_roll_sim.ros.topics import is_installed, message_class, offered_qos
from vehicle_roll_sim.simulation.description import describe
from vehicle_roll_sim.simulation.options import Options

LONGEST_UNNOTICED_NS = 50_000_000
"""How long (wall ns) a new subscriber may go unnoticed in real time.

Asking for the subscription count costs as much as publishing.
"""


def set_topics(
    settings: Settings, options: Options, devices: Collection[str], actuated: bool
) -> tuple[Topic, ...]:
    """The topics that are published every period, in order.

    devices: of the vehicle's sensors. actuated: whether it has actuators.
    """
    clock = (CLOCK,) if settings.has_own_clock else ()
    topics = set_of(options, settings.publish_stamped, devices, actuated)
    return (*clock, *topics, *filter(is_installed, (TRANSFORMS,)))


def published_topics(
    settings: Settings, options: Options, devices: Collection[str], actuated: bool
) -> tuple[Topic, ...]:
    """Every topic that a simulator publishes; arguments as for `set_topics`."""
    beside = (ROLLOVER, ROBOT_DESCRIPTION, SIMULATION_DESCRIPTION, DIAGNOSTICS)
    topics = set_topics(settings, options, devices, actuated)
    return (*topics, *beside, *filter(is_installed, (ROAD,)))


class Publications:
    """The publishers of `node` for the messages of a session.

    own_clock: whether stamps are simulated time, published on /clock; otherwise they are the times
    on the node's clock at which the sets are due (Stamps). sets: number of sets published so far.
    """

    def __init__(
        self,
        node: Node,
        session: Session,
        settings: Settings,
        covariances: Covariances,
    ):
        self._node, clock = node, node.get_clock()
        self._settings, self._covariances = settings, covariances
        self.own_clock = settings.has_own_clock
        self._stamps = None if self.own_clock else Stamps(lambda: clock.now().nanoseconds)
        self._last_stamp_ns = 0
        self.sets = 0
        self._unnoticed_ns = 0 if settings.is_lockstep else LONGEST_UNNOTICED_NS
        self._publishers: dict[Topic, Publisher] = {}
        self.follow(session)
        self._tree = self._publishers.get(TRANSFORMS)
        self._rollover = self.publisher(ROLLOVER)
        simulation = session.simulation
        told = {
            ROBOT_DESCRIPTION: {"data": robot_description(simulation)},
            SIMULATION_DESCRIPTION: {"data": describe(simulation, session.period_ns)},
            ROAD: road_marker(simulation.road, settings.frame_prefix) if is_installed(ROAD) else {},
        }
        self._descriptions = [self._tell(topic, fields) for topic, fields in told.items() if fields]

    def follow(self, session: Session) -> None:
        """Publish the messages of this session from now on."""
        self._session, simulation = session, session.simulation
        prefix = self._settings.frame_prefix
        self._messages = messages_of(simulation, prefix, encode, self._covariances)
        parts = (simulation.sensors.devices, simulation.has_actuators)
        topics = set_topics(self._settings, simulation.options, *parts)
        for topic in topics:
            if topic not in self._publishers:
                self._publishers[topic] = self.publisher(topic)
        self._set = {
            topic.name: (self._publishers[topic], builder(self._messages, encode, topic))
            for topic in topics
        }
        self._prepare()

    def _tell(self, topic: Topic, fields: dict):
        """A latched publisher that has published a message; keep a reference to it."""
        publisher = self.publisher(topic)
        publisher.publish(encode(topic.type, fields))
        return publisher

    def _prepare(self) -> None:
        """Build every message once, so that nothing is compiled when time matters."""
        for _, build in self._set.values():
            build()
        self.look_for_listeners()

    def publisher(self, topic: Topic):
        """A publisher without event handlers, which would add to the cost of every wait."""
        return make_publisher(
            self._node,
            message_class(topic.type),
            topic.name,
            offered_qos(topic, self._settings.is_lockstep),
            event_callbacks=PublisherEventCallbacks(use_default_callbacks=False),
        )

    def look_for_listeners(self) -> None:
        """Find out which topics of the set have subscribers."""
        self._heard = [
            (publisher, build)
            for publisher, build in self._set.values()
            if publisher.get_subscription_count()
        ]
        self._looked_ns = time.monotonic_ns()

    def publish_set(self) -> None:
        """Publish the current set. Topics without subscribers are not serialized."""
        if time.monotonic_ns() - self._looked_ns >= self._unnoticed_ns:
            self.look_for_listeners()
            self._follow_clock()
        stamp_ns = self._session.simulation.time_ns
        if self._stamps:
            stamp_ns = self._stamps.of(stamp_ns)
        self._messages.set_time(stamp_ns)
        self._messages.applied = self._session.applied
        is_repeated = self.sets and stamp_ns == self._last_stamp_ns
        for publisher, build in self._heard:
            if is_repeated and publisher is self._tree:
                continue  # tf2 warns about a transform that is repeated
            publisher.publish(build())
        self._last_stamp_ns = stamp_ns
        self.sets += 1

    def publish_rollover(self) -> None:
        """Publish whether the vehicle has rolled over (latched)."""
        self._rollover.publish(encode(ROLLOVER.type, {"data": self._session.rolled_over}))

    def anchor(self, due_ns: int) -> None:
        """Realign stamps with the clock: the current set is due at `due_ns` on the steady clock.

        This has no effect on stamps in simulated time.
        """
        if self._stamps:
            self._stamps.anchor(self._session.simulation.time_ns, due_ns)

    def _follow_clock(self) -> None:
        """If the clock has jumped forward during a run, move the stamps forward with it."""
        if self._stamps and not self._session.stopped and (gained := self._stamps.follow()):
            gain = f"{gained / NANOSECONDS:.3f} s"
            self._node.get_logger().warning(f"the clock was set {gain} ahead: stamps follow it")

    def clock_trouble(self) -> str:
        """A warning if the stamps differ from the clock, else ''."""
        lead_ns = self._stamps.lead_ns() if self._stamps else 0
        if lead_ns <= 0:
            return ""
        lead = f"{lead_ns / NANOSECONDS:.3f} s"
        return f"the clock was set back: stamps keep increasing, {lead} ahead of it"

    def present_stamp(self):
        """The stamp for messages outside the sets: now, on the clock that subscribers use."""
        if self.own_clock:
            seconds, nanoseconds = self._messages.stamp
            return Time(sec=seconds, nanosec=nanoseconds)
        return self._node.get_clock().now().to_msg()

    def unreceived(self) -> list[str]:
        """Topics of the set on which a reliable subscriber has not yet acknowledged everything."""
        return [
            publisher.topic_name
            for publisher, _ in self._heard
            if not publisher.wait_for_all_acked(Duration())
        ]

    def listeners(self, name: str) -> int:
        """The number of subscriptions to a topic of the set."""
        return self._set[name][0].get_subscription_count()
