"""Whether the design, draws, correlations and search of a study fit together."""

import dataclasses
import math
from collections.abc import Callable, Mapping

import numpy as np

from vehicle_roll_sim.declaration import InputError, Parameter, number_of, unknown_name
from vehicle_roll_sim.files.yaml_file import Place
from vehicle_roll_sim.simulation.options import options_for
from vehicle_roll_sim.studies.chunks import unknown_metrics
from vehicle_roll_sim.studies.factors import Distribution, Factor
from vehicle_roll_sim.studies.quantities import MODEL
from vehicle_roll_sim.studies.source import Source
from vehicle_roll_sim.studies.study import DESIGNS, GRID, MOST_RUNS, RANDOM, SALTELLI, SOBOL, Study
from vehicle_roll_sim.vehicle.suspension_parameters import AXLES

RANDOM_DESIGNS = tuple(name for name in DESIGNS if name != GRID)
SMALLEST_EIGENVALUE = 1e-9
Declared = Callable[[Place, str], Parameter]


def design_of(source: Source, factors: Mapping[str, Factor]) -> str:
    """The design by its name, checked against the factors; raises InputError."""
    is_drawn = any(isinstance(each, Distribution) for each in factors.values())
    design = source.values.get("design", None if is_drawn else GRID)
    if design is None and "rare" in source.values:
        return RANDOM
    if design is None:
        allowed = "factors with distributions need one of " + ", ".join(RANDOM_DESIGNS)
        raise source.refused(("design",), None, allowed)
    if design not in DESIGNS:
        raise unknown_name(str(design), DESIGNS, source.where("design"))
    if is_drawn and design == GRID:
        allowed = "one of " + ", ".join(RANDOM_DESIGNS)
        raise source.refused(("design",), design, allowed, "factors have distributions")
    if not is_drawn and design != GRID:
        allowed = f"{GRID}, or factors with a distribution"
        raise source.refused(("design",), design, allowed, "no factor has a distribution")
    return design


def checked(source: Source, study: Study, declared: Declared) -> Study:
    """The study with its correlation; raises InputError for parts that do not fit together.

    declared: the declaration of a quantity by its place and name.
    """
    _check_draws(source, study)
    _check_tires(source, study)
    if study.search:
        _check_search(source, study, declared)
    if study.rare:
        _check_rare(source, study)
    if not study.factors and not study.search:
        raise source.refused(("factors",), None, "at least one factor, or a search")
    if study.points > MOST_RUNS:
        allowed = f"at most {MOST_RUNS} in all"
        raise source.refused(("factors",), study.points, allowed, f"{study.points} runs")
    return dataclasses.replace(study, correlation=_correlation(source, study))


def _check_draws(source: Source, study: Study) -> None:
    runs, seed = study.settings.runs, study.settings.seed
    if not study.drawn:
        for name, value in (("runs", runs), ("seed", seed)):
            if value is not None:
                allowed = "only together with distributions"
                raise source.refused((name,), value, allowed, "nothing is drawn")
        return
    if seed is None:
        allowed = "a whole number, from which all draws follow"
        raise source.refused(("seed",), None, allowed)
    if study.rare:
        return
    if runs is None:
        raise source.refused(("runs",), None, "the number of draws from the distributions")
    if study.design in (SOBOL, SALTELLI) and runs & (runs - 1):
        near = f"{2 ** int(math.log2(runs))} or {2 ** (int(math.log2(runs)) + 1)}"
        allowed = f"a power of 2 with design {study.design}, such as {near}"
        raise source.refused(("runs",), runs, allowed)


def _check_tires(source: Source, study: Study) -> None:
    """A coefficient is given for all tires or for those of one axle."""
    places = {name: ("factors", name) for name in study.factors}
    places |= {name: ("fixed", name) for name in study.fixed}
    if study.search:
        places[study.search.factor] = ("search", "factor")
    for name in places:
        axle, _, key = name.partition("_tire.")
        if axle in AXLES and key and f"tire.{key}" in places:
            problem = f"{name} together with tire.{key}"
            raise source.refused(places[name], name, "either all tires or one axle", problem)


