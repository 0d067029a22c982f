"""Hypothesis strategies for vehicles, options, roads and commands."""

import itertools
import math

import numpy as np
from hypothesis import strategies as st
from programmes import SHIFTS, with_tire

from vehicle_roll_sim import InputError, Options, Tire, Vehicle, preset
from vehicle_roll_sim.declaration import parameters_of
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.model.tire.coefficients import RANGES
from vehicle_roll_sim.simulation.options import ASYMMETRIC, MODELS, SYMMETRIC
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.derived_values import GRAVITY
from vehicle_roll_sim.vehicle.tire.keys import COEFFICIENTS

REFERENCE = preset()
LARGEST_FACTOR = 1.6
"""Largest ratio between a parameter of an ordinary vehicle and the reference, or its inverse."""
DEPTHS = ("front_roll_centre_depth", "rear_roll_centre_depth")
LONGEST = 50.0
"""Range of lengths (m)."""
OPEN_END, ROUNDING = 1e-3, 1e-12
"""Relative distance from a limit on a combination of parameters."""
FLAGS = ("no_roll_centre", "tire_normal_to_ground", "steady_state_slip", "euler_terms")


def every_option() -> list[Options]:
    """All combinations of model and options that are not refused."""
    found = []
    flags = itertools.product((False, True), repeat=len(FLAGS))
    for model, links, values in itertools.product(MODELS, (SYMMETRIC, ASYMMETRIC), flags):
        try:
            found.append(
                Options(model, link_load_transfer=links, **dict(zip(FLAGS, values, strict=True)))
            )
        except InputError:
            continue
    return found


OPTIONS = st.sampled_from(every_option())
WITH_ONE_SOLUTION = OPTIONS.filter(lambda o: not (o.has_eight_dof and o.steady_state_slip))
"""But for the 8 DOF model without lag: its loads and accelerations can agree in several ways, and
rounding decides which of them is found."""
ROADS = st.builds(Road, grade=st.floats(-0.2, 0.2), bank=st.floats(-0.2, 0.2))
NUMBERS = st.integers(0, 2**32 - 1).map(np.random.default_rng)
"""A random number generator: a state or command is one draw, which is not shrunk."""


@st.composite
def ordinary_vehicles(draw, sides=("", "left", "right")) -> Vehicle:
    """Roads could have it: every parameter within a factor of the reference vehicle's.

    sides: of a tire with shifts, "" for the reference tire, which has none.
    """
    values = {}
    for name, value in REFERENCE.given.items():
        factor = draw(st.floats(1 / LARGEST_FACTOR, LARGEST_FACTOR))
        values[name] = value * factor
    values["rolling_resistance_coefficient"] = draw(st.floats(0.0, 0.05))
    values["drag_area"] = draw(st.floats(0.0, 2.0))
    for name in ("front_camber", "rear_camber"):
        values[name] = draw(st.floats(-0.1, 0.1))
    return _on_a_tire(_possible(values), draw(st.sampled_from(sides)))


@st.composite
def allowed_vehicles(draw) -> Vehicle:
    """Vehicles with parameters anywhere in their ranges, which span decades."""
    values = {}
    for name in REFERENCE.given:
        about = parameters_of(Vehicle)[name]
        least, most = about.minimum, about.maximum
        if name in DEPTHS or least == 0.0 or name.endswith("camber"):
            values[name] = draw(st.one_of(st.just(max(0.0, least)), st.floats(least, most)))
        else:
            power = st.floats(math.log10(least), math.log10(most))
            values[name] = min(max(10.0 ** draw(power), least), most)
    return _on_a_tire(_possible(values), draw(st.sampled_from(("", "left", "right"))))


def _possible(values: dict) -> Vehicle:
    """A vehicle with these values, except for those that contradict others."""
    about = parameters_of(Vehicle)
    roll, pitch = values["roll_inertia"], values["pitch_inertia"]
    least = max(abs(roll - pitch) * (1 + ROUNDING), about["yaw_inertia"].minimum)
    most = min((roll + pitch) * (1 - ROUNDING), about["yaw_inertia"].maximum)
    values["yaw_inertia"] = min(max(values["yaw_inertia"], least), most)
    softest = GRAVITY * values["sprung_mass"] / 2 / LONGEST  # a limit is twice that compression
    for name in ("front_spring_stiffness", "rear_spring_stiffness"):
        values[name] = max(values[name], softest)
    heaviest = max(values["front_unsprung_mass"], values["rear_unsprung_mass"])
    load = GRAVITY * (values["sprung_mass"] / 2 + heaviest) * (1 + OPEN_END)  # at most
    stiffness = ("front_tire_stiffness", "rear_tire_stiffness")
    for name in stiffness:
        values[name] = max(values[name], load / LONGEST)
    compression = load / min(values[name] for name in stiffness)
    values["tire_radius"] = min(max(values["tire_radius"], compression), LONGEST)
    lowest = min(values["tire_radius"] * (1 + OPEN_END), LONGEST)
    values["cg_height"] = max(values["cg_height"], lowest)
    return REFERENCE.with_values(values)


def _on_a_tire(vehicle: Vehicle, side: str) -> Vehicle:
    return with_tire(vehicle, side, **SHIFTS) if side else vehicle


@st.composite
def tires(draw) -> Tire:
    """Tires with all coefficients of the version within 20 % of the reference tire, shifts on."""
    rng, given = draw(NUMBERS), REFERENCE.tire.coefficients
    own = COEFFICIENTS[REFERENCE.tire.version]
    nearby = {name: given[name] * rng.uniform(0.8, 1.2) for name in given if name in own}
    ranges = {name: given[name] for name in RANGES}
    return REFERENCE.tire.with_coefficients(**nearby | SHIFTS | ranges)


@st.composite
def held_commands(draw, count: int, share: float = 1.0) -> np.ndarray:
    """COMMAND records to be held one after the other; share: of the largest that are usual."""
    rng = draw(NUMBERS)
    commands = np.zeros(count, COMMAND)
    commands["steering"] = rng.uniform(-0.6, 0.6, count) * share
    commands["rear_steering"] = rng.uniform(-0.3, 0.3, count) * share
    commands["wheel_torque"] = rng.uniform(-3000.0, 3000.0, (count, 4)) * share
    commands["brake_torque"] = rng.uniform(-3000.0, 3000.0, (count, 4)).clip(0.0) * share
    commands["normal_force"] = rng.uniform(-5000.0, 5000.0, (count, 4)) * share
    return commands
