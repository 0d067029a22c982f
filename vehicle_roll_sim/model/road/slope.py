"""Gravity along the plane of the road, on grade or bank, or on a table that tilts.

Not in the paper.
"""

from vehicle_roll_sim.model.compiled.jit import kernel, math
from vehicle_roll_sim.model.frames import ground_to_yawed, yawed_to_body
from vehicle_roll_sim.model.road.layout import TILT_COUNT
from vehicle_roll_sim.model.road.surface import tilt_angle


@kernel
def slope_gravity_on_body_axes(heading, attitude, vehicle, outputs):
    """Gravity along the plane of the road, on grade or bank, in frame 1 (m/s^2)."""
    along, across = ground_to_yawed(heading, vehicle.gravity_along, vehicle.gravity_across)
    slope = yawed_to_body(attitude, along, across, 0.0)
    for axis in range(len(slope)):
        outputs.slope_gravity[axis] = slope[axis]


@kernel
def tilted_gravity_on_body_axes(time, ground, heading, attitude, vehicle, outputs):
    """What tilting the ground by an angle a about its x axis adds to gravity, in frame 1 (m/s^2).

    It is (0, -g sin a, g (1 - cos a)) in the frame of the ground, which turns so slowly that its
    own acceleration is left out.
    """
    if ground[TILT_COUNT] == 0.0:
        return
    angle, g = tilt_angle(time, ground), vehicle.gravity
    along, across = ground_to_yawed(heading, 0.0, -g * math.sin(angle))
    half = math.sin(0.5 * angle)
    tilted = yawed_to_body(attitude, along, across, 2.0 * g * half * half)
    for axis in range(len(tilted)):
        outputs.slope_gravity[axis] += tilted[axis]


@kernel
def slope_gravity_on_yawed_axes(heading, vehicle, outputs):
    """Gravity along the plane of the road, on grade or bank, in frame 2 (m/s^2)."""
    slope = outputs.slope_gravity
    slope[0], slope[1] = ground_to_yawed(heading, vehicle.gravity_along, vehicle.gravity_across)
