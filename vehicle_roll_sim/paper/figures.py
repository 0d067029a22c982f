"""The figures of the paper, reproduced, with their data."""

import csv
import dataclasses
import math
from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.drawing import add_legend, new_figure, save_figure
from vehicle_roll_sim.analysis.panels import PANELS
from vehicle_roll_sim.analysis.plots import KILO
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.model.roll_plane import RollPlane
from vehicle_roll_sim.paper.study import (
    ENGINE,
    J_TURN,
    NO_ROLL_CENTRE,
    RAMP_STEER,
    SAME_AS_ENGINE,
    STEP_STEER,
    TRANSIENT,
    UPRIGHT_TIRES,
    Response,
    Study,
)
from vehicle_roll_sim.runs.metrics import load_transfer_ratio
from vehicle_roll_sim.vehicle.derived_values import GRAVITY

LOADS = tuple((f"normal_force_{wheel}", f"{wheel} load\n(kN)", 1 / KILO) for wheel in WHEELS)
DATA = ("time", *(name for name, _, _ in (*PANELS, *LOADS)))
"""Columns of the data: SI units and radians."""
EVERY = 10
"""Every tenth row of a run (10 ms) is written to the data."""
IN_WORDS = {STEP_STEER: "step steer", RAMP_STEER: "ramp steer", J_TURN: "J-turn"}
MULTIBODY_CASES = ("1", SAME_AS_ENGINE, ENGINE)
COLOURS = ("black", "tab:orange", "tab:blue")
STYLES = ("-", "-", "--")


@dataclasses.dataclass(frozen=True)
class PaperFigure:
    """A figure of the paper: its number, one manoeuvre, several models, columns of panels.

    Number 0 is a figure that the paper does not have, on tire lag.
    """

    number: int
    manoeuvre: str
    cases: tuple[str, ...]
    columns: tuple = (PANELS, LOADS)

    @property
    def name(self) -> str:
        return f"figure_{self.number:02}" if self.number else "transient_slip"

    @property
    def title(self) -> str:
        marks = "o lift-off, x 85° of roll" if PANELS in self.columns else "o lift-off"
        figure = f"Figure {self.number}" if self.number else "Lag of the tires"
        return f"{figure}: {IN_WORDS[self.manoeuvre]} ({marks})"


FIGURES = (
    PaperFigure(6, J_TURN, MULTIBODY_CASES),
    PaperFigure(7, J_TURN, MULTIBODY_CASES, (LOADS[::2], LOADS[1::2])),
    PaperFigure(8, STEP_STEER, ("1", "1a", "1b")),
    PaperFigure(9, RAMP_STEER, ("1", "1a", "1b")),
    PaperFigure(10, STEP_STEER, ("1b", "1c-i", "1c-ii")),
    PaperFigure(11, RAMP_STEER, ("1b", "1c-i", "1c-ii")),
    PaperFigure(12, STEP_STEER, ("1b", "1c-iii", "1c-iv")),
    PaperFigure(13, RAMP_STEER, ("1b", "1c-iii", "1c-iv")),
    PaperFigure(14, STEP_STEER, ("1", NO_ROLL_CENTRE, UPRIGHT_TIRES)),
    PaperFigure(15, RAMP_STEER, ("1", NO_ROLL_CENTRE, UPRIGHT_TIRES)),
    PaperFigure(17, STEP_STEER, ("1", "8dof")),
    PaperFigure(18, RAMP_STEER, ("1", "8dof")),
)
"""All figures with results; 1 to 5 and 16 are drawings."""
LAG = PaperFigure(0, STEP_STEER, ("1", TRANSIENT))
ROLL_PLANE = "roll_plane"


def in_words(case: str) -> str:
    """The name of a case in a legend; `model` precedes the bare name of a model."""
    return f"model {case}" if case[0].isdigit() else case


