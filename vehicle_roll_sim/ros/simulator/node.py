"""The node `simulator`: takes commands, steps the model and publishes the results."""

import functools
import sys
import threading
from collections.abc import Collection, Sequence

from rclpy.clock import Clock as RosClock
from rclpy.clock import ClockType
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.live.channels import DROPPED
from vehicle_roll_sim.live.log_limiter import LogLimiter
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.live.standard_simulator import StandardSimulator
from vehicle_roll_sim.live.status import ending
from vehicle_roll_sim.live.ways_in import PARTS
from vehicle_roll_sim.messages.topic import Topic
from vehicle_roll_sim.model.compiled import jit
from vehicle_roll_sim.ros.node_main import lifetime, node_main
from vehicle_roll_sim.ros.qos_overrides import make_subscription, refuse_wrong_overrides
from vehicle_roll_sim.ros.simulator import parameters, standard_services
from vehicle_roll_sim.ros.simulator.compile_status import compile_and_tell
from vehicle_roll_sim.ros.simulator.control import Control
from vehicle_roll_sim.ros.simulator.diagnostics import Reporter
from vehicle_roll_sim.ros.simulator.lockstep import Lockstep, UnansweredError
from vehicle_roll_sim.ros.simulator.publications import Publications, published_topics
from vehicle_roll_sim.ros.simulator.real_time import RealTime
from vehicle_roll_sim.ros.simulator.session import session_of
from vehicle_roll_sim.ros.simulator.settings import Settings
from vehicle_roll_sim.ros.simulator.standard_services import StandardServices
from vehicle_roll_sim.ros.topics import EVERY_ANSWER, NEWEST_ONLY, heard_commands, message_class
from vehicle_roll_sim.vehicle.actuator_parameters import has_actuators
from vehicle_roll_sim.vehicle.sensor_parameters import devices_of

NAME = "simulator"
DIAGNOSTICS_PERIOD = 1.0
"""s"""
WARNING_INTERVAL = 1.0
"""Shortest time (s) between two warnings of the same kind about the same topic."""
NO_ANSWER = 1
"""Exit status if a controller did not answer in lockstep and the timeout policy is `stop`."""


