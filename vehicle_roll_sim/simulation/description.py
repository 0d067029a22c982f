"""Description of a simulation as text from which it can be rebuilt; stored with its results."""

import dataclasses
import json
import math
import platform

from vehicle_roll_sim.declaration import OFF, ON, InputError, parameters_of
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.tire.coefficients import (
    ALIGNING,
    CAMBER_RANGE,
    INCLINED,
    OPTIONAL,
    OVERTURNING,
    PRESSURE,
    RADII,
    RANGES,
    REQUIRED,
    ROLLING,
    SCALING,
)
from vehicle_roll_sim.simulation.options import SWITCHES, Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.sensor_parameters import SEED
from vehicle_roll_sim.vehicle.tire_file import DEFAULTS, Tire
from vehicle_roll_sim.vehicle.vehicle_file import TIRES
from vehicle_roll_sim.version import __version__

PACKAGE = "vehicle_roll_sim"
FIELD = "simulation description"
OFF_UNLESS_DESCRIBED = dict.fromkeys(SWITCHES, OFF) | dict.fromkeys(
    ("wheel_gyroscopics", "body_contact"), False
)
OF_OLD_TIRES = {"version": "5.2", "combined": True}
ALWAYS = (*SCALING, *OPTIONAL, *RANGES, *REQUIRED)
"""Coefficients that are described even if they are neutral."""
BEYOND_PLAIN = {*INCLINED, *PRESSURE, *OVERTURNING, *ROLLING, *ALIGNING, *RADII, *CAMBER_RANGE}
"""Coefficients without effect on an upright tire without moments at its nominal pressure."""
UPRIGHT = {"front_camber": 0.0, "rear_camber": 0.0}
"""Neutral values of what older versions did not have."""
VERSION, MACHINE = __version__, f"{platform.system()} {platform.machine()}"
"""Version and machine, on which results depend to the last bit."""


@dataclasses.dataclass(frozen=True)
class Described:
    """A simulation rebuilt from a description, its publish period (s), and the version and machine
    on which it ran."""

    simulation: Simulation
    period: float
    version: str
    machine: str


def describe(simulation: Simulation, period_ns: int) -> str:
    """Describe a simulation whose commands are held for `period_ns` (ns), as one line of JSON."""
    about = {"package": PACKAGE, "version": VERSION, "machine": MACHINE}
    period = {"publish_period": period_ns / NANOSECONDS}
    return json.dumps(about | period | _parts(simulation))


def _parts(simulation: Simulation) -> dict:
    """Everything that defines a simulation.

    The seed of sensors is named even if it is 0. What older versions did not have is omitted where
    it is neutral: a description that lacks it describes the same simulation as ever.
    """
    vehicle, options = simulation.vehicle, dataclasses.asdict(simulation.options)
    taken = vehicle.from_tires
    if simulation.options.contact_patch_shift == ON:
        taken = taken | vehicle.lateral_stiffness_from_tires
    numbers = vehicle.with_depths().given | {name: found.value for name, found in taken.items()}
    if simulation.has_sensors:
        numbers[SEED] = simulation.sensors.seed
    numbers = {name: numbers[name] for name in parameters_of(Vehicle) if name in numbers}
    parts = {
        "step": simulation.step_ns / NANOSECONDS,
        "rollover_angle": simulation.rollover_angle,
        "model": _without_neutral(options, OFF_UNLESS_DESCRIBED),
        "road": simulation.road.values(),
        "vehicle": _without_neutral(numbers, UPRIGHT),
    }
    records = vehicle.tires(simulation.options.tire_moments == ON)
    is_plain = bool((records["plain"] * (1.0 - records["rolls_on_own_radius"])).all())
    for name, tire in vehicle.own_tires.items():
        parts |= _tire_parts(name, tire, is_plain)
    return parts


def _without_neutral(values: dict, neutral: dict) -> dict:
    return {name: v for name, v in values.items() if name not in neutral or v != neutral[name]}


def _tire_parts(name: str, tire: Tire, is_plain: bool) -> dict:
    """A tire under its name among TIRES; infinite range limits are omitted.

    is_plain: the coefficients of BEYOND_PLAIN have no effect.
    """
    values = tire.coefficients
    others = {n: v for n, v in values.items() if n not in ALWAYS and v != DEFAULTS[n]}
    if is_plain:
        others = {n: value for n, value in others.items() if n not in BEYOND_PLAIN}
    described = {n: values[n] for n in ALWAYS} | others
    about = {"side": tire.side, "version": tire.version, "combined": tire.combined}
    about = _without_neutral(about, OF_OLD_TIRES)
    return {
        name: {key: value for key, value in described.items() if math.isfinite(value)},
        **{f"{name}_{key}": value for key, value in about.items()},
    }


def _described_tire(told: dict, name: str) -> Tire:
    about = {key: told.get(f"{name}_{key}", value) for key, value in OF_OLD_TIRES.items()}
    return Tire(told[name], told[f"{name}_side"], **about)


def described(text: str) -> Described:
    """Rebuild a simulation from the text written by `describe`; raises InputError.

    It keeps its step even if that is too large for stability.
    """
    try:
        told = json.loads(text)
        tires = {name: _described_tire(told, name) for name in TIRES if name in told}
        simulation = Simulation(
            Vehicle.checked(told["vehicle"], **tires or {"tire": _described_tire(told, "tire")}),
            Options(**OFF_UNLESS_DESCRIBED | told["model"]),
            step=told["step"],
            rollover_angle=told["rollover_angle"],
            road=Road.from_values(told["road"]),
            check_step=False,  # it was run with this step
        )
        period = float(told["publish_period"])
        return Described(simulation, period, str(told["version"]), str(told["machine"]))
    except InputError as error:
        field = f"{FIELD}: {error.field}"
        raise InputError(field, error.value, error.allowed, error.problem) from None
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        allowed = f"a description written by {PACKAGE}"
        raise InputError(FIELD, "", allowed, f"{type(error).__name__}: {error}") from None


def difference(first: Simulation, second: Simulation) -> tuple[str, object, object] | None:
    """The first difference between two simulations: its name and both values; None if equal."""
    ours, theirs = _flat(_parts(first)), _flat(_parts(second))
    for name in ours | theirs:
        if ours.get(name) != theirs.get(name):
            return name, ours.get(name), theirs.get(name)
    return None


def _flat(parts: dict) -> dict:
    """Flatten nested parts, joining names with a dot."""
    flat = {}
    for name, value in parts.items():
        inner = value.items() if isinstance(value, dict) else ()
        flat |= {f"{name}.{key}": each for key, each in inner} or {name: value}
    return flat
