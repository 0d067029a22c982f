"""The node `manoeuvre`: resets a running simulator and drives it through a manoeuvre."""

import argparse
import dataclasses
import math
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter, parameter_value_to_python
from std_msgs.msg import Float64, Float64MultiArray
from std_srvs.srv import Trigger

from vehicle_roll_sim.analysis.sampled_events import events_of
from vehicle_roll_sim.arguments import (
    OneLineParser,
    add_declared,
    declared_values,
    named_file,
)
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.manoeuvres.manoeuvre import STANDARD, Manoeuvre, manoeuvre_named
from vehicle_roll_sim.model.events import MINIMUM_SPEED, Condition
from vehicle_roll_sim.ros.collector import Collector
from vehicle_roll_sim.ros.process import node_main
from vehicle_roll_sim.ros.simulated_vehicle import simulated_vehicle
from vehicle_roll_sim.ros.topics import COMMANDING
from vehicle_roll_sim.simulation.command import command_at
from vehicle_roll_sim.simulation.history import History
from vehicle_roll_sim.simulation.output_file import check_figure_format, check_writable
from vehicle_roll_sim.simulation.simulation import compile_model
from vehicle_roll_sim.simulation.summary import line, summary_lines

PATIENCE = 10.0
"""Wall seconds that a simulator may take to answer."""
ASK_AGAIN = 2.0
"""Wall seconds after which a question is repeated."""
NO_SIMULATOR = 1
"""Exit status when none does."""
DIVERGED = 1
"""Exit status when the model of the simulator did not stay plausible."""
ROUNDING = 1e-9
"""s"""
STANDING_STILL = 3
"""States without progress after which the simulator has stopped."""


class NoAnswerError(Exception):
    """No simulator answered as it should; the text says what was waited for."""


class Driver(Node):
    """Plays a manoeuvre: answers every state with the commands for the period that begins there."""

    def __init__(self, manoeuvre: Manoeuvre, simulator: str):
        super().__init__("manoeuvre")
        self.manoeuvre = manoeuvre
        self._steering = self.create_publisher(Float64, "steering_cmd", COMMANDING)
        self._torque = self.create_publisher(Float64MultiArray, "wheel_torque_cmd", COMMANDING)
        self._simulator = simulator
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(self)
        self.collector = Collector(self, self._on_state)
        self._forget()

    def _forget(self) -> None:
        self.collector.forget()
        self._time, self._still, self._states = -1.0, 0, 0
        self.state, self.sent = None, {}
        self.driver = self.manoeuvre.driver()
        self.finished = self.disturbed = False

    def prepare(self) -> None:
        """Set the speed, wait until every topic is connected, reset; raises NoAnswerError."""
        reset = self.create_client(Trigger, f"{self._simulator}/reset")
        self.rollover_angle, steady = self._get(["rollover_angle", "steady_state_slip"])
        self._slowest = MINIMUM_SPEED if steady else -math.inf
        if self.manoeuvre.needs_vehicle:
            compile_model()
            self.manoeuvre = self.manoeuvre.for_vehicle(*simulated_vehicle(self._get))
        self._set("initial_speed", self.manoeuvre.speed)
        self._wait(self._connected, "a connection to its topics")
        self._call(reset, Trigger.Request(), "a reset", before=self._forget)
        self._wait(lambda: self.state is not None, "its state")

    def _connected(self) -> bool:
        commands = all(p.get_subscription_count() for p in (self._steering, self._torque))
        return commands and all(s.get_publisher_count() for s in self.collector.subscriptions)

    def _get(self, names: Sequence[str]) -> list:
        client = self.create_client(GetParameters, f"{self._simulator}/get_parameters")
        request = GetParameters.Request(names=names)
        answer = self._call(client, request, f"its {names[0]}")
        return [parameter_value_to_python(value) for value in answer.values]

    def _set(self, name: str, value: float) -> None:
        client = self.create_client(SetParameters, f"{self._simulator}/set_parameters")
        parameter = Parameter(name, value=value).to_parameter_msg()
        request = SetParameters.Request(parameters=[parameter])
        result = self._call(client, request, f"its {name}").results[0]
        if not result.successful:
            raise NoAnswerError(f"`{self._simulator}` refused {name} {value:g}: {result.reason}")

    def _call(self, client, request, what: str, before: Callable[[], None] = lambda: None):
        """Ask a service until it answers, which must not mind being asked twice.

        A server that has not found its new client yet drops the answer. `before` each request.
        """
        self._wait(client.service_is_ready, f"its service for {what}")
        until = time.monotonic() + PATIENCE
        while True:
            before()
            future = client.call_async(request)
            try:
                self._wait(future.done, what, min(ASK_AGAIN, until - time.monotonic()))
            except NoAnswerError:
                client.remove_pending_request(future)
                if time.monotonic() >= until:
                    raise
            else:
                return future.result()

    def _wait(self, done: Callable[[], bool], what: str, patience: float = PATIENCE) -> None:
        until = time.monotonic() + patience
        while not done():
            if time.monotonic() > until:
                raise NoAnswerError(f"no answer from `{self._simulator}` in {PATIENCE:g} s: {what}")
            self._executor.spin_once(timeout_sec=0.05)

    def play(self) -> None:
        """Drive to the end, or until the simulator stops; raises NoAnswerError."""
        while not self.finished:
            seen = self._states
            self._wait(lambda: self._states > seen, "its next state (is it paused?)")  # noqa: B023
            if self.disturbed:
                raise NoAnswerError(f"`{self._simulator}` was reset by somebody else")
        self._wait(self.collector.is_complete, "the rest of its last set")

    def _on_state(self, state: dict) -> None:
        now = state["time"]
        self.disturbed = self.disturbed or now < self._time
        self.state = state
        self._states += 1
        self._still = self._still + 1 if now == self._time else 0
        self._time = now
        if now >= self.manoeuvre.duration - ROUNDING or self._still >= STANDING_STILL:
            self.finished = True
        else:
            self._command(now)

    def _command(self, when: float) -> None:
        command = command_at(self.driver, when, self.state)
        self.sent[when] = command.steering
        self._steering.publish(Float64(data=command.steering))
        if self.manoeuvre.speed_hold:
            self._torque.publish(Float64MultiArray(data=command.wheel_torque))

    @property
    def condition(self) -> Condition:
        """How the run ended, as far as the last state shows it."""
        if abs(self.state["roll"]) >= self.rollover_angle:
            return Condition.ROLLED_OVER
        if self._time >= self.manoeuvre.duration - ROUNDING:
            return Condition.RUNNING
        return Condition.TOO_SLOW if self.state["u"] < self._slowest else Condition.DIVERGED


