"""A simulator alone, until Ctrl-C."""

from vehicle_roll_sim.ros.launching import processes as start


def generate_launch_description():
    arguments = [*start.simulator_arguments(), *start.name_arguments()]
    return start.launch_description(arguments, lambda given: [start.simulator(given)])
