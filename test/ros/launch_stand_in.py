"""A stand-in for the parts of `launch` and `launch_ros` that the launch files use.

Keywords are those of ROS 2 Jazzy's; one that is not there is an error.
"""

import signal
import subprocess
import sys
import time
from types import ModuleType, SimpleNamespace

from forked import Forked, open_process
from patience import PATIENCE

POLL = 0.05
"""s"""
BUSY = 10
"""Times slower than a quiet machine that a busy one may be."""


class LaunchDescription:
    def __init__(self, initial_entities=None):
        self.entities = list(initial_entities or [])


class DeclareLaunchArgument:
    def __init__(self, name, *, default_value=None, description=None, choices=None):
        self.name, self.default_value, self.description = name, default_value, description
        self.choices = choices
        if choices is not None and default_value not in choices:
            raise RuntimeError(f"{name}: default {default_value!r} is not one of {choices}")


class OpaqueFunction:
    def __init__(self, *, function):
        self.function = function


class SetEnvironmentVariable:
    def __init__(self, name, value):
        self.name, self.value = name, value


class Shutdown:
    def __init__(self, *, reason="reason not given"):
        self.reason = reason


class ExecuteProcess:
    def __init__(
        self,
        *,
        cmd,
        name=None,
        output="log",
        sigterm_timeout="5",
        on_exit=None,
        additional_env=None,
    ):
        self.cmd, self.name, self.output = cmd, name or cmd[0], output
        self.sigterm_timeout, self.on_exit = float(sigterm_timeout), on_exit
        self.additional_env = additional_env or {}


class Node(ExecuteProcess):
    def __init__(
        self,
        *,
        executable,
        package=None,
        name=None,
        namespace=None,
        parameters=None,
        remappings=None,
        ros_arguments=None,
        arguments=None,
        **more,
    ):
        self.package, self.executable = package, executable
        self.parameters, self.remappings = parameters or [], remappings or []
        words = [*(arguments or []), "--ros-args", *(ros_arguments or [])]
        if namespace is not None:
            words += ["-r", f"__ns:=/{namespace.lstrip('/')}"]
        super().__init__(
            cmd=[sys.executable, "-m", f"{package}.ros.executables", executable, *words],
            name=name or executable,
            **more,
        )


class ParameterValue:
    def __init__(self, value, *, value_type=None):
        self.value, self.value_type = value, value_type


class LaunchConfiguration:
    def __init__(self, name):
        self.name = name

    def perform(self, context) -> str:
        return context.launch_configurations[self.name]


def modules() -> dict[str, ModuleType]:
    """What stands in, by the names under which it is imported."""
    actions = (
        *(DeclareLaunchArgument, ExecuteProcess, OpaqueFunction),
        *(SetEnvironmentVariable, Shutdown),
    )
    contents = {
        "launch": (LaunchDescription,),
        "launch.actions": actions,
        "launch.substitutions": (LaunchConfiguration,),
        "launch_ros": (),
        "launch_ros.actions": (Node,),
        "launch_ros.parameter_descriptions": (ParameterValue,),
    }
    made = {name: ModuleType(name) for name in contents}
    for name, classes in contents.items():
        for each in classes:
            setattr(made[name], each.__name__, each)
    return made


def actions_of(description: LaunchDescription, **given: str) -> list:
    """What a launch file does with these arguments, but for declaring them."""
    declared = {a.name: a for a in description.entities if isinstance(a, DeclareLaunchArgument)}
    values = {name: a.default_value for name, a in declared.items()} | given
    for name, argument in declared.items():
        if argument.choices is not None and values[name] not in argument.choices:
            raise RuntimeError(f"{name}: {values[name]!r} is not one of {argument.choices}")
    context = SimpleNamespace(launch_configurations=values)
    functions = [e.function for e in description.entities if isinstance(e, OpaqueFunction)]
    return [action for function in functions for action in function(context)]


def run(actions: list, environment: dict[str, str]) -> dict[str, tuple[int, str, str]]:
    """Start what is described; once a process that ends all has ended, SIGINT to the others.

    Exit status, stdout and stderr of each process, by its name.
    """
    environment = dict(environment)
    for action in actions:
        if isinstance(action, SetEnvironmentVariable):
            environment[action.name] = action.value
    described = [action for action in actions if isinstance(action, ExecuteProcess)]
    processes = {}
    try:
        for action in described:
            processes[action.name] = _start(action, environment)
        _wait_for_one([processes[a.name] for a in described if a.on_exit is not None])
        for process in processes.values():
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
        return {
            action.name: _ended(processes[action.name], BUSY * action.sigterm_timeout)
            for action in described
        }
    finally:
        for process in processes.values():
            process.kill()
            process.communicate()


def _start(action: ExecuteProcess, environment: dict[str, str]) -> Forked | subprocess.Popen:
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    return open_process(action.cmd, env=environment, **pipes)


def _wait_for_one(processes: list[Forked | subprocess.Popen]) -> None:
    until = time.monotonic() + PATIENCE
    while all(process.poll() is None for process in processes):
        assert time.monotonic() < until, "nothing ended that the launch should end with"
        time.sleep(POLL)


def _ended(process: Forked | subprocess.Popen, patience: float) -> tuple[int, str, str]:
    out, err = process.communicate(timeout=patience)
    return process.returncode, out, err
