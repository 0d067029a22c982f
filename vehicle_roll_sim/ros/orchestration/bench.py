"""The bench: simulator and driver as nodes in this process, the controller as others.

One simulator serves all runs: for each of them it goes on with another vehicle at time 0. To a
controller that is a reset. The driver's commands reach the simulator without the middleware, and
are published for controllers that hear them.
"""

import contextlib
import time
from collections.abc import Callable, Iterator, Sequence

import numpy as np
import rclpy
from rclpy.logging import LoggingSeverity, set_logger_level
from rclpy.signals import SignalHandlerOptions

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.live.channels import channels
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.ros.node_main import LOOK, find_log_folder, lifetime
from vehicle_roll_sim.ros.orchestration.controller_processes import ControllerFailedError
from vehicle_roll_sim.ros.orchestration.driver import BRAKE, DEMANDS, STEERING, TORQUE, Driver
from vehicle_roll_sim.ros.simulator.lockstep import LAST_LOOK, LONGEST_RECEIPT, SETTLING
from vehicle_roll_sim.ros.simulator.node import NAME, Simulator
from vehicle_roll_sim.ros.simulator.session import session_of
from vehicle_roll_sim.scoring.driven import ROUNDING, Driven
from vehicle_roll_sim.scoring.options import WARNING
from vehicle_roll_sim.scoring.plan import Setup
from vehicle_roll_sim.simulation.command import NO_FORCE, Command, command_at
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.parameters import Vehicle

FIELDS = {name: channel.field for name, channel in channels().items()}
GHOST = 25.0
"""Wall time (s) by which a killed node is forgotten: the lease of the middleware is 20 s."""


