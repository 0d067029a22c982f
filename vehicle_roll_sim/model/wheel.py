"""The spin of the wheels: drive torque, brake, rolling resistance and tire force.

A brake is dry friction: it opposes the spin, holds a stationary wheel and never reverses it. The
direction of friction is that at the beginning of a step; a wheel that the friction would have
reversed during the step stops instead.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, math, term
from vehicle_roll_sim.model.records import LR, WHEEL_COUNT


@kernel
def note_turning(state, outputs):
    """Direction of spin of every wheel: 1, -1, or 0 if it is stationary."""
    spin = state[at.WHEEL_SPEED]
    for i in range(WHEEL_COUNT):
        outputs.turning[i] = math.copysign(1.0, spin[i]) if spin[i] != 0.0 else 0.0


@kernel
def friction_capacity(i, command, vehicle, outputs):
    """Friction capacity of brake and rolling resistance at wheel i (N m)."""
    resistance = vehicle.rolling_resistance_coefficient * outputs.normal_force[i]
    return command.brake_torque[i] + resistance * outputs.loaded_radius[i]


@kernel
def with_friction(torque, capacity, turning):
    """Net torque on a wheel (N m) after dry friction of the given capacity (N m).

    turning: direction of the spin, 1, -1 or 0.
    """
    if turning != 0.0:
        return torque - turning * capacity
    if abs(torque) <= capacity:
        return 0.0
    return torque - math.copysign(capacity, torque)


@term
def drive_torque(i, hold, spin, command, vehicle):
    """Torque of the drive at wheel i, before the coupling of the differential (N m)."""
    torque = command.wheel_torque[i]
    if i >= LR:
        torque += hold
    return torque - vehicle.engine_drag[i] * spin[i]


@kernel
def coupling_torque(i, hold, spin, command, vehicle):
    """Torque that the differential takes from wheel i for the other one of the axle, i ^ 1 (N m).

    An open differential gives both the same, which the command contains. A viscous coupling adds
    c (w - w'), a limited-slip differential the dry friction L tanh[c (w - w') / L], regularized at
    equal speeds, where L = preload + locking / 2 |torque of the axle|.
    """
    torque = vehicle.differential_damping[i] * (spin[i] - spin[i ^ 1])
    if vehicle.differential_preload[i] == 0.0:
        return torque
    of_axle = drive_torque(i, hold, spin, command, vehicle)
    of_axle += drive_torque(i ^ 1, hold, spin, command, vehicle)
    largest = vehicle.differential_preload[i] + vehicle.differential_locking[i] / 2 * abs(of_axle)
    return largest * math.tanh(torque / largest)


@kernel
def wheel_rates(state, command, vehicle, options, outputs, rates):
    """Spin acceleration: Jw dw/dt = T - r Fxt minus friction; the speed hold acts at the rear.

    With contact moments also their part about the spin axis.
    """
    spin = state[at.WHEEL_SPEED]
    hold = command.speed_hold_gain * (command.speed_hold_target - state[at.U])
    for i in range(WHEEL_COUNT):
        torque = drive_torque(i, hold, spin, command, vehicle)
        torque -= coupling_torque(i, hold, spin, command, vehicle)
        torque -= outputs.loaded_radius[i] * outputs.tire_longitudinal[i]
        if options.contact_moments:
            torque += outputs.spin_moment[i]
        capacity = friction_capacity(i, command, vehicle, outputs)
        if capacity > 0.0:
            torque = with_friction(torque, capacity, outputs.turning[i])
        rates[at.WHEEL_SPEED][i] = torque / vehicle.wheel_inertia
        rates[at.WHEEL_ANGLE][i] = spin[i]
        if not options.steady_state_slip:
            rates[at.LONGITUDINAL_SLIP][i] = outputs.longitudinal_slip_rate[i]
            rates[at.LATERAL_SLIP][i] = outputs.lateral_slip_rate[i]


@kernel
def stop_reversed(state, command, vehicle, outputs):
    """Stop the wheels that friction has reversed since `note_turning`."""
    spin = state[at.WHEEL_SPEED]
    for i in range(WHEEL_COUNT):
        turned_round = outputs.turning[i] * spin[i] < 0.0
        if turned_round and friction_capacity(i, command, vehicle, outputs) > 0.0:
            spin[i] = 0.0
