"""Invalid input of `run`: status 2, one line with field and allowed values, no file."""

import pytest

NUMBERS = {
    "--amplitude": ("-60", "60", "deg"),
    "--rate": ("0.001", "100000", "deg/s"),
    "--start": ("0", "86400", "s"),
    "--speed": ("0", "100", "m/s"),
    "--duration": ("0", "86400", "s"),
    "--speed-hold": ("0", "1e+06", "N m s/m"),
    "--step": ("1e-06", "0.1", "s"),
    "--sample": ("1e-06", "1000", "s"),
    "--command-period": ("0", "1000", "s"),
    "--stop-roll": ("1", "90", "deg"),
    "--grade": ("-1", "1", "m/m"),
    "--bank": ("-1", "1", "m/m"),
}
"""Lowest and highest value, and unit."""
NO_NUMBERS = ("nan", "inf", "-inf", "fast", "", "1,5", "0x10", "1_0", "1٠")


def beyond(limits: tuple[str, str]) -> list[str]:
    """A number below the lowest, and one above the highest."""
    return [
        repr(float(limit) + direction * max(abs(float(limit)), 1.0) * 1e-3)
        for limit, direction in zip(limits, (-1, 1), strict=True)
    ]


@pytest.mark.parametrize("option", NUMBERS)
def test_a_value_that_is_no_number_in_the_range_is_refused(refused, option):
    low, high, unit = NUMBERS[option]
    for value in (*NO_NUMBERS, *beyond((low, high))):
        words = ("run", "step_steer", f"{option}={value}", "--csv", "rows.csv")
        line = refused(words, option, f"from {float(low):g} to {float(high):g} {unit}")
        assert value.strip("-0") in line


def test_with_steady_state_slip_a_speed_below_its_lowest_is_refused(refused):
    words = ("run", "step_steer", "--steady-state-slip", "--speed", "3.4", "--csv", "rows.csv")
    refused(words, "speed", "3.4", "from 3.5 to 100 m/s")


@pytest.mark.parametrize("option", ["--duration", "--sample", "--command-period"])
@pytest.mark.parametrize("value", ["0.0015", "1.00001"])
def test_a_time_that_is_no_multiple_of_the_step_is_refused(refused, option, value):
    field = option.strip("-").replace("-", " ")
    line = refused(("run", "step_steer", option, value, "--csv", "rows.csv"), value, "0.001 s")
    assert field in line.replace("-", " ")


def test_a_duration_of_zero_is_refused(refused):
    refused(("run", "step_steer", "--duration", "0", "--csv", "rows.csv"), "duration", "multiple")


@pytest.mark.parametrize("step", ["0.0007", "0.003"])
def test_a_step_of_which_the_other_times_are_no_multiples_is_refused(refused, step):
    refused(("run", "step_steer", "--step", step, "--csv", "rows.csv"), "multiple", step)


SET = {
    "no value": ("sprung_mass", ["NAME=VALUE"]),
    "empty value": ("sprung_mass=", ["sprung_mass", "from 0.01 to 1e+06 kg"]),
    "text": ("sprung_mass=heavy", ["sprung_mass", "heavy", "from 0.01 to 1e+06 kg"]),
    "not a number": ("front_track=nan", ["front_track", "nan", "from 0.01 to 50 m"]),
    "negative": ("rear_damping=-1", ["rear_damping", "-1", "from 0 to 1e+07 N s/m"]),
    "misspelt": ("sprungmass=1", ["sprungmass", "did you mean sprung_mass"]),
    "misspelt, no number": ("paylod=1", ["paylod", "did you mean payload?"]),
    "no name": ("=1", ["sprung_mass", "steering_ratio"]),
    "no body": ("roll_inertia=9000", ["roll_inertia", "9000", "4000 kg m^2"]),
    "pressure without effect": ("tire_pressure=2e5", ["tire_pressure", "200000", "version 5.2"]),
    "pressure in bar": ("rear_tire_pressure=2.3", ["rear_tire_pressure", "2.3", "10000"]),
    "camber in degrees": ("front_camber=-1.5", ["front_camber", "-1.5", "-0.5 to 0.5 rad"]),
    "lateral stiffness of nothing": (
        "front_tire_lateral_stiffness=1",
        ["front_tire_lateral", "1", "1000"],
    ),
    "on its rims": ("tire_radius=0.02", ["tire_radius", "0.02", "more than"]),
}


