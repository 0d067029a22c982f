"""The columns of a command file, the fields of a command that they set, and their limits."""

import math

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.roads.feature import HIGHEST
from vehicle_roll_sim.roads.surfaces import LARGEST_FRICTION
from vehicle_roll_sim.simulation.limits import MAXIMUM_SPEED

COLUMNS = {
    **{name: (name, None) for name in ("steering", "rear_steering")},
    **{
        f"{name}_{wheel}": (name, i)
        for name in ("wheel_torque", "brake_torque", "normal_force", "road_height")
        for i, wheel in enumerate(WHEELS)
    },
    **{f"road_friction_{wheel}": ("road_friction_change", i) for i, wheel in enumerate(WHEELS)},
    **{f"wind_{axis}": ("wind", i) for i, axis in enumerate("xy")},
}
"""Column name: field of COMMAND, and index of the value if the field has several."""
TOTALS = {"drive_torque": "wheel_torque", "brake": "brake_torque"}
"""Columns with a total torque (N m), and the field that it is distributed to."""
BRAKES = ("brake", *(f"brake_torque_{wheel}" for wheel in WHEELS))
WIND = (-MAXIMUM_SPEED, MAXIMUM_SPEED, f"from {-MAXIMUM_SPEED:g} to {MAXIMUM_SPEED:g} m/s")
HEIGHT = (-HIGHEST, HIGHEST, f"from {-HIGHEST:g} to {HIGHEST:g} m")
FRICTION = (0.0, LARGEST_FRICTION, f"from 0 to {LARGEST_FRICTION:g}")
LIMITS = {
    **dict.fromkeys(BRAKES, (0.0, math.inf, "of at least 0")),
    **dict.fromkeys(("wind_x", "wind_y"), WIND),
    **{f"road_height_{wheel}": HEIGHT for wheel in WHEELS},
    **{f"road_friction_{wheel}": FRICTION for wheel in WHEELS},
}
"""Smallest and largest value of the columns that are limited, and the range in words."""


def check_limits(field: str, name: str, value: float) -> None:
    """Raise InputError naming `field` for a value beyond the LIMITS of its column."""
    lowest, highest, allowed = LIMITS.get(name, (-math.inf, math.inf, ""))
    if not lowest <= value <= highest:
        raise InputError(field, value, f"a number {allowed}")
