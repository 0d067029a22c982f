"""The other nodes around a manoeuvre: who publishes what it hears, who hears or sends commands."""

import time
from collections.abc import Iterable, Mapping

from rclpy.node import Node
from rclpy.publisher import Publisher

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.messages.run_messages import STATE
from vehicle_roll_sim.ros.clients.collector import Collector
from vehicle_roll_sim.ros.clients.simulator_client import NoAnswerError, SimulatorClient
from vehicle_roll_sim.ros.compatibility import (
    NAMELESS,
    UNNAMED,
    fitting_listeners,
    publishers_of,
)
from vehicle_roll_sim.ros.simulator.lockstep import SETTLING

TORQUE = "wheel_torque_cmd"
WITHOUT_TORQUE = ", or drive with --speed-hold 0"
"""The other way out if the manoeuvre may not command TORQUE."""
DISCOVERY = 3.5
"""Wall time (s) by which all nodes should have been discovered: usually at once, otherwise with
their next announcement, which the middleware sends every 3 s."""
LEASE = 21.0
"""Wall time (s) for which a killed node may still appear alive: the middleware's lease is 20 s."""


class OtherNodes:
    """What `node` knows of the nodes around it and `simulator`.

    collector: with the subscriptions of the node. commands: its publishers by topic, as they are
    when a method is called.
    """

    def __init__(
        self,
        node: Node,
        collector: Collector,
        simulator: SimulatorClient,
        commands: Mapping[str, Publisher],
    ):
        self._node, self._collector = node, collector
        self._simulator, self._commands = simulator, commands

    def are_heard(self) -> bool:
        """Whether every subscription has a publisher."""
        return all(each.get_publisher_count() for each in self._collector.subscriptions)

    def hear(self) -> bool:
        """Whether every command has a matched subscription, and all known ones are matched."""
        return all(
            publisher.get_subscription_count() >= max(1, fitting_listeners(self._node, publisher))
            for publisher in self._commands.values()
        )

    def command(self, topic: str) -> bool:
        """Whether another node publishes a topic that the node does not; waits for discovery."""
        until = time.monotonic() + DISCOVERY
        while not (is_theirs := self._node.count_publishers(topic)) and time.monotonic() < until:
            self._simulator.linger(SETTLING)
        return bool(is_theirs)

    def refuse_commands(self, topics: Iterable[str]) -> None:
        """Raise InputError if another node is known to command one of `topics`."""
        node = self._node
        for name in topics:
            if node.count_publishers(name) <= (name in self._commands):
                continue
            self._simulator.linger(SETTLING)  # its name may be discovered a little later
            found = node.get_publishers_info_by_topic(node.resolve_topic_name(name))
            others = sorted({each.node_name for each in found} - {node.get_name(), UNNAMED})
            allowed = "in lockstep only the manoeuvre may command it; stop the other node"
            if name == TORQUE:
                allowed += WITHOUT_TORQUE
            problem = f"already commanded by {', '.join(others) or 'another node'}"
            raise InputError(name, "", allowed, problem)

    def find_one_simulator(self) -> None:
        """Wait until each topic has a single publisher; raises NoAnswerError after a timeout.

        A killed node appears alive until its lease ends, but no longer sends anything.
        """
        until, is_said, collector = time.monotonic() + LEASE, False, self._collector
        while crowded := [e for e in collector.subscriptions if e.get_publisher_count() > 1]:
            topic = crowded[0].topic_name
            if collector.is_mixed or time.monotonic() > until:
                raise self._not_alone(topic)
            self._simulator.linger(SETTLING)
            if not (is_said or collector.is_mixed):
                is_said = True
                why = f"waiting up to {LEASE:g} s, in case one of them was killed"
                self._node.get_logger().info(f"several nodes publish {topic}: {why}")

    def check_one_simulator(self) -> None:
        """Raise NoAnswerError if a second simulator has appeared."""
        if self._collector.is_mixed or self._collector.simulators() > 1:
            raise self._not_alone(self._node.resolve_topic_name(STATE))

    def _not_alone(self, topic: str) -> NoAnswerError:
        until = time.monotonic() + DISCOVERY
        while NAMELESS in (names := publishers_of(self._node, topic)) and time.monotonic() < until:
            self._simulator.linger(SETTLING)
        if len(names) < 2:
            name = self._simulator.name
            return NoAnswerError(f"`{name}` has been replaced: another node publishes {topic} now")
        return NoAnswerError(
            f"{len(names)} nodes publish {topic}: {', '.join(names)}; allowed: one simulator per "
            "namespace (stop the others, or start each with --ros-args -r __ns:=/NAME)"
        )
