"""Where the suspension guides a wheel: its path, and how its carrier turns on the way.

Everything is a function of the wheel's travel q, in frame 1. The curves of an axle are polynomials
of fifth degree between common knots, and straight outside (`vehicle.travel_curves`).
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.elementary import sine_within_half_turn
from vehicle_roll_sim.model.compiled.jit import kernel, math, square_root, term
from vehicle_roll_sim.model.records import FRONT, LR, REAR, WHEEL_COUNT
from vehicle_roll_sim.model.work_space import (
    AHEAD,
    CAMBER,
    CARRIER_PITCH,
    COEFFICIENTS,
    HALF_TRACK,
    KNOTS,
    TOE,
    TRAVEL_CURVE_COUNT,
)

LEAN, NOD, TURN = range(0, 3 * WHEEL_COUNT, WHEEL_COUNT)
"""First places of the angles of the carriers about x, y and z, each of all wheels."""
QUARTER_TURN = 0.5 * math.pi


@term
def interval(travel, knots):
    """The number of knots at or below a travel (m); KNOTS + 1 is a power of 2."""
    found, half = 0, (KNOTS + 1) // 2
    while half > 0:
        if travel >= knots[found + half - 1]:
            found += half
        half //= 2
    return found


@kernel
def look_up(state, vehicle, outputs):
    """Value, slope and bend (second derivative) of every curve at the travel of every wheel."""
    terms = outputs.suspension_terms
    compression = state[at.SUSPENSION_COMPRESSION]
    for i in range(WHEEL_COUNT):
        axle = FRONT if i < LR else REAR
        travel = compression[i] - vehicle.static_suspension_compression[i]
        row = interval(travel, vehicle.travel_knots[axle])
        terms.travel[i] = travel
        part = vehicle.travel_curves[axle, row]
        for curve in range(TRAVEL_CURVE_COUNT):
            place = curve * WHEEL_COUNT + i
            terms.part[place] = travel - vehicle.travel_origins[axle, row]
            for power in range(COEFFICIENTS):
                terms.coefficients[power, place] = part[power, curve]
    for k in range(TRAVEL_CURVE_COUNT * WHEEL_COUNT):
        d, p = terms.part[k], terms.coefficients
        a, b, c, e, f, g = p[0, k], p[1, k], p[2, k], p[3, k], p[4, k], p[5, k]
        terms.value[k] = a + d * (b + d * (c + d * (e + d * (f + d * g))))
        terms.slope[k] = b + d * (2 * c + d * (3 * e + d * (4 * f + d * (5 * g))))
        terms.bend[k] = 2 * c + d * (6 * e + d * (12 * f + d * (20 * g)))


@kernel
def carriers(vehicle, outputs):
    """How far the carrier of every wheel is turned, and its turning with the travel, in frame 1.

    It is turned by its pitch about y, then by its camber about x, then by its toe about z; in it
    the wheel is steered about z. The curves are those of a left wheel; a right wheel is its mirror
    image. Where curves are extrapolated, angles may exceed a quarter turn.
    """
    terms = outputs.suspension_terms
    value, slope, angle = terms.value, terms.slope, terms.carrier_angle
    for i in range(WHEEL_COUNT):
        side = 1.0 if i % 2 == 0 else -1.0
        angle[LEAN + i] = vehicle.camber[i] + side * value[CAMBER + i]
        angle[NOD + i] = value[CARRIER_PITCH + i]
        angle[TURN + i] = side * value[TOE + i]
        terms.leaning[i] = side * slope[CAMBER + i]
        terms.nodding[i] = slope[CARRIER_PITCH + i]
        terms.turning_in[i] = side * slope[TOE + i]
    for k in range(3 * WHEEL_COUNT):
        a = angle[k]
        folded = a if abs(a) <= QUARTER_TURN else math.copysign(2.0 * QUARTER_TURN, a) - a
        terms.carrier_sine[k] = sine_within_half_turn(folded)
    for k in range(3 * WHEEL_COUNT):
        square = terms.carrier_sine[k] * terms.carrier_sine[k]
        cosine = square_root(max(1.0 - square, 0.0))
        terms.carrier_cosine[k] = cosine if abs(angle[k]) <= QUARTER_TURN else -cosine
    for i in range(WHEEL_COUNT):
        sa, ca = terms.carrier_sine[LEAN + i], terms.carrier_cosine[LEAN + i]
        sp, cp = terms.carrier_sine[NOD + i], terms.carrier_cosine[NOD + i]
        st, ct = terms.carrier_sine[TURN + i], terms.carrier_cosine[TURN + i]
        leaning, nodding = terms.leaning[i], terms.nodding[i]
        terms.carrier_turn[0, i] = leaning * ct - nodding * st * ca
        terms.carrier_turn[1, i] = leaning * st + nodding * ct * ca
        terms.carrier_turn[2, i] = terms.turning_in[i] + nodding * sa
        s, c = outputs.steering_sine[i], outputs.steering_cosine[i]
        x, y, z = -s * cp, c * ca - s * sp * sa, c * sa + s * sp * ca
        terms.spin_axis[0, i], terms.spin_axis[1, i] = x * ct - y * st, x * st + y * ct
        terms.spin_axis[2, i] = z


@kernel
def paths(vehicle, outputs):
    """Place of every wheel centre in frame 1, and the first two derivatives of its path.

    The half-track is that of the contact point: the wheel centre is where that puts it at the
    static loaded radius.
    """
    terms = outputs.suspension_terms
    value, slope, bend = terms.value, terms.slope, terms.bend
    height = vehicle.cg_height
    for i in range(WHEEL_COUNT):
        side, radius = 1.0 if i % 2 == 0 else -1.0, vehicle.static_loaded_radius[i]
        sa, ca = terms.carrier_sine[LEAN + i], terms.carrier_cosine[LEAN + i]
        leaning, bending = terms.leaning[i], side * bend[CAMBER + i]
        terms.wheel[0, i] = vehicle.x[i] + value[AHEAD + i]
        terms.wheel[1, i] = vehicle.y[i] + side * value[HALF_TRACK + i] - radius * sa
        terms.wheel[2, i] = vehicle.static_wheel_height[i] - height + terms.travel[i]
        terms.path[0, i] = slope[AHEAD + i]
        terms.path[1, i] = side * slope[HALF_TRACK + i] - radius * ca * leaning
        terms.path_bend[0, i] = bend[AHEAD + i]
        inward = radius * (ca * bending - sa * leaning * leaning)
        terms.path_bend[1, i] = side * bend[HALF_TRACK + i] - inward


@kernel
def wheel_velocities(state, outputs):
    """Rate of travel (m/s), and velocity of every wheel centre along x and y of frame 1 (m/s)."""
    terms = outputs.suspension_terms
    u, v, w = state[at.U], state[at.V], state[at.W]
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    wu = state[at.UNSPRUNG_VELOCITY]
    for i in range(WHEEL_COUNT):
        x, y, z = terms.wheel[0, i], terms.wheel[1, i], terms.wheel[2, i]
        rate = wu[i] - (w + wx * y - wy * x)
        outputs.suspension_rate[i] = rate
        outputs.unsprung_u[i] = u + wy * z - wz * y + terms.path[0, i] * rate
        outputs.unsprung_v[i] = v + wz * x - wx * z + terms.path[1, i] * rate
