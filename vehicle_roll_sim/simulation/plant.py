"""The plant: a vehicle, its tires and the options of the model, as the equations take them."""

from typing import NamedTuple

import numpy as np

from vehicle_roll_sim.declaration import ON
from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.road.layout import PLANE, USED
from vehicle_roll_sim.model.tire.coefficients import as_one
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.suspension_use import use_details
from vehicle_roll_sim.vehicle.consistency import check_one_rolling_resistance
from vehicle_roll_sim.vehicle.derived_values import GRAVITY
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.plausibility import doubts, warn


class Plant(NamedTuple):
    """The records of one simulated vehicle, in arrays of shape (1,), for tires (2,).

    vehicle: VEHICLE, with the gravity of its road. tires: TIRE, of front and rear axle. options:
    OPTIONS. ground: the features of the road (see `model.road.layout`), an array of numbers.
    """

    vehicle: np.ndarray
    tires: np.ndarray
    options: np.ndarray
    ground: np.ndarray

    @classmethod
    def of(cls, vehicle: Vehicle, options: Options, road: Road | None = None) -> "Plant":
        """That of a vehicle, on a level road unless one is given.

        Warns (PlausibilityWarning) of values that are not plausible. Raises InputError if tire file
        and vehicle both have a rolling resistance, and for details of the suspension that the model
        does not use.
        """
        warn(doubts(vehicle))
        options = options.for_vehicle(vehicle)
        has_moments = options.tire_moments == ON
        if has_moments:
            check_one_rolling_resistance(vehicle)
        record = vehicle.record()
        tires = vehicle.tires(has_moments)
        use_details(record, tires, vehicle, options)
        if options.contact_patch_shift == ON:
            record["tire_lateral_compliance"] = vehicle.contact_patch_compliance(has_moments)
        flags, ground = options.record(), PLANE
        if road:
            gravity = road.resting_gravity(GRAVITY)
            record["gravity"], record["gravity_along"], record["gravity_across"] = gravity
            ground = road.ground()
            road.check_model(options)
        if ground[USED]:
            flags["contact_moments"] = True
        return cls(record, tires, flags, ground)

    def arguments(self, *others: np.ndarray) -> tuple:
        """The records, with `others` and the ground after them, as kernels take them."""
        records = (self.vehicle, as_one(self.tires), self.options, *others)
        return (*(kernel_argument(record) for record in records), self.ground)
