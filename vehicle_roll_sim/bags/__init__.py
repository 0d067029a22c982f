"""Rosbag2 bags (MCAP) without a middleware: written, read, run again.

All modules need the library rosbags, which is optional.
"""

import importlib.util

from vehicle_roll_sim.declaration import InputError


def need_library(field: str) -> None:
    """Raise InputError naming `field` where the library is not installed."""
    if importlib.util.find_spec("rosbags") is None:
        raise InputError(field, "", "pip install rosbags", "no Python package rosbags")
