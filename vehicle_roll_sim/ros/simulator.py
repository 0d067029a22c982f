"""The node `simulator`: steps the model in real time, takes commands, publishes what happens."""

import sys

import rclpy
from rclpy.clock import Clock as RosClock
from rclpy.clock import ClockType
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Bool, String
from std_srvs.srv import SetBool, Trigger

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model import jit
from vehicle_roll_sim.model.advance import NANOSECONDS
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.ros import parameters
from vehicle_roll_sim.ros.diagnostics import diagnostics
from vehicle_roll_sim.ros.messages import Messages
from vehicle_roll_sim.ros.process import node_main
from vehicle_roll_sim.ros.topics import (
    CLOCK,
    COMMANDS,
    DIAGNOSTICS,
    NEWEST_ONLY,
    ROBOT_DESCRIPTION,
    ROLLOVER,
    STATE_SET,
    TRANSFORMS,
    Topic,
)
from vehicle_roll_sim.ros.urdf import robot_description
from vehicle_roll_sim.simulation.command_inbox import CommandInbox
from vehicle_roll_sim.simulation.pacing import Pacer
from vehicle_roll_sim.simulation.session import Session
from vehicle_roll_sim.simulation.simulation import Simulation, compile_model, whole_steps
from vehicle_roll_sim.simulation.speed_controller import SpeedController

DIAGNOSTICS_PERIOD = 1.0
"""s"""
WARNING_INTERVAL = 1.0
"""s between two warnings of the same kind."""


