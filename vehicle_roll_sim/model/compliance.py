"""Compliance: wheels yield in steering and camber to the forces of their tires.

A tire force depends on the angles of its wheel, and these on the force. With transient slip a force
is a function of the slip states, not of the present steering angle: the forces give the angle, and
the angle gives the rates of the slip. With steady-state slip, or near standstill, and for camber in
any case, angle and force have to agree. The secant method makes them agree, each angle with one
equation of its own; the influence of one angle of a wheel on the equation of the other is small.
"""

from vehicle_roll_sim.model.compiled.jit import kernel, math, term
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.model.tire.loads import terms_of_loads

MOST_ITERATIONS = 30
AGREEMENT = 1e-12
"""rad: largest difference between a compliance angle and that from its forces."""
LARGEST = 0.5
"""rad: largest compliance steer and compliance camber."""


@kernel
def begin_to_yield(outputs):
    """Keep the directions and inclinations of rigid wheels, from which compliance is counted."""
    terms = outputs.compliance_terms
    for i in range(WHEEL_COUNT):
        terms.sine[i], terms.cosine[i] = outputs.steering_sine[i], outputs.steering_cosine[i]
        terms.inclination[i] = outputs.inclination[i]
        terms.inclination_sine[i] = outputs.inclination_sine[i]
        terms.inclination_cosine[i] = outputs.inclination_cosine[i]
        terms.angle[i] = terms.gap[i] = terms.step[i] = 0.0
        terms.lean[i] = terms.lean_gap[i] = terms.lean_step[i] = 0.0


@kernel
def has_yielded(iteration, vehicle, tires, outputs):
    """Whether angles and forces agree; otherwise turn the wheels further towards agreement."""
    terms, details, largest = outputs.compliance_terms, vehicle.details, 0.0
    for i in range(WHEEL_COUNT):
        side_force, moment = outputs.tire_lateral[i], outputs.aligning_moment[i]
        wanted = details.lateral_force_steer[i] * side_force
        wanted += details.aligning_moment_steer[i] * moment
        gap = max(-LARGEST, min(LARGEST, wanted)) - terms.angle[i]
        terms.step[i] = secant_step(gap, terms.gap[i], terms.step[i])
        terms.gap[i] = gap
        wanted = details.lateral_force_camber[i] * side_force
        lean_gap = max(-LARGEST, min(LARGEST, wanted)) - terms.lean[i]
        terms.lean_step[i] = secant_step(lean_gap, terms.lean_gap[i], terms.lean_step[i])
        terms.lean_gap[i] = lean_gap
        largest = max(largest, abs(gap), abs(lean_gap))
    if largest <= AGREEMENT or iteration == MOST_ITERATIONS - 1:
        return True
    turn_further(outputs)
    if details.camber_yields != 0.0:
        lean_further(outputs)
        terms_of_loads(tires, outputs)
    return False


@term
def secant_step(gap, gap_before, step_before):
    """The next step (rad); the gap itself at first, and where the slope does not fall."""
    fall = gap_before - gap
    if step_before * fall > 0.0:
        return max(-LARGEST, min(LARGEST, gap * step_before / fall))
    return gap


@kernel
def turn_further(outputs):
    """Take the step of compliance steer."""
    terms = outputs.compliance_terms
    for i in range(WHEEL_COUNT):
        terms.angle[i] += terms.step[i]
        s, c = math.sin(terms.angle[i]), math.cos(terms.angle[i])
        outputs.steering_sine[i] = terms.sine[i] * c + terms.cosine[i] * s
        outputs.steering_cosine[i] = terms.cosine[i] * c - terms.sine[i] * s


@kernel
def lean_further(outputs):
    """Take the step of compliance camber."""
    terms = outputs.compliance_terms
    for i in range(WHEEL_COUNT):
        terms.lean[i] += terms.lean_step[i]
        s, c = math.sin(terms.lean[i]), math.cos(terms.lean[i])
        level, rise = terms.inclination_cosine[i], terms.inclination_sine[i]
        outputs.inclination[i] = terms.inclination[i] + terms.lean[i]
        outputs.inclination_sine[i] = rise * c + level * s
        outputs.inclination_cosine[i] = level * c - rise * s


@kernel
def note_compliance_steer(outputs):
    """Add compliance steer to the road-wheel angles."""
    for i in range(WHEEL_COUNT):
        outputs.steering[i] += outputs.compliance_terms.angle[i]
