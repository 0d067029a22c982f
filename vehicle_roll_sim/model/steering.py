"""The steering angle of every wheel: commands, steering geometry, toe and roll steer."""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, math
from vehicle_roll_sim.model.records import FRONT, LR, REAR, WHEEL_COUNT
from vehicle_roll_sim.model.suspension.strut_details import apart_from_rest, value_at


@kernel
def steer(command, outputs):
    """Road-wheel angle of every wheel (rad), its sine and cosine."""
    front, rear = command.steering, command.rear_steering
    outputs.commanded_steering[FRONT], outputs.commanded_steering[REAR] = front, rear
    at_front, at_rear = (math.sin(front), math.cos(front)), (math.sin(rear), math.cos(rear))
    for i in range(WHEEL_COUNT):
        outputs.steering[i] = front if i < LR else rear
        outputs.steering_sine[i], outputs.steering_cosine[i] = at_front if i < LR else at_rear


@kernel
def steer_each_wheel(state, vehicle, options, outputs):
    """Add what sets the wheels of an axle apart, and what turns them with the suspension.

    Ackermann geometry: cot(outer) - cot(inner) = share * track / wheelbase, with the command's
    cotangent halfway; with k = share * y / wheelbase tan(angle) = sin / (cos - k sin).
    """
    details = vehicle.details
    for i in range(WHEEL_COUNT):
        s, c = outputs.steering_sine[i], outputs.steering_cosine[i]
        angle = outputs.steering[i]
        if details.ackermann[i] != 0.0:
            angle = math.atan2(s, c - details.ackermann[i] * s)
        angle += details.toe[i]
        if not options.eight_dof:
            angle += suspension_steer(i, state, vehicle, options)
        outputs.steering[i] = angle
        outputs.steering_sine[i], outputs.steering_cosine[i] = math.sin(angle), math.cos(angle)


@kernel
def suspension_steer(i, state, vehicle, options):
    """Roll steer of wheel i, and the change of its toe with travel (rad).

    Roll steer goes by the roll angle of the suspension, (q_right - q_left) / track. In model 2 the
    change of toe is one of the carrier.
    """
    details, xs, left = vehicle.details, state[at.SUSPENSION_COMPRESSION], i - i % 2
    track = vehicle.y[left] - vehicle.y[left + 1]
    rolled = apart_from_rest(left + 1, state, vehicle) / track
    angle = details.roll_steer[i] * rolled
    if not options.kinematic:
        axle, side = FRONT if i < LR else REAR, 1.0 if i % 2 == 0 else -1.0
        travel = xs[i] - vehicle.static_suspension_compression[i]
        toe = value_at(
            travel,
            details.toe_change_knots[axle],
            details.toe_change_origins[axle],
            details.toe_change[axle],
        )
        angle += side * toe
    return angle
