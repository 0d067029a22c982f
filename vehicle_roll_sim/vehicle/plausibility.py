"""Values that are allowed but that no usual vehicle has: most often they are in another unit."""

import contextlib
import math
import sys
import warnings
from collections.abc import Iterable, Iterator

from vehicle_roll_sim.vehicle.parameters import AXLES, Vehicle

PACKAGE = __name__.partition(".")[0]
LARGEST_STEERING = math.pi / 3
"""rad: road-wheel angles beyond it belong to no road vehicle."""
RIDE_FREQUENCY = (0.5, 10.0)
"""Hz: from soft cars of old to formula cars that hardly have any travel."""
DAMPING_RATIO = (0.05, 2.0)
"""Of critical damping. Cars have 0.2 to 0.4, race cars up to 1."""
LARGEST_SAG = 0.5
"""m, of a spring at rest."""
LARGEST_FLATTENING = 0.25
"""Compression of a tire at rest over its radius."""
LOWEST_CENTRE = 0.5
"""Height of the sprung c.g. over that of the wheel centres. Formula cars have 0.8 and more."""
RADIUS_OF_GYRATION = {
    "roll_inertia": ("track", 0.1, 1.0),
    "pitch_inertia": ("wheelbase", 0.15, 1.0),
    "yaw_inertia": ("wheelbase", 0.15, 1.0),
}
"""Of the sprung mass, over a length of the vehicle. Cars, buses and models have 0.25 to 0.55; given
in kg cm^2 it seems to be a hundred times as much, in lb ft^2 five times."""
WHEELS_RADIUS_OF_GYRATION = (0.1, 3.0)
"""Over the radius of the tire, for the unsprung mass; geared parts of the drive count too."""
ROUNDING = 1e-9
"""m"""


class PlausibilityWarning(UserWarning):
    """A value is allowed but not plausible; its text is one line with the figure and what is usual.

    `warnings.simplefilter("error", PlausibilityWarning)` makes it an error.
    """


def plausibility(vehicle: Vehicle) -> list[str]:
    """What is not plausible of a vehicle: a line each, which names the parameter."""
    return [
        *_inertias(vehicle),
        *(line for axle, wheel in AXLES.items() for line in _suspension(vehicle, axle, wheel)),
        *(line for axle, wheel in AXLES.items() for line in _roll_centre(vehicle, axle, wheel)),
        *_lowness(vehicle),
    ]


def doubtful_steering(name: str, angle: float) -> str:
    """The line on a road-wheel angle (rad) beyond LARGEST_STEERING that is called `name`."""
    usual = f"usual is at most {LARGEST_STEERING:.4f} rad, and radians are wanted"
    figure = f"{angle:.4g} rad is {math.degrees(angle):.4g} deg"
    return f"{name}: {figure} at the road wheels: {usual}"


def warn(lines: Iterable[str]) -> None:
    """A PlausibilityWarning for each line, at the place where the package was called."""
    for line in lines:
        warnings.warn(line, PlausibilityWarning, stacklevel=_levels_to_the_caller())


