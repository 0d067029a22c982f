"""What the script of a controller imports: the base class, and what its main function calls.

From this import on SIGINT and SIGTERM end the script with status 0, also while rclpy is imported;
`run` handles those that come later. A program that is more than a controller imports the same names
from `vehicle_roll_sim.ros.clients.controller`.
"""

from vehicle_roll_sim import early_signals

early_signals.end_node_at_once()

from vehicle_roll_sim.messages.collected import by_name
from vehicle_roll_sim.messages.topics import Topic
from vehicle_roll_sim.ros.clients.controller import Controller, run

__all__ = ["Controller", "Topic", "by_name", "run"]
