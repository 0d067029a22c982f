"""Signals that are derived from others: sideslip, load transfer, and the lift of each wheel."""

import numpy as np
import pytest

from vehicle_roll_sim import Command, Options, Simulation, preset, run
from vehicle_roll_sim.files.table_file import read_table
from vehicle_roll_sim.manoeuvres.criteria import (
    has_wheel_heights,
    two_wheel_lift,
    two_wheel_lift_line,
)
from vehicle_roll_sim.messages.run_messages import RunMessages
from vehicle_roll_sim.model.records import COMMAND, LF
from vehicle_roll_sim.roads.commanded import Commanded
from vehicle_roll_sim.roads.surfaces import Patch
from vehicle_roll_sim.roads.tilt import TiltTable
from vehicle_roll_sim.runs.columns import COLUMNS, COMMANDS, WHEEL_LIFTS
from vehicle_roll_sim.runs.compiled_run import compiled_run
from vehicle_roll_sim.runs.derived_signals import SIGNALS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.metrics import wheel_lift
from vehicle_roll_sim.runs.run import run as stepwise
from vehicle_roll_sim.simulation.road import Road

SAME_AS_A_PLANE = Road(features=(Patch(start=-1e3, friction=1.0),))
HOLLOW = Road.from_values(
    {"features": [{"kind": "ramp", "start": 10.0, "length": 20.0, "height": -2.0}]}
)
GEOMETRIC = 1e-11
"""m: the tire compression is integrated; see test/model/integration/test_accuracy.py."""
LOWERED = 0.15
"""m"""
FALLEN = 1e-4
"""m: a wheel of 40 kg that a spring of 5 kN pushes down falls 0.06 mm in 1 ms."""


def steers_hard(times: np.ndarray) -> np.ndarray:
    """A steep ramp to 0.2 rad: the vehicle rolls over."""
    commands = np.zeros(len(times), COMMAND)
    commands["steering"] = np.clip(2.0 * (times - 0.5), 0.0, 0.2)
    return commands


def turned_over(road: Road | None = None, model: str = "1", driver=compiled_run) -> History:
    simulation = Simulation(preset(), Options(model=model), road=road)
    return driver(simulation, steers_hard, 2.5)


@pytest.fixture(scope="module")
def on_a_plane() -> History:
    return turned_over()


def test_a_wheel_is_lifted_where_it_carries_no_load(on_a_plane):
    """By as much as its centre is higher than the unloaded radius."""
    lifts = on_a_plane.wheel_lift()
    np.testing.assert_array_equal(lifts > 0.0, on_a_plane.wheels("normal_force") == 0.0)
    assert not np.signbit(lifts).any()
    assert lifts.max() > 0.3
    vehicle = preset()
    static = vehicle.static_strut_length + vehicle.static_suspension_compression
    length = static - on_a_plane.wheels("suspension_compression")
    ahead = np.array([1, 1, 0, 0]) * (vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle)
    ahead, left = ahead - vehicle.cg_to_rear_axle, vehicle.per_wheel("track") / 2 * (1, -1, 1, -1)
    roll, pitch = on_a_plane["roll"][:, None], on_a_plane["pitch"][:, None]
    up = np.cos(pitch) * (np.sin(roll) * left - np.cos(roll) * length) - np.sin(pitch) * ahead
    centres = on_a_plane["z"][:, None] + up
    expected = np.maximum(centres - vehicle.tire_radius, 0.0)
    assert np.abs(lifts - expected).max() < GEOMETRIC


@pytest.mark.parametrize("model", ["1", "2"])
def test_on_a_road_with_features_it_is_the_same_in_both_loops_and_as_on_a_plane(model):
    rolled = [turned_over(SAME_AS_A_PLANE, model, each) for each in (compiled_run, stepwise)]
    compiled, by_steps = (each.wheel_lift() for each in rolled)
    np.testing.assert_array_equal(compiled, by_steps)
    plane = turned_over(None, model).wheel_lift()
    assert plane.max() > 0.1
    np.testing.assert_allclose(compiled, plane[: len(compiled)], atol=1e-6)


def test_a_wheel_of_model_1_that_lies_beside_the_body_is_as_high_as_on_a_plane():
    """With `body_contact` its tire is a disc there; the lift is that of its centre all the same."""
    fallen = Options(body_contact=True)
    on_plane, on_road = (
        compiled_run(Simulation(preset(), fallen, road=road), steers_hard, 4.0)
        for road in (None, SAME_AS_A_PLANE)
    )
    assert np.abs(on_plane["roll"]).max() > np.radians(80.0)
    np.testing.assert_allclose(on_road.wheel_lift(), on_plane.wheel_lift(), atol=1e-6)


