"""Template files: the reference vehicle and its tire, with a comment on every value."""

from dataclasses import MISSING

from vehicle_roll_sim.declaration import Parameter, parameters_of
from vehicle_roll_sim.model.variants import PAPER
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.tire.general_keys import UNITS as UNIT_KEYS
from vehicle_roll_sim.vehicle.tire.keys import COEFFICIENTS, KEYS, REQUIRED
from vehicle_roll_sim.vehicle.tire.text import HEADER, KEY, UNITS
from vehicle_roll_sim.vehicle.tire.version import FORMAT
from vehicle_roll_sim.vehicle.vehicle_file import (
    FROM_LATERAL,
    LONGITUDINAL,
    MODEL,
    PRESETS,
    SHIPPED_TIRE,
    SWITCHES,
    preset,
)

ABOUT_THE_VEHICLE = """\
# Vehicle file for vehicle_roll_sim, with the values of the reference vehicle. Edit them as needed.
# Format: NAME: VALUE  # unit, allowed range: description (symbol in Shim and Ghike, 2007)
# `vehicle_roll_sim parameters --vehicle FILE` lists the parameters of a vehicle file.
"""
ABOUT_OPTIONAL = """\
# These are optional. The values shown are the defaults, but for tire radius and stiffnesses, whose
# defaults are those of the tire file.
"""
ABOUT_THE_PAYLOAD = """\
# Masses that the sprung mass carries besides; its data above are those of the vehicle without them.
# m, kg, kg m^2. left_of_middle and the moments of inertia about its own c.g. are 0 if left out.
# payload:
#   - {mass: 75, behind_front_axle: 1.3, height: 0.7, left_of_middle: 0.35}
#   - {mass: 60, behind_front_axle: 1.4, height: 1.6, pitch_inertia: 9, yaw_inertia: 9}
"""
ABOUT_SWITCHES = """\
# Whether the moments of the tires act, and whether contact patches shift sideways under lateral
# force (true or false; true if left out, but the vehicle of the paper has neither).
"""
ABOUT_THE_MODEL = f"""\
# The model with which the vehicle is simulated unless another is asked for. By default it is
# {PAPER}, that of the paper; 2 is recommended for a vehicle of your own.
# {MODEL}: "2"
"""
ABOUT_THE_TIRE = f"""\
# Path of a tire file (.tir) relative to this file, or `{SHIPPED_TIRE}` for the tire that comes with
# the package. `vehicle_roll_sim template --tire` writes a tire file to start from. front_tire and
# rear_tire in place of tire give each axle its own. `{LONGITUDINAL}: {FROM_LATERAL}` gives a tire
# file that has no longitudinal coefficients those of its lateral force.
tire: {SHIPPED_TIRE}
"""
ABOUT_COEFFICIENTS = """\
$ Tire file (Magic Formula 5.2) for vehicle_roll_sim, with the values of the reference tire. Edit
$ them as needed. Keys marked 'required' must be given; the others default to 1 for scaling factors,
$ 0 for coefficients, no limit for ranges, and SI for units. Keys marked 'not used' are ignored.
$ Fx, Fy: longitudinal and lateral force. Values have no unit unless one is given in parentheses.
"""
COMMENT_AT = 45
"""Column at which the comment of a line begins."""


def vehicle_template() -> str:
    """A commented vehicle file with the values of the reference vehicle."""
    vehicle, lines, optional = preset(), [], []
    for name, parameter in parameters_of(Vehicle).items():
        value = getattr(vehicle, name)
        line = f"{name}: {value!r}" if value is not None else f"# {name}:"
        is_optional = parameter.default is not MISSING and not parameter.alternative
        (optional if is_optional else lines).append(f"{line:{COMMENT_AT}}# {_about(parameter)}\n")
    switches = (f"{name}: {str(getattr(vehicle, name)).lower()}\n" for name in SWITCHES)
    optional = [ABOUT_OPTIONAL, *optional, ABOUT_SWITCHES, *switches]
    parts = [*lines, *optional, ABOUT_THE_PAYLOAD, ABOUT_THE_MODEL, ABOUT_THE_TIRE]
    return "".join([ABOUT_THE_VEHICLE, *parts])


def _about(parameter: Parameter) -> str:
    """Unit, allowed range, description and symbol of a parameter."""
    unit = parameter.unit or "-"
    allowed = f"{parameter.minimum:g} to {parameter.maximum:g}"
    symbol = f" ({parameter.symbol})" if parameter.symbol else ""
    return f"{unit}, {allowed}: {parameter.description}{symbol}"


def tire_template() -> str:
    """A commented tire file with the values of the reference tire."""
    text = (PRESETS / "reference.tir").read_text(encoding="utf-8")
    section, lines = "", []
    for line in text.splitlines():
        header = HEADER.match(line)
        section = header["name"] if header else section
        lines.append(_commented(line, section))
    return ABOUT_COEFFICIENTS + "".join(f"{line}\n" for line in lines)


def _commented(line: str, section: str) -> str:
    """Append a comment on its key to a line of a tire file; lines without a key are unchanged."""
    entry = KEY.match(line)
    if not entry:
        return line
    name = entry["key"]
    key = UNIT_KEYS[name] if section == UNITS else KEYS[name]
    if name in (FORMAT, *REQUIRED):
        note = "; required"
    else:
        is_used = section == UNITS or name in (*COEFFICIENTS["5.2"], "TYRESIDE")
        note = "" if is_used else "; not used"
    return f"{line:{COMMENT_AT}}$ {key.meaning}{note}"
