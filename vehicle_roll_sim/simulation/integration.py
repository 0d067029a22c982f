"""Settings of the integration, declared once for all that takes them from users."""

import dataclasses

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.simulation.limits import DEFAULT_ROLLOVER_DEGREES, DEFAULT_STEP, SHORTEST_STEP
from vehicle_roll_sim.simulation.simulation import LONGEST_STEP


@dataclasses.dataclass(frozen=True)
class Integration:
    """The integration step, and the roll angle at which the run stops."""

    step: float = parameter(
        "integration step", "s", SHORTEST_STEP, LONGEST_STEP, default=DEFAULT_STEP
    )
    stop_roll: float = parameter(
        "roll angle that counts as a rollover and ends the run",
        "deg",
        1.0,
        90.0,
        default=DEFAULT_ROLLOVER_DEGREES,
    )
