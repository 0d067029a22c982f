"""How a log drives the model, and what the model did: signals as a log has them."""

import dataclasses

import numpy as np

from vehicle_roll_sim.comparison.log_commands import LogCommands, Plan
from vehicle_roll_sim.declaration import keep_validated, parameter
from vehicle_roll_sim.logs.log import Log
from vehicle_roll_sim.logs.quantities import BODY, SPEED
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.records import OUTPUTS, STATE_NAMES, WHEEL_COUNT, WHEELS
from vehicle_roll_sim.runs.metrics import sideslip_angle


def output_places(*wanted: tuple) -> list[int]:
    """Places of (name, element) in the flat vector of OUTPUTS."""
    places = np.arange(OUTPUTS.itemsize // 8).astype(np.float64).view(OUTPUTS)[0]
    found = [np.atleast_1d(places[name][element]) for name, element in wanted]
    return np.concatenate(found).astype(int).tolist()


SPEED_HELD, TORQUES_APPLIED = DRIVES = ("speed", "torques")
NOTED_STATES = [STATE_NAMES.index(name) for name in ("u", "roll", "pitch", "yaw_rate", "roll_rate")]
NOTED_OUTPUTS = output_places(("acceleration", 1), ("specific_force", 1), ("normal_force", ...))
"""Where the quantities are in the flat vectors of states and outputs."""


@dataclasses.dataclass(frozen=True)
class Driving:
    """How a log drives the model."""

    drive_by: str = parameter(
        "what drives the model beside the steering: the speed, which the speed controller holds, "
        "or the torques and brakes",
        choices=DRIVES,
        default=SPEED_HELD,
    )
    run_up: float = parameter(
        "time for which the model drives with the first steering angle and speed before the log "
        "begins",
        "s",
        0.0,
        60.0,
        default=3.0,
    )

    def __post_init__(self):
        keep_validated(self)

    @property
    def holds_speed(self) -> bool:
        """Whether the speed is held from the beginning to the end."""
        return self.drive_by == SPEED_HELD


@dataclasses.dataclass(frozen=True)
class Driven:
    """What the model did. signals: by name of the log's quantities, (n,), at the first n times of
    the log. steering: of the model at these times (rad). speed_error: largest error of the held
    speed (m/s), nan if it is not held. unused: quantities of the log that did not drive the model.
    """

    signals: dict[str, np.ndarray]
    steering: np.ndarray
    speed_error: float
    unused: list[str]
    condition: Condition


def driven_of(
    log: Log, plan: Plan, commands: LogCommands, columns: np.ndarray, condition: Condition
) -> Driven:
    """What the model did, from what was noted at the end of each period.

    columns: of `noted`, shape (quantities, periods + 1), fewer if the model stopped.
    """
    times = plan.instants[: columns.shape[1]]
    is_driven = log.time <= times[-1] + 1e-9
    wanted = log.time[is_driven]
    found = _signals(columns, log.frame)
    signals = {name: np.interp(wanted, times, values) for name, values in found.items()}
    error = np.nan
    if commands.is_held.all() and len(wanted):
        error = float(np.abs(signals[SPEED] - log.signals[SPEED][is_driven]).max())
    steering = np.interp(wanted, plan.middles, commands.steering)
    return Driven(signals, steering, error, commands.unused, condition)


def noted(states: np.ndarray, outputs: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """What `driven_of` needs at one time, shape (quantities,), or (n, quantities) of n models.

    states, outputs: flat vectors, one or n of them. velocity: u, v, w of the c.g. (m/s), likewise.
    """
    of_model = (states[..., NOTED_STATES], outputs[..., NOTED_OUTPUTS])
    return np.concatenate((*of_model, velocity), axis=-1)


def _signals(columns: np.ndarray, frame: str) -> dict[str, np.ndarray]:
    """The quantities of a log from the columns of `noted`."""
    speed, roll, pitch, yaw_rate, roll_rate, level, felt, *others = columns
    loads, velocity = others[:WHEEL_COUNT], others[WHEEL_COUNT:]
    return {
        SPEED: speed,
        "lateral_acceleration": felt if frame == BODY else level,
        "sideslip_angle": np.nan_to_num(sideslip_angle(velocity, roll, pitch)),  # 0 at standstill
        "yaw_rate": yaw_rate,
        "roll": roll,
        "roll_rate": roll_rate,
        **{f"normal_force_{w}": load for w, load in zip(WHEELS, loads, strict=True)},
    }
