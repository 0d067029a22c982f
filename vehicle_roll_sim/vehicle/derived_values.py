"""What follows from a vehicle's parameters: static equilibrium, and the record for the model."""

import functools

import numpy as np

from vehicle_roll_sim.model.equilibrium import (
    axle_load_share,
    progressive_compression,
    static_strut_length,
    static_tire_compression,
    static_tire_load,
)
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.vehicle.axle_values import AxleValues
from vehicle_roll_sim.vehicle.masses import MOMENTS, PRODUCTS
from vehicle_roll_sim.vehicle.steering_gear import Gear
from vehicle_roll_sim.vehicle.suspension_details import (
    compressions_at_rest,
    mean_damping,
    stiffnesses_at_rest,
)
from vehicle_roll_sim.vehicle.suspension_parameters import AXLES
from vehicle_roll_sim.vehicle.travel_curves import TravelCurve
from vehicle_roll_sim.vehicle.travel_parameters import curves_of
from vehicle_roll_sim.vehicle.vehicle_record import record_of

GRAVITY = 9.81
"""m/s^2, the value used in the paper."""
SIDES = np.array([1.0, -1.0, 1.0, -1.0])
"""Of the wheels: left is positive."""
FRONT_BRAKE_SHARE = 0.6
"""Share of a total brake torque at the front axle, if none is given."""
BAR_SPELLINGS = tuple(
    (f"{axle}_anti_roll_bar_stiffness", f"{axle}_anti_roll_bar_rate") for axle in AXLES
)
"""The two parameters of each bar, of which a vehicle has at most one."""


def _shares(front: float) -> np.ndarray:
    """The share of each wheel, shape (4,), both wheels of an axle alike."""
    return np.array([front, front, 1.0 - front, 1.0 - front]) / 2.0


