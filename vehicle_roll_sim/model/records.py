"""The data that the equations read and write, as numpy structured dtypes: names and layout.

The order of wheels is lf, rf, lr, rr everywhere. SI units and radians.
"""

import functools

import numpy as np

from vehicle_roll_sim.model.layout import (
    AXLE_COUNT,
    CORNER_COUNT,
    WHEEL_COUNT,
    WHEELS,
    per_wheel,
    place_in,
    record_dtype,
)
from vehicle_roll_sim.model.work_space import (
    COEFFICIENTS,
    COMPLIANCE_TERMS,
    KNOTS,
    ROAD_TERMS,
    SUSPENSION_TERMS,
    TIRE_TERMS,
    TRAVEL_CURVE_COUNT,
)

LF, RF, LR, RR = range(WHEEL_COUNT)
FRONT, REAR = range(AXLE_COUNT)
"""Indices of the axles."""
DEGREES_OF_ACCELERATION = 6
DU, DV, DW, DWX, DWY, DWZ = range(DEGREES_OF_ACCELERATION)
"""Indices of the derivatives of u, v, w and of the body rates among the accelerations."""


MODEL_STATE = record_dtype(
    *("x", "y", "z", "roll", "pitch", "yaw"),
    *("u", "v", "w", "roll_rate", "pitch_rate", "yaw_rate"),
    *per_wheel("suspension_compression", "tire_compression", "unsprung_velocity", "wheel_speed"),
)
"""The 28 states: position of the sprung c.g. (m, ground frame), Euler angles (rad), velocity
(m/s) and rates (rad/s) in the body frame, then per wheel xs, xt (m), wu (m/s) and spin (rad/s)."""

EIGHT_DOF_STATES = (
    *("x", "y", "yaw", "roll"),
    *("u", "v", "yaw_rate", "roll_rate", "wheel_speed"),
)
"""The states of the 8 DOF model, in the order of its equations."""

SLIP_STATES = ("longitudinal_slip", "lateral_slip")
"""The states of transient slip, per wheel: transient values of the slip ratio and of the tangent of
the slip angle (-)."""

STATE = record_dtype(
    *((name, MODEL_STATE[name].shape or ()) for name in MODEL_STATE.names),
    *per_wheel("wheel_angle", *SLIP_STATES),
)
"""The integrated state: the 28 states, then the spin angle of each wheel (rad) and the states of
transient slip."""

MODEL_STATE_SIZE = MODEL_STATE.itemsize // 8
STATE_SIZE = STATE.itemsize // 8


def element_names(fields: tuple[str, ...]) -> tuple[str, ...]:
    """Name of every element of these fields of STATE; values per wheel end in the wheel's name."""
    return tuple(
        f"{name}_{wheel}" if STATE[name].shape else name
        for name in fields
        for wheel in (WHEELS if STATE[name].shape else ("",))
    )


STATE_NAMES = element_names(STATE.names)
"""Name of every element of the state vector."""


_place = functools.partial(place_in, STATE)
X, Y, Z = _place("x"), _place("y"), _place("z")
ROLL, PITCH, YAW = _place("roll"), _place("pitch"), _place("yaw")
U, V, W = _place("u"), _place("v"), _place("w")
ROLL_RATE, PITCH_RATE, YAW_RATE = _place("roll_rate"), _place("pitch_rate"), _place("yaw_rate")
SUSPENSION_COMPRESSION = _place("suspension_compression")
TIRE_COMPRESSION = _place("tire_compression")
UNSPRUNG_VELOCITY = _place("unsprung_velocity")
WHEEL_SPEED = _place("wheel_speed")
WHEEL_ANGLE = _place("wheel_angle")
LONGITUDINAL_SLIP, LATERAL_SLIP = _place("longitudinal_slip"), _place("lateral_slip")