def _check_search(
    source: Source, study: Study, declared: Callable[[Place, str], Parameter]
) -> None:
    search, where = study.search, source.where("search", "factor")
    if study.rare:
        raise source.refused(("search",), "", "either search or rare", "both are given")
    if study.design == SALTELLI:
        raise source.refused(("design",), SALTELLI, "any other design for a search")
    quantity = declared(("search", "factor"), search.factor)
    if quantity.kind is not float and not quantity.is_curve:
        raise InputError(where, search.factor, "a quantity that is a number")
    for bound in ("lowest", "highest"):
        quantity.validate(getattr(search, bound), source.where("search", bound))
    for names, key in ((study.factors, "factors"), (study.fixed, "fixed")):
        if search.factor in names:
            raise InputError(where, search.factor, f"a quantity that is not among {key}")
    _check_event(source, study, "search", search.event)


def _check_rare(source: Source, study: Study) -> None:
    where = source.where("rare", "event")
    _check_event(source, study, "rare", study.rare.event)
    if not study.events[study.rare.event].is_bounded:
        raise InputError(where, study.rare.event, "an event with a bound, above or below")
    if study.gridded or not study.drawn:
        raise source.refused(("factors",), "", "only factors with a distribution, for rare")
    for name in ("runs", "design"):
        if name in source.values:
            raise source.refused((name,), source.values[name], "no value together with rare")


def _check_event(source: Source, study: Study, key: str, name: str) -> None:
    """The event of a search, or a rare one, is known and can happen with all models."""
    where = source.where(key, "event")
    if name not in study.events:
        raise unknown_name(name, study.events, where)
    own = options_for(study.vehicle).model
    metric = study.events[name].metric
    for model in study.gridded.get(MODEL, (study.fixed.get(MODEL, own),)):
        if metric in unknown_metrics(model):
            problem = f"{name} is unknown to model {model}, which has no {metric}"
            raise InputError(where, name, "an event that all models have", problem)


def _correlation(source: Source, study: Study) -> np.ndarray:
    """The matrix of correlations of the drawn factors."""
    names = list(study.drawn)
    matrix = np.eye(len(names))
    given = source.values.get("correlations", [])
    if not isinstance(given, list | tuple):
        raise source.refused(("correlations",), given, "a list of [factor, factor, correlation]")
    if given and not names:
        allowed = "none, or factors with a distribution"
        raise source.refused(("correlations",), given, allowed, "no factor has a distribution")
    for index, entry in enumerate(given):
        place = ("correlations", index)
        if not isinstance(entry, list | tuple) or len(entry) != 3:
            raise source.refused(place, entry, "[factor, factor, correlation]")
        for name in entry[:2]:
            if name not in names:
                field = f"{source.where(*place)}: factor with a distribution"
                raise unknown_name(str(name), names, field)
        row, column = names.index(entry[0]), names.index(entry[1])
        allowed = "a number between -1 and 1"
        value = number_of(entry[2], source.where(*place), allowed)
        if row == column or matrix[row, column]:
            raise source.refused(place, entry, "each pair of two factors once")
        if not -1.0 < value < 1.0:
            raise source.refused(place, value, allowed)
        matrix[row, column] = matrix[column, row] = value
    if given and study.design == SALTELLI:
        raise source.refused(("correlations",), "", "none", f"{SALTELLI} needs independent factors")
    smallest = float(np.linalg.eigvalsh(matrix).min()) if names else 1.0
    if smallest < SMALLEST_EIGENVALUE:
        allowed = "correlations that can hold together (a positive definite matrix)"
        problem = f"the smallest eigenvalue of their matrix is {smallest:.3g}"
        raise source.refused(("correlations",), "", allowed, problem)
    return matrix
