"""The bag of an offline run has the content of a recording of the node."""

import json

import numpy as np
import pytest
import yaml
from recorded import PERIOD, PERIOD_NS, read_by_another_library, record
from rosbags.rosbag2 import Reader

from vehicle_roll_sim import Command, InputError, Options, Simulation, preset
from vehicle_roll_sim import run as run_offline
from vehicle_roll_sim.bags.reading import last_run
from vehicle_roll_sim.bags.run_bag import run_bag
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.messages.command_topics import (
    COMMANDS,
    COMMANDS_OF_ROAD,
    OF_WIND,
    TOTAL_TORQUES,
)
from vehicle_roll_sim.messages.topics import (
    CLOCK,
    OF_SOME_SETS,
    PUBLISHED,
    ROAD,
    STATE_SET,
    TRANSFORMS,
)
from vehicle_roll_sim.runs.run import run

SETS = 298
"""At 0, 0.01 … 2.96 s, and at 2.965 s, where the vehicle has rolled over."""


def full_name(topic) -> str:
    return "/" + topic.name.lstrip("/")


@pytest.fixture(scope="module")
def messages(j_turn) -> dict[str, list]:
    return read_by_another_library(j_turn)


def test_it_has_every_topic_of_a_recording_with_type_and_quality_of_service(j_turn):
    with Reader(j_turn) as reader:
        found = {connection.topic: connection for connection in reader.connections}
    absent = (*OF_SOME_SETS, *TOTAL_TORQUES, *OF_WIND, *COMMANDS_OF_ROAD, ROAD)
    topics = [topic for topic in (*COMMANDS, *PUBLISHED) if topic not in absent]
    assert found.keys() == {full_name(topic) for topic in topics}
    for topic in topics:
        connection = found[full_name(topic)]
        assert connection.msgtype == topic.type
        (qos,) = connection.ext.offered_qos_profiles
        assert (qos.reliability.name, qos.depth) == ("RELIABLE", topic.depth)
        assert qos.durability.name == ("TRANSIENT_LOCAL" if topic.latched else "VOLATILE")


def test_every_set_is_complete_and_logged_at_the_simulated_time_of_its_stamps(messages):
    for topic in (*STATE_SET, TRANSFORMS, CLOCK):
        assert len(messages[full_name(topic)]) == SETS
    times = [sent for sent, _ in messages["/state"]]
    assert times == [*range(0, 2_970_000_000, PERIOD_NS), 2_965_000_000]
    for k, sent in enumerate(times):
        assert messages["/state"][k][1].data[0] == sent / 1e9
        (_, clock), (_, imu) = messages["/clock"][k], messages["/imu"][k]
        for stamp in (clock.clock, imu.header.stamp):
            assert stamp.sec * 1_000_000_000 + stamp.nanosec == sent


def test_states_are_those_of_the_simulation_under_the_recorded_commands(messages):
    simulation = Simulation(preset())
    assert list(messages["/state"][0][1].data) == [0.0, *simulation.model_state]
    sent = [message.data for _, message in messages["/steering_cmd"]]
    for k in range(1, SETS):
        simulation.step(Command(steering=sent[k - 1]), PERIOD)
        assert list(messages["/state"][k][1].data) == [simulation.time, *simulation.model_state]
        applied = messages["/applied_command"][k][1].data
        assert list(applied) == [simulation.time, sent[k - 1], *[0.0] * 13]
        loads = messages["/tire_normal_forces"][k][1].data
        assert list(loads) == list(simulation.outputs.normal_force)


def test_commands_are_sent_with_the_set_that_they_answer(messages):
    manoeuvre = STANDARD["j_turn"]
    for sent, message in messages["/steering_cmd"]:
        assert message.data == manoeuvre(np.array([sent / 1e9]))["steering"][0]
    assert len(messages["/steering_cmd"]) == SETS - 1
    assert "/wheel_torque_cmd" not in messages  # nothing but steering is commanded


