"""Sensors: what a perfect one would read, and the errors of a real one.

Random numbers come from outside, as uniform ones.
"""

from vehicle_roll_sim.model.actuators import in_steps_of
from vehicle_roll_sim.model.compiled.elementary import cosine, logarithm, sine
from vehicle_roll_sim.model.compiled.jit import kernel, math, square_root


@kernel
def make_normal(numbers):
    """Turn pairs of uniform numbers (above 0, below 1) into standard normal ones, in place.

    Box and Muller (1958): sqrt(-2 ln a) times cos 2 pi b and sin 2 pi b. numbers: shape (n, 2).
    """
    for i in range(len(numbers)):
        size = square_root(-2.0 * logarithm(numbers[i, 0]))
        angle = 2.0 * math.pi * numbers[i, 1]
        numbers[i, 0], numbers[i, 1] = size * cosine(angle), size * sine(angle)


@kernel
def feel(specific_force, rates, turning, place, axes, felt):
    """Specific force (m/s^2) at a place on the body, then body rates (rad/s), along sensor axes.

    f + a x r + w x (w x r), rigid-body kinematics. specific_force, rates (w), turning (a, rad/s^2),
    place (r, m): vectors in frame 1, the first at the c.g. and the last from it. axes: those of the
    sensor, one a row, in frame 1, shape (3, 3). felt: the six numbers, written.
    """
    x, y, z = place[0], place[1], place[2]
    p, q, r = rates[0], rates[1], rates[2]
    along, square = p * x + q * y + r * z, p * p + q * q + r * r
    fx = specific_force[0] + (turning[1] * z - turning[2] * y) + (p * along - square * x)
    fy = specific_force[1] + (turning[2] * x - turning[0] * z) + (q * along - square * y)
    fz = specific_force[2] + (turning[0] * y - turning[1] * x) + (r * along - square * z)
    for i in range(3):
        felt[i] = axes[i, 0] * fx + axes[i, 1] * fy + axes[i, 2] * fz
        felt[3 + i] = axes[i, 0] * p + axes[i, 1] * q + axes[i, 2] * r


@kernel
def measure(truth, normal, errors, walk, measured):
    """Measure some numbers, and let their biases walk on.

    (1 + scale error) truth + bias + walk + noise, in steps of the resolution. truth, walk,
    measured: shape (n,); the latter two are written. normal: standard normal numbers, shape (n, 2).
    errors: rows of scale, bias, standard deviation of the noise, that of the step of the walk,
    resolution, shape (5, n).
    """
    for i in range(len(truth)):
        value = errors[0, i] * truth[i] + errors[1, i] + walk[i] + errors[2, i] * normal[i, 0]
        measured[i] = in_steps_of(errors[4, i], value)
        walk[i] += errors[3, i] * normal[i, 1]


@kernel
def turned(first, second):
    """The attitude after two turns, the second about axes that the first has turned: quaternions
    (x, y, z, w)."""
    x, y, z, w = first[0], first[1], first[2], first[3]
    a, b, c, d = second[0], second[1], second[2], second[3]
    return (
        w * a + x * d + y * c - z * b,
        w * b - x * c + y * d + z * a,
        w * c + x * b - y * a + z * d,
        w * d - x * a - y * b - z * c,
    )
