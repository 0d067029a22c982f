"""The vehicle parameters: the single declaration of names, units, ranges and descriptions."""

import dataclasses

from vehicle_roll_sim.declaration import (
    Curve,
    InputError,
    Table,
    check_alternatives,
    keep_validated,
    parameter,
    parameters_of,
    validated,
)
from vehicle_roll_sim.model.variants import PAPER
from vehicle_roll_sim.vehicle.air_parameters import of_air
from vehicle_roll_sim.vehicle.consistency import ROLL_CENTRES, check_consistency, check_given
from vehicle_roll_sim.vehicle.derived_values import AXLES, BAR_SPELLINGS, DerivedValues
from vehicle_roll_sim.vehicle.differential_parameters import of_differential
from vehicle_roll_sim.vehicle.masses import Load
from vehicle_roll_sim.vehicle.sprung_mass import (
    MASS_SPELLINGS,
    WHOLE,
    Origin,
    as_given,
    sprung_values,
)
from vehicle_roll_sim.vehicle.suspension_parameters import of_axle
from vehicle_roll_sim.vehicle.tire_file import Tire

_LENGTH = {"unit": "m", "minimum": 0.01, "maximum": 50.0}
_INERTIA = {"unit": "kg m^2", "minimum": 1e-3, "maximum": 1e7}
_WHEEL_INERTIA = _INERTIA | {"minimum": 1e-6}
_STIFFNESS = {"unit": "N/m", "minimum": 1.0, "maximum": 1e8}
_DAMPING = {"unit": "N s/m", "minimum": 0.0, "maximum": 1e7}
_MASS = {"unit": "kg", "minimum": 0.01, "maximum": 1e6}
_OFFSET = {"unit": "m", "minimum": -25.0, "maximum": 25.0}
_PRODUCT = {"unit": "kg m^2", "minimum": -1e7, "maximum": 1e7}
_CENTRE = {"unit": "m"} | ROLL_CENTRES
_PRESSURE = {"unit": "Pa", "minimum": 1e4, "maximum": 2e6}
_CAMBER = {"unit": "rad", "minimum": -0.5, "maximum": 0.5}
_ROLL_STIFFNESS = {"unit": "N m/rad", "minimum": 0.0, "maximum": 1e8}
_BAR = {"unit": "N/m", "minimum": 0.0, "maximum": 1e8}
_PATH = {"unit": "m/m", "minimum": -10.0, "maximum": 10.0}
_TURN = {"unit": "rad/m", "minimum": -50.0, "maximum": 50.0}
_LATERAL = _STIFFNESS | {"minimum": 1e3}
PER_AXLE = {
    name: tuple(f"{axle}_{name}" for axle in AXLES) for name in ("tire_radius", "tire_pressure")
}
"""Parameters of both axles, and those of one axle that are given instead."""


