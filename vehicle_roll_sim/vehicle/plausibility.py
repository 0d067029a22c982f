"""Plausibility checks: values that are allowed but atypical, usually given in the wrong unit."""

import contextlib
import contextvars
import math
import sys
import warnings
from collections.abc import Iterable, Iterator

from vehicle_roll_sim.vehicle.derived_values import AXLES
from vehicle_roll_sim.vehicle.parameters import Vehicle

PACKAGE = __name__.partition(".")[0]
LARGEST_STEERING = math.pi / 3
"""rad; no road vehicle reaches larger road-wheel angles."""
RIDE_FREQUENCY = (0.5, 10.0)
"""Hz; from very softly sprung passenger cars to formula cars with hardly any suspension travel."""
DAMPING_RATIO = (0.05, 2.0)
"""Fraction of critical damping; passenger cars have 0.2 to 0.4, race cars up to 1."""
LARGEST_SAG = 0.5
"""m; static deflection of a spring."""
LARGEST_FLATTENING = 0.25
"""Static compression of a tire over its radius."""
LOWEST_CENTRE = 0.5
"""Height of the sprung c.g. over that of the wheel centres; formula cars have at least 0.8."""
RADIUS_OF_GYRATION = {
    "roll_inertia": ("track", 0.1, 1.0),
    "pitch_inertia": ("wheelbase", 0.15, 1.0),
    "yaw_inertia": ("wheelbase", 0.15, 1.0),
}
"""Radius of gyration of the sprung mass over a length of the vehicle.

Cars, buses and scale models have 0.25 to 0.55. An inertia given in kg cm^2 appears as 100 times
this ratio, one given in lb ft^2 as about 5 times.
"""
WHEELS_RADIUS_OF_GYRATION = (0.1, 3.0)
"""Radius of gyration of the unsprung mass over the tire radius; includes geared driveline parts."""
ROUNDING = 1e-9
"""m"""
_UNWARNED = contextvars.ContextVar("unwarned", default=False)
"""Whether warnings are suppressed; the filters of `warnings` are the same in all threads."""


class PlausibilityWarning(UserWarning):
    """A value is allowed but implausible; the message is one line with the value and typical ones.

    `warnings.simplefilter("error", PlausibilityWarning)` turns it into an error.
    """


def plausibility(vehicle: Vehicle) -> list[str]:
    """One line for each implausible value of a vehicle, beginning with the parameter's name."""
    return list(doubts(vehicle))


def doubts(vehicle: Vehicle) -> Iterator[str]:
    """The lines of `plausibility`, each found when it is asked for."""
    yield from _inertias(vehicle)
    for check in (_suspension, _roll_centre):
        for axle, wheel in AXLES.items():
            yield from check(vehicle, axle, wheel)
    yield from _lowness(vehicle)
    yield from _pressures(vehicle)


def doubtful_steering(name: str, angle: float) -> str:
    """The warning for `name`, a road-wheel angle (rad) beyond LARGEST_STEERING."""
    usual = f"typically at most {LARGEST_STEERING:.4f} rad; give the angle in radians"
    figure = f"{angle:.4g} rad is {math.degrees(angle):.4g} deg"
    return f"{name}: {figure} at the road wheels: {usual}"


def warn(lines: Iterable[str]) -> None:
    """Issue a PlausibilityWarning for each line, located at the call into this package."""
    if _UNWARNED.get():
        return
    for line in lines:
        warnings.warn(line, PlausibilityWarning, stacklevel=_levels_to_the_caller())


@contextlib.contextmanager
def unwarned() -> Iterator[None]:
    """Suppress PlausibilityWarning in this thread, for programs that report implausible values
    themselves."""
    before = _UNWARNED.set(True)
    try:
        yield
    finally:
        _UNWARNED.reset(before)


def _levels_to_the_caller() -> int:
    """Number of stack frames from `warn` up to the first frame outside this package."""
    frame, levels = sys._getframe(2), 2
    while frame is not None and _is_own(frame.f_globals.get("__name__", "")):
        frame, levels = frame.f_back, levels + 1
    return levels


def _is_own(module: str) -> bool:
    return module == PACKAGE or module.startswith(f"{PACKAGE}.")


def _inertias(vehicle: Vehicle) -> Iterator[str]:
    lengths = {
        "track": (vehicle.front_track + vehicle.rear_track) / 2,
        "wheelbase": vehicle.wheelbase,
        "tire radius": float(vehicle.per_wheel("tire_radius").mean()),
    }
    unsprung = (vehicle.front_unsprung_mass + vehicle.rear_unsprung_mass) / 2
    checks = [(name, vehicle.sprung_mass, *of) for name, of in RADIUS_OF_GYRATION.items()]
    checks.append(("wheel_inertia", unsprung, "tire radius", *WHEELS_RADIUS_OF_GYRATION))
    for name, mass, length, least, most in checks:
        inertia = getattr(vehicle, name)
        radius = math.sqrt(inertia / mass)
        share = radius / lengths[length]
        if not least <= share <= most:
            figure = f"a radius of gyration of {radius:.3g} m, {share:.3g} times the {length}"
            usual = f"typically {least:g} to {most:g} times"
            yield f"{name}: {inertia:g} kg m^2 gives {figure}: {usual}"


