"""`vehicle_roll_sim view --live`: the node `live_view`, for which the command makes room."""

import os
import sys

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.viewer.live_server import DEFAULT_PORT

LIVE = "--live"
ABOUT = "instead of RUN: serve a page that follows a running simulator; needs ROS 2"
DESCRIPTION = "Serve a page that follows a running simulator; needs ROS 2."
NODE = ("-m", "vehicle_roll_sim.ros.executables", "live_view")


def live_command(words: list[str], program: str) -> int:
    """Become the node that serves the page, with the arguments of the command."""
    parser = OneLineParser(prog=f"{program} {LIVE}", description=DESCRIPTION)
    parser.add_argument(LIVE, action="store_true", required=True)
    parser.add_argument("--port", metavar="N", help=f"port on 127.0.0.1 (default: {DEFAULT_PORT})")
    parser.add_argument("--open", action="store_true", help="also open the page in the browser")
    parser.add_argument("--namespace", metavar="NS", help="namespace of the simulator")
    arguments = parser.parse_args(words)
    given = [*NODE, *(("--port", arguments.port) if arguments.port is not None else ())]
    given += ["--open"] if arguments.open else []
    if arguments.namespace:
        given += ["--ros-args", "-r", f"__ns:=/{arguments.namespace.strip('/')}"]
    sys.stdout.flush()
    os.execv(sys.executable, [sys.executable, *given])
