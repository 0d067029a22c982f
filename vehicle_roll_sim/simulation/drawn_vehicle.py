"""Dimensions of a vehicle that RViz, Foxglove and the viewer draw besides its parameters."""

import numpy as np

from vehicle_roll_sim.simulation.options import Options

WHEEL_WIDTH = 0.2
"""m, for display only."""
BODY_CLEARANCE = 0.25
"""Height of the body's underside above the ground (m), for display only."""


def wheel_centres_at_rest(record: np.record, options: Options) -> np.ndarray:
    """Centres of the wheels from the sprung c.g. in frame 1, at rest, shape (4, 3) (m).

    record: a VEHICLE record.
    """
    height = -record.static_strut_length
    if options.is_kinematic:
        height = record.static_wheel_height - record.cg_height
    return np.column_stack((record.x, record.y, height))