def _suspension(vehicle: Vehicle, axle: str, wheel: int) -> Iterator[str]:
    tire = f"{axle}_tire_stiffness"
    spring, damper = f"{axle}_spring_stiffness", f"{axle}_damping"
    spring = spring if spring in vehicle.given else f"{axle}_spring_force"
    damper = damper if damper in vehicle.given else f"{axle}_damper_force"
    names = ("spring_stiffness", "tire_stiffness", "damping")
    stiffness, tires, damping = (float(vehicle.per_wheel(name)[wheel]) for name in names)
    mass = float(vehicle.sprung_mass * vehicle.axle_load_share[wheel])
    sag = float(vehicle.static_suspension_compression[wheel])
    if sag > LARGEST_SAG:
        figure = f"{stiffness:g} N/m gives a static deflection of {sag:.3g} m"
        yield f"{spring}: {figure}: typically at most {LARGEST_SAG:g} m"
    flattening = float(vehicle.static_tire_compression[wheel])
    flattening /= float(vehicle.per_wheel("tire_radius")[wheel])
    if flattening > LARGEST_FLATTENING:
        figure = f"a static compression of {flattening:.3g} times the tire radius"
        usual = f"typically at most {LARGEST_FLATTENING:g} times"
        yield f"{tire}: {tires:g} N/m gives {figure}: {usual}"
    at_rest = float(vehicle.tire_stiffness_at_rest[wheel])
    in_series = stiffness * at_rest / (stiffness + at_rest)
    frequency = math.sqrt(in_series / mass) / math.tau
    least, most = RIDE_FREQUENCY
    if not least <= frequency <= most:
        figure = f"a ride frequency of {frequency:.3g} Hz at the {axle} axle, tires included"
        yield f"{spring}: {stiffness:g} N/m gives {figure}: typically {least:g} to {most:g} Hz"
    ratio = damping / (2 * math.sqrt(stiffness * mass))
    least, most = DAMPING_RATIO
    if not least <= ratio <= most:
        figure = f"{damping:g} N s/m gives a damping ratio of {ratio:.3g} at the {axle} axle"
        yield f"{damper}: {figure}: typically {least:g} to {most:g}"


def _roll_centre(vehicle: Vehicle, axle: str, wheel: int) -> Iterator[str]:
    """A roll centre below the road is accepted silently only if it was specified as a height."""
    name = f"{axle}_roll_centre_depth"
    depth, height = float(vehicle.roll_centre_depth[wheel]), vehicle.roll_centre_height[wheel]
    if name in vehicle.given and height < -ROUNDING:
        place = f"below a c.g. at {vehicle.cg_height:g} m puts the roll centre {-height:.3g} m"
        remedy = f"use {axle}_roll_centre_height to specify its height above the road"
        yield f"{name}: {depth:g} m {place} below the road: {remedy}"
    elif depth < -ROUNDING:
        stated = next(each for each in vehicle.given if each.startswith(f"{axle}_roll_centre"))
        figure = f"puts the roll centre {-depth:.3g} m above the sprung c.g."
        yield f"{stated}: {getattr(vehicle, stated):g} m {figure}: typically it is below"


def _lowness(vehicle: Vehicle) -> Iterator[str]:
    heights = vehicle.per_wheel("tire_radius") - vehicle.static_tire_compression
    wheel_centre = float(heights.min())
    if vehicle.cg_height < LOWEST_CENTRE * wheel_centre:
        figure = f"{vehicle.cg_height:g} m with wheel centres at {wheel_centre:.3g} m"
        yield f"cg_height: {figure}: typically at least {LOWEST_CENTRE:g} times their height"


def _pressures(vehicle: Vehicle) -> Iterator[str]:
    """Inflation pressures that are given, outside the range of their tire file."""
    told = set()
    for axle, tire in vehicle.axle_tires.items():
        pressure = vehicle.at_axle(axle, "tire_pressure")
        least, most = tire.coefficients["PRESMIN"], tire.coefficients["PRESMAX"]
        if pressure is None or least <= pressure <= most:
            continue
        name = f"{axle}_tire_pressure"
        name = name if name in vehicle.given else "tire_pressure"
        figure = f"{pressure:g} Pa is outside the range of the tire file (PRESMIN, PRESMAX)"
        usual = f"at least {least:g}" if math.isinf(most) else f"{least:g} to {most:g}"
        line = f"{name}: {figure}: typically {usual} Pa"
        if line not in told:
            told.add(line)
            yield line
