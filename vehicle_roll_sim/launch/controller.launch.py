"""A simulator, controllers and a manoeuvre, recorded in a bag; ends with the manoeuvre."""

from vehicle_roll_sim.ros.launching import processes as start


def processes(given):
    return [
        start.simulator(given, start.answers_of(given)),
        *start.recording(given),
        *start.controllers(given),
        start.manoeuvre(given),
    ]


def generate_launch_description():
    return start.launch_description("controller", processes)
