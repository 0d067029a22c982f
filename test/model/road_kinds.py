"""One road of every kind, on which a vehicle starts on the level."""

import numpy as np

from vehicle_roll_sim.simulation.road import Road

GRID = {
    "kind": "grid",
    "start": 5.0,
    "spacing": 1.0,
    "side_spacing": 1.0,
    "right": -3.0,
    "heights": np.pad(
        np.random.default_rng(4).uniform(0.0, 0.04, (38, 5)), ((1, 1), (1, 1))
    ).tolist(),
}
FEATURES = {
    "patch": {"kind": "patch", "start": 8.0, "friction": 0.3, "left": 0.0},
    "chessboard": {
        "kind": "chessboard",
        "start": 5.0,
        "left": 4.0,
        "right": -4.0,
        "friction": 1.0,
        "other_friction": 0.4,
        "square_length": 2.0,
        "square_width": 1.0,
    },
    "soft soil": {"kind": "soft_soil", "start": 5.0, "stiffness": 2e5},
    "ramp": {"kind": "ramp", "start": 6.0, "length": 5.0, "height": 0.5, "top": 2.0},
    "corkscrew ramp": {
        "kind": "corkscrew_ramp",
        "start": 6.0,
        "length": 8.0,
        "height": 0.5,
        "width": 1.0,
    },
    "crests": {"kind": "wave", "start": 6.0, "length": 6.0, "height": 0.1, "count": 3},
    "dip": {"kind": "wave", "start": 6.0, "length": 6.0, "height": -0.1},
    "curb": {"kind": "curb", "start": 6.0, "length": 100.0, "offset": 0.8, "height": 0.12},
    "banked curve": {
        "kind": "banked_curve",
        "start": 4.0,
        "radius": 60.0,
        "arc": 30.0,
        "transition": 15.0,
        "bank": 0.2,
    },
    "profile": {
        "kind": "profile",
        "start": 5.0,
        "points": [[0, 0], [3, 0.05, 0.02], [6, 0.0, -0.03], [9, 0, 0]],
    },
    "random profile": {"kind": "random_profile", "start": 4.0, "roughness": "C", "length": 100.0},
    "grid": GRID,
}
"""By what they are called here; all but the patches of friction have a height or a force."""
TILT = {"kind": "tilt_table", "angles": [[0, 0], [0.5, 0], [10, 19]]}


def road(*features: dict, **plane: float) -> Road:
    return Road.from_values({"features": features, **plane})


ROADS = {name: road(feature) for name, feature in FEATURES.items()}
