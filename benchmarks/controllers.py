"""`python -m benchmarks.controllers [FILE]`: a table of the effect of each example controller.

The effect is measured in lockstep runs without and with the controller. In FILE, the existing table
is replaced, and so are the lines below it.
"""

import math
import os
import sys
from pathlib import Path

from vehicle_roll_sim.ros.controller_scripts import EXAMPLES
from vehicle_roll_sim.ros.orchestration.comparison import (
    Chain,
    Outcome,
    Scenario,
    distance,
    drive,
    ros_words,
)
from vehicle_roll_sim.ros.orchestration.domains import own_domain
from vehicle_roll_sim.simulation.compilation import compile_model

HEADER = (
    *("controller", "manoeuvre", "peak roll", "largest load transfer ratio", "two-wheel lift"),
    *("rollover", "largest distance", "displacement to the left", "forward speed"),
)


def program(name: str, *parameters: str) -> tuple[str, ...]:
    """The script of an example, and the arguments that set its parameters."""
    return (str(EXAMPLES / f"{name}.py"), *ros_words(parameters))


SCENARIOS = {
    "J-turn": Scenario(("j_turn",)),
    "fishhook": Scenario(
        ("nhtsa_fishhook", "--speed", "20.1168"),
        ("steering_cmd", "wheel_torque_cmd"),
        ("vehicle.cg_height:=0.62",),
    ),
}
"""The J-turn of the paper at 50 km/h; NHTSA's fishhook at 45 mph, with a lower c.g."""
WARNING = program("rollover_warning")
BRAKES = ("brake_torque_cmd",)
WITHOUT = Chain(BRAKES, (WARNING, program("roll_braking", "largest_torque:=0.0")))
"""With warnings, but without braking."""
CONTROLLERS = {
    "active_roll_bar": Chain(("normal_force_cmd",), (program("active_roll_bar"),)),
    "roll_braking": Chain(BRAKES, (WARNING, program("roll_braking"))),
    "rear_steering": Chain(("rear_steering_cmd",), (program("rear_steering"),)),
    "lqr_roll_bar": Chain(("normal_force_cmd",), (program("lqr_roll_bar"),)),
    "rollover_mpc": Chain((*BRAKES, "rear_steering_cmd"), (program("rollover_mpc"),)),
    "stability_control": Chain(BRAKES, (program("stability_control"),)),
}


def row(controller: str, manoeuvre: str, without: Outcome, found: Outcome) -> list[str]:
    """A table row: figures without and with the controller, up to the rollover without it."""
    end = without.rollover
    pairs = (
        (f"{without.peak_roll:.1f}", f"{found.peak_roll:.1f}°"),
        (f"{without.largest_ratio:.2f}", f"{found.largest_ratio:.2f}"),
        (moment(without.two_wheel_lift), moment(found.two_wheel_lift)),
        (moment(without.rollover), moment(found.rollover)),
    )
    path = (
        f"{distance(without, found, end):.1f} m",
        f"{without.at('y', end):.1f} → {found.at('y', end):.1f} m",
        f"{without.at('u', end):.1f} → {found.at('u', end):.1f} m/s",
    )
    return [f"`{controller}`", manoeuvre, *(" → ".join(pair) for pair in pairs), *path]


def warning_line(manoeuvre: str, without: Outcome) -> str:
    """A line on how long before each event the warning comes."""
    leads = (
        ("both inner wheels are unloaded", without.inner_wheels_off),
        ("the two-wheel lift", without.two_wheel_lift),
        ("the rollover", without.rollover),
    )
    text = ", ".join(f"{time - without.warned:.2f} s before {what}" for what, time in leads)
    return f"- {manoeuvre}: `rollover_warning` at {without.warned:.2f} s: {text}"


def moment(time: float) -> str:
    return "none" if math.isnan(time) else f"{time:.2f} s"


def compare(manoeuvre: str) -> tuple[list[list[str]], str]:
    """The rows of the table for one manoeuvre, and the line about its warning."""
    scenario = SCENARIOS[manoeuvre]
    without = drive(scenario, WITHOUT)
    rows = [
        row(name, manoeuvre, without, drive(scenario, chain)) for name, chain in CONTROLLERS.items()
    ]
    return rows, warning_line(manoeuvre, without)


def as_table(rows: list[list[str]], lines: list[str]) -> str:
    cells = [HEADER, ["---"] * len(HEADER), *rows]
    return "\n".join(["| " + " | ".join(row) + " |" for row in cells]) + "\n\n" + "\n".join(lines)


def replaced(text: str, table: str) -> str:
    """The text with the table, and the lines below it, replaced; exits if there is no table."""
    before, header, rest = text.partition("| " + " | ".join(HEADER) + " |")
    if not header:
        raise SystemExit("controllers: error: no table to replace")
    behind = rest.split("\n\n", 2)[2:]
    return "\n\n".join((before + table, *behind)).rstrip("\n") + "\n"


def main(words: list[str]) -> None:
    compile_model()
    with own_domain() as domain:
        os.environ["ROS_DOMAIN_ID"] = str(domain)
        found = [compare(manoeuvre) for manoeuvre in SCENARIOS]
    rows = [cells for own, _ in found for cells in own]
    table = as_table(rows, [line for _, line in found])
    print(table)
    for file in map(Path, words):
        file.write_text(replaced(file.read_text(encoding="utf-8"), table), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
