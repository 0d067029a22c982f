"""The sprung mass as the equations take it, from data of the whole vehicle and from payload.

docs/masses.md has the formulas.
"""

from typing import NamedTuple

import numpy as np

from vehicle_roll_sim.declaration import InputError, parameters_of
from vehicle_roll_sim.model.equilibrium import axle_load_share, static_tire_compression
from vehicle_roll_sim.vehicle.derived_values import AXLES, GRAVITY, SIDES, DerivedValues
from vehicle_roll_sim.vehicle.masses import (
    MOMENTS,
    PRODUCTS,
    Body,
    joined,
    numbers_of,
    point,
    tensor,
)
from vehicle_roll_sim.vehicle.suspension_details import compressions_at_rest

LENGTHS = ("cg_to_front_axle", "cg_to_rear_axle")
SPRUNG = ("sprung_mass", *MOMENTS, *PRODUCTS, *LENGTHS, "cg_height", "cg_offset")
WHOLE = (
    *("total_mass", *(f"total_{name}" for name in MOMENTS), "total_roll_yaw_product"),
    *(f"total_{name}" for name in (*LENGTHS, "cg_height", "cg_offset")),
)
"""Parameters that describe the whole vehicle."""
MASS_SPELLINGS = (
    ("cg_offset", "total_cg_offset"),
    ("roll_yaw_product", "total_roll_yaw_product"),
)
"""Optional parameters of which a vehicle has at most one."""
DEPTHS = tuple(f"{axle}_roll_centre_depth" for axle in AXLES)


class Origin(NamedTuple):
    """Where the sprung mass of a vehicle comes from.

    given: every given value by name. derived: what the equations take instead, by name; None for
    what has no value.
    """

    given: dict
    derived: dict


def as_given(vehicle: DerivedValues) -> dict:
    """The values to start from, by name: those that `vehicle.origin` has in place of derived ones.

    Raises InputError if a derived value was replaced.
    """
    if not vehicle.origin:
        return {}
    given, derived = vehicle.origin
    for name, value in derived.items():
        if getattr(vehicle, name) != value:
            allowed = "unchanged, since it follows from other values; with_values replaces those"
            raise InputError(name, getattr(vehicle, name), allowed)
    return {name: given.get(name) for name in derived} | {"origin": None}


def sprung_values(vehicle: DerivedValues) -> dict:
    """The values of SPRUNG and DEPTHS that the equations take; {} if they are the given ones.

    Raises InputError if there is no such sprung mass.
    """
    given = vehicle.given
    if not vehicle.payload and not given.keys() & {*WHOLE}:
        return {}
    _check_spellings(vehicle)
    body = sprung = _Whole(vehicle).sprung_mass()
    wheelbase = _wheelbase(vehicle)
    if vehicle.payload:
        loaded = joined([sprung, *(load.body for load in vehicle.payload)])
        body = loaded._replace(place=loaded.place - (0.0, 0.0, _sinking(vehicle, sprung, loaded)))
    x, y, z = body.place.tolist()
    values = numbers_of(body.inertia) | {
        "sprung_mass": body.mass,
        "cg_to_front_axle": -x,
        "cg_to_rear_axle": wheelbase + x,
        "cg_height": z,
        "cg_offset": y,
    }
    values |= {n: None for n in (*PRODUCTS, "cg_offset") if values[n] == 0.0 and n not in given}
    kept = {name: given[name] for name in values if name in given and not vehicle.payload}
    if vehicle.payload:
        raised = float(loaded.place[2] - sprung.place[2])
        values |= {name: given[name] + raised for name in DEPTHS if name in given}
    return _checked(vehicle, values | kept)


def _wheelbase(vehicle: DerivedValues) -> float:
    given = vehicle.given
    return sum(given.get(name, given.get(f"total_{name}")) for name in LENGTHS)


def _check_spellings(vehicle: DerivedValues) -> None:
    given = vehicle.given
    front, rear = (f"total_{name}" in given for name in LENGTHS)
    if front != rear:
        name = f"total_{LENGTHS[0 if front else 1]}"
        other = LENGTHS[1 if front else 0]
        problem = f"{given[name]:g} together with {other} {given[other]:g}"
        raise InputError(name, given[name], f"together with total_{other}", problem)
    for name, whole in MASS_SPELLINGS:
        if name in given and whole in given:
            problem = f"{given[whole]:g} together with {name} {given[name]:g}"
            raise InputError(whole, given[whole], "only one of the two may be given", problem)


