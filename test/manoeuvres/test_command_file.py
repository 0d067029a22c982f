"""Command files: read correctly, or refused in one line that names file and line."""

import math

import numpy as np
import pytest

from vehicle_roll_sim import WHEELS, Command, InputError, Simulation, preset
from vehicle_roll_sim.manoeuvres.command_file import load_commands
from vehicle_roll_sim.runs.run import run

FIELDS_OF_FOUR = ("wheel_torque", "brake_torque", "normal_force")
OF_FOUR = [f"{name}_{wheel}" for name in FIELDS_OF_FOUR for wheel in WHEELS]
COLUMNS = ["steering", "rear_steering", *OF_FOUR]
TABLE = "time,steering,wheel_torque_lr\n0.5,0.0,100\n1.0,0.2,300\n2.0,-0.2,300\n"


@pytest.fixture
def path(tmp_path):
    return tmp_path / "commands.csv"


@pytest.fixture
def commands_from(path):
    """Loads a command file with that content."""

    def load(content: str | bytes):
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return load_commands(path)

    return load


def column_of(commands: np.ndarray, name: str) -> np.ndarray:
    """The values of a column of the file among COMMAND records."""
    field, _, wheel = name.rpartition("_")
    return commands[field][:, WHEELS.index(wheel)] if wheel in WHEELS else commands[name]


@pytest.mark.parametrize(
    ("time", "steering", "torque"),
    [
        pytest.param(0.0, 0.0, 100.0, id="before the first row"),
        pytest.param(0.5, 0.0, 100.0, id="on the first row"),
        pytest.param(0.75, 0.1, 200.0, id="half-way"),
        pytest.param(0.8, 0.12, 220.0, id="three fifths"),
        pytest.param(1.0, 0.2, 300.0, id="on a row"),
        pytest.param(1.25, 0.1, 300.0, id="on the way back"),
        pytest.param(2.0, -0.2, 300.0, id="on the last row"),
        pytest.param(1e6, -0.2, 300.0, id="long after"),
    ],
)
def test_commands_are_linear_between_rows_and_held_outside(commands_from, time, steering, torque):
    command = commands_from(TABLE)(np.array([time]))[0]
    assert command.steering == pytest.approx(steering, abs=1e-16)  # last place of 0.2
    assert command.wheel_torque == pytest.approx([0.0, 0.0, torque, 0.0], rel=1e-15)


def test_every_column_drives_its_own_command_and_missing_ones_are_zero(commands_from):
    for name in COLUMNS:
        commands = commands_from(f"time,{name}\n0,7.5\n1,8.5\n")(np.array([0.0, 0.5, 1.0]))
        assert column_of(commands, name).tolist() == [7.5, 8.0, 8.5]
        for other in set(COLUMNS) - {name}:
            assert not np.any(column_of(commands, other))


def test_columns_may_come_in_any_order_with_spaces_and_empty_lines(commands_from):
    given = "rear_steering , time, steering\r\n\r\n 3, 0.0 ,1e0\r\n\r\n-4,1.0, +2\r\n\r\n"
    commands = commands_from(given)(np.array([0.0, 1.0]))
    assert commands["steering"].tolist() == [1.0, 2.0]
    assert commands["rear_steering"].tolist() == [3.0, -4.0]


def test_many_random_columns_are_interpolated_each_by_itself(commands_from):
    rng = np.random.default_rng(1)
    times = np.cumsum(rng.uniform(0.01, 1.0, 40))
    values = rng.normal(size=(40, len(COLUMNS)))
    for place, name in enumerate(COLUMNS):
        if name.startswith("brake_torque"):  # never below 0
            values[:, place] = np.abs(values[:, place])
    rows = [",".join(map(repr, row)) for row in np.column_stack([times, values]).tolist()]
    commands = commands_from("\n".join([",".join(["time", *COLUMNS]), *rows]))
    share, gaps = rng.uniform(0.0, 1.0, 39), np.diff(times)
    got = commands(times[:-1] + share * gaps)
    for name, column in zip(COLUMNS, values.T, strict=True):
        expected = (1.0 - share) * column[:-1] + share * column[1:]
        # times are rounded to 2e-15 s, slopes reach a few hundred per second
        np.testing.assert_allclose(column_of(got, name), expected, rtol=0, atol=1e-12)


