"""Runs of a manoeuvre, a command file or a driver, from reset to end."""

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path

from vehicle_roll_sim.bags import need_library
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.files.output_file import check_new_folder
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.manoeuvres.on_roads.own_road import road_for
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.offline.manoeuvre_argument import manoeuvre_of
from vehicle_roll_sim.offline.run_result import RunResult
from vehicle_roll_sim.offline.tables import path_of
from vehicle_roll_sim.runs import run as stepwise
from vehicle_roll_sim.runs.run import DEFAULT_SAMPLE, HELD_PERIOD, Observer
from vehicle_roll_sim.runs.summary import choices
from vehicle_roll_sim.simulation.limits import DEFAULT_ROLLOVER_ANGLE, DEFAULT_STEP, whole_steps
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.vehicle_file import preset


def run(
    manoeuvre,
    vehicle: Vehicle | None = None,
    *,
    options: Options | None = None,
    road: Road | None = None,
    step: float = DEFAULT_STEP,
    rollover_angle: float = DEFAULT_ROLLOVER_ANGLE,
    sample: float = DEFAULT_SAMPLE,
    command_period: float = 0.0,
    bag: str | Path | None = None,
    stamped: bool = False,
    progress: Callable[[float], None] = lambda seconds: None,
    **values: float | str,
) -> RunResult:
    """Drive a manoeuvre from static equilibrium, like `vehicle_roll_sim run`.

    manoeuvre: the name of a standard manoeuvre, a Manoeuvre, the name of a command file (.csv), a
    table of its columns (a mapping of arrays, or a DataFrame), a constant Command, a Programme or a
    Feedback. values: parameters of the manoeuvre, with the names and units of the command's options
    (deg, m/s, s); for a user-defined driver `duration` (required) and `speed` (default 50 km/h).
    vehicle: by default the reference vehicle. road: by default level, or that of the manoeuvre.
    step, sample, command_period (s), rollover_angle (rad): as in Simulation and simulation.run.
    bag: folder of a bag to write, with the messages that the node would publish; commands are then
    held for `command_period`, by default 10 ms. stamped: also write the messages without a header
    to the bag in stamped form. progress: called with each increment of simulated time (s). Returns
    a RunResult. Raises InputError.
    """
    vehicle = preset() if vehicle is None else vehicle
    settings = {"step": step, "rollover_angle": rollover_angle}
    simulation = Simulation(vehicle, options, road=road, **settings)
    manoeuvre = manoeuvre_of(manoeuvre, values, simulation.step_ns)
    if (own := road_for(manoeuvre, road)) != road:
        simulation = Simulation(vehicle, options, road=own, **settings)
    return drive(
        manoeuvre,
        simulation,
        sample=sample,
        command_period=command_period,
        bag=bag,
        stamped=stamped,
        progress=progress,
    )


def drive(
    manoeuvre: Manoeuvre,
    simulation: Simulation,
    *,
    sample: float = DEFAULT_SAMPLE,
    command_period: float = 0.0,
    bag: str | Path | None = None,
    stamped: bool = False,
    progress: Callable[[float], None] = lambda seconds: None,
) -> RunResult:
    """Reset a simulation and drive a manoeuvre; arguments and result as for `run`."""
    manoeuvre.check_road(simulation.road)
    _check_multiples(manoeuvre, sample, command_period, simulation.step_ns)
    if stamped and bag is None:
        raise InputError("stamped", "", "together with bag", "there is no bag")
    if bag is not None:
        bag = path_of(bag, "bag")
        need_library("bag")
        check_new_folder(bag, "bag")
    manoeuvre = manoeuvre.for_vehicle(simulation.vehicle, simulation.options)
    driver = manoeuvre.driver()
    simulation.reset(manoeuvre.speed)
    period = command_period or HELD_PERIOD
    with _recorded(simulation, manoeuvre.commanded, bag, period, stamped) as observer:
        history = stepwise.run(
            simulation,
            driver,
            manoeuvre.duration,
            sample=sample,
            command_period=command_period,
            observer=observer,
            progress=progress,
        )
    return RunResult(
        manoeuvre,
        history,
        simulation.events.copy(),
        simulation.condition,
        simulation.time,
        simulation.implausible,
        choices(simulation.vehicle, simulation.options) | manoeuvre.results(history, driver),
        simulation.road,
    )


def _check_multiples(
    manoeuvre: Manoeuvre, sample: float, command_period: float, step_ns: int
) -> None:
    """Raise InputError unless the times of the run are multiples of the step."""
    whole_steps(manoeuvre.duration, step_ns, "duration")
    whole_steps(sample, step_ns, "sample")
    if command_period:
        whole_steps(command_period, step_ns, "command_period")


def _recorded(
    simulation: Simulation,
    commanded: tuple[str, ...],
    bag: Path | None,
    period: float,
    stamped: bool,
) -> AbstractContextManager[Observer | None]:
    """Context of the observer that writes the bag; yields None without a bag."""
    if bag is None:
        return nullcontext()
    from vehicle_roll_sim.bags.run_bag import run_bag  # its library is optional

    period_ns = round(period * NANOSECONDS)
    return run_bag(simulation, commanded, bag, period_ns, "bag", stamped=stamped)
