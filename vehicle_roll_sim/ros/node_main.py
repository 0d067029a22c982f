"""What the main functions of all nodes share: starting, spinning and ending without a traceback."""

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
from vehicle_roll_sim.ros import qos_overrides, signals
from vehicle_roll_sim.ros.parameter_files import warn_of_files_for_others
from vehicle_roll_sim.ros.parameter_requests import refuse_malformed
from vehicle_roll_sim.vehicle.plausibility import unwarned

LOOK = 0.05
"""Timeout (s) of every `spin_once`. An executor called with a different timeout than before starts
again with its first subscription, so varying timeouts would starve the last ones."""
NOT_MADE = "Failed to create"
"""Part of rclpy's message if topics of two types are remapped to the same name."""
OF_EVERY_NODE = ("use_sim_time", "start_type_description_service")
"""Parameters that rclpy itself declares or reads."""
_executor_lock = threading.Lock()
"""Held while an executor is created. If the context were shut down in between, destructors of rclpy
would use attributes that are not there yet, and print a traceback."""


def node_main(
    parser: argparse.ArgumentParser,
    body: Callable[[argparse.Namespace], int],
    words: list[str],
) -> int:
    """Run `body` with the arguments in `words` (program name first); return the exit status.

    `body` runs within an rclpy context, which SIGINT and SIGTERM shut down: it then ends with
    status 0 (see `ending`). Before the context exists, signals end the process at once.
    """

    def command() -> int:
        end_node_at_once()
        arguments = parser.parse_args(_without_ros_arguments(words))
        try:
            find_log_folder(parser.prog)
            _initialise(words)
            signals.shut_down_on_signal(_shut_down)
            with unwarned():  # nodes log plausibility warnings themselves
                return _run(body, arguments)
        except (KeyboardInterrupt, ExternalShutdownException):
            return 0
        finally:
            _shut_down()
            signals.ignore_signals()

    return exit_status(command, parser.prog)


def refuse_unknown_parameters(node: Node, known: Iterable[str] = ()) -> None:
    """Raise InputError, with the nearest name, for a parameter override that is not in `known`.

    By default, `known` are the parameters declared so far. QoS overrides are left to
    `qos_overrides`.
    """
    known = [*(known or node._parameters), *OF_EVERY_NODE]
    for name in node._parameter_overrides:  # rclpy offers no public access
        if name not in known and not name.startswith(qos_overrides.PREFIX):
            raise unknown_name(name, known, "parameter")


class NodeExecutor(SingleThreadedExecutor):
    """An executor whose destructor prints no traceback if its context was shut down first."""

    _sigint_gc = None


@contextlib.contextmanager
def lifetime(node: Node) -> Iterator[Executor]:
    """An executor for a node; at the end, the node is destroyed and the executor shut down."""
    refuse_malformed(node)
    warn_of_files_for_others(node)
    with _executor_lock:
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
    with _executor_lock, contextlib.suppress(RuntimeError):  # already being shut down
        try_shutdown()  # `rclpy.try_shutdown` would also remove the signal handlers


def _without_ros_arguments(words: list[str]) -> list[str]:
    try:
        return remove_ros_args(words)[1:]
    except RuntimeError as error:
        raise _not_started(error) from None


def find_log_folder(program: str) -> None:
    """Direct the logs to a temporary folder if ROS cannot write them, such as without a home."""
    if os.environ.get("ROS_LOG_DIR") or os.environ.get("ROS_HOME"):
        return
    home = os.environ.get("HOME")
    if home and _is_writable(Path(home, ".ros", "log")):
        return
    folder = os.environ["ROS_LOG_DIR"] = tempfile.mkdtemp(prefix="ros_log_")
    print(f"{program}: ~/.ros/log is not writable, logs are in {folder}", file=sys.stderr)


def _is_writable(folder: Path) -> bool:
    """Whether files can be written to a folder; it is created if necessary."""
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
    """The error for wrong --ros-args, or for a log folder that cannot be created."""
    problem = " ".join(str(error).split())
    return InputError("ROS", "", "check --ros-args and ROS_LOG_DIR", problem)
