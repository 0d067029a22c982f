"""The machine and software on which the results were measured."""

import importlib.metadata
import os
import platform
import re
from pathlib import Path

UNKNOWN = "unknown"


def describe() -> dict[str, str]:
    """Properties of the machine and versions of the software, by name."""
    return {
        "CPU": f"{_cpu_model()}, {os.cpu_count()} cores",
        "kernel": f"{platform.system()} {platform.release()}",
        "Python": platform.python_version(),
        "numba": _version("numba"),
        "numpy": _version("numpy"),
        "ROS": _distribution(),
        "vehicle_roll_sim": _version("vehicle_roll_sim"),
        "load average at the start": " ".join(f"{load:.2f}" for load in os.getloadavg()),
    }


def _cpu_model() -> str:
    """The model name that Linux reports."""
    about = Path("/proc/cpuinfo")
    text = about.read_text(encoding="utf-8") if about.exists() else ""
    named = re.search(r"^model name\s*: (.+)$", text, re.MULTILINE)
    return named[1] if named else platform.machine() or UNKNOWN


def _version(name: str) -> str:
    try:
        return importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return "not installed"


def _distribution() -> str:
    """The ROS distribution, from the environment or from the names of installed wheels."""
    names = (str(each.metadata["Name"]) for each in importlib.metadata.distributions())
    of_wheels = (re.fullmatch(r"ros-(\w+)-rclpy", name) for name in names)
    return os.environ.get("ROS_DISTRO") or next((of[1] for of in of_wheels if of), UNKNOWN)