class Simulator(Node):
    """A vehicle on ROS 2. Raises InputError if a parameter is wrong."""

    def __init__(self, **node_options):
        super().__init__("simulator", **node_options)
        declared = parameters.declare(self)
        self.settings = declared.settings
        self.session = _session(declared)
        self.get_logger().info(jit.describe())
        self._steady_clock = RosClock(clock_type=ClockType.STEADY_TIME)
        self.pacer = Pacer(self.session.period_ns, lambda: self._steady_clock.now().nanoseconds)
        self._stamps_begin_ns = self._first_stamp()
        self._messages = Messages(self.session, self.settings.frame_prefix)
        parameters.follow_changes(self, self.settings, declared.options)
        self._advertise(declared)
        self._subscribe()
        self._serve()
        self._publish_set()
        self._publish_rollover()
        self._catch_up = self.create_guard_condition(self._tick)
        period = self.session.period_ns / NANOSECONDS
        self.create_timer(period, self._tick, clock=self._steady_clock)
        self.create_timer(DIAGNOSTICS_PERIOD, self._report, clock=self._steady_clock)

    def _advertise(self, declared: parameters.Declared) -> None:
        self._set_publishers = [(self._publisher(t), self._builder(t)) for t in STATE_SET]
        self._transform_publishers = [(self._publisher(t), t.type) for t in TRANSFORMS]
        self._rollover_publisher = self._publisher(ROLLOVER)
        self._diagnostics_publisher = self._publisher(DIAGNOSTICS)
        self._clock_publisher = self._publisher(CLOCK) if self.settings.publish_clock else None
        self._description_publisher = self._publisher(ROBOT_DESCRIPTION)
        description = robot_description(declared.vehicle, not declared.options.has_eight_dof)
        self._description_publisher.publish(String(data=description))
        self._sets_since_report = self._overruns_reported = 0
        self._reported_ns = self._steady_clock.now().nanoseconds

    def _publisher(self, topic: Topic):
        return self.create_publisher(topic.type, topic.name, topic.publisher_qos)

    def _builder(self, topic: Topic):
        """The method that fills the message of a topic."""
        family, _, wheel = topic.name.partition("/")
        if family == "tire_forces":
            index = WHEELS.index(wheel)
            return lambda: self._messages.tire_force(index)
        return getattr(self._messages, topic.name)

    def _subscribe(self) -> None:
        for topic in COMMANDS:

            def receive(message, name=topic.name):
                self._receive(name, message.data)

            self.create_subscription(topic.type, topic.name, receive, NEWEST_ONLY)

    def _serve(self) -> None:
        self.create_service(Trigger, "~/reset", self._reset)
        self.create_service(SetBool, "~/pause", self._pause)
        self.create_service(Trigger, "~/step", self._step)

    def _receive(self, topic: str, data) -> None:
        values = [data] if isinstance(data, float) else data
        problem = self.session.inbox.receive(topic, values, self.session.simulation.time_ns)
        if problem:
            self.get_logger().warning(
                f"{topic}: message dropped: {problem}", throttle_duration_sec=WARNING_INTERVAL
            )

    def _tick(self) -> None:
        """Run a period that is due; if more are, come back after the messages that wait."""
        if self.pacer.due() and not self.session.paused:
            self._run_period()
        if self.pacer.behind:
            self._catch_up.trigger()

    def _run_period(self) -> None:
        inbox, was_stopped = self.session.inbox, self.session.stopped
        inbox.timeout = self.settings.command_timeout
        inbox.steering_policy = self.settings.steering_timeout_policy
        self.session.run_period()
        self._publish_set()
        if self.session.stopped and not was_stopped:
            self._publish_rollover()
            name = self.session.simulation.condition.name.lower().replace("_", " ")
            self.get_logger().error(f"{name} at {self.session.simulation.time:.3f} s")

    def _publish_set(self) -> None:
        stamp_ns = self._stamps_begin_ns + self.session.simulation.time_ns
        self._messages.set_time(stamp_ns)
        if self._clock_publisher:
            self._clock_publisher.publish(Clock(clock=self._messages.stamp))
        for publisher, build in self._set_publishers:
            if publisher.get_subscription_count():
                publisher.publish(build())
        if not self.session.stopped:  # tf2 complains of a transform that comes twice
            for publisher, kind in self._transform_publishers:
                publisher.publish(kind(transforms=self._messages.transforms()))
        self._last_stamp_ns = stamp_ns
        self._sets_since_report += 1

    def _publish_rollover(self) -> None:
        self._rollover_publisher.publish(Bool(data=self.session.rolled_over))

    def _report(self) -> None:
        now = self._steady_clock.now().nanoseconds
        rate = self._sets_since_report * NANOSECONDS / (now - self._reported_ns)
        name = f"{self.get_fully_qualified_name()}: model"
        overruns = self.pacer.overruns - self._overruns_reported
        message = diagnostics(name, self.session, self.pacer, rate, overruns)
        message.header.stamp = self._present_stamp()
        self._diagnostics_publisher.publish(message)
        self._sets_since_report, self._reported_ns = 0, now
        self._overruns_reported = self.pacer.overruns
        self.pacer.largest_late_ns = 0

    def _first_stamp(self) -> int:
        """Where stamps begin (ns): 0 with our own /clock, else the time of the start."""
        return 0 if self.settings.publish_clock else self.get_clock().now().nanoseconds

    def _present_stamp(self):
        """For messages of no set: the time on the clock that subscribers go by."""
        if self.settings.publish_clock:
            return self._messages.stamp
        return self.get_clock().now().to_msg()

    def _reset(self, _, response: Trigger.Response) -> Trigger.Response:
        self.session.reset(self.settings.initial_speed)
        if not self.settings.publish_clock:
            self._stamps_begin_ns = self._last_stamp_ns + self.session.period_ns
        self._publish_set()
        self._publish_rollover()
        self.pacer.restart()
        response.success = True
        response.message = f"static equilibrium at {self.settings.initial_speed:g} m/s"
        return response

    def _pause(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        self.session.paused = request.data
        self.pacer.restart()
        response.success = True
        response.message = "paused" if request.data else "running"
        return response

    def _step(self, _, response: Trigger.Response) -> Trigger.Response:
        response.success = self.session.paused and not self.session.stopped
        if response.success:
            self._run_period()
            response.message = f"{self.session.simulation.time:.9g} s"
        elif self.session.stopped:
            response.message = "the model has stopped: reset first"
        else:
            response.message = "running: pause first"
        return response


def _session(declared: parameters.Declared) -> Session:
    """The simulation that the parameters describe."""
    settings = declared.settings
    simulation = Simulation(
        declared.vehicle,
        declared.options,
        step=settings.step,
        rollover_angle=settings.rollover_angle,
        road=declared.road,
    )
    try:
        steps = whole_steps(1.0 / settings.publish_rate, simulation.step_ns, "publish_rate")
    except InputError:
        limit = f"a rate whose period is a multiple of the step, {settings.step:g} s"
        raise InputError("publish_rate", settings.publish_rate, limit) from None
    inbox = CommandInbox(settings.command_timeout, settings.steering_timeout_policy)
    controller = SpeedController(
        declared.vehicle, settings.speed_drive_limit, settings.speed_brake_limit
    )
    period_ns = steps * simulation.step_ns
    return Session(simulation, inbox, period_ns, settings.initial_speed, controller)


def main() -> int:
    """Entry point of the executable."""
    parser = OneLineParser(
        prog="simulator",
        description="Simulate a vehicle's roll in real time on ROS 2.",
        usage="simulator [--ros-args -p NAME:=VALUE -r __ns:=/NAMESPACE ...]",
        epilog="parameters: " + ", ".join(parameters.PARAMETERS),
    )

    def body(_) -> int:
        rclpy.spin(Simulator())
        return 0

    return node_main(parser, body, sys.argv, prepare=compile_model)


if __name__ == "__main__":
    sys.exit(main())
