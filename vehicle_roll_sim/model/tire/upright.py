"""Tires that remain normal to the ground at any roll angle (section 7.2, eqs 67-69)."""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, math
from vehicle_roll_sim.model.records import LF, LR, RF, RR


@kernel
def tire_tilt(left, right, xt, vehicle, c_roll):
    """Inclination of an axle's wheels to the ground (rad), not 0 if a wheel is lifted (eq. 75)."""
    track = vehicle.y[left] - vehicle.y[right]
    return math.atan((min(xt[right], 0.0) - min(xt[left], 0.0)) / (track * c_roll))


@kernel
def upright_contact(i, state, vehicle, attitude, outputs):
    """Tilt (rad), loaded radius (m), contact velocity (m/s) of wheel i (eqs 67-69, 75, 76)."""
    s_roll, c_roll, s_pitch, c_pitch = attitude
    xt, wu = state[at.TIRE_COMPRESSION], state[at.UNSPRUNG_VELOCITY]
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    left, right = (LF, RF) if i < LR else (LR, RR)
    tilt = tire_tilt(left, right, xt, vehicle, c_roll)
    s_tilt, c_tilt = math.sin(tilt), math.cos(tilt)
    tilting = wx if tilt != 0.0 else 0.0  # (76)
    r = vehicle.tire_radius[i]
    if xt[i] > 0.0:
        r -= xt[i] / (c_pitch * c_tilt)  # (69)
    us, vs, ls = outputs.corner_u[i], outputs.corner_v[i], outputs.strut_length[i]
    rotational = wy * ls + (wy * c_tilt - wz * s_tilt) * r
    rise = wu[i] * c_roll + (wx * ls + vs) * s_roll + tilting * r * s_tilt
    outputs.tire_tilt[i], outputs.loaded_radius[i] = tilt, r
    outputs.contact_u[i] = c_pitch * (us - rotational) + s_pitch * rise  # (67)
    outputs.contact_v[i] = c_roll * (vs + wx * ls) + tilting * r * c_tilt - wu[i] * s_roll  # (68)
