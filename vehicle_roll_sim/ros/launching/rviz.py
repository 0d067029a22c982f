"""The nodes that display the vehicle in rviz.launch.py: robot_state_publisher and RViz."""

import atexit
import os
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path

import yaml
from ament_index_python.packages import (
    PackageNotFoundError,
    get_package_prefix,
    get_package_share_directory,
)
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from vehicle_roll_sim.input_errors import InputError, number_in
from vehicle_roll_sim.messages.urdf import urdf
from vehicle_roll_sim.ros.launching.processes import PACKAGE, ends_all
from vehicle_roll_sim.ros.launching.values import YES, log_words
from vehicle_roll_sim.simulation.options import Options, options_for
from vehicle_roll_sim.vehicle.shipped import vehicle_named
from vehicle_roll_sim.vehicle.vehicle_file import preset

WHEELS, RVIZ = "robot_state_publisher", "rviz2"
"""Packages; their executables have the same names."""
FRAMES = ("odom", "base_footprint", "base_link")
"""Frames that occur in the RViz configuration."""


def pictures(given: Mapping[str, str]) -> list[Node]:
    """robot_state_publisher, which positions the wheels, and RViz if `use_rviz` is true.

    Raises InputError, before anything is started, if one of them is not installed.
    """
    _require(WHEELS, "")
    with_rviz = given["use_rviz"] == YES
    if with_rviz:
        _require(RVIZ, ", or use_rviz:=false")
    vehicle = vehicle_named(given["vehicle_file"]) if given["vehicle_file"] else preset()
    options = Options(model=given["model"]) if given["model"] else options_for(vehicle)
    text = urdf(vehicle, options)
    described = {"robot_description": ParameterValue(text, value_type=str)}
    if given["frame_prefix"]:
        prefix = ParameterValue(given["frame_prefix"], value_type=str)
        described["frame_prefix"] = prefix
    clock = {"use_sim_time": _goes_by_simulated_time(given)}
    common = {"namespace": given["namespace"], "ros_arguments": log_words(given)}
    wheels = Node(
        package=WHEELS,
        executable=WHEELS,
        parameters=[described | clock],
        remappings=[("robot_description", "robot_state_publisher/robot_description")],
        on_exit=ends_all(WHEELS),
        **common,
    )
    if not with_rviz:
        return [wheels]
    rviz = Node(
        package=RVIZ,
        executable=RVIZ,
        arguments=["-d", str(_configuration(given["namespace"], given["frame_prefix"]))],
        parameters=[clock],
        on_exit=ends_all("RViz"),
        **common,
    )
    return [wheels, rviz]


def _require(package: str, otherwise: str) -> None:
    """Raise InputError unless a package is installed with the executable of the same name."""
    try:
        program = Path(get_package_prefix(package), "lib", package, package)
    except PackageNotFoundError:
        program = None
    if program is None or not os.access(program, os.X_OK):
        name = package.replace("_", "-")
        remedy = f"install it (apt install ros-{os.environ.get('ROS_DISTRO', 'DISTRO')}-{name})"
        raise InputError("rviz.launch.py", "", remedy + otherwise, f"{package} is not installed")


def _goes_by_simulated_time(given: Mapping[str, str]) -> bool:
    """The value of `use_sim_time`, else whether the simulator publishes /clock."""
    if given["use_sim_time"]:
        return given["use_sim_time"] == YES
    text = given["real_time_factor"] or "1"
    try:
        return number_in(text) != 1.0 or given["lockstep"] == YES
    except ValueError:
        raise InputError("real_time_factor", text, "a number") from None


def _configuration(namespace: str, prefix: str) -> Path:
    """The RViz configuration; with a namespace or prefix, an adapted copy that the launch removes.

    The configuration has full topic and frame names, and RViz appends a slash to the TF prefix of
    a robot model.
    """
    shown = Path(get_package_share_directory(PACKAGE)) / "config" / "vehicle.rviz"
    namespace = namespace.strip("/")
    if not namespace and not prefix:
        return shown
    if prefix and not prefix.endswith("/"):
        allowed = "a prefix that ends in a slash for RViz, or use_rviz:=false"
        raise InputError("frame_prefix", prefix, allowed)
    content = yaml.safe_load(shown.read_text(encoding="utf-8"))
    folder = Path(tempfile.mkdtemp(prefix="vehicle_rviz_"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    copy = folder / shown.name
    moved = _moved(content, f"/{namespace}" if namespace else "", prefix)
    copy.write_text(yaml.safe_dump(moved, sort_keys=False), encoding="utf-8")
    return copy


def _moved(part, namespace: str, prefix: str):
    """A part of the configuration, with namespace and prefix added to topic and frame names."""
    if isinstance(part, list):
        return [_moved(each, namespace, prefix) for each in part]
    if isinstance(part, dict):
        moved = {
            prefix + key if key in FRAMES else key: _moved(value, namespace, prefix)
            for key, value in part.items()
        }
        if "TF Prefix" in moved:
            moved["TF Prefix"] = prefix.removesuffix("/")
        return moved
    if part in FRAMES:
        return prefix + part
    return namespace + part if isinstance(part, str) and part.startswith("/") else part
