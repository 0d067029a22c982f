"""Gravity along the plane of the road, on grade or bank (not in the paper)."""

from vehicle_roll_sim.model.compiled.jit import kernel
from vehicle_roll_sim.model.frames import ground_to_yawed, yawed_to_body


@kernel
def slope_gravity_on_body_axes(heading, attitude, vehicle, outputs):
    """Gravity along the plane of the road, on grade or bank, in frame 1 (m/s^2)."""
    along, across = ground_to_yawed(heading, vehicle.gravity_along, vehicle.gravity_across)
    slope = yawed_to_body(attitude, along, across, 0.0)
    for axis in range(len(slope)):
        outputs.slope_gravity[axis] = slope[axis]


@kernel
def slope_gravity_on_yawed_axes(heading, vehicle, outputs):
    """Gravity along the plane of the road, on grade or bank, in frame 2 (m/s^2)."""
    slope = outputs.slope_gravity
    slope[0], slope[1] = ground_to_yawed(heading, vehicle.gravity_along, vehicle.gravity_across)
