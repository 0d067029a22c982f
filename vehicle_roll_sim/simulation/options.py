"""The choice of the model and its options, declared once for Python, command line and node."""

import dataclasses

import numpy as np

from vehicle_roll_sim.declaration import (
    AUTO,
    OFF,
    ON,
    SWITCH,
    InputError,
    keep_validated,
    parameter,
)
from vehicle_roll_sim.model.records import EIGHT_DOF_STATES, MODEL_STATE, OPTIONS, SLIP_STATES
from vehicle_roll_sim.model.variants import MODELS, PAPER
from vehicle_roll_sim.vehicle.parameters import Vehicle

OF_FOURTEEN_DOF = ("cg_offset", "roll_pitch_product", "pitch_yaw_product", "roll_yaw_product")
"""Parameters of a vehicle that only the equations of the 14 DOF models have."""
SWITCHES = ("tire_moments", "contact_patch_shift")
"""Options that a vehicle file decides unless they are given."""
UPRIGHT_ONLY = ("tire_normal_to_ground", "steady_state_slip")
"""Options that make no sense once a vehicle has fallen on its side and slides to a stop."""
SYMMETRIC, ASYMMETRIC = "symmetric", "asymmetric"


@dataclasses.dataclass(frozen=True)
class Options:
    """The model and its variants. The default is model 1 of the paper.

    Raises InputError for a combination that the paper does not define: the simplified models have
    only the variant `no_roll_centre`, the 8 DOF model and model 2 have none; without roll centres
    there is no link load transfer that could be asymmetric.
    """

    model: str = parameter(
        "model of the paper, or 2; a vehicle file can name another default",
        choices=tuple(MODELS),
        default=PAPER,
    )
    no_roll_centre: bool = parameter(
        "no roll centres: lateral link forces act at the strut tops (eq. 24 instead of 25), and "
        "there is no link load transfer",
        default=False,
    )
    tire_normal_to_ground: bool = parameter(
        "tires remain normal to the ground in roll (section 7.2)", default=False
    )
    link_load_transfer: str = parameter(
        "load transfer through the suspension links, for an axle as a whole or for each side "
        "separately (section 7.3)",
        choices=(SYMMETRIC, ASYMMETRIC),
        default=SYMMETRIC,
    )
    steady_state_slip: bool = parameter(
        "steady-state slip of equations 5 and 6, without tire lag; valid above 3.5 m/s",
        default=False,
    )
    euler_terms: bool = parameter(
        "include the gyroscopic terms that the paper omits from equations 32 to 34", default=False
    )
    wheel_gyroscopics: bool = parameter(
        "include the gyroscopic moments of the spinning wheels and the reactions to their spin-up",
        default=False,
    )
    body_contact: bool = parameter(
        "let the body touch the ground, a box with springs, dampers and friction at its corners; a "
        "run then goes on after a rollover (models 1 and 2)",
        default=False,
    )
    tire_moments: str = parameter(
        "apply the overturning, rolling resistance and aligning moments of the tires; auto: as in "
        "the vehicle file, where on is the default",
        choices=SWITCH,
        default=AUTO,
    )
    contact_patch_shift: str = parameter(
        "shift the contact patches sideways under lateral force, unless an overturning moment of "
        "the tire file is applied, which includes this; auto: as in the vehicle file, where on is "
        "the default",
        choices=SWITCH,
        default=AUTO,
    )

    def __post_init__(self):
        keep_validated(self)  # converts 1 to model "1"
        if self.model != "1":
            self._refuse("of model 1", "tire_normal_to_ground", "link_load_transfer", "euler_terms")
        if not self.has_tire_moments:
            self._refuse("of models 1 and 2", *SWITCHES, "wheel_gyroscopics", "body_contact")
        if self.is_kinematic:
            self._refuse("of models with a fixed roll centre", "no_roll_centre")
        if self.has_eight_dof:
            self._refuse("of the 14 DOF models", "no_roll_centre")
        if self.no_roll_centre and self.link_load_transfer == ASYMMETRIC:
            allowed = "symmetric, since there is no roll centre"
            raise InputError("link_load_transfer", ASYMMETRIC, allowed)
        for name in UPRIGHT_ONLY if self.body_contact else ():
            if getattr(self, name):
                problem = "not possible together with body_contact"
                raise InputError(name, True, "an option for wheels on the road", problem)

    def _refuse(self, of_which: str, *names: str) -> None:
        """Raise InputError for the first of these options that is not at its default."""
        for name in names:
            value, lacking = getattr(self, name), f"model {self.model} does not have it"
            if value is True:
                raise InputError(name, value, f"an option {of_which}", lacking)
            if value not in (False, SYMMETRIC, AUTO, OFF):
                raise InputError(name, value, f"an option {of_which}; {lacking}")

    @property
    def has_eight_dof(self) -> bool:
        return "eight_dof" in MODELS[self.model]

    @property
    def is_kinematic(self) -> bool:
        """Whether the suspension guides the wheels along paths, as in model 2."""
        return "kinematic" in MODELS[self.model]

    @property
    def has_tire_moments(self) -> bool:
        """Whether the equations have terms for the moments of the tires."""
        return self.model == "1" or self.is_kinematic

    @property
    def states(self) -> tuple[str, ...]:
        """The fields of records.STATE that the model uses, in the order of its equations."""
        states = EIGHT_DOF_STATES if self.has_eight_dof else MODEL_STATE.names
        return states if self.steady_state_slip else (*states, *SLIP_STATES)

    def record(self) -> np.ndarray:
        """The options as input to the equations: an array of one OPTIONS record, shape (1,)."""
        options = np.zeros(1, OPTIONS)
        chosen = [name for name, value in vars(self).items() if value is True]
        for name in (*MODELS[self.model], *chosen):
            options[name] = True
        options["asymmetric_link_load_transfer"] = self.link_load_transfer == ASYMMETRIC
        of_tires = ON in (self.tire_moments, self.contact_patch_shift)
        options["contact_moments"] = of_tires or self.wheel_gyroscopics
        return options

    def for_vehicle(self, vehicle: Vehicle) -> "Options":
        """The same options with on or off in place of auto, as a vehicle has it.

        Raises InputError for a vehicle whose mass the model cannot take.
        """
        self._check_mass(vehicle)
        chosen = {
            name: ON if self.has_tire_moments and getattr(vehicle, name) else OFF
            for name in SWITCHES
            if getattr(self, name) == AUTO
        }
        return dataclasses.replace(self, **chosen) if chosen else self

    def _check_mass(self, vehicle: Vehicle) -> None:
        """The 8 DOF models assume a symmetric body without products of inertia."""
        for name in OF_FOURTEEN_DOF if self.has_eight_dof else ():
            value = getattr(vehicle, name)
            if value:
                of_payload = vehicle.origin and name not in vehicle.given
                source = " (from payload or data of the whole vehicle)" if of_payload else ""
                takes_it = "a model with 14 degrees of freedom takes it"
                allowed = f"0 in model {self.model}; {takes_it}"
                raise InputError(name, value, allowed, f"{value:.6g}{source} is not allowed")


def options_for(vehicle: Vehicle, **values) -> Options:
    """Options with these values; the model is that of the vehicle unless it is among them.

    Raises InputError.
    """
    return Options(**{"model": vehicle.model} | values)


MULTIBODY = Options(no_roll_centre=True, euler_terms=True, steady_state_slip=True)
"""The model that is exact for a rigid body and four point masses that slide along its z axis
(docs/model.md)."""
