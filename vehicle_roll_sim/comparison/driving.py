"""The model driven by a log: its steering, and its speed or its torques."""

import dataclasses

import numpy as np

from vehicle_roll_sim.declaration import keep_validated, parameter
from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.logs.log import Log
from vehicle_roll_sim.logs.quantities import BODY, SPEED, TORQUES
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.records import WHEEL_COUNT, WHEELS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import sideslip_angle
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.command import Command, Feedback
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.simulation.speed_controller import SpeedController
from vehicle_roll_sim.vehicle.derived_values import GRAVITY
from vehicle_roll_sim.vehicle.steering_gear import to_road_wheels

PERIOD = 0.002
"""s: commands are those of the middle of such a period, so that holding them delays nothing."""
SPEED_HELD, TORQUES_APPLIED = DRIVES = ("speed", "torques")


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


def drive(log: Log, simulation: Simulation, driving: Driving) -> Driven:
    """Drive a simulation by a log from the run-up to its end, or until the model stops."""
    step = simulation.step_ns / NANOSECONDS
    period = max(1, round(PERIOD / step)) * step
    ahead = round(driving.run_up / period)
    periods = ahead + int(np.ceil((log.time[-1] - log.time[0]) / period - 1e-6))
    middles = (np.arange(periods) - ahead + 0.5) * period + log.time[0]
    driver = _Driver(log, simulation, driving.drive_by, middles, ahead, period)
    simulation.reset(float(driver.speeds[0]))
    recorder = _Recorder(simulation)
    history = run(
        simulation,
        driver,
        periods * period,
        sample=period,
        command_period=period,
        observer=recorder,
    )
    rows = min(len(history.rows), len(recorder.rows))
    times = history["time"][:rows] - ahead * period + log.time[0]
    is_driven = log.time <= times[-1] + 1e-9
    wanted = log.time[is_driven]
    found = _signals(history, np.array(recorder.rows), log.frame, rows)
    signals = {name: np.interp(wanted, times, values) for name, values in found.items()}
    error = np.nan
    if driving.drive_by == SPEED_HELD and len(wanted):
        error = float(np.abs(signals[SPEED] - log.signals[SPEED][is_driven]).max())
    steering = np.interp(wanted, middles, driver.steering)
    return Driven(signals, steering, error, driver.unused, simulation.condition)


class _Driver(Feedback):
    """The commands of a log, one for each period. ahead: periods of the run-up.

    speeds, steering: of each period (m/s, rad). unused: what does not drive the model.
    """

    def __init__(self, log, simulation, drive_by, middles, ahead, period):
        self._simulation, self._period = simulation, period
        vehicle = simulation.vehicle
        given = {name: np.interp(middles, *channel) for name, channel in log.inputs.items()}
        torques = [name for name in given if name in TORQUES]
        self._held = np.arange(len(middles)) < ahead
        if drive_by == SPEED_HELD:
            self._held[:] = True
        elif not torques:
            raise InputError(
                "drive_by", drive_by, "drive_torque, brake or those of wheels in the log"
            )
        self.unused = torques if drive_by == SPEED_HELD else []
        self.speeds, self.steering = given[SPEED], given.get("steering")
        if self.steering is None:
            degrees = to_road_wheels(np.degrees(given["handwheel"]), vehicle.gear)
            self.steering = np.radians(degrees)
        self._rear = given.get("rear_steering", np.zeros(len(middles)))
        self._drives = _of_wheels(given, "drive_torque", "wheel_torque", vehicle.drive_shares)
        self._brakes = _of_wheels(given, "brake", "brake_torque", vehicle.brake_shares)
        radius = float(np.mean(vehicle.per_wheel("tire_radius")))
        limit = vehicle.mass * GRAVITY * radius / WHEEL_COUNT
        self._controller = SpeedController(vehicle, limit, limit)

    def command(self, time: float, state) -> Command:
        place = min(round(time / self._period), len(self.steering) - 1)
        command = Command(float(self.steering[place]), float(self._rear[place]))
        if self._held[place]:
            slope = float(self._simulation.outputs["slope_gravity"][0])
            target, speed = float(self.speeds[place]), float(state["u"])
            return self._controller.drive(command, target, speed, self._period, slope)
        return dataclasses.replace(
            command,
            wheel_torque=tuple(self._drives[place].tolist()),
            brake_torque=tuple(self._brakes[place].tolist()),
        )


def _of_wheels(given: dict, total: str, each: str, shares: np.ndarray) -> np.ndarray:
    """Torques of the wheels (N m), shape (n, 4), from their total or from those of each."""
    count = len(given[SPEED])
    singles = [f"{each}_{wheel}" for wheel in WHEELS if f"{each}_{wheel}" in given]
    if total in given:
        if singles:
            problem = f"{total} together with {singles[0]}"
            raise InputError(f"columns: {total}", "", "a total, or values of wheels", problem)
        return np.outer(given[total], shares)
    still = np.zeros(count)
    return np.column_stack([given.get(f"{each}_{wheel}", still) for wheel in WHEELS])


class _Recorder:
    """What the history of a run does not have: specific force and velocity of the c.g."""

    def __init__(self, simulation: Simulation):
        self._simulation, self.rows = simulation, []

    def on_set(self) -> None:
        *_, u, v, w = self._simulation.cg_motion
        self.rows.append((float(self._simulation.outputs["specific_force"][1]), u, v, w))

    def on_command(self, command: Command) -> None:
        """Commands are those of the log."""


def _signals(history: History, more: np.ndarray, frame: str, rows: int) -> dict[str, np.ndarray]:
    """The quantities of a log from the rows of a run."""
    felt, *velocity = more[:rows].T
    roll, pitch = history["roll"][:rows], history["pitch"][:rows]
    level = history["lateral_acceleration"][:rows]
    return {
        SPEED: history["u"][:rows],
        "lateral_acceleration": felt if frame == BODY else level,
        "sideslip_angle": np.nan_to_num(sideslip_angle(velocity, roll, pitch)),  # 0 at standstill
        **{name: history[name][:rows] for name in ("yaw_rate", "roll", "roll_rate")},
        **{f"normal_force_{w}": history[f"normal_force_{w}"][:rows] for w in WHEELS},
    }
