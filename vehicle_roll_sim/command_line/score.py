"""`vehicle_roll_sim score`: the executable `score`, which needs ROS 2, in place of this process."""

import os
import sys

from vehicle_roll_sim.scoring.options import parser_of

EXECUTABLES = "vehicle_roll_sim.ros.executables"


def score_command(words: list[str], program: str) -> int:
    """Become the executable, which says in one line what is missing without ROS 2."""
    parser_of(program).parse_args(words)
    sys.stdout.flush()
    os.execv(sys.executable, [sys.executable, "-m", EXECUTABLES, "score", *words])
