"""What a run was: its columns with units, its events, how it ended, and the files made of it."""

import dataclasses
import math
from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.figure_size import Size, named_size
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.output_file import check_figure_format
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.model.integration.events import TIME, VALUE, Condition
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.offline.tables import data_frame, known, path_of, structured
from vehicle_roll_sim.runs.history import COLUMNS, UNITS, History
from vehicle_roll_sim.runs.metrics import load_transfer_ratio, peak
from vehicle_roll_sim.runs.summary import line, summary_lines


@dataclasses.dataclass(frozen=True)
class RunResult:
    """A run that is over; result["roll"] is a column, shape (rows,), in SI units and radians.

    manoeuvre: what was driven, sized to the vehicle. history: all rows. events: an EVENTS record:
    lift-off and rollover times (s, nan for never), peaks. condition: RUNNING of a run that went
    to its end, else why it stopped; time: when it ended (s); implausible: the state that diverged,
    or None. report: what the manoeuvre is driven for, label and text. columns, units: names of the
    columns and the unit of each.
    """

    manoeuvre: Manoeuvre
    history: History
    events: np.record
    condition: Condition
    time: float
    implausible: str | None
    report: dict[str, str]

    columns = COLUMNS
    units = UNITS

    def __getitem__(self, name: str) -> np.ndarray:
        return self.history.rows[:, known(name, COLUMNS)]

    def __len__(self) -> int:
        return len(self.history.rows)

    def wheels(self, quantity: str) -> np.ndarray:
        """A quantity of all wheels, lf, rf, lr, rr: shape (rows, 4)."""
        return np.column_stack([self[f"{quantity}_{wheel}"] for wheel in WHEELS])

    @property
    def summary(self) -> str:
        """The lines that the command prints, without those of files."""
        report = [line(label, text) for label, text in self.report.items()]
        end = summary_lines(self.events, self.time, self.condition, self.implausible)
        return "\n".join([*report, *end])

    @property
    def metrics(self) -> dict[str, float]:
        """The numbers of the run by name, SI units and radians; times (s) are nan for never.

        Peaks of roll and lateral acceleration are those of every step, that of the load transfer
        ratio (-1 to 1) of the rows. Peaks have the largest magnitude, with its sign.
        """
        roll, acceleration = self.events.peak_roll, self.events.peak_lateral_acceleration
        ratio, ratio_time = peak(self["time"], load_transfer_ratio(self.wheels("normal_force")))
        lift_offs = zip(WHEELS, self.events.lift_off_time.tolist(), strict=True)
        return {
            "peak_roll": float(roll[VALUE]),
            "peak_roll_time": float(roll[TIME]) if roll[VALUE] else math.nan,
            "peak_lateral_acceleration": float(acceleration[VALUE]),
            "peak_lateral_acceleration_time": (
                float(acceleration[TIME]) if acceleration[VALUE] else math.nan
            ),
            "peak_load_transfer_ratio": ratio,
            "peak_load_transfer_ratio_time": ratio_time,
            **{f"lift_off_time_{wheel}": time for wheel, time in lift_offs},
            "rollover_time": float(self.events.rollover_time[0]),
            "end_time": self.time,
        }

    def to_numpy(self) -> np.ndarray:
        """All rows as a structured array, shape (rows,): a float64 field for each column."""
        return structured(COLUMNS, list(self.history.rows.T))

    def to_pandas(self):
        """All rows as a pandas DataFrame, units in `.attrs["units"]`; needs the package pandas."""
        return data_frame(self.to_numpy(), UNITS)

    def write_csv(self, path: str | Path, with_commands: bool = False) -> None:
        """Write all rows in full precision, as the command's --csv and --with-commands do."""
        self.history.write_csv(path_of(path, "path"), with_commands)

    def plot(self, path: str | Path, title: str = "", size: Size | str | None = None) -> None:
        """Draw the standard figure (PNG, SVG or PDF); raises InputError for what it cannot be.

        size: of the figure, a Size or a text such as "170x200" (mm); that of the screen if there is
        none.
        """
        if not isinstance(title, str):
            raise InputError("title", title, "a text")
        size = size if isinstance(size, Size) else named_size(size, "size")
        path = path_of(path, "path")
        check_figure_format(path, "path")
        from vehicle_roll_sim.analysis import plots  # matplotlib: half a second

        plots.plot_run(self.history, self.events, path, title, size)
