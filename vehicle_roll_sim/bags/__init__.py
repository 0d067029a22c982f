"""Writing, reading and replaying rosbag2 bags (MCAP) without ROS.

All modules need the optional library rosbags.
"""

import importlib.util

from vehicle_roll_sim.declaration import InputError


def need_library(field: str) -> None:
    """Raise InputError naming `field` if the library is not installed."""
    if importlib.util.find_spec("rosbags") is None:
        raise InputError(field, "", "pip install rosbags", "no Python package rosbags")
