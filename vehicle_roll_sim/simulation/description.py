"""Description of a simulation as text from which it can be rebuilt; stored with its results."""

import dataclasses
import json
import math
import platform

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.tire_file import DEFAULTS, Tire
from vehicle_roll_sim.version import __version__

PACKAGE = "vehicle_roll_sim"
FIELD = "simulation description"
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
    """Everything that defines a simulation; infinite range limits of the tire are omitted."""
    vehicle = simulation.vehicle
    coefficients = vehicle.tire.coefficients.items()
    return {
        "step": simulation.step_ns / NANOSECONDS,
        "rollover_angle": simulation.rollover_angle,
        "model": dataclasses.asdict(simulation.options),
        "road": dataclasses.asdict(simulation.road),
        "vehicle": vehicle.with_depths().given,
        "tire": {name: value for name, value in coefficients if math.isfinite(value)},
        "tire_side": vehicle.tire.side,
    }


def described(text: str) -> Described:
    """Rebuild a simulation from the text written by `describe`; raises InputError.

    It keeps its step even if that is too large for stability.
    """
    try:
        told = json.loads(text)
        tire = Tire(DEFAULTS | told["tire"], told["tire_side"])
        simulation = Simulation(
            Vehicle.checked(told["vehicle"], tire),
            Options(**told["model"]),
            step=told["step"],
            rollover_angle=told["rollover_angle"],
            road=Road(**told["road"]),
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
