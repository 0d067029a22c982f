"""The rows of a run: the documented columns, and a CSV file that keeps every bit."""

import csv
import errno
import struct

import numpy as np
import pytest
from signals import turn

from vehicle_roll_sim import WHEELS, InputError
from vehicle_roll_sim.runs.columns import COLUMNS, row_of
from vehicle_roll_sim.runs.history import History

PROMISED = [
    *("time", "x", "y", "z", "roll", "pitch", "yaw"),
    *("u", "v", "w", "roll_rate", "pitch_rate", "yaw_rate"),
    *("suspension_compression_lf", "suspension_compression_rf"),
    *("suspension_compression_lr", "suspension_compression_rr"),
    *("tire_compression_lf", "tire_compression_rf", "tire_compression_lr", "tire_compression_rr"),
    *("unsprung_velocity_lf", "unsprung_velocity_rf"),
    *("unsprung_velocity_lr", "unsprung_velocity_rr"),
    *("wheel_speed_lf", "wheel_speed_rf", "wheel_speed_lr", "wheel_speed_rr"),
    *("normal_force_lf", "normal_force_rf", "normal_force_lr", "normal_force_rr"),
    *("longitudinal_force_lf", "longitudinal_force_rf"),
    *("longitudinal_force_lr", "longitudinal_force_rr"),
    *("lateral_force_lf", "lateral_force_rf", "lateral_force_lr", "lateral_force_rr"),
    *("slip_ratio_lf", "slip_ratio_rf", "slip_ratio_lr", "slip_ratio_rr"),
    *("slip_angle_lf", "slip_angle_rf", "slip_angle_lr", "slip_angle_rr"),
    *("steering", "longitudinal_acceleration", "lateral_acceleration"),
]
FROM_OUTPUTS = (
    *("normal_force", "longitudinal_force", "lateral_force"),
    *("slip_ratio", "slip_angle"),
)
AWKWARD = (float("nan"), -0.0, 5e-324, 1.7976931348623157e308, 0.1, 1 / 3, -1e-17, 1e16, 2.0**53)


@pytest.fixture
def history() -> History:
    """Rows of arbitrary doubles, including special values."""
    size = 50 * len(COLUMNS)
    numbers = np.frombuffer(np.random.default_rng(1).bytes(8 * size))
    numbers = np.where(np.isfinite(numbers), numbers, 1.0)
    numbers[: len(AWKWARD)] = AWKWARD
    return History(numbers.reshape(50, -1))


def bits(values) -> list[bytes]:
    return [struct.pack("<d", value) for value in values]


def test_the_columns_are_those_of_the_interface_in_their_order():
    assert list(COLUMNS) == PROMISED


def test_a_row_has_every_value_under_its_name(simulation):
    simulation.step(turn(4.0), 0.7)
    row = dict(zip(PROMISED, row_of(simulation), strict=True))
    state, outputs = simulation.state, simulation.outputs
    assert row["time"] == simulation.time == pytest.approx(0.7, rel=1e-15)  # one rounding
    for name in PROMISED[1:13]:
        assert row[name] == state[name]
    for name in PROMISED[13:29]:
        quantity, _, wheel = name.rpartition("_")
        assert row[name] == state[quantity][WHEELS.index(wheel)]
    for quantity in FROM_OUTPUTS:
        for i, wheel in enumerate(WHEELS):
            assert row[f"{quantity}_{wheel}"] == outputs[quantity][i]
    assert row["steering"] == outputs.steering[0] != 0.0
    assert row["longitudinal_acceleration"] == outputs.acceleration[0]
    assert row["lateral_acceleration"] == outputs.acceleration[1]


COMMANDS_PROMISED = [
    "rear_steering",
    *("wheel_torque_lf", "wheel_torque_rf", "wheel_torque_lr", "wheel_torque_rr"),
    *("brake_torque_lf", "brake_torque_rf", "brake_torque_lr", "brake_torque_rr"),
    *("active_force_lf", "active_force_rf", "active_force_lr", "active_force_rr"),
]


