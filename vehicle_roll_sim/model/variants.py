"""The models by name: which forms of the terms each has."""

_1A = ("small_angles",)
_1B = (*_1A, "no_link_inertia", "no_unsprung_turning")
MODELS = {
    "1": (),
    "1a": _1A,
    "1b": _1B,
    "1c-i": (*_1B, "contact_forces_not_rotated"),
    "1c-ii": (*_1B, "unsprung_forces_not_rotated"),
    "1c-iii": (*_1B, "rates_not_rotated"),
    "1c-iv": (*_1B, "contact_moves_with_corner"),
    "1b-static-strut": (*_1B, "fixed_strut_length"),
    "1b-no-strut": (*_1B, "fixed_strut_length", "unsprung_moves_with_corner"),
    "1b-turning-kept": (*_1A, "no_link_inertia"),
    "1b-mass-lumped": (*_1B, "lumped_unsprung_mass"),
    "2": ("kinematic",),
    "8dof": ("eight_dof",),
    "8dof-rigid-tires": ("eight_dof", "rigid_tires"),
}
"""The simplifications that define each model.

After 1c-iv: the admissible simplification of section 6.4 in its two steps, and the two errors of
section 5 (equation 58 omitted; unsprung mass lumped into equations 48 and 49). Last: the 8 DOF
model of section 8, with the tires in series with the springs, and with rigid tires, that is, with
the roll stiffness of the springs alone. 2 is not in the paper (docs/model_2.md).
"""
PAPER = "1"
"""The full model of the paper, which is the default."""
