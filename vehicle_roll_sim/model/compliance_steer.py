"""Compliance steer: wheels yield in their steering to lateral force and aligning moment.

It depends on the forces of a tire, and these on the angle of its wheel. With transient slip a tire
force is a function of the slip states, not of the present angle: the forces give the angle, and the
angle gives the rates of the slip. With steady-state slip, or near standstill, angle and force have
to agree: each wheel has one equation in one unknown, which the secant method solves.
"""

from vehicle_roll_sim.model.compiled.jit import kernel, math, term
from vehicle_roll_sim.model.records import WHEEL_COUNT

MOST_ITERATIONS = 30
AGREEMENT = 1e-12
"""rad: between the angle of compliance steer and that of its forces."""
LARGEST = 0.5
"""rad: of compliance steer."""


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


@kernel
def note_compliance_steer(outputs):
    """Add compliance steer to the road-wheel angles."""
    for i in range(WHEEL_COUNT):
        outputs.steering[i] += outputs.compliance_terms.angle[i]