COMMAND = record_dtype(
    *("steering", "rear_steering"),
    *per_wheel("wheel_torque", "brake_torque", "normal_force"),
    *("speed_hold_gain", "speed_hold_target"),
    ("wind", 2),
    *per_wheel("road_height", "road_friction_change"),
)
"""The commands: road-wheel angles (rad), drive torque at each wheel (N m), brake torque capacity at
each wheel (N m), active force at each corner (N), and a speed hold, a torque gain * (target - u)
added at each rear wheel (N m per m/s, m/s). wind: velocity of the air along x and y of the ground
frame (m/s). road_height, road_friction_change: on a road that takes them, height of the road under
each wheel (m), and the change of its factor of friction, added to those of its features."""

STOPS = ("bump_stop", "rebound_stop")
DETAIL_CURVES = ("spring", "damper", "toe_change", "spring_travel", "damper_travel")
DETAILS = record_dtype(
    *("struts", "steering", "compliance", "camber_yields"),
    *per_wheel(*(f"{stop}_{of}" for stop in STOPS for of in ("clearance", "stiffness"))),
    *per_wheel(*(f"{stop}_progression" for stop in STOPS)),
    *per_wheel("toe", "roll_steer", "lateral_force_steer", "aligning_moment_steer", "ackermann"),
    *per_wheel("lateral_force_camber"),
    *per_wheel("spring_compression_at_rest"),
    *((f"{curve}_knots", (AXLE_COUNT, KNOTS)) for curve in DETAIL_CURVES),
    *((f"{curve}_origins", (AXLE_COUNT, KNOTS + 1)) for curve in DETAIL_CURVES),
    *((curve, (AXLE_COUNT, KNOTS + 1, COEFFICIENTS)) for curve in DETAIL_CURVES),
)
"""What a vehicle may have beyond linear springs and dampers and parallel steering.

struts, steering, compliance, camber_yields: 1 if the terms of the forces of the struts, of the
steering angles, of compliance and of compliance camber are computed, else 0. toe: to the left
(rad). ackermann: share of Ackermann geometry, times y over the wheelbase. spring, damper: force (N)
over compression (m) and its rate (m/s), toe_change: angle of a left wheel (rad) over travel (m),
spring_travel, damper_travel: compression of spring and damper since rest (m) over travel (m), at
one wheel of each axle, as polynomials between knots like the curves over wheel travel.
"""

BODY = record_dtype(
    *("ahead", "behind", "left", "right", "top", "bottom"),
    *("stiffness", "damping", "friction"),
)
"""The body as a box that touches the ground: distances of its faces from the c.g. (m), and the
stiffness (N/m), damping (N s/m) and coefficient of friction (-) of each of its corners."""

VEHICLE = record_dtype(
    *("sprung_mass", "roll_inertia", "pitch_inertia", "yaw_inertia", "cg_height"),
    *("wheel_inertia", "gravity", "gravity_along", "gravity_across"),
    "minimum_relaxation_length",
    *("rolling_resistance_coefficient", "drag_area"),
    *("air_density", "side_and_lift", "side_force_area", "front_lift_area", "rear_lift_area"),
    *("pressure_centre_ahead", "pressure_centre_height"),
    *per_wheel("x", "y", "roll_centre_depth", "unsprung_mass", "axle_load_share"),
    *per_wheel("spring_stiffness", "damping", "tire_stiffness"),
    *per_wheel("tire_progression", "tire_stiffness_at_rest"),
    *per_wheel("static_strut_length", "static_suspension_compression"),
    *per_wheel("static_tire_compression", "tire_radius", "tire_lateral_compliance"),
    *per_wheel("camber", "camber_sine", "camber_cosine"),
    *per_wheel("bar_rate", "static_loaded_radius", "static_wheel_height"),
    ("travel_knots", (2, KNOTS)),
    ("travel_origins", (2, KNOTS + 1)),
    ("travel_curves", (2, KNOTS + 1, COEFFICIENTS, TRAVEL_CURVE_COUNT)),
    *per_wheel("engine_drag"),
    *per_wheel("differential_damping", "differential_preload", "differential_locking"),
    *("roll_pitch_product", "roll_yaw_product", "pitch_yaw_product"),
    ("details", DETAILS),
    ("body", BODY),
)
"""The vehicle as input to the equations: front and rear values are laid out per wheel.

tire_stiffness: at zero compression (N/m); see `tire.spring`. side_and_lift: 1 if aerodynamic side
force and lift are computed, else 0.
travel_knots, travel_origins, travel_curves: of each axle the ends of the intervals of travel (m,
inf for those that are not used), and for each interval the travel from which the polynomials of its
curves are counted (m), and their coefficients, lowest power first.
"""

