"""Settings of an identification: which values are free, sensors, priors."""

from collections.abc import Mapping, Sequence

from vehicle_roll_sim.identification.problem import Prior
from vehicle_roll_sim.identification.sensors import KINDS, sensor_name
from vehicle_roll_sim.input_errors import InputError, number_in, unknown_name


def with_sensors(names: Sequence[str], kinds: Sequence[str], compared: Sequence[str]) -> list[str]:
    """The names, and those of these kinds of values of the sensors of all compared quantities."""
    for kind in kinds:
        if kind not in KINDS:
            raise unknown_name(kind, KINDS, "sensors")
    added = [sensor_name(quantity, kind) for kind in kinds for quantity in compared]
    return [*names, *(name for name in added if name not in names)]


def prior_of(name: str, given, names: Sequence[str]) -> Prior:
    """A prior from (mean, standard deviation); raises InputError."""
    field, allowed = f"prior {name}", "a mean and a standard deviation above 0: MEAN,SD"
    if name not in names:
        raise unknown_name(name, names, "prior")
    try:
        mean, deviation = (float(each) for each in given)
    except (TypeError, ValueError):
        raise InputError(field, str(given), allowed) from None
    if not (abs(mean) < float("inf") and 0.0 < deviation < float("inf")):
        raise InputError(field, str(given), allowed)
    return Prior(mean, deviation)


def priors_of(given: Mapping[str, object], names: Sequence[str]) -> dict[str, Prior]:
    """Priors by name; raises InputError for a name that is not identified."""
    return {name: prior_of(name, each, names) for name, each in given.items()}


def prior_texts(assignments: Sequence[str]) -> dict[str, tuple[float, ...]]:
    """NAME=MEAN,SD, as the command line has it; raises InputError."""
    found = {}
    for text in assignments:
        name, equals, numbers = text.partition("=")
        try:
            found[name] = tuple(number_in(each) for each in numbers.split(","))
        except ValueError:
            equals = ""
        if not equals or len(found[name]) != 2:
            raise InputError("--prior", text, "NAME=MEAN,SD")
    return found
