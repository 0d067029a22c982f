"""The result of a run: columns with units, events, how it ended, and output files."""

import dataclasses
from pathlib import Path

import numpy as np

from vehicle_roll_sim.analysis.figure_size import Size, named_size
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.output_file import check_figure_format
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.offline.tables import data_frame, known, path_of, structured
from vehicle_roll_sim.runs.columns import COLUMNS, UNITS
from vehicle_roll_sim.runs.derived_signals import SIGNALS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run_metrics import metrics_of
from vehicle_roll_sim.runs.summary import line, summary_lines
from vehicle_roll_sim.simulation.road import Road


@dataclasses.dataclass(frozen=True)
class RunResult:
    """The result of a run; `result["roll"]` is a column, shape (rows,), in SI units and radians.

    So is `result["sideslip_angle"]`, and so are all SIGNALS of `runs.derived_signals`, although
    they are not among `columns`.

    manoeuvre: as driven, completed for the vehicle. history: all rows. events: EVENTS record with
    lift-off and rollover times (s, nan for never) and peaks. condition: RUNNING if the run was
    completed, else why it stopped. time: end of the run (s). implausible: the state that diverged,
    or None. report: results of the manoeuvre, text by label. road: on which it was driven. columns,
    units: names of the columns, and their units by name.
    """

    manoeuvre: Manoeuvre
    history: History
    events: np.record
    condition: Condition
    time: float
    implausible: str | None
    report: dict[str, str]
    road: Road | None = None

    columns = COLUMNS
    units = UNITS

    def __getitem__(self, name: str) -> np.ndarray:
        place = known(name, (*COLUMNS, *SIGNALS))
        if place < len(COLUMNS):
            return self.history.rows[:, place]
        return self.history.signals()[:, place - len(COLUMNS)]

    def __len__(self) -> int:
        return len(self.history.rows)

    def wheels(self, quantity: str) -> np.ndarray:
        """A quantity at all wheels (lf, rf, lr, rr), shape (rows, 4)."""
        return np.column_stack([self[f"{quantity}_{wheel}"] for wheel in WHEELS])

    @property
    def summary(self) -> str:
        """The summary that the command prints, without the lines on output files."""
        report = [line(label, text) for label, text in self.report.items()]
        end = summary_lines(self.events, self.time, self.condition, self.implausible)
        return "\n".join([*report, *end])

    @property
    def metrics(self) -> dict[str, float]:
        """Metrics of the run by name, in SI units and radians; times (s) are nan for never.

        Peaks are signed values of the largest magnitude. Those of roll and lateral acceleration are
        taken over all integration steps, that of the load transfer ratio (-1 to 1) and the time of
        the two-wheel lift over the rows.
        """
        return metrics_of(self.history, self.events, self.time)

    def to_numpy(self) -> np.ndarray:
        """All rows as a structured array, shape (rows,), with a float64 field for each column."""
        return structured(COLUMNS, list(self.history.rows.T))

    def to_pandas(self):
        """All rows as a pandas DataFrame, units in `.attrs["units"]`; requires pandas."""
        return data_frame(self.to_numpy(), UNITS)

    def write_csv(
        self, path: str | Path, with_commands: bool = False, with_signals: bool = False
    ) -> None:
        """Write all rows in full precision, like --csv, --with-commands and --with-signals."""
        self.history.write_csv(path_of(path, "path"), with_commands, with_signals)

    def plot(self, path: str | Path, title: str = "", size: Size | str | None = None) -> None:
        """Write the standard figure (PNG, SVG or PDF, by the suffix of `path`).

        size: size of the figure, a Size or a text such as "170x200" (mm); by default one for the
        screen. Raises InputError for an invalid argument.
        """
        if not isinstance(title, str):
            raise InputError("title", title, "a text")
        size = size if isinstance(size, Size) else named_size(size, "size")
        path = path_of(path, "path")
        check_figure_format(path, "path")
        from vehicle_roll_sim.analysis import plots  # matplotlib: half a second

        plots.plot_run(self.history, self.events, path, title, size, self.road)
