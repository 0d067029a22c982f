"""A simulator and a manoeuvre, recorded if `bag` is given; ends with the manoeuvre."""

from vehicle_roll_sim.ros.launching import processes as start


def processes(given):
    return [start.simulator(given), *start.recording(given), start.manoeuvre(given)]


def generate_launch_description():
    return start.launch_description("manoeuvre", processes)
