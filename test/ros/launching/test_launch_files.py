"""Launch files: arguments are documented, names exist, and the launch ends."""

import importlib.util
import itertools
import os
import re
import sys
from pathlib import Path

import launch_files
import launch_stand_in
import numpy as np
import pytest
from launch_files import actions_of
from recordings import read_bag

from vehicle_roll_sim.messages.sets import COMMAND_LABELS
from vehicle_roll_sim.messages.topics import STATE_SET

ROOT = Path(__file__).parents[3]
MANUAL = ROOT / "docs" / "launch.md"
EXAMPLES = ROOT / "msg_examples"


def parameters_of(command: list[str]) -> dict[str, str]:
    """Those that a command line gives after -p."""
    words = [word for flag, word in itertools.pairwise(command) if flag == "-p"]
    return dict(word.split(":=", 1) for word in words)


def documented() -> dict[str, dict[str, str]]:
    """Defaults of the arguments in the manual, by launch file and name."""
    _, _, table = MANUAL.read_text().partition("| argument |")
    rows = re.findall(r"^\| `(\w+)` \| ([^|]*) \| ([^|]*) \|", table, re.MULTILINE)
    found = {name: {} for name in launch_files.NAMES}
    for argument, files, default in rows:
        for name in launch_files.NAMES if files == "all" else files.replace("`", "").split(", "):
            found[name][argument] = default.strip("`")
    return found


@pytest.mark.parametrize("name", launch_files.NAMES)
def test_the_arguments_are_those_of_the_manual_and_described(launching, monkeypatch, name):
    monkeypatch.delenv(launching.DISCOVERY)
    declared = [
        entity
        for entity in launch_files.load(name).entities
        if isinstance(entity, launch_stand_in.DeclareLaunchArgument)
    ]
    assert len({argument.name for argument in declared}) == len(declared)
    assert all(argument.description for argument in declared)
    defaults = {
        argument.name: re.sub(r"bag_[-\d]+", "bag_DATE-TIME", argument.default_value or "empty")
        for argument in declared
    }
    assert defaults == documented()[name]


@pytest.mark.parametrize("name", launch_files.NAMES)
def test_every_executable_of_the_package_that_is_started_is_installed(launching, name):
    entries = re.findall(r'f"(\w+) = \{NAME\}\.ros', (ROOT / "setup.py").read_text())
    started = [a for a in actions_of(name).values() if isinstance(a, launch_stand_in.Node)]
    own = [node.executable for node in started if node.package == "vehicle_roll_sim"]
    assert "simulator" in own
    assert set(own) <= set(entries)


def test_lockstep_waits_for_what_a_controller_commands(launching):
    actions = actions_of("controller", controller="active_roll_bar", lockstep="true")
    given = parameters_of(actions["simulator"].cmd)
    assert given["lockstep_topics"] == "[steering_cmd, normal_force_cmd]"
    assert Path(actions["active_roll_bar"].cmd[1]).samefile(EXAMPLES / "active_roll_bar.py")


@pytest.mark.parametrize("script", EXAMPLES.glob("*.py"), ids=lambda path: path.stem)
def test_what_a_controller_answers_is_said_by_one_that_is_started_before_it(launching, script):
    foreseeing = "rollover_prediction"
    if f'"{foreseeing}"' in script.read_text() and script.stem != "rollover_warning":
        given = {"controller": script.stem, "answers": "brake_torque_cmd"}
        names = list(actions_of("controller", **given))
        assert names.index("rollover_warning") < names.index(script.stem)


MINE = """
'Not the docstring: brake_torque_cmd and rear_steering_cmd.'
COMMAND, WATCHED = "brake_torque_cmd", "tire_normal_forces"
"""


@pytest.mark.parametrize(
    ("answers", "expected"), [("", "brake_torque_cmd"), ("speed_cmd", "speed_cmd")]
)
def test_a_controller_of_ones_own_is_a_path(launching, tmp_path, answers, expected):
    own = tmp_path / "mine.py"
    own.write_text(MINE)
    given = {"controller": f"{own} active_roll_bar", "answers": answers}
    actions = actions_of("controller", lockstep="true", parameters="gain:=2.0 on:=1", **given)
    assert actions["mine"].cmd[:2] == [sys.executable, str(own)]
    assert parameters_of(actions["mine"].cmd) == {"gain": "2.0", "on": "1"}
    assert "active_roll_bar" in actions
    topics = parameters_of(actions["simulator"].cmd)["lockstep_topics"]
    with_example = ["normal_force_cmd"] if not answers else []
    assert sorted(topics.strip("[]").split(", ")) == sorted(
        ["steering_cmd", expected, *with_example]
    )


def test_a_parameter_goes_to_the_scripts_that_name_it(launching):
    given = {
        "controller": "roll_braking",
        "parameters": "smoothing:=0.1 threshold:=0.7 thrshold:=1",
    }
    actions = actions_of("controller", **given)
    expected = {"smoothing": "0.1", "thrshold": "1"}
    assert parameters_of(actions["rollover_warning"].cmd) == expected
    assert parameters_of(actions["roll_braking"].cmd) == {"threshold": "0.7", "thrshold": "1"}


