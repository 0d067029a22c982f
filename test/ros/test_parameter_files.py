"""A parameter file without a section for the node: one warning, exactly if ROS uses nothing."""

from types import SimpleNamespace

import pytest
import rclpy
from rclpy.context import Context
from rclpy.node import Node

from vehicle_roll_sim.ros.parameter_files import warn_of_files_for_others

SECTION = "{}:\n  ros__parameters:\n    initial_speed: 7.0\n"
SECTIONS = {
    "simulator": SECTION.format("simulator"),
    "/simulator": SECTION.format("/simulator"),
    "/car/simulator": SECTION.format("/car/simulator"),
    "car/simulator": SECTION.format("car/simulator"),
    "every node": SECTION.format("/**"),
    "every node of one level": SECTION.format("/*"),
    "of any namespace": SECTION.format("/**/simulator"),
    "of a namespace of one level": SECTION.format("/*/simulator"),
    "misspelt": SECTION.format("simulater"),
    "nested": "car:\n  simulator:\n    ros__parameters:\n      initial_speed: 7.0\n",
    "nested with slashes": "/car:\n  simulator:\n    ros__parameters:\n      initial_speed: 7.0\n",
    "two": SECTION.format("recorder") + SECTION.format("simulator"),
    "two of others": SECTION.format("recorder") + SECTION.format("manoeuvre"),
}


@pytest.fixture
def warnings(domain, monkeypatch):
    """warnings(*words, namespace): whether a node got its parameter, and what it warned of."""
    context = Context()
    rclpy.init(context=context, domain_id=domain)

    def warned(*words: str, namespace: str = "") -> tuple[bool, list[str]]:
        node = Node("simulator", context=context, namespace=namespace, cli_args=words)
        said = []
        monkeypatch.setattr(node, "get_logger", lambda: SimpleNamespace(warning=said.append))
        warn_of_files_for_others(node, ["simulator", *words])
        got = "initial_speed" in node._parameter_overrides
        node.destroy_node()
        return got, said

    yield warned
    rclpy.try_shutdown(context=context)


@pytest.mark.parametrize("namespace", ["", "/car", "/car/front"])
@pytest.mark.parametrize("text", SECTIONS.values(), ids=SECTIONS)
def test_it_is_warned_of_where_ros_takes_nothing(warnings, tmp_path, namespace, text):
    file = tmp_path / "params.yaml"
    file.write_text(text)
    got, said = warnings("--ros-args", "--params-file", str(file), namespace=namespace)
    assert len(said) == (0 if got else 1)
    assert all(f"no section for this node, {namespace}/simulator, " in line for line in said)


def test_every_file_that_is_for_others_is_named_with_its_sections(warnings, tmp_path):
    for name in ("one", "two", "three"):
        (tmp_path / name).write_text(SECTION.format(name) + SECTION.format("/a/b"))
    words = [word for name in ("one", "two") for word in ("--params-file", str(tmp_path / name))]
    aside = ("--", "--params-file", str(tmp_path / "three"))  # not for ROS
    _, said = warnings("--ros-args", *words, "-p", "initial_speed:=7.0", *aside)
    assert len(said) == 2
    for name, line in zip(("one", "two"), said, strict=True):
        assert line.startswith(f"{tmp_path / name} has no section for this node, /simulator, ")
        assert line.endswith(f"it has sections for: /{name}, /a/b")


def test_a_simulator_in_another_namespace_warns_and_runs(start, make_peer, tmp_path):
    file = tmp_path / "params.yaml"
    file.write_text(SECTIONS["simulator"])
    peer = make_peer("/car")
    simulator = start("simulator", "--ros-args", "-r", "__ns:=/car", "--params-file", str(file))
    peer.listen("state")
    peer.newest("state")
    status, _, err = simulator.finish(2)
    assert status == 0
    (line,) = (line for line in err.splitlines() if "WARN" in line)
    assert line.endswith(
        f"{file} has no section for this node, /car/simulator, and is ignored; "
        "it has sections for: /simulator"
    )