def late_commands(history: History, sent_at: dict[float, float]) -> int:
    """Periods whose steering (rad) is not the one that was sent at their beginning (s)."""
    driven = zip(history["time"][:-1].tolist(), history["steering"][1:], strict=True)
    return sum(abs(found - sent_at.get(time, found)) > ROUNDING for time, found in driven)


def drive(name: str, manoeuvre: Manoeuvre, simulator: str, plot: Path | None) -> int:
    """Play the manoeuvre and print its summary; the exit status."""
    driver = Driver(manoeuvre, simulator)
    try:
        driver.prepare()
        driver.play()
    except NoAnswerError as error:
        print(f"manoeuvre: error: {error}", file=sys.stderr)
        return NO_SIMULATOR
    history = driver.collector.history()
    events = events_of(history, driver.rollover_angle)
    if plot:
        from vehicle_roll_sim.analysis import plots  # half a second, for those who want a figure

        plots.plot_run(history, events, plot, name)
    condition = driver.condition
    late = late_commands(history, driver.sent)
    report = driver.manoeuvre.report(history, driver.driver)
    lines = summary_lines(events, history["time"][-1], condition, "its state")
    print("\n".join([*(line(label, text) for label, text in report.items()), *lines]))
    if late:
        print(line("late commands", f"{late} periods were driven with an older command"))
    if plot:
        print(line("plot", plot))
    return DIVERGED if condition is Condition.DIVERGED else 0


def _parser() -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog="manoeuvre",
        description="Drive a running simulator through a manoeuvre and print what happened.",
    )
    parser.add_argument("manoeuvre", metavar="NAME", help=", ".join(STANDARD))
    for declaring in map(type, STANDARD.values()):
        add_declared(parser, declaring, "manoeuvre")
    parser.add_argument(
        "--simulator", default="simulator", metavar="NODE", help="name of the simulator's node"
    )
    parser.add_argument("--plot", metavar="FILE", help="draw the run (PNG, SVG or PDF)")
    return parser


def main() -> int:
    """Entry point of the executable."""

    def body(arguments: argparse.Namespace) -> int:
        manoeuvre = manoeuvre_named(arguments.manoeuvre)
        manoeuvre = dataclasses.replace(manoeuvre, **declared_values(arguments, manoeuvre))
        if not arguments.simulator:
            raise InputError("--simulator", "", "the name of a node")
        plot = named_file(arguments.plot, "--plot")
        if plot:
            check_writable(plot, "--plot")
            check_figure_format(plot, "--plot")
        return drive(arguments.manoeuvre, manoeuvre, arguments.simulator, plot)

    return node_main(_parser(), body, sys.argv)


if __name__ == "__main__":
    sys.exit(main())
