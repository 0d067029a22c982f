"""The base class of controllers: several topics of a set in, one answer per set out."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from patience import PATIENCE
from std_msgs.msg import Bool, Float64, Float64MultiArray

from vehicle_roll_sim import InputError
from vehicle_roll_sim.messages.run_messages import by_name
from vehicle_roll_sim.messages.topic import Topic
from vehicle_roll_sim.messages.topics import OF_SOME_SETS, PUBLISHED, STATE_SET
from vehicle_roll_sim.ros.clients.controller import heard_topics, message_of, said_topics

EXAMPLES = Path(__file__).parents[3] / "msg_examples"
PERIODS = 40
HEARS_SEVERAL = """
from vehicle_roll_sim.controller import Controller, by_name, run

class Several(Controller):
    node_name = "several"
    heard = ("lift_off", "motion", "steering_cmd", "imu", "state", "tire_normal_forces")
    said = ("brake_torque_cmd", "rear_steering_cmd")

    def answer(self, lift_off, motion, steering, imu, state, loads):
        motion, state = by_name(motion), by_name(state)
        stamp = imu.header.stamp.sec + 1e-9 * imu.header.stamp.nanosec
        yaw_rates = [motion["yaw_rate"], state["yaw_rate"], imu.angular_velocity.z]
        same_yaw_rate = float(max(yaw_rates) - min(yaw_rates) < 1e-12)
        return {
            "brake_torque_cmd": [motion["time"], state["time"], stamp, same_yaw_rate],
            "rear_steering_cmd": 0.5 * steering.data,
        }

run(Several)
"""
ANSWERS = """
from vehicle_roll_sim.controller import Controller, Topic, run

class Answers(Controller):
    node_name = "answers"
    heard = {heard}
    said = {said}

    def answer(self, *messages):
        return {answer}

