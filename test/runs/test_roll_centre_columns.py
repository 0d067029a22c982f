"""The roll centres of model 2 in the history and the CSV of a run; other models have none."""

import numpy as np

from vehicle_roll_sim import Command, Options, Simulation, preset
from vehicle_roll_sim.files.table_file import read_table
from vehicle_roll_sim.runs.columns import COLUMNS, ROLL_CENTRES
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.command import Feedback


class Turn(Feedback):
    def command(self, time, state) -> Command:
        return Command(steering=0.05 if time > 0.5 else 0.0)


def history_of(model: str) -> History:
    simulation = Simulation(preset(), Options(model=model))
    return run(simulation, Turn(), 1.5)


def test_model_2_writes_them_after_the_other_columns(tmp_path):
    history, file = history_of("2"), tmp_path / "run.csv"
    history.write_csv(file)
    header, lines = read_table(file, 10_000_000)
    assert tuple(header) == (*COLUMNS, *ROLL_CENTRES)
    rows = np.array([[float(text) for text in texts] for _, texts in lines])
    np.testing.assert_array_equal(rows[:, len(COLUMNS) :], history.roll_centres)
    read = History.read_csv(file)
    np.testing.assert_array_equal(read.rows, history.rows)
    np.testing.assert_array_equal(read.roll_centres, history.roll_centres)
    at_rest = preset().roll_centre_height[[0, 2]]
    np.testing.assert_allclose(history.roll_centres[0, :2], at_rest, atol=1e-9)
    assert np.ptp(history.roll_centres[:, 0]) > 1e-3  # they move
    later = history.part(history["time"] > 1.0)
    assert len(later.roll_centres) == len(later.rows)


def test_model_1_does_not(tmp_path):
    history, file = history_of("1"), tmp_path / "run.csv"
    history.write_csv(file)
    assert history.roll_centres is None
    assert tuple(read_table(file, 10_000_000)[0]) == COLUMNS