class _Whole:
    """A vehicle without payload as a rigid body and four point masses."""

    def __init__(self, vehicle: DerivedValues):
        self.vehicle, self.given = vehicle, vehicle.given
        self.unsprung = vehicle.per_wheel("unsprung_mass")
        front, rear = 0.0, -_wheelbase(vehicle)
        self.wheels = np.array([front, front, rear, rear]), vehicle.per_wheel("track") / 2 * SIDES

    def sprung_mass(self) -> Body:
        """What is left of the whole without the unsprung masses.

        They are points, as in the equations: what own inertia they have stays with the body.
        """
        mass, x, y = self._mass(), self._along(0), self._along(1)
        height = self._height(mass, x, y)
        wheels = self._points(mass, x, y)
        parts = joined([point(mass, (x, y, height)), *wheels])
        whole = dict.fromkeys((*MOMENTS, *PRODUCTS), 0.0)
        whole |= {n: self.given[f"total_{n}"] for n in whole if f"total_{n}" in self.given}
        own = numbers_of(tensor(whole) - parts.inertia)
        values = {n: own[n] if f"total_{n}" in self.given else self.given.get(n, 0.0) for n in own}
        for name in MOMENTS:
            if values[name] <= 0.0:
                self._refuse_small(f"total_{name}", whole[name] - own[name])
        return Body(mass, np.array([x, y, height]), tensor(values))

    def _mass(self) -> float:
        if "total_mass" not in self.given:
            return self.given["sprung_mass"]
        total, unsprung = self.given["total_mass"], float(self.unsprung.sum())
        if total <= unsprung:
            allowed = f"more than the unsprung masses together, {unsprung:g} kg"
            raise InputError("total_mass", total, allowed)
        return total - unsprung

    def _along(self, axis: int) -> float:
        """Place of the sprung c.g. along x or y (m)."""
        name, sign = (LENGTHS[0], -1.0) if axis == 0 else ("cg_offset", 1.0)
        if f"total_{name}" not in self.given:
            return sign * self.given.get(name, 0.0)
        return self._left(sign * self.given[f"total_{name}"], self.wheels[axis])

    def _left(self, whole: float, wheels: np.ndarray) -> float:
        """Coordinate of the sprung c.g. from that of the whole and of the wheels (m)."""
        mass, unsprung = self._mass(), float(self.unsprung.sum())
        return float(((mass + unsprung) * whole - self.unsprung @ wheels) / mass)

    def _height(self, mass: float, x: float, y: float) -> float:
        if "total_cg_height" not in self.given:
            return self.given["cg_height"]
        return self._left(self.given["total_cg_height"], self._wheel_heights(mass, x, y))

    def _wheel_heights(self, mass: float, x: float, y: float) -> np.ndarray:
        """Heights of the wheel centres at rest, shape (4,) (m)."""
        length = _wheelbase(self.vehicle)
        along = np.array([length + x, length + x, -x, -x]) / (2 * length)
        share = along * (1.0 + 2 * y / self.vehicle.per_wheel("track") * SIDES)
        spring = (self.vehicle.per_wheel(f"tire_{name}") for name in ("stiffness", "progression"))
        compression = static_tire_compression(mass, share, self.unsprung, *spring, GRAVITY)
        return self.vehicle.per_wheel("tire_radius") - compression

    def _points(self, mass: float, x: float, y: float) -> list[Body]:
        places = np.array([*self.wheels, self._wheel_heights(mass, x, y)]).T
        return [point(part, at) for part, at in zip(self.unsprung.tolist(), places, strict=True)]

    def _refuse_small(self, name: str, least: float) -> None:
        allowed = f"more than {least:g} kg m^2, which sprung and unsprung masses have as points"
        raise InputError(name, self.given[name], allowed)


class _Carrying:
    """A vehicle with another sprung mass (kg) and its c.g. at x (m), in the middle."""

    def __init__(self, vehicle: DerivedValues, mass: float, x: float):
        self._vehicle, self.sprung_mass = vehicle, mass
        self.axle_load_share = axle_load_share(-x, _wheelbase(vehicle) + x)

    def __getattr__(self, name: str):
        return getattr(self._vehicle, name)

    def compressions(self) -> np.ndarray:
        """Of suspension and tire together at rest, of the left wheel of each axle (m)."""
        tires = static_tire_compression(
            self.sprung_mass,
            self.axle_load_share,
            self.per_wheel("unsprung_mass"),
            self.per_wheel("tire_stiffness"),
            self.per_wheel("tire_progression"),
            GRAVITY,
        )
        return (compressions_at_rest(self, GRAVITY) + tires)[[*AXLES.values()]]


def _sinking(vehicle: DerivedValues, empty: Body, loaded: Body) -> float:
    """How far the c.g. of the loaded sprung mass sinks with it on springs and tires (m).

    By the mean load of the two wheels of each axle: the vehicle is level across.
    """
    before, after = (
        _Carrying(vehicle, body.mass, float(body.place[0])).compressions()
        for body in (empty, loaded)
    )
    front, rear = after - before
    share = -float(loaded.place[0]) / _wheelbase(vehicle)
    return float(front * (1.0 - share) + rear * share)


def _checked(vehicle: DerivedValues, values: dict) -> dict:
    """The values, each within the range of its parameter; raises InputError."""
    known = parameters_of(type(vehicle))
    source = "payload" if vehicle.payload else "data of the whole vehicle"
    for name, value in values.items():
        if value is not None:
            known[name].validate(value, f"{name}, from {source}")
    return values
