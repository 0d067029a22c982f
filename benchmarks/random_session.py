"""A session that receives random messages, and checks of what must hold after every period."""

import collections
import dataclasses
import math
import sys
from collections.abc import Iterator

import numpy as np

from vehicle_roll_sim import WHEELS, Road, Simulation, preset
from vehicle_roll_sim.bags.encoding import decode, encode
from vehicle_roll_sim.declaration import parameters_of
from vehicle_roll_sim.live.command_inbox import CENTRE, HOLD, CommandInbox
from vehicle_roll_sim.live.command_limits import CommandLimits
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.messages.command_topics import COMMANDS
from vehicle_roll_sim.messages.sets import Messages
from vehicle_roll_sim.messages.topics import STATE_SET, TRANSFORMS
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.simulation.options import MODELS, Options

STEP_NS = 1_000_000
PERIODS = (1, 2, 5, 10, 20, 50)
"""Publish periods (steps)."""
USUAL = {
    "steering_cmd": 0.3,
    "rear_steering_cmd": 0.1,
    "wheel_torque_cmd": 800.0,
    "brake_torque_cmd": 1500.0,
    "normal_force_cmd": 3000.0,
    "speed_cmd": 30.0,
    "drive_torque_cmd": 1500.0,
    "brake_cmd": 3000.0,
    "wind_cmd": 30.0,
    "road_height_cmd": 0.05,
    "road_friction_cmd": 1.0,
}
"""Largest usual value on each topic, in its unit."""
NEVER_NEGATIVE = ("brake_torque_cmd", "brake_cmd", "road_friction_cmd")
COMMANDED_ROAD = Road.from_values({"features": [{"kind": "commanded"}]})
HUGE = (1e3, 1e6, 1e12, 1e100, 1e300, sys.float_info.max)
"""Factors that turn a usual value into an absurdly large one."""
NO_NUMBERS = (math.nan, math.inf, -math.inf)
LENGTHS = (0, 1, 2, 3, 5, 8, 100)
LONGEST_STOP = 20
"""Periods for which a stopped run is observed before it is reset."""
QUATERNION_ROUNDING = 1e-12
WHOLE_SET = (*STATE_SET, TRANSFORMS)
OF_HEAVE_AND_PITCH = {
    "odom.pose.pose.position.z",
    "odom.twist.twist.linear.z",
    "odom.twist.twist.angular.y",
    "imu.angular_velocity.y",
}
"""The only numbers that are nan in a set of a model without heave and pitch."""


@dataclasses.dataclass
class Found:
    """The results of a soak test: counts, and the worst values in any set."""

    messages: int = 0
    periods: int = 0
    resets: int = 0
    pauses: int = 0
    dropped: int = 0
    clamped: int = 0
    conditions: collections.Counter = dataclasses.field(default_factory=collections.Counter)
    """How often runs have ended with each condition."""
    largest_load: float = 0.0
    largest_roll: float = 0.0
    quaternion_error: float = 0.0
    lifted: int = 0
    sessions: int = 0
    seconds: float = 0.0
    growth: float = 0.0
    """Growth of resident memory (MiB) after the first tenth of the messages."""


class BrokenPromiseError(AssertionError):
    """Something that must always hold does not; the text says what and where."""


def drawn_limits(rng: np.random.Generator) -> CommandLimits:
    """Random command limits: each is the default, the largest allowed, or any value below it."""
    return CommandLimits(
        **{
            name: float(rng.choice([each.default, each.maximum, rng.uniform(0.0, each.maximum)]))
            for name, each in parameters_of(CommandLimits).items()
        }
    )


def numbers(message, place: str) -> Iterator[tuple[str, float | np.ndarray]]:
    """Every number of a decoded message with its path, except for the constant layout."""
    if isinstance(message, (int, float, np.ndarray)):
        yield place, message
    elif isinstance(message, list):
        for part in message:
            yield from numbers(part, place)
    elif dataclasses.is_dataclass(message):
        for field in dataclasses.fields(message):
            if field.name != "layout":
                yield from numbers(getattr(message, field.name), f"{place}.{field.name}")