def draw(figure: PaperFigure, study: Study, folder: Path) -> None:
    """Write a figure as PNG and its data as CSV into `folder`."""
    present = [case for case in figure.cases if (figure.manoeuvre, case) in study.runs]
    responses = {case: study.response(figure.manoeuvre, case) for case in present}
    rows = len(figure.columns[0])
    drawing = new_figure(11.0, 1.0 + 2.2 * rows)
    axes = drawing.subplots(rows, len(figure.columns), sharex=True, squeeze=False)
    for place, panels in enumerate(figure.columns):
        for axis, panel in zip(axes[:, place], panels, strict=True):
            _draw_panel(axis, panel, responses)
        axes[-1, place].set_xlabel("time (s)")
    add_legend(drawing, list(zip(*axes[0, 0].get_legend_handles_labels(), strict=True)))
    drawing.suptitle(figure.title)
    save_figure(drawing, folder / f"{figure.name}.png")
    samples = {case: _samples(response) for case, response in responses.items()}
    write_table(folder / f"{figure.name}.csv", ("model", *DATA), samples)


def _draw_panel(axis, panel: tuple, responses: dict[str, Response]) -> None:
    """Draw one signal of all cases; mark lift-offs in loads and the rollover in the roll angle."""
    name, label, scale = panel
    for (case, response), colour, style in zip(responses.items(), COLOURS, STYLES, strict=False):
        signal = response.history[name] * scale
        axis.plot(response.time, signal, style, color=colour, linewidth=1.2, label=in_words(case))
        if panel in LOADS:
            axis.plot(response.lift_offs[LOADS.index(panel)], 0.0, "o", color=colour, markersize=5)
        if name == "roll" and not math.isnan(response.rollover):
            axis.plot(response.time[-1], signal[-1], "x", color=colour)
    axis.set_ylabel(label)
    axis.grid(alpha=0.3)


def _samples(response: Response) -> list[np.ndarray]:
    """DATA columns every 10 ms and at the end."""
    last = len(response.time) - 1
    return [response.history[name][[*range(0, last, EVERY), last]] for name in DATA]


def write_table(path: Path, header: tuple[str, ...], curves: dict) -> None:
    """Write the rows of all curves one after the other, with their names in the first column."""
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(header)
        for name, columns in curves.items():
            for row in np.column_stack(columns).tolist():
                table.writerow((name, *map(repr, row)))


def load_transfer_curves(study: Study) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Lateral acceleration (m/s^2) and load transfer ratio: roll-plane models, and ramp steer."""
    acceleration, curves = np.linspace(0.0, 12.0, 121), {}
    for suspended, label in ((False, "rigid roll plane"), (True, "suspended roll plane")):
        model = RollPlane(study.vehicle.record(), suspended)
        curves[label] = acceleration, model.load_transfer_ratio(acceleration)
    for case in ("1", "8dof"):
        response = study.ramp(case)
        until = response.time <= response.first_lift_off
        lateral = response.history["lateral_acceleration"][until]
        curves[f"{in_words(case)}, ramp steer up to lift-off"] = (
            lateral,
            load_transfer_ratio(response.loads[until]),
        )
    return curves


def draw_roll_plane(study: Study, folder: Path) -> None:
    """Write load transfer over lateral acceleration, as PNG and CSV, into `folder`."""
    drawing = new_figure(8.0, 5.0)
    axis = drawing.subplots()
    curves = load_transfer_curves(study)
    for label, (acceleration, ratio) in curves.items():
        axis.plot(acceleration / GRAVITY, ratio, "--" if "plane" in label else "-", label=label)
    header = ("model", "lateral_acceleration", "load_transfer_ratio")
    write_table(folder / f"{ROLL_PLANE}.csv", header, curves)
    axis.set_xlabel("lateral acceleration (g)")
    axis.set_ylabel("load transfer ratio")
    axis.grid(alpha=0.3)
    axis.legend()
    save_figure(drawing, folder / f"{ROLL_PLANE}.png")
