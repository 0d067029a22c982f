"""Find the entry speed of the fishhook at which two wheels of each shipped vehicle lift.

Writes vehicle_roll_sim/vehicle/presets/two_wheel_lift.csv, which the command `vehicles` shows. It
takes a minute or two: `python benchmarks/two_wheel_lift.py`.
"""

import csv
import math
import warnings

from vehicle_roll_sim import InputError, Options, preset, series
from vehicle_roll_sim.command_line.vehicles import MODEL
from vehicle_roll_sim.files.output_file import replaced_file
from vehicle_roll_sim.vehicle.plausibility import PlausibilityWarning
from vehicle_roll_sim.vehicle.shipped import LIFT_SPEEDS, SHIPPED
from vehicle_roll_sim.vehicle.vehicle_file import PRESETS

LOWEST_SPEED = 5.0
"""m/s"""


def lift_speed(name: str) -> float:
    """The lowest entry speed driven at which two wheels lift (m/s); nan if there is none."""
    try:
        search = {"options": Options(model=MODEL), "lowest_speed": LOWEST_SPEED}
        result = series("nhtsa_fishhook", preset(name), **search)
    except InputError as error:
        print(f"{name}: {error}")
        return math.nan
    rows = zip(result["speed"], result["two_wheel_lift"], strict=True)
    return min((speed for speed, time in rows if not math.isnan(time)), default=math.nan)


def main() -> None:
    warnings.simplefilter("ignore", PlausibilityWarning)
    speeds = {name: lift_speed(name) for name in SHIPPED}
    with replaced_file(PRESETS / LIFT_SPEEDS) as partial, partial.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("vehicle", "speed"))
        for name, speed in speeds.items():
            writer.writerow((name, "" if math.isnan(speed) else f"{speed:.4f}"))


if __name__ == "__main__":
    main()
