"""The node `simulator`: takes commands, steps the model and publishes the results."""

import sys
import threading
import time
from collections.abc import Collection, Sequence

from rclpy.clock import Clock as RosClock
from rclpy.clock import ClockType
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from std_srvs.srv import SetBool, Trigger

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.live.command_inbox import DROPPED
from vehicle_roll_sim.live.log_limiter import LogLimiter
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.live.status import ending
from vehicle_roll_sim.messages.topics import COMMANDS, Topic
from vehicle_roll_sim.model.compiled import jit
from vehicle_roll_sim.ros.node_main import lifetime, node_main
from vehicle_roll_sim.ros.qos_overrides import make_subscription, refuse_wrong_overrides
from vehicle_roll_sim.ros.services import PAUSE, RESET, STEP
from vehicle_roll_sim.ros.simulator import parameters
from vehicle_roll_sim.ros.simulator.compile_status import compile_and_tell
from vehicle_roll_sim.ros.simulator.diagnostics import Reporter
from vehicle_roll_sim.ros.simulator.lockstep import Lockstep, UnansweredError
from vehicle_roll_sim.ros.simulator.publications import Publications, published_topics
from vehicle_roll_sim.ros.simulator.real_time import RealTime
from vehicle_roll_sim.ros.simulator.session import session_of
from vehicle_roll_sim.ros.simulator.settings import Settings
from vehicle_roll_sim.ros.topics import EVERY_ANSWER, NEWEST_ONLY, message_class
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
    the inbox. `declared`: its parameters. `driver` decides when a period runs. `lock` guards the
    session: the thread that steps the model holds it during a period, the thread that runs
    callbacks between periods.
    """

    def __init__(self, driven: Collection[str] = (), **node_options):
        super().__init__(NAME, **node_options)
        declared = self.declared = parameters.declare(self)
        self.settings = declared.settings
        refuse_wrong_overrides(
            self,
            publishers=[each.name for each in _published(declared)],
            subscriptions=[each.name for each in COMMANDS],
            lossless=self.settings.is_lockstep,
        )
        self.lock = threading.Lock()
        self.session = session_of(declared, declared.vehicle, self.settings.initial_speed)
        logger = self.get_logger()
        (logger.info if jit.COMPILED else logger.warning)(jit.describe())
        self.driver = _driver(self.settings, self.session.period_ns)
        self._publications = Publications(self, self.session, self.settings, declared.covariances)
        self._has_begun = False
        self._warnings = LogLimiter(WARNING_INTERVAL)
        parameters.follow_changes(self, declared, self.lock)
        self._commands = {
            topic.name: self._subscribe(topic) for topic in COMMANDS if topic.name not in driven
        }
        self._serve()
        report = Reporter(self, self.driver, self._publications, self.lock).report
        steady = RosClock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(DIAGNOSTICS_PERIOD, report, clock=steady)

    def begin(self, session: Session | None = None) -> None:
        """Publish the first set, at time 0, and discard any command received before it.

        session: the one to go on with, by default the present one. The parameters of the node
        remain those that it was started with.
        """
        with self.lock:
            if session is not None:
                self.session = session
                self._publications.follow(session)
            self._has_begun = True
            self.session.inbox.clear()
            self._restart()
            self._publish_all()

    def _restart(self) -> None:
        """Restart pacing and stamps from the current time."""
        self._publications.anchor(self.driver.restart())

    def _publish_all(self) -> None:
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
        def receive(message):
            self._receive(topic.name, message.data)

        return make_subscription(
            self,
            message_class(topic.type),
            topic.name,
            receive,
            EVERY_ANSWER if self.settings.is_lockstep else NEWEST_ONLY,
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )

    def _receive(self, topic: str, data) -> None:
        values = [data] if isinstance(data, float) else data
        with self.lock:
            now_ns = self.session.simulation.time_ns
            problem = self.session.inbox.receive(topic, values, now_ns)
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

    def _serve(self) -> None:
        answers = {RESET: self._reset, PAUSE: self._pause, STEP: self._step}
        for service, answer in answers.items():
            self.create_service(service.kind, f"~/{service.name}", answer)

    def _reset(self, _, response: Trigger.Response) -> Trigger.Response:
        with self.lock:
            try:
                self.session.reset(self.settings.initial_speed)
            except InputError as error:  # the step is too large for that speed
                response.success, response.message = False, str(error)
                return response
            self._restart()
            if self._has_begun:
                self._publish_all()
        response.success = True
        response.message = f"static equilibrium at {self.settings.initial_speed:g} m/s"
        return response

    def _pause(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        with self.lock:
            self.session.paused = request.data
            self._restart()
        response.success = True
        response.message = "paused" if request.data else "running"
        return response

    def _step(self, _, response: Trigger.Response) -> Trigger.Response:
        with self.lock:
            can_step = self.session.paused and not self.session.stopped
            response.success = can_step and self._has_begun
            if response.success:
                self.run_period(time.monotonic_ns())
                response.message = f"{self.session.simulation.time:.9g} s"
            elif not self._has_begun:
                response.message = "not started yet: waiting for the lockstep partners"
            elif self.session.stopped:
                response.message = "the model has stopped: reset first"
            else:
                response.message = "running: pause first"
        return response


def _published(declared: parameters.Declared) -> tuple[Topic, ...]:
    return published_topics(declared.settings, declared.options, devices_of(declared.vehicle))


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
