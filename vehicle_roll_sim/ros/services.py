"""The services of the simulator: name, type and effect."""

import dataclasses

from std_srvs.srv import SetBool, Trigger


@dataclasses.dataclass(frozen=True)
class Service:
    """A service below the name of the node. kind: its class. effect: in one phrase."""

    name: str
    kind: type
    effect: str

    @property
    def type(self) -> str:
        """The name of its type, such as std_srvs/srv/Trigger."""
        return f"{self.kind.__module__.partition('.')[0]}/srv/{self.kind.__name__}"


RESET = Service(
    "reset",
    Trigger,
    "return to static equilibrium at initial_speed and time 0, and discard all commands; refused, "
    "and the run continues, if the step is too large for that speed",
)
PAUSE = Service("pause", SetBool, "true: pause; false: resume")
STEP = Service(
    "step", Trigger, "run one publish period while paused; refused while running or stopped"
)
SAVE = Service(
    "save", Trigger, "save the present state; the message is its token, for the parameter snapshot"
)
RESTORE = Service(
    "restore",
    Trigger,
    "go on from the state whose token is the parameter snapshot, or from the last one saved; "
    "refused, and the run continues, if it is unknown, damaged or that of another simulation",
)
SERVICES = (RESET, PAUSE, STEP, SAVE, RESTORE)
