#!/usr/bin/env python3
"""What each controller here does: runs in lockstep with and without it, as a table in Markdown.

usage: python msg_examples/compare.py [README.md], which has the table between its header and the
next empty line brought up to date.
"""

import dataclasses
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.metrics import load_transfer_ratio
from vehicle_roll_sim.manoeuvres.criteria import two_wheel_lift
from vehicle_roll_sim.ros.demo import LOCAL, start, stop
from vehicle_roll_sim.simulation.history import History
from vehicle_roll_sim.simulation.simulation import DEFAULT_ROLLOVER_ANGLE, compile_model

FOLDER = Path(__file__).parent
INNER_WHEELS_OFF = 0.999
"""Load transfer ratio; 1 but for rounding."""
WARNED = re.compile(r"at (\d+\.\d+) s: the (\w+) wheels lift")
HEADER = (
    *("controller", "manoeuvre", "peak roll", "largest load transfer ratio", "two-wheel lift"),
    *("rollover", "off the path", "sideways", "speed"),
)


@dataclasses.dataclass(frozen=True)
class Scenario:
    """A manoeuvre that ends in a rollover without a controller, and the vehicle for it."""

    manoeuvre: tuple[str, ...]
    commands: tuple[str, ...] = ("steering_cmd",)
    vehicle: tuple[str, ...] = ()


@dataclasses.dataclass(frozen=True)
class Chain:
    """Controllers that answer with `command` in the end: programs and their parameters."""

    command: str
    programs: tuple[tuple[str, ...], ...]


SCENARIOS = {
    "J-turn": Scenario(("j_turn",)),
    "fishhook": Scenario(
        ("nhtsa_fishhook", "--speed", "20.1168"),
        ("steering_cmd", "wheel_torque_cmd"),
        ("vehicle.cg_height:=0.62",),
    ),
}
"""The source's at 50 km/h with the reference vehicle; NHTSA's at 45 mph with its c.g. lower."""
WARNING = ("rollover_warning",)
WITHOUT = Chain("brake_torque_cmd", (WARNING, ("roll_braking", "largest_torque:=0.0")))
"""Warned, but not braked."""
CONTROLLERS = {
    "active_roll_bar": Chain("normal_force_cmd", (("active_roll_bar",),)),
    "roll_braking": Chain("brake_torque_cmd", (WARNING, ("roll_braking",))),
    "rear_steering": Chain("rear_steering_cmd", (("rear_steering",),)),
}


@dataclasses.dataclass(frozen=True)
class Outcome:
    """What a run was; warnings: when they came (s), and of the wheels of which side."""

    history: History
    warnings: tuple[tuple[float, str], ...]

    @property
    def peak_roll(self) -> float:
        return float(np.degrees(np.abs(self.history["roll"]).max()))

    @property
    def ratios(self) -> np.ndarray:
        return load_transfer_ratio(self.history.wheels("normal_force"))

    @property
    def largest_ratio(self) -> float:
        return float(np.abs(self.ratios).max())

    @property
    def inner_wheels_off(self) -> float:
        """When neither inner wheel carries anything any more (s), nan if never."""
        off = np.flatnonzero(np.abs(self.ratios) >= INNER_WHEELS_OFF)
        return float(self.history["time"][off[0]]) if len(off) else math.nan

    @property
    def warned(self) -> float:
        """The first warning (s) of the wheels that come off, nan if none."""
        off = self.history["time"] == self.inner_wheels_off
        side = "left" if (self.ratios[off] > 0.0).all() else "right"
        return min((time for time, warned in self.warnings if warned == side), default=math.nan)

    @property
    def two_wheel_lift(self) -> float:
        return two_wheel_lift(self.history)

    @property
    def rollover(self) -> float:
        over = np.abs(self.history["roll"][-1]) >= DEFAULT_ROLLOVER_ANGLE
        return float(self.history["time"][-1]) if over else math.nan

    def at(self, name: str, time):
        """A signal at a time (s) or at several, linear between samples."""
        return np.interp(time, self.history["time"], self.history[name])


