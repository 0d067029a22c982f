"""Memory of the terms of tires and of model 2 between their computation and their use."""

from vehicle_roll_sim.model.layout import WHEEL_COUNT, per_wheel, record_dtype, vectors

TRAVEL_CURVE_COUNT = 5
HALF_TRACK, AHEAD, CAMBER, TOE, CARRIER_PITCH = range(
    0, TRAVEL_CURVE_COUNT * WHEEL_COUNT, WHEEL_COUNT
)
"""First places of the curves, each of all wheels.

What changes with the travel of a left wheel: place of its contact point (m, outwards), place of its
centre (m, forward), and angles of its carrier about x, z and y of frame 1 (rad)."""
KNOTS, COEFFICIENTS = 63, 6
"""Most knots of the curves of an axle; coefficients of a polynomial of fifth degree."""

CURVES = (
    *("longitudinal", "lateral", "longitudinal_weight", "lateral_weight"),
    *("longitudinal_at_shift", "lateral_at_shift"),
    *("upright_lateral", "trail"),
)
"""The curves of a tire: forces at pure slip and their weighting functions; the weighting functions
at their shifts, which are 0 for many tires; and those of the aligning moment."""
CURVE_COUNT, FORCE_CURVES, MAIN_CURVES = len(CURVES), 6, 4
LONGITUDINAL, LATERAL, LONGITUDINAL_WEIGHT, LATERAL_WEIGHT = range(MAIN_CURVES)
LONGITUDINAL_AT_SHIFT, LATERAL_AT_SHIFT = range(MAIN_CURVES, FORCE_CURVES)
UPRIGHT_LATERAL, TRAIL = range(FORCE_CURVES, CURVE_COUNT)


def per_curve(*names: str) -> tuple:
    """Fields with one value per curve and wheel; the wheels of a curve are adjacent."""
    return tuple((name, CURVE_COUNT * WHEEL_COUNT) for name in names)


def per_curve_of_travel(*names: str) -> tuple:
    """Fields with one value per curve over travel and wheel; wheels of a curve are adjacent."""
    return tuple((name, TRAVEL_CURVE_COUNT * WHEEL_COUNT) for name in names)


TIRE_TERMS = record_dtype(
    *per_wheel("rolling_depth", "relative_load", "stiffening", "slip_stiffness", "cornering_wave"),
    *per_wheel("upright_stiffness", "load_power"),
    *per_wheel("relaxation_fading", "longitudinal_relaxation", "lateral_relaxation"),
    *per_wheel("longitudinal_release", "lateral_release"),
    *per_wheel("longitudinal_damping", "lateral_damping"),
    *per_wheel("longitudinal_peak", "lateral_peak", "longitudinal_shift", "lateral_shift"),
    *per_wheel("ply_steer", "upright_peak", "upright_shift", "trail_peak", "residual"),
    *per_curve("curve_slip", "curve_stiffness", "curve_shape", "curve_curvature"),
    *per_curve("curve_bend", "curve_angle", "curve_sine"),
)
"""Work space of model/tire; explained where it is written."""

TRACKS, NEIGHBOURS = 2, 4
POINTS_OF_PROFILE = TRACKS * NEIGHBOURS
"""Heights from which a profile takes that of a place: four neighbours of each track."""
ROAD_TERMS = record_dtype(
    *per_wheel("place_x", "place_y", "place_z", "height", "slope_x", "slope_y", "friction"),
    *per_wheel("distance", "aside", "part"),
    ("points", (POINTS_OF_PROFILE, WHEEL_COUNT)),
    *per_wheel("along", "across", "linear", "quadratic", "deflection", "sinkage"),
    *per_wheel("arm_x", "arm_y", "arm_z", "side_x", "side_y", "side_height"),
    *per_wheel("level", "normal_x", "normal_y", "normal_z", "force_x", "force_y", "force_z"),
    *per_wheel("speed_ahead", "speed_left", "speed_up"),
)
"""Work space of model/road.

place: of the wheel centre in the ground frame (m). height, slope_x, slope_y, friction: of the road
below it, slopes along x and y of the ground frame (m/m). distance, aside, part, points: see
`road.profile`. along, across: slope along the axes of frame 2 (m/m). level, normal: cosine of the
first, and the normal of the road in frame 2. linear, quadratic: see `road.surface.softness`.
deflection: of the tire, normal to the road, negative off it (m). sinkage: of the wheel into the
ground (m). arm: from wheel centre to contact point in frame 1 (m). side:
force on the side of the wheel in frame 2 (N), and its height above the contact point (m). force:
the whole force of the road in frame 2 (N). speed: velocity of the contact point in frame 2 (m/s).
"""

PARTS = 27
"""Elements of the lower triangle of the mass matrix of model 2 and of its right-hand side."""
SUSPENSION_TERMS = record_dtype(
    *per_wheel("tire_compression", "travel", "travel_force", "pull"),
    *per_curve_of_travel("part", "value", "slope", "bend"),
    ("coefficients", (COEFFICIENTS, TRAVEL_CURVE_COUNT * WHEEL_COUNT)),
    *((name, 3 * WHEEL_COUNT) for name in ("carrier_angle", "carrier_sine", "carrier_cosine")),
    *per_wheel("leaning", "nodding", "turning_in", "lean", "resisting_mass"),
    *vectors("wheel", "carrier_turn", "spin_axis", "arm", "contact_path"),
    ("path", (2, WHEEL_COUNT)),
    ("path_bend", (2, WHEEL_COUNT)),
    ("of_wheels", (PARTS, WHEEL_COUNT)),
)
"""Work space of model/kinematic, per wheel and in frame 1; also explained where it is written.

tire_compression: that of the state. travel: of the wheel centre, up from rest (m). wheel, arm: from
the c.g. to the wheel centre, from there to the contact point (m). path, contact_path: derivatives
of wheel centre and contact point by the travel (m/m).
"""

COMPLIANCE_TERMS = record_dtype(
    *per_wheel("sine", "cosine", "angle", "gap", "step"),
    *per_wheel("inclination", "inclination_sine", "inclination_cosine"),
    *per_wheel("lean", "lean_gap", "lean_step"),
)
"""Work space of model/compliance.

sine, cosine: of the direction of a wheel without compliance. angle: of compliance steer (rad). gap:
between that of the forces and this one (rad). step: change of the angle (rad). inclination: without
compliance (rad). lean: compliance camber (rad), with gap and step likewise.
"""
