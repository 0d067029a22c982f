"""What an episode begins with: vehicle, manoeuvre and speed, fixed or drawn at random."""

import functools
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vehicle_roll_sim.declaration import unknown_name
from vehicle_roll_sim.learning.names import mapping_of, names_of
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.simulation.limits import whole_steps
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.studies.designs import drawn_at
from vehicle_roll_sim.studies.quantities import case_of, quantity
from vehicle_roll_sim.studies.source import Source
from vehicle_roll_sim.studies.study import RANDOM, Study
from vehicle_roll_sim.studies.study_file import study_of
from vehicle_roll_sim.vehicle.plausibility import unwarned
from vehicle_roll_sim.vehicle.sensor_parameters import LARGEST_SEED, SEED

MANOEUVRE = "manoeuvre."
SPEED, AMPLITUDE = f"{MANOEUVRE}speed", f"{MANOEUVRE}amplitude"
NOISE = f"vehicle.{SEED}"
STRAIGHT = "j_turn"
"""Manoeuvre that goes straight ahead if its amplitude is 0."""
EXAMPLE = "{'manoeuvre.speed': 20.0}"
PREFIX = "study: "
KEPT = 16
"""Simulations that are kept for further episodes."""
Values = dict[str, float | str | bool]


class Start(NamedTuple):
    """Simulation, reset to the entry speed, and manoeuvre of an episode, and what was drawn."""

    simulation: Simulation
    manoeuvre: Manoeuvre
    drawn: Values


class _Given(Source):
    """Arguments of an environment, which messages name without the prefix of a study."""

    def where(self, *place: str | int) -> str:
        return super().where(*place).removeprefix(PREFIX)


class Scenario:
    """Draws the beginnings of episodes.

    manoeuvres: names of the catalogue, one of which is drawn for each episode, or None for straight
    ahead. Others as in a study (docs/studies.md): vehicle, model, fixed, factors, correlations,
    step and stop_roll; of a factor with a list of values, one is drawn. None stands for the usual
    value. Raises InputError.
    """

    def __init__(self, manoeuvres: str | Sequence[str] | None, **given):
        given = {name: value for name, value in given.items() if value is not None}
        fixed = mapping_of("fixed", given.pop("fixed", {}), EXAMPLE)
        if manoeuvres is None:
            manoeuvres, fixed = STRAIGHT, {AMPLITUDE: 0.0, **fixed}
        names = [manoeuvres] if isinstance(manoeuvres, str) else manoeuvres
        names = names_of("manoeuvre", names, STANDARD)
        self.__setstate__([_study(name, fixed, given) for name in names])

    def __getstate__(self) -> list[Study]:
        return self._studies

    def __setstate__(self, studies: list[Study]) -> None:
        self._studies = studies
        self._simulation_of = functools.lru_cache(maxsize=KEPT)(self._new_simulation)

    @property
    def step(self) -> float:
        """Integration step (s)."""
        return self._studies[0].settings.step

    def begin(self, generator: np.random.Generator, chosen: Mapping) -> Start:
        """Draw the beginning of an episode. chosen: factors that are not drawn, and their values.

        Raises InputError for values that the vehicle or the manoeuvre refuses.
        """
        number = int(generator.integers(len(self._studies))) if len(self._studies) > 1 else 0
        study = self._studies[number]
        drawn = {n: each[generator.integers(len(each))] for n, each in study.gridded.items()}
        if study.drawn:
            scores = generator.standard_normal((1, len(study.drawn)))
            drawn |= {name: float(value) for name, (value,) in drawn_at(study, scores).items()}
        for name, value in mapping_of("options", chosen, EXAMPLE).items():
            if name not in drawn:
                raise unknown_name(str(name), drawn, "options")
            declared = quantity(name, study.driving, name)
            drawn[name] = declared.validate(value, f"options: {name}")
        with unwarned():
            return self._started(number, drawn, generator)

    def _started(self, number: int, drawn: Values, generator: np.random.Generator) -> Start:
        study = self._studies[number]
        of_vehicle = {n: v for n, v in drawn.items() if not n.startswith(MANOEUVRE)}
        simulation = self._simulation_of(number, tuple(of_vehicle.items()))
        values = {
            name.removeprefix(MANOEUVRE): value
            for name, value in {**study.fixed, **drawn}.items()
            if name.startswith(MANOEUVRE)
        }
        manoeuvre = study.manoeuvre.with_values(values)
        manoeuvre = manoeuvre.for_vehicle(simulation.vehicle, simulation.options)
        whole_steps(manoeuvre.duration, simulation.step_ns, "duration")
        simulation.reset(manoeuvre.speed)
        if simulation.has_sensors and NOISE not in (*study.fixed, *drawn):
            drawn[NOISE] = int(generator.integers(LARGEST_SEED))
            simulation.sensors.rest(drawn[NOISE])
            simulation.sense()
        return Start(simulation, manoeuvre, drawn)

    def _new_simulation(self, number: int, values: tuple) -> Simulation:
        return case_of(self._studies[number], dict(values)).simulation()


def _study(manoeuvre: str, fixed: dict, given: Mapping) -> Study:
    """The study of all that is fixed and drawn with one manoeuvre; raises InputError."""
    factors, fixed = mapping_of("factors", given.get("factors", {}), EXAMPLE), dict(fixed)
    if not factors:  # a study has one
        factors = {SPEED: [fixed.pop(SPEED, STANDARD[manoeuvre].speed)]}
    kinds = [isinstance(each, Mapping) and "distribution" in each for each in factors.values()]
    about_draws = {"design": RANDOM, "runs": 1, "seed": 0} if any(kinds) else {}
    values = {**given, "manoeuvre": manoeuvre, "fixed": fixed, "factors": factors, **about_draws}
    return study_of(_Given(values))
