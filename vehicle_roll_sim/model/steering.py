"""The steering angle of every wheel: commands, steering geometry, toe, roll and compliance steer.

Compliance steer depends on the forces of a tire, and these on its angle. With transient slip a tire
force is a function of the slip states, not of the present angle: the forces give the angle, and the
angle gives the rates of the slip. With steady-state slip, or near standstill, angle and force have
to agree: each wheel has one equation in one unknown, which the secant method solves.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, math, term
from vehicle_roll_sim.model.contact import contact_forces
from vehicle_roll_sim.model.records import FRONT, LR, REAR, WHEEL_COUNT
from vehicle_roll_sim.model.suspension.strut_details import value_at

MOST_ITERATIONS = 30
AGREEMENT = 1e-12
"""rad: between the angle of compliance steer and that of its forces."""
LARGEST = 0.5
"""rad: of compliance steer."""


@kernel
def steer(state, command, vehicle, options, outputs):
    """Road-wheel angle of every wheel (rad), its sine and cosine."""
    front, rear = command.steering, command.rear_steering
    outputs.commanded_steering[FRONT], outputs.commanded_steering[REAR] = front, rear
    at_front, at_rear = (math.sin(front), math.cos(front)), (math.sin(rear), math.cos(rear))
    for i in range(WHEEL_COUNT):
        outputs.steering[i] = front if i < LR else rear
        outputs.steering_sine[i], outputs.steering_cosine[i] = at_front if i < LR else at_rear
    if vehicle.details.steering != 0.0:
        steer_each_wheel(state, vehicle, options, outputs)


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
    rolled = (xs[left + 1] - xs[left]) / (vehicle.y[left] - vehicle.y[left + 1])
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


@kernel
def compliant_contact_forces(state, vehicle, tires, options, outputs):
    """Contact forces as of `contact_forces`, with wheels that yield to them in their steering."""
    yields = vehicle.details.compliance != 0.0
    if yields:
        begin_to_yield(outputs)
    for iteration in range(MOST_ITERATIONS):
        contact_forces(state, vehicle, tires, options, outputs)
        if not yields or has_yielded(iteration, vehicle, outputs):
            break
    if yields:
        for i in range(WHEEL_COUNT):
            outputs.steering[i] += outputs.compliance_terms.angle[i]


@kernel
def begin_to_yield(outputs):
    """Keep the directions of rigid wheels, from which compliance steer is counted."""
    terms = outputs.compliance_terms
    for i in range(WHEEL_COUNT):
        terms.sine[i], terms.cosine[i] = outputs.steering_sine[i], outputs.steering_cosine[i]
        terms.angle[i] = terms.gap[i] = terms.step[i] = 0.0


@kernel
def has_yielded(iteration, vehicle, outputs):
    """Whether angles and forces agree; otherwise turn the wheels further towards agreement."""
    terms, details, largest = outputs.compliance_terms, vehicle.details, 0.0
    for i in range(WHEEL_COUNT):
        side_force, moment = outputs.tire_lateral[i], outputs.aligning_moment[i]
        wanted = details.lateral_force_steer[i] * side_force
        wanted += details.aligning_moment_steer[i] * moment
        gap = max(-LARGEST, min(LARGEST, wanted)) - terms.angle[i]
        terms.step[i] = secant_step(gap, terms.gap[i], terms.step[i])
        terms.gap[i] = gap
        largest = max(largest, abs(gap))
    if largest <= AGREEMENT or iteration == MOST_ITERATIONS - 1:
        return True
    for i in range(WHEEL_COUNT):
        terms.angle[i] += terms.step[i]
        s, c = math.sin(terms.angle[i]), math.cos(terms.angle[i])
        outputs.steering_sine[i] = terms.sine[i] * c + terms.cosine[i] * s
        outputs.steering_cosine[i] = terms.cosine[i] * c - terms.sine[i] * s
    return False


@term
def secant_step(gap, gap_before, step_before):
    """The next step (rad); the first one, and one without a falling slope, goes by the gap."""
    fall = gap_before - gap
    if step_before * fall > 0.0:
        return max(-LARGEST, min(LARGEST, gap * step_before / fall))
    return gap
