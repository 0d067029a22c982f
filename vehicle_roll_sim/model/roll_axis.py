"""The body on its roll axis: common terms of equations 77-87 and the roll-plane models."""

from vehicle_roll_sim.model.compiled.jit import kernel, math
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.model.suspension.links import half_track


@kernel
def over_wheels(weights, values):
    """Sum of the products of two quantities of each wheel."""
    total = 0.0
    for i in range(WHEEL_COUNT):
        total += weights[i] * values[i]
    return total


@kernel
def roll_axis_depth(vehicle):
    """hrc: depth of the roll axis below the sprung c.g. (m; eq. 81)."""
    return over_wheels(vehicle.axle_load_share, vehicle.roll_centre_depth)


@kernel
def strut_share(i, vehicle, options):
    """Share of the strut in the travel of corner i relative to the ground; the rest is the tire's.

    kt / (ks + kt): strut and tire in series, in roll, with the stiffness of the tire at rest. 1 for
    rigid tires.
    """
    if options.rigid_tires:
        return 1.0
    tire_stiffness = vehicle.tire_stiffness_at_rest[i]
    return tire_stiffness / (stiffness_in_roll(i, vehicle) + tire_stiffness)


@kernel
def stiffness_in_roll(i, vehicle):
    """Force of spring and anti-roll bar per travel of corner i in roll (N/m): ks + 2 kb.

    The other wheel of the axle then moves the other way.
    """
    return vehicle.spring_stiffness[i] + 2 * vehicle.bar_rate[i]


@kernel
def corner_stiffness(i, vehicle, options):
    """Vertical stiffness between body and ground at corner i in roll (N/m): ks kt / (ks + kt)."""
    return stiffness_in_roll(i, vehicle) * strut_share(i, vehicle, options)


@kernel
def corner_damping(i, vehicle, options):
    """Vertical damping between body and ground at corner i (N s/m): bs (kt / (ks + kt))^2."""
    return vehicle.damping[i] * strut_share(i, vehicle, options) ** 2


@kernel
def roll_stiffness(vehicle, options):
    """Total roll stiffness of both axles (N m/rad): sum of c^2 / 2 times the corner stiffness."""
    stiffness = 0.0
    for i in range(WHEEL_COUNT):
        stiffness += half_track(i, vehicle) ** 2 * corner_stiffness(i, vehicle, options)
    return stiffness


@kernel
def wheel_centre_height(i, vehicle):
    """hu: height of wheel centre i above the ground at rest (m)."""
    return vehicle.tire_radius[i] - vehicle.static_tire_compression[i]


def motion_above_axis(state, depth: float) -> tuple[float, ...]:
    """x, y (m, ground frame) and u, v (m/s, body frame) of the sprung c.g. in the 8 DOF model.

    state: a STATE record with the motion of the roll axis. depth: of the axis below the c.g. (m).
    """
    roll, yaw, aside = float(state["roll"]), float(state["yaw"]), -depth * state["roll"]
    ahead = state["u"] - state["yaw_rate"] * aside
    left = (state["v"] - depth * state["roll_rate"]) * math.cos(roll)
    x, y = state["x"] - aside * math.sin(yaw), state["y"] + aside * math.cos(yaw)
    return float(x), float(y), float(ahead), float(left)
