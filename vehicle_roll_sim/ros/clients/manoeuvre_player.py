"""The node that drives a running simulator through a manoeuvre, in real time or in lockstep."""

import dataclasses
import math
import time
from collections.abc import Iterable

from rclpy.node import Node
from rclpy.publisher import Publisher
from std_msgs.msg import Float64, Float64MultiArray

from vehicle_roll_sim.declaration import InputError, parameters_of
from vehicle_roll_sim.live.channels import channels
from vehicle_roll_sim.manoeuvres.catalogue import Manoeuvre
from vehicle_roll_sim.messages.run_messages import COLLECTED, STATE
from vehicle_roll_sim.model.integration.events import MINIMUM_SPEED, Condition
from vehicle_roll_sim.ros import signals
from vehicle_roll_sim.ros.clients.collector import Collector
from vehicle_roll_sim.ros.clients.simulated_vehicle import simulated_vehicle
from vehicle_roll_sim.ros.clients.simulator_client import NoAnswerError, SimulatorClient
from vehicle_roll_sim.ros.compatibility import (
    NAMELESS,
    UNNAMED,
    fitting_listeners,
    publishers_of,
)
from vehicle_roll_sim.ros.node_main import refuse_unknown_parameters
from vehicle_roll_sim.ros.qos_overrides import make_publisher, refuse_wrong_overrides
from vehicle_roll_sim.ros.simulator.lockstep import SETTLING
from vehicle_roll_sim.ros.simulator.settings import LOCKSTEP
from vehicle_roll_sim.ros.topics import COMMANDING
from vehicle_roll_sim.simulation.command import command_at
from vehicle_roll_sim.simulation.compilation import compile_model
from vehicle_roll_sim.simulation.road import Road

STEERING, TORQUE = "steering_cmd", "wheel_torque_cmd"
COMMANDED = (STEERING, TORQUE, "brake_torque_cmd", "wind_cmd")
"""The topics that manoeuvres command."""
FIELDS = {name: channel.field for name, channel in channels().items()}
ROUNDING = 1e-9
"""s"""
DISCOVERY = 3.5
"""Wall time (s) by which all nodes should have been discovered: usually at once, otherwise with
their next announcement, which the middleware sends every 3 s."""
LEASE = 21.0
"""Wall time (s) for which a killed node may still appear alive: the middleware's lease is 20 s."""
STANDING_STILL = 3
"""Repeated states after which the simulator is considered stopped."""


