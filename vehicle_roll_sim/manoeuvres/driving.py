"""The quickest way to the history of a run: in compiled code where the driver allows it."""

from vehicle_roll_sim.manoeuvres.base import OpenLoop
from vehicle_roll_sim.runs.compiled_run import compiled_run
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.simulation.timetable import Timetable


def history_of(
    simulation: Simulation,
    driver: Programme | Feedback,
    duration: float,
    *,
    with_commands: bool = False,
) -> History:
    """Drive from the present state for `duration` (s); the same history as that of `run`.

    with_commands: with the commands other than the steering. The loop of an open-loop manoeuvre or
    of a fishhook is compiled; drivers that answer the state in Python, as along a path, are asked
    period by period. Raises InputError as `run` does.
    """
    if isinstance(driver, OpenLoop | Timetable):
        return compiled_run(simulation, driver, duration, with_commands=with_commands)
    return run(simulation, driver, duration)
