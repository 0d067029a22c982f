"""Moments of the spinning wheels, which resist a turn of their axes and a change of their spin.

With the spin omega about the axis n, and the angular velocity W of the carrier, the moment on the
carrier is -Jw omega (W x n) - Jw omega' n: minus the change of the angular momentum Jw omega n. The
second part is what is left of drive torque, brake torque and tire force at a wheel that spins up or
down. Both are added to the moments at the contact point: a moment has no place. The rate of
steering, which may step, is left out.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, term
from vehicle_roll_sim.model.records import WHEEL_COUNT


@term
def add_moment_of_spin(i, momentum, change, turning, axis, outputs):
    """Add the moment of wheel i (N m), with its angular momentum about its axis (N m s).

    change: of this momentum (N m). turning, axis: angular velocity of the carrier (rad/s) and spin
    axis, in frame 1.
    """
    wx, wy, wz = turning
    nx, ny, nz = axis
    outputs.contact_moment_x[i] -= momentum * (wy * nz - wz * ny) + change * nx
    outputs.contact_moment_y[i] -= momentum * (wz * nx - wx * nz) + change * ny
    outputs.contact_moment_z[i] -= momentum * (wx * ny - wy * nx) + change * nz


@kernel
def gyroscopic_moments(state, vehicle, outputs, rates):
    """Add those of wheels that turn with the body, steered about its z axis.

    rates: with those of the spins.
    """
    turning = (state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE])
    for i in range(WHEEL_COUNT):
        axis = (-outputs.steering_sine[i], outputs.steering_cosine[i], 0.0)
        momentum = vehicle.wheel_inertia * state[at.WHEEL_SPEED][i]
        change = vehicle.wheel_inertia * rates[at.WHEEL_SPEED][i]
        add_moment_of_spin(i, momentum, change, turning, axis, outputs)


@kernel
def gyroscopic_moments_on_carriers(state, vehicle, outputs, rates):
    """Add those of wheels whose carriers also turn with their travel.

    rates: with those of the spins.
    """
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
        change = vehicle.wheel_inertia * rates[at.WHEEL_SPEED][i]
        add_moment_of_spin(i, momentum, change, turning, axis, outputs)
