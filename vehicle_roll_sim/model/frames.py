"""Rotations between the body (frame 1), the yawed ground frame (frame 2) and the ground.

Angles are Rz(yaw) Ry(pitch) Rx(roll), ISO 8855 / REP-103: pitch positive nose down, roll positive
left side up. Variables named s_ and c_ are a sine and a cosine.
"""

from vehicle_roll_sim.model.compiled.jit import kernel, math


@kernel
def attitude_of(roll, pitch):
    """Sine and cosine of roll, then of pitch."""
    return math.sin(roll), math.cos(roll), math.sin(pitch), math.cos(pitch)


@kernel
def heading_of(yaw):
    """Sine and cosine of yaw."""
    return math.sin(yaw), math.cos(yaw)


@kernel
def body_to_yawed(attitude, x, y, z):
    """Transform a vector from frame 1 to frame 2: Ry(pitch) Rx(roll)."""
    s_roll, c_roll, s_pitch, c_pitch = attitude
    y_pitched = c_roll * y - s_roll * z
    z_pitched = s_roll * y + c_roll * z
    return c_pitch * x + s_pitch * z_pitched, y_pitched, -s_pitch * x + c_pitch * z_pitched


@kernel
def yawed_to_body(attitude, x, y, z):
    """Transform a vector from frame 2 to frame 1 (eq. 2)."""
    s_roll, c_roll, s_pitch, c_pitch = attitude
    z_pitched = s_pitch * x + c_pitch * z
    return (
        c_pitch * x - s_pitch * z,
        c_roll * y + s_roll * z_pitched,
        -s_roll * y + c_roll * z_pitched,
    )


@kernel
def yawed_to_ground(heading, x, y):
    """Transform a horizontal vector from frame 2 to the ground frame: Rz(yaw)."""
    s_yaw, c_yaw = heading
    return c_yaw * x - s_yaw * y, s_yaw * x + c_yaw * y


@kernel
def ground_to_yawed(heading, x, y):
    """Transform a horizontal vector from the ground frame to frame 2."""
    s_yaw, c_yaw = heading
    return c_yaw * x + s_yaw * y, -s_yaw * x + c_yaw * y


@kernel
def euler_rates(attitude, wx, wy, wz):
    """Roll, pitch and yaw rates (rad/s) from the body rates (eqs 37, 35, 36)."""
    s_roll, c_roll, s_pitch, c_pitch = attitude
    yaw_rate = (wy * s_roll + wz * c_roll) / c_pitch
    return wx + yaw_rate * s_pitch, wy * c_roll - wz * s_roll, yaw_rate


@kernel
def small_angle_euler_rates(roll, pitch, wx, wy, wz):
    """Roll, pitch and yaw rates (rad/s) for small angles (eqs 53, 51, 52)."""
    return wx + wz * pitch, wy - wz * roll, wy * roll + wz


@kernel
def quaternion(roll, pitch, yaw):
    """The attitude as a unit quaternion (x, y, z, w), for messages."""
    sr, cr = math.sin(roll / 2), math.cos(roll / 2)
    sp, cp = math.sin(pitch / 2), math.cos(pitch / 2)
    sy, cy = math.sin(yaw / 2), math.cos(yaw / 2)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )
