"""Logs that the simulator makes itself, with known faults of sensors added to them."""

import dataclasses
import functools
from pathlib import Path

import numpy as np

from vehicle_roll_sim.model.records import COMMAND, WHEELS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import sideslip_angle
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.vehicle_file import preset

PERIOD = 0.01
"""s: of the rows of a log."""
SPEED = 22.0
"""m/s: at the start; the vehicle then rolls freely, so that zero torques drive it."""
UNITS = {
    "time": "s",
    "speed": "m/s",
    "brake": "N m",
    "lateral_acceleration": "m/s^2",
    **dict.fromkeys(("yaw_rate", "roll_rate", "pitch_rate"), "rad/s"),
}


@dataclasses.dataclass
class MadeLog:
    """A run as sensors would see it. columns: by quantity, SI units, (n,) each."""

    columns: dict[str, np.ndarray]

    def map(self, **more) -> dict:
        """A map of these columns. more: further keys of a column, by quantity."""
        return {"columns": {name: self._entry(name) | more.get(name, {}) for name in self.columns}}

    def _entry(self, name: str) -> dict:
        load = "N" if name.startswith("normal_force") else "rad"
        frame = {"frame": "level"} if name == "lateral_acceleration" else {}
        return {"column": name, "unit": UNITS.get(name, load)} | frame

    def write(self, path: Path) -> Path:
        """As a CSV file in full precision."""
        rows = np.column_stack(list(self.columns.values())).tolist()
        lines = [",".join(self.columns), *(",".join(map(repr, row)) for row in rows)]
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return path

    def with_(self, **changed: np.ndarray) -> "MadeLog":
        """A copy with other values in some columns, or without those that are None."""
        columns = self.columns | changed
        return MadeLog({name: each for name, each in columns.items() if each is not None})

    def late(self, name: str, seconds: float) -> "MadeLog":
        """A copy in which one sensor is late."""
        time = self.columns["time"]
        return self.with_(**{name: np.interp(time - seconds, time, self.columns[name])})


def gentle(times: np.ndarray) -> np.ndarray:
    """Road-wheel angle (rad): a ramp into a turn and out of it, then a period of a sine."""
    ramp = np.interp(times, (0.5, 5.5, 6.0, 6.7), (0.0, 0.03, 0.03, 0.0))
    sine = np.where((times > 7.5) & (times < 9.5), np.sin(np.pi * (times - 7.5)), 0.0)
    return ramp + 0.04 * sine


def severe(times: np.ndarray) -> np.ndarray:
    """Road-wheel angle (rad) of a turn that lifts the inner wheels, without a rollover."""
    return np.interp(times, (0.5, 0.8, 1.6, 2.0), (0.0, 0.08, 0.08, 0.0))


def overturning(times: np.ndarray) -> np.ndarray:
    """Road-wheel angle (rad) of a step steer that ends in a rollover."""
    return np.interp(times, (0.5, 0.8), (0.0, 0.13))


def made(simulation: Simulation, steering=gentle, duration: float = 10.5) -> MadeLog:
    """The log of a freely rolling run, all sensors at the c.g. and without noise."""

    def driver(times):
        commands = np.zeros(len(times), COMMAND)
        commands["steering"] = steering(times)
        return commands

    simulation.reset(SPEED)
    history = run(simulation, driver, duration, sample=PERIOD)
    return MadeLog(_columns(history, steering))


@functools.cache
def gentle_log() -> MadeLog:
    """That of the reference vehicle; only read."""
    return made(Simulation(preset()))


def _columns(history: History, steering) -> dict[str, np.ndarray]:
    time = history["time"]
    velocity = (history["u"], history["v"], history["w"])
    return {
        "time": time,
        "steering": steering(time),
        "speed": history["u"],
        "brake": np.zeros(len(time)),
        **{name: history[name] for name in ("yaw_rate", "roll", "roll_rate", "pitch_rate")},
        "lateral_acceleration": history["lateral_acceleration"],
        "sideslip_angle": sideslip_angle(velocity, history["roll"], history["pitch"]),
        **{f"normal_force_{wheel}": history[f"normal_force_{wheel}"] for wheel in WHEELS},
    }
