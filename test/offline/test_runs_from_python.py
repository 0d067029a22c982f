"""A run as a Python call gives the numbers of the command for all options."""

import dataclasses
import math
import pickle

import numpy as np
import pytest

from vehicle_roll_sim import (
    Command,
    Condition,
    Feedback,
    InputError,
    Options,
    Road,
    preset,
    run,
)
from vehicle_roll_sim.command_line.main import main
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.model.records import COMMAND

SHORT = {"duration": 0.3, "start": 0.1}


class Damped(Feedback):
    """Steers against the roll rate, and answers with a Command."""

    def command(self, time, state) -> Command:
        return Command(steering=0.02 - 0.05 * float(state["roll_rate"]))


class DampedInRecords(Damped):
    """The same with an answer in records."""

    def command(self, time, state) -> np.ndarray:
        return super().command(time, state).records()


def turning(times: np.ndarray) -> np.ndarray:
    commands = np.zeros(len(times), COMMAND)
    commands["steering"] = 0.05 * times
    return commands


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_rows_summary_and_bag_are_those_of_the_command(folder, capsys):
    words = ["--duration", "0.3", "--start", "0.1", "--set", "cg_height=0.6", "--model", "1b"]
    words += ["--grade", "0.05", "--step", "0.002", "--sample", "0.02"]
    assert main(["run", "j_turn", *words, "--csv", "command.csv"]) == 0
    printed = capsys.readouterr().out
    result = run(
        "j_turn",
        preset().with_values({"cg_height": 0.6}),
        options=Options(model="1b"),
        road=Road(grade=0.05),
        step=0.002,
        sample=0.02,
        **SHORT,
    )
    result.write_csv("python.csv")
    assert (folder / "python.csv").read_bytes() == (folder / "command.csv").read_bytes()
    assert result.summary in printed


def test_columns_have_names_and_units_in_every_form():
    result = run("j_turn", **SHORT)
    table = result.to_numpy()
    assert table.dtype.names == result.columns == tuple(result.units)
    assert len(result) == len(table) == 31
    for name in result.columns:
        np.testing.assert_array_equal(table[name], result[name])
    np.testing.assert_array_equal(result.wheels("normal_force")[:, 1], result["normal_force_rf"])
    units = {name: result.units[name] for name in ("time", "roll", "u", "normal_force_lf")}
    assert units == {"time": "s", "roll": "rad", "u": "m/s", "normal_force_lf": "N"}
    assert result.units["slip_ratio_rr"] == ""
    with pytest.raises(KeyError, match="no column 'rol': one of time, "):
        result["rol"]


def test_events_condition_and_metrics_are_those_of_the_run():
    result = run("j_turn")
    assert result.condition is Condition.ROLLED_OVER
    metrics = result.metrics
    assert metrics["rollover_time"] == result.events.rollover_time[0] <= metrics["end_time"]
    assert metrics["end_time"] == result.time == result["time"][-1]
    lifted = [metrics[f"lift_off_time_{wheel}"] for wheel in ("lf", "rf", "lr", "rr")]
    assert lifted == result.events.lift_off_time.tolist()
    assert metrics["peak_roll"] == pytest.approx(np.abs(result["roll"]).max(), abs=0.02)
    assert metrics["peak_load_transfer_ratio"] == pytest.approx(1.0)
    straight = run("j_turn", amplitude=0.0, **SHORT).metrics
    assert math.isnan(straight["rollover_time"])
    assert math.isnan(straight["peak_roll_time"])


def test_what_a_manoeuvre_is_driven_for_is_reported():
    result = run("nhtsa_j_turn", duration=1.0)
    assert result.report["two-wheel lift"] == "none"
    assert "two-wheel lift:             none" in result.summary


def test_a_result_can_be_sent_elsewhere():
    result = run("iso_double_lane_change", duration=0.2)
    received = pickle.loads(pickle.dumps(result))
    np.testing.assert_array_equal(received.to_numpy(), result.to_numpy())
    assert received.summary == result.summary


@pytest.mark.parametrize("name", STANDARD)
def test_every_manoeuvre_is_known_by_name_and_as_an_object(name):
    duration = 5.0 if name == "iso_step_steer" else 0.05  # it is sized by a run of its own length
    by_name = run(name, duration=duration)
    by_object = run(dataclasses.replace(STANDARD[name], duration=duration))
    np.testing.assert_array_equal(by_name.to_numpy(), by_object.to_numpy())


