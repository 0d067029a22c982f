"""Everything that a controller script imports: the base class, `run`, and the topic helpers.

From this import on, SIGINT and SIGTERM end the script with status 0, even while rclpy is being
imported; `run` handles later signals. A program that does more than run one controller imports the
same names from `vehicle_roll_sim.ros.clients.controller`.
"""

from vehicle_roll_sim import early_signals

early_signals.end_node_at_once()

from vehicle_roll_sim.messages.run_messages import by_name
from vehicle_roll_sim.messages.topic import Topic
from vehicle_roll_sim.ros.clients.controller import Controller, run

__all__ = ["Controller", "Topic", "by_name", "run"]