@dataclasses.dataclass(frozen=True)
class Vehicle(DerivedValues):
    """A vehicle: the values of a vehicle file, and its tires.

    Units are those of the declarations (SI; `vehicle_roll_sim parameters` lists them).

    The tires are given either as one `tire` for all wheels, or as `front_tire` and `rear_tire`; the
    other attributes are None. `axle_tires` has both, whichever was given. tire_moments,
    contact_patch_shift: the values for which `auto` stands in the options of these names.
    longitudinal: how tire files are read, `from_lateral` or ''. model: with which the vehicle is
    simulated unless another is asked for. stated_at: where values were given (file, line and name),
    for messages.

    payload: masses that the sprung mass carries besides. Of a vehicle with payload or with data of
    the whole vehicle (`total_mass` and so on), the attributes `sprung_mass`, `cg_height` ... are
    those of the sprung mass with its payload, as the equations take them; `given` has the values
    as they were given, and `origin` both. Change such a vehicle with `with_values`.

    The roll centre of an axle is specified either as a depth below the c.g. or as a height above
    the ground; the other attribute is None. The specified value is kept when `cg_height` is
    replaced. `roll_centre_depth` and `roll_centre_height` give both, whichever was specified.

    Raises InputError for a value that is invalid or inconsistent with the others.
    """

    sprung_mass: float | None = parameter(
        "mass carried by the suspension springs", **_MASS, symbol="m", alternative="total_mass"
    )
    roll_inertia: float | None = parameter(
        "moment of inertia of the sprung mass about its x axis",
        **_INERTIA,
        symbol="Jx",
        alternative="total_roll_inertia",
    )
    pitch_inertia: float | None = parameter(
        "moment of inertia of the sprung mass about its y axis",
        **_INERTIA,
        symbol="Jy",
        alternative="total_pitch_inertia",
    )
    yaw_inertia: float | None = parameter(
        "moment of inertia of the sprung mass about its z axis",
        **_INERTIA,
        symbol="Jz",
        alternative="total_yaw_inertia",
    )
    cg_to_front_axle: float | None = parameter(
        "distance from the c.g. of the sprung mass to the front axle",
        **_LENGTH,
        symbol="a",
        alternative="total_cg_to_front_axle",
    )
    cg_to_rear_axle: float | None = parameter(
        "distance from the c.g. of the sprung mass to the rear axle",
        **_LENGTH,
        symbol="b",
        alternative="total_cg_to_rear_axle",
    )
    cg_height: float | None = parameter(
        "height of the c.g. of the sprung mass above ground at rest",
        **_LENGTH,
        symbol="h",
        alternative="total_cg_height",
    )
    total_mass: float | None = parameter(
        "mass of the whole vehicle, instead of its sprung mass", **_MASS, alternative="sprung_mass"
    )
    total_roll_inertia: float | None = parameter(
        "moment of inertia of the whole vehicle about its x axis, instead of that of the sprung "
        "mass",
        **_INERTIA,
        alternative="roll_inertia",
    )
    total_pitch_inertia: float | None = parameter(
        "moment of inertia of the whole vehicle about its y axis, instead of that of the sprung "
        "mass",
        **_INERTIA,
        alternative="pitch_inertia",
    )
    total_yaw_inertia: float | None = parameter(
        "moment of inertia of the whole vehicle about its z axis, instead of that of the sprung "
        "mass",
        **_INERTIA,
        alternative="yaw_inertia",
    )
    total_cg_to_front_axle: float | None = parameter(
        "distance from the c.g. of the whole vehicle to the front axle, instead of that of the "
        "sprung mass",
        **_LENGTH,
        alternative="cg_to_front_axle",
    )
    total_cg_to_rear_axle: float | None = parameter(
        "distance from the c.g. of the whole vehicle to the rear axle, instead of that of the "
        "sprung mass",
        **_LENGTH,
        alternative="cg_to_rear_axle",
    )
    total_cg_height: float | None = parameter(
        "height of the c.g. of the whole vehicle above ground at rest, instead of that of the "
        "sprung mass",
        **_LENGTH,
        alternative="cg_height",
    )
    cg_offset: float | None = parameter(
        "distance of the c.g. of the sprung mass to the left of the middle (model 2); by default 0",
        **_OFFSET,
        default=None,
    )
    total_cg_offset: float | None = parameter(
        "distance of the c.g. of the whole vehicle to the left of the middle, instead of that of "
        "the sprung mass (model 2)",
        **_OFFSET,
        default=None,
    )
    roll_yaw_product: float | None = parameter(
        "product of inertia of the sprung mass, the integral of x z dm (14 DOF models); by default "
        "0",
        **_PRODUCT,
        symbol="Jxz",
        default=None,
    )
    total_roll_yaw_product: float | None = parameter(
        "product of inertia of the whole vehicle, instead of that of the sprung mass",
        **_PRODUCT,
        default=None,
    )
    roll_pitch_product: float | None = parameter(
        "product of inertia of the sprung mass, the integral of x y dm (model 2); by default 0",
        **_PRODUCT,
        symbol="Jxy",
        default=None,
    )
    pitch_yaw_product: float | None = parameter(
        "product of inertia of the sprung mass, the integral of y z dm (model 2); by default 0",
        **_PRODUCT,
        symbol="Jyz",
        default=None,
    )
    front_track: float = parameter("track width of the front axle", **_LENGTH, symbol="cf")
    rear_track: float = parameter("track width of the rear axle", **_LENGTH, symbol="cr")
    front_spring_stiffness: float | None = parameter(
        "spring stiffness at one front wheel, not per axle",
        **_STIFFNESS,
        symbol="ksf",
        alternative="front_spring_force",
    )
    front_spring_force: Table | None = of_axle("front", "spring_force")
    rear_spring_stiffness: float | None = parameter(
        "spring stiffness at one rear wheel, not per axle",
        **_STIFFNESS,
        symbol="ksr",
        alternative="rear_spring_force",
    )
    rear_spring_force: Table | None = of_axle("rear", "spring_force")
    front_damping: float | None = parameter(
        "damping coefficient at one front wheel, not per axle",
        **_DAMPING,
        symbol="bsf",
        alternative="front_damper_force",
    )
    front_damper_force: Table | None = of_axle("front", "damper_force")
    rear_damping: float | None = parameter(
        "damping coefficient at one rear wheel, not per axle",
        **_DAMPING,
        symbol="bsr",
        alternative="rear_damper_force",
    )
    rear_damper_force: Table | None = of_axle("rear", "damper_force")
    front_unsprung_mass: float = parameter(
        "unsprung mass at one front wheel, not per axle", **_MASS, symbol="muf"
    )
    rear_unsprung_mass: float = parameter(
        "unsprung mass at one rear wheel, not per axle", **_MASS, symbol="mur"
    )
    front_tire_stiffness: float | None = parameter(
        "vertical stiffness of one front tire; by default VERTICAL_STIFFNESS of the tire file",
        **_STIFFNESS,
        symbol="ktf",
        default=None,
    )
    rear_tire_stiffness: float | None = parameter(
        "vertical stiffness of one rear tire; by default VERTICAL_STIFFNESS of the tire file",
        **_STIFFNESS,
        symbol="ktr",
        default=None,
    )
    tire_radius: float | None = parameter(
        "unloaded radius of all tires; by default UNLOADED_RADIUS of the tire file",
        **_LENGTH,
        symbol="r0",
        default=None,
    )
    front_tire_radius: float | None = parameter(
        "unloaded radius of the front tires, instead of one radius for all", **_LENGTH, default=None
    )
    rear_tire_radius: float | None = parameter(
        "unloaded radius of the rear tires, instead of one radius for all", **_LENGTH, default=None
    )
    tire_pressure: float | None = parameter(
        "inflation pressure of all tires (version 6 only); by default that of the tire file",
        **_PRESSURE,
        default=None,
    )
    front_tire_pressure: float | None = parameter(
        "inflation pressure of the front tires, instead of one for all", **_PRESSURE, default=None
    )
    rear_tire_pressure: float | None = parameter(
        "inflation pressure of the rear tires, instead of one for all", **_PRESSURE, default=None
    )
    front_tire_lateral_stiffness: float | None = parameter(
        "lateral stiffness of one front tire, for the shift of its contact patch; by default "
        "LATERAL_STIFFNESS of the tire file, else cornering stiffness over relaxation length",
        **_LATERAL,
        default=None,
    )
    rear_tire_lateral_stiffness: float | None = parameter(
        "lateral stiffness of one rear tire, for the shift of its contact patch; by default "
        "LATERAL_STIFFNESS of the tire file, else cornering stiffness over relaxation length",
        **_LATERAL,
        default=None,
    )
    wheel_inertia: float = parameter(
        "moment of inertia of one wheel about its spin axis", **_WHEEL_INERTIA, symbol="Jw"
    )
    front_roll_centre_depth: float | None = parameter(
        "depth of the front roll centre below the c.g. of the sprung mass",
        **_CENTRE,
        symbol="hrcf",
        alternative="front_roll_centre_height",
    )
    front_roll_centre_height: float | None = parameter(
        "height of the front roll centre above ground at rest, instead of its depth",
        **_CENTRE,
        alternative="front_roll_centre_depth",
    )
    rear_roll_centre_depth: float | None = parameter(
        "depth of the rear roll centre below the c.g. of the sprung mass",
        **_CENTRE,
        symbol="hrcr",
        alternative="rear_roll_centre_height",
    )
    rear_roll_centre_height: float | None = parameter(
        "height of the rear roll centre above ground at rest, instead of its depth",
        **_CENTRE,
        alternative="rear_roll_centre_depth",
    )
    steering_ratio: float | None = parameter(
        "ratio of handwheel angle to road-wheel angle",
        minimum=0.1,
        maximum=100.0,
        alternative="steering_gear",
    )
    steering_gear: Table | None = parameter(
        "road-wheel angle over handwheel angle, instead of a constant steering ratio; rising, 0 "
        "at 0",
        "rad",
        -3.0,
        3.0,
        over=("handwheel angle", 50.0),
        alternative="steering_ratio",
    )
    minimum_relaxation_length: float = parameter(
        "lower limit of the tires' relaxation lengths", "m", 0.01, 5.0, default=0.1
    )
    rolling_resistance_coefficient: float = parameter(
        "ratio of a wheel's rolling resistance to its normal load", "", 0.0, 1.0, default=0.0
    )
    drag_area: float = parameter(
        "drag coefficient times frontal area", "m^2", 0.0, 100.0, default=0.0
    )
    front_camber: float = parameter(
        "static camber of the front wheels, positive with their tops outwards",
        **_CAMBER,
        default=0.0,
    )
    rear_camber: float = parameter(
        "static camber of the rear wheels, positive with their tops outwards",
        **_CAMBER,
        default=0.0,
    )
    front_anti_roll_bar_stiffness: float | None = parameter(
        "roll stiffness of the front anti-roll bar, between body and road; by default 0",
        **_ROLL_STIFFNESS,
        default=None,
    )
    front_anti_roll_bar_rate: float | None = parameter(
        "the same at the wheels: force on each per difference of their travels",
        **_BAR,
        default=None,
    )
    rear_anti_roll_bar_stiffness: float | None = parameter(
        "roll stiffness of the rear anti-roll bar, between body and road; by default 0",
        **_ROLL_STIFFNESS,
        default=None,
    )
    rear_anti_roll_bar_rate: float | None = parameter(
        "the same at the wheels: force on each per difference of their travels",
        **_BAR,
        default=None,
    )
    front_half_track_change: Curve | None = parameter(
        "front wheels: displacement of the contact point outwards with wheel travel (model "
        "2); by default along the line that gives the roll centre",
        **_PATH,
        default=None,
    )
    front_longitudinal_change: Curve | None = parameter(
        "front wheels: displacement of the wheel centre forwards with wheel travel (model 2); "
        "by default 0",
        **_PATH,
        default=None,
    )
    front_camber_change: Curve | None = parameter(
        "front wheels: camber with wheel travel, positive with the top outwards (model 2); by "
        "default 0",
        **_TURN,
        default=None,
    )
    front_toe_change: Curve | None = parameter(
        "front wheels: toe-in with wheel travel (model 2); by default 0",
        **_TURN,
        default=None,
    )
    front_carrier_pitch_change: Curve | None = parameter(
        "front wheels: turn of the wheel carrier with wheel travel, positive with its top "
        "forwards (model 2); by default 0",
        **_TURN,
        default=None,
    )
    rear_half_track_change: Curve | None = parameter(
        "rear wheels: displacement of the contact point outwards with wheel travel (model 2); "
        "by default along the line that gives the roll centre",
        **_PATH,
        default=None,
    )
    rear_longitudinal_change: Curve | None = parameter(
        "rear wheels: displacement of the wheel centre forwards with wheel travel (model 2); "
        "by default 0",
        **_PATH,
        default=None,
    )
    rear_camber_change: Curve | None = parameter(
        "rear wheels: camber with wheel travel, positive with the top outwards (model 2); by "
        "default 0",
        **_TURN,
        default=None,
    )
    rear_toe_change: Curve | None = parameter(
        "rear wheels: toe-in with wheel travel (model 2); by default 0",
        **_TURN,
        default=None,
    )
    rear_carrier_pitch_change: Curve | None = parameter(
        "rear wheels: turn of the wheel carrier with wheel travel, positive with its top "
        "forwards (model 2); by default 0",
        **_TURN,
        default=None,
    )
    front_rebound_damping: float | None = of_axle("front", "rebound_damping")
    front_spring_motion_ratio: Curve | None = of_axle("front", "spring_motion_ratio")
    front_damper_motion_ratio: Curve | None = of_axle("front", "damper_motion_ratio")
    front_bump_stop_clearance: float | None = of_axle("front", "bump_stop_clearance")
    front_bump_stop_stiffness: float | None = of_axle("front", "bump_stop_stiffness")
    front_bump_stop_progression: float | None = of_axle("front", "bump_stop_progression")
    front_rebound_stop_clearance: float | None = of_axle("front", "rebound_stop_clearance")
    front_rebound_stop_stiffness: float | None = of_axle("front", "rebound_stop_stiffness")
    front_rebound_stop_progression: float | None = of_axle("front", "rebound_stop_progression")
    front_toe: float | None = of_axle("front", "toe")
    front_roll_steer: float | None = of_axle("front", "roll_steer")
    front_lateral_force_steer: float | None = of_axle("front", "lateral_force_steer")
    front_aligning_moment_steer: float | None = of_axle("front", "aligning_moment_steer")
    rear_rebound_damping: float | None = of_axle("rear", "rebound_damping")
    rear_spring_motion_ratio: Curve | None = of_axle("rear", "spring_motion_ratio")
    rear_damper_motion_ratio: Curve | None = of_axle("rear", "damper_motion_ratio")
    rear_bump_stop_clearance: float | None = of_axle("rear", "bump_stop_clearance")
    rear_bump_stop_stiffness: float | None = of_axle("rear", "bump_stop_stiffness")
    rear_bump_stop_progression: float | None = of_axle("rear", "bump_stop_progression")
    rear_rebound_stop_clearance: float | None = of_axle("rear", "rebound_stop_clearance")
    rear_rebound_stop_stiffness: float | None = of_axle("rear", "rebound_stop_stiffness")
    rear_rebound_stop_progression: float | None = of_axle("rear", "rebound_stop_progression")
    rear_toe: float | None = of_axle("rear", "toe")
    rear_roll_steer: float | None = of_axle("rear", "roll_steer")
    rear_lateral_force_steer: float | None = of_axle("rear", "lateral_force_steer")
    rear_aligning_moment_steer: float | None = of_axle("rear", "aligning_moment_steer")
    ackermann_percentage: float | None = parameter(
        "share of Ackermann geometry in the steering of the front wheels: 0 is parallel, with 100 "
        "their axes meet on that of the rear axle; by default 0",
        "%",
        -200.0,
        200.0,
        default=None,
    )
    engine_drag: float | None = parameter(
        "braking torque of the engine at each driven wheel per its speed; by default 0",
        "N m s/rad",
        0.0,
        1e4,
        default=None,
    )
    air_density: float | None = of_air("air_density")
    side_force_area: float | None = of_air("side_force_area")
    pressure_centre_ahead: float | None = of_air("pressure_centre_ahead")
    pressure_centre_height: float | None = of_air("pressure_centre_height")
    front_lift_area: float | None = of_air("front_lift_area")
    rear_lift_area: float | None = of_air("rear_lift_area")
    front_drive_share: float | None = parameter(
        "share of a total drive torque that the front wheels get: 0 is rear-wheel drive, 1 front-"
        "wheel drive; by default 0, and speed_cmd drives all wheels alike",
        "",
        0.0,
        1.0,
        default=None,
    )
    front_brake_share: float | None = parameter(
        "share of a total brake torque that the front wheels get; by default 0.6",
        "",
        0.0,
        1.0,
        default=None,
    )
    front_differential_damping: float | None = of_differential("damping", "front")
    rear_differential_damping: float | None = of_differential("damping", "rear")
    front_differential_preload: float | None = of_differential("preload", "front")
    rear_differential_preload: float | None = of_differential("preload", "rear")
    front_differential_locking: float | None = of_differential("locking", "front")
    rear_differential_locking: float | None = of_differential("locking", "rear")
    tire: Tire | None = dataclasses.field(kw_only=True, default=None)
    front_tire: Tire | None = dataclasses.field(kw_only=True, default=None)
    rear_tire: Tire | None = dataclasses.field(kw_only=True, default=None)
    tire_moments: bool = dataclasses.field(kw_only=True, default=True)
    contact_patch_shift: bool = dataclasses.field(kw_only=True, default=True)
    longitudinal: str = dataclasses.field(kw_only=True, default="")
    payload: tuple[Load, ...] = dataclasses.field(kw_only=True, default=())
    origin: Origin | None = dataclasses.field(kw_only=True, default=None, repr=False, compare=False)
    model: str = dataclasses.field(kw_only=True, default=PAPER)
    stated_at: dict = dataclasses.field(
        kw_only=True, default_factory=dict, compare=False, repr=False
    )

    def __post_init__(self):
        self._keep(as_given(self))
        keep_validated(self, self.given)
        check_alternatives(Vehicle, self.given)
        check_given(self, PER_AXLE)
        given = self.given
        if derived := sprung_values(self):
            self._keep(derived | {"origin": Origin(given, derived)})
        check_consistency(self)

    def _keep(self, values: dict) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)

    @classmethod
    def checked(
        cls, values: dict, tire: Tire | None = None, prefix: str = "", **others
    ) -> "Vehicle":
        """Build a vehicle from these values. others: fields that are not numbers.

        Raises InputError naming the invalid value, preceded by `prefix`.
        """
        numbers = validated(cls, values, prefix)
        try:
            return cls(**numbers, tire=tire, **others)
        except InputError as error:  # inconsistent values
            field = prefix + error.field
            raise InputError(field, error.value, error.allowed, error.problem) from None

    def with_values(self, values: dict, prefix: str = "") -> "Vehicle":
        """A copy with some values replaced; raises InputError like `checked`.

        A value also replaces its alternative: a roll centre height, for instance, the depth; the
        radius or pressure of one axle leaves the other axle the common one.
        """
        known, given = parameters_of(Vehicle), self.given
        kept = {n: value for n, value in given.items() if known[n].alternative not in values}
        spellings = (*BAR_SPELLINGS, *MASS_SPELLINGS)
        for name, other in (*spellings, *((b, a) for a, b in spellings)):
            if name in values:
                kept.pop(other, None)
        for both, single in PER_AXLE.items():
            if both in values:
                kept = {name: value for name, value in kept.items() if name not in single}
            elif both in kept and values.keys() & {*single}:
                kept |= dict.fromkeys(single, kept.pop(both))
        places = self.stated_at | {name: prefix + name for name in values}
        others = self.not_numbers | {"stated_at": places}
        return self.checked(kept | values, prefix=prefix, **others)

    @property
    def given(self) -> dict[str, float]:
        """Every given value by name; of two alternatives, only the one that was specified.

        Not what `origin.derived` has.
        """
        if self.origin:
            return dict(self.origin.given)
        known = parameters_of(Vehicle)
        values = {name: getattr(self, name) for name in known}
        return {n: v for n, v in values.items() if v is not None or known[n].default is not None}

    @property
    def not_numbers(self) -> dict:
        """The fields that are not parameters: tires, payload, and what is on by default."""
        names = {field.name for field in dataclasses.fields(self)} - {*parameters_of(Vehicle)}
        names.remove("origin")
        return {name: getattr(self, name) for name in names}

    def with_depths(self) -> "Vehicle":
        """The same vehicle, bit for bit, as its sprung mass with depths of roll centres."""
        depths = {
            f"{axle}_roll_centre_depth": float(self.roll_centre_depth[wheel])
            for axle, wheel in AXLES.items()
        }
        if not self.origin:
            return self.with_values(depths)
        values = {n: v for n, v in self.given.items() if n not in WHOLE and "roll_centre" not in n}
        values |= {n: v for n, v in self.origin.derived.items() if v is not None}
        return self.checked(values | depths, **self.not_numbers | {"payload": ()})