def test_it_lasts_until_its_last_row_and_holds_no_speed_unless_told(commands_from):
    table = commands_from(TABLE)
    assert table.duration == 2.0
    assert table.speed == pytest.approx(50 / 3.6, rel=1e-15)
    assert table(np.zeros(1))[0].speed_hold_gain == 0.0


STEPS = "time,steering,wheel_torque_lr\n0.5,0.0,100\n0.5,0.1,100\n1.0,0.2,300\n1.0,0.0,500\n"


@pytest.mark.parametrize(
    ("time", "steering", "torque"),
    [
        (0.0, 0.0, 100.0),
        (0.5, 0.1, 100.0),
        (0.75, 0.15, 200.0),
        (1.0, 0.0, 500.0),
        (2.0, 0.0, 500.0),
    ],
)
def test_two_rows_of_one_time_are_a_step_to_the_second(commands_from, time, steering, torque):
    command = commands_from(STEPS)(np.array([time]))[0]
    assert command.steering == pytest.approx(steering, abs=1e-16)  # last place of 0.2
    assert command.wheel_torque[2] == pytest.approx(torque, rel=1e-15)


def test_an_integration_step_that_ends_at_a_step_ends_before_it(commands_from):
    table = commands_from(STEPS)
    assert table.steps_at == (0.5, 1.0)
    assert table(np.array([0.998, 0.999, 1.0]))["steering"][-1] == 0.2
    assert table(np.array([0.498, 0.499, 0.5]))["steering"].tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("at", ["0.2", "0.203", "0.20300000000000001", repr(0.1 + 0.1 + 0.003)])
@pytest.mark.parametrize("sample", [0.01, 0.05])
def test_a_run_with_a_step_is_that_of_two_held_commands(commands_from, at, sample):
    """To the bit: no integration step sees both sides of it, on a row of the run or between."""
    text = f"time,steering,wheel_torque_lr\n0,0.02,50\n{at},0.02,50\n{at},-0.03,-80\n1,-0.03,-80\n"
    driven, held = Simulation(preset()), Simulation(preset())
    run(driven, commands_from(text), 0.4, sample=sample)
    first = round(float(at), 9)
    held.step(Command(0.02, wheel_torque=(0.0, 0.0, 50.0, 0.0)), first)
    held.step(Command(-0.03, wheel_torque=(0.0, 0.0, -80.0, 0.0)), round(0.4 - first, 9))
    assert driven.state_vector.tolist() == held.state_vector.tolist()


def test_a_row_at_a_step_shows_the_command_before_it(commands_from):
    history = run(Simulation(preset()), commands_from("time,steering\n0.1,0\n0.1,0.02\n"), 0.2)
    assert history["steering"][9:12].tolist() == [0.0, 0.0, 0.02]


