"""A gust from a command file: driven, in the CSV and the bag, and replayed bit for bit."""

import numpy as np
import pytest
from recorded import PERIOD, PERIOD_NS, read_by_another_library

from vehicle_roll_sim import InputError, Options, Simulation, preset
from vehicle_roll_sim.bags.reading import last_run, recorded_runs
from vehicle_roll_sim.bags.replay import replay
from vehicle_roll_sim.bags.run_bag import run_bag
from vehicle_roll_sim.manoeuvres.command_file import command_table, load_commands
from vehicle_roll_sim.runs.columns import WIND
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.description import described

GUST = "time,wind_x,wind_y\n0,0,0\n0.1,0,0\n0.1,-1.5,-20\n0.3,-1.5,-20\n0.5,0,0\n"
END = 0.5
"""s"""


@pytest.fixture(scope="module")
def gust(tmp_path_factory):
    folder = tmp_path_factory.mktemp("gust")
    (folder / "gust.csv").write_text(GUST)
    return load_commands(folder / "gust.csv")


@pytest.fixture(scope="module")
def windy(gust, tmp_path_factory):
    """The folder of the bag, and the history of the run that it is of."""
    simulation = Simulation(preset().with_values({"side_force_area": 4.0}))
    simulation.reset(25.0)
    ready = gust.for_vehicle(simulation.vehicle, simulation.options)
    bag = tmp_path_factory.mktemp("bags") / "gust"
    with run_bag(simulation, ready.commanded, bag, PERIOD_NS, "--bag") as observer:
        history = run(simulation, ready.driver(), END, command_period=PERIOD, observer=observer)
    return bag, history


def test_the_gust_is_driven_as_it_is_in_the_file(gust, windy):
    _, history = windy
    commands = gust(history["time"][:-1])
    assert history.wind[1:] == pytest.approx(commands["wind"])  # of the period before the row
    assert history.command("wind_y").min() == -20.0
    assert history["v"].min() < -0.05  # m/s


def test_the_bag_has_the_wind_in_its_own_topic_and_in_what_was_applied(windy):
    bag, history = windy
    messages = read_by_another_library(bag)
    assert [list(m.data) for _, m in messages["/wind_cmd"]] == history.wind[1:].tolist()
    _, applied = messages["/applied_command"][20]
    assert [dimension.label for dimension in applied.layout.dim][-2:] == list(WIND)
    assert list(applied.data[-2:]) == [-1.5, -20.0]


def test_it_is_read_and_replayed_with_its_wind(windy):
    bag, history = windy
    (recorded,) = recorded_runs(bag)
    result = replay(recorded, described(recorded.description).simulation)
    assert result.is_exact
    assert result.periods == round(END / PERIOD)
    np.testing.assert_array_equal(last_run(bag)[0].wind, history.wind)


def test_the_csv_has_the_wind_among_the_commands(windy, tmp_path):
    _, history = windy
    history.write_csv(tmp_path / "run.csv", with_commands=True)
    read = History.read_csv(tmp_path / "run.csv")
    np.testing.assert_array_equal(read.wind, history.wind)
    part = read.part(read["time"] > 0.3)
    assert np.isnan(History(history.rows).command("wind_x")).all()
    assert len(part.wind) == len(part.rows)
    history.write_csv(tmp_path / "short.csv")
    assert "wind" not in (tmp_path / "short.csv").read_text()


def test_columns_of_wind_are_refused_for_a_vehicle_that_does_not_feel_it(gust):
    with pytest.raises(InputError, match=r"gust.csv: column: 'wind_x' .*no air forces"):
        gust.for_vehicle(preset(), Options())
    assert gust.needs_vehicle
    assert not command_table({"time": [0.0, 1.0], "steering": [0.0, 0.1]}).needs_vehicle
