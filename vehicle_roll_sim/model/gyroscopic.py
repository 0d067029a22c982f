"""Gyroscopic moments of the spinning wheels: a wheel resists a turn of its spin axis.

With the spin omega about the axis n, and the angular velocity W of the carrier, the moment on the
carrier is -Jw omega (W x n). It does no work. It is added to the moments at the contact point: a
moment has no place. The rate of steering, which may step, is left out.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, term
from vehicle_roll_sim.model.records import WHEEL_COUNT


@term
def add_gyroscopic_moment(i, momentum, turning, axis, outputs):
    """Add the moment of wheel i (N m), with its angular momentum about its axis (N m s).

    turning, axis: angular velocity of the carrier (rad/s) and spin axis, in frame 1.
    """
    wx, wy, wz = turning
    nx, ny, nz = axis
    outputs.contact_moment_x[i] -= momentum * (wy * nz - wz * ny)
    outputs.contact_moment_y[i] -= momentum * (wz * nx - wx * nz)
    outputs.contact_moment_z[i] -= momentum * (wx * ny - wy * nx)


@kernel
def gyroscopic_moments(state, vehicle, outputs):
    """Add those of wheels that turn with the body, steered about its z axis."""
    turning = (state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE])
    for i in range(WHEEL_COUNT):
        axis = (-outputs.steering_sine[i], outputs.steering_cosine[i], 0.0)
        momentum = vehicle.wheel_inertia * state[at.WHEEL_SPEED][i]
        add_gyroscopic_moment(i, momentum, turning, axis, outputs)


@kernel
def gyroscopic_moments_on_carriers(state, vehicle, outputs):
    """Add those of wheels whose carriers also turn with their travel."""
    terms = outputs.suspension_terms
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    for i in range(WHEEL_COUNT):
        rate = outputs.suspension_rate[i]
        turning = (
            wx + terms.carrier_turn[0, i] * rate,
            wy + terms.carrier_turn[1, i] * rate,
            wz + terms.carrier_turn[2, i] * rate,
        )
        axis = (terms.spin_axis[0, i], terms.spin_axis[1, i], terms.spin_axis[2, i])
        momentum = vehicle.wheel_inertia * state[at.WHEEL_SPEED][i]
        add_gyroscopic_moment(i, momentum, turning, axis, outputs)