def drive(scenario: Scenario, chain: Chain) -> Outcome:
    """Simulator, manoeuvre and controllers as processes in lockstep."""
    topics = ", ".join((*scenario.commands, chain.command))
    parameters = ("mode:=lockstep", f"lockstep_topics:=[{topics}]", *scenario.vehicle)
    processes = []
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryFile("w+") as said:
        rows = Path(folder) / "rows.csv"
        try:
            processes.append(start("simulator", *ros_arguments(parameters), stderr=said))
            for program, *own in chain.programs:
                words = [sys.executable, str(FOLDER / f"{program}.py"), *ros_arguments(own)]
                processes.append(subprocess.Popen(words, env=LOCAL | os.environ, stderr=said))
            words = (*scenario.manoeuvre, "--csv", str(rows))
            driver = start("manoeuvre", *words, stdout=subprocess.DEVNULL, stderr=said)
            processes.append(driver)
            status = driver.wait()
        finally:
            for process in reversed(processes):
                stop(process)
        said.seek(0)
        text = said.read()
        if status:
            raise RuntimeError(f"the manoeuvre ended with status {status}:\n{text}")
        warnings = tuple((float(time), side) for time, side in WARNED.findall(text))
        history = History.read_csv(rows)
    return Outcome(history, warnings)


def ros_arguments(parameters) -> list[str]:
    return ["--ros-args", *(word for each in parameters for word in ("-p", each))]


def row(controller: str, manoeuvre: str, without: Outcome, found: Outcome) -> list[str]:
    """Cells of the table, without the controller and with it, up to the rollover without it."""
    end = without.rollover
    pairs = (
        (f"{without.peak_roll:.1f}", f"{found.peak_roll:.1f}°"),
        (f"{without.largest_ratio:.2f}", f"{found.largest_ratio:.2f}"),
        (moment(without.two_wheel_lift), moment(found.two_wheel_lift)),
        (moment(without.rollover), moment(found.rollover)),
    )
    path = (
        f"{apart(without, found):.1f} m",
        f"{without.at('y', end):.1f} → {found.at('y', end):.1f} m",
        f"{without.at('u', end):.1f} → {found.at('u', end):.1f} m/s",
    )
    return [f"`{controller}`", manoeuvre, *(" → ".join(pair) for pair in pairs), *path]


def apart(without: Outcome, found: Outcome) -> float:
    """The largest distance (m) between the places at the same time, until the rollover without."""
    times = without.history["time"]  # its last row is that of the rollover, within a period
    x, y = (found.at(name, times) - without.history[name] for name in ("x", "y"))
    return float(np.hypot(x, y).max())


def warning_line(manoeuvre: str, without: Outcome) -> str:
    """How long before what the warning comes."""
    leads = (
        ("neither inner wheel carries anything", without.inner_wheels_off),
        ("the two-wheel lift", without.two_wheel_lift),
        ("the rollover", without.rollover),
    )
    text = ", ".join(f"{time - without.warned:.2f} s before {what}" for what, time in leads)
    return f"- {manoeuvre}: `rollover_warning` at {without.warned:.2f} s: {text}"


def moment(time: float) -> str:
    return "none" if math.isnan(time) else f"{time:.2f} s"


def compare(manoeuvre: str) -> tuple[list[list[str]], str]:
    """Rows of the table for one manoeuvre, and the line on the warning."""
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
    """A text with the table and the lines below it brought up to date."""
    before, header, rest = text.partition("| " + " | ".join(HEADER) + " |")
    if not header:
        raise SystemExit("compare.py: error: no table to bring up to date")
    return before + table + "\n\n" + rest.split("\n\n", 2)[2]


def main(words: list[str]) -> None:
    os.environ.setdefault("ROS_DOMAIN_ID", str(1 + os.getpid() % 100))
    compile_model()
    found = [compare(manoeuvre) for manoeuvre in SCENARIOS]
    rows = [cells for own, _ in found for cells in own]
    table = as_table(rows, [line for _, line in found])
    print(table)
    for file in map(Path, words):
        file.write_text(replaced(file.read_text(encoding="utf-8"), table), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
