"""Values of each axle and wheel: those given for it, for both axles, or by its tire."""

import functools

import numpy as np

from vehicle_roll_sim.model.tire.coefficients import on_axles
from vehicle_roll_sim.vehicle.axle_tires import (
    FromTire,
    lateral_stiffness,
    progression_of,
    radius_of,
    stiffness_of,
)
from vehicle_roll_sim.vehicle.suspension_parameters import AXLES
from vehicle_roll_sim.vehicle.tire.moments import OVERTURNING, has_moment
from vehicle_roll_sim.vehicle.tire_file import Tire

LINEAR = {"spring_stiffness": "stiffness_at_rest", "damping": "mean_damping"}
"""Parameters of each axle that may be tables, and the values of linear models in their place."""
NEUTRAL = {"tire_progression": 0.0}
"""Values of tires that neither the vehicle file nor the tire file has to give."""


class AxleValues:
    """What a Vehicle has at each axle and on its tires."""

    @property
    def own_tires(self) -> dict[str, Tire]:
        """The tires as they were given, by field: `tire`, or `front_tire` and `rear_tire`."""
        names = ("tire",) if self.tire is not None else ("front_tire", "rear_tire")
        return {name: getattr(self, name) for name in names}

    @property
    def axle_tires(self) -> dict[str, Tire]:
        """The tire of each axle, by the axle's name."""
        if self.tire is not None:
            return dict.fromkeys(AXLES, self.tire)
        return {"front": self.front_tire, "rear": self.rear_tire}

    @functools.cached_property
    def from_tires(self) -> dict[str, FromTire]:
        """The values that come from the tire files because none is given, by parameter name.

        Raises InputError for one that its tire file does not have.
        """
        found = {}
        for axle, tire in self.axle_tires.items():
            pressure = self.at_axle(axle, "tire_pressure")
            if self.at_axle(axle, "tire_radius") is None:
                found[f"{axle}_tire_radius"] = radius_of(axle, tire)
            stiffness = self.at_axle(axle, "tire_stiffness")
            progression = self.at_axle(axle, "tire_progression")
            if stiffness is None:
                if progression is None:
                    found[f"{axle}_tire_progression"] = progression_of(axle, tire)
                    progression = found[f"{axle}_tire_progression"].value
                found[f"{axle}_tire_stiffness"] = stiffness_of(axle, tire, pressure, progression)
        return found

    @functools.cached_property
    def lateral_stiffness_from_tires(self) -> dict[str, FromTire]:
        """The lateral stiffnesses of the tires of each axle that are not given, by name (N/m)."""
        loads = self.static_tire_load
        loads = loads.reshape(len(AXLES), -1).mean(axis=1)  # of left and right wheel
        return {
            f"{axle}_tire_lateral_stiffness": lateral_stiffness(
                tire,
                self.at_axle(axle, "tire_pressure"),
                float(load),
                float(self.per_wheel("tire_radius")[AXLES[axle]]),
                self.minimum_relaxation_length,
            )
            for load, (axle, tire) in zip(loads, self.axle_tires.items(), strict=True)
            if self.at_axle(axle, "tire_lateral_stiffness") is None
        }

    def at_axle(self, axle: str, name: str) -> float | None:
        """The value given for an axle, alone or for both; None if there is none."""
        value = getattr(self, f"{axle}_{name}")
        return getattr(self, name, None) if value is None else value

    def per_wheel(self, name: str) -> np.ndarray:
        """The values of NAME of the front and rear axle at lf, rf, lr, rr; shape (4,).

        Those that are not given are those of the tires. Springs and dampers that are tables have
        the stiffness and damping of linear models.
        """
        if name in LINEAR:
            return getattr(self, LINEAR[name])
        front, rear = (self._known_at_axle(axle, name) for axle in AXLES)
        return np.array([front, front, rear, rear])

    def _known_at_axle(self, axle: str, name: str) -> float:
        value = self.at_axle(axle, name)
        if value is not None:
            return value
        taken = self.from_tires.get(f"{axle}_{name}")
        return taken.value if taken else NEUTRAL[name]

    def contact_patch_compliance(self, tire_moments: bool) -> np.ndarray:
        """Shift of each contact patch per lateral force, shape (4,) (m/N).

        With tire_moments it is 0 for tires whose file has an overturning moment, which contains it.
        """
        found = self.lateral_stiffness_from_tires
        compliances = []
        for axle, tire in self.axle_tires.items():
            given = self.at_axle(axle, "tire_lateral_stiffness")
            stiffness = found[f"{axle}_tire_lateral_stiffness"].value if given is None else given
            is_contained = tire_moments and has_moment(OVERTURNING, tire.coefficients)
            compliances += [0.0 if is_contained else 1.0 / stiffness] * 2
        return np.array(compliances)

    def tires(self, moments: bool = False) -> np.ndarray:
        """The tires of front and rear axle as input to the equations: TIRE records, shape (2,).

        moments: whether their moments are computed; with the radius of the vehicle if the tire file
        has none.
        """
        records = []
        for axle, tire in self.axle_tires.items():
            record = tire.shared_record(self.at_axle(axle, "tire_pressure"), moments)
            if record["UNLOADED_RADIUS"] == 0.0:
                record = record.copy()
                record["UNLOADED_RADIUS"] = self._known_at_axle(axle, "tire_radius")
            records.append(record)
        return on_axles(*records)
