"""Vehicle files (YAML with the parameters of `Vehicle`) and the presets of the package."""

import copy
import dataclasses
import errno
import functools
import os
from dataclasses import MISSING
from importlib.resources import as_file, files
from pathlib import Path

from vehicle_roll_sim.declaration import InputError, parameters_of, unknown_name
from vehicle_roll_sim.files.yaml_file import read_mapping
from vehicle_roll_sim.vehicle.masses import Load
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.tire_file import Tire, load_tire

A_MAPPING = "expected a YAML mapping of parameter names to values"
TEMPLATE_HAS_ALL = "`vehicle_roll_sim template` writes a complete file"
SHIPPED_TIRE = "reference"
"""The name by which a vehicle file refers to the tire that comes with the package."""
TIRES = ("tire", "front_tire", "rear_tire")
"""Keys that name a tire file: one for all wheels, or one for each axle."""
SWITCHES = ("tire_moments", "contact_patch_shift")
"""Keys that say what the options of these names mean by `auto`."""
PAYLOAD = "payload"
"""Key of the masses that the sprung mass carries besides."""
LONGITUDINAL, FROM_LATERAL = "longitudinal", "from_lateral"
"""Key and value by which a lateral-only tire file gets a stand-in for longitudinal forces."""
MODEL = "model"
"""Key that names the model with which the vehicle is simulated by default."""
NO_NUMBERS = (*TIRES, *SWITCHES, LONGITUDINAL, PAYLOAD, MODEL)
"""All keys beside the parameters of a vehicle."""
PRESETS = files("vehicle_roll_sim.vehicle") / "presets"


def load_vehicle(path: str | Path) -> Vehicle:
    """Read a vehicle file and its tire files; raises InputError naming file, line and key."""
    path = Path(path)
    values, lines = _mapping(path)
    where = {name: f"{path}: line {line}: {name}" for name, line in lines.items()}
    known = parameters_of(Vehicle)
    expected = (*known, *NO_NUMBERS)
    for name in values:
        if name not in expected:
            raise unknown_name(name, expected, f"{path}: line {lines[name]}: name")
    if missing := _missing(values):
        wanted = f"all are required; {TEMPLATE_HAS_ALL}"
        raise InputError(f"{path}: {', '.join(missing)}", None, wanted)
    numbers = {
        name: known[name].validate(value, where[name])
        for name, value in values.items()
        if name in known
    }
    others = _others(path, values, where)
    try:
        return Vehicle(**numbers, **others, stated_at=where)
    except InputError as error:  # inconsistent values
        field = where.get(error.field, f"{path}: {error.field}")
        raise InputError(field, error.value, error.allowed, error.problem) from None


def no_parameter(name: str, field: str, elsewhere: str, file: str) -> InputError:
    """The error for one of NO_NUMBERS among numbers.

    elsewhere: the option or parameter that it is instead, if any. file: the option or parameter for
    a vehicle file.
    """
    if elsewhere:
        return InputError(field, name, f"give {elsewhere} instead", f"{name} is no number")
    allowed = f"write it into a vehicle file ({file})"
    return InputError(field, name, allowed, f"{name} is a key of vehicle files only")


def _others(path: Path, values: dict, where: dict[str, str]) -> dict:
    """The values of the keys that are not numbers: tires, switches, reading of tires, model."""
    others = {}
    if LONGITUDINAL in values:
        if values[LONGITUDINAL] != FROM_LATERAL:
            raise InputError(where[LONGITUDINAL], values[LONGITUDINAL], FROM_LATERAL)
        others[LONGITUDINAL] = FROM_LATERAL
    if MODEL in values:
        others[MODEL] = str(values[MODEL])
    for name in SWITCHES:
        if name in values:
            if not isinstance(values[name], bool):
                raise InputError(where[name], values[name], "true or false")
            others[name] = values[name]
    if PAYLOAD in values:
        others[PAYLOAD] = _payload(values[PAYLOAD], where[PAYLOAD])
    for name in TIRES:
        if name in values:
            others[name] = _tire(path, values[name], where[name], others.get(LONGITUDINAL, ""))
    return others


