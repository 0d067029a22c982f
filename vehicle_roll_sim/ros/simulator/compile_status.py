"""A simulator announces that its model is still compiling, so that its clients keep waiting."""

import os
import threading
import time

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.clock import Clock, ClockType
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

from vehicle_roll_sim.messages.topics import DIAGNOSTICS
from vehicle_roll_sim.model.compiled import jit
from vehicle_roll_sim.ros.node_main import LOOK, lifetime
from vehicle_roll_sim.ros.topics import message_class, offered_qos
from vehicle_roll_sim.simulation.compilation import compile_model

COMPILING = "compiling the model"
INTERVAL = 0.5
"""Interval between announcements (wall s)."""
FRESH = 5.0
"""How long an announcement counts (wall s): a busy machine may delay the next one."""


def status_name(node: str) -> str:
    """The name of a simulator's diagnostic status. node: the full name of its node."""
    return f"{node}: model"


def compile_and_tell(name: str) -> None:
    """Compile the model if necessary; a node of this name announces it in the meantime.

    Raises ExternalShutdownException if a signal ends the wait.
    """
    if not jit.is_to_be_compiled():
        compile_model()
    elif jit.CACHE is None:
        _compile_here(name)
    else:
        compile_model(lambda process: _tell(name, lambda: process.poll() is None))


def _compile_here(name: str) -> None:
    """Compile in this process, which is necessary without a cache.

    A signal then ends the process immediately: the compiler cannot be stopped in an orderly way.
    """
    compiling = threading.Thread(target=compile_model, name="compiler", daemon=True)
    compiling.start()
    try:
        _tell(name, compiling.is_alive)
    except ExternalShutdownException:
        os._exit(0)


def _tell(name: str, is_working) -> None:
    node = Node(name, start_parameter_services=False)  # there are no parameters yet
    publisher = node.create_publisher(
        message_class(DIAGNOSTICS.type), DIAGNOSTICS.name, offered_qos(DIAGNOSTICS)
    )

    def announce() -> None:
        status = DiagnosticStatus(level=DiagnosticStatus.WARN, message=COMPILING)
        status.name, status.hardware_id = status_name(node.get_fully_qualified_name()), "simulation"
        diagnostics = DiagnosticArray(status=[status])
        diagnostics.header.stamp = node.get_clock().now().to_msg()
        publisher.publish(diagnostics)

    node.create_timer(INTERVAL, announce, clock=Clock(clock_type=ClockType.STEADY_TIME))
    with lifetime(node) as executor:
        while is_working():
            executor.spin_once(timeout_sec=LOOK)


class Compilations:
    """Monitors, on behalf of `node`, whether a simulator is compiling its model."""

    def __init__(self, node: Node, simulator: str):
        self._node, self._last = node, -FRESH
        absolute = simulator.startswith("/")
        full = simulator if absolute else f"{node.get_namespace().rstrip('/')}/{simulator}"
        self._simulator, self._is_told = full, False
        node.create_subscription(DiagnosticArray, DIAGNOSTICS.name, self._hear, 10)

    def _hear(self, diagnostics: DiagnosticArray) -> None:
        for status in diagnostics.status:
            if status.name == status_name(self._simulator) and status.message == COMPILING:
                self._last = time.monotonic()
                if not self._is_told:
                    self._node.get_logger().info(f"waiting: {self._simulator} is {COMPILING}")
                self._is_told = True

    def is_running(self) -> bool:
        """Whether the simulator has recently announced that it is compiling."""
        return time.monotonic() - self._last < FRESH
