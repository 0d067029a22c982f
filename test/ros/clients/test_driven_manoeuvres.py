"""`manoeuvre` in lockstep equals the offline run, and reports what is missing."""

import csv
import dataclasses
import re

import pytest
import rclpy
from peers import TOPICS

from vehicle_roll_sim.command_line.main import main as offline
from vehicle_roll_sim.manoeuvres.catalogue import manoeuvre_named
from vehicle_roll_sim.ros.clients.manoeuvre_player import ManoeuvrePlayer
from vehicle_roll_sim.ros.clients.simulator_client import SimulatorClient
from vehicle_roll_sim.ros.node_main import lifetime
from vehicle_roll_sim.ros.topics import message_class, recording_qos

VEHICLE = {"cg_height": 0.55, "steering_ratio": 20.0, "front_roll_centre_height": 0.1}
"""The front roll centre is above the road, the rear one stays as deep below the c.g. as it was."""
STEERING, BOTH = (
    "lockstep_topics:=[steering_cmd]",
    "lockstep_topics:=[steering_cmd, wheel_torque_cmd]",
)
FROM_MESSAGES = ("lateral_acceleration",)
"""Columns that the node computes from messages, which rounds differently."""
SHORT = ("--duration", "1.5")
COMMANDING = {
    "braking_in_a_turn": (
        "brake_torque_cmd",
        {},
        ("--handwheel-angle", "20", "--brakes-from", "1.6", "--duration", "2.7"),
    ),
    "wind_gust": (
        "wind_cmd",
        {"side_force_area": 3.0},
        ("--start", "0.1", "--gust-time", "0.5", "--duration", "1.7"),
    ),
}
"""Manoeuvres that command more than steering and torque: topic, vehicle, and a short run."""
REPORTED = {
    "braking_in_a_turn": ("mean deceleration", "off the circle after 1 s"),
    "wind_gust": ("peak yaw rate after it", "deviation 1 s later"),
}


def simulator_words(*more: str) -> list[str]:
    values = [("-p", f"vehicle.{name}:={value}") for name, value in VEHICLE.items()]
    return ["--ros-args", *more, *(word for pair in values for word in pair)]


def lockstep(topics: str, *more: str) -> list[str]:
    return simulator_words("-p", "mode:=lockstep", "-p", topics, *more)


def values_of(summary: str) -> dict[str, str]:
    pairs = (text.partition(":") for text in summary.splitlines())
    return {label: value.strip() for label, _, value in pairs}


def run_offline(capsys, name: str, *more: str) -> dict[str, str]:
    """The summary of the run without middleware, with commands held as the node holds them."""
    words = [word for key, value in VEHICLE.items() for word in ("--set", f"{key}={value}")]
    offline(["run", name, "--command-period", "0.01", *words, *more])
    return values_of(capsys.readouterr().out)


