"""Replay of a recording: bit for bit or with the largest difference; bad recordings are refused."""

import contextlib
import json
import shutil

import numpy as np
import pytest
from actuated import actuated
from measured import measured
from recorded import record

from vehicle_roll_sim import InputError, Options, Simulation, preset
from vehicle_roll_sim.bags.encoding import TYPES, decode
from vehicle_roll_sim.bags.reading import last_run, recorded_runs
from vehicle_roll_sim.bags.replay import replay
from vehicle_roll_sim.command_line.main import main
from vehicle_roll_sim.runs.columns import roll_centres_of
from vehicle_roll_sim.simulation.description import described

ARRAY = "std_msgs/msg/Float64MultiArray"


def replayed(bag, namespace=None):
    """Every run of a bag replayed with the simulation that it describes."""
    runs = recorded_runs(bag, namespace)
    return [replay(run, described(run.description).simulation) for run in runs]


@pytest.mark.parametrize(
    ("options", "name", "duration", "end"),
    [
        (None, "j_turn", 4.0, 2.965),
        (Options(steady_state_slip=True), "step_steer", 1.505, 1.505),
        (Options(model="8dof"), "nhtsa_fishhook", 2.5, 2.5),
    ],
    ids=["to the rollover", "with speed hold, ending within a period", "of another model"],
)
def test_an_offline_run_is_reproduced_to_the_bit(tmp_path, options, name, duration, end):
    record(tmp_path / "bag", options, name, duration)
    (result,) = replayed(tmp_path / "bag")
    assert result.is_exact
    assert (result.end, np.isnan(result.missing_from)) == (end, True)


@pytest.mark.parametrize("more", [{}, {"side_force_area": 3.0}], ids=["in still air", "in air"])
def test_a_run_with_actuators_is_reproduced_from_what_was_demanded(tmp_path, more):
    bag, vehicle = tmp_path / "bag", actuated(**more)
    simulation = record(bag, name="step_steer", duration=1.5, vehicle=vehicle)
    (result,) = replayed(bag)
    assert (result.is_exact, result.end) == (True, 1.5)
    history = last_run(bag)[0]
    assert history["steering"][-1] == simulation.outputs["commanded_steering"][0]
    assert (history.wind is None) == (not more)
    acting = simulation.actuation.records()["wheel_torque"][0]
    assert history.commands[-1][1:5].tolist() == acting.tolist() != [0.0] * 4


@pytest.fixture(scope="module")
def measured_run(tmp_path_factory):
    """The bag of a run with sensors, and its simulation at the end."""
    bag = tmp_path_factory.mktemp("measured") / "bag"
    return bag, record(bag, duration=0.8, vehicle=measured())


def test_what_sensors_measured_is_reproduced_with_the_seed_in_the_bag(measured_run):
    bag, simulation = measured_run
    (run,) = recorded_runs(bag)
    assert json.loads(run.description)["vehicle"]["sensor_seed"] == 17
    assert (run.measurements[0.8] == simulation.sensors.readings()).all()
    (result,) = replayed(bag)
    assert (result.is_exact, result.end) == (True, 0.8)


def test_the_history_of_a_bag_is_the_truth_whatever_the_sensors_say(measured_run, tmp_path):
    plain = record(tmp_path / "bag", duration=0.8)
    assert plain.state.tobytes() == measured_run[1].state.tobytes()
    rows = [last_run(bag)[0].rows for bag in (measured_run[0], tmp_path / "bag")]
    np.testing.assert_array_equal(*rows)


def test_a_measurement_that_is_another_is_found(measured_run, changed):
    def shift(topic, sent, data):
        if topic == "/measurements" and sent == 500_000_000:
            message = decode(data, ARRAY)
            message.data = message.data + 1e-9 * (np.arange(len(message.data)) == 1)
            data = bytes(TYPES.serialize_cdr(message, ARRAY))
        return [(topic, sent, data)]

    (result,) = replayed(changed(measured_run[0], shift))
    assert (result.is_exact, result.name, result.time) == (False, "accelerometer_x", 0.5)


