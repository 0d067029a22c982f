"""Launch arguments as people spell them: booleans in any case, `none` for no value."""

import re
from collections.abc import Mapping

from vehicle_roll_sim.declaration import InputError

YES, NO = "true", "false"
NONE = "none"
"""Stands for no value: `ros2 launch` does not accept an empty one."""
ALWAYS_SET = ("manoeuvre", "discovery_range")
"""Arguments that need a value."""
TRUTHS = ("lockstep", "use_rviz")
"""Boolean arguments; `use_sim_time` may also have no value."""
SPELLINGS = {YES: YES, "1": YES, "yes": YES, "on": YES, NO: NO, "0": NO, "no": NO, "off": NO}
FORMER_NAMES = {"use_rviz": "rviz"}
"""Former names of boolean arguments that are true by default."""
LEVELS = ("debug", "info", "warn", "error", "fatal")
OF_ONE_LOGGER = re.compile(r"[\w./]+:=(\w+)")


def understood(given: Mapping[str, str], configurations: Mapping[str, str]) -> dict[str, str]:
    """`given` in normal form: "true" or "false" for booleans, "" for no value.

    configurations: all launch configurations, which may include former names of arguments.
    Raises InputError naming the argument.
    """
    values = {
        name: "" if name not in ALWAYS_SET and value.strip().lower() == NONE else value
        for name, value in given.items()
    }
    for name in (name for name in TRUTHS if name in values):
        values[name] = _truth(name, given[name])
        former = FORMER_NAMES.get(name)
        if former in configurations and values[name] == YES:
            values[name] = _truth(former, configurations[former])
    if values.get("use_sim_time"):
        values["use_sim_time"] = _truth("use_sim_time", values["use_sim_time"])
    if values.get("log_level"):
        values["log_level"] = _level(values["log_level"])
    return values


def ros_words(given: Mapping[str, str]) -> list[str]:
    """Arguments after --ros-args for every node except the simulator, which has its own time."""
    words = log_words(given)
    if given.get("use_sim_time"):
        words += ["-p", f"use_sim_time:={given['use_sim_time']}"]
    return words


def log_words(given: Mapping[str, str]) -> list[str]:
    """Arguments after --ros-args for every node."""
    return ["--log-level", given["log_level"]] if given.get("log_level") else []


def _truth(name: str, value: str) -> str:
    try:
        return SPELLINGS[value.strip().lower()]
    except KeyError:
        raise InputError(name, value, f"{YES} or {NO}") from None


def _level(value: str) -> str:
    """A log level, or LOGGER:=LEVEL; raises InputError."""
    named = OF_ONE_LOGGER.fullmatch(value)
    if (named[1] if named else value).lower() not in LEVELS:
        allowed = f"{', '.join(LEVELS)}, or LOGGER:=LEVEL"
        raise InputError("log_level", value, allowed)
    return value if named else value.lower()
