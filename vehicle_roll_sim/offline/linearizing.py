"""Linearization about steady driving."""

from vehicle_roll_sim.analysis import linear_model, trim
from vehicle_roll_sim.input_errors import InputError, given, number_of
from vehicle_roll_sim.simulation.limits import DEFAULT_SPEED
from vehicle_roll_sim.simulation.options import Options, options_for
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
    """Linearize the model about steady driving on a level road, like `vehicle_roll_sim linearize`.

    vehicle: by default the reference vehicle. speed: forward speed (m/s), held by torque at the
    rear wheels. steering: road-wheel angle (rad, left positive). lateral_acceleration: m/s^2, left
    positive; given instead of the steering, which is then determined. Straight ahead by default.
    Returns a LinearModel with A, B, C and D. Raises InputError if there is no such steady state or
    the model cannot be linearized there.
    """
    if steering is not None and lateral_acceleration is not None:
        raise InputError("lateral_acceleration", lateral_acceleration, "not together with steering")
    turn = {"steering": steering, "lateral_acceleration": lateral_acceleration}
    vehicle = given("vehicle", preset() if vehicle is None else vehicle, Vehicle)
    found = trim.find_trim(
        vehicle,
        given("options", options or options_for(vehicle), Options),
        speed=number_of(speed, "speed", "a number, in m/s"),
        **{n: number_of(v, n, "a finite number") for n, v in turn.items() if v is not None},
    )
    return linear_model.linearize(found)
