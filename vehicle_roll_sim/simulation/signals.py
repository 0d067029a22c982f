"""Unit, frame and meaning of every field of the state and the outputs."""

from typing import NamedTuple

from vehicle_roll_sim.model.records import OUTPUTS, STATE, WHEELS

GROUND, BODY, ROAD, WHEEL = "ground", "1", "2", "wheel"
"""Frames (docs/model.md): ground-fixed; 1, body-fixed; 2, rotated by the yaw angle only; and that
of a steered wheel (along, across and normal to it)."""


class Signal(NamedTuple):
    """unit: SI or rad; '' for a ratio or a flag. frame: '' if it has none."""

    unit: str
    frame: str
    meaning: str


STATE_SIGNALS = {
    "x": Signal("m", GROUND, "position of the sprung c.g. in the initial heading"),
    "y": Signal("m", GROUND, "position of the sprung c.g. to the left of the initial heading"),
    "z": Signal("m", GROUND, "height of the sprung c.g. above the road"),
    "roll": Signal("rad", GROUND, "Euler angle, positive with the left side up"),
    "pitch": Signal("rad", GROUND, "Euler angle, positive with the nose down"),
    "yaw": Signal("rad", GROUND, "Euler angle, positive to the left"),
    "u": Signal("m/s", BODY, "velocity of the sprung c.g., forward"),
    "v": Signal("m/s", BODY, "velocity of the sprung c.g., to the left"),
    "w": Signal("m/s", BODY, "velocity of the sprung c.g., up"),
    "roll_rate": Signal("rad/s", BODY, "angular velocity about the x axis"),
    "pitch_rate": Signal("rad/s", BODY, "angular velocity about the y axis"),
    "yaw_rate": Signal("rad/s", BODY, "angular velocity about the z axis"),
    "suspension_compression": Signal("m", BODY, "compression of the spring from its free length"),
    "tire_compression": Signal("m", ROAD, "compression of the tire from its unloaded radius"),
    "unsprung_velocity": Signal("m/s", BODY, "velocity of the wheel centre, up"),
    "wheel_speed": Signal("rad/s", WHEEL, "spin velocity, positive when rolling forward"),
    "wheel_angle": Signal("rad", WHEEL, "spin angle since the reset"),
    "longitudinal_slip": Signal("", WHEEL, "state of transient slip, for the slip ratio"),
    "lateral_slip": Signal("", WHEEL, "state of transient slip, for the tangent of the slip angle"),
}
"""Every field of a STATE record."""

