"""From the values of a study file, or of a mapping in Python, to a Study."""

import dataclasses
import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from vehicle_roll_sim.declaration import InputError, Parameter, parameters_of, plain, unknown_name
from vehicle_roll_sim.files.yaml_file import Place
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.manoeuvres.catalogue import MANOEUVRES
from vehicle_roll_sim.runs.run_metrics import METRIC_UNITS
from vehicle_roll_sim.simulation.road import ROAD_KEYS, Road
from vehicle_roll_sim.studies import design_checks
from vehicle_roll_sim.studies.factors import DISTRIBUTIONS, MOST_VALUES, Factor, Grid, Levels
from vehicle_roll_sim.studies.quantities import MODEL, PAYLOAD, quantity
from vehicle_roll_sim.studies.source import Source
from vehicle_roll_sim.studies.study import EVENTS, Event, Rare, Search, Settings, Study
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.shipped import SHIPPED, vehicle_named
from vehicle_roll_sim.vehicle.vehicle_file import preset

KEYS = (
    *("manoeuvre", "vehicle", "model", "road", "fixed", "factors", "correlations", "design"),
    *parameters_of(Settings),
    *("outputs", "events", "search", "rare"),
)
A_FACTOR = "a list of values, lowest, highest and count, or a distribution with its parameters"


def study_of(source: Source, is_to_run: bool = True) -> Study:
    """The study that these values describe; raises InputError naming file, line and key.

    is_to_run: otherwise its vehicle is not read, and another stands in for it.
    """
    values = source.mapping((), source.values, KEYS)
    vehicle = _vehicle(source) if is_to_run else preset()
    reader = _Reader(source, _manoeuvre(source), vehicle, is_to_run)
    fixed = reader.fixed()
    factors = reader.factors(fixed)
    numbers = {name: values[name] for name in parameters_of(Settings) if name in values}
    study = Study(
        said={},
        manoeuvre=reader.manoeuvre,
        vehicle=reader.vehicle,
        fixed=fixed,
        factors=factors,
        correlation=np.eye(0),
        design=design_checks.design_of(source, factors),
        settings=source.declared(Settings, (), numbers),
        outputs=_outputs(source),
        events=_events(source),
        search=_declared(source, "search", Search),
        rare=_declared(source, "rare", Rare),
        road=_road(source),
    )
    checked = design_checks.checked(source, study, reader.quantity)
    return dataclasses.replace(checked, said=_said(values, checked.road))


def _said(values: Mapping, road: Road | None) -> dict:
    """The values, which have been checked, as JSON has them; those of a road for its file."""
    by_name = {
        key: "a Vehicle" if isinstance(each, Vehicle) else each for key, each in values.items()
    }
    if road:
        by_name["road"] = road.values()
    return json.loads(json.dumps(by_name, default=_number))


def _number(value) -> float | bool | int:
    """A number of another library, such as NumPy, or of another type, such as Fraction."""
    number = plain(value)
    return float(number) if number is value else number


def _manoeuvre(source: Source) -> Manoeuvre:
    name = source.values.get("manoeuvre")
    if name is None:
        raise source.refused(("manoeuvre",), None, "one of " + ", ".join(MANOEUVRES))
    if not isinstance(name, str) or name not in MANOEUVRES:
        raise unknown_name(str(name), MANOEUVRES, source.where("manoeuvre"))
    return MANOEUVRES[name]


def _vehicle(source: Source) -> Vehicle:
    """The vehicle that is named: a file beside the study file, or a shipped one."""
    name = source.values.get("vehicle")
    if "vehicle" not in source.values or isinstance(name, Vehicle):
        return name or preset()
    if not isinstance(name, str) or not name:
        allowed = "the name of a vehicle file, or one of " + ", ".join(SHIPPED)
        raise source.refused(("vehicle",), name, allowed)
    beside = (source.path.parent if source.path else Path()) / name
    try:
        return vehicle_named(name if name in SHIPPED and not beside.exists() else beside)
    except InputError as error:
        if error.field != "vehicle":
            raise
        raise source.refused(("vehicle",), name, error.allowed, error.problem) from None


def _road(source: Source) -> Road | None:
    """The road that is given: a file beside the study file, or its values."""
    given = source.values.get("road")
    if given is None or isinstance(given, Road):
        return given
    try:
        if isinstance(given, str) and given:
            return Road.from_file((source.path.parent if source.path else Path()) / given)
        return Road.from_values(source.mapping(("road",), given, ROAD_KEYS))
    except InputError as error:
        if isinstance(given, str) or error.field.startswith(source.where("road")):
            raise
        where = f"{source.where('road')}: {error.field}"
        raise InputError(where, error.value, error.allowed, error.problem) from None


