"""A simulator, robot_state_publisher and RViz, until RViz is closed; drive it from elsewhere."""

from vehicle_roll_sim.ros import launching as start


def processes(given):
    return [start.simulator(given), *start.pictures(given)]


def generate_launch_description():
    arguments = [*start.picture_arguments(), *start.simulator_arguments()]
    return start.launch_description(arguments, processes)
