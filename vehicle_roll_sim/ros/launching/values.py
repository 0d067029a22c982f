"""Values of launch arguments as people spell them: truths in any case, `none` for nothing."""

import re
from collections.abc import Mapping

from vehicle_roll_sim.declaration import InputError

YES, NO = "true", "false"
NONE = "none"
"""Switches an argument off: `ros2 launch` takes no empty value."""
ALWAYS_SET = ("manoeuvre", "discovery_range")
"""Arguments that cannot be switched off."""
TRUTHS = ("lockstep", "use_rviz")
"""Arguments that are true or false; use_sim_time is also left open."""
SPELLINGS = {YES: YES, "1": YES, "yes": YES, "on": YES, NO: NO, "0": NO, "no": NO, "off": NO}
FORMER_NAMES = {"use_rviz": "rviz"}
"""Former names of arguments that are true by default."""
LEVELS = ("debug", "info", "warn", "error", "fatal")
OF_ONE_LOGGER = re.compile(r"[\w./]+:=(\w+)")


def understood(given: Mapping[str, str], configurations: Mapping[str, str]) -> dict[str, str]:
    """`given` with "true" or "false" for truths and "" for what is switched off.

    configurations: everything that the launch was told, former names of arguments among it.
    Raises InputError with the argument's name.
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
    """Words after --ros-args for every node, but the simulator, whose time is its own."""
    words = log_words(given)
    if given.get("use_sim_time"):
        words += ["-p", f"use_sim_time:={given['use_sim_time']}"]
    return words


def log_words(given: Mapping[str, str]) -> list[str]:
    """Words after --ros-args for every node."""
    return ["--log-level", given["log_level"]] if given.get("log_level") else []


def _truth(name: str, value: str) -> str:
    try:
        return SPELLINGS[value.strip().lower()]
    except KeyError:
        raise InputError(name, value, f"{YES} or {NO}") from None


def _level(value: str) -> str:
    """A level, or LOGGER:=LEVEL."""
    named = OF_ONE_LOGGER.fullmatch(value)
    if (named[1] if named else value).lower() not in LEVELS:
        allowed = f"{', '.join(LEVELS)}, or LOGGER:=LEVEL"
        raise InputError("log_level", value, allowed)
    return value if named else value.lower()
