"""What sensors measure joins the rows of a run, however it is made."""

import numpy as np
import pytest
from measured import measured

from vehicle_roll_sim import Batch, Simulation, run
from vehicle_roll_sim.runs.compiled_run import compiled_run
from vehicle_roll_sim.runs.history import History

ABOUT = {"speed": 18.0, "duration": 1.5}
CAR = measured("suv")


@pytest.fixture(scope="module")
def histories():
    """Of fishhooks: one that is simply run, one with a bag's periods, and one of a batch."""
    plain = run("nhtsa_fishhook", CAR, **ABOUT).history
    held = run("nhtsa_fishhook", CAR, command_period=0.01, **ABOUT).history
    batch = Batch(CAR, manoeuvre="nhtsa_fishhook", **ABOUT).run(histories=True).histories[0]
    return plain, held, batch


def test_every_way_of_running_has_the_same_measurements(histories):
    plain, *others = histories
    assert len(plain.measured_names) == 31
    for other in others:
        assert other.measured_names == plain.measured_names
        np.testing.assert_array_equal(other.measured, plain.measured)
        np.testing.assert_array_equal(other.rows, plain.rows)


def test_rows_have_the_last_reading_and_a_part_of_a_history_its_rows(histories):
    """Wheel speeds are measured every 3 ms, rows are 10 ms apart: of samples 2, 1 and 0 ms old."""
    history = histories[0]
    first = history.measured_names.index("measured_wheel_speed_lf")
    noise = history.measured[:, first] - 1.01 * history["wheel_speed_lf"]
    deviation = 0.01 / np.sqrt(0.003)
    assert 0.7 * deviation < noise.std() < 1.3 * deviation  # 150 values, and braking meanwhile
    chosen = history["time"] > 1.0
    np.testing.assert_array_equal(history.part(chosen).measured, history.measured[chosen])


def test_the_csv_ends_with_the_measurements(histories, tmp_path):
    path = tmp_path / "run.csv"
    histories[0].write_csv(path, with_commands=True)
    header, *lines = path.read_text().splitlines()
    names = histories[0].measured_names
    assert tuple(header.split(",")[-len(names) :]) == names
    last = [float(text) for text in lines[-1].split(",")[-len(names) :]]
    assert last == histories[0].measured[-1].tolist()
    np.testing.assert_array_equal(History.read_csv(path).rows, histories[0].rows)


def test_a_compiled_run_leaves_the_simulation_with_its_present_readings():
    simulations = [Simulation(CAR), Simulation(CAR)]

    def straight(times):
        from vehicle_roll_sim import Command

        return Command(steering=0.05).records()

    compiled_run(simulations[0], straight, 0.2)
    simulations[1].step(straight, 0.2)
    found = [each.sensors.readings() for each in simulations]
    np.testing.assert_array_equal(*found)