def rows_of(path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.mark.parametrize("name", ["nhtsa_fishhook", "sine_with_dwell"])
def test_in_lockstep_a_manoeuvre_of_a_standard_has_the_summary_of_the_offline_run(
    start, capsys, name
):
    start("simulator", *lockstep(BOTH))
    status, out, err = start("manoeuvre", name).finish()
    assert (status, err) == (0, "")
    expected, found = run_offline(capsys, name), values_of(out)
    by_steps = {label for label in expected if label.startswith(("peak", "lift-off"))}
    for label in expected.keys() - by_steps:  # the node knows what comes between sets by samples
        assert found[label] == expected[label], label
    assert found.keys() == expected.keys()


@pytest.mark.parametrize(
    ("name", "topics", "bank"),
    [("step_steer", BOTH, 0.1), ("j_turn", BOTH, 0.0), ("j_turn", STEERING, 0.0)],
)
def test_in_lockstep_it_is_the_offline_run_to_the_bit_with_and_without_speed_hold(
    start, capsys, tmp_path, name, topics, bank
):
    """Where torques are waited for and nobody else gives them, it answers with zeros."""
    start("simulator", *lockstep(topics, "-p", f"bank:={bank}"))
    found, expected = tmp_path / "found.csv", tmp_path / "expected.csv"
    status, _, err = start("manoeuvre", name, "--csv", str(found)).finish()
    assert (status, err) == (0, "")
    run_offline(capsys, name, "--csv", str(expected), "--bank", str(bank))
    for one, other in zip(rows_of(found), rows_of(expected), strict=True):
        for column in FROM_MESSAGES:
            assert float(one[column]) == pytest.approx(float(other[column]), abs=1e-9)
        for column in one.keys() - {*FROM_MESSAGES}:
            assert one[column] in (other[column], "nan"), (other["time"], column)


@pytest.mark.parametrize(("name", "more"), COMMANDING.items())
def test_in_lockstep_brakes_and_wind_of_a_manoeuvre_are_those_of_the_offline_run(
    start, capsys, tmp_path, name, more
):
    topic, vehicle, words = more
    node = [word for key, value in vehicle.items() for word in ("-p", f"vehicle.{key}:={value}")]
    start("simulator", *lockstep(BOTH.replace("]", f", {topic}]"), *node))
    found, expected = tmp_path / "found.csv", tmp_path / "expected.csv"
    status, out, err = start("manoeuvre", name, *words, "--csv", str(found)).finish()
    assert (status, err) == (0, "")
    given = [word for key, value in vehicle.items() for word in ("--set", f"{key}={value}")]
    offline_values = run_offline(capsys, name, *words, "--csv", str(expected), *given)
    rows, others = rows_of(found), rows_of(expected)
    assert [row["y"] for row in rows] == [row["y"] for row in others]
    for label in REPORTED[name]:
        assert values_of(out)[label] == offline_values[label]


def test_a_second_manoeuvre_on_the_same_simulator_is_like_the_first(start, tmp_path):
    start("simulator", *lockstep(BOTH))
    files = [tmp_path / "first.csv", tmp_path / "second.csv"]
    for file in files:
        words = ("step_steer", *SHORT, "--speed", "20", "--csv", str(file))
        assert start("manoeuvre", *words).finish()[0] == 0
    first, second = (file.read_text(encoding="utf-8") for file in files)
    assert first == second


@pytest.mark.parametrize(
    ("topics", "missing"),
    [(STEERING, "wheel_torque_cmd"), ("lockstep_topics:=[normal_force_cmd]", "steering_cmd")],
)
def test_what_lockstep_does_not_wait_for_is_refused_in_one_line_that_says_what_to_set(
    start, topics, missing
):
    start("simulator", *lockstep(topics))
    status, out, err = start("manoeuvre", "step_steer").finish()
    assert (status, out) == (2, "")
    assert len(err.splitlines()) == 1
    assert f"lockstep_topics: {missing}" in err
    assert "-p lockstep_topics:=[" in err


def test_a_topic_that_somebody_else_commands_is_refused_or_left_to_them(start, peer):
    start("simulator", *lockstep(BOTH))
    peer.listen("state")
    torques = peer.publisher("wheel_torque_cmd")
    endless = ("--amplitude", "0.1", "--duration", "1000")
    status, _, err = start("manoeuvre", "step_steer", *endless).finish()
    assert status == 2
    assert len(err.splitlines()) == 1
    assert "wheel_torque_cmd: " in err
    assert "already commanded by" in err
    assert "--speed-hold 0" in err

    left_alone = start("manoeuvre", "j_turn", "--duration", "0.5")

    def answered_to_the_end():
        answered = len(peer.received["state"])
        while answers[0] < answered:
            torques.publish(torques.msg_type(data=[0.0] * 4))
            answers[0] += 1
        return left_alone.process.poll() is not None

    answers = [0]
    peer.wait(answered_to_the_end, "the end of the manoeuvre")
    assert left_alone.finish()[0] == 0


def test_steering_that_somebody_else_commands_is_refused_as_soon_as_they_are_known(start, peer):
    start("simulator", *lockstep(STEERING))
    peer.publisher("steering_cmd")
    endless = ("--amplitude", "0.1", "--duration", "1000")  # a minute: nodes are known in seconds
    status, _, err = start("manoeuvre", "j_turn", *endless).finish()
    assert status == 2
    assert len(err.splitlines()) == 1
    assert "steering_cmd: " in err
    assert "already commanded by" in err


def test_a_controller_that_never_comes_is_named(start):
    start("simulator", *lockstep("lockstep_topics:=[steering_cmd, normal_force_cmd]"))
    status, _, err = start("manoeuvre", "j_turn").finish()
    assert status == 1
    assert len(err.splitlines()) == 1
    assert "no node publishes normal_force_cmd" in err


@pytest.fixture
def driver(domain):
    """The node of a short manoeuvre with speed hold, in this process."""
    rclpy.init(args=[], domain_id=domain)
    manoeuvre = dataclasses.replace(manoeuvre_named("step_steer"), duration=1.5)
    yield ManoeuvrePlayer(manoeuvre)
    rclpy.try_shutdown()


def test_whoever_is_known_to_listen_gets_every_command_and_none_from_before_the_reset(
    start, driver, peer
):
    """As a recorder listens: best effort, so that what is sent before a match is lost."""
    start("simulator", *lockstep(BOTH))
    commands = {"steering_cmd": [], "wheel_torque_cmd": []}
    for name, kept in commands.items():
        kind, qos = message_class(TOPICS[name].type), recording_qos(TOPICS[name])
        peer.node.create_subscription(kind, name, kept.append, qos)
    peer.wait(lambda: driver.count_subscribers("wheel_torque_cmd") == 2, "all to be known")
    with lifetime(driver) as executor:
        driver.prepare(SimulatorClient(driver, executor, "simulator"))
        driver.play()
    periods = len(driver.sent)
    assert periods == 150
    for name, kept in commands.items():
        peer.wait(lambda kept=kept: len(kept) >= periods, f"every {name}")
        assert len(kept) == periods
    assert [message.data for message in commands["steering_cmd"]] == list(driver.sent.values())


def test_in_real_time_the_fishhook_reverses_at_the_roll_rate_too(start):
    start("simulator", *simulator_words())
    status, out, _ = start("manoeuvre", "nhtsa_fishhook", "--duration", "3").finish()
    assert status == 0
    found = values_of(out)
    roll_rate = re.search(r"roll rate of (\S+) deg/s", found["steering reversal"])
    assert float(roll_rate[1]) <= 1.5
    assert float(found["handwheel amplitude"].split()[0]) == pytest.approx(
        6.5 * float(found["handwheel angle at 0.3 g"].split()[0]), abs=0.01
    )


def test_a_vehicle_that_the_manoeuvre_is_not_for_ends_with_one_line_and_status_2(start):
    start("simulator", *simulator_words())
    status, _, err = start("manoeuvre", "nhtsa_j_turn", "--scalar", "90").finish()
    assert status == 2
    assert len(err.splitlines()) == 1
    assert "handwheel angle" in err
