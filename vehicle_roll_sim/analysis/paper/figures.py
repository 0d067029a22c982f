"""The figures of the source, drawn anew, with the data that is in them."""

import csv
import dataclasses
import math
from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.metrics import load_transfer_ratio
from vehicle_roll_sim.analysis.paper.study import (
    ENGINE,
    J_TURN,
    NO_ROLL_CENTRE,
    RAMP_STEER,
    SAME_AS_ENGINE,
    STEP_STEER,
    UPRIGHT_TIRES,
    Response,
    Study,
)
from vehicle_roll_sim.analysis.plots import KILO, PANELS, new_figure, save_figure
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.model.roll_plane import RollPlane
from vehicle_roll_sim.vehicle.parameters import GRAVITY

LOADS = tuple((f"normal_force_{wheel}", f"{wheel} load\n(kN)", 1 / KILO) for wheel in WHEELS)
DATA = ("time", *(name for name, _, _ in (*PANELS, *LOADS)))
"""Columns of the data; SI units and radians."""
EVERY = 10
"""Rows of a run of which one goes into the data: 10 ms."""
IN_WORDS = {STEP_STEER: "step steer", RAMP_STEER: "ramp steer", J_TURN: "J-turn"}
MULTIBODY_CASES = ("1", SAME_AS_ENGINE, ENGINE)
COLOURS = ("black", "tab:orange", "tab:blue")
STYLES = ("-", "-", "--")


@dataclasses.dataclass(frozen=True)
class PaperFigure:
    """A figure of the source: its number, one manoeuvre, several models, two columns of panels."""

    number: int
    manoeuvre: str
    cases: tuple[str, ...]
    columns: tuple = (PANELS, LOADS)

    @property
    def name(self) -> str:
        return f"figure_{self.number:02}"

    @property
    def title(self) -> str:
        return f"Figure {self.number}: {IN_WORDS[self.manoeuvre]} (o lift-off, x 85° of roll)"


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
"""All but 1 to 5 and 16, which are drawings."""
ROLL_PLANE = "roll_plane"


def in_words(case: str) -> str:
    """A case in a legend; the bare name of a model is too short for one."""
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
    drawing.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    drawing.suptitle(figure.title)
    save_figure(drawing, folder / f"{figure.name}.png")
    _write_data(folder / f"{figure.name}.csv", responses)


def _draw_panel(axis, panel: tuple, responses: dict[str, Response]) -> None:
    """One signal of all cases, with lift-offs where it is a load, the rollover where it is roll."""
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


def _write_data(path: Path, responses: dict[str, Response]) -> None:
    """One row for every 10 ms of every case, and its last row."""
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(("model", *DATA))
        for case, response in responses.items():
            columns = np.column_stack([response.history[name] for name in DATA])
            last = len(columns) - 1
            for row in columns[[*range(0, last, EVERY), last]].tolist():
                table.writerow((case, *map(repr, row)))


def draw_roll_plane(study: Study, folder: Path) -> None:
    """Load transfer over lateral acceleration: the roll-plane models and the ramp steer."""
    drawing = new_figure(8.0, 5.0)
    axis = drawing.subplots()
    acceleration = np.linspace(0.0, 1.2, 121)
    for suspended, label in ((False, "rigid roll plane"), (True, "suspended roll plane")):
        model = RollPlane(study.vehicle.record(), suspended)
        ratio = model.load_transfer_ratio(acceleration * GRAVITY)
        axis.plot(acceleration, ratio, "--", label=label)
    for case in ("1", "8dof"):
        response = study.ramp(case)
        until = response.time <= response.first_lift_off
        lateral = response.history["lateral_acceleration"][until] / GRAVITY
        ratio = load_transfer_ratio(response.loads[until])
        axis.plot(lateral, ratio, label=f"{in_words(case)}, ramp steer up to lift-off")
    axis.set_xlabel("lateral acceleration (g)")
    axis.set_ylabel("load transfer ratio")
    axis.grid(alpha=0.3)
    axis.legend()
    save_figure(drawing, folder / f"{ROLL_PLANE}.png")
