"""The building blocks of the launch files: their descriptions, and the processes to start."""

import importlib.util
import shlex
import shutil
import sys
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from launch import LaunchDescription
from launch.actions import (
    DeclareLaunchArgument,
    ExecuteProcess,
    OpaqueFunction,
    SetEnvironmentVariable,
    Shutdown,
)
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from vehicle_roll_sim.live.channels import channels
from vehicle_roll_sim.manoeuvres.catalogue import ON_ANY_ROAD
from vehicle_roll_sim.ros.controller_scripts import assigned, commanded_by, scripts_of
from vehicle_roll_sim.ros.launching.arguments import ARGUMENTS, DISCOVERY, Argument
from vehicle_roll_sim.ros.launching.values import YES, log_words, ros_words, understood
from vehicle_roll_sim.ros.simulator.settings import PUBLISHED_IN_SETS

PACKAGE = "vehicle_roll_sim"
TEXTS = ("model", "vehicle_file", "road_file", "frame_prefix")
NUMBERS = ("publish_rate", "initial_speed", "real_time_factor")
"""Arguments that are parameters of the simulator."""
TIME_TO_END = "10"
"""Time (s) that a process may take to end after SIGINT: a recorder has to close its bag."""


def launch_description(
    name: str, processes: Callable[[Mapping[str, str]], list]
) -> LaunchDescription:
    """The launch description of a launch file: its arguments, and `processes` of their values."""
    arguments = [_declared(each) for each in ARGUMENTS[name]]

    def start(context) -> list:
        given = {a.name: LaunchConfiguration(a.name).perform(context) for a in arguments}
        given = understood(given, context.launch_configurations)
        return [SetEnvironmentVariable(DISCOVERY, given["discovery_range"]), *processes(given)]

    return LaunchDescription([*arguments, OpaqueFunction(function=start)])


def _declared(argument: Argument) -> DeclareLaunchArgument:
    limited = {"choices": list(argument.choices)} if argument.choices else {}
    about = {"default_value": argument.value, "description": argument.description}
    return DeclareLaunchArgument(argument.name, **about, **limited)


def ends_all(what: str) -> Shutdown:
    """The action that ends the launch when a process has ended."""
    return Shutdown(reason=f"{what} has ended")


def simulator(given: Mapping[str, str], answers: Iterable[str] = ()) -> Node:
    """The simulator. answers: topics that lockstep waits for besides those of the manoeuvre."""
    words = ["--params-file", given["params_file"]] if given["params_file"] else []
    values = {name: f'"{given[name]}"' for name in TEXTS if given.get(name)}
    values |= {name: given[name] for name in NUMBERS if given[name]}
    if given["lockstep"] == YES:
        topics = dict.fromkeys((*_commanded_by_manoeuvre(given), *answers))
        listened = PUBLISHED_IN_SETS if given.get("bag") else ("state",)
        values |= {
            "mode": "lockstep",
            "lockstep_topics": f"[{', '.join(topics)}]",
            "lockstep_wait": f"[{', '.join(listened)}]",
        }
    if given["use_sim_time"] == YES:
        values["publish_clock"] = YES
    for name, value in values.items():
        words += ["-p", f"{name}:={value}"]
    return _node("simulator", given, ros_arguments=log_words(given) + words)


def _commanded_by_manoeuvre(given: Mapping[str, str]) -> tuple[str, ...]:
    """The topics that the manoeuvre commands; only the steering without a manoeuvre."""
    name = given.get("manoeuvre", "")
    fields = {*ON_ANY_ROAD[name].commanded} if name else {"steering"}
    if name and "--speed-hold" in given["options"]:
        fields.add("wheel_torque")
    return tuple(topic for topic, channel in channels().items() if channel.field in fields)


def _node(executable: str, given: Mapping[str, str], **more) -> Node:
    """A node of this package; the launch ends with it."""
    return Node(
        package=PACKAGE,
        executable=executable,
        namespace=given.get("namespace", ""),
        output="screen",
        sigterm_timeout=TIME_TO_END,
        on_exit=ends_all(executable),
        **more,
    )


def manoeuvre(given: Mapping[str, str]) -> Node:
    """The node that drives the manoeuvre."""
    words = [given["manoeuvre"], *shlex.split(given["options"])]
    return _node("manoeuvre", given, arguments=words, ros_arguments=ros_words(given))


def controllers(given: Mapping[str, str]) -> list[ExecuteProcess]:
    """The controller scripts, run by this Python; those that others need come first."""
    words = ["--ros-args", "-r", f"__ns:=/{given['namespace'].strip('/')}", *ros_words(given)]
    values = assigned(shlex.split(given["parameters"]), _scripts(given), "controller")
    return [
        ExecuteProcess(
            cmd=[sys.executable, str(script), *words, *values[script]],
            name=script.stem,
            output="screen",
            on_exit=ends_all(script.stem),
        )
        for script in values
    ]


def _scripts(given: Mapping[str, str]) -> list[Path]:
    return scripts_of(given["controller"].split(), "controller")


def answers_of(given: Mapping[str, str]) -> list[str]:
    """The topics that the controllers command: as given, else as their scripts declare."""
    if given["answers"]:
        return given["answers"].split()
    return commanded_by(_scripts(given), "controller")


def recording(given: Mapping[str, str]) -> list[ExecuteProcess]:
    """The recording process, if any: `ros2 bag record` if it is installed, else `recorder`."""
    if not given["bag"]:
        return []
    if shutil.which("ros2") is None or importlib.util.find_spec("ros2bag") is None:
        words = ["--output", given["bag"]]
        return [_node("recorder", given, arguments=words, ros_arguments=ros_words(given))]
    command = ["ros2", "bag", "record", "--all", "--storage", "mcap", "--output", given["bag"]]
    ending = {"sigterm_timeout": TIME_TO_END, "on_exit": ends_all("ros2 bag record")}
    return [ExecuteProcess(cmd=command, output="screen", **ending)]
