"""The body on the ground after a rollover: spring-dampers with friction at the corners of a box.

Not in the paper. What becomes of the wheels is in `fallen_wheels`.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, square_root, term
from vehicle_roll_sim.model.contact import normal_force
from vehicle_roll_sim.model.frames import (
    body_to_yawed,
    ground_to_yawed,
    yawed_to_body,
    yawed_to_ground,
)
from vehicle_roll_sim.model.layout import CORNER_COUNT
from vehicle_roll_sim.model.records import DU, DV, DW, DWX, DWY, DWZ, WHEEL_COUNT
from vehicle_roll_sim.model.road.plane import limited
from vehicle_roll_sim.model.road.surface import surface

STICKING_SPEED = 0.1
"""m/s: sliding speed from which on friction is complete; below, it is proportional to the speed."""


@term
def place_of_corner(k, body):
    """Place of corner k of the box from the c.g., in frame 1 (m); in the order of CORNERS."""
    x = body.ahead if k % WHEEL_COUNT < 2 else -body.behind
    y = body.left if k % 2 == 0 else -body.right
    return x, y, body.top if k >= WHEEL_COUNT else -body.bottom


@term
def normal_load(depth, rate, body):
    """Load on a corner (N) at its depth in the ground (m) and the rate of it: it never pulls."""
    return normal_force(body.stiffness * depth + body.damping * rate) if depth > 0.0 else 0.0


@term
def friction_per_speed(load, speed, friction, body):
    """Friction on a corner over its sliding speed (N s/m): Coulomb's, linear at a low speed."""
    return body.friction * friction * load / max(speed, STICKING_SPEED)


@kernel
def ground_under(x, y, z, state, heading, ground):
    """Depth of a point in the ground (m), the normal there in frame 2, and the factor of friction.

    x, y, z: from the c.g. along the axes of frame 2 (m). As for a wheel, the ground is the plane
    through the point of the road vertically below or above.
    """
    height = state[at.Z] + z
    if ground is None:
        return -height, (0.0, 0.0, 1.0), 1.0
    ahead, aside = yawed_to_ground(heading, x, y)
    rise, along, across, friction = surface(state[at.X] + ahead, state[at.Y] + aside, ground)
    along, across = limited(along, across)
    a, b = ground_to_yawed(heading, along, across)
    upright = 1.0 / square_root(1.0 + a * a + b * b)
    return (rise - height) * upright, (-a * upright, -b * upright, upright), friction


@kernel
def force_at_corner(k, state, heading, attitude, vehicle, ground, outputs):
    """Force of the ground on corner k of the body in frame 1 (N); notes its normal load."""
    body = vehicle.body
    x, y, z = place_of_corner(k, body)
    ahead, left, up = body_to_yawed(attitude, x, y, z)
    depth, normal, friction = ground_under(ahead, left, up, state, heading, ground)
    outputs.body_load[k] = 0.0
    if depth <= 0.0:
        return 0.0, 0.0, 0.0
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    u, v = state[at.U] + wy * z - wz * y, state[at.V] + wz * x - wx * z
    w = state[at.W] + wx * y - wy * x
    u, v, w = body_to_yawed(attitude, u, v, w)
    nx, ny, nz = normal
    rise = nx * u + ny * v + nz * w
    load = normal_load(depth, -rise, body)
    outputs.body_load[k] = load
    u, v, w = u - rise * nx, v - rise * ny, w - rise * nz
    drag = friction_per_speed(load, square_root(u * u + v * v + w * w), friction, body)
    return yawed_to_body(attitude, load * nx - drag * u, load * ny - drag * v, load * nz - drag * w)


@kernel
def add_body_contact(state, heading, attitude, vehicle, ground, outputs):
    """Add the forces of the ground on the corners of the body (N) and their moments (N m), frame 1.

    To the right-hand side of the equations of motion, `outputs.body_acceleration`. At each corner
    a spring and a damper in parallel act along the normal of the ground, max(0, k d + c dd/dt) at
    the depth d > 0, and friction mu N against the sliding velocity. ground: None for a plane.
    """
    f = outputs.body_acceleration
    for k in range(CORNER_COUNT):
        x, y, z = place_of_corner(k, vehicle.body)
        fx, fy, fz = force_at_corner(k, state, heading, attitude, vehicle, ground, outputs)
        f[DU] += fx
        f[DV] += fy
        f[DW] += fz
        f[DWX] += y * fz - z * fy
        f[DWY] += z * fx - x * fz
        f[DWZ] += x * fy - y * fx
