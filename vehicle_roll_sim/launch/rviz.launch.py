"""A simulator with robot_state_publisher and RViz, until one of them ends; drive it separately."""

from vehicle_roll_sim.ros.launching import processes as start
from vehicle_roll_sim.ros.launching import rviz


def processes(given):
    return [start.simulator(given), *rviz.pictures(given)]


def generate_launch_description():
    return start.launch_description("rviz", processes)
