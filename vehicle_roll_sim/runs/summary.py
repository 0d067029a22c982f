"""The summary printed at the end of a run."""

import math

import numpy as np

from vehicle_roll_sim.declaration import ON
from vehicle_roll_sim.model.integration.events import MINIMUM_SPEED, TIME, VALUE, Condition
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.model.variants import PAPER
from vehicle_roll_sim.simulation.options import SWITCHES, Options
from vehicle_roll_sim.vehicle.derived_values import AXLES
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.tire.moments import moments_of

RANGES = ("slip ratio", "slip angle", "tire load", "inclination")
LABEL_WIDTH = 28


def summary_lines(events: np.record, time: float, condition: Condition, note: str = "") -> list:
    """Peaks, lift-offs, rollover and how the run ended, one line each.

    events: an EVENTS record. time: end of the run (s). note: the implausible state if it diverged.
    """
    roll, acceleration = events.peak_roll, events.peak_lateral_acceleration
    lift_offs = zip(WHEELS, events.lift_off_time, strict=True)
    return [
        line("peak roll angle", _peak(np.degrees(roll[VALUE]), "deg", roll)),
        line("peak lateral acceleration", _peak(acceleration[VALUE], "m/s^2", acceleration)),
        *(line(f"lift-off {wheel}", _time(time)) for wheel, time in lift_offs),
        line("rollover", _time(events.rollover_time[0])),
        *_ranges_left(events),
        line("end", f"{time:.3f} s, {_ending(condition, note)}"),
    ]


def choices(vehicle: Vehicle, options: Options) -> dict[str, str]:
    """The model that the vehicle names, and whether tire moments and contact patch shift count.

    One line each. options: those of the simulation. Nothing for a vehicle that names no model, has
    both off, and tires without moments, as in the paper.
    """
    stated_model = {"model": options.model} if vehicle.model != PAPER else {}
    return stated_model | _choices_of_tires(vehicle, options)


def _choices_of_tires(vehicle: Vehicle, options: Options) -> dict[str, str]:
    chosen = [getattr(options, name) for name in SWITCHES]
    stated = [getattr(vehicle, name) for name in SWITCHES]
    has_moments = any(moments_of(tire.coefficients) for tire in vehicle.axle_tires.values())
    if ON not in chosen and not any(stated) and not has_moments:
        return {}
    return {name.replace("_", " "): _choice(name, vehicle, options) for name in SWITCHES}


def _choice(name: str, vehicle: Vehicle, options: Options) -> str:
    """The resolved value of one of SWITCHES, and what is to be known about it."""
    if getattr(options, name) != ON:
        return "off" if options.model == "1" else f"off: model {options.model} does not have it"
    if name == "tire_moments":
        return ON
    compliance = vehicle.contact_patch_compliance(options.tire_moments == ON)
    of_axles = [
        f"{axle} lateral stiffness {1e-3 / compliance[wheel]:.4g} kN/m"
        if compliance[wheel]
        else f"{axle} contained in the overturning moment"
        for axle, wheel in AXLES.items()
    ]
    return f"on, {', '.join(of_axles)}"


def line(label: str, value) -> str:
    """A line of the summary: label, colon and value."""
    return f"{label + ': ':{LABEL_WIDTH}}{value}"


def _time(value: float) -> str:
    return "none" if math.isnan(value) else f"{value:.3f} s"


def _peak(value: float, unit: str, peak: np.ndarray) -> str:
    when = f" at {peak[TIME]:.3f} s" if peak[VALUE] else ""
    return f"{value:.3f} {unit}{when}"


def _ranges_left(events: np.record):
    for quantity, time in zip(RANGES, events.out_of_range_time, strict=True):
        if not math.isnan(time):
            note = f"from {time:.3f} s: outside the range of the tire file"
            yield line(f"{quantity} out of range", note)


def _ending(condition: Condition, note: str) -> str:
    if condition is Condition.ROLLED_OVER:
        return "rolled over"
    if condition is Condition.TOO_SLOW:
        return f"too slow: the speed fell to {MINIMUM_SPEED:g} m/s, the minimum of the model"
    if condition is Condition.DIVERGED:
        cause = "unrealistic torques, forces or parameters, or too large a step"
        return f"diverged: {note} is not plausible ({cause})"
    return "complete"
