"""The names in the layouts exist: topics, fields, elements and frames."""

import functools
import json
import re
from xml.etree import ElementTree

import launch_files
import pytest
import yaml
from recordings import read_bag

from vehicle_roll_sim import WHEELS, Simulation, preset
from vehicle_roll_sim.messages.command_topics import COMMANDS
from vehicle_roll_sim.messages.sets import COMMAND_LABELS
from vehicle_roll_sim.messages.topics import PUBLISHED
from vehicle_roll_sim.ros.orchestration.domains import own_domain
from vehicle_roll_sim.ros.topics import message_class

CONFIG = launch_files.PACKAGE / "config"
TOPICS = {f"/{topic.name.lstrip('/')}": topic for topic in (*COMMANDS, *PUBLISHED)}
FRAMES = {"odom", "base_footprint", "base_link"}
SHOWN_BY = {
    "Wrench": "WrenchStamped",
    "Odometry": "Odometry",
    "RobotModel": "String",
    "Marker": "Marker",
}
"""Message types of RViz's displays."""
DEGREES = 57.29577951308232


@functools.cache
def labels() -> dict[str, tuple[str, ...]]:
    """Names of the elements of the multi-arrays."""
    return {
        "/state": ("time", *Simulation(preset()).state_names),
        "/applied_command": COMMAND_LABELS,
        "/tire_normal_forces": WHEELS,
        "/lift_off": WHEELS,
    }


def plotjuggler() -> ElementTree.Element:
    return ElementTree.parse(CONFIG / "plotjuggler.xml").getroot()


def foxglove() -> dict:
    return json.loads((CONFIG / "foxglove.json").read_text())


def rviz() -> dict:
    return yaml.safe_load((CONFIG / "vehicle.rviz").read_text())["Visualization Manager"]


def series_of_plotjuggler() -> list[tuple[str, str]]:
    """(title, series) of every curve, that of the path twice."""
    root, found = plotjuggler(), []
    computed = {s.get("name"): s.findtext("linked_source") for s in root.iter("snippet")}
    for curve in root.iter("curve"):
        name = curve.get("name")
        along = [curve.get(axis) for axis in ("curve_x", "curve_y") if curve.get(axis)]
        found += [(name, series) for series in along or [computed.get(name, name)]]
    return found


def series_of_foxglove() -> list[tuple[str, str]]:
    """(title, message path) of everything that a panel shows."""
    found = []
    for panel in foxglove()["configById"].values():
        title = panel["foxglovePanelTitle"]
        found += [(path["label"], path["value"]) for path in panel.get("paths", ())]
        found += [("x", panel["xAxisPath"]["value"])] if "xAxisPath" in panel else []
        found += [(title, panel[key]) for key in ("path", "topicPath") if key in panel]
    return found


def steps_of(series: str) -> tuple[str, list[str]]:
    """Topic, and the names and indices that lead to the value, of either program's notation."""
    topic = max((t for t in TOPICS if re.match(re.escape(t) + r"(?=[./]|$)", series)), key=len)
    return topic, re.findall(r"\w+", series.removeprefix(topic))


ALL = sorted({*series_of_plotjuggler(), *series_of_foxglove()})


def value_in(message, steps: list[str]):
    for step in steps:
        message = message[int(step)] if step.isdigit() else getattr(message, step)
    return message


@pytest.mark.parametrize(("title", "series"), ALL)
def test_what_is_plotted_is_a_field_and_an_element_is_what_the_title_calls_it(title, series):
    topic, steps = steps_of(series)
    message = message_class(TOPICS[topic].type)()
    if steps and steps[-1].isdigit():
        *steps, index = steps
        label = labels()[topic][int(index)]
        assert re.sub(r" \(.*\)", "", title).split()[-1] == label or (title, label) in {
            ("path", "x"),
            ("path", "y"),
        }
    value_in(message, steps)


def test_the_tabs_of_plotjuggler_show_what_they_are_named_after():
    names = [tab.get("tab_name") for tab in plotjuggler().iter("Tab")]
    assert names == [
        *("steering", "roll", "lateral acceleration", "yaw rate"),
        *("tire loads", "lift-off", "load transfer", "path"),
    ]
    for tab in plotjuggler().iter("Tab"):
        for splitter in tab.iter("DockSplitter"):
            count = int(splitter.get("count"))
            assert count == len(list(splitter)) == len(splitter.get("sizes").split(";"))
        assert tab.find(".//curve") is not None