def test_a_run_of_model_2_is_reproduced_with_its_roll_centres(tmp_path):
    simulation = record(tmp_path / "bag", Options(model="2"), "j_turn", 1.5)
    (result,) = replayed(tmp_path / "bag")
    assert result.is_exact
    history = last_run(tmp_path / "bag")[0]
    assert len(history.roll_centres) == len(history.rows)
    np.testing.assert_array_equal(history.roll_centres[-1], roll_centres_of(simulation))
    assert np.ptp(history.roll_centre("place"), axis=0).min() > 0.1  # m


def test_a_state_that_is_another_is_found_and_measured(j_turn, changed):
    def shift(topic, sent, data):
        if topic == "/state" and sent == 1_500_000_000:
            message = decode(data, ARRAY)
            message.data = message.data + 1e-9 * (np.arange(37) == 4)  # rad of roll
            data = bytes(TYPES.serialize_cdr(message, ARRAY))
        return [(topic, sent, data)]

    (result,) = replayed(changed(j_turn, shift))
    assert not result.is_exact
    assert (result.name, result.time) == ("roll", 1.5)
    assert result.difference == pytest.approx(1e-9, rel=1e-6)  # roll is some 0.2 rad there
    assert result.relative == pytest.approx(1e-9 / np.radians(85.0), rel=1e-3)  # over its peak


def test_another_command_gives_another_run(j_turn, changed):
    def steer_more(topic, sent, data):
        if topic == "/applied_command" and sent == 1_500_000_000:
            message = decode(data, ARRAY)
            message.data = message.data + 1e-6 * (np.arange(15) == 1)  # rad of steering
            data = bytes(TYPES.serialize_cdr(message, ARRAY))
        return [(topic, sent, data)]

    (result,) = replayed(changed(j_turn, steer_more))
    assert 0.0 < result.relative < 1e-2
    assert result.time >= 1.5


@pytest.mark.parametrize("topic", ["/state", "/applied_command"])
def test_where_messages_are_missing_the_comparison_ends_and_says_so(j_turn, changed, topic):
    def lose(name, sent, data):
        return [] if (name, sent) == (topic, 1_000_000_000) else [(name, sent, data)]

    (result,) = replayed(changed(j_turn, lose))
    assert result.is_exact  # as far as it goes
    assert (result.end, result.missing_from) == (0.99, 0.99)
    assert not result.is_complete


def test_every_run_from_a_reset_on_is_replayed(j_turn, changed):
    later = 3_000_000_000

    def once_more(topic, sent, data):
        return [(topic, sent, data), (topic, sent + later, data)]

    results = replayed(changed(j_turn, once_more))
    assert [(result.end, result.is_exact) for result in results] == [(2.965, True)] * 2


def test_one_vehicle_of_several_is_chosen_by_its_namespace(j_turn, changed):
    def two(topic, sent, data):
        return [(f"/{name}{topic}", sent, data) for name in ("a", "b")]

    bag = changed(j_turn, two)
    with pytest.raises(InputError, match="one of /a, /b"):
        recorded_runs(bag)
    with pytest.raises(InputError, match="namespace"):
        recorded_runs(bag, "c")
    for name in ("a", "/b/"):
        (result,) = replayed(bag, name)
        assert result.is_exact


def test_a_recording_of_another_vehicle_is_refused_by_its_first_state(j_turn):
    (run,) = recorded_runs(j_turn)
    with pytest.raises(InputError, match="z at the reset"):
        replay(run, Simulation(preset().with_values({"cg_height": 0.8})))
    with pytest.raises(InputError, match="model 8dof"):
        replay(run, Simulation(preset(), Options(model="8dof")))


def test_a_run_whose_beginning_is_not_recorded_is_told_from_the_others(j_turn, changed):
    def in_the_midst(topic, sent, data):
        later = [(topic, sent + 3_000_000_000, data)]
        early = sent < 1_000_000_000 and topic != "/simulation_description"
        return later if early else [(topic, sent, data), *later]

    fragment, whole = recorded_runs(changed(j_turn, in_the_midst))
    assert (fragment.begins_at_a_reset, whole.begins_at_a_reset) == (False, True)
    assert replay(whole, described(whole.description).simulation).is_complete


def test_one_set_alone_shows_nothing(j_turn, changed):
    def first_only(topic, sent, data):
        return [(topic, sent, data)] if sent == 0 else []

    (result,) = replayed(changed(j_turn, first_only))
    assert (result.periods, result.is_complete) == (0, False)


