"""The SROS2 policy allows exactly what the nodes use. It cannot be enforced here."""

import functools
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest
from rclpy.action import get_action_server_names_and_types_by_node

import vehicle_roll_sim
from vehicle_roll_sim.messages.command_topics import WAYS_IN
from vehicle_roll_sim.messages.topics import ROAD, TRANSFORMS
from vehicle_roll_sim.ros.simulator import standard_services
from vehicle_roll_sim.ros.simulator.standard_services import ACTION, SERVICES, name_of
from vehicle_roll_sim.ros.topics import is_installed

ROOT = Path(vehicle_roll_sim.__file__).parent.parent
POLICY = ROOT / "policies" / "vehicle_roll_sim.policy.xml"
NODES = ("simulator", "manoeuvre", "recorder", "live_view")
ALLOWED = {
    ("topics", "publish"): "publisher",
    ("topics", "subscribe"): "subscriber",
    ("services", "reply"): "service",
    ("services", "request"): "client",
    ("actions", "execute"): "action",
}
"""Kinds of rules, and what rclpy calls what they allow."""
KINDS = tuple(ALLOWED.values())
CHILDREN = {
    "policy": {"enclaves"},
    "enclaves": {"enclave"},
    "enclave": {"profiles"},
    "profiles": {"profile"},
    "profile": {"topics", "services", "actions"},
    "topics": {"topic"},
    "services": {"service"},
    "topic": set(),
    "actions": {"action"},
    "service": set(),
    "action": set(),
}
"""What the schema of SROS2 policies, version 0.2.0, lets lie within what."""
ATTRIBUTES = {"enclave": {"path"}, "profile": {"ns", "node"}, "policy": {"version"}}


@pytest.fixture(scope="module")
def policy() -> ElementTree.Element:
    return ElementTree.parse(POLICY).getroot()


def allowed(policy, node: str) -> dict[str, set[str]]:
    """Full names that a node in the root namespace may use, by what rclpy calls their kind."""
    (profile,) = policy.findall(f".//profile[@node='{node}']")
    names = {kind: set() for kind in KINDS}
    for rules in profile:
        (action,) = rules.attrib
        for rule in rules:
            name = rule.text.replace("~", f"/{node}")
            names[ALLOWED[rules.tag, action]].add("/" + name.lstrip("/"))
    return names


def used(peer, node: str) -> dict[str, set[str]]:
    """The same as the graph has it."""
    ask_for = {
        **{kind: getattr(peer.node, f"get_{kind}_names_and_types_by_node") for kind in KINDS[:-1]},
        KINDS[-1]: functools.partial(get_action_server_names_and_types_by_node, peer.node),
    }
    return {kind: {name for name, _ in ask(node, "/")} for kind, ask in ask_for.items()}


def test_the_policy_is_one_after_the_schema_and_denies_by_allowing_nothing_else(policy):
    assert policy.attrib == {"version": "0.2.0"}
    for element in policy.iter():
        assert {child.tag for child in element} <= CHILDREN[element.tag], element.tag
        if element.tag in ATTRIBUTES:
            assert set(element.attrib) == ATTRIBUTES[element.tag]
        elif element.tag in ("topics", "services", "actions"):
            assert set(element.attrib.values()) == {"ALLOW"}
            assert len(element) > 0
        elif not len(element):
            assert "*" not in element.text
    assert [profile.get("node") for profile in policy.iter("profile")] == list(NODES)


def test_what_live_nodes_use_is_what_the_policy_allows(start, peer, policy, tmp_path):
    sensors = ("imu_period", "odom_period", "steering_sensor_period")
    of_sensors = (f"vehicle.{name}:=0.01" for name in sensors)
    actuated = "vehicle.steering_actuator_time_constant:=0.05"
    kinds = ("model:='2'", "body_contact:=true")
    further = ("publish_stamped:=true", *kinds, actuated, *of_sensors)
    every_topic = ("publish_clock:=true", *further)
    start("simulator", "--ros-args", *(word for each in every_topic for word in ("-p", each)))
    start("recorder", "--output", str(tmp_path / "bag"))
    start("live_view", "--port", "0")
    peer.listen("state", "applied_command")
    start("manoeuvre", "step_steer", "--duration", "1000")
    peer.wait(lambda: peer.newest("applied_command").data[1] != 0.0, "the manoeuvre to steer")
    for node in NODES:
        # Its endpoints may be found before the node itself.
        peer.wait(lambda node=node: node in peer.node.get_node_names(), f"the node {node}")
        names = allowed(policy, node)
        for topic in (TRANSFORMS, ROAD, *WAYS_IN):
            if not is_installed(topic):  # allowed for where it is
                for kind in ("publisher", "subscriber"):
                    names[kind].discard("/" + topic.name.lstrip("/"))
        if node == "manoeuvre":  # allowed for those that command brakes or wind
            names["publisher"] -= {"/brake_torque_cmd", "/wind_cmd"}
        if not standard_services.is_installed():
            names["action"].discard(f"/{node}/{name_of(ACTION)}")
            names["service"] -= {f"/{node}/{name_of(kind)}" for kind in SERVICES}
        peer.wait(lambda node=node, names=names: used(peer, node) == names, f"the uses of {node}")