def test_every_computed_curve_of_plotjuggler_is_shown_and_only_changes_the_unit():
    root = plotjuggler()
    shown = {curve.get("name") for curve in root.iter("curve")}
    for snippet in root.iter("snippet"):
        name, function = snippet.get("name"), snippet.findtext("function")
        assert name in shown
        in_degrees = function == f"return value * {DEGREES}"
        assert in_degrees == ("(deg" in name)
        assert in_degrees or function == "return value"


def test_every_panel_of_foxglove_is_placed_once():
    layout, places = foxglove(), []

    def visit(node):
        if isinstance(node, str):
            places.append(node)
            return
        assert node["direction"] in ("row", "column")
        assert 0 < node["splitPercentage"] < 100
        visit(node["first"])
        visit(node["second"])

    visit(layout["layout"])
    assert sorted(places) == sorted(layout["configById"])


def test_the_scene_of_foxglove_is_the_vehicle_on_its_ground():
    (scene,) = (p for name, p in foxglove()["configById"].items() if name.startswith("3D!"))
    layers = scene["layers"]
    assert layers["vehicle"]["topic"] in TOPICS
    assert layers["vehicle"]["jointStatesTopic"] in TOPICS
    assert layers["vehicle"]["controlMode"] == "jointStates"  # recordings may be without /tf
    assert {scene["followTf"], layers["grid"]["frameId"]} <= FRAMES
    assert set(scene["topics"]) <= set(TOPICS)


def test_rviz_shows_topics_of_the_right_type_and_gets_what_was_sent_before():
    shown = set()
    for display in rviz()["Displays"]:
        topic = display.get("Topic") or display.get("Description Topic")
        if topic:
            found = TOPICS[topic["Value"]]
            kind = display["Class"].removeprefix("rviz_default_plugins/")
            assert found.type.endswith(f"/{SHOWN_BY[kind]}")
            durability = "Transient Local" if found.latched else "Volatile"
            assert topic["Durability Policy"] == durability
            assert topic["Reliability Policy"] == "Reliable"
            shown.add(topic["Value"])
    forces = {f"/tire_forces/{wheel}" for wheel in WHEELS}
    assert shown == {"/robot_description", "/road", "/odom", *forces}


def test_rviz_looks_at_frames_that_are_there():
    manager = rviz()
    assert manager["Global Options"]["Fixed Frame"] == "odom"
    assert manager["Views"]["Current"]["Target Frame"] == "base_footprint"
    (frames,) = (d["Frames"] for d in manager["Displays"] if d["Class"].endswith("/TF"))
    assert set(frames) - {"All Enabled"} == FRAMES


@pytest.fixture(scope="module")
def recorded(tmp_path_factory) -> dict[str, list]:
    """A J-turn in lockstep that ends in a rollover: decoded messages by topic."""
    pytest.importorskip("rosbags", reason="the recorder needs the library rosbags")
    folder = tmp_path_factory.mktemp("recorded")
    with pytest.MonkeyPatch.context() as patch, launch_files.stand_in(patch, folder / "install"):
        patch.setenv("ROS_LOG_DIR", str(folder / "log"))
        given = {"lockstep": "true", "bag": str(folder / "bag")}
        with own_domain() as domain:
            results = launch_files.run("manoeuvre", domain, **given)
    assert "rolled over" in results["manoeuvre"][1]
    return read_bag(folder / "bag")


@pytest.mark.parametrize(("title", "series"), ALL)
def test_a_recording_has_what_is_plotted(recorded, title, series):
    topic, steps = steps_of(series)
    messages = recorded[topic]
    assert messages
    if steps and steps[-1].isdigit():
        assert messages[0].layout.dim[int(steps[-1])].label == labels()[topic][int(steps[-1])]
    values = [value_in(message, steps) for message in messages]
    if steps:
        assert all(isinstance(value, (bool, int, float)) for value in values)


def test_a_recording_of_a_rollover_shows_it(recorded):
    """Steered to the left, rolled to the right, one wheel after the other in the air."""
    steering = [message.data[1] for message in recorded["/applied_command"]]
    roll = [message.data[4] for message in recorded["/state"]]
    assert max(steering) == pytest.approx(10 / DEGREES)
    assert max(roll) > 1.4  # 85° is where the run ends
    assert [max(m.data[i] for m in recorded["/lift_off"]) for i in range(4)] == [1, 1, 1, 1]
    assert [message.data for message in recorded["/rollover"]] == [False, True]
    assert {len(message.position) for message in recorded["/joint_states"]} == {12}
