"""Signals that follow from others: sideslip angle, load transfer, and the lift of each wheel."""

from collections.abc import Sequence

import numpy as np

from vehicle_roll_sim.model.records import OUTPUTS
from vehicle_roll_sim.runs.columns import WHEEL_LIFTS
from vehicle_roll_sim.runs.metrics import (
    load_transfer,
    load_transfer_ratio,
    sideslip_angle,
    wheel_lift,
)
from vehicle_roll_sim.simulation.simulation import Simulation

SIGNALS = {
    "sideslip_angle": "rad",
    "load_transfer_ratio": "",
    "front_load_transfer": "N",
    "rear_load_transfer": "N",
    **dict.fromkeys(WHEEL_LIFTS, "m"),
}
"""Unit of each signal that follows from the columns of a history and, on a road with features, from
the road; '' for a ratio. Load transfers are from left to right. wheel_lift: distance of the tire
from the road, 0 in contact. The angle is that of the point that the states describe."""


def _places_of_lifts() -> np.ndarray:
    """Where the outputs are from which the lift of wheels on a road with features follows."""
    places = np.arange(OUTPUTS.itemsize // 8).astype(np.float64).view(OUTPUTS)[0]
    terms = places["road_terms"]
    found = (terms["place_z"], places["road_height"], terms["normal_z"])
    return np.concatenate((*found, places["inclination_cosine"])).astype(int)


LIFT_PLACES = _places_of_lifts()


def wheel_lifts_of(simulation: Simulation) -> np.ndarray:
    """Distance of each tire from the road at the present simulated time (m), see SIGNALS."""
    if simulation.road.features:
        return lifts_on_road(simulation.output_vector[LIFT_PLACES], simulation)
    return wheel_lift(simulation.state["tire_compression"])


def lifts_on_road(outputs: np.ndarray, simulation: Simulation) -> np.ndarray:
    """Distance of each tire from a road with features (m), from the outputs at LIFT_PLACES.

    outputs: (..., 16). Normal to the plane under the wheel. With model 2 that of the lowest point
    of the inclined wheel, else that of the wheel centre less the unloaded radius, as on a plane.
    """
    centre, road, upright, cosine = np.split(outputs, 4, axis=-1)
    radius = simulation.vehicle.per_wheel("tire_radius")
    reach = radius * cosine if simulation.options.is_kinematic else radius
    return wheel_lift(reach - (centre - road) * upright)


def signals_of(
    velocity: Sequence[np.ndarray],
    roll: np.ndarray,
    pitch: np.ndarray,
    loads: np.ndarray,
    lifts: np.ndarray,
) -> np.ndarray:
    """The values of SIGNALS, shape (..., len(SIGNALS)).

    velocity: u, v and w (m/s). roll, pitch: rad. loads, lifts: of the tires (N, m), (..., 4).
    """
    angle, ratio = sideslip_angle(velocity, roll, pitch), load_transfer_ratio(loads)
    pair = np.stack((angle, ratio), axis=-1)
    return np.concatenate((pair, load_transfer(loads), lifts), axis=-1)
