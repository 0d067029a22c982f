"""What follows from a vehicle's parameters: static equilibrium, and the record for the model."""

import functools

import numpy as np

from vehicle_roll_sim.model.equilibrium import (
    axle_load_share,
    static_strut_length,
    static_tire_compression,
)
from vehicle_roll_sim.model.records import VEHICLE, WHEEL_COUNT
from vehicle_roll_sim.model.tire.coefficients import on_axles
from vehicle_roll_sim.vehicle.air_parameters import air_of
from vehicle_roll_sim.vehicle.axle_tires import (
    FromTire,
    from_tire,
    lateral_stiffness,
)
from vehicle_roll_sim.vehicle.differential_parameters import differentials_of
from vehicle_roll_sim.vehicle.masses import MOMENTS, PRODUCTS
from vehicle_roll_sim.vehicle.steering_gear import Gear
from vehicle_roll_sim.vehicle.suspension_details import (
    compressions_at_rest,
    details_of,
    mean_damping,
    stiffnesses_at_rest,
)
from vehicle_roll_sim.vehicle.suspension_parameters import AXLES
from vehicle_roll_sim.vehicle.tire.moments import OVERTURNING, has_moment
from vehicle_roll_sim.vehicle.tire_file import Tire
from vehicle_roll_sim.vehicle.travel_curves import TravelCurve, tabulated

GRAVITY = 9.81
"""m/s^2, the value used in the paper."""
SIDES = np.array([1.0, -1.0, 1.0, -1.0])
"""Of the wheels: left is positive."""
FRONT_BRAKE_SHARE = 0.6
"""Share of a total brake torque at the front axle, if none is given."""
LINEAR = {"spring_stiffness": "stiffness_at_rest", "damping": "mean_damping"}
"""Parameters of each axle that may be tables, and the values of linear models in their place."""
BAR_SPELLINGS = tuple(
    (f"{axle}_anti_roll_bar_stiffness", f"{axle}_anti_roll_bar_rate") for axle in AXLES
)
"""The two parameters of each bar, of which a vehicle has at most one."""
TRAVEL_SIGNS = {
    "half_track_change": 1.0,
    "longitudinal_change": 1.0,
    "camber_change": -1.0,
    "toe_change": -1.0,
    "carrier_pitch_change": 1.0,
}
"""Parameters of each axle that are curves over wheel travel, and the sign with which they are
displacements, or rotations of a left wheel about the axes, of frame 1."""


def _times(given: float | tuple, sign: float) -> float | tuple:
    """A curve times a sign."""
    if isinstance(given, tuple):
        return tuple((travel, sign * value) for travel, value in given)
    return sign * float(given)


def _shares(front: float) -> np.ndarray:
    """The share of each wheel, shape (4,), both wheels of an axle alike."""
    return np.array([front, front, 1.0 - front, 1.0 - front]) / 2.0


class DerivedValues:
    """Properties of a Vehicle, all derived from what was given."""

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
            for name in ("tire_radius", "tire_stiffness"):
                if self.at_axle(axle, name) is None:
                    found[f"{axle}_{name}"] = from_tire(name, axle, tire, pressure)
        return found

    @functools.cached_property
    def lateral_stiffness_from_tires(self) -> dict[str, FromTire]:
        """The lateral stiffnesses of the tires of each axle that are not given, by name (N/m)."""
        loads = self.static_tire_compression * self.per_wheel("tire_stiffness")
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
            GRAVITY,
        )

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
        """Distance from each wheel centre to its contact point at rest, shape (4,) (m)."""
        flattening = self.static_tire_compression * np.cos(self.per_wheel("camber"))
        return self.per_wheel("tire_radius") - flattening

    @functools.cached_property
    def static_wheel_height(self) -> np.ndarray:
        """Height of each wheel centre above the road at rest, in model 2; shape (4,) (m)."""
        return self.static_loaded_radius * np.cos(self.per_wheel("camber"))

    @functools.cached_property
    def travel_curves(self) -> dict[str, dict[str, TravelCurve]]:
        """What changes with the travel of the left wheel of each axle: HALF_TRACK to CARRIER_PITCH.

        By the names of the parameters, but with the signs of rotations about the body's axes.
        Without a half-track change the contact point moves at right angles to the line from it to
        the roll centre.
        """
        return {
            axle: {
                f"{axle}_{name}": TravelCurve(_times(self._over_travel(axle, name), sign))
                for name, sign in TRAVEL_SIGNS.items()
            }
            for axle in AXLES
        }

    def _over_travel(self, axle: str, name: str) -> float | tuple:
        given = getattr(self, f"{axle}_{name}")
        if given is not None:
            return given
        height = self.cg_height - self.roll_centre_depth[AXLES[axle]]  # the same for either measure
        slope = 2 * height / getattr(self, f"{axle}_track")
        return slope if name == "half_track_change" else 0.0

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
        return self.from_tires[f"{axle}_{name}"].value if value is None else value

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

    def record(self) -> np.ndarray:
        """The vehicle on a level road as input to the equations: one VEHICLE record, shape (1,).

        Each field takes the attribute of its name, or the values front_NAME and rear_NAME, or comes
        from `_placement`. Raises AttributeError for a field that has none of these.
        """
        placement, vehicle = self._placement(), np.zeros(1, VEHICLE)
        for name in VEHICLE.names:
            if name in placement:
                vehicle[name] = placement[name]
            elif hasattr(self, name):
                vehicle[name] = getattr(self, name)
            else:
                vehicle[name] = self.per_wheel(name)
        return vehicle

    def tires(self, moments: bool = False) -> np.ndarray:
        """The tires of front and rear axle as input to the equations: TIRE records, shape (2,).

        moments: whether their moments are computed; with the radius of the vehicle if the tire file
        has none.
        """
        records = []
        for axle, tire in self.axle_tires.items():
            record = tire.record(self.at_axle(axle, "tire_pressure"), moments)
            if record["UNLOADED_RADIUS"] == 0.0:
                record["UNLOADED_RADIUS"] = self._known_at_axle(axle, "tire_radius")
            records.append(record)
        return on_axles(*records)

    def _placement(self) -> dict:
        """Where and how the wheels stand, air forces, and gravity (m/s^2).

        x, y: in the plane of the c.g. (m). camber: positive with the top towards the right (rad).
        tire_lateral_compliance: 0, as for a contact patch that does not shift. engine_drag: at the
        driven wheels (N m s/rad).
        """
        front, rear = self.cg_to_front_axle, -self.cg_to_rear_axle
        camber = self.per_wheel("camber") * (-1, 1, -1, 1)
        of_axles = [tabulated([*curves.values()]) for curves in self.travel_curves.values()]
        knots, origins, curves = zip(*of_axles, strict=True)
        return {
            "x": (front, front, rear, rear),
            "y": self.wheel_places,
            **{name: self.inertias[name] for name in PRODUCTS},
            "camber": camber,
            "camber_sine": np.sin(camber),
            "camber_cosine": np.cos(camber),
            "tire_radius": self.per_wheel("tire_radius"),
            "tire_lateral_compliance": 0.0,
            "engine_drag": np.where(self.drive_shares > 0.0, self.engine_drag or 0.0, 0.0),
            **differentials_of(self),
            "travel_knots": knots,
            "travel_origins": origins,
            "travel_curves": curves,
            "details": details_of(self, GRAVITY),
            **air_of(self),
            "gravity": GRAVITY,
            "gravity_along": 0.0,
            "gravity_across": 0.0,
        }