def test_commands_come_behind_the_columns_where_they_are_asked_for_and_are_read_again(
    history, tmp_path
):
    plain, more = tmp_path / "plain.csv", tmp_path / "more.csv"
    history.rows[:, 0] = np.arange(50.0)
    history.write_csv(plain)
    history.commands = np.random.default_rng(2).normal(size=(50, len(COMMANDS_PROMISED)))
    history.write_csv(more, with_commands=True)
    assert plain.read_text() == "".join(
        line.rsplit(",", len(COMMANDS_PROMISED))[0] + "\n" for line in more.read_text().splitlines()
    )
    assert more.read_text().splitlines()[0].split(",")[len(COLUMNS) :] == COMMANDS_PROMISED
    found = History.read_csv(more)
    assert bits(found.rows.flat) == bits(history.rows.flat)
    for place, name in enumerate(COMMANDS_PROMISED):
        assert bits(found.command(name)) == bits(history.commands[:, place])
    assert bits(found.command("brake_torque").flat) == bits(history.commands[:, 5:9].flat)
    assert found.part(found["time"] < 2.0).commands.shape == (2, len(COMMANDS_PROMISED))
    history.write_csv(plain)
    assert History.read_csv(plain).commands is None
    assert np.isnan(History.read_csv(plain).command("wheel_torque")).all()


def test_unknown_commands_are_nan_in_the_file(history, tmp_path):
    history.rows[:, 0] = np.arange(50.0)
    history.write_csv(tmp_path / "more.csv", with_commands=True)
    assert np.isnan(History.read_csv(tmp_path / "more.csv").commands).all()


def test_a_row_is_a_copy_that_the_next_step_leaves_alone(simulation):
    row = row_of(simulation)
    before = row.copy()
    simulation.step(turn(4.0), 0.7)
    np.testing.assert_array_equal(row, before)


def test_columns_are_found_by_name_and_those_of_the_wheels_together(history):
    assert bits(history["roll"]) == bits(history.rows[:, PROMISED.index("roll")])
    loads = history.wheels("normal_force")
    assert loads.shape == (50, 4)
    for i, wheel in enumerate(WHEELS):
        column = PROMISED.index(f"normal_force_{wheel}")
        assert bits(loads[:, i]) == bits(history.rows[:, column])


def test_a_csv_file_gives_every_bit_back(history, tmp_path):
    path = tmp_path / "run.csv"
    history.write_csv(path)
    with path.open(newline="") as file:
        header, *rows = csv.reader(file)
    assert header == PROMISED
    read = [[float(text) for text in row] for row in rows]
    assert [bits(row) for row in read] == [bits(row) for row in history.rows]
    assert rows[0][0] == "nan"


def test_a_csv_file_has_one_line_for_each_row_and_ends_with_a_line_feed(history, tmp_path):
    history.write_csv(tmp_path / "run.csv")
    content = (tmp_path / "run.csv").read_bytes()
    assert content.count(b"\n") == 51
    assert content.endswith(b"\n")
    assert b"\r" not in content


class FullDisk:
    """Rows of which only the first fits on the disk."""

    def tolist(self):
        yield [1.0] * len(COLUMNS)
        raise OSError(errno.ENOSPC, "No space left on device")


@pytest.mark.parametrize("before", [{}, {"run.csv": b"old"}], ids=["new", "existing"])
def test_on_failure_no_file_is_left_and_an_old_one_stays(history, tmp_path, before):
    for name, content in before.items():
        (tmp_path / name).write_bytes(content)
    history.rows = FullDisk()
    with pytest.raises(InputError, match="No space"):
        history.write_csv(tmp_path / "run.csv")
    assert {file.name: file.read_bytes() for file in tmp_path.iterdir()} == before


def test_what_was_written_is_read_back_bit_for_bit(history, tmp_path):
    history.rows[:, 0] = np.arange(50) / 7
    history.write_csv(tmp_path / "run.csv")
    read = History.read_csv(tmp_path / "run.csv")
    assert [bits(row) for row in read.rows] == [bits(row) for row in history.rows]


def test_a_time_may_come_twice_but_not_fall(history, tmp_path):
    history.rows[:, 0] = np.arange(50)
    history.rows[49, 0] = 48
    history.write_csv(tmp_path / "run.csv")
    assert len(History.read_csv(tmp_path / "run.csv").rows) == 50
    history.rows[49, 0] = 47
    history.write_csv(tmp_path / "run.csv")
    with pytest.raises(InputError, match=r"line 51: time: 47\.0 .*at least 48\.0"):
        History.read_csv(tmp_path / "run.csv")
