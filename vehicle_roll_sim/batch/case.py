"""A case is one run to be made; an outcome is what came of it."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.declaration import InputError, given
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.variants import MODELS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.options import Options, options_for
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.simulation import DEFAULT_ROLLOVER_ANGLE, DEFAULT_STEP, Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle


@dataclasses.dataclass(frozen=True, kw_only=True)
class Case:
    """One run: a vehicle, and how it is driven. Checked when it is run, not before.

    vehicle: the vehicle. manoeuvre: a Manoeuvre of the catalogue, such as `STANDARD["j_turn"]`;
    it is completed for the vehicle. speed: entry speed (m/s), by default that of the manoeuvre.
    duration: simulated time (s), by default that of the manoeuvre. options: options of the model,
    by default those of the vehicle. model: name of the model, in place of that of the options.
    road: by default level. step: integration step (s). rollover_angle: roll angle at which the run
    stops (rad).
    """

    vehicle: Vehicle
    manoeuvre: Manoeuvre
    speed: float | None = None
    duration: float | None = None
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
            road=self.road,
        )

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
        values = {"speed": self.speed, "duration": self.duration}
        chosen = {name: value for name, value in values.items() if value is not None}
        manoeuvre = dataclasses.replace(given("manoeuvre", self.manoeuvre, Manoeuvre), **chosen)
        return manoeuvre.for_vehicle(simulation.vehicle, simulation.options)


@dataclasses.dataclass(frozen=True)
class Outcome:
    """What came of a case.

    metrics: as `RunResult.metrics`, by name, in SI units and radians; times (s) are nan for never.
    Empty if the run failed. failure: one line, "refused: ..." if the run was not begun, or
    "diverged at ..." if it was broken off; "" otherwise. condition: RUNNING if the run was
    completed, else why it stopped; None if it was refused. final_state: values of
    `model.records.STATE_NAMES` at the end, shape (40,); nan if it was refused, and what the model
    does not have. history: rows of the run if they were asked for, else None.
    """

    metrics: dict[str, float]
    failure: str
    condition: Condition | None
    final_state: np.ndarray
    history: History | None = None

    @property
    def is_rollover(self) -> bool:
        """Whether the vehicle rolled over."""
        return not math.isnan(self.metrics.get("rollover_time", math.nan))
