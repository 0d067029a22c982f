"""The launch files of the checkout, loaded as `ros2 launch` loads them."""

import contextlib
import importlib.util
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import launch_stand_in

PACKAGE = Path(__file__).parents[2] / "vehicle_roll_sim"
LAUNCHING = "vehicle_roll_sim.ros.launching.processes"
PICTURES = "vehicle_roll_sim.ros.launching.rviz"
NAMES = tuple(sorted(f.name.removesuffix(".launch.py") for f in PACKAGE.glob("launch/*.py")))


def program_in(folder: Path, package: str) -> Path:
    """The executable in an install space that has the name of its package."""
    return folder / "lib" / package / package


def share_in(folder: Path) -> str:
    """An install space with what the launch files look for in share/: an AMENT_PREFIX_PATH."""
    marker = folder / "share/ament_index/resource_index/packages/vehicle_roll_sim"
    marker.parent.mkdir(parents=True)
    marker.touch()
    share = folder / "share" / "vehicle_roll_sim"
    share.mkdir()
    (share / "config").symlink_to(PACKAGE / "config")
    (share / "msg_examples").symlink_to(PACKAGE.parent / "msg_examples")
    for package in ("robot_state_publisher", "rviz2"):
        (marker.parent / package).touch()
        program = program_in(folder, package)
        program.parent.mkdir(parents=True)
        program.touch(0o755)
    return str(folder)


@contextlib.contextmanager
def stand_in(monkeypatch, folder: Path) -> Iterator[ModuleType]:
    """The module of the launch files, with the stand-in for `launch`, its share in `folder`."""
    for name, module in launch_stand_in.modules().items():
        monkeypatch.setitem(sys.modules, name, module)
    monkeypatch.setenv("AMENT_PREFIX_PATH", share_in(folder))
    _forget()
    yield importlib.import_module(LAUNCHING)
    _forget()


def _forget() -> None:
    """The modules that have imported the stand-in are imported anew."""
    for name in (LAUNCHING, PICTURES):
        if sys.modules.pop(name, None):
            room, _, module = name.rpartition(".")
            delattr(sys.modules[room], module)


def load(name: str):
    """The launch description of a launch file."""
    path = PACKAGE / "launch" / f"{name}.launch.py"
    spec = importlib.util.spec_from_file_location("launch_file", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.generate_launch_description()


def actions_of(name: str, **given: str) -> dict[str, object]:
    """The actions of a launch file by their names."""
    return {action.name: action for action in launch_stand_in.actions_of(load(name), **given)}


def run(name: str, domain: int, **given: str) -> dict[str, tuple[int, str, str]]:
    """Run a launch file to its end: status, stdout and stderr of every process."""
    actions = launch_stand_in.actions_of(load(name), **given)
    return launch_stand_in.run(actions, os.environ | {"ROS_DOMAIN_ID": str(domain)})