run(Answers)
"""


def controller(folder, **parts: str) -> str:
    """A script whose class has these parts."""
    usual = {"heard": '("imu",)', "said": '("brake_torque_cmd",)', "answer": "[0.0] * 4"}
    script = folder / "mine.py"
    script.write_text(ANSWERS.format(**usual | parts))
    return str(script)


def test_several_topics_of_one_set_are_answered_once_and_together(start, peer, tmp_path):
    """In lockstep, where an answer too many or too few would show, with a chained command heard."""
    script = tmp_path / "several.py"
    script.write_text(HEARS_SEVERAL)
    topics = "[steering_cmd, brake_torque_cmd, rear_steering_cmd]"
    start("simulator", "--ros-args", "-p", "mode:=lockstep", "-p", f"lockstep_topics:={topics}")
    peer.listen("state", "applied_command")
    peer.publisher("steering_cmd")
    start("", program=str(script))
    peer.listen("brake_torque_cmd", "rear_steering_cmd")
    for period in range(PERIODS):
        peer.wait(lambda period=period: len(peer.received["state"]) > period, "the next set")
        peer.publish("steering_cmd", 0.001 * period)
    peer.wait(lambda: len(peer.received["applied_command"]) > PERIODS, "the last set")
    heard = peer.received["brake_torque_cmd"]  # which the simulator may have read first
    peer.wait(lambda: len(heard) >= PERIODS, "the last answer")
    brakes = [list(message.data) for _, message in heard]
    times = 0.01 * np.arange(PERIODS)
    np.testing.assert_allclose(brakes[:PERIODS], np.transpose([times] * 3 + [np.ones(PERIODS)]))
    assert len(brakes) == PERIODS
    driven = [message.data[2] for _, message in peer.received["applied_command"]]
    np.testing.assert_allclose(driven, [0.0, *(0.0005 * np.arange(PERIODS))])


def test_the_controller_of_the_manual_answers(start, peer, tmp_path):
    manual = (Path(__file__).parents[3] / "docs" / "controllers.md").read_text()
    script = tmp_path / "mine.py"
    script.write_text(manual.partition("```python\n")[2].partition("```")[0])
    start("simulator")
    start("", "--ros-args", "-p", "gain:=500", program=str(script))
    peer.listen("brake_torque_cmd")
    peer.command(
        {"steering_cmd": 0.05}, lambda: max(peer.newest("brake_torque_cmd").data), "brakes"
    )


@pytest.mark.parametrize(
    ("parts", "line"),
    [
        ({"heard": '("imus",)'}, "heard: 'imus' is unknown: did you mean imu?"),
        ({"heard": '("rollover",)'}, "rollover is not published with every set"),
        ({"heard": "()"}, "heard: () is not allowed: one or more topics"),
        ({"said": '"brake_torq_cmd"'}, "said: 'brake_torq_cmd' is unknown: did you mean"),
        ({"said": '("imu",)'}, "said: 'imu' is unknown: one of steering_cmd"),
        ({"heard": '("no such/topic",)'}, "heard: 'no such/topic' is unknown"),
    ],
)
def test_a_wrong_declaration_is_refused_in_one_line(start, tmp_path, parts, line):
    status, out, err = start("", program=controller(tmp_path, **parts)).finish()
    assert (status, out) == (2, "")
    assert err.startswith("mine.py: error: ")
    assert line in err
    assert len(err.splitlines()) == 1


@pytest.mark.parametrize(
    ("parts", "line"),
    [
        ({"answer": "None"}, "answer on brake_torque_cmd: missing: 4 numbers"),
        ({"answer": "[1.0, 2.0]"}, "answer on brake_torque_cmd: [1.0, 2.0] is not allowed"),
        (
            {"said": '("steering_cmd", "speed_cmd")', "answer": "0.1"},
            "answer: 0.1 is not allowed: a dict with steering_cmd and speed_cmd",
        ),
    ],
)
def test_a_wrong_answer_ends_it_with_one_line(start, tmp_path, parts, line):
    start("simulator")
    status, _, err = start("", program=controller(tmp_path, **parts)).finish()
    assert (status, len(err.splitlines())) == (2, 1)
    assert line in err


@pytest.mark.parametrize(
    ("example", "value", "line"),
    [
        ("yaw_control", "gain:=much", "gain: 'much' is not allowed: a number"),
        ("lqr_roll_bar", "roll_gain:=1e9", "roll_gain: 1000000000.0 is not allowed"),
        ("stability_control", "yaw_off:=0.5", "yaw_off: 0.5 is not allowed: at most yaw_on, 0.06"),
    ],
)
def test_a_wrong_parameter_is_refused_in_one_line(start, example, value, line):
    words = ("--ros-args", "-p", value)
    status, out, err = start("", *words, program=str(EXAMPLES / f"{example}.py")).finish()
    assert (status, out, len(err.splitlines())) == (2, "", 1)
    assert err.startswith(f"{example}.py: error: {line}")


def test_topics_are_declared_by_name_and_others_with_their_type():
    own = Topic("prediction", "std_msgs/msg/Float64MultiArray")
    assert list(heard_topics(("motion", own, "imu"))) == ["motion", "prediction", "imu"]
    assert heard_topics("imu") == heard_topics(("imu",))
    assert said_topics((own, "speed_cmd"))["prediction"] is own
    every_set = {topic.name for topic in (*STATE_SET, *OF_SOME_SETS)}
    assert set(heard_topics(every_set)) == every_set
    for topic in PUBLISHED:
        if topic.name not in every_set:
            with pytest.raises(InputError, match="not published with every set"):
                heard_topics((topic.name,))


@pytest.mark.parametrize(
    ("topic", "data", "message"),
    [
        ("steering_cmd", 1, Float64(data=1.0)),
        ("steering_cmd", np.float32(0.5), Float64(data=0.5)),
        ("brake_torque_cmd", (1, 2, 3, 4), Float64MultiArray(data=[1.0, 2.0, 3.0, 4.0])),
        (
            "normal_force_cmd",
            np.arange(4, dtype=np.float32),
            Float64MultiArray(data=[0.0, 1.0, 2.0, 3.0]),
        ),
        (Topic("warning", "std_msgs/msg/Bool"), np.True_, Bool(data=True)),
        (
            Topic("prediction", "std_msgs/msg/Float64MultiArray"),
            [1.0, float("inf")],
            Float64MultiArray(data=[1.0, float("inf")]),
        ),
    ],
)
def test_numbers_of_any_kind_and_arrays_of_any_length_serve_as_answers(topic, data, message):
    (declared,) = said_topics((topic,)).values()
    assert message_of(declared, data) == message


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("steering_cmd", [0.1, 0.2]),
        ("steering_cmd", "left"),
        ("steering_cmd", None),
        ("wheel_torque_cmd", 100.0),
        ("wheel_torque_cmd", [1.0, 2.0, 3.0]),
        ("wheel_torque_cmd", ["a"] * 4),
        ("wheel_torque_cmd", np.zeros((4, 2))),
    ],
)
def test_what_is_no_answer_is_refused_with_what_is_wanted(name, data):
    wanted = "a number" if name == "steering_cmd" else "4 numbers"
    with pytest.raises(InputError, match=f"answer on {name}: .*{wanted}"):
        message_of(said_topics((name,))[name], data)


def test_importing_the_base_leaves_signals_alone():
    """Unlike `vehicle_roll_sim.controller`, which is for scripts."""
    program = "import signal, vehicle_roll_sim.{}; print(signal.getsignal(signal.SIGINT))"
    said = [
        subprocess.run(
            [sys.executable, "-c", program.format(module)],
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            check=True,
        ).stdout
        for module in ("ros.clients.controller", "controller")
    ]
    assert ["default_int_handler" in text for text in said] == [True, False]


def test_labels_give_values_by_name(start, peer):
    start("simulator")
    peer.listen("motion")
    motion = by_name(peer.newest("motion"))
    assert motion["u"] == pytest.approx(13.889, abs=0.5)
    assert motion["steering"] == 0.0
