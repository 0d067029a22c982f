"""The simulator's own parameters, besides those of the model, road and vehicle."""

import dataclasses
import math
from collections.abc import Collection

from vehicle_roll_sim.declaration import InputError, parameter, parameters_of
from vehicle_roll_sim.live.command_inbox import CENTRE, DEFAULT_TIMEOUT, HOLD
from vehicle_roll_sim.live.pacing import (
    AS_FAST_AS_POSSIBLE,
    DEFAULT_CATCH_UP,
    FASTEST_FACTOR,
    SLOWEST_FACTOR,
)
from vehicle_roll_sim.messages.command_topics import COMMANDS, WAYS_IN
from vehicle_roll_sim.messages.topics import (
    BODY_LOADS,
    OF_SOME_SETS,
    ROLL_CENTRE,
    STAMPED,
    STATE_SET,
    set_of,
)
from vehicle_roll_sim.ros.simulator.lockstep import STOP
from vehicle_roll_sim.ros.topics import is_installed
from vehicle_roll_sim.simulation.limits import (
    DEFAULT_ROLLOVER_ANGLE,
    DEFAULT_SPEED,
    DEFAULT_STEP,
    MAXIMUM_SPEED,
    SHORTEST_STEP,
    whole_steps,
)
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.simulation import LONGEST_STEP
from vehicle_roll_sim.simulation.speed_controller import DEFAULT_BRAKE_LIMIT, DEFAULT_DRIVE_LIMIT

REAL_TIME, LOCKSTEP = "real_time", "lockstep"
COMMANDED = tuple(topic.name for topic in COMMANDS)
AWAITED = (*COMMANDED, *(topic.name for topic in WAYS_IN))
NAMES_OF_STAMPED = tuple(topic.name for topic in STAMPED)
OF_CHANGING_SETS = tuple(topic.name for topic in OF_SOME_SETS)
PUBLISHED_IN_SETS = tuple(topic.name for topic in STATE_SET)
"""With every model."""
MOST_STEPS = 100_000
"""Per period: half a second of computation (model 1), during which signals have to wait."""