class Simulator(Node):
    """A simulated vehicle as a node. Raises InputError if a parameter is wrong.

    driven: command topics that are not subscribed to, since the owner of the node writes them to
    the inbox; he also replaces the session, so that the standard services are not offered.
    `declared`: its parameters. `driver` decides when a period runs. `lock` guards the session: the
    thread that steps the model holds it during a period, the thread that runs callbacks between
    periods. `has_begun`: whether the first set has been published.
    """

    def __init__(self, driven: Collection[str] = (), **node_options):
        super().__init__(NAME, **node_options)
        declared = self.declared = parameters.declare(self)
        self.settings = declared.settings
        refuse_wrong_overrides(
            self,
            publishers=[each.name for each in _published(declared)],
            subscriptions=[each.name for each in heard_commands()],
            lossless=self.settings.is_lockstep,
        )
        self.lock = threading.Lock()
        self.session = session_of(declared, declared.vehicle, self.settings.initial_speed)
        logger = self.get_logger()
        (logger.info if jit.COMPILED else logger.warning)(jit.describe())
        self.driver = _driver(self.settings, self.session.period_ns)
        self._publications = Publications(self, self.session, self.settings, declared.covariances)
        self.has_begun = False
        self._warnings = LogLimiter(WARNING_INTERVAL)
        parameters.follow_changes(self, declared, self.lock)
        self._commands = {
            topic.name: self._subscribe(topic)
            for topic in heard_commands()
            if topic.name not in driven
        }
        self._control = Control(self, lambda: parameters.show_changes(self, declared))
        self._control.serve()
        if standard_services.is_installed() and not driven:
            self._serve_standard()
        report = Reporter(self, self.driver, self._publications, self.lock).report
        steady = RosClock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(DIAGNOSTICS_PERIOD, report, clock=steady)

    def _serve_standard(self) -> None:
        """Offer the services of the standard for simulators."""
        fulfilled = StandardSimulator(self.session, self._control, self.lock)
        stamp, frame = self._publications.present_stamp, f"{self.settings.frame_prefix}odom"
        self._standard = StandardServices(self, fulfilled, stamp, frame)
        self._standard.serve()

    def begin(self, session: Session | None = None) -> None:
        """Publish the first set and discard any command received before it.

        It is that of time 0, unless a snapshot has been restored. session: the one to go on with,
        by default the present one. The parameters of the node remain those that it was started
        with.
        """
        with self.lock:
            if session is not None:
                self.session = session
                self._publications.follow(session)
            self.has_begun = True
            self._control.begin()
            self.show()

    def restart(self) -> None:
        """Restart pacing and stamps from the current time."""
        self._publications.anchor(self.driver.restart())

    def show(self) -> None:
        """Restart pacing and stamps, and publish the set once the simulator has begun."""
        self.restart()
        if self.has_begun:
            self._publications.look_for_listeners()
            self._publications.publish_set()
            self._publications.publish_rollover()

    def unreceived(self) -> list[str]:
        """Topics of the set on which a reliable subscriber has not yet acknowledged everything."""
        with self.lock:
            return self._publications.unreceived()

    def missing_partners(self, commands: Sequence[str], listened: Sequence[str]) -> list[str]:
        """The command publishers and set subscribers that have not been discovered yet."""
        publishers = {name: self._commands[name].get_publisher_count() for name in commands}
        listeners = {name: self._publications.listeners(name) for name in listened}
        return [
            *(f"a publisher on {name}" for name, count in publishers.items() if not count),
            *(f"a subscriber on {name}" for name, count in listeners.items() if not count),
        ]

    def _subscribe(self, topic: Topic):
        receive = self._receive_parts if topic.name in PARTS else self._receive

        return make_subscription(
            self,
            message_class(topic.type),
            topic.name,
            functools.partial(receive, topic.name),
            EVERY_ANSWER if self.settings.is_lockstep else NEWEST_ONLY,
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )

    def _receive(self, topic: str, message) -> None:
        data = message.data
        values = [data] if isinstance(data, float) else data
        with self.lock:
            now_ns = self.session.simulation.time_ns
            problem = self.session.inbox.receive(topic, values, now_ns)
        self._warn(topic, problem)

    def _receive_parts(self, topic: str, message) -> None:
        inbox, simulation = self.session.inbox, self.session.simulation
        try:
            parts = PARTS[topic](message, simulation.vehicle.wheelbase)
        except InputError as error:
            with self.lock:
                problem = inbox.drop(topic, str(error))
        else:
            with self.lock:
                problem = inbox.receive_parts(topic, parts, simulation.time_ns)
        self._warn(topic, problem)

    def _warn(self, topic: str, problem: str) -> None:
        if problem and self._warnings.allows((topic, problem.startswith(DROPPED))):
            self.get_logger().warning(f"{topic}: {problem}")

    def run_period(self, due_ns: int | None = None) -> None:
        """Advance by one publish period and publish the set. Call with the lock held.

        due_ns: when the set is due on the steady clock, if not one period after the previous one.
        """
        inbox, was_stopped = self.session.inbox, self.session.stopped
        inbox.timeout = 0.0 if self.settings.is_lockstep else self.settings.command_timeout
        inbox.steering_policy = self.settings.steering_timeout_policy
        self.session.run_period()
        if due_ns is not None and not was_stopped:
            self._publications.anchor(due_ns)
        self._publications.publish_set()
        if self.session.stopped and not was_stopped:
            self._publications.publish_rollover()
            self.get_logger().error(ending(self.session))


def _published(declared: parameters.Declared) -> tuple[Topic, ...]:
    vehicle = declared.vehicle
    parts = (devices_of(vehicle), has_actuators(vehicle))
    return published_topics(declared.settings, declared.options, *parts)


def _driver(settings: Settings, period_ns: int) -> Lockstep | RealTime:
    """The object that decides when a period of `period_ns` runs."""
    if settings.is_lockstep:
        return Lockstep(
            settings.lockstep_topics,
            settings.lockstep_wait,
            settings.lockstep_timeout,
            settings.lockstep_timeout_policy,
        )
    return RealTime(period_ns, settings.real_time_factor, settings.catch_up_limit)


def main() -> int:
    """Entry point of the executable."""
    parser = OneLineParser(
        prog="simulator",
        description="Simulate a vehicle's roll dynamics on ROS 2, in real time or in lockstep.",
        usage="simulator [--ros-args -p NAME:=VALUE -r __ns:=/NAMESPACE ...]",
        epilog="parameters (`ros2 param describe /simulator NAME` explains one): "
        + ", ".join(parameters.PARAMETERS),
    )

    def body(_) -> int:
        try:
            compile_and_tell(NAME)
            simulator = Simulator()
            with lifetime(simulator) as executor:
                simulator.driver.run(simulator, executor)
        except UnansweredError as error:
            print(f"simulator: error: {error}", file=sys.stderr)
            return NO_ANSWER
        return 0

    return node_main(parser, body, sys.argv)


if __name__ == "__main__":
    sys.exit(main())