@pytest.mark.parametrize("model", ["1", "2"])
def test_it_is_that_above_the_road_under_the_wheel(model):
    """A road that drops under one wheel leaves it in the air."""
    simulation = Simulation(preset(), Options(model=model), road=Road(features=(Commanded(),)))
    lowered = Command(road_height=(-LOWERED, 0.0, 0.0, 0.0))
    history = stepwise(simulation, lambda times: lowered.records(), 0.001, sample=0.001)
    lifts = history.wheel_lift()
    assert lifts[0].tolist() == [0.0] * 4
    squeezed = preset().static_tire_compression[LF]
    assert lifts[1] == pytest.approx([LOWERED - squeezed, 0.0, 0.0, 0.0], abs=FALLEN)
    assert history.part(history["time"] > 0.0).wheel_lift().tolist() == [lifts[1].tolist()]


@pytest.mark.parametrize("with_signals", [False, True])
def test_a_file_of_a_run_on_a_road_gives_the_same_lift_back(tmp_path, with_signals):
    """The compressions alone, over z = 0, say that wheels over a hollow of 2 m do not lift."""
    result = run("nhtsa_j_turn", road=HOLLOW, speed=15.0, duration=4.0, steering_at_03g=20.0)
    result.write_csv(tmp_path / "run.csv", with_commands=True, with_signals=with_signals)
    read = History.read_csv(tmp_path / "run.csv")
    np.testing.assert_array_equal(read.wheel_lift(), result.history.lifts)
    assert two_wheel_lift(read) == two_wheel_lift(result.history)
    assert two_wheel_lift(read) > 1.0
    assert not wheel_lift(read.wheels("tire_compression")).any()
    header, _ = read_table(tmp_path / "run.csv", 10_000_000)
    assert [header.count(name) for name in WHEEL_LIFTS] == [1] * 4


def test_a_file_of_messages_from_a_road_with_heights_says_that_it_is_unknown(on_a_plane, tmp_path):
    unknown = np.full_like(on_a_plane.wheel_lift(), np.nan)
    History(on_a_plane.rows, lifts=unknown).write_csv(tmp_path / "run.csv")
    read = History.read_csv(tmp_path / "run.csv")
    assert not has_wheel_heights(read)
    assert two_wheel_lift_line(read)["two-wheel lift"].startswith("unknown")
    History(on_a_plane.rows).write_csv(tmp_path / "plane.csv")
    assert has_wheel_heights(History.read_csv(tmp_path / "plane.csv"))


def test_from_messages_it_is_known_on_a_plane_only():
    """Also one with friction of its own, or that tilts."""
    for road in (Road(), SAME_AS_A_PLANE):
        assert RunMessages().history(road).lifts is None
    assert not Road(features=(TiltTable(angles=((0.0, 0.0), (1.0, 5.0))),)).has_heights
    assert RunMessages().history(Road(features=(Commanded(),))).lifts is not None


def test_a_model_without_heights_does_not_know_it():
    assert np.isnan(turned_over(model="8dof").wheel_lift()).all()


def test_the_other_signals_are_what_their_names_say(on_a_plane):
    """The sideslip angle is that from the heading to the course that the c.g. has over ground."""
    found = dict(zip(SIGNALS, on_a_plane.signals().T, strict=True))
    lf, rf, lr, rr = on_a_plane.wheels("normal_force").T
    np.testing.assert_allclose(found["front_load_transfer"], (rf - lf) / 2, rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(found["rear_load_transfer"], (rr - lr) / 2, rtol=1e-12, atol=1e-9)
    total = lf + rf + lr + rr
    ratio = (rf + rr - lf - lr) / np.where(total == 0.0, 1.0, total)
    np.testing.assert_allclose(found["load_transfer_ratio"], ratio, atol=1e-12)
    early = slice(1, 150)  # differences are exact to second order where nothing jumps
    course = np.arctan2(np.gradient(on_a_plane["y"]), np.gradient(on_a_plane["x"]))
    angle = found["sideslip_angle"] + on_a_plane["yaw"]
    np.testing.assert_allclose(angle[early], course[early], atol=1e-3)
    assert np.abs(found["sideslip_angle"][early]).max() > 0.02


def test_the_csv_has_them_on_request_after_the_commands(tmp_path):
    result, file = run("j_turn", duration=1.0), tmp_path / "run.csv"
    result.write_csv(file, with_commands=True, with_signals=True)
    header, lines = read_table(file, 10_000_000)
    assert tuple(header) == (*COLUMNS, *COMMANDS, *SIGNALS)
    rows = np.array([[float(text) for text in texts] for _, texts in lines])
    written = rows[:, -len(SIGNALS) :]
    np.testing.assert_array_equal(written, result.history.signals())
    for name, values in zip(SIGNALS, written.T, strict=True):
        np.testing.assert_array_equal(result[name], values)
    with pytest.raises(KeyError, match="no column 'wheel_lift'"):
        result["wheel_lift"]
    result.write_csv(file)
    assert tuple(read_table(file, 10_000_000)[0]) == COLUMNS