class ManoeuvrePlayer(Node):
    """Plays a manoeuvre: answers every state with the commands for the period that starts there.

    It commands nothing before it has reset the simulator. In lockstep, the simulator may be waiting
    for its publishers; they are created after the reset, so that the set of time 0 comes only once.
    """

    def __init__(self, manoeuvre: Manoeuvre):
        super().__init__("manoeuvre")
        refuse_unknown_parameters(self)
        self._refuse_wrong_overrides()
        self.manoeuvre = manoeuvre
        self._commands: dict[str, Publisher] = {}
        self.collector = Collector(self, self._on_state)
        self._forget()

    def _forget(self) -> None:
        self.collector.forget()
        self._time, self._still, self._states = -1.0, 0, 0
        self.state, self.sent = None, {}
        self.driver = self.manoeuvre.driver()
        self.finished = self.disturbed = self._driving = False

    def _refuse_wrong_overrides(self, lossless: bool = False) -> None:
        heard = [topic.name for topic in COLLECTED]
        refuse_wrong_overrides(self, publishers=COMMANDED, subscriptions=heard, lossless=lossless)

    def prepare(self, simulator: SimulatorClient) -> None:
        """Set the speed, connect and reset.

        Raises NoAnswerError, or InputError if the manoeuvre cannot be driven on this simulator.
        """
        self._simulator = simulator
        names = ["rollover_angle", "body_contact", "steady_state_slip", "mode", "lockstep_topics"]
        values = simulator.get(names)
        if not values:
            problem = f"it has no parameter {names[0]}"
            raise NoAnswerError(f"`{simulator.name}` is not a simulator: {problem}")
        self.rollover_angle, self._goes_on, steady, mode, awaited = values
        self.road = _road(*simulator.get(["road_file", *parameters_of(Road)]))
        self._slowest = MINIMUM_SPEED if steady else -math.inf
        self._awaited = awaited if mode == LOCKSTEP else []
        if mode == LOCKSTEP:
            self._check_awaited()
            self._refuse_wrong_overrides(lossless=True)
        if self.manoeuvre.needs_vehicle:
            vehicle, options = simulated_vehicle(simulator.get)
            with signals.interruptible():
                compile_model()
                self.manoeuvre = self.manoeuvre.for_vehicle(vehicle, options)
        simulator.set("initial_speed", self.manoeuvre.speed)
        simulator.wait(self._hears, "a connection to its topics")
        self._find_alone()
        if mode == LOCKSTEP:
            commanded = self._answered()
            self._refuse_others(commanded)
            simulator.reset(before=self._forget)
            self._connect(commanded)
        else:
            self._connect(self._needed)
            simulator.reset(before=self._forget)

    @property
    def _needed(self) -> list[str]:
        """The topics that the manoeuvre commands."""
        return [name for name in COMMANDED if FIELDS[name] in self.manoeuvre.commanded]

    def _check_awaited(self) -> None:
        """Raise InputError unless lockstep waits for every topic that the manoeuvre commands."""
        missing = [name for name in self._needed if name not in self._awaited]
        if not missing:
            return
        wanted = [*self._awaited, *missing]
        allowed = f"start the simulator with -p lockstep_topics:=[{', '.join(wanted)}]"
        if missing == [TORQUE]:
            allowed += ", or drive with --speed-hold 0"
        problem = f"{' and '.join(missing)} missing, which the manoeuvre commands"
        raise InputError("lockstep_topics", "", allowed, problem)

    def _answered(self) -> list[str]:
        """The topics to command in lockstep, torques (of 0) included if nobody else sends them."""
        if TORQUE in self._needed or TORQUE not in self._awaited:
            return self._needed
        until = time.monotonic() + DISCOVERY
        while not (is_theirs := self.count_publishers(TORQUE)) and time.monotonic() < until:
            self._simulator.linger(SETTLING)
        return self._needed if is_theirs else [*self._needed, TORQUE]

    def _refuse_others(self, topics: Iterable[str]) -> None:
        """Raise InputError if another node is known to command one of `topics`."""
        for name in topics:
            if self.count_publishers(name) <= (name in self._commands):
                continue
            self._simulator.linger(SETTLING)  # its name may be discovered a little later
            found = self.get_publishers_info_by_topic(self.resolve_topic_name(name))
            others = sorted({each.node_name for each in found} - {self.get_name(), UNNAMED})
            allowed = "in lockstep only the manoeuvre may command it; stop the other node"
            if name == TORQUE:
                allowed += ", or drive with --speed-hold 0"
            problem = f"already commanded by {', '.join(others) or 'another node'}"
            raise InputError(name, "", allowed, problem)

    def _connect(self, topics: list[str]) -> None:
        """Create the publishers and wait until all subscriptions to them are matched."""
        for name in topics:
            kind = Float64 if name == STEERING else Float64MultiArray
            self._commands[name] = make_publisher(self, kind, name, COMMANDING)
        self._simulator.wait(self._is_heard, "a connection to its topics")
        self._simulator.linger(SETTLING)  # they may discover us a little later

    def _hears(self) -> bool:
        return all(each.get_publisher_count() for each in self.collector.subscriptions)

    def _find_alone(self) -> None:
        """Wait until each topic has a single publisher; raises NoAnswerError after a timeout.

        A killed node appears alive until its lease ends, but no longer sends anything.
        """
        until, is_said = time.monotonic() + LEASE, False
        while crowded := [e for e in self.collector.subscriptions if e.get_publisher_count() > 1]:
            topic = crowded[0].topic_name
            if self.collector.is_mixed or time.monotonic() > until:
                raise self._not_alone(topic)
            self._simulator.linger(SETTLING)
            if not (is_said or self.collector.is_mixed):
                is_said = True
                why = f"waiting up to {LEASE:g} s, in case one of them was killed"
                self.get_logger().info(f"several nodes publish {topic}: {why}")

    def _check_alone(self) -> None:
        """Raise NoAnswerError if a second simulator has appeared."""
        if self.collector.is_mixed or self.collector.simulators() > 1:
            raise self._not_alone(self.resolve_topic_name(STATE))

    def _not_alone(self, topic: str) -> NoAnswerError:
        until = time.monotonic() + DISCOVERY
        while NAMELESS in (names := publishers_of(self, topic)) and time.monotonic() < until:
            self._simulator.linger(SETTLING)
        if len(names) < 2:
            name = self._simulator.name
            return NoAnswerError(f"`{name}` has been replaced: another node publishes {topic} now")
        return NoAnswerError(
            f"{len(names)} nodes publish {topic}: {', '.join(names)}; allowed: one simulator per "
            "namespace (stop the others, or start each with --ros-args -r __ns:=/NAME)"
        )

    def _is_heard(self) -> bool:
        """Whether every command has a matched subscription, and all known ones are matched."""
        return all(
            publisher.get_subscription_count() >= max(1, fitting_listeners(self, publisher))
            for publisher in self._commands.values()
        )

    def play(self) -> None:
        """Drive to the end, or until the simulator stops; raises the same errors as `prepare`."""
        self._driving = True
        if self.state is not None:
            self._answer()
        while not self.finished:
            seen = self._states
            self._simulator.wait(lambda: self._states > seen, self._missing())  # noqa: B023
            self._check_alone()
            if self._awaited:
                self._refuse_others(self._commands)  # discovered late: see DISCOVERY
            if self.disturbed:
                raise NoAnswerError(f"`{self._simulator.name}` was reset by another node")
        self._simulator.wait(self.collector.is_complete, "the rest of its last set")
        self._check_alone()

    def _missing(self) -> str:
        """What to say if the next state does not come."""
        silent = [name for name in self._awaited if not self.count_publishers(name)]
        if silent:
            return f"its next state, in lockstep: no node publishes {', '.join(silent)}"
        return "its next state (is it paused?)"

    def _on_state(self, state: dict) -> None:
        now = state["time"]
        is_again = now == self._time
        self.disturbed = self.disturbed or now < self._time
        self.state, self._time = state, now
        self._states += 1
        self._still = self._still + 1 if is_again else 0
        is_reset_again = is_again and now == 0.0 and self._still < STANDING_STILL  # requested twice
        if self._driving and not is_reset_again:
            self._answer()

    def _answer(self) -> None:
        if self._time >= self.manoeuvre.duration - ROUNDING or self._still >= STANDING_STILL:
            self.finished = True
        else:
            self._command(self._time)

    def _command(self, when: float) -> None:
        command = command_at(self.driver, when, self.state)
        self.sent[when] = command.steering
        for name, publisher in self._commands.items():
            kind = Float64 if name == STEERING else Float64MultiArray
            publisher.publish(kind(data=getattr(command, FIELDS[name])))

    @property
    def condition(self) -> Condition:
        """How the run ended, as far as the last state shows."""
        if abs(self.state["roll"]) >= self.rollover_angle and not self._goes_on:
            return Condition.ROLLED_OVER
        if self._time >= self.manoeuvre.duration - ROUNDING:
            return Condition.RUNNING
        return Condition.TOO_SLOW if self.state["u"] < self._slowest else Condition.DIVERGED


def _road(file: str, *slopes: float) -> Road:
    """The road of a simulator, from its parameters; its file is read again."""
    road = Road.from_file(file) if file else Road()
    return dataclasses.replace(road, **dict(zip(parameters_of(Road), slopes, strict=True)))