OUTPUT_SIGNALS = {
    "normal_force": Signal("N", ROAD, "normal load of the tire, 0 off the ground"),
    "longitudinal_force": Signal("N", ROAD, "contact force, forward"),
    "lateral_force": Signal("N", ROAD, "contact force, to the left"),
    "support": Signal("N", ROAD, "normal load before clipping at 0: negative off the ground"),
    "slip_ratio": Signal("", WHEEL, "slip ratio from which the tire force is computed"),
    "slip_angle": Signal("rad", WHEEL, "slip angle from which the tire force is computed"),
    "steering": Signal("rad", BODY, "road-wheel angle, positive to the left"),
    "suspension_rate": Signal("m/s", BODY, "rate of the suspension compression"),
    "longitudinal_slip_rate": Signal("1/s", WHEEL, "rate of the state longitudinal_slip"),
    "lateral_slip_rate": Signal("1/s", WHEEL, "rate of the state lateral_slip"),
    "turning": Signal("", WHEEL, "direction of the spin: 1, -1, or 0 for a stationary wheel"),
    "strut_length": Signal("m", BODY, "distance from the c.g. plane down to the wheel centre"),
    "loaded_radius": Signal("m", WHEEL, "distance from the wheel centre to the contact point"),
    "unsprung_u": Signal("m/s", BODY, "velocity of the wheel centre, forward"),
    "unsprung_v": Signal("m/s", BODY, "velocity of the wheel centre, to the left"),
    "corner_u": Signal("m/s", BODY, "velocity of the strut top, forward"),
    "corner_v": Signal("m/s", BODY, "velocity of the strut top, to the left"),
    "tire_tilt": Signal("rad", ROAD, "inclination of a tire that is kept normal to the ground"),
    "rolling_force": Signal("N", BODY, "lateral contact force that acts on the roll motion"),
    "contact_u": Signal("m/s", ROAD, "velocity of the contact point, forward"),
    "contact_v": Signal("m/s", ROAD, "velocity of the contact point, to the left"),
    "tire_longitudinal": Signal("N", WHEEL, "tire force along the wheel"),
    "tire_lateral": Signal("N", WHEEL, "tire force across the wheel, to the left"),
    "overturning_moment": Signal("N m", WHEEL, "tire moment about the x axis, 0 if not computed"),
    "rolling_resistance_moment": Signal("N m", WHEEL, "tire moment about the y axis; the same"),
    "aligning_moment": Signal("N m", WHEEL, "tire moment about the z axis; the same"),
    "camber": Signal("rad", BODY, "static camber as inclination, top to the right"),
    "camber_sine": Signal("", "", "sine of the static camber"),
    "camber_cosine": Signal("", "", "cosine of the static camber"),
    "inclination": Signal(
        "rad", WHEEL, "camber to the road, top to the right; 0 if without effect"
    ),
    "inclination_sine": Signal("", "", "sine of the inclination"),
    "inclination_cosine": Signal("", "", "cosine of the inclination"),
    "rolling_radius": Signal("m", WHEEL, "speed of free rolling over the spin"),
    "unloaded_radius": Signal("m", WHEEL, "radius of the tire without load"),
    "contact_moment_x": Signal("N m", BODY, "moment at the contact point about the x axis"),
    "contact_moment_y": Signal("N m", BODY, "moment at the contact point about the y axis"),
    "contact_moment_z": Signal("N m", BODY, "moment at the contact point about the z axis"),
    "spin_moment": Signal("N m", WHEEL, "moment at the contact point about the spin axis"),
    "steering_sine": Signal("", "", "sine of the road-wheel angle"),
    "steering_cosine": Signal("", "", "cosine of the road-wheel angle"),
    "rolling": Signal("m/s", WHEEL, "velocity of the contact point along the wheel"),
    "sliding": Signal("m/s", WHEEL, "velocity of the contact point across the wheel"),
    "tread": Signal("m/s", WHEEL, "spin times rolling radius"),
    "side": Signal("", "", "-1 at wheels where the tire is mirrored, else 1"),
    "patch_slip_ratio": Signal("", WHEEL, "the state longitudinal_slip"),
    "patch_slip_tangent": Signal("", WHEEL, "the state lateral_slip"),
    "slip_tangent": Signal("", WHEEL, "tangent of the slip angle"),
    "tire_terms": Signal("", WHEEL, "terms of the Magic Formula, a record (work space)"),
    "contact_x": Signal("N", BODY, "contact force, forward"),
    "contact_y": Signal("N", BODY, "contact force, to the left"),
    "strut_force": Signal("N", BODY, "sum of spring, damper, stop, bar and active force"),
    "link_load_transfer": Signal("N", BODY, "load transfer through the suspension links"),
    "applied_x": Signal("N", BODY, "force at the strut top for an unaccelerated body, forward"),
    "applied_y": Signal("N", BODY, "force at the strut top for an unaccelerated body, to the left"),
    "link_x": Signal("N", BODY, "force of the suspension links, forward"),
    "link_y": Signal("N", BODY, "force of the suspension links, to the left"),
    "contact_z": Signal("N", BODY, "model 2: contact force, up"),
    "roll_centre_height": Signal("m", ROAD, "model 2: roll centre of each axle above the road"),
    "roll_centre_place": Signal("m", BODY, "model 2: the same, to the left of the c.g."),
    "suspension_terms": Signal("", BODY, "model 2: path and carrier of the wheels (work space)"),
    "compliance_terms": Signal("", WHEEL, "compliance of the wheels (work space)"),
    "commanded_steering": Signal("rad", BODY, "steering commands, front and rear"),
    "air_velocity": Signal(
        "m/s", BODY, "velocity of the sprung c.g. through the air, forward and to the left"
    ),
    "road_height": Signal("m", GROUND, "height of the road under the wheel; nan on a plane"),
    "road_friction": Signal("", WHEEL, "factor of the road on the friction of the tire"),
    "road_terms": Signal("", ROAD, "the road under the wheels (work space)"),
    "body_load": Signal("N", ROAD, "with body_contact: normal load on each corner of the body"),
    "acceleration": Signal("m/s^2", ROAD, "acceleration of the sprung c.g.: forward, left, up"),
    "specific_force": Signal("m/s^2", BODY, "reading of an accelerometer at the sprung c.g."),
    "slope_gravity": Signal("m/s^2", BODY, "component of gravity along the road surface"),
    "body_acceleration": Signal(
        "m/s^2, rad/s^2", BODY, "derivatives of u, v, w and of the three body rates"
    ),
    "mass_matrix": Signal(
        "kg, kg m, kg m^2", BODY, "mass matrix of these six after elimination (work space)"
    ),
}
"""Every field of an OUTPUTS record, in its order; fields of four values are lf, rf, lr, rr."""


def field_of(column: str) -> str:
    """The record field of a column: its name without the wheel at the end."""
    name, _, wheel = column.rpartition("_")
    return name if wheel in WHEELS else column


def as_markdown(record: str) -> str:
    """A Markdown table of the fields of `state` or `outputs`, for the documentation."""
    signals, dtype = {"state": (STATE_SIGNALS, STATE), "outputs": (OUTPUT_SIGNALS, OUTPUTS)}[record]
    rows = [("field", "values", "unit", "frame", "meaning"), ("---",) * 5]
    for name, signal in signals.items():
        size = " × ".join(map(str, dtype[name].shape)) or "1"
        rows.append((f"`{name}`", size, signal.unit or "–", signal.frame or "–", signal.meaning))
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)