WRONG = {
    "no time column": ("t,steering\n0,0\n", 1, ["time"]),
    "unknown column": ("time,sterring\n0,0\n", 1, ["sterring", "did you mean steering"]),
    "wheel misspelt": ("time,wheel_torqe_rf\n0,0\n", 1, ["wheel_torqe_rf", "wheel_torque_rf"]),
    "column twice": ("time,steering,steering\n0,0,0\n", 1, ["steering", "once"]),
    "time twice": ("time,time\n0,0\n", 1, ["time", "once"]),
    "nameless column": ("time,\n0,0\n", 1, []),
    "text": ("time,steering\n0,0\n1,left\n", 3, ["steering", "left", "number"]),
    "digits apart": ("time,steering\n0,0\n1_0,0\n", 3, ["time", "1_0", "number"]),
    "no value": ("time,steering\n0,\n", 2, ["steering", "number"]),
    "decimal comma": ('time,steering\n0,0\n1,"0,5"\n', 3, ["steering", "0,5"]),
    "not a number": ("time,steering\n0,nan\n", 2, ["steering", "nan", "finite"]),
    "infinite": ("time,steering\n0,0\n1,0\n2,-inf\n", 4, ["steering", "-inf", "finite"]),
    "a brake that drives": (
        "time,brake_torque_lr\n0,0\n1,-1\n",
        3,
        ["brake_torque_lr", "-1", "at least 0"],
    ),
    "a wind like no other": (
        "time,wind_y\n0,0\n1,-1e300\n",
        3,
        ["wind_y", "-1e+300", "from -100 to 100 m/s"],
    ),
    "beyond doubles": ("time,steering\n0,1e999\n", 2, ["steering", "1e999", "finite"]),
    "infinite time": ("time,steering\n0,0\ninf,0\n", 3, ["time", "inf", "finite"]),
    "too few values": ("time,steering\n0,0\n1\n", 3, ["1 value:", "2 values"]),
    "too many values": ("time,steering\n0,0,0\n", 2, ["3 values", "2 values"]),
    "semicolons": (
        "time;steering\n0;0\n1;0,05\n",
        1,
        ["separated by semicolons", "must be separated by commas", "decimal points"],
    ),
    "semicolons, one column, and a mark": ("\ufefftime;x\r\n0;0\r\n", 1, ["semicolons", "commas"]),
    "semicolons behind a line that says so": ("sep=;\ntime;steering\n0;0\n", 1, ["semicolons"]),
    "tabs": ("time\tsteering\n0\t0\n", 1, ["separated by tabs", "commas"]),
    "spaces": ("time steering\n0 0\n", 1, ["separated by spaces", "commas"]),
    "decimal commas": ("time,steering\n0,0\n1,0,05\n", 3, ["3 values", "decimal points"]),
    "capitals": ("TIME,steering\n0,0\n", 1, ["TIME", "did you mean time?"]),
    "a unit in the name": ("time,steering (rad)\n0,0\n", 1, ["did you mean steering?"]),
    "time three times": ("time,steering\n0,0\n1,0\n1,1\n1,0\n", 5, ["time", "two rows", "step"]),
    "time that falls": ("time,steering\n0,0\n2,0\n1.5,0\n", 4, ["time", "1.5", "2"]),
    "after empty lines": ("time,steering\n0,0\n\n\n2,0\n1.5,0\n", 6, ["time", "1.5"]),
    "empty": ("", 1, ["time"]),
    "a picture's end": ("\x89PNG\r\n\x1a\n", 1, ["time"]),
    "zeros": (b"\0" * 1000, 1, ["time"]),
    "an endless value": (f"time,steering\n0,{'1' * 200_000}\n", 2, []),
}


def refused(load, path) -> str:
    """The one line with which a file is refused."""
    with pytest.raises(InputError) as refusal:
        load()
    message = str(refusal.value)
    assert str(path) in message
    assert len(message.splitlines()) == 1
    assert message.isprintable()
    assert "float64" not in message  # numbers, not how a library spells them
    return message


@pytest.mark.parametrize("case", WRONG)
def test_what_is_wrong_in_a_line_is_refused_by_file_and_line(commands_from, path, case):
    content, line, words = WRONG[case]
    message = refused(lambda: commands_from(content), path)
    assert f"line {line}" in message
    for word in words:
        assert word in message.replace(str(path), "")


@pytest.mark.parametrize(
    "content",
    [
        pytest.param("time,steering\n", id="only a header"),
        pytest.param("time,steering\n\n\n", id="a header and empty lines"),
        pytest.param(b"\xff\xfe\x00\x01", id="binary"),
    ],
)
def test_a_file_without_rows_or_text_is_refused_by_its_name(commands_from, path, content):
    refused(lambda: commands_from(content), path)


def test_a_file_that_is_not_there_or_a_folder_is_refused_by_its_name(tmp_path):
    refused(lambda: load_commands(tmp_path / "none.csv"), tmp_path / "none.csv")
    refused(lambda: load_commands(tmp_path), tmp_path)


def test_the_largest_finite_numbers_are_taken_as_they_are(commands_from):
    commands = commands_from("time,steering\n0,1e308\n1,-5e-324\n")(np.array([0.0, 1.0]))
    assert commands["steering"].tolist() == [1e308, -5e-324]
    assert all(map(math.isfinite, commands["steering"]))


def test_a_file_that_would_last_for_days_is_refused(commands_from, path):
    message = refused(lambda: commands_from("time,steering\n0,0\n1e9,0\n"), path)
    assert "line 3" in message
    assert "86400" in message