def _payload(values, where: str) -> tuple[Load, ...]:
    """The payload from a list of mappings; raises InputError."""
    known = parameters_of(Load)
    required = [name for name, declared in known.items() if declared.default is MISSING]
    if not isinstance(values, list) or not all(isinstance(each, dict) for each in values):
        allowed = "a list of masses, each with " + ", ".join(required)
        raise InputError(where, values, allowed)
    loads = []
    for number, given in enumerate(values, 1):
        field = f"{where}: mass {number}"
        for name in given:
            if name not in known:
                raise unknown_name(str(name), known, f"{field}: name")
        if missing := [name for name in required if name not in given]:
            raise InputError(f"{field}: {', '.join(missing)}", None, "all are required")
        try:
            loads.append(Load(**given))
        except InputError as error:
            problem, allowed = error.problem, error.allowed
            raise InputError(f"{field}: {error.field}", error.value, allowed, problem) from None
    return tuple(loads)


def _missing(values: dict) -> list[str]:
    """Required names that are missing; two missing alternatives are joined as `A or B`."""
    missing = []
    for name, declared in parameters_of(Vehicle).items():
        other = declared.alternative
        if other and name not in values and other not in values:
            both = f"{name} or {other}"
            missing += [both] if f"{other} or {name}" not in missing else []
        elif declared.default is MISSING and name not in values:
            missing.append(name)
    return missing if values.keys() & {*TIRES} else [*missing, "tire"]


def _tire(path: Path, name, where: str, longitudinal: str) -> Tire:
    """The tire named in the vehicle file at `path`."""
    if not isinstance(name, str) or not name:
        raise InputError(where, name, f"the name of a .tir file, or {SHIPPED_TIRE}")
    if name == SHIPPED_TIRE:
        return shipped_tire()
    file = path.parent / name
    try:
        return tire_of(file, longitudinal)
    except InputError as error:
        if error.field != f"file {file}":
            raise
        is_absent = error.problem == os.strerror(errno.ENOENT)
        problem = f"{file} does not exist" if is_absent else f"{file}: {error.problem}"
    wanted = f"the path of a .tir file relative to the vehicle file, or {SHIPPED_TIRE}"
    raise InputError(where, name, wanted, problem)


def tire_of(file: str | Path, longitudinal: str) -> Tire:
    """Read a tire file; longitudinal: `from_lateral` if the vehicle asks for it, else ''."""
    return load_tire(file, longitudinal=longitudinal) if longitudinal else load_tire(file)


def on_tires(vehicle: Vehicle, files: dict[str, str | Path]) -> Vehicle:
    """The vehicle on other tires.

    files: tire files by the names of TIRES; that of one axle leaves the other axle its tire. Raises
    InputError.
    """
    if not files:
        return vehicle
    if "tire" in files and len(files) > 1:
        other = next(name for name in files if name != "tire")
        problem = f"{files['tire']} together with {other} {files[other]}"
        allowed = "either one tire for all wheels, or tires of one or both axles"
        raise InputError("tire", str(files["tire"]), allowed, problem)
    loaded = {name: tire_of(file, vehicle.longitudinal) for name, file in files.items()}
    if "tire" not in loaded:
        of_axles = {f"{axle}_tire": tire for axle, tire in vehicle.axle_tires.items()}
        loaded = of_axles | loaded
    return dataclasses.replace(vehicle, **dict.fromkeys(TIRES) | loaded)


def _mapping(path: Path) -> tuple[dict, dict[str, int]]:
    """The values of a file and their line numbers, both by name."""
    values, lines = read_mapping(path, "vehicle file", A_MAPPING)
    return values, {place[0]: line for place, line in lines.items() if len(place) == 1}


def shipped_tire() -> Tire:
    """The tire of the reference vehicle."""
    with as_file(PRESETS) as folder:
        return load_tire(folder / "reference.tir")


def preset(name: str = "reference") -> Vehicle:
    """A vehicle that comes with the package; `reference` is that of Shim and Ghike (2007)."""
    return copy.deepcopy(_shipped(name))


@functools.cache
def _shipped(name: str) -> Vehicle:
    """The vehicle in a file of the package, which is read once."""
    with as_file(PRESETS) as folder:
        return load_vehicle(folder / f"{name}.yaml")
