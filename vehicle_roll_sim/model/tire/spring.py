"""The tire as a spring: its vertical force over compression, and the inverse.

    F = k x (1 + p x),  E = k x^2 (1/2 + p x / 3)

with the stiffness k at zero compression and the progression p, 0 for a linear spring. Off the
ground, at negative compression, F = k x: it is only a measure of how far a wheel has lifted.
"""

from vehicle_roll_sim.model.compiled.jit import kernel, math, term


@term
def spring_force(compression, stiffness, progression):
    """F (N) at a compression (m). stiffness: N/m. progression: 1/m."""
    return stiffness * compression * (1.0 + progression * max(compression, 0.0))


@kernel
def compression_under(force, stiffness, progression):
    """x (m) under a force of at least 0 (N)."""
    root = math.sqrt(stiffness * stiffness + 4 * stiffness * progression * force)
    return 2 * force / (stiffness + root)
