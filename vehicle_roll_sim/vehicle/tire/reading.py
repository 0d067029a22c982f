"""Reads a tire file: coefficients in SI units and ISO signs, and notes on the decisions made."""

from pathlib import Path
from typing import NamedTuple

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.tire.checks import check_complete, check_numbers, warnings_of
from vehicle_roll_sim.vehicle.tire.combined_slip import check_weights
from vehicle_roll_sim.vehicle.tire.idle_keys import TURN_SLIP
from vehicle_roll_sim.vehicle.tire.keys import (
    COEFFICIENTS,
    COMBINED,
    KEYS,
    LONGITUDINAL,
    NUMERIC,
    defaults,
)
from vehicle_roll_sim.vehicle.tire.lateral_only import FROM_LATERAL, WITH_Y, stand_in
from vehicle_roll_sim.vehicle.tire.pac2002_pressure import without_pressure
from vehicle_roll_sim.vehicle.tire.resistance import within_resistance
from vehicle_roll_sim.vehicle.tire.signs import in_iso, made_symmetric
from vehicle_roll_sim.vehicle.tire.text import UNITS, Entry, first_of_each, read
from vehicle_roll_sim.vehicle.tire.units import converted, factors
from vehicle_roll_sim.vehicle.tire.unknown_keys import pass_over
from vehicle_roll_sim.vehicle.tire.use_mode import Mode, mode_of, side_of
from vehicle_roll_sim.vehicle.tire.version import version_of
from vehicle_roll_sim.vehicle.tire.vertical import check_vertical, vertical_notes


class TireData(NamedTuple):
    """What a tire file says: see Tire."""

    coefficients: dict[str, float]
    side: str
    version: str
    combined: bool
    notes: tuple[str, ...]


def tire_data(path: Path, longitudinal: str = "") -> TireData:
    """Read a tire file; raises InputError naming file, line, key, value and what is allowed.

    longitudinal: from_lateral, to derive the longitudinal force of a file that has none.
    """
    if longitudinal not in ("", FROM_LATERAL):
        raise InputError("longitudinal", longitudinal, FROM_LATERAL)
    text = read(path)
    notes = pass_over(text.entries)
    units_given = first_of_each(e for e in text.entries if e.section == UNITS)
    units = factors(units_given)
    entries = _known(text.entries)
    mode = mode_of(entries)
    numbers = {
        name: entries[name].number(units[KEYS[name].dimension])
        for name in NUMERIC
        if name in entries
    }
    numbers, dropped = without_pressure(entries, numbers)
    version = version_of(entries, numbers)
    is_made = _is_to_be_made(path, numbers, mode, longitudinal)
    optional = COMBINED if is_made or not mode.combined else ()
    check_complete(path, numbers, (*optional, *(LONGITUDINAL if is_made else ())), version)
    acting = {name: v for name, v in numbers.items() if name in COEFFICIENTS[version.name]}
    coefficients, replaced = defaults() | acting, []
    check_numbers(coefficients, {n: e for n, e in entries.items() if not (is_made and n in WITH_Y)})
    check_vertical(coefficients, entries)
    if is_made:
        coefficients, replaced = stand_in(coefficients, mode.combined)
    side, about_side = side_of(entries, mode.mirrored)
    coefficients, turned = in_iso(coefficients, entries, text.comments)
    coefficients, cut = within_resistance(coefficients, entries, turned)
    if mode.combined and not is_made:
        check_weights(coefficients, entries)
    if side == "symmetric":
        coefficients, symmetric = made_symmetric(coefficients)
        about_side = [*about_side, *symmetric]
    decided = [version.reason, *dropped, *turned, *about_side, *mode.notes, *replaced]
    warned = warnings_of(coefficients, entries, mode.combined)
    told = (
        *decided,
        *converted(units_given),
        *_not_simulated(coefficients, entries, text.sections),
        *notes,
        *cut,
        *warned,
    )
    return TireData(coefficients, side, version.name, mode.combined, told)


def _known(entries: list[Entry]) -> dict[str, Entry]:
    """The entries with known keys outside [UNITS], each once."""
    return first_of_each(e for e in entries if e.section != UNITS and e.key in KEYS)


def _is_to_be_made(path: Path, numbers: dict[str, float], mode: Mode, longitudinal: str) -> bool:
    """Whether the longitudinal force is to be derived from the lateral force.

    Raises InputError if the file has none and none is to be derived.
    """
    has_none = not any(numbers.get(name, 0.0) for name in LONGITUDINAL)
    if "PKY1" not in numbers or not (mode.lateral_only or has_none):
        return False
    if longitudinal == FROM_LATERAL:
        return True
    problem = "USE_MODE is for lateral force only" if mode.lateral_only else "missing or 0"
    allowed = (
        "`longitudinal: from_lateral` in the vehicle file (of the command tire: --longitudinal "
        "from_lateral; of load_tire: longitudinal='from_lateral') derives it from the lateral force"
    )
    raise InputError(f"{path}: {', '.join(LONGITUDINAL)}", None, allowed, problem)


def _not_simulated(
    coefficients: dict[str, float], entries: dict[str, Entry], sections: list[str]
) -> list[str]:
    """Notes on the terms of turn slip and of the vertical force that have no effect."""
    given = [name for name in TURN_SLIP if name in entries and name != "LMP"]
    notes = [f"turn slip is not simulated: {len(given)} coefficients ignored"] if given else []
    return [*notes, *vertical_notes(coefficients, entries, sections)]
