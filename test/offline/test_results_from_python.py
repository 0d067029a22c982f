"""Results of runs and series as tables and files; series, linear model and replay as calls."""

import pickle
import sys
from types import ModuleType

import numpy as np
import pytest
from matplotlib.image import imread

from vehicle_roll_sim import (
    Command,
    InputError,
    Options,
    Simulation,
    linearize,
    preset,
    replay,
    run,
    series,
)
from vehicle_roll_sim.command_line.main import main

SHORT = {"duration": 0.3, "start": 0.1}


class DataFrame(dict):
    """A stand-in for pandas.DataFrame."""

    def __init__(self, columns):
        super().__init__(columns)
        self.attrs = {}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def short():
    return run("j_turn", **SHORT)


def test_a_run_becomes_a_data_frame_with_units(short, monkeypatch):
    pandas = ModuleType("pandas")
    pandas.DataFrame = DataFrame
    monkeypatch.setitem(sys.modules, "pandas", pandas)
    frame = short.to_pandas()
    assert tuple(frame) == short.columns
    np.testing.assert_array_equal(frame["roll"], short["roll"])
    assert frame.attrs["units"] == short.units


def test_without_pandas_one_line_says_what_to_install(short, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(InputError, match="pip install pandas"):
        short.to_pandas()


@pytest.mark.usefixtures("unplaced")
def test_a_run_is_drawn(short, folder):
    short.plot("figure.png", "short")
    assert min(imread("figure.png").shape[:2]) > 500
    with pytest.raises(InputError, match=r"\.png, \.svg, \.pdf"):
        short.plot("figure.jpg")


@pytest.mark.usefixtures("unplaced")
def test_a_figure_has_the_size_in_mm_of_a_paper(short, folder):
    short.plot("figure.png", size="170x200")
    height, width = imread("figure.png").shape[:2]
    assert height / width == pytest.approx(200 / 170, abs=2 / width)  # whole pixels


@pytest.mark.parametrize(
    ("field", "value"), [("size", 170), ("size", (170, 200)), ("size", "170"), ("title", 5)]
)
def test_a_figure_that_cannot_be_drawn_is_refused_by_name(short, folder, field, value):
    with pytest.raises(InputError, match=f"^{field}: .* is not allowed: "):
        short.plot("figure.png", **{field: value})
    assert not list(folder.iterdir())


def test_stamped_messages_need_a_bag():
    with pytest.raises(InputError, match=r"^stamped: there is no bag: together with bag$"):
        run("j_turn", stamped=True, **SHORT)


def test_the_commands_of_a_held_command_are_in_every_row(folder):
    result = run(Command(rear_steering=0.01, wheel_torque=(0, 0, 50, 60)), duration=0.1)
    result.write_csv("run.csv", with_commands=True)
    table = np.genfromtxt("run.csv", delimiter=",", names=True)
    assert len(table) == len(result) == 11
    for name, value in (("rear_steering", 0.01), ("wheel_torque_lr", 50), ("wheel_torque_rr", 60)):
        assert set(table[name]) == {value}


def test_a_bag_of_a_run_replays_to_the_bit(folder):
    run("j_turn", bag="bag", **SHORT)
    (again,) = replay("bag")
    assert again.is_reproduced
    assert (again.begin, again.replay.end, again.replay.difference) == (0.0, 0.3, 0.0)
    assert again.recorded.simulation.vehicle.sprung_mass == preset().sprung_mass
    assert replay("bag", simulation=Simulation(preset()))[0].is_reproduced
    with pytest.raises(InputError, match="model"):
        replay("bag", simulation=Simulation(preset(), Options(model="1a")))
    for wrong in ("none", 3, ""):
        with pytest.raises(InputError, match="BAG"):
            replay(wrong)
    with pytest.raises(InputError, match="simulation"):
        replay("bag", simulation="reference")


def test_with_a_bag_the_command_says_that_commands_are_held(folder, capsys):
    words = ["run", "j_turn", "--duration", "0.1"]
    main([*words, "--bag", "told"])
    assert "commands:" in (printed := capsys.readouterr().out)
    assert "held for 0.01 s each" in printed
    main([*words, "--bag", "as asked", "--command-period", "0.01"])
    main(words)
    main(["run", "iso_double_lane_change", "--duration", "0.1", "--bag", "by feedback"])
    assert "commands:" not in capsys.readouterr().out


def test_a_series_is_a_table_with_its_verdict_as_of_the_command(folder, capsys):
    values = {"lowest_speed": 15.0, "highest_speed": 25.0, "speed_step": 10.0, "resolution": 5.0}
    calls = []
    result = series("j_turn", progress=lambda: calls.append(1), duration=3.0, **values)
    words = [f"--{name.replace('_', '-')}={value}" for name, value in values.items()]
    assert main(["series", "j_turn", "--duration", "3", *words, "--csv", "command.csv"]) == 0
    printed = capsys.readouterr().out
    assert result.table in printed
    assert result.verdict in printed
    result.write_csv("python.csv")
    assert (folder / "python.csv").read_bytes() == (folder / "command.csv").read_bytes()
    assert len(calls) == len(result) == len(result.to_numpy()) >= 2
    assert result["speed"] == result.to_numpy()["speed"].tolist()
    assert set(result["direction"]) == {"left", "right"}


@pytest.mark.parametrize(
    ("arguments", "values", "expected"),
    [
        (("nope",), {}, "one of"),
        ((3,), {}, "the name of a manoeuvre"),
        (("nhtsa_fishhook",), {"amplitude": 3.0}, "amplitude"),
        (("iso_double_lane_change",), {"preview_tim": 1.0}, "did you mean preview_time"),
        (("j_turn",), {"lowest_speed": "5"}, "lowest_speed"),
        (("nhtsa_fishhook", "car"), {}, "vehicle"),
        (("nhtsa_fishhook",), {"options": "8dof"}, "options"),
        (("nhtsa_fishhook",), {"options": Options(model="8dof")}, "model: '8dof'"),
    ],
)
def test_what_is_wrong_with_a_series_is_said_in_one_line(arguments, values, expected):
    with pytest.raises(InputError, match=expected):
        series(*arguments, **values)


def test_the_linear_model_is_that_of_the_command(folder, capsys):
    assert main(["linearize", "--npz", "model.npz", "--steering", "1", "--model", "8dof"]) == 0
    written = np.load("model.npz")
    model = linearize(options=Options(model="8dof"), steering=np.radians(1.0))
    for name in "abcd":
        np.testing.assert_array_equal(written[name.upper()], getattr(model, name))
    turn = linearize(speed=20, lateral_acceleration=2.0)
    assert turn.trim.outputs.acceleration[1] == pytest.approx(2.0, abs=1e-6)


@pytest.mark.parametrize(
    ("values", "field"),
    [
        ({"speed": "20"}, "speed"),
        ({"steering": True}, "steering"),
        ({"steering": 0.1, "lateral_acceleration": 1.0}, "lateral_acceleration"),
        ({"vehicle": "car"}, "vehicle"),
        ({"options": 8}, "options"),
    ],
)
def test_what_is_wrong_with_steady_driving_is_said_in_one_line(values, field):
    with pytest.raises(InputError) as refusal:
        linearize(**values)
    assert refusal.value.field == field


def test_a_received_linear_model_has_a_plant_that_still_answers():
    model = linearize()
    plant = pickle.loads(pickle.dumps(model)).trim.plant
    state = model.trim.state.copy()
    state[plant.places] *= 1.01
    np.testing.assert_array_equal(
        plant.rates(state, model.trim.inputs), model.trim.plant.rates(state, model.trim.inputs)
    )
    assert plant.outputs.tobytes() == model.trim.plant.outputs.tobytes()
