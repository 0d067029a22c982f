"""The launch file of RViz: what is displayed, and the clock it uses."""

import os
import re
from pathlib import Path

import launch_files
import launch_stand_in
import pytest
import yaml
from launch_files import actions_of

from vehicle_roll_sim import Options, preset
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.messages.urdf import urdf


@pytest.mark.parametrize("model", ["", "1a", "2", "8dof"])
def test_rviz_is_shown_the_vehicle_that_is_simulated(launching, model):
    actions = actions_of("rviz", model=model)
    (parameters,) = actions["robot_state_publisher"].parameters
    description = parameters["robot_description"]
    assert description.value == urdf(preset(), Options(model=model or "1"))
    assert description.value_type is str
    (shown,) = (Path(word) for word in actions["rviz2"].cmd if word.endswith(".rviz"))
    assert shown.samefile(launch_files.PACKAGE / "config" / "vehicle.rviz")


@pytest.mark.parametrize(
    ("given", "simulated"),
    [({}, False), ({"lockstep": "true"}, True), ({"real_time_factor": "0.5"}, True)],
)
def test_pictures_go_by_the_clock_of_the_simulator(launching, given, simulated):
    actions = actions_of("rviz", **given)
    for name in ("robot_state_publisher", "rviz2"):
        assert actions[name].parameters[0]["use_sim_time"] is simulated


@pytest.mark.parametrize("spelt", ["true", "false"])
def test_pictures_go_by_the_clock_that_is_asked_for(launching, spelt):
    actions = actions_of("rviz", use_sim_time=spelt, real_time_factor="0.5")
    for name in ("robot_state_publisher", "rviz2"):
        assert actions[name].parameters[0]["use_sim_time"] is (spelt == "true")


@pytest.mark.parametrize("name", ["use_rviz", "rviz"])
def test_pictures_can_do_without_rviz(launching, name):
    """Also by the former name of the argument."""
    assert "rviz2" not in actions_of("rviz", **{name: "false"})


@pytest.mark.parametrize("launched", launch_files.NAMES)
def test_whatever_ends_ends_the_rest(launching, launched):
    for action in actions_of(launched, bag="here").values():
        if isinstance(action, launch_stand_in.ExecuteProcess):
            assert isinstance(action.on_exit, launch_stand_in.Shutdown), action.name


def without(prefix: Path, package: str, part: str) -> None:
    """Take a package, or only its executable, out of an install space."""
    marker = prefix / "share/ament_index/resource_index/packages" / package
    (marker if part == "package" else launch_files.program_in(prefix, package)).unlink()


@pytest.mark.parametrize("part", ["package", "executable"])
@pytest.mark.parametrize("package", ["rviz2", "robot_state_publisher"])
def test_what_is_not_installed_is_said_before_anything_is_started(
    launching, monkeypatch, package, part
):
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    without(Path(os.environ["AMENT_PREFIX_PATH"]), package, part)
    install = f"apt install ros-jazzy-{package.replace('_', '-')}"
    with pytest.raises(InputError, match=f"{package} is not installed: .*{install}") as refused:
        actions_of("rviz")
    assert ("use_rviz:=false" in str(refused.value)) is (package == "rviz2")
    if package == "rviz2":
        assert "robot_state_publisher" in actions_of("rviz", use_rviz="false")


def shown_by(actions) -> Path:
    (path,) = (Path(word) for word in actions["rviz2"].cmd if word.endswith(".rviz"))
    return path


NAMED = re.compile(r"^\W*(?:[\w ]+: )?(/[\w/]+)$", re.MULTILINE)
"""Topics in a configuration of RViz."""


def test_a_namespace_and_a_prefix_reach_all_that_shows_the_vehicle(launching):
    actions = actions_of("rviz", namespace="/car", frame_prefix="a/")
    for name in ("simulator", "robot_state_publisher", "rviz2"):
        words = actions[name].cmd
        assert "__ns:=/car" in words, name
    assert actions["robot_state_publisher"].parameters[0]["frame_prefix"].value == "a/"
    plain = (launch_files.PACKAGE / "config" / "vehicle.rviz").read_text()
    moved = shown_by(actions).read_text()
    topics = NAMED.findall(plain)
    assert "/odom" in topics
    assert NAMED.findall(moved) == [f"/car{topic}" for topic in topics]
    root = yaml.safe_load(moved)["Visualization Manager"]
    assert root["Global Options"]["Fixed Frame"] == "a/odom"
    assert root["Views"]["Current"]["Target Frame"] == "a/base_footprint"
    displays = {display.get("Name"): display for display in root["Displays"]}
    assert displays["vehicle"]["TF Prefix"] == "a"  # RViz puts the slash
    frames = set(displays["frames"]["Frames"]) - {"All Enabled"}
    assert frames == {"a/odom", "a/base_footprint", "a/base_link"}


def test_a_namespace_alone_leaves_the_frames_as_they_are(launching):
    actions = actions_of("rviz", namespace="car")
    changed = yaml.safe_load(shown_by(actions).read_text())
    plain = yaml.safe_load((launch_files.PACKAGE / "config" / "vehicle.rviz").read_text())
    assert changed != plain
    text = yaml.safe_dump(changed).replace("/car/", "/")
    assert yaml.safe_load(text) == plain


def test_a_prefix_that_rviz_cannot_show_is_refused(launching):
    with pytest.raises(InputError, match=r"frame_prefix: 'a_' is not allowed: .*slash"):
        actions_of("rviz", frame_prefix="a_")
    actions = actions_of("rviz", frame_prefix="a_", use_rviz="false")
    assert actions["robot_state_publisher"].parameters[0]["frame_prefix"].value == "a_"
