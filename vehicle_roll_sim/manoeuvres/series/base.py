"""What every test series is made of: runs of a manoeuvre to either side."""

import abc
import dataclasses
from collections.abc import Iterator

from vehicle_roll_sim.manoeuvres.base import SIDES, Manoeuvre
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle

COMPLETE = "complete"


@dataclasses.dataclass(frozen=True)
class Series(abc.ABC):
    """Runs of a manoeuvre to the left, then to the right; a row of results for each."""

    manoeuvre: Manoeuvre

    columns = ()
    """Names of what a row has; SI units unless the name ends in another."""
    settings = ()
    """Title and declaring class, or instance with defaults, of the options that are left open."""

    def with_values(self, values: dict) -> "Series":
        """A copy with other values of these options."""
        return dataclasses.replace(self, manoeuvre=dataclasses.replace(self.manoeuvre, **values))

    def rows(self, vehicle: Vehicle, options: Options) -> Iterator[tuple]:
        """Drive the runs one by one, on a level road."""
        ready = self.manoeuvre.for_vehicle(vehicle, options)
        for direction in SIDES:
            for row in self.rows_to_a_side(ready, direction, vehicle, options):
                yield (direction, *row)

    @abc.abstractmethod
    def rows_to_a_side(
        self, ready: Manoeuvre, direction: str, vehicle: Vehicle, options: Options
    ) -> Iterator[tuple]:
        """Runs to the left or to the right, without the direction in front."""

    def remarks(self, vehicle: Vehicle, rows: list[tuple]) -> dict[str, str]:
        """What else there is to say of the rows: label and text of each line."""
        return {}

    @abc.abstractmethod
    def verdict(self, rows: list[tuple]) -> str:
        """What the rows mean."""


def driven(manoeuvre: Manoeuvre, vehicle: Vehicle, options: Options) -> tuple[Simulation, History]:
    """A run of its own with a manoeuvre that is ready for the vehicle."""
    simulation = Simulation(vehicle, options)
    simulation.reset(manoeuvre.speed)
    return simulation, run(simulation, manoeuvre.driver(), manoeuvre.duration)


def ending_of(simulation: Simulation) -> str:
    """How a run ended, in a word."""
    is_complete = simulation.condition is Condition.RUNNING
    return COMPLETE if is_complete else simulation.condition.name.lower()
