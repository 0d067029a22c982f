"""The numbers with which the page draws a vehicle."""

import numpy as np

from vehicle_roll_sim.model.records import LR, WHEEL_COUNT
from vehicle_roll_sim.simulation.drawn_vehicle import (
    WHEEL_WIDTH,
    wheel_centres_at_rest,
)
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.derived_values import AXLES, SIDES
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.travel_parameters import TRAVEL_SIGNS

TRAVELS = np.linspace(-0.25, 0.25, 51)
"""Wheel travels at which the curves of model 2 are tabulated (m); linear in between."""


def scene_of(vehicle: Vehicle, options: Options) -> dict:
    """Body, wheels and axles about the sprung c.g. at rest, in frame 1 (m, rad).

    body: extent ahead, behind, down (`bottom`) and up (`top`), width, and place of the middle to
    the left of the c.g. A wheel has the suspension compression at rest, and the camber (top to the
    right) and toe (to the left) at rest; with model 2 also `guide`, what changes with its travel.
    """
    record = vehicle.record()[0]
    places = wheel_centres_at_rest(record, options)
    box = record.body
    body = {
        "ahead": float(box.ahead),
        "behind": float(box.behind),
        "bottom": float(-box.bottom),
        "top": float(box.top),
        "width": float(box.left + box.right),
        "aside": float(box.left - box.right) / 2,
    }
    wheels = [
        {
            "place": places[i].tolist(),
            "radius": float(record.tire_radius[i]),
            "width": WHEEL_WIDTH,
            "compression": float(record.static_suspension_compression[i]),
            "camber": float(record.camber[i]),
            "toe": float(record.details.toe[i]),
        }
        for i in range(WHEEL_COUNT)
    ]
    if options.is_kinematic:
        for i, wheel in enumerate(wheels):
            wheel["guide"] = _guide(vehicle, i, float(record.static_loaded_radius[i]))
    axles = [{"name": name, "x": float(record.x[wheel])} for name, wheel in AXLES.items()]
    return {"height": vehicle.cg_height, "body": body, "wheels": wheels, "axles": axles}


def _guide(vehicle: Vehicle, wheel: int, radius: float) -> dict:
    """How a wheel of model 2 moves with its travel: tables over TRAVELS, as in `guidance`.

    ahead, left: displacement of its centre (m). toe, camber, pitch: turn of its carrier about the
    z, x and y axes, from those at rest (rad). radius: static loaded radius (m).
    """
    axle, side = list(AXLES)[0 if wheel < LR else 1], SIDES[wheel]
    half_track, ahead, camber, toe, pitch = (
        _table(vehicle.travel_curves[axle][f"{axle}_{name}"]) for name in TRAVEL_SIGNS
    )
    at_rest = vehicle.record()[0].camber[wheel]
    left = side * half_track - radius * np.sin(at_rest + side * camber)
    found = {"ahead": ahead, "left": left, "toe": side * toe, "camber": side * camber}
    found |= {"travel": TRAVELS, "pitch": pitch}
    return {name: values.tolist() for name, values in found.items()}


def _table(curve) -> np.ndarray:
    """A TravelCurve at TRAVELS."""
    return np.array([curve.piece(travel, travel)[0] for travel in TRAVELS.tolist()])
