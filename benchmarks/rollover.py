"""`python -m benchmarks.rollover [FILE]`: a table of what each suspension detail does to rollover.

The reference vehicle drives the J-turn of the paper with each detail alone: at 50 km/h, and at
rising speeds up to the rollover. In FILE, the existing table is replaced, and so are the lines
below it.
"""

import math
import sys
from pathlib import Path

from vehicle_roll_sim import Options, preset
from vehicle_roll_sim.manoeuvres.catalogue import PAPER
from vehicle_roll_sim.manoeuvres.series.base import driven
from vehicle_roll_sim.manoeuvres.series.speed_search import EVENTS, KMH, SpeedSearch, gap_of

HEADER = (
    *("detail", "values", "rear lift-off", "front lift-off", "rollover"),
    *("tip-up speed, model 1", "change", "tip-up speed, model 2", "change"),
)
J_TURN = PAPER["j_turn"]
MODELS = ("1", "2")
SEARCH = SpeedSearch(J_TURN, lowest_speed=9.0, highest_speed=25.0, speed_step=2.0, resolution=0.01)


def of_axles(name: str, front: float, rear: float) -> dict[str, float]:
    return {f"front_{name}": front, f"rear_{name}": rear}


def progressive(stiffness: float, load: float) -> tuple:
    """A spring with this load (N) and stiffness (N/m) at rest: the half of it 0.1 m below."""
    rise = 2.5 * stiffness  # N/m^2
    around = [k / 40 for k in range(-4, 5)]
    return tuple((0.1 + d, load + stiffness * d + rise * d**2) for d in around)


BARS = of_axles("anti_roll_bar_stiffness", 20e3, 8e3)
STOPS = (
    of_axles("bump_stop_clearance", 0.06, 0.06)
    | of_axles("bump_stop_stiffness", 50e3, 50e3)
    | of_axles("bump_stop_progression", 2e6, 2e6)
    | of_axles("rebound_stop_clearance", 0.06, 0.06)
    | of_axles("rebound_stop_stiffness", 100e3, 100e3)
)
DETAILS = {
    "none": ("the vehicle of the paper", {}, {}),
    "anti-roll bars": ("20 and 8 kN m/rad", BARS, {}),
    "bump and rebound stops": (
        "60 mm from rest; 50 kN/m, rising by 20 kN/m per cm; 100 kN/m",
        STOPS,
        {},
    ),
    "progressive springs": (
        "half the stiffness 0.1 m below rest, 1.5 times 0.1 m above",
        {
            "front_spring_force": progressive(35e3, 1440 * 9.81 * 0.3),
            "rear_spring_force": progressive(30e3, 1440 * 9.81 * 0.2),
        },
        {},
    ),
    "asymmetric dampers": (
        "bump to rebound 1 : 3, same mean",
        of_axles("damping", 1250.0, 1000.0) | of_axles("rebound_damping", 3750.0, 3000.0),
        {},
    ),
    "roll steer": ("−0.05 and 0.05 °/° (understeer)", of_axles("roll_steer", -0.05, 0.05), {}),
    "compliance steer": (
        "−0.15 and 0.05 °/kN (understeer)",
        of_axles("lateral_force_steer", -0.15e-3 * math.pi / 180, 0.05e-3 * math.pi / 180),
        {},
    ),
    "static toe": ("0.2° toe-in", of_axles("toe", math.radians(0.2), math.radians(0.2)), {}),
    "Ackermann geometry": ("100 %", {"ackermann_percentage": 100.0}, {}),
    "engine drag": ("1 N m s/rad at each rear wheel", {"engine_drag": 1.0}, {}),
    "wheel gyroscopics": ("", {}, {"wheel_gyroscopics": True}),
}
"""Of each detail its values in words, and as vehicle parameters and options."""


def row(name: str, before: dict[str, float]) -> tuple[list[str], dict[str, float]]:
    """The table row of a detail, and its tip-up speeds by model (km/h).

    before: the tip-up speeds without any detail, empty in their own row.
    """
    words, values, options = DETAILS[name]
    vehicle = preset().with_values(values)
    simulation, _ = driven(J_TURN, vehicle, Options(**options))
    lifts = simulation.events.lift_off_time
    times = (lifts[2], lifts[0], simulation.events.rollover_time[0])
    speeds = {model: tip_up_speed(vehicle, Options(model, **options)) for model in MODELS}
    cells = [name, words, *(moment(float(time)) for time in times)]
    for model, speed in speeds.items():
        change = f"{speed - before[model]:+.1f} km/h".replace("-", "−") if before else ""
        cells += [f"{speed:.1f} km/h", change]
    return cells, speeds


def moment(time: float) -> str:
    return "–" if math.isnan(time) else f"{time:.2f} s"


def tip_up_speed(vehicle, options: Options) -> float:
    """The lowest entry speed at which the J-turn rolls the vehicle over (km/h)."""
    rows = {run[0]: run for run in SEARCH.rows_to_a_side(J_TURN, "left", vehicle, options)}
    return KMH * gap_of(rows, EVENTS["rollover"])[1]


def table() -> str:
    """All rows, in Markdown."""
    lines, before = [[*HEADER], ["---"] * len(HEADER)], {}
    for name in DETAILS:
        cells, speeds = row(name, before)
        before = before or speeds
        lines.append(cells)
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def main(words: list[str]) -> None:
    text = table()
    print(text, end="")
    for name in words[:1]:
        page = Path(name)
        above, _, _ = page.read_text(encoding="utf-8").partition(
            "| " + HEADER[0] + " | " + HEADER[1]
        )
        page.write_text(above + text, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
