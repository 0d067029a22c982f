"""Arc tangent, sine and cosine of arithmetic alone, to about the last digit.

Without calls and with selections in place of branches, a loop over the wheels becomes one pass in
which the processor works on all four at once. The results are the same bits in plain Python.
"""

from vehicle_roll_sim.model.jit import term, math, square_root

TAN_THREE_EIGHTHS = 2.414213562373095
"""tan(3 pi / 8), from where the arc tangent is that of -1 / x, turned by pi / 2."""
ONE_EIGHTH = 0.66
"""About tan(pi / 8) to 1, from where it is that of (x - 1) / (x + 1), turned by pi / 4."""
BEYOND_PI_HALVES = 6.123233995736766e-17
"""pi / 2 less its double."""

PI_PARTS = (3.1415926534682512, 1.2154201013012384e-10)
HALF_TURNS = 1 / math.pi
ROUNDING = 1.5 * 2**52
"""Added and taken away again, it leaves the nearest whole number of anything below 2^51."""


@term
def cubic(x, a, b, c, d):
    return (a + b * x) + (x * x) * (c + d * x)


@term
def arctan(x):
    """rad: a rational approximation on |x| <= 0.66, after Cephes (Moshier), atan.c."""
    size = abs(x)
    steep, middle = size > TAN_THREE_EIGHTHS, size > ONE_EIGHTH
    above = -1.0 if steep else (size - 1.0 if middle else size)
    below = size if steep else (size + 1.0 if middle else 1.0)
    turned = math.pi / 2 if steep else (math.pi / 4 if middle else 0.0)
    rest = BEYOND_PI_HALVES if steep else (BEYOND_PI_HALVES / 2 if middle else 0.0)
    z = above / below
    q = z * z
    p = cubic(q, -6.485021904942025371773e1, -1.228866684490136173410e2, -7.500855792314704667340e1, -1.615753718733365076637e1)
    p = p + (q * q) * (q * q) * -8.750608600031904122785e-1
    d = cubic(q, 1.945506571482613964425e2, 4.853903996359136964868e2, 4.328810604912902668951e2, 1.650270098316988542046e2)
    d = d + (q * q) * (q * q) * (2.485846490142306297962e1 + q)
    return math.copysign(turned + (z * (q * p / d) + z + rest), x)


@term
def sine_of_half_turn(r):
    """Of |r| <= pi / 2: r - r^3 / 3! + r^5 / 5! ... to r^21."""
    q = r * r
    low = cubic(q, -1 / 6.0, 1 / 120.0, -1 / 5040.0, 1 / 362880.0)
    middle = cubic(q, -1 / 39916800.0, 1 / 6227020800.0, -1 / 1307674368000.0, 1 / 355687428096000.0)
    high = -1 / 121645100408832000.0 + q * (1 / 51090942171709440000.0)
    q4 = (q * q) * (q * q)
    return r + (r * q) * (low + q4 * (middle + q4 * high))


@term
def nearest(x):
    return (x + ROUNDING) - ROUNDING


@term
def reduced(x, half_turns):
    most, rest = PI_PARTS
    return (x - half_turns * most) - half_turns * rest


@term
def alternating(half_turns, value):
    pairs = half_turns / 2
    return value if nearest(pairs) == pairs else -value


@term
def sine(x):
    turns = nearest(x * HALF_TURNS)
    return alternating(turns, sine_of_half_turn(reduced(x, turns)))


@term
def cosine(x):
    size = abs(x)
    turns = nearest(size * HALF_TURNS - 0.5)
    return alternating(turns, -sine_of_half_turn(reduced(size, turns + 0.5)))


@term
def cosine_of_arctan(x):
    """cos(atan x)."""
    return 1.0 / square_root(1.0 + x * x)


@term
def sine_of_twice_arctan(x):
    """sin(2 atan x)."""
    return 2.0 * x / (1.0 + x * x)
