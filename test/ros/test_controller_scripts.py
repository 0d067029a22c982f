"""The topics that a controller script commands are read from it without running it."""

import pytest

from vehicle_roll_sim import InputError
from vehicle_roll_sim.ros.controller_scripts import EXAMPLES, commanded_by, scripts_of

HEARS_STEERING = """
class Mine(Controller):
    heard = ("steering_cmd", "motion")
    said = {said}
"""


@pytest.mark.parametrize(
    ("said", "commands"),
    [
        ('("brake_torque_cmd",)', ["brake_torque_cmd"]),
        ('"speed_cmd"', ["speed_cmd"]),
        ('["rear_steering_cmd", "brake_torque_cmd"]', ["rear_steering_cmd", "brake_torque_cmd"]),
        ('(Topic("warning", "std_msgs/msg/Bool"), "speed_cmd")', ["speed_cmd"]),
        ('(Topic("warning", "std_msgs/msg/Bool"),)', []),
    ],
)
def test_commands_are_those_that_are_declared_as_said_not_those_that_are_heard(
    tmp_path, said, commands
):
    script = tmp_path / "mine.py"
    script.write_text(HEARS_STEERING.format(said=said))
    assert commanded_by([script], "controller") == commands


@pytest.mark.parametrize("said", ["(BRAKES,)", "Topic(BRAKES, KIND)", "BRAKES"])
def test_where_that_is_not_written_out_all_texts_count(tmp_path, said):
    script = tmp_path / "mine.py"
    script.write_text('BRAKES = "brake_torque_cmd"\n' + HEARS_STEERING.format(said=said))
    assert commanded_by([script], "controller") == ["steering_cmd", "brake_torque_cmd"]


def test_examples_are_found_by_name_with_those_that_they_need():
    names = [script.stem for script in scripts_of(["roll_braking", "yaw_control"], "SCRIPT")]
    assert names == ["rollover_warning", "roll_braking", "yaw_control"]
    assert commanded_by(scripts_of(["roll_braking"], "SCRIPT"), "SCRIPT") == ["brake_torque_cmd"]


@pytest.mark.parametrize("name", ["none.py", ".", "__init__", "executables", ""])
def test_what_is_no_script_is_refused_with_the_examples_that_there_are(name):
    with pytest.raises(InputError, match=r"SCRIPT: .*active_roll_bar, .*yaw_control"):
        scripts_of([name], "SCRIPT")


@pytest.mark.parametrize("content", [b"def (", b"\xff\xfe\x00", b"a\x00b"])
def test_what_is_not_python_is_refused_in_one_line(tmp_path, content):
    script = tmp_path / "mine.py"
    script.write_bytes(content)
    with pytest.raises(InputError, match=r"SCRIPT: .*mine\.py: .*: a Python script"):
        commanded_by([script], "SCRIPT")


def test_every_example_is_a_script_beside_the_messages_too(request):
    folder = request.config.rootpath / "msg_examples"
    examples = {path.name for path in EXAMPLES.glob("*.py")} - {"__init__.py", "executables.py"}
    assert {path.name for path in folder.glob("*.py")} == examples
    for name in examples:
        assert (folder / name).read_bytes() == (EXAMPLES / name).read_bytes()
