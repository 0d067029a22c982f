"""A simulator alone, until Ctrl-C."""

from vehicle_roll_sim.ros.launching import processes as start


def generate_launch_description():
    return start.launch_description("simulator", lambda given: [start.simulator(given)])
