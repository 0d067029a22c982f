"""The node that drives a running simulator through a manoeuvre, in real time or in lockstep."""

import dataclasses
import math

from rclpy.node import Node
from rclpy.publisher import Publisher
from std_msgs.msg import Float64, Float64MultiArray

from vehicle_roll_sim.declaration import InputError, parameters_of
from vehicle_roll_sim.live.channels import channels
from vehicle_roll_sim.manoeuvres.catalogue import Manoeuvre
from vehicle_roll_sim.messages.run_messages import COLLECTED
from vehicle_roll_sim.model.integration.events import MINIMUM_SPEED, Condition
from vehicle_roll_sim.ros import signals
from vehicle_roll_sim.ros.clients.collector import Collector
from vehicle_roll_sim.ros.clients.other_nodes import TORQUE, WITHOUT_TORQUE, OtherNodes
from vehicle_roll_sim.ros.clients.simulated_vehicle import simulated_vehicle
from vehicle_roll_sim.ros.clients.simulator_client import NoAnswerError, SimulatorClient
from vehicle_roll_sim.ros.node_main import refuse_unknown_parameters
from vehicle_roll_sim.ros.qos_overrides import make_publisher, refuse_wrong_overrides
from vehicle_roll_sim.ros.simulator.lockstep import SETTLING
from vehicle_roll_sim.ros.simulator.settings import LOCKSTEP
from vehicle_roll_sim.ros.topics import COMMANDING
from vehicle_roll_sim.simulation.command import command_at
from vehicle_roll_sim.simulation.compilation import compile_model
from vehicle_roll_sim.simulation.road import Road

STEERING = "steering_cmd"
COMMANDED = (STEERING, TORQUE, "brake_torque_cmd", "wind_cmd")
"""The topics that manoeuvres command."""
FIELDS = {name: channel.field for name, channel in channels().items()}
ROUNDING = 1e-9
"""s"""
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
        self._others = OtherNodes(self, self.collector, simulator, self._commands)
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
        simulator.wait(self._others.are_heard, "a connection to its topics")
        self._others.find_one_simulator()
        if mode == LOCKSTEP:
            commanded = self._answered()
            self._others.refuse_commands(commanded)
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
            allowed += WITHOUT_TORQUE
        problem = f"{' and '.join(missing)} missing, which the manoeuvre commands"
        raise InputError("lockstep_topics", "", allowed, problem)

    def _answered(self) -> list[str]:
        """The topics to command in lockstep, torques (of 0) included if nobody else sends them."""
        if TORQUE in self._needed or TORQUE not in self._awaited:
            return self._needed
        return self._needed if self._others.command(TORQUE) else [*self._needed, TORQUE]

    def _connect(self, topics: list[str]) -> None:
        """Create the publishers and wait until all subscriptions to them are matched."""
        for name in topics:
            kind = Float64 if name == STEERING else Float64MultiArray
            self._commands[name] = make_publisher(self, kind, name, COMMANDING)
        self._simulator.wait(self._others.hear, "a connection to its topics")
        self._simulator.linger(SETTLING)  # they may discover us a little later

    def play(self) -> None:
        """Drive to the end, or until the simulator stops; raises the same errors as `prepare`."""
        self._driving = True
        if self.state is not None:
            self._answer()
        while not self.finished:
            seen = self._states
            self._simulator.wait(lambda: self._states > seen, self._missing())  # noqa: B023
            self._others.check_one_simulator()
            if self._awaited:
                self._others.refuse_commands(self._commands)  # discovered late
            if self.disturbed:
                raise NoAnswerError(f"`{self._simulator.name}` was reset by another node")
        self._simulator.wait(self.collector.is_complete, "the rest of its last set")
        self._others.check_one_simulator()

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
