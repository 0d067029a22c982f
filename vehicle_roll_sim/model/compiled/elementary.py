"""Arc tangent, sine, exponential function and others from basic arithmetic.

They are accurate to about the last digit.

Without function calls and branches, a loop over the wheels can be vectorized. The same operations
in plain Python give the same bits.
"""

from vehicle_roll_sim.model.compiled.jit import bits_of, math, of_bits, square_root, term

TAN_PI_8, TAN_3_PI_8 = math.sqrt(2) - 1, math.sqrt(2) + 1
"""Limits of the argument reduction: above the first the arc tangent is computed as
pi / 4 + atan[(x - 1) / (x + 1)], above the second as pi / 2 - atan(1 / x)."""
PI_HALVES_REST = 6.123233995736766e-17
"""pi / 2 minus its floating-point representation."""
REST_OF_ANGLE = PI_HALVES_REST / (math.pi / 2)
"""That, relative; times pi / 2 or pi / 4 it gives its rest exactly, with one operation."""
PI, PI_REST = 3.1415926534682512, 1.2154201013012384e-10
"""pi in two parts; the first has 33 bits, so its product with an integer of 20 bits is exact."""
HALF_TURNS = 1 / math.pi
"""Half turns per radian."""
ROUNDING = 1.5 * 2**52
"""Adding and subtracting this constant rounds to the nearest integer, up to 2^51."""

LN_2, LN_2_REST = 0.6931471803691238, 1.9082149292705877e-10
"""ln 2 in two parts; the first has 33 bits."""
POWERS_OF_2, SIGN = 52, 63
"""Positions of exponent and sign in the bits of a double."""
EXPONENT_BIAS = 1023
SQUARE_ROOT_HALF = 0x3FE6A09E667F3BCD
"""The bits of sqrt(1 / 2)."""
FLOAT_OF_INTEGER = 0x4330000000000000
"""The bits of 2^52; with a smaller integer in the lowest bits, those of their sum."""
LARGEST_EXPONENT = 700.0


@term
def cubic(x, a, b, c, d):
    """a + b x + c x^2 + d x^3, in two independent halves."""
    return (a + b * x) + (x * x) * (c + d * x)


@term
def arctan_of_small(z):
    """atan z - z for |z| up to tan(pi / 8): Chebyshev interpolation, accurate to 7e-18."""
    q = z * z
    q4 = (q * q) * (q * q)
    low = cubic(
        q, -0.3333333333333333, 0.1999999999999552, -0.14285714284666542, 0.11111111015256361
    )
    middle = cubic(
        q, -0.09090904578123903, 0.07692183190826087, -0.06664511447381948, 0.0585814891280221
    )
    high = (-0.0508544973794026 + 0.03923165829558719 * q) + (q * q) * -0.019176887119062257
    return z * q * (low + q4 * (middle + q4 * high))


@term
def arctan(x):
    """atan x (rad), from -pi / 2 to pi / 2."""
    return arctan_of_ratio(x, 1.0)


@term
def arctan_of_ratio(x, base):
    """atan(x / base) (rad) for a base of at least 0, with one division; not both may be 0."""
    size = abs(x)
    steep, middle = size > TAN_3_PI_8 * base, size > TAN_PI_8 * base
    above = -base if steep else (size - base if middle else size)
    below = size if steep else (size + base if middle else base)
    turned = math.pi / 2 if steep else (math.pi / 4 if middle else 0.0)
    z = above / below
    return math.copysign(turned + (arctan_of_small(z) + turned * REST_OF_ANGLE + z), x)


@term
def nearest(x):
    """The nearest integer, as a float, and a float whose lowest bit tells whether it is odd."""
    rounded = x + ROUNDING
    return rounded - ROUNDING, rounded


@term
def sine_within_half_turn(r):
    """sin r for |r| up to pi / 2: r - r^3 / 3! + r^5 / 5! ... + r^21 / 21!."""
    q = r * r
    q4 = (q * q) * (q * q)
    low = cubic(q, -1 / 6, 1 / 120, -1 / 5040, 1 / 362880)
    middle = cubic(q, -1 / 39916800, 1 / 6227020800, -1 / 1307674368000, 1 / 355687428096000)
    high = -1 / 121645100408832000 + q * (1 / 51090942171709440000)
    return r + r * q * (low + q4 * (middle + q4 * high))


