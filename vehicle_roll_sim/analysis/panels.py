"""The signals in the left panels of the standard figure: commands and responses."""

import dataclasses
import math
from collections.abc import Callable, Iterable

import numpy as np

from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import load_transfer_ratio, sideslip_angle

FARTHEST_ROLL_CENTRE = 2.0
"""m: distances above it are not drawn; that of lines which are nearly parallel has no limit."""
DEGREES = math.degrees(1)
KILO = 1e3
PANELS = (
    ("steering", "steering, front\nroad wheels (deg)", DEGREES),
    ("roll", "roll angle\n(deg)", DEGREES),
    ("lateral_acceleration", "lateral acceleration\n(m/s²)", 1.0),
    ("yaw_rate", "yaw rate\n(deg/s)", DEGREES),
)
"""Column of a history, label with unit, and factor to that unit."""


@dataclasses.dataclass(frozen=True)
class Signal:
    """The signal of a panel.

    label: name with unit. of: function of a history that returns the values, shape (n,), or (n, 4)
    for the wheels if is_command, or (n, 2) for the axles if is_of_axles.
    """

    label: str
    of: Callable[[History], np.ndarray]
    is_command: bool = False
    is_of_axles: bool = False


def _column(name: str, label: str, scale: float) -> Signal:
    return Signal(label, lambda history: history[name] * scale)


def _command(name: str, label: str) -> Signal:
    return Signal(label, lambda history: history.command(name), is_command=True)


def _wind(axis: str) -> Signal:
    return Signal(f"wind along {axis}\n(m/s)", lambda history: history.command(f"wind_{axis}"))


STEERING, *RESPONSES = (_column(*panel) for panel in PANELS)
REAR_STEERING = Signal(
    "steering, rear\nroad wheels (deg)", lambda history: history.command("rear_steering") * DEGREES
)
SIDESLIP = Signal(
    "sideslip angle\n(deg)",
    lambda history: (
        DEGREES
        * sideslip_angle([history[name] for name in "uvw"], history["roll"], history["pitch"])
    ),
)
SPEED = _column("u", "forward speed\n(m/s)", 1.0)
LOAD_TRANSFER = Signal(
    "load transfer\nratio (−)", lambda history: load_transfer_ratio(history.wheels("normal_force"))
)


def _roll_centre(measure: str, label: str) -> Signal:
    def shown(history: History) -> np.ndarray:
        values = history.roll_centre(measure)
        return np.where(np.abs(values) <= FARTHEST_ROLL_CENTRE, values, np.nan)

    return Signal(label, shown, is_of_axles=True)


def _body_load(history: History) -> np.ndarray:
    if history.body_loads is None:
        return np.full(len(history.rows), np.nan)
    return history.body_loads.sum(axis=1) / KILO


BODY_LOAD = Signal("load on the\nbody (kN)", _body_load)
"""Sum of the normal loads on the corners of the body; shown only if it may touch the ground."""
ROLL_CENTRES = (
    _roll_centre("height", "roll centre\nheight (m)"),
    _roll_centre("place", "roll centre\nto the left (m)"),
)
"""Shown only for models whose roll centres move."""
COMMANDS = (
    REAR_STEERING,
    _command("wheel_torque", "wheel torque\n(N m)"),
    _command("brake_torque", "brake torque\n(N m)"),
    _command("active_force", "active force\n(N)"),
    *(_wind(axis) for axis in "xy"),
)
"""Shown only if they are not 0 throughout."""


def signals_of(histories: Iterable[History], anyway: Iterable[Signal] = ()) -> list[Signal]:
    """The panels for some runs, from the top: steering, other commands, responses.

    anyway: commands with a panel even if they are 0 throughout.
    """
    histories, anyway = list(histories), list(anyway)
    given = [
        signal
        for signal in COMMANDS
        if signal in anyway or any(np.nan_to_num(signal.of(history)).any() for history in histories)
    ]
    moving = any(history.roll_centres is not None for history in histories)
    touching = any(history.body_loads is not None for history in histories)
    below = (LOAD_TRANSFER, *((BODY_LOAD,) if touching else ()), *(ROLL_CENTRES if moving else ()))
    return [STEERING, *given, *RESPONSES, SIDESLIP, SPEED, *below]