@dataclasses.dataclass(frozen=True)
class _Reader:
    """Reads what is fixed and varied of a manoeuvre and a vehicle."""

    source: Source
    manoeuvre: Manoeuvre
    vehicle: Vehicle
    checks_vehicle: bool

    def quantity(self, place: Place, name: str) -> Parameter:
        """The declaration of a quantity that is named at a place; raises InputError."""
        found = quantity(name, self.manoeuvre, self.source.where(*place))
        section, _, rest = name.partition(".")
        masses = len(self.vehicle.payload)
        if self.checks_vehicle and section == PAYLOAD and int(rest.partition(".")[0]) > masses:
            problem = f"the vehicle has {masses} masses of payload"
            raise self.source.refused(
                place, name, "the number of one of them, counted from 1", problem
            )
        return found

    def fixed(self) -> dict:
        """The fixed values by name, validated."""
        source, fixed = self.source, {}
        values = source.mapping(("fixed",), source.values.get("fixed", {}))
        if "model" in source.values:
            if MODEL in values:
                problem = f"{MODEL} together with model"
                raise source.refused(
                    ("fixed", MODEL), values[MODEL], "only one of the two", problem
                )
            declared = self.quantity(("model",), MODEL)
            fixed[MODEL] = declared.validate(str(source.values["model"]), source.where("model"))
        for name, value in values.items():
            place = ("fixed", name)
            fixed[name] = self.quantity(place, name).validate(value, source.where(*place))
        return fixed

    def factors(self, fixed: Mapping) -> dict[str, Factor]:
        """The factors by name."""
        source, factors = self.source, {}
        for name, values in source.mapping(("factors",), source.values.get("factors", {})).items():
            place = ("factors", name)
            declared = self.quantity(place, name)
            if name in fixed:
                problem = f"{name} is also fixed, at {fixed[name]}"
                raise source.refused(place, name, "either fixed or varied", problem)
            factors[name] = self._factor(place, values, declared)
        return factors

    def _factor(self, place: Place, values, declared: Parameter) -> Factor:
        source = self.source
        if isinstance(values, list | tuple):
            return self._levels(place, values, declared)
        if not isinstance(values, Mapping):
            raise source.refused(place, values, A_FACTOR)
        if not (declared.kind is float or declared.is_curve):
            problem = f"{declared.name} is not a number"
            raise source.refused(place, "", "a list of values", problem)
        kind, rest = Grid, dict(values)
        if "distribution" in values:
            name = str(rest.pop("distribution"))
            if name not in DISTRIBUTIONS:
                raise unknown_name(name, DISTRIBUTIONS, source.where(*place, "distribution"))
            kind = DISTRIBUTIONS[name]
        factor = source.declared(kind, place, rest)
        for bound, value in factor.limits.items():
            declared.validate(value, source.where(*place, bound))
        return factor

    def _levels(self, place: Place, values: list | tuple, declared: Parameter) -> Levels:
        source = self.source
        if not 1 <= len(values) <= MOST_VALUES:
            problem = f"{len(values)} values"
            raise source.refused(place, "", f"1 to {MOST_VALUES} values", problem)
        levels = []
        for index, value in enumerate(values):
            there = (*place, index)
            level = declared.validate(value, source.where(*there))
            if level is None or isinstance(level, tuple):
                raise source.refused(there, value, "a number")
            if level in levels:
                raise source.refused(there, value, "each value once", f"{level} is given twice")
            levels.append(level)
        return Levels(tuple(levels))


def _outputs(source: Source) -> tuple[str, ...]:
    outputs = source.values.get("outputs", ["peak_roll"])
    if not isinstance(outputs, list | tuple) or not outputs:
        allowed = "a list of some of " + ", ".join(METRIC_UNITS)
        raise source.refused(("outputs",), outputs, allowed)
    for index, name in enumerate(outputs):
        if not isinstance(name, str) or name not in METRIC_UNITS:
            raise unknown_name(str(name), METRIC_UNITS, source.where("outputs", index))
    return tuple(dict.fromkeys(outputs))


def _events(source: Source) -> dict[str, Event]:
    found = {}
    for name, values in source.mapping(("events",), source.values.get("events", {})).items():
        if not name.isidentifier() or not name.isascii():
            allowed = "a name of letters, digits and underscores"
            raise source.refused(("events", name), name, allowed)
        if name in METRIC_UNITS:  # their figures would have the same name
            raise source.refused(("events", name), name, "a name that is not that of a metric")
        if isinstance(values, Mapping) and values.get("metric") not in (None, *METRIC_UNITS):
            where = source.where("events", name, "metric")
            raise unknown_name(str(values["metric"]), METRIC_UNITS, where)
        found[name] = source.declared(Event, ("events", name), values)
    return found or EVENTS


def _declared(source: Source, key: str, kind: type):
    """An instance of a declaring class from the mapping of a key, None if there is none."""
    return source.declared(kind, (key,), source.values[key]) if key in source.values else None