def test_the_history_is_the_same_where_messages_of_a_set_arrive_in_any_order(j_turn, changed):
    numbers = np.random.default_rng(1)

    def arrive_late(topic, sent, data):
        return [(topic, sent + int(numbers.integers(300_000)), data)]  # ns

    whole, received = last_run(j_turn)[0], last_run(changed(j_turn, arrive_late))[0]
    np.testing.assert_array_equal(received.rows, whole.rows)


def test_what_is_not_a_state_of_a_simulator_is_refused(j_turn, changed):
    def without_labels(topic, sent, data):
        if topic == "/state":
            message = decode(data, ARRAY)
            message.layout.dim = []
            data = bytes(TYPES.serialize_cdr(message, ARRAY))
        return [(topic, sent, data)]

    with pytest.raises(InputError, match="a message on state that is not a simulator's"):
        recorded_runs(changed(j_turn, without_labels))


@pytest.mark.parametrize("seed", range(12))
def test_a_damaged_bag_is_read_or_refused_and_no_more(j_turn, tmp_path, seed):
    damaged = tmp_path / "j_turn"
    shutil.copytree(j_turn, damaged)
    file = damaged / ("metadata.yaml" if seed % 3 == 0 else "j_turn_0.mcap")
    data, numbers = bytearray(file.read_bytes()), np.random.default_rng(seed)
    for place in numbers.integers(len(data), size=30):
        data[place] = numbers.integers(256)
    file.write_bytes(data)
    with contextlib.suppress(InputError):
        assert recorded_runs(damaged)


def test_the_history_of_a_bag_is_that_of_the_run(j_turn):
    history = last_run(j_turn)[0]
    simulation = Simulation(preset())
    times = history["time"]
    assert (len(times), times[0], times[-1]) == (298, 0.0, 2.965)
    assert history["roll"][-1] >= simulation.rollover_angle
    loads = history.wheels("normal_force")
    assert loads[0] == pytest.approx(simulation.outputs.normal_force, rel=1e-12)  # at rest
    sprung = history["lateral_acceleration"]
    assert np.abs(sprung).max() == pytest.approx(9.353, abs=0.01)  # m/s^2, of the run's summary
    assert history["steering"][-1] == pytest.approx(np.radians(10.0))


@pytest.mark.parametrize("model", ["1", "8dof"])
def test_on_a_slope_too_the_lateral_acceleration_is_that_of_the_run(tmp_path, model):
    bag, table = tmp_path / "bag", tmp_path / "run.csv"
    road = ("--grade", "0.05", "--bank", "-0.2", "--model", model)
    words = ("step_steer", "--duration", "3", *road, "--bag", str(bag), "--csv", str(table))
    assert main(["run", *words]) == 0
    told = np.genfromtxt(table, delimiter=",", names=True)
    history = last_run(bag)[0]
    assert np.abs(np.degrees(told["yaw"][-1])) > 20.0  # where the grade, too, is across
    for name in ("lateral_acceleration", "roll"):
        assert history[name] == pytest.approx(told[name], abs=1e-9)  # rounding of the file


def test_a_description_that_is_nested_without_end_is_refused():
    with pytest.raises(InputError, match="simulation description"):
        described("[" * 100_000)


def timed(factor, *topics):
    """A change to a bag: multiply the times in the messages on these topics by a factor."""

    def change(topic, sent, data):
        if topic in topics:
            message = decode(data, ARRAY)
            message.data = np.append(message.data[0] * factor, message.data[1:])
            data = bytes(TYPES.serialize_cdr(message, ARRAY))
        return [(topic, sent, data)]

    return change


def test_a_command_of_no_time_is_refused(j_turn, changed):
    with pytest.raises(InputError, match="applied_command that is not a simulator's"):
        recorded_runs(changed(j_turn, timed(np.nan, "/applied_command")))


def test_times_that_do_not_fit_the_publish_period_are_not_compared(j_turn, changed, capsys):
    bag = changed(j_turn, timed(1e6, "/state", "/applied_command"))
    assert main(["replay", str(bag), "--strict"]) == 1
    verdict = capsys.readouterr().out
    assert "nothing to compare; messages are missing from 0.000 s" in verdict
    assert "reproduced" not in verdict
