"""Writes examples/log.csv: `python test/comparison/example_log.py`.

The log is that of a simulated vehicle whose sensors have noise, units and places as in a car.
"""

from pathlib import Path

import numpy as np
from made_logs import made

from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.vehicle_file import preset

FILE = Path(__file__).parents[2] / "examples" / "log.csv"
SEED = 20260101
EVERY = 2
"""Rows of a simulated log for each row of the file, which has 50 a second."""
PLACE = (0.4, 0.0, -0.2)
"""m: of the accelerometer, forward, left and up from the c.g."""
DELAY = 0.02
"""s: of the yaw rate."""
STANDARD_GRAVITY = 9.80665
COLUMNS = {
    "time": ("Time [s]", 1.0, 0.0, 2),
    "speed": ("v GPS [km/h]", 3.6, 0.05, 2),
    "handwheel": ("SWA [deg]", 180 / np.pi, 0.1, 1),
    "yaw_rate": ("Gyro Z [deg/s]", 180 / np.pi, 0.15, 2),
    "roll_rate": ("Gyro X [deg/s]", 180 / np.pi, 0.15, 2),
    "lateral_acceleration": ("Acc Y [g]", 1 / STANDARD_GRAVITY, 0.005, 4),
    "roll": ("Roll [deg]", -180 / np.pi, 0.03, 2),
    "sideslip_angle": ("Beta [deg]", 180 / np.pi, 0.05, 2),
}
"""Name, factor, noise (standard deviation, in the unit of the column) and digits."""


def example_log() -> dict[str, np.ndarray]:
    """The columns of the file by name, in their units."""
    log = made(Simulation(preset())).late("yaw_rate", DELAY).columns
    log["handwheel"] = 16.0 * log["steering"]
    log["lateral_acceleration"] = _at_sensor(log)
    noise = np.random.default_rng(SEED)
    return {
        name: factor * log[quantity][::EVERY] + noise.normal(0.0, spread, len(log["time"][::EVERY]))
        for quantity, (name, factor, spread, _) in COLUMNS.items()
    }


def _at_sensor(log: dict[str, np.ndarray]) -> np.ndarray:
    """What an accelerometer reads: gravity by the roll angle, and the place of the sensor."""
    x, _, z = PLACE
    time, p, r = log["time"], log["roll_rate"], log["yaw_rate"]
    turning = np.gradient(r, time) * x - np.gradient(p, time) * z
    inward = p * log["pitch_rate"] * x + log["pitch_rate"] * r * z
    level = log["lateral_acceleration"] * np.cos(log["roll"])
    return level + STANDARD_GRAVITY * np.sin(log["roll"]) + turning + inward


def as_text(columns: dict[str, np.ndarray]) -> str:
    """Columns separated by semicolons, with decimal commas."""
    digits = {name: count for name, _, _, count in COLUMNS.values()}
    rows = zip(*columns.values(), strict=True)
    lines = [
        ";".join(f"{value:.{digits[name]}f}" for name, value in zip(columns, row, strict=True))
        for row in rows
    ]
    return "\n".join([";".join(columns), *(line.replace(".", ",") for line in lines)]) + "\n"


if __name__ == "__main__":
    FILE.write_text(as_text(example_log()), encoding="utf-8")
