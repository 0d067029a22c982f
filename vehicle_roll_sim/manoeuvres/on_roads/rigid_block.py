"""Critical speeds of a rigid block that slides sideways: the oldest estimates for trips.

The block has the mass and the dimensions of a vehicle: half track T, height h of its c.g. and
radius of gyration k in roll. It turns over its leading edge, r = sqrt(T^2 + h^2) from the c.g.
"""

import math

import numpy as np

from vehicle_roll_sim.model.roll_plane import RollPlane
from vehicle_roll_sim.vehicle.derived_values import GRAVITY
from vehicle_roll_sim.vehicle.parameters import Vehicle

POINTS = 400
"""Of the integral over the angle of the block; twice as many change the speed by 1e-5 of itself."""
HALVINGS = 60
"""Of an interval of angles below pi / 2: down to rounding."""


def block_like(vehicle: Vehicle) -> tuple[float, float, float]:
    """Half track, height of the c.g. and radius of gyration in roll (m) of a whole vehicle."""
    record = vehicle.record()
    car, plane = record[0], RollPlane(record, suspended=False)
    unsprung, below = car["unsprung_mass"], plane.cg_height - car["static_wheel_height"]
    inertia = car["roll_inertia"] + car["sprung_mass"] * (car["cg_height"] - plane.cg_height) ** 2
    inertia += (unsprung * (car["y"] ** 2 + below**2)).sum()
    mass = car["sprung_mass"] + unsprung.sum()
    return plane.track / 2, plane.cg_height, math.sqrt(inertia / mass)


def critical_speed_at_curb(half_track: float, cg_height: float, gyration: float) -> float:
    """The speed (m/s) from which a rigid block rolls over when its lower edge is stopped.

    m v h = J w, a plastic impact, and J w^2 / 2 = m g (r - h), with the distance r of the c.g. from
    the edge and J = m (k^2 + r^2). half_track, cg_height h and radius of gyration k in roll: m.
    """
    reach = math.hypot(half_track, cg_height)
    about_edge = gyration**2 + reach**2
    return math.sqrt(2 * GRAVITY * (reach - cg_height) * about_edge) / cg_height


def least_tripping_speed(half_track: float, cg_height: float) -> float:
    """The speed (m/s) whose energy just lifts the c.g. above the edge: v^2 / 2 = g (r - h).

    half_track, cg_height: m. No rigid block rolls over at a lower speed, however elastic the curb.
    """
    return math.sqrt(2 * GRAVITY * (math.hypot(half_track, cg_height) - cg_height))


def critical_speed_in_furrow(
    half_track: float, cg_height: float, gyration: float, resistance: float
) -> float:
    """The speed (m/s) from which a rigid block rolls over that a constant force slows at its edge.

    resistance: the force over the mass of the block, a (m/s^2); lengths in m. The c.g. is slowed by
    a, however the block turns. Turned by t, with its c.g. y = r cos(b + t) behind the edge and at
    the height z = r sin(b + t), where tan b = h / T, it has the energy about the c.g.

        (k^2 + y^2) t'^2 / 2 = a (T - y) - g (z - h)

    until the edge, at v - a time - z t', stops; after which the block turns about the edge and must
    rise to r: (k^2 + r^2) t'^2 / 2 = g (r - z). inf if a < g T / h, with which it never tips.
    """
    if resistance * cg_height <= GRAVITY * half_track:
        return math.inf
    reach, rest = math.hypot(half_track, cg_height), math.atan2(cg_height, half_track)

    def turning(angle):
        """Square of the rate of the angle, while the edge slides."""
        y, z = reach * np.cos(rest + angle), reach * np.sin(rest + angle)
        energy = resistance * (half_track - y) - GRAVITY * (z - cg_height)
        return 2.0 * energy / (gyration**2 + y**2)

    def surplus(angle: float) -> float:
        """Energy that the block has beyond what it needs, if its edge stops at an angle."""
        z = reach * math.sin(rest + angle)
        kinetic = (gyration**2 + reach**2) * float(turning(angle)) / 2.0
        return kinetic - GRAVITY * (reach - z)

    low, high = 0.0, math.pi / 2 - rest
    for _ in range(HALVINGS):
        middle = (low + high) / 2.0
        low, high = (middle, high) if surplus(middle) < 0.0 else (low, middle)
    # the rate grows with the root of the angle, t = high u^2: the integrand in u is smooth
    u = (np.arange(POINTS) + 0.5) / POINTS
    time = (2.0 * high * u / np.sqrt(turning(high * u**2))).sum() / POINTS
    return resistance * time + reach * math.sin(rest + high) * math.sqrt(float(turning(high)))
