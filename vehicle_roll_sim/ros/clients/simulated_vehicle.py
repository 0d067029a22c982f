"""The vehicle and model options of a running simulator, read from its parameters."""

from collections.abc import Callable, Sequence

from vehicle_roll_sim.declaration import parameters_of
from vehicle_roll_sim.ros.simulator.parameters import VEHICLE_PREFIX
from vehicle_roll_sim.simulation.options import Options
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.shipped import vehicle_named
from vehicle_roll_sim.vehicle.vehicle_file import LONGITUDINAL, TIRES, tire_of


def simulated_vehicle(ask: Callable[[Sequence[str]], list]) -> tuple[Vehicle, Options]:
    """The vehicle and model options of a simulator.

    ask: returns the values of the parameters of these names. Tire files, and the payload in a
    vehicle file, are read from the paths that the simulator has; raises InputError if they are not
    there.
    """
    known, of_model = parameters_of(Vehicle), list(parameters_of(Options))
    of_vehicle = [name for name, declared in known.items() if declared.default is not None]
    numbers = ask([VEHICLE_PREFIX + name for name in of_vehicle])
    options = Options(**dict(zip(of_model, ask(of_model), strict=True)))
    values = dict(zip(of_vehicle, numbers, strict=True))
    for name in known.keys() - values.keys():
        if found := ask([VEHICLE_PREFIX + name]):  # empty if it was not given
            values[name] = found[0]
    (file,) = ask(["vehicle_file"])
    payload = vehicle_named(file).payload if file else ()
    (longitudinal,) = ask([VEHICLE_PREFIX + LONGITUDINAL])
    tires = {}
    for name in TIRES:
        if found := ask([VEHICLE_PREFIX + name]):
            tires[name] = tire_of(found[0], longitudinal)
    return Vehicle.checked(values, prefix=VEHICLE_PREFIX, payload=payload, **tires), options