class Bench:
    """Drives runs with a controller that answers each set on `answers`, in lockstep.

    patience: wall time (s) to wait for an answer. check: called while waiting; raises what ends it.
    """

    def __init__(
        self,
        simulator: Simulator,
        driver: Driver,
        executor,
        answers: Sequence[str],
        patience: float,
    ):
        self.simulator, self._driver, self._executor = simulator, driver, executor
        self._answers, self._patience = tuple(answers), patience
        self._commands = [name for name in answers if name != WARNING]
        self.check: Callable[[], None] = lambda: None
        self._checked = time.monotonic()

    @property
    def setup(self) -> Setup:
        """What all runs share, as the parameters of the simulator say."""
        session = self.simulator.session
        simulation = session.simulation
        return Setup(
            simulation.vehicle,
            simulation.options,
            simulation.step_ns / NANOSECONDS,
            simulation.rollover_angle,
            simulation.road,
            session.period_ns / NANOSECONDS,
        )

    def connect(self) -> None:
        """Wait until the controller publishes all of its answers."""
        self._wait(lambda: not self._missing(), lambda: f"no publisher on {self._missing()[0]}")
        self._linger(SETTLING)

    def disconnect(self) -> None:
        """Wait until no controller is known, after its processes have ended."""
        until = time.monotonic() + GHOST
        while len(self._missing()) < len(self._answers) and time.monotonic() < until:
            self._executor.spin_once(timeout_sec=LOOK)

    def _missing(self) -> list[str]:
        partners = self.simulator.missing_partners(self._commands, ())
        missing = [each.rpartition(" ")[-1] for each in partners]
        if self._driver.is_heard_for_warnings and not self._driver.count_publishers(WARNING):
            missing.append(WARNING)
        return missing

    def drive(
        self, manoeuvre: Manoeuvre, vehicle: Vehicle, is_first: bool, road: Road | None = None
    ) -> Driven:
        """Drive a manoeuvre, completed by `for_vehicle`, with the controller.

        is_first: whether the controller was connected just before. road: by default that of the
        simulator. Raises ControllerFailedError.
        """
        session = session_of(self.simulator.declared, vehicle, manoeuvre.speed, road)
        self._driver.warnings.clear()
        self._sets, given = 1, []
        self.simulator.begin(session)
        if is_first:
            self._await_receipts()
        driver = manoeuvre.driver()
        while True:
            now = session.simulation.time
            demand = command_at(driver, now, session.simulation.state)
            self._demand(manoeuvre, demand)
            self._wait(self._is_answered, self._silent)
            if session.stopped or now >= manoeuvre.duration - ROUNDING:
                break
            with self.simulator.lock, self._braked(manoeuvre, demand):
                self.simulator.run_period()
            self._sets += 1
            given.append(session.applied.records())
        self._check_counts()
        warned = np.array(self._driver.warnings, bool)
        return Driven(np.concatenate(given), warned, self._notes())

    def _await_receipts(self) -> None:
        """Wait until every subscriber has received the first set, and so will the rest."""
        until = time.monotonic() + LONGEST_RECEIPT
        while self.simulator.unreceived() and time.monotonic() < until:
            self._executor.spin_once(timeout_sec=LOOK)

    def _demand(self, manoeuvre: Manoeuvre, command: Command) -> None:
        """Give the driver's commands for the next period, and publish them."""
        session = self.simulator.session
        data = {
            STEERING: command.steering,
            TORQUE: list(command.wheel_torque),
            BRAKE: list(command.brake_torque),
        }
        for name, values in data.items():
            if FIELDS[name] not in manoeuvre.commanded:
                continue
            if name not in self._answers:
                numbers = values if isinstance(values, list) else [values]
                session.inbox.receive(name, numbers, session.simulation.time_ns)
            self._driver.say(name, values)

    @contextlib.contextmanager
    def _braked(self, manoeuvre: Manoeuvre, demand: Command) -> Iterator[None]:
        """Within the block, the driver's brake torques add to those of the controller.

        As both press on the same brakes. A controller that hears the driver's decides on its own.
        """
        session, brakes = self.simulator.session, FIELDS[BRAKE]
        is_left = BRAKE not in self._answers or self._driver.is_heard(BRAKE)
        if is_left or brakes not in manoeuvre.commanded:
            yield
            return
        channel, now = session.inbox.channels[BRAKE], session.simulation.time_ns
        own = channel.value if session.inbox.is_in_force(BRAKE, now) else NO_FORCE
        channel.value, channel.arrival_ns = tuple(np.add(own, demand.brake_torque).tolist()), now
        yield
        channel.value = own

    def _counts(self) -> dict[str, int]:
        """The number of messages received on each topic of the controller in this run."""
        received = self.simulator.session.inbox.channels
        counts = {name: received[name].received for name in self._commands}
        if self._driver.is_heard_for_warnings:
            counts[WARNING] = len(self._driver.warnings)
        return counts

    def _is_answered(self) -> bool:
        return all(count >= self._sets for count in self._counts().values())

    def _silent(self) -> str:
        silent = [name for name, count in self._counts().items() if count < self._sets]
        time_s = self.simulator.session.simulation.time
        return f"no message on {silent[0]} in answer to the set of {time_s:g} s"

    def _check_counts(self) -> None:
        """Raise ControllerFailedError if there was more than one answer to a set."""
        self._linger(LAST_LOOK)
        for name, count in self._counts().items():
            if count != self._sets:
                raise ControllerFailedError(
                    f"{count} messages on {name} in answer to {self._sets} sets: "
                    "in lockstep a controller answers each set once"
                )

    def _notes(self) -> tuple[str, ...]:
        notes = []
        for name in self._commands:
            channel = self.simulator.session.inbox.channels[name]
            if channel.dropped or channel.clamped:
                what = f"{channel.dropped} dropped, {channel.clamped} clamped"
                notes.append(
                    f"`{name}`: of {channel.received} messages {what}; {channel.last_problem}"
                )
        return tuple(notes)

    def _wait(self, done: Callable[[], bool], problem: Callable[[], str]) -> None:
        """Spin until `done`; raises ControllerFailedError after the patience, and as `check`."""
        begun = time.monotonic()
        while not done():
            self._executor.spin_once(timeout_sec=LOOK)
            now = time.monotonic()
            if now - self._checked >= LOOK:
                self._checked = now
                self.check()
            if now - begun > self._patience:
                raise ControllerFailedError(f"{problem()} within {self._patience:g} s")

    def _linger(self, seconds: float) -> None:
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            self._executor.spin_once(timeout_sec=LOOK)


@contextlib.contextmanager
def context(program: str) -> Iterator[None]:
    """A context of rclpy, in the domain of the environment; signals are left alone."""
    find_log_folder(program)
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    try:
        yield
    finally:
        rclpy.try_shutdown()


@contextlib.contextmanager
def bench(answers: Sequence[str], parameters: Sequence[str], patience: float) -> Iterator[Bench]:
    """A bench with a simulator that has these NAME:=VALUE parameters.

    Raises InputError if one of them is wrong.
    """
    driven = [name for name in DEMANDS if name not in answers]
    given = [word for each in ("mode:=lockstep", *parameters) for word in ("-p", each)]
    set_logger_level(NAME, LoggingSeverity.FATAL)
    try:
        simulator = Simulator(driven, cli_args=["--ros-args", *given], use_global_arguments=False)
    except RuntimeError as error:
        problem = " ".join(str(error).split())
        raise InputError("--simulator", "", "NAME:=VALUE", problem) from None
    for timer in simulator.timers:
        timer.cancel()
    with lifetime(simulator) as executor:
        driver = Driver(answers)
        executor.add_node(driver)
        try:
            yield Bench(simulator, driver, executor, answers, patience)
        finally:
            driver.destroy_node()
