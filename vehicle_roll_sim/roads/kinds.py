"""The kinds of features by name, and features from plain values such as those of a file."""

import dataclasses
from collections.abc import Mapping

from vehicle_roll_sim.declaration import InputError, parameters_of, unknown_name
from vehicle_roll_sim.roads.commanded import Commanded
from vehicle_roll_sim.roads.grid import Grid
from vehicle_roll_sim.roads.heights import BankedCurve, CorkscrewRamp, Curb, Ramp, Wave
from vehicle_roll_sim.roads.profiles import Profile, RandomProfile
from vehicle_roll_sim.roads.surfaces import Chessboard, Patch, SoftSoil
from vehicle_roll_sim.roads.tilt import TiltTable

KINDS = {
    "patch": Patch,
    "chessboard": Chessboard,
    "soft_soil": SoftSoil,
    "ramp": Ramp,
    "corkscrew_ramp": CorkscrewRamp,
    "wave": Wave,
    "curb": Curb,
    "banked_curve": BankedCurve,
    "profile": Profile,
    "random_profile": RandomProfile,
    "grid": Grid,
    "tilt_table": TiltTable,
    "commanded": Commanded,
}
NAMES = {kind: name for name, kind in KINDS.items()}
KIND = "kind"


def feature_of(values, field: str):
    """The feature that a mapping of values describes; raises InputError, fields after `field`."""
    if not isinstance(values, Mapping):
        raise InputError(field, values, f"a mapping with {KIND} and its values")
    values = dict(values)
    name = values.pop(KIND, None)
    if name is None:
        raise InputError(f"{field}: {KIND}", None, "one of " + ", ".join(KINDS))
    if not isinstance(name, str) or name not in KINDS:
        raise unknown_name(str(name), KINDS, f"{field}: {KIND}")
    kind = KINDS[name]
    fields = {each.name: each for each in dataclasses.fields(kind)}
    for key in values:
        if key not in fields:
            raise unknown_name(str(key), fields, f"{field}: name")
    declared = parameters_of(kind)
    needed = [key for key, each in declared.items() if each.default is dataclasses.MISSING]
    if missing := [key for key in needed if key not in values]:
        raise InputError(f"{field}: {', '.join(missing)}", None, "all are required")
    try:
        return kind(**values)
    except InputError as error:
        problem, allowed = error.problem, error.allowed
        raise InputError(f"{field}: {error.field}", error.value, allowed, problem) from None


def values_of(feature) -> dict:
    """The values from which `feature_of` makes an equal feature, for JSON and YAML.

    Those that are at their defaults are left out.
    """
    values = {KIND: NAMES[type(feature)]}
    for each in dataclasses.fields(feature):
        value = getattr(feature, each.name)
        if value != each.default:
            values[each.name] = value
    return values
