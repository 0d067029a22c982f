"""Commands of ROS 2, checked against what the package declares; nothing is started by them."""

import contextlib
import importlib
import runpy
import signal
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from unittest import mock

import forked
import launch_files
import launch_stand_in
import pytest
import rclpy
import yaml
from parsing import PACKAGE, arguments_of, executables
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from vehicle_roll_sim.messages.command_topics import COMMANDS, WAYS_IN
from vehicle_roll_sim.messages.topics import PUBLISHED, STAMPED
from vehicle_roll_sim.ros import services
from vehicle_roll_sim.ros.clients import controller as base
from vehicle_roll_sim.ros.clients.recorder import Recorder
from vehicle_roll_sim.ros.node_main import refuse_unknown_parameters
from vehicle_roll_sim.ros.orchestration import compare, score
from vehicle_roll_sim.ros.orchestration.domains import own_domain
from vehicle_roll_sim.ros.simulator.node import Simulator
from vehicle_roll_sim.ros.simulator.parameters import PARAMETERS
from vehicle_roll_sim.ros.topics import message_class

EVERY_TOPIC = (*COMMANDS, *WAYS_IN, *PUBLISHED, *STAMPED)
TOPICS = {topic.name.lstrip("/"): topic.type for topic in EVERY_TOPIC}
SERVICES = {f"/simulator/{each.name}": each for each in services.SERVICES}
NODES = {"simulator": Simulator, "recorder": Recorder}
"""Executables whose parameters are known only from their node, and its class."""


def check_run(name: str, words: list[str]) -> None:
    """`ros2 run vehicle_roll_sim NAME …`: words, parameters and scripts are known."""
    arguments = arguments_of(name, words)
    if name == "compare":
        compare.scenario_of(arguments)
        compare.chain_of(arguments)
        for script in arguments.scripts:
            if script.endswith(".py"):
                check_script(script)
    elif name == "score":
        score.controllers_of(arguments)
    elif name in NODES:
        _make(NODES[name], words)
    elif executables()[name].module.startswith(f"{PACKAGE}.examples"):
        module = importlib.import_module(f"{PACKAGE}.examples.{name}")
        _make(_controller_of(vars(module)), words)


def run_compare(words: list[str]) -> int:
    """`compare …` in this process, with nodes that are forked; returns its exit status."""
    usual = {each: signal.getsignal(each) for each in (signal.SIGINT, signal.SIGTERM)}
    with pytest.MonkeyPatch.context() as patched:
        forked.fork_nodes(patched)
        patched.delenv("MPLBACKEND", raising=False)  # nodes draw nothing
        patched.setattr(sys, "argv", ["compare", *words])
        try:
            return compare.main()
        finally:
            for signum, handler in usual.items():
                signal.signal(signum, handler)


def check_script(script: str, *words: str) -> None:
    """`python3 SCRIPT …` for a controller: its node accepts these arguments."""
    _make(_controller_in(Path(script)), words)


def check_launch(name: str, words: list[str]) -> None:
    """`ros2 launch vehicle_roll_sim NAME …`: arguments, and what is started by them."""
    assert name.removesuffix(".launch.py") in launch_files.NAMES, f"no launch file {name}"
    given = dict(word.split(":=", 1) for word in words if word != "--show-args")
    description = launch_files.load(name.removesuffix(".launch.py"))
    declared = {getattr(each, "name", None) for each in description.entities}
    assert given.keys() <= declared, f"no argument {' '.join(given.keys() - declared)}"
    for action in launch_stand_in.actions_of(description, **given):
        if getattr(action, "package", None) == PACKAGE:
            check_run(action.executable, action.cmd[4:])  # behind python -m executables NAME
        elif action.__class__ is launch_stand_in.ExecuteProcess:  # a script of a controller
            check_script(*action.cmd[1:])


def check_talk(words: list[str]) -> None:
    """`ros2 topic`, `ros2 param` or `ros2 service`: names, types and values."""
    kind, verb, *rest = (word for word in words if not word.startswith("--"))
    {"topic": _check_topic, "param": _check_parameter, "service": _check_service}[kind](verb, rest)


def _check_topic(verb: str, words: list[str]) -> None:
    named = [word.lstrip("/") for word in words if word.lstrip("/") in TOPICS]
    assert verb == "list" or len(named) == 1, f"no topic in {words}"
    if verb == "pub":
        kind, text = words[-2:]
        assert kind == TOPICS[named[0]], f"{named[0]} is of the type {TOPICS[named[0]]}"
        _fill(message_class(kind)(), text)


def _check_parameter(verb: str, words: list[str]) -> None:
    node, *rest = words
    assert node == "/simulator", f"no node {node}"
    if rest:
        assert rest[0] in PARAMETERS, f"no parameter {rest[0]}"
    if verb == "set":
        PARAMETERS[rest[0]].validate(yaml.safe_load(rest[1]), rest[0])


def _check_service(verb: str, words: list[str]) -> None:
    name, kind, *text = words
    assert verb == "call", f"ros2 service {verb}"
    assert name in SERVICES, f"no service {name}"
    assert kind == SERVICES[name].type, f"{name} is not of the type {kind}"
    _fill(SERVICES[name].kind.Request(), *text)


def _fill(message, text: str = "{}") -> None:
    """Set the fields of a message from a YAML text."""
    _fill_fields(message, yaml.safe_load(text))


def _fill_fields(message, values: dict) -> None:
    for name, value in values.items():
        assert hasattr(message, name), f"{type(message).__name__} has no field {name}"
        if isinstance(value, dict):
            _fill_fields(getattr(message, name), value)
        else:
            setattr(message, name, value)


def _controller_in(script: Path) -> type[Node]:
    """The controller class that a script runs."""
    found = []
    with mock.patch(f"{PACKAGE}.controller.run", found.append):
        runpy.run_path(str(script), run_name="__main__")
    assert len(found) == 1, f"{script} runs no controller"
    return found[0]


def _controller_of(names: dict) -> type[Node]:
    kinds = [
        each
        for each in names.values()
        if isinstance(each, type) and issubclass(each, base.Controller)
        if each is not base.Controller
    ]
    return kinds[0]


def _make(kind: type[Node], words: Sequence[str]) -> None:
    """Create a node as an executable does, and refuse parameters that it does not declare."""
    with own_domain() as domain, _context([PACKAGE, *words], domain):
        node = kind()
        try:
            if issubclass(kind, base.Controller):
                refuse_unknown_parameters(node)
        finally:
            node.destroy_node()


@contextlib.contextmanager
def _context(words: list[str], domain: int) -> Iterator[None]:
    with mock.patch.object(sys, "argv", words):
        rclpy.init(args=words, domain_id=domain, signal_handler_options=SignalHandlerOptions.NO)
    try:
        yield
    finally:
        rclpy.try_shutdown()