@term
def alternating(rounded, value):
    """`value`, with the opposite sign if the lowest bit of `rounded` is 1."""
    return of_bits(bits_of(value) ^ (bits_of(rounded) << SIGN))


@term
def sine(x):
    """sin x (x in rad); beyond some 10^6 rad as accurate as x itself."""
    half_turns, rounded = nearest(x * HALF_TURNS)
    rest = (x - half_turns * PI) - half_turns * PI_REST
    return alternating(rounded, sine_within_half_turn(rest))


@term
def cosine(x):
    """cos x = -sin(x - pi / 2) (x in rad); beyond some 10^6 rad as accurate as x itself."""
    size = abs(x)
    half_turns, rounded = nearest(size * HALF_TURNS - 0.5)
    rest = (size - (half_turns + 0.5) * PI) - (half_turns + 0.5) * PI_REST
    return alternating(rounded, -sine_within_half_turn(rest))


@term
def arctan_of_hypotenuse(x, y):
    """atan sqrt(tan^2 x + y^2) (x in rad), as atan[sqrt(sin^2 x + y^2 cos^2 x) / |cos x|].

    Sine and cosine follow from the sine of half the remainder of x by the nearest multiple of pi.
    """
    half_turns, _ = nearest(x * HALF_TURNS)
    rest = (x - half_turns * PI) - half_turns * PI_REST
    half = sine_within_half_turn(0.5 * rest)
    square = half * half
    across = (1.0 - 2.0 * square) * y
    size = square_root(4.0 * square * (1.0 - square) + across * across)
    return arctan_of_ratio(size, abs(1.0 - 2.0 * square))


@term
def exponential(x):
    """exp x, a series times a power of 2; beyond LARGEST_EXPONENT that of the limit."""
    x = max(-LARGEST_EXPONENT, min(LARGEST_EXPONENT, x))
    power = x * (1.0 / (LN_2 + LN_2_REST)) + ROUNDING
    whole = power - ROUNDING
    r = (x - whole * LN_2) - whole * LN_2_REST
    q = r * r
    low = cubic(r, 1 / 2, 1 / 6, 1 / 24, 1 / 120)
    middle = cubic(r, 1 / 720, 1 / 5040, 1 / 40320, 1 / 362880)
    high = cubic(r, 1 / 3628800, 1 / 39916800, 1 / 479001600, 1 / 6227020800)
    series = 1.0 + (r + q * (low + (q * q) * (middle + (q * q) * high)))
    return of_bits(bits_of(series) + (bits_of(power) << POWERS_OF_2))


@term
def logarithm(x):
    """ln x for x from 1e-300 on: that of a power of 2, plus 2 artanh z for the rest, with
    z = (x - 1) / (x + 1)."""
    bits = bits_of(x)
    power = (bits - SQUARE_ROOT_HALF + (EXPONENT_BIAS << POWERS_OF_2)) >> POWERS_OF_2
    rest = of_bits(bits - ((power - EXPONENT_BIAS) << POWERS_OF_2))
    whole = of_bits(power + FLOAT_OF_INTEGER) - (2.0**52 + EXPONENT_BIAS)
    z = (rest - 1.0) / (rest + 1.0)
    q = z * z
    q4 = (q * q) * (q * q)
    low, middle = cubic(q, 2 / 3, 2 / 5, 2 / 7, 2 / 9), cubic(q, 2 / 11, 2 / 13, 2 / 15, 2 / 17)
    series = z * q * (low + q4 * (middle + q4 * (2 / 19 + q * (2 / 21))))
    return whole * LN_2 + (2.0 * z + (series + whole * LN_2_REST))


@term
def cosine_of_arctan(x):
    """cos(atan x)."""
    return 1.0 / square_root(1.0 + x * x)


@term
def sine_of_twice_arctan(x):
    """sin(2 atan x)."""
    return 2.0 * x / (1.0 + x * x)