@contextlib.contextmanager
def unwarned() -> Iterator[None]:
    """Within, no PlausibilityWarning: for programs that say the same in their own way."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", PlausibilityWarning)
        yield


def _levels_to_the_caller() -> int:
    """How many frames above `warn` the first one is that is not of this package."""
    frame, levels = sys._getframe(2), 2
    while frame is not None and _is_own(frame.f_globals.get("__name__", "")):
        frame, levels = frame.f_back, levels + 1
    return levels


def _is_own(module: str) -> bool:
    return module == PACKAGE or module.startswith(f"{PACKAGE}.")


def _inertias(vehicle: Vehicle) -> Iterator[str]:
    lengths = {
        "track": (vehicle.front_track + vehicle.rear_track) / 2,
        "wheelbase": vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle,
        "radius of the tire": vehicle.tire_radius,
    }
    unsprung = (vehicle.front_unsprung_mass + vehicle.rear_unsprung_mass) / 2
    checks = [(name, vehicle.sprung_mass, *of) for name, of in RADIUS_OF_GYRATION.items()]
    checks.append(("wheel_inertia", unsprung, "radius of the tire", *WHEELS_RADIUS_OF_GYRATION))
    for name, mass, length, least, most in checks:
        inertia = getattr(vehicle, name)
        radius = math.sqrt(inertia / mass)
        share = radius / lengths[length]
        if not least <= share <= most:
            figure = f"a radius of gyration of {radius:.3g} m, {share:.3g} of the {length}"
            yield f"{name}: {inertia:g} kg m^2 is {figure}: usual is {least:g} to {most:g} of it"


def _suspension(vehicle: Vehicle, axle: str, wheel: int) -> Iterator[str]:
    spring, tire, damper = f"{axle}_spring_stiffness", f"{axle}_tire_stiffness", f"{axle}_damping"
    stiffness, tires, damping = (getattr(vehicle, name) for name in (spring, tire, damper))
    mass = float(vehicle.sprung_mass * vehicle.axle_load_share[wheel])
    sag = float(vehicle.static_suspension_compression[wheel])
    if sag > LARGEST_SAG:
        figure = f"{stiffness:g} N/m is compressed by {sag:.3g} m at rest"
        yield f"{spring}: {figure}: usual is at most {LARGEST_SAG:g} m"
    flattening = float(vehicle.static_tire_compression[wheel]) / vehicle.tire_radius
    if flattening > LARGEST_FLATTENING:
        figure = f"{tires:g} N/m is compressed by {flattening:.3g} of the tire's radius at rest"
        yield f"{tire}: {figure}: usual is at most {LARGEST_FLATTENING:g}"
    in_series = stiffness * tires / (stiffness + tires)
    frequency = math.sqrt(in_series / mass) / math.tau
    least, most = RIDE_FREQUENCY
    if not least <= frequency <= most:
        figure = f"with the tires a ride frequency of {frequency:.3g} Hz of the {axle} axle"
        yield f"{spring}: {stiffness:g} N/m is {figure}: usual is {least:g} to {most:g} Hz"
    ratio = damping / (2 * math.sqrt(stiffness * mass))
    least, most = DAMPING_RATIO
    if not least <= ratio <= most:
        figure = f"{damping:g} N s/m is a damping ratio of {ratio:.3g} of the {axle} axle"
        yield f"{damper}: {figure}: usual is {least:g} to {most:g}"


def _roll_centre(vehicle: Vehicle, axle: str, wheel: int) -> Iterator[str]:
    """A height below the road is taken as it is said; the one that a depth comes to need not be."""
    name = f"{axle}_roll_centre_depth"
    depth, height = float(vehicle.roll_centre_depth[wheel]), vehicle.roll_centre_height[wheel]
    if name in vehicle.given and height < -ROUNDING:
        under = f"under a c.g. at {vehicle.cg_height:g} m leaves the roll centre {-height:.3g} m"
        remedy = f"{axle}_roll_centre_height gives it above the road"
        yield f"{name}: {depth:g} m {under} below the road: {remedy}"
    elif depth < -ROUNDING:
        stated = next(each for each in vehicle.given if each.startswith(f"{axle}_roll_centre"))
        figure = f"the roll centre is {-depth:.3g} m above the sprung c.g."
        yield f"{stated}: {getattr(vehicle, stated):g} m: {figure}: usual is below it"


def _lowness(vehicle: Vehicle) -> Iterator[str]:
    wheel_centre = vehicle.tire_radius - float(max(vehicle.static_tire_compression))
    if vehicle.cg_height < LOWEST_CENTRE * wheel_centre:
        figure = f"{vehicle.cg_height:g} m under wheel centres at {wheel_centre:.3g} m"
        yield f"cg_height: {figure}: usual is at least {LOWEST_CENTRE:g} of their height"
