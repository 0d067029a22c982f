"""Manoeuvres with a road of their own, and the choice between it and a road that is given."""

import abc
import dataclasses

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.simulation.road import Road


@dataclasses.dataclass(frozen=True, kw_only=True)
class OnOwnRoad(Manoeuvre):
    """A manoeuvre that is driven on the road that its parameters describe."""

    @abc.abstractmethod
    def own_road(self) -> Road:
        """The road of the manoeuvre."""

    def check_road(self, road: Road) -> None:
        if road != self.own_road():
            allowed = "a simulation with the road of the manoeuvre, its own_road()"
            raise InputError("road", "", allowed, "the simulation has another road")


def road_for(manoeuvre: Manoeuvre, given: Road | None) -> Road | None:
    """The road on which a manoeuvre is driven: its own if it has one, else the one that is given.

    Raises InputError if another road than the level plane is given to a manoeuvre that brings one.
    """
    if not isinstance(manoeuvre, OnOwnRoad):
        return given
    own = manoeuvre.own_road()
    if given not in (None, Road(), own):
        allowed = "no road, grade or bank: this manoeuvre brings its own road"
        raise InputError("road", "", allowed, "another road is given")
    return own
