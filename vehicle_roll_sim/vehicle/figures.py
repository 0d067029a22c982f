"""Figures of a vehicle at rest that follow from its data alone, in closed form."""

import dataclasses
import math

import numpy as np

from vehicle_roll_sim.model.records import LF, LR
from vehicle_roll_sim.vehicle.derived_values import AXLES, GRAVITY
from vehicle_roll_sim.vehicle.parameters import Vehicle


@dataclasses.dataclass(frozen=True)
class AxleFigures:
    """One axle of a vehicle at rest on a level road.

    wheel_load: normal force of one tire, the mean of both (N). spring_compression,
    tire_compression: static, of one corner (m). ride_rate: vertical stiffness of one corner between
    body and road, spring and tire in series (N/m). ride_frequency: of the sprung mass that the axle
    carries on its ride rates, without damping and pitch coupling (Hz). hop_frequency: of an
    unsprung mass between spring and tire (Hz). damping_ratio: of the sprung mass on its springs.
    spring_roll_stiffness, bar_roll_stiffness, tire_roll_stiffness: of the axle's springs, its
    anti-roll bar and its tires (N m/rad). roll_stiffness: of springs and bar in series with the
    tires (N m/rad). roll_centre_height: above the road (m).
    """

    wheel_load: float
    spring_compression: float
    tire_compression: float
    ride_rate: float
    ride_frequency: float
    hop_frequency: float
    damping_ratio: float
    spring_roll_stiffness: float
    bar_roll_stiffness: float
    tire_roll_stiffness: float
    roll_stiffness: float
    roll_centre_height: float


@dataclasses.dataclass(frozen=True)
class VehicleFigures:
    """A whole vehicle at rest.

    mass: kg. wheelbase: m. cg_to_front_axle, cg_height: of the whole vehicle's c.g. (m).
    left_share: of the weight that the left wheels carry. static_stability_factor: mean track over
    twice that height. roll_axis_depth: of the roll axis below the sprung c.g. (m). roll_stiffness:
    of both axles (N m/rad). front_share: of the roll stiffness. roll_gradient: of a rigid body on
    its roll axis, (rad/(m/s^2)); inf if its weight overcomes its roll stiffness. roll_frequency: of
    that body, without damping (Hz); 0 likewise. axles: by name.
    """

    mass: float
    wheelbase: float
    cg_to_front_axle: float
    cg_height: float
    left_share: float
    static_stability_factor: float
    roll_axis_depth: float
    roll_stiffness: float
    front_share: float
    roll_gradient: float
    roll_frequency: float
    axles: dict[str, AxleFigures]


def figures_of(vehicle: Vehicle) -> VehicleFigures:
    """The figures of a vehicle."""
    axles = {axle: _axle(vehicle, axle) for axle in AXLES}
    unsprung = vehicle.per_wheel("unsprung_mass")
    carried = vehicle.sprung_mass * vehicle.axle_load_share + unsprung
    wheels = vehicle.per_wheel("tire_radius") - vehicle.static_tire_compression
    moment = vehicle.sprung_mass * vehicle.cg_height + float(unsprung @ wheels)
    height = moment / vehicle.mass
    wheelbase = vehicle.cg_to_front_axle + vehicle.cg_to_rear_axle
    rear_mass = vehicle.sprung_mass * vehicle.cg_to_front_axle / wheelbase + unsprung[2:].sum()
    depth = float(vehicle.axle_load_share @ vehicle.roll_centre_depth)
    stiffness = math.fsum(axle.roll_stiffness for axle in axles.values())
    inertia = vehicle.roll_inertia + vehicle.sprung_mass * depth**2
    left = stiffness - vehicle.sprung_mass * GRAVITY * depth
    return VehicleFigures(
        mass=vehicle.mass,
        wheelbase=wheelbase,
        cg_to_front_axle=float(rear_mass * wheelbase / vehicle.mass),
        cg_height=height,
        left_share=float(carried[[LF, LR]].sum() / vehicle.mass),
        static_stability_factor=(vehicle.front_track + vehicle.rear_track) / (4 * height),
        roll_axis_depth=depth,
        roll_stiffness=stiffness,
        front_share=axles["front"].roll_stiffness / stiffness,
        roll_gradient=vehicle.sprung_mass * depth / left if left > 0.0 else math.inf,
        roll_frequency=math.sqrt(max(left, 0.0) / inertia) / math.tau,
        axles=axles,
    )


def _axle(vehicle: Vehicle, axle: str) -> AxleFigures:
    sides = slice(AXLES[axle], AXLES[axle] + 2)
    names = ("spring_stiffness", "damping", "unsprung_mass", "track")
    spring, damping, unsprung, track = (
        float(vehicle.per_wheel(name)[AXLES[axle]]) for name in names
    )
    tire = float(np.mean(vehicle.tire_stiffness_at_rest[sides]))
    sprung = vehicle.sprung_mass * float(np.mean(vehicle.axle_load_share[sides]))
    ride_rate = spring * tire / (spring + tire)
    springs, tires = (stiffness * track**2 / 2 for stiffness in (spring, tire))
    bar = float(vehicle.bar_rate[AXLES[axle]]) * track**2
    return AxleFigures(
        wheel_load=(sprung + unsprung) * GRAVITY,
        spring_compression=float(np.mean(vehicle.static_suspension_compression[sides])),
        tire_compression=float(np.mean(vehicle.static_tire_compression[sides])),
        ride_rate=ride_rate,
        ride_frequency=math.sqrt(ride_rate / sprung) / math.tau,
        hop_frequency=math.sqrt((spring + tire) / unsprung) / math.tau,
        damping_ratio=damping / (2 * math.sqrt(spring * sprung)),
        spring_roll_stiffness=springs,
        bar_roll_stiffness=bar,
        tire_roll_stiffness=tires,
        roll_stiffness=(springs + bar) * tires / (springs + bar + tires),
        roll_centre_height=float(vehicle.roll_centre_height[AXLES[axle]]),
    )