def test_lockstep_waits_for_all_that_a_manoeuvre_commands(launching):
    for given in ({"manoeuvre": "step_steer"}, {"options": "--speed-hold 500"}):
        actions = actions_of("manoeuvre", lockstep="true", **given)
        topics = parameters_of(actions["simulator"].cmd)["lockstep_topics"]
        assert topics == "[steering_cmd, wheel_torque_cmd]"
    for name, more in (("braking_in_a_turn", "brake_torque_cmd"), ("wind_gust", "wind_cmd")):
        actions = actions_of("manoeuvre", lockstep="true", manoeuvre=name)
        topics = parameters_of(actions["simulator"].cmd)["lockstep_topics"]
        assert topics == f"[steering_cmd, wheel_torque_cmd, {more}]"


def test_arguments_reach_the_simulator_and_what_is_empty_does_not(launching):
    assert parameters_of(actions_of("simulator")["simulator"].cmd) == {}
    given = {"model": "1", "initial_speed": "20", "frame_prefix": "a/", "params_file": "p.yaml"}
    command = actions_of("simulator", **given)["simulator"].cmd
    # quoted: text stays text where it looks like a number
    expected = {"model": '"1"', "initial_speed": "20", "frame_prefix": '"a/"'}
    assert parameters_of(command) == expected
    assert command[command.index("--params-file") + 1] == "p.yaml"
    assert command.index("--params-file") < command.index("-p")


@pytest.mark.parametrize("installed", [True, False])
def test_ros2_bag_records_where_it_is_installed(launching, monkeypatch, installed):
    monkeypatch.setattr(launching.shutil, "which", lambda _: "ros2" if installed else None)
    monkeypatch.setattr(launching.importlib.util, "find_spec", lambda _: installed or None)
    actions = actions_of("controller", bag="here")
    command = actions["ros2" if installed else "recorder"].cmd
    assert command[command.index("--output") + 1] == "here"
    if installed:
        assert command[:3] == ["ros2", "bag", "record"]
        assert command[command.index("--storage") + 1] == "mcap"


def test_nobody_elses_network_is_joined_unless_the_environment_says_so(launching, monkeypatch):
    monkeypatch.delenv(launching.DISCOVERY)
    assert actions_of("simulator")[launching.DISCOVERY].value == "LOCALHOST"
    monkeypatch.setenv(launching.DISCOVERY, "SUBNET")
    assert actions_of("simulator")[launching.DISCOVERY].value == "SUBNET"
    given = actions_of("simulator", discovery_range="OFF")
    assert given[launching.DISCOVERY].value == "OFF"


def test_controller_recording_and_manoeuvre_in_lockstep_end_with_the_manoeuvre(
    launching, domain, tmp_path
):
    pytest.importorskip("rosbags", reason="the recorder needs the library rosbags")
    bag = tmp_path / "bag"
    results = launch_files.run("controller", domain, lockstep="true", bag=str(bag))
    assert set(results) == {"simulator", "recorder", "active_roll_bar", "manoeuvre"}
    assert "6.000 s, complete" in results["manoeuvre"][1]
    assert "messages in" in results["recorder"][1]  # it has closed the bag
    messages = read_bag(bag)
    states = messages["/state"]
    assert [state.data[0] for state in states[-600:]] == pytest.approx(0.01 * np.arange(1, 601))
    assert {len(messages[f"/{topic.name}"]) for topic in STATE_SET} == {len(states)}
    forces = [
        command.data[COMMAND_LABELS.index("normal_force_rf")]
        for command in messages["/applied_command"]
    ]
    assert max(forces) > 100.0  # N: the controller has been heard


def test_a_launch_ends_when_its_simulator_does_not_start(launching, domain):
    results = launch_files.run("manoeuvre", domain, publish_rate="-1")
    status, _, err = results["simulator"]
    assert status == 2
    assert "publish_rate" in err


@pytest.mark.parametrize(
    ("name", "given", "named"),
    [
        ("controller", {"manoeuvre": "j_tum"}, "j_turn"),
        ("controller", {"controller": "bar"}, "active_roll_bar"),
        ("rviz", {"real_time_factor": "half"}, "real_time_factor: 'half' is not allowed: a number"),
    ],
)
def test_a_wrong_argument_is_refused_with_what_is_allowed(launching, name, given, named):
    with pytest.raises((RuntimeError, ValueError), match=named):
        actions_of(name, **given)


@pytest.mark.skipif(
    importlib.util.find_spec("launch") is None, reason="the package launch of ROS is not installed"
)
def test_launch_itself_runs_a_manoeuvre_to_its_end(monkeypatch, domain, tmp_path):
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
    from launch import LaunchDescription, LaunchService
    from launch.actions import IncludeLaunchDescription
    from launch.launch_description_sources import PythonLaunchDescriptionSource

    source = PythonLaunchDescriptionSource(
        os.fspath(launch_files.PACKAGE / "launch" / "manoeuvre.launch.py")
    )
    plot = tmp_path / "run.png"
    given = {"lockstep": "true", "options": f"--duration 1 --plot {plot}"}
    service = LaunchService()
    include = IncludeLaunchDescription(source, launch_arguments=given.items())
    service.include_launch_description(LaunchDescription([include]))
    assert service.run() == 0
    assert plot.read_bytes().startswith(b"\x89PNG")
