"""Files to start from: the reference vehicle and tire, with a comment on every value."""

from dataclasses import MISSING

from vehicle_roll_sim.declaration import Parameter, parameters_of
from vehicle_roll_sim.model.tire.magic_formula import REQUIRED
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.tire_file import ENTRY, FORMAT, UNITS, USED
from vehicle_roll_sim.vehicle.tire_meanings import MEANINGS
from vehicle_roll_sim.vehicle.vehicle_file import PRESETS, SHIPPED_TIRE, preset

ABOUT_THE_VEHICLE = """\
# A vehicle file of vehicle_roll_sim: the reference vehicle, to be changed.
# A line is NAME: VALUE. Behind it: unit, allowed range, meaning, symbol in the source (Shim and
# Ghike, 2007). `vehicle_roll_sim parameters --vehicle FILE` shows what a file says.
"""
ABOUT_OPTIONAL = "# These are optional; the values shown are the defaults.\n"
ABOUT_THE_TIRE = f"""\
# A tire file (.tir) with its path from here, or {SHIPPED_TIRE}: the tire that is shipped.
# `vehicle_roll_sim template --tire` writes one to start from.
tire: {SHIPPED_TIRE}
"""
ABOUT_COEFFICIENTS = """\
$ A tire file of vehicle_roll_sim, Magic Formula 5.2: the reference tire, to be changed.
$ What must be given is marked 'required'. Without the others scaling factors are 1, coefficients 0,
$ ranges unlimited and units SI. Keys marked 'not used' are ignored. Fx and Fy: forces along and
$ across the wheel. Values have no unit unless one is given in brackets.
"""
COMMENT_AT = 45
"""Column of a line at which its comment begins."""


def vehicle_template() -> str:
    """A vehicle file with the values of the reference vehicle and comments."""
    vehicle, lines, optional = preset(), [], []
    for name, parameter in parameters_of(Vehicle).items():
        value = getattr(vehicle, name)
        line = f"{name}: {value!r}" if value is not None else f"# {name}:"
        is_optional = parameter.default not in (MISSING, None)
        (optional if is_optional else lines).append(f"{line:{COMMENT_AT}}# {_about(parameter)}\n")
    return "".join([ABOUT_THE_VEHICLE, *lines, ABOUT_OPTIONAL, *optional, ABOUT_THE_TIRE])


def _about(parameter: Parameter) -> str:
    """Unit, range and meaning."""
    unit = parameter.unit or "-"
    allowed = f"{parameter.minimum:g} to {parameter.maximum:g}"
    symbol = f" ({parameter.symbol})" if parameter.symbol else ""
    return f"{unit}, {allowed}: {parameter.description}{symbol}"


def tire_template() -> str:
    """A tire file with the values of the reference tire and comments."""
    text = (PRESETS / "reference.tir").read_text(encoding="utf-8")
    return ABOUT_COEFFICIENTS + "".join(f"{_commented(line)}\n" for line in text.splitlines())


def _commented(line: str) -> str:
    """A line of a tire file, with the meaning of its key if it has one."""
    entry = ENTRY.match(line)
    if not entry:
        return line
    key = entry["key"]
    if key in (FORMAT, *REQUIRED):
        note = "; required"
    else:
        note = "" if key in USED or key in UNITS else "; not used"
    return f"{line:{COMMENT_AT}}$ {MEANINGS[key]}{note}"