@pytest.mark.parametrize("case", SET)
def test_a_value_of_set_is_checked_like_one_of_a_vehicle_file(refused, case):
    assignment, words = SET[case]
    refused(("run", "step_steer", "--set", assignment, "--csv", "rows.csv"), "--set", *words)


def test_of_two_values_of_set_for_one_name_none_is_taken(refused):
    words = ("--set", "sprung_mass=1500", "--set", "sprung_mass=1600")
    refused(("run", "step_steer", *words), "--set sprung_mass", "twice")


def test_of_several_values_of_set_each_is_checked(refused):
    words = ("run", "step_steer", "--set", "sprung_mass=1500", "--set", "yaw_inertia=-2")
    refused(words, "--set yaw_inertia")


@pytest.mark.parametrize("option", ["--vehicle", "--tire", "--commands"])
def test_an_input_file_that_is_missing_or_no_such_file_is_refused(refused, folder, option):
    manoeuvre = () if option == "--commands" else ("step_steer",)
    (folder / "text").write_text("This is none of them.\n")
    (folder / "binary").write_bytes(b"\xff\xfe\x00")
    for name in ("missing", "text", "binary", "."):
        refused(("run", *manoeuvre, option, name, "--csv", "rows.csv"), name)


@pytest.mark.parametrize("option", ["--csv", "--plot"])
def test_a_result_is_refused_before_the_run_where_no_file_can_be(refused, folder, option):
    (folder / "folder.png").mkdir()
    (folder / "file").write_text("not a folder")
    for name in ("none/result.png", "file/result.png", "folder.png"):
        line = refused(("run", "step_steer", option, name), option, name)
        assert "folder" in line


@pytest.mark.parametrize("name", ["figure.jpg", "figure", ".png", "figure.png.txt"])
def test_a_figure_of_another_kind_is_refused(refused, name):
    refused(("run", "step_steer", "--plot", name), "--plot", name, ".png", ".svg", ".pdf")


def test_what_says_how_a_file_is_written_is_refused_without_that_file(refused):
    refused(("run", "step_steer", "--size", "170x200"), "--size", "'170x200'", "with --plot")
    refused(("run", "step_steer", "--with-commands"), "--with-commands", "together with --csv")


def test_what_is_no_size_of_a_figure_is_refused(refused):
    words = ("run", "step_steer", "--plot", "run.png", "--size", "17x20cm")
    refused(words, "--size", "'17x20cm'", "WIDTHxHEIGHT in mm, from 80x120 to 1000x1000")


@pytest.mark.parametrize("option", ["--csv", "--plot", "--vehicle", "--tire", "--commands"])
def test_an_empty_name_is_refused(refused, option):
    manoeuvre = () if option == "--commands" else ("step_steer",)
    refused(("run", *manoeuvre, option, ""), option)


def test_one_name_for_rows_and_figure_is_refused(refused):
    words = ("run", "step_steer", "--csv", "both.png", "--plot", "both.png")
    refused(words, "both.png")


def test_a_manoeuvre_and_a_command_file_together_are_refused(refused, folder):
    (folder / "in.csv").write_text("time,steering\n0,0\n1,0\n")
    refused(("run", "step_steer", "--commands", "in.csv"), "--commands", "manoeuvre")


@pytest.mark.parametrize("option", ["--amplitude", "--rate", "--start"])
def test_an_option_that_a_command_file_has_no_use_for_is_refused(refused, folder, option):
    (folder / "in.csv").write_text("time,steering\n0,0\n1,0\n")
    refused(("run", "--commands", "in.csv", option, "1"), option)


def test_what_is_wrong_in_a_command_file_is_refused_by_its_line(refused, folder):
    (folder / "in.csv").write_text("time,steering\n0,0\n1,left\n")
    refused(("run", "--commands", "in.csv", "--csv", "rows.csv"), "in.csv", "line 3", "steering")


def test_a_full_disk_is_said_in_one_line_and_leaves_no_file(command, folder, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.replace", full)
    result = command("run", "step_steer", "--duration", "0.1", "--csv", "rows.csv")
    assert result.status == 1
    assert "No space left on device" in result.err
    assert len(result.err.splitlines()) == 1
    assert not any(folder.iterdir())


def test_a_step_too_large_for_the_vehicle_is_refused_with_the_largest(refused):
    """Spin against steady-state slip: in proportion to the speed."""
    words = ("run", "step_steer", "--steady-state-slip", "--step", "0.01", "--csv", "rows.csv")
    refused(words, "step: 0.01", "at most 0.0053 s at 13.89 m/s")
    refused((*words, "--speed", "5"), "step: 0.01", "at most 0.0019 s at 5 m/s")
