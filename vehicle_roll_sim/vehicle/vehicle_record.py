"""The vehicle as input to the equations: a VEHICLE record from parameters and properties."""

import numpy as np

from vehicle_roll_sim.model.records import VEHICLE
from vehicle_roll_sim.vehicle.air_parameters import air_of
from vehicle_roll_sim.vehicle.body_parameters import body_of
from vehicle_roll_sim.vehicle.differential_parameters import differentials_of
from vehicle_roll_sim.vehicle.masses import PRODUCTS
from vehicle_roll_sim.vehicle.suspension_details import details_of
from vehicle_roll_sim.vehicle.travel_curves import tabulated

NOWHERE = object()
"""In place of an attribute that there is not."""


def record_of(vehicle, gravity: float) -> np.ndarray:
    """The vehicle on a level road as input to the equations: one VEHICLE record, shape (1,).

    gravity: m/s^2. Each field takes the attribute of its name, or the values front_NAME and
    rear_NAME, or comes from `_placement`. Raises AttributeError for a field that has none of these.
    """
    placement, record = _placement(vehicle, gravity), np.zeros(1, VEHICLE)
    for name in VEHICLE.names:
        if name in placement:
            record[name] = placement[name]
        else:
            value = getattr(vehicle, name, NOWHERE)
            record[name] = vehicle.per_wheel(name) if value is NOWHERE else value
    return record


def _placement(vehicle, gravity: float) -> dict:
    """Where and how the wheels stand, air forces, and gravity (m/s^2).

    x, y: in the plane of the c.g. (m). camber: positive with the top towards the right (rad).
    tire_lateral_compliance: 0, as for a contact patch that does not shift. engine_drag: at the
    driven wheels (N m s/rad).
    """
    front, rear = vehicle.cg_to_front_axle, -vehicle.cg_to_rear_axle
    camber = vehicle.per_wheel("camber") * (-1, 1, -1, 1)
    of_axles = [tabulated([*curves.values()]) for curves in vehicle.travel_curves.values()]
    knots, origins, curves = zip(*of_axles, strict=True)
    return {
        "x": (front, front, rear, rear),
        "y": vehicle.wheel_places,
        **{name: vehicle.inertias[name] for name in PRODUCTS},
        "camber": camber,
        "camber_sine": np.sin(camber),
        "camber_cosine": np.cos(camber),
        "tire_radius": vehicle.per_wheel("tire_radius"),
        "tire_lateral_compliance": 0.0,
        "engine_drag": np.where(vehicle.drive_shares > 0.0, vehicle.engine_drag or 0.0, 0.0),
        **differentials_of(vehicle),
        "travel_knots": knots,
        "travel_origins": origins,
        "travel_curves": curves,
        "details": details_of(vehicle, gravity),
        "body": body_of(vehicle, gravity),
        **air_of(vehicle),
        "gravity": gravity,
        "gravity_along": 0.0,
        "gravity_across": 0.0,
    }
