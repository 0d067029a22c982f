"""Which model, and its options: declared once for Python, the command line and the node."""

import dataclasses

import numpy as np

from vehicle_roll_sim.declaration import InputError, keep_validated, parameter
from vehicle_roll_sim.model.records import EIGHT_DOF_STATES, MODEL_STATE, OPTIONS, SLIP_STATES

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
    "8dof": ("eight_dof",),
    "8dof-rigid-tires": ("eight_dof", "rigid_tires"),
}
"""The forms of the terms that make each model. After 1c-iv: the harmless simplification of section
6.4 in its two steps, and the two mistakes of section 5 (58 left out; the unsprung mass lumped into
the equations 48 and 49). At the end: the 8 DOF model of section 8, as it should be and with the
roll stiffness of the springs alone."""
SYMMETRIC, ASYMMETRIC = "symmetric", "asymmetric"


@dataclasses.dataclass(frozen=True)
class Options:
    """The model and variants of it. The default is the source's model 1.

    Raises InputError for a combination that the source does not define: of the variants, the
    simplified models have `no_roll_centre` only and the 8 DOF model has none; without a roll centre
    there is no link load transfer that could be asymmetric.
    """

    model: str = parameter("the model of the source", choices=tuple(MODELS), default="1")
    no_roll_centre: bool = parameter(
        "lateral link forces act at the strut top (eq. 24 for 25), no link load transfer",
        default=False,
    )
    tire_normal_to_ground: bool = parameter(
        "tires stay normal to the ground in roll (section 7.2)", default=False
    )
    link_load_transfer: str = parameter(
        "over an axle, or each side by itself (section 7.3)",
        choices=(SYMMETRIC, ASYMMETRIC),
        default=SYMMETRIC,
    )
    steady_state_slip: bool = parameter(
        "the slip of equations 5 and 6 without the lag of the tires; needs 3.5 m/s",
        default=False,
    )
    euler_terms: bool = parameter(
        "the gyroscopic terms that the source leaves out of equations 32 to 34", default=False
    )

    def __post_init__(self):
        keep_validated(self)  # as its type: 1 is model "1"
        if self.model != "1":
            self._refuse("of model 1", "tire_normal_to_ground", "link_load_transfer", "euler_terms")
        if self.has_eight_dof:
            self._refuse("of the 14 DOF models", "no_roll_centre")
        if self.no_roll_centre and self.link_load_transfer == ASYMMETRIC:
            allowed = "symmetric where there is no roll centre"
            raise InputError("link_load_transfer", ASYMMETRIC, allowed)

    def _refuse(self, of_which: str, *names: str) -> None:
        """Raise InputError for the first of these options that is not at its default."""
        for name in names:
            if getattr(self, name) not in (False, SYMMETRIC):
                allowed = f"an option {of_which}, model {self.model} does not have it"
                raise InputError(name, getattr(self, name), allowed)

    @property
    def has_eight_dof(self) -> bool:
        return "eight_dof" in MODELS[self.model]

    @property
    def states(self) -> tuple[str, ...]:
        """Fields of records.STATE that the model has, in the order of its equations."""
        states = EIGHT_DOF_STATES if self.has_eight_dof else MODEL_STATE.names
        return states if self.steady_state_slip else (*states, *SLIP_STATES)

    def record(self) -> np.ndarray:
        """The options as the equations take them: one OPTIONS record in an array."""
        options = np.zeros(1, OPTIONS)
        chosen = [name for name, value in dataclasses.asdict(self).items() if value is True]
        for name in (*MODELS[self.model], *chosen):
            options[name] = True
        options["asymmetric_link_load_transfer"] = self.link_load_transfer == ASYMMETRIC
        return options


MULTIBODY = Options(no_roll_centre=True, euler_terms=True, steady_state_slip=True)
"""The model that is the exact mechanics of a body and four point masses that slide along its z axis
(docs/model.md)."""