class DerivedValues(AxleValues):
    """Properties of a Vehicle, all derived from what was given."""

    @functools.cached_property
    def roll_centre_depth(self) -> np.ndarray:
        """Depth of the roll centre below the sprung c.g., at each wheel's axle; shape (4,) (m)."""
        return self._roll_centre("depth", "height")

    @functools.cached_property
    def roll_centre_height(self) -> np.ndarray:
        """Height of the roll centre above ground at rest, at each wheel's axle; shape (4,) (m)."""
        return self._roll_centre("height", "depth")

    def _roll_centre(self, wanted: str, other: str) -> np.ndarray:
        """The requested measure at each wheel (m), derived from the other if not specified."""
        values = []
        for axle in AXLES:
            value = getattr(self, f"{axle}_roll_centre_{wanted}")
            if value is None:
                value = self.cg_height - getattr(self, f"{axle}_roll_centre_{other}")
            values += [value, value]
        return np.array(values)

    @property
    def gear(self) -> Gear:
        """The steering ratio, or the table in its place."""
        return self.steering_gear if self.steering_ratio is None else self.steering_ratio

    @property
    def wheelbase(self) -> float:
        """Distance between the axles (m)."""
        return self.cg_to_front_axle + self.cg_to_rear_axle

    @property
    def mass(self) -> float:
        """Mass of the whole vehicle (kg)."""
        return self.sprung_mass + float(self.per_wheel("unsprung_mass").sum())

    @property
    def inertias(self) -> dict[str, float]:
        """Moments and products of inertia of the sprung mass, by name (kg m^2)."""
        return {name: getattr(self, name) or 0.0 for name in (*MOMENTS, *PRODUCTS)}

    @functools.cached_property
    def wheel_places(self) -> np.ndarray:
        """Where the wheels are, to the left of the sprung c.g.; shape (4,) (m)."""
        return self.per_wheel("track") / 2 * SIDES - (self.cg_offset or 0.0)

    @functools.cached_property
    def axle_load_share(self) -> np.ndarray:
        """Share of the sprung weight that each wheel carries at rest; shape (4,).

        The vehicle stands level across: of an axle's load, each wheel has 1/2 +- offset / track.
        """
        aside = 2 * (self.cg_offset or 0.0) / self.per_wheel("track")
        of_axles = axle_load_share(self.cg_to_front_axle, self.cg_to_rear_axle)
        return of_axles * (1.0 + aside * SIDES)

    @functools.cached_property
    def static_tire_compression(self) -> np.ndarray:
        """xti of each tire, eq. 20; shape (4,) (m)."""
        return static_tire_compression(
            self.sprung_mass,
            self.axle_load_share,
            self.per_wheel("unsprung_mass"),
            self.per_wheel("tire_stiffness"),
            self.per_wheel("tire_progression"),
            GRAVITY,
        )

    @functools.cached_property
    def static_tire_load(self) -> np.ndarray:
        """Load of each tire at rest, shape (4,) (N)."""
        spring = (self.per_wheel(f"tire_{name}") for name in ("stiffness", "progression"))
        return static_tire_load(self.static_tire_compression, *spring)

    @functools.cached_property
    def tire_stiffness_at_rest(self) -> np.ndarray:
        """Vertical stiffness of each tire under its load at rest, shape (4,) (N/m)."""
        growth = 2 * self.per_wheel("tire_progression") * self.static_tire_compression
        return self.per_wheel("tire_stiffness") * (1.0 + growth)

    @functools.cached_property
    def static_suspension_compression(self) -> np.ndarray:
        """xsi of each corner, eq. 19; shape (4,) (m)."""
        return compressions_at_rest(self, GRAVITY)

    @functools.cached_property
    def stiffness_at_rest(self) -> np.ndarray:
        """Stiffness of the spring at each wheel at rest, shape (4,) (N/m)."""
        return stiffnesses_at_rest(self, GRAVITY)

    @functools.cached_property
    def mean_damping(self) -> np.ndarray:
        """Damping coefficient at each wheel, shape (4,) (N s/m): mean of bump and rebound."""
        return np.repeat([mean_damping(self, axle) for axle in AXLES], WHEEL_COUNT // 2)

    @functools.cached_property
    def static_strut_length(self) -> np.ndarray:
        """lsi of each corner, eq. 18; shape (4,) (m)."""
        return static_strut_length(
            self.cg_height, self.per_wheel("tire_radius"), self.static_tire_compression
        )

    @functools.cached_property
    def bar_rate(self) -> np.ndarray:
        """Force of the anti-roll bar on a wheel per difference of travels, shape (4,) (N/m).

        K / c^2 with the bar's roll stiffness K: a roll angle phi moves the wheels c phi apart, and
        the pair of forces has the lever c.
        """
        rates = []
        for axle in AXLES:
            rate = getattr(self, f"{axle}_anti_roll_bar_rate") or 0.0
            stiffness = getattr(self, f"{axle}_anti_roll_bar_stiffness")
            if stiffness is not None:
                rate = stiffness / getattr(self, f"{axle}_track") ** 2
            rates += [rate, rate]
        return np.array(rates)

    @functools.cached_property
    def drive_shares(self) -> np.ndarray:
        """Share of a total drive torque at each wheel, shape (4,); rear-wheel drive by default."""
        return _shares(self.front_drive_share or 0.0)

    @functools.cached_property
    def brake_shares(self) -> np.ndarray:
        """Share of a total brake torque at each wheel, shape (4,)."""
        front = self.front_brake_share
        return _shares(FRONT_BRAKE_SHARE if front is None else front)

    @functools.cached_property
    def static_loaded_radius(self) -> np.ndarray:
        """Distance from each wheel centre to its contact point at rest, shape (4,) (m).

        In model 2 the force of the tire's spring is the load times the cosine of the inclination.
        """
        compression = self.static_tire_compression
        progression = self.per_wheel("tire_progression")
        linear = compression * (1.0 + progression * compression) * np.cos(self.per_wheel("camber"))
        return self.per_wheel("tire_radius") - progressive_compression(linear, progression)

    @functools.cached_property
    def static_wheel_height(self) -> np.ndarray:
        """Height of each wheel centre above the road at rest, in model 2; shape (4,) (m)."""
        return self.static_loaded_radius * np.cos(self.per_wheel("camber"))

    @functools.cached_property
    def travel_curves(self) -> dict[str, dict[str, TravelCurve]]:
        """What changes with the travel of the left wheel of each axle, by the parameters' names."""
        return {axle: curves_of(self, axle) for axle in AXLES}

    def record(self) -> np.ndarray:
        """The vehicle on a level road as input to the equations: one VEHICLE record, shape (1,)."""
        return record_of(self, GRAVITY)