class Driven:
    """A session with a random model that receives random messages."""

    def __init__(self, rng: np.random.Generator, found: Found):
        self.rng, self.found = rng, found
        found.sessions += 1
        options = Options(model=str(rng.choice([*MODELS])), steady_state_slip=rng.random() < 0.3)
        takes_road = not options.has_eight_dof and rng.random() < 0.5
        road = COMMANDED_ROAD if takes_road else Road()
        simulation = Simulation(preset(), options, road=road)
        timeout = float(rng.choice([0.0, 0.05, 0.5]))
        self.inbox = CommandInbox(timeout, str(rng.choice([HOLD, CENTRE])), drawn_limits(rng))
        period_ns = int(rng.choice(PERIODS)) * STEP_NS
        self.session = Session(simulation, self.inbox, period_ns, 20.0)
        self.messages = Messages(simulation, "", encode)
        self.builders = {topic.name: self.messages.builder(topic.name) for topic in WHOLE_SET}
        self.absent = OF_HEAVE_AND_PITCH if options.has_eight_dof else set()
        self.stamps_begin_ns, self.stamp_ns = 0, -1
        self.stopped_for, self.talkative = 0, 0.0

    def run(self, periods: int, most_messages: int) -> None:
        """Run up to `periods` periods, or until `most_messages` have been sent in total."""
        for _ in range(periods):
            if self.found.messages >= most_messages:
                return
            self.maybe_change_pace()
            self.send()
            self.serve()
            if not self.session.paused:
                self.run_period()

    def maybe_change_pace(self) -> None:
        """Occasionally change between silence, a few messages per period, and bursts."""
        if self.rng.random() < 0.02:
            self.talkative = float(self.rng.choice([0.0, 1.0, 3.0, 20.0]))

    def send(self) -> None:
        """Send random messages and check which are dropped."""
        for _ in range(self.rng.poisson(self.talkative)):
            topic = COMMANDS[self.rng.integers(len(COMMANDS))].name
            values, is_wrong = self.message(topic)
            channel, now_ns = self.inbox.channels[topic], self.session.simulation.time_ns
            dropped = channel.dropped
            self.inbox.receive(topic, values, now_ns)
            self.found.messages += 1
            self.expect(
                channel.dropped == dropped + is_wrong, f"{topic}: {values} wrongly kept or dropped"
            )

    def message(self, topic: str) -> tuple[list, bool]:
        """Random values for a topic, and whether they must be dropped."""
        channel, kind = self.inbox.channels[topic], self.rng.random()
        length = channel.size
        if kind < 0.05:
            length = int(self.rng.choice([each for each in LENGTHS if each != channel.size]))
        values = self.rng.normal(0.0, USUAL[topic] / 2, length)
        if topic in NEVER_NEGATIVE and kind < 0.9:
            values = np.abs(values)
        if 0.05 <= kind < 0.1:
            values[self.rng.integers(length)] = self.rng.choice(NO_NUMBERS)
        elif 0.1 <= kind < 0.12:
            with np.errstate(over="ignore"):
                values *= self.rng.choice(HUGE)
        is_wrong = length != channel.size or not np.isfinite(values).all()
        return values.tolist(), is_wrong or bool((values < channel.smallest).any())

    def serve(self) -> None:
        """Call the services: pause, and reset at random times and after a stop."""
        session, chance = self.session, self.rng.random()
        if session.paused:
            session.paused = chance < 0.8
        elif chance < 0.005:
            session.paused = True
            self.found.pauses += 1
        if self.stopped_for > LONGEST_STOP or self.rng.random() < 0.0005:
            slowest = 3.5 if session.simulation.options.steady_state_slip else 0.0
            session.reset(float(self.rng.uniform(slowest, 50.0)))
            self.stamps_begin_ns = self.stamp_ns + session.period_ns
            self.stopped_for = 0
            self.found.resets += 1
            self.expect(not session.stopped, "a reset does not restart the run")

    def run_period(self) -> None:
        """Run one period and check the set that it publishes."""
        session, simulation = self.session, self.session.simulation
        was_stopped, before = session.stopped, simulation.state_vector.tobytes()
        time_ns = simulation.time_ns
        session.run_period()
        self.found.periods += 1
        if was_stopped:
            self.expect(
                simulation.state_vector.tobytes() == before, "the state of a stopped run changes"
            )
            self.expect(simulation.time_ns == time_ns, "time advances in a stopped run")
        elif session.stopped:
            self.found.conditions[simulation.condition.name] += 1
        else:
            self.expect(
                simulation.time_ns == time_ns + session.period_ns, "a period has the wrong length"
            )
        self.stopped_for = self.stopped_for + 1 if session.stopped else 0
        self.look(self.published(), was_stopped)

    def published(self) -> dict:
        """The set of this period as a subscriber receives it: decoded messages by topic."""
        stamp_ns = self.stamps_begin_ns + self.session.simulation.time_ns
        self.messages.set_time(stamp_ns)
        self.messages.applied = self.session.applied
        return {topic.name: decode(self.builders[topic.name](), topic.type) for topic in WHOLE_SET}

    def look(self, sets: dict, was_stopped: bool) -> None:
        """Check everything that must hold for a set."""
        self.look_at_loads(sets)
        self.look_at_attitude(sets)
        self.look_at_stamps(sets, was_stopped or self.session.stopped)
        found = [each for name, message in sets.items() for each in numbers(message, name)]
        odd = {place for place, values in found if not np.isfinite(values).all()}
        self.expect(odd == self.absent, f"unexpectedly nan, or not: {odd ^ self.absent}")
        self.expect(
            -1.0 <= sets["load_transfer_ratio"].data <= 1.0, "load transfer ratio off range"
        )
        roll = abs(float(self.session.simulation.state["roll"]))
        self.found.largest_roll = max(self.found.largest_roll, roll)

    def look_at_loads(self, sets: dict) -> None:
        """Check that loads are not negative, and lift-off is flagged exactly where they are 0."""
        loads, flags = sets["tire_normal_forces"].data, sets["lift_off"].data
        self.expect((loads >= 0.0).all(), f"loads {loads}")
        self.expect((flags == (loads == 0.0)).all(), f"flags {flags} at loads {loads}")
        self.found.largest_load = max(self.found.largest_load, float(loads.max()))
        self.found.lifted += int(flags.sum())

    def look_at_stamps(self, sets: dict, may_stay: bool) -> None:
        """Check that all stamps of a set are equal, and later than those of the set before."""
        wrenches = (f"tire_forces/{wheel}" for wheel in WHEELS)
        stamps = {self.stamp(sets[name]) for name in ("odom", "imu", "joint_states", *wrenches)}
        self.expect(len(stamps) == 1, f"stamps of one set {stamps}")
        stamp_ns, before_ns = stamps.pop(), self.stamp_ns
        rises = stamp_ns > before_ns or (may_stay and stamp_ns == before_ns)
        self.expect(rises, f"stamp {stamp_ns} after {before_ns}")
        self.stamp_ns = stamp_ns

    def look_at_attitude(self, sets: dict) -> None:
        """Check that quaternions have unit length."""
        for message in (sets["odom"].pose.pose, sets["imu"]):
            turn = message.orientation
            length = math.sqrt(turn.x**2 + turn.y**2 + turn.z**2 + turn.w**2)
            error = abs(length - 1.0)
            self.expect(error < QUATERNION_ROUNDING, f"quaternion of length {length}")
            self.found.quaternion_error = max(self.found.quaternion_error, error)

    @staticmethod
    def stamp(message) -> int:
        """The stamp of a message (ns)."""
        stamp = message.header.stamp
        return stamp.sec * NANOSECONDS + stamp.nanosec

    def expect(self, holds: bool, what: str) -> None:
        """Raise BrokenPromiseError with `what` and the circumstances unless `holds`."""
        if not holds:
            simulation = self.session.simulation
            where = f"message {self.found.messages}, period {self.found.periods}"
            model = f"model {simulation.options.model}, {simulation.condition.name}"
            raise BrokenPromiseError(f"{where}, {model}, {simulation.time:g} s: {what}")