def test_commands_may_come_from_a_file_or_a_table_alike(folder):
    (folder / "in.csv").write_text(
        "time,steering,wheel_torque_lr\n0,0,0\n0.1,0.02,50\n0.2,0.02,0\n"
    )
    table = {"time": [0.0, 0.1, 0.2], "steering": [0.0, 0.02, 0.02], "wheel_torque_lr": [0, 50, 0]}
    from_file, from_table = run("in.csv", speed=20.0), run(table, speed=20.0)
    np.testing.assert_array_equal(from_file.to_numpy(), from_table.to_numpy())
    assert from_file.time == 0.2
    assert from_file["steering"][5] == pytest.approx(0.01)
    assert run(folder / "in.csv", duration=0.5).time == 0.5


def test_drivers_of_ones_own_drive_for_the_time_that_is_given():
    programme = run(turning, speed=20.0, duration=0.2)
    assert programme["steering"][-1] == pytest.approx(0.01)
    assert programme["u"][0] == 20.0
    held = run(Command(steering=0.03), duration=0.2)
    assert set(held["steering"][1:]) == {0.03}
    feedback, in_records = (run(each(), duration=0.2) for each in (Damped, DampedInRecords))
    np.testing.assert_array_equal(feedback.to_numpy(), in_records.to_numpy())


def test_progress_adds_up_to_the_run():
    stretches = []
    run("j_turn", progress=stretches.append, **SHORT)
    assert math.fsum(stretches) == pytest.approx(0.3, abs=1e-9)  # sums of ns


class Mute(Feedback):
    def command(self, time, state):
        return None


class Reversed(Feedback):
    """A brake that drives: a record is not checked when it is written."""

    def command(self, time, state):
        records = np.zeros(1, COMMAND)
        records["brake_torque"] = -1.0
        return records


def brake_of_no_number(times: np.ndarray) -> np.ndarray:
    commands = np.zeros(len(times), COMMAND)
    commands["brake_torque"][len(times) // 2] = math.nan
    return commands


REFUSED = {
    "misspelt": (("j_tern",), {}, "manoeuvre", "did you mean j_turn?"),
    "nothing": ((None,), {}, "manoeuvre", "a name, a Manoeuvre"),
    "a class": ((Damped,), {"duration": 1.0}, "manoeuvre", "a Feedback"),
    "an unknown value": (("j_turn",), {"amplitud": 4.0}, "name", "did you mean amplitude"),
    "a text": (("j_turn",), {"amplitude": "4"}, "amplitude", "from -60 to 60 deg"),
    "no length": ((turning,), {}, "duration", "duration of the run"),
    "an empty moment": (({"time": [0.0], "steering": [1.0]},), {}, "duration", "required"),
    "between steps": (("j_turn",), {"sample": 0.0015}, "sample", "multiple"),
    "a period below 0": (("j_turn",), {"command_period": -1.0}, "command_period", "multiple"),
    "a name for a vehicle": (("j_turn", "car.yaml"), {}, "vehicle", "Vehicle"),
    "a name for a model": (("j_turn",), {"options": "8dof"}, "options", "Options"),
    "no name of a bag": (("j_turn",), {"bag": 3}, "bag", "the name of a file or folder"),
    "a mute driver": ((Mute(),), {"duration": 1.0}, "command", "one COMMAND record"),
    "a brake below 0": ((Reversed(),), {"duration": 1.0}, "brake_torque", "at least 0"),
    "a brake of nan": ((brake_of_no_number,), {"duration": 1.0}, "brake_torque", "finite"),
    "no times": (({"steering": [0.0]},), {}, "commands", "time"),
    "an unknown column": (
        ({"time": [0.0, 1.0], "stering": [0.0, 1.0]},),
        {},
        "commands: column",
        "steering",
    ),
    "falling times": (
        ({"time": [1.0, 0.0], "steering": [0.0, 1.0]},),
        {},
        "commands: time",
        "at least 1",
    ),
    "a column too short": (
        ({"time": [0.0, 1.0], "steering": [0.0]},),
        {},
        "commands: steering",
        "2 values",
    ),
    "no numbers": (
        ({"time": [0.0, 1.0], "steering": ["left", 1.0]},),
        {},
        "commands: steering",
        "finite",
    ),
    "brakes below 0": (
        ({"time": [0.0, 1.0], "brake_torque_lf": [0.0, -1.0]},),
        {},
        "commands: brake_torque_lf",
        "at least 0",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_wrong_is_said_in_one_line_that_names_it(case):
    arguments, options, field, allowed = REFUSED[case]
    with pytest.raises(InputError) as refusal:
        run(*arguments, **options)
    assert refusal.value.field == field
    assert allowed in str(refusal.value)
    assert "\n" not in str(refusal.value)
