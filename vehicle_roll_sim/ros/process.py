"""What the main functions of all nodes share: start, spin, end without a traceback."""

import argparse
import contextlib
import os
import sys
import tempfile
import threading
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import rclpy
from rclpy.exceptions import (
    InvalidParameterTypeException,
    NameValidationException,
    NotInitializedException,
)
from rclpy.executors import Executor, ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args, try_shutdown

from vehicle_roll_sim.arguments import exit_status
from vehicle_roll_sim.declaration import InputError, unknown_name
from vehicle_roll_sim.early_signals import end_node_at_once
from vehicle_roll_sim.ros import ending, qos_overrides
from vehicle_roll_sim.ros.parameter_files import warn_of_files_for_others
from vehicle_roll_sim.ros.parameter_requests import refuse_malformed
from vehicle_roll_sim.vehicle.plausibility import unwarned

LOOK = 0.05
"""s that a loop waits in `spin_once`, always the same: an executor that is asked with another
timeout than before begins with its first subscription again, and the last ones would starve."""
NOT_MADE = "Failed to create"
"""In what rclpy says where the same name is given to topics of two types."""
OF_EVERY_NODE = ("use_sim_time", "start_type_description_service")
"""Parameters that rclpy itself knows."""
_being_made = threading.Lock()
"""Held while an executor is made. If the context were shut down half-way through, destructors of
rclpy would ask for what is not there yet and print a traceback."""


def node_main(
    parser: argparse.ArgumentParser,
    body: Callable[[argparse.Namespace], int],
    words: list[str],
) -> int:
    """Run `body` with the arguments among `words` (program name first); the exit status.

    `body` runs within an rclpy context. SIGINT and SIGTERM end it with status 0 (`ending`), as the
    context is shut down; before that, at once.
    """

    def command() -> int:
        end_node_at_once()
        arguments = parser.parse_args(_without_ros_arguments(words))
        try:
            _find_log_folder(parser.prog)
            _initialise(words)
            ending.shutting_down(_shut_down)
            with unwarned():  # nodes warn in their log
                return _run(body, arguments)
        except (KeyboardInterrupt, ExternalShutdownException):
            return 0
        finally:
            _shut_down()
            ending.over()

    return exit_status(command, parser.prog)


def refuse_unknown_parameters(node: Node, known: Iterable[str] = ()) -> None:
    """Every parameter that was given must be known, or declared if `known` is empty.

    Qualities of service are left to `qos_overrides`. Raises InputError with the nearest name.
    """
    known = [*(known or node._parameters), *OF_EVERY_NODE]
    for name in node._parameter_overrides:  # rclpy shows them nowhere else
        if name not in known and not name.startswith(qos_overrides.PREFIX):
            raise unknown_name(name, known, "parameter")


class NodeExecutor(SingleThreadedExecutor):
    """An executor whose destructor prints no traceback where its context was shut down before."""

    _sigint_gc = None


@contextlib.contextmanager
def lifetime(node: Node) -> Iterator[Executor]:
    """An executor for a node; in the end it is shut down, and both are gone."""
    refuse_malformed(node)
    warn_of_files_for_others(node)
    with _being_made:
        executor = NodeExecutor(context=node.context)
        executor.add_node(node)
    try:
        yield executor
    finally:
        node.destroy_node()
        executor.shutdown()


def _run(body: Callable[[argparse.Namespace], int], arguments: argparse.Namespace) -> int:
    try:
        return body(arguments)
    except (NameValidationException, InvalidParameterTypeException) as error:
        raise _not_started(error) from None
    except (RuntimeError, NotInitializedException) as error:
        if not rclpy.ok():  # a signal has shut the context down
            return 0
        if NOT_MADE in str(error):
            raise _not_started(error) from None
        raise


def _shut_down() -> None:
    with _being_made, contextlib.suppress(RuntimeError):  # it is being shut down just now
        try_shutdown()  # that of rclpy itself also takes away the handlers of signals


def _without_ros_arguments(words: list[str]) -> list[str]:
    try:
        return remove_ros_args(words)[1:]
    except RuntimeError as error:
        raise _not_started(error) from None


def _find_log_folder(program: str) -> None:
    """Where ROS could not write its logs, as without a home, they get a temporary folder."""
    if os.environ.get("ROS_LOG_DIR") or os.environ.get("ROS_HOME"):
        return
    home = os.environ.get("HOME")
    if home and _is_writable(Path(home, ".ros", "log")):
        return
    folder = os.environ["ROS_LOG_DIR"] = tempfile.mkdtemp(prefix="ros_log_")
    print(f"{program}: ~/.ros/log cannot be written, logs are in {folder}", file=sys.stderr)


def _is_writable(folder: Path) -> bool:
    """Whether a folder, which is made if need be, takes files."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return False
    return os.access(folder, os.W_OK | os.X_OK)


def _initialise(words: list[str]) -> None:
    try:
        rclpy.init(args=words, signal_handler_options=SignalHandlerOptions.NO)
    except RuntimeError as error:
        raise _not_started(error) from None


def _not_started(error: Exception) -> InputError:
    """Wrong --ros-args, or a log folder that cannot be made."""
    problem = " ".join(str(error).split())
    return InputError("ROS", "", "check --ros-args and ROS_LOG_DIR", problem)
