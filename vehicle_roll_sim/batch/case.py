"""A case is one run to be made; an outcome is its result."""

import dataclasses

import numpy as np

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.input_errors import given
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.manoeuvres.command_file import CommandTable
from vehicle_roll_sim.manoeuvres.on_roads.own_road import road_for
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.records import STATE
from vehicle_roll_sim.model.variants import MODELS
from vehicle_roll_sim.runs.control_law import ControlLaw, Controlled
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Feedback, Programme
from vehicle_roll_sim.simulation.limits import DEFAULT_ROLLOVER_ANGLE, DEFAULT_STEP
from vehicle_roll_sim.simulation.options import Options, options_for
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle


@dataclasses.dataclass(frozen=True, kw_only=True)
class Case:
    """One run: a vehicle, and how it is driven. Checked when it is run, not before.

    vehicle: the vehicle. manoeuvre: a Manoeuvre, such as `STANDARD["j_turn"]` of the catalogue; it
    is completed for the vehicle. speed: entry speed (m/s), by default that of the manoeuvre.
    duration: simulated time (s), by default that of the manoeuvre; that of a command table is
    rounded up to a multiple of the step. controller: a ControlLaw, with which all commands are held
    for periods of 10 ms. options: options of the model, by default those of the vehicle. model:
    name of the model, in place of that of the options. road: by default that of the manoeuvre, or
    level. step: integration step (s). rollover_angle: roll angle at which the run stops (rad).
    """

    vehicle: Vehicle
    manoeuvre: Manoeuvre
    speed: float | None = None
    duration: float | None = None
    controller: ControlLaw | None = None
    options: Options | None = None
    model: str | None = None
    road: Road | None = None
    step: float = DEFAULT_STEP
    rollover_angle: float = DEFAULT_ROLLOVER_ANGLE

    def simulation(self) -> Simulation:
        """A new simulation of the vehicle. Raises InputError for anything that is refused."""
        given("vehicle", self.vehicle, Vehicle)
        return Simulation(
            self.vehicle,
            self._options(),
            step=self.step,
            rollover_angle=self.rollover_angle,
            road=road_for(self._chosen_manoeuvre(), self.road),
        )

    def driver(self, manoeuvre: Manoeuvre, simulation: Simulation) -> Programme | Feedback:
        """A new driver of a ready manoeuvre for one run of the simulation, with the controller."""
        driver = manoeuvre.driver()
        if self.controller is None:
            return driver
        return Controlled(simulation, driver, given("controller", self.controller, ControlLaw))

    def _chosen_manoeuvre(self) -> Manoeuvre:
        """The manoeuvre with its speed and duration."""
        values = {"speed": self.speed, "duration": self.duration}
        chosen = {name: value for name, value in values.items() if value is not None}
        return dataclasses.replace(given("manoeuvre", self.manoeuvre, Manoeuvre), **chosen)

    def _options(self) -> Options:
        options = options_for(self.vehicle) if self.options is None else self.options
        if self.model is None:
            return options
        if str(self.model) not in MODELS:
            raise InputError("model", self.model, "one of " + ", ".join(MODELS))
        return dataclasses.replace(given("options", options, Options), model=self.model)

    def ready_manoeuvre(self, simulation: Simulation) -> Manoeuvre:
        """The manoeuvre with its speed and duration, completed for the vehicle.

        Raises InputError.
        """
        manoeuvre = self._chosen_manoeuvre()
        manoeuvre.check_road(simulation.road)
        if isinstance(manoeuvre, CommandTable) and self.duration is None:
            manoeuvre = manoeuvre.to_whole_steps(simulation.step_ns)
        return manoeuvre.for_vehicle(simulation.vehicle, simulation.options)


@dataclasses.dataclass(frozen=True)
class Outcome:
    """The result of a case.

    metrics: as `RunResult.metrics`, by name, in SI units and radians; times (s) are nan for never.
    Empty if the run failed. failure: one line, "refused: ..." if the run was not begun,
    "diverged at ..." if it was broken off, or "failed: ..." if the user's own driver raised an
    exception; "" otherwise. condition: RUNNING if the run was completed, else why it stopped; None
    if it was refused or failed. final_state: STATE record at the end, such as `final_state.u`; nan
    without a condition, and where the model does not have a state. history, events: rows of the run
    and EVENTS record of all its steps if the history was asked for, else None.
    """

    metrics: dict[str, float]
    failure: str
    condition: Condition | None
    final_state: np.record
    history: History | None = None
    events: np.record | None = None


def no_state() -> np.ndarray:
    """An array of one STATE record in which everything is unknown: nan."""
    return np.full(1, np.nan, STATE)


def unsuccessful(error: Exception) -> Outcome:
    """The outcome of a case that is refused, or of one whose driver raised an exception."""
    is_refused = isinstance(error, InputError)
    text = f"refused: {error}" if is_refused else f"failed: {type(error).__name__}: {error}"
    return Outcome({}, " ".join(text.split()), None, no_state()[0])