@dataclasses.dataclass
class Settings:
    """How the simulator runs. Model options, road and vehicle are declared elsewhere."""

    publish_rate: float = parameter(
        "message sets per second of simulated time; the period must be a multiple of step",
        "Hz",
        0.1,
        10_000.0,
        default=100.0,
    )
    step: float = parameter(
        "integration step", "s", SHORTEST_STEP, LONGEST_STEP, default=DEFAULT_STEP
    )
    initial_speed: float = parameter(
        "forward speed at the start and after a reset",
        "m/s",
        0.0,
        MAXIMUM_SPEED,
        tunable=True,
        default=DEFAULT_SPEED,
    )
    rollover_angle: float = parameter(
        "roll angle, to either side, that counts as a rollover and stops the model",
        "rad",
        0.01,
        math.pi / 2,
        default=DEFAULT_ROLLOVER_ANGLE,
    )
    command_timeout: float = parameter(
        "simulated time after which a command that is not repeated expires; 0: never",
        "s",
        0.0,
        3600.0,
        tunable=True,
        default=DEFAULT_TIMEOUT,
    )
    steering_timeout_policy: str = parameter(
        "what the steering does once its command has expired",
        choices=(HOLD, CENTRE),
        tunable=True,
        default=HOLD,
    )
    speed_drive_limit: float = parameter(
        "largest drive torque at each wheel that speed_cmd may use",
        "N m",
        0.0,
        1e5,
        default=DEFAULT_DRIVE_LIMIT,
    )
    speed_brake_limit: float = parameter(
        "largest brake torque at each wheel that speed_cmd may use",
        "N m",
        0.0,
        1e5,
        default=DEFAULT_BRAKE_LIMIT,
    )
    mode: str = parameter(
        "what each period waits for: the clock, or an answer on every topic of lockstep_topics",
        choices=(REAL_TIME, LOCKSTEP),
        default=REAL_TIME,
    )
    real_time_factor: float = parameter(
        "ratio of simulated to real time; 0: as fast as possible, otherwise at least 0.1",
        "",
        AS_FAST_AS_POSSIBLE,
        FASTEST_FACTOR,
        default=1.0,
    )
    catch_up_limit: float = parameter(
        "largest delay that is made up for in real time; periods beyond it are skipped and counted",
        "s",
        0.0,
        10.0,
        default=DEFAULT_CATCH_UP,
    )
    lockstep_topics: tuple = parameter(
        "command topics on which lockstep waits for a message in every period",
        choices=AWAITED,
        default=("steering_cmd",),
    )
    lockstep_wait: tuple = parameter(
        "topics of the set that must have a subscriber before lockstep begins",
        choices=(*PUBLISHED_IN_SETS, *OF_CHANGING_SETS, *NAMES_OF_STAMPED),
        default=("state",),
    )
    lockstep_timeout: float = parameter(
        "wall time that lockstep waits for an answer; 0: forever", "s", 0.0, 3600.0, default=0.0
    )
    lockstep_timeout_policy: str = parameter(
        "what lockstep does after lockstep_timeout: continue with the last command or end the node",
        choices=(HOLD, STOP),
        default=HOLD,
    )
    publish_clock: bool = parameter(
        "publish /clock and stamp messages with simulated time from 0; always on in lockstep and "
        "with a real_time_factor other than 1",
        default=False,
    )
    publish_stamped: bool = parameter(
        "for each topic of the set without a header, also publish NAME_stamped with one",
        default=False,
    )
    frame_prefix: str = parameter("prefix of the frame names in all messages", default="")
    road_file: str = parameter(
        "path of a road file; grade and bank override its values; empty: a plane",
        default="",
    )
    vehicle_file: str = parameter(
        "path of the vehicle file (YAML), or name of a shipped vehicle; empty: the reference "
        "vehicle",
        default="",
    )
    snapshot: str = parameter(
        "token of the state to restore; empty: the last one saved",
        tunable=True,
        default="",
    )
    snapshot_folder: str = parameter(
        "folder in which saved states are also kept as files; empty: none",
        default="",
    )
    strict: bool = parameter(
        "refuse an implausible vehicle instead of logging a warning", default=False
    )

    def memory(self) -> dict:
        """The values that may change while the node runs, without the token of a snapshot."""
        return {name: getattr(self, name) for name in KEPT_WITH_SNAPSHOTS}

    def remember(self, memory: dict) -> None:
        """Take over what `memory` returned."""
        for name in KEPT_WITH_SNAPSHOTS:
            setattr(self, name, memory[name])

    def check(self, options: Options, devices: Collection[str], actuated: bool) -> None:
        """Raise InputError for a combination of values that is not allowed.

        devices: of the vehicle's sensors. actuated: whether it has actuators.
        """
        if AS_FAST_AS_POSSIBLE < self.real_time_factor < SLOWEST_FACTOR:
            allowed = f"0, or from {SLOWEST_FACTOR:g} to {FASTEST_FACTOR:g}"
            raise InputError("real_time_factor", self.real_time_factor, allowed)
        for topic in WAYS_IN:
            if topic.name in self.lockstep_topics and not is_installed(topic):
                package = topic.type.partition("/")[0]
                problem = f"{topic.name} needs {package}, which is not installed"
                raise InputError("lockstep_topics", "", "other topics", problem)
        topics = set_of(options, self.publish_stamped, devices, actuated)
        published = {topic.name for topic in topics}
        if not published.issuperset(self.lockstep_wait):
            allowed = f"topics that end in _stamped only with publish_stamped, {ROLL_CENTRE.name} "
            allowed += f"only with model 2, {BODY_LOADS.name} only with body_contact, those of "
            allowed += "sensors and actuators only with these"
            raise InputError("lockstep_wait", self.lockstep_wait, allowed)

    def steps_in_a_period(self, step_ns: int) -> int:
        """Integration steps per publish period. step_ns: their length (ns). Raises InputError."""
        rate, step = self.publish_rate, self.step
        try:
            steps = whole_steps(1.0 / rate, step_ns, "publish_rate")
        except InputError:
            limit = f"a rate whose period is a multiple of the step, {step:g} s"
            raise InputError("publish_rate", rate, limit) from None
        if steps > MOST_STEPS:
            limit = f"at least {1.0 / (MOST_STEPS * step):g} Hz with steps of {step:g} s"
            raise InputError("publish_rate", rate, limit)
        return steps

    @property
    def is_lockstep(self) -> bool:
        """Whether the mode is lockstep rather than real time."""
        return self.mode == LOCKSTEP

    @property
    def has_own_clock(self) -> bool:
        """Whether stamps are simulated time from 0, published on /clock."""
        return self.publish_clock or self.is_lockstep or self.real_time_factor != 1.0


KEPT_WITH_SNAPSHOTS = tuple(
    name for name, each in parameters_of(Settings).items() if each.tunable and name != "snapshot"
)