OPTION_NAMES = (
    "euler_terms",
    "no_roll_centre",
    "tire_normal_to_ground",
    "asymmetric_link_load_transfer",
    "small_angles",
    "no_link_inertia",
    "no_unsprung_turning",
    "lumped_unsprung_mass",
    "contact_forces_not_rotated",
    "unsprung_forces_not_rotated",
    "rates_not_rotated",
    "contact_moves_with_corner",
    "fixed_strut_length",
    "unsprung_moves_with_corner",
    "eight_dof",
    "rigid_tires",
    "steady_state_slip",
    "contact_moments",
    "kinematic",
    "wheel_gyroscopics",
    "body_contact",
)
OPTIONS = record_dtype(*((name, np.bool_) for name in OPTION_NAMES))
"""Forms of terms in the equations; all off is model 1. Each is explained where it is used."""

OUTPUTS = record_dtype(
    *per_wheel("normal_force", "longitudinal_force", "lateral_force", "support"),
    *per_wheel("slip_ratio", "slip_angle", "steering", "suspension_rate"),
    *per_wheel("longitudinal_slip_rate", "lateral_slip_rate", "turning"),
    *per_wheel("strut_length", "loaded_radius", "unsprung_u", "unsprung_v"),
    *per_wheel("corner_u", "corner_v", "tire_tilt", "rolling_force"),
    *per_wheel("contact_u", "contact_v", "tire_longitudinal", "tire_lateral"),
    *per_wheel("overturning_moment", "rolling_resistance_moment", "aligning_moment"),
    *per_wheel("camber", "camber_sine", "camber_cosine"),
    *per_wheel("inclination", "inclination_sine", "inclination_cosine"),
    *per_wheel("rolling_radius", "unloaded_radius"),
    *per_wheel("contact_moment_x", "contact_moment_y", "contact_moment_z", "spin_moment"),
    *per_wheel("steering_sine", "steering_cosine", "rolling", "sliding", "tread", "side"),
    *per_wheel("patch_slip_ratio", "patch_slip_tangent", "slip_tangent"),
    ("tire_terms", TIRE_TERMS),
    *per_wheel("contact_x", "contact_y", "strut_force", "link_load_transfer"),
    *per_wheel("applied_x", "applied_y", "link_x", "link_y"),
    *per_wheel("contact_z"),
    ("roll_centre_height", 2),
    ("roll_centre_place", 2),
    ("suspension_terms", SUSPENSION_TERMS),
    ("compliance_terms", COMPLIANCE_TERMS),
    ("commanded_steering", AXLE_COUNT),
    ("air_velocity", 2),
    *per_wheel("road_height", "road_friction"),
    ("road_terms", ROAD_TERMS),
    ("body_load", CORNER_COUNT),
    ("acceleration", 3),
    ("specific_force", 3),
    ("slope_gravity", 3),
    ("body_acceleration", DEGREES_OF_ACCELERATION),
    ("mass_matrix", (DEGREES_OF_ACCELERATION, DEGREES_OF_ACCELERATION)),
)
"""Everything that is computed between a state and its derivative.

Fields per wheel come first, at distances of a multiple of four numbers, on which vectorized loops
over the wheels depend.

normal_force, longitudinal_force, lateral_force: contact forces in frame 2 (N). support: normal load
before clipping at 0 (N), negative off the ground. acceleration: of the sprung c.g. along the axes
of frame 2 (m/s^2). specific_force: reading of an accelerometer at the c.g., in frame 1 (m/s^2).
commanded_steering: front and rear (rad). air_velocity: of the sprung c.g. through the air, along x
and y of frame 1 (m/s).
body_acceleration: derivatives of u, v, w and the body rates. The others are terms of the equations,
described where they are computed. road_height: of the road under each wheel above the plane z = 0
(m). road_friction: factor of the friction of its tire. body_load: normal load on each corner of the
body (N), with the option `body_contact`. Outputs that a model does not have are nan.
"""
