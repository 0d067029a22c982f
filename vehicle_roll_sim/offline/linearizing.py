"""The linear model about steady driving."""

from vehicle_roll_sim.analysis import linear_model, trim
from vehicle_roll_sim.declaration import InputError, given, number_of
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.simulation.simulation import DEFAULT_SPEED
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.vehicle_file import preset


def linearize(
    vehicle: Vehicle | None = None,
    *,
    options: Options | None = None,
    speed: float = DEFAULT_SPEED,
    steering: float | None = None,
    lateral_acceleration: float | None = None,
) -> linear_model.LinearModel:
    """A, B, C and D about steady driving on a level road, as `vehicle_roll_sim linearize` finds it.

    vehicle: the reference if there is none. speed: forward speed (m/s), held by the rear wheels.
    steering: road-wheel angle (rad, left positive); in its place `lateral_acceleration` (m/s^2),
    for which the steering is found. Straight ahead if there is neither. Raises InputError where
    there is no such steady state, or no slope there.
    """
    if steering is not None and lateral_acceleration is not None:
        raise InputError("lateral_acceleration", lateral_acceleration, "not together with steering")
    turn = {"steering": steering, "lateral_acceleration": lateral_acceleration}
    found = trim.find_trim(
        given("vehicle", preset() if vehicle is None else vehicle, Vehicle),
        given("options", options or Options(), Options),
        speed=number_of(speed, "speed", "a number, in m/s"),
        **{n: number_of(v, n, "a finite number") for n, v in turn.items() if v is not None},
    )
    return linear_model.linearize(found)
