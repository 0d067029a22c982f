"""The arguments of the launch files, for `ros2 launch`, `--show-args` and the documentation."""

import dataclasses
import os
import time
from collections.abc import Callable, Iterable

from vehicle_roll_sim.declaration import parameters_of
from vehicle_roll_sim.manoeuvres.catalogue import ON_ANY_ROAD
from vehicle_roll_sim.ros.launching.values import NO, YES
from vehicle_roll_sim.ros.simulator.settings import Settings
from vehicle_roll_sim.simulation.options import Options

DISCOVERY = "ROS_AUTOMATIC_DISCOVERY_RANGE"
NEARBY = "LOCALHOST"
"""Default: discovery stays on this machine."""


@dataclasses.dataclass(frozen=True)
class Argument:
    """A launch argument, always a text. default: as the documentation shows it.

    at_start: the default at the start, where it depends on the time or the environment.
    """

    name: str
    description: str
    default: str = ""
    choices: tuple[str, ...] = ()
    at_start: Callable[[], str] | None = None

    @property
    def value(self) -> str:
        """The default at the start."""
        return self.at_start() if self.at_start else self.default


def new_bag() -> str:
    """A name for a new bag, from the current time."""
    return time.strftime("bag_%Y-%m-%d-%H%M%S")


def _of_simulator(*names: str) -> Iterable[Argument]:
    """Arguments that are parameters of the simulator and mean the same."""
    declared = parameters_of(Settings) | parameters_of(Options)
    for name in names:
        unit = f" ({declared[name].unit})" if declared[name].unit else ""
        what, *more = declared[name].description.split("; ")
        about = "; ".join((what + unit, *more, "none: the simulator's default"))
        yield Argument(name, about)


CONTROLLER = (
    Argument(
        "controller",
        "name of an example (other examples that it needs are started too), or path of your own "
        "script; several are separated by spaces",
        "active_roll_bar",
    ),
    Argument(
        "parameters",
        "ROS parameters of the controllers, such as 'share:=0.7 smoothing:=0.1'; each is passed to "
        "the scripts that contain its name as a string, or to all if none does",
    ),
    Argument(
        "answers",
        "command topics on which the controllers publish (for lockstep), separated by spaces; "
        "none: those that the scripts list in `said` or, for a script that does not list them "
        "there as plain strings, all that occur in it as strings",
    ),
)
MANOEUVRE = (
    Argument(
        "manoeuvre", "manoeuvre to drive; the launch ends with it", "j_turn", tuple(ON_ANY_ROAD)
    ),
    Argument(
        "options",
        "options of the manoeuvre, as on the command line: '--amplitude 8 --speed 15'",
    ),
)
BAG = Argument("bag", "folder of the bag, which must not exist yet; none: no bag")
BAG_ALWAYS = dataclasses.replace(BAG, default="bag_DATE-TIME", at_start=new_bag)
USE_RVIZ = Argument("use_rviz", "start RViz: true or false", YES)
SIMULATOR = (
    Argument("vehicle_file", "vehicle file (YAML); none: the reference vehicle"),
    Argument("road_file", "road file (YAML); none: a plane"),
    *_of_simulator("model", "initial_speed", "publish_rate", "real_time_factor"),
    Argument(
        "params_file",
        "ROS parameter file (YAML) of the simulator; the other arguments take precedence",
    ),
    Argument(
        "lockstep",
        "true: lockstep, one period for each answer of the controllers; false: real time",
        NO,
    ),
    Argument(
        "log_level",
        "log level of all nodes except `ros2 bag record`: debug, info, warn, error or fatal, or "
        "LOGGER:=LEVEL",
    ),
    Argument(
        "use_sim_time",
        "true: the simulator publishes /clock and the other nodes use it; false: they do not use "
        "it; none: robot_state_publisher and RViz use it if the simulator publishes it anyway",
    ),
    Argument(
        "discovery_range",
        f"{DISCOVERY} of all nodes; if it is set in the environment, that is the default",
        NEARBY,
        at_start=lambda: os.environ.get(DISCOVERY, NEARBY),
    ),
    Argument("namespace", "namespace of all nodes, to run several vehicles"),
    Argument(
        "frame_prefix", "prefix of the frame names in all messages; for RViz it must end in a slash"
    ),
)
ARGUMENTS = {
    "controller": (*CONTROLLER, *MANOEUVRE, BAG_ALWAYS, *SIMULATOR),
    "manoeuvre": (*MANOEUVRE, BAG, *SIMULATOR),
    "rviz": (USE_RVIZ, *SIMULATOR),
    "simulator": SIMULATOR,
}
"""By launch file."""
