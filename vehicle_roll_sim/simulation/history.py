"""What a run was: one row of named signals for each sample, in memory and as CSV."""

from pathlib import Path

import numpy as np

from vehicle_roll_sim.model.records import MODEL_STATE_SIZE, WHEELS
from vehicle_roll_sim.simulation.output_file import replaced_file
from vehicle_roll_sim.simulation.simulation import STATE_NAMES, Simulation

OUTPUT_QUANTITIES = (
    "normal_force",
    "longitudinal_force",
    "lateral_force",
    "slip_ratio",
    "slip_angle",
)
ACCELERATIONS = ("longitudinal_acceleration", "lateral_acceleration")
COLUMNS = (
    "time",
    *STATE_NAMES[:MODEL_STATE_SIZE],
    *(f"{quantity}_{wheel}" for quantity in OUTPUT_QUANTITIES for wheel in WHEELS),
    "steering",
    *ACCELERATIONS,
)
"""Names of the columns; SI units and radians, forces and accelerations in frame 2."""


def row_of(simulation: Simulation) -> np.ndarray:
    """The columns at the present simulated time."""
    outputs = simulation.outputs
    return np.concatenate(
        (
            [simulation.time],
            simulation.state_vector[:MODEL_STATE_SIZE],
            *(outputs[quantity] for quantity in OUTPUT_QUANTITIES),
            outputs["steering"][:1],
            outputs["acceleration"][: len(ACCELERATIONS)],
        )
    )


class History:
    """Rows of `COLUMNS`; history["roll"] is a column, history.wheels("normal_force") four."""

    def __init__(self, rows: list[np.ndarray] | np.ndarray):
        self.rows = np.array(rows)

    def __getitem__(self, name: str) -> np.ndarray:
        return self.rows[:, COLUMNS.index(name)]

    def wheels(self, quantity: str) -> np.ndarray:
        """A quantity of all wheels, shape (rows, 4)."""
        first = COLUMNS.index(f"{quantity}_{WHEELS[0]}")
        return self.rows[:, first : first + len(WHEELS)]

    def write_csv(self, path: Path) -> None:
        """Write all rows in full precision; the file appears whole or not at all."""
        with replaced_file(path) as partial, partial.open("w", encoding="utf-8") as file:
            file.write(",".join(COLUMNS) + "\n")
            for row in self.rows.tolist():
                file.write(",".join(map(repr, row)) + "\n")