def test_a_speed_hold_is_recorded_as_the_torque_that_it_gives(tmp_path):
    record(tmp_path / "bag", name="step_steer", duration=2.0)
    messages = read_by_another_library(tmp_path / "bag")
    speeds = [message.data[7] for _, message in messages["/state"]]  # u
    manoeuvre = STANDARD["step_steer"]
    wanted = [2000.0 * (manoeuvre.speed - u) for u in speeds]
    applied = [list(message.data[3:7]) for _, message in messages["/applied_command"]]
    assert applied[1:] == [[0.0, 0.0, torque, torque] for torque in wanted[:-1]]
    assert max(wanted) > 1.0  # N m


def test_the_rollover_is_latched_and_the_descriptions_come_first(messages):
    assert [(sent, m.data) for sent, m in messages["/rollover"]] == [
        (0, False),
        (2_965_000_000, True),
    ]
    ((sent, description),) = messages["/simulation_description"]
    told = json.loads(description.data)
    assert (sent, told["step"], told["publish_period"]) == (0, 0.001, PERIOD)
    assert told["vehicle"]["cg_height"] == 0.75
    assert told["tire"]["PDY1"] == preset().tire.coefficients["PDY1"]
    assert messages["/robot_description"][0][1].data.startswith("<?xml")


def test_the_metadata_says_what_was_simulated(j_turn, messages):
    metadata = yaml.safe_load((j_turn / "metadata.yaml").read_text())
    told = metadata["rosbag2_bagfile_information"]["custom_data"]["simulation_description"]
    assert told == messages["/simulation_description"][0][1].data


def test_the_8_dof_model_has_its_own_states_and_no_transform_to_the_body(tmp_path):
    simulation = record(tmp_path / "bag", Options(model="8dof"), "step_steer", 0.5)
    messages = read_by_another_library(tmp_path / "bag")
    _, last = messages["/state"][-1]
    assert [dimension.label for dimension in last.layout.dim[1:]] == list(simulation.state_names)
    assert list(last.data[1:]) == list(simulation.model_state)
    assert len(messages["/tf"][-1][1].transforms) == 1


def test_the_same_run_gives_the_same_bytes(j_turn, tmp_path):
    record(tmp_path / "j_turn")
    files = sorted(file.name for file in j_turn.iterdir())
    assert files == ["j_turn_0.mcap", "metadata.yaml"]
    for name in files:
        assert (tmp_path / "j_turn" / name).read_bytes() == (j_turn / name).read_bytes()


def test_a_run_that_is_broken_off_leaves_nothing(tmp_path):
    simulation = Simulation(preset())

    def interrupt(seconds):
        raise KeyboardInterrupt

    def interrupted():
        with run_bag(simulation, ("steering",), tmp_path / "bag", PERIOD_NS, "--bag") as observer:
            run(simulation, STANDARD["j_turn"], 1.0, observer=observer, progress=interrupt)

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert list(tmp_path.iterdir()) == []


def test_what_is_there_already_is_left_alone(tmp_path):
    (tmp_path / "bag").mkdir()
    with (
        pytest.raises(InputError, match="does not exist yet"),
        run_bag(Simulation(preset()), ("steering",), tmp_path / "bag", PERIOD_NS, "--bag"),
    ):
        pass
    assert list((tmp_path / "bag").iterdir()) == []


def test_the_tire_forces_of_a_bag_are_those_of_the_run(tmp_path):
    result = run_offline("step_steer", duration=1.5, bag=tmp_path / "bag")
    with_forces, _ = last_run(tmp_path / "bag", with_forces=True)
    for quantity in ("longitudinal_force", "lateral_force", "normal_force"):
        np.testing.assert_array_equal(with_forces.wheels(quantity), result.wheels(quantity))
    assert np.abs(with_forces["lateral_force_rf"]).max() > 1000.0
    assert np.isnan(last_run(tmp_path / "bag")[0].wheels("lateral_force")).all()
