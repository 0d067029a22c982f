"""The rates of a model on a level road, as a function of states and inputs."""

from types import SimpleNamespace

import numpy as np

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.compiled.jit import kernel_argument, silently
from vehicle_roll_sim.model.frames import heading_of, yawed_to_ground
from vehicle_roll_sim.model.integration.derivatives import derivatives_at
from vehicle_roll_sim.model.records import (
    COMMAND,
    OUTPUTS,
    PITCH,
    ROLL,
    STATE_NAMES,
    STATE_SIZE,
    SUSPENSION_COMPRESSION,
    WHEELS,
    YAW,
    Z,
    element_names,
)
from vehicle_roll_sim.simulation.options import MODELS, Options
from vehicle_roll_sim.simulation.plant import Plant
from vehicle_roll_sim.vehicle.air_parameters import has_air_forces
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.suspension_details import with_linear_dampers

INPUT_FIELDS = ("steering", "rear_steering", "wheel_torque", "normal_force")
INPUT_NAMES = tuple(
    f"{name}_{wheel}" if COMMAND[name].shape else name
    for name in INPUT_FIELDS
    for wheel in (WHEELS if COMMAND[name].shape else ("",))
)
"""The smooth inputs of the model; brakes are dry friction, which cannot be linearized at rest."""
_numbers = np.arange(COMMAND.itemsize // 8).astype(np.float64).view(COMMAND)[0]
INPUT_PLACES = np.hstack([_numbers[name] for name in INPUT_FIELDS]).astype(int)
"""Indices of the inputs among the numbers of a COMMAND record."""
GEOMETRY = (
    *("x", "y", "tire_radius", "static_strut_length"),
    "static_suspension_compression",
)
"""Fields of VEHICLE that determine the compression of the tires on a level road."""
WIND_NAMES = ("wind_x", "wind_y")
"""Further inputs of a vehicle with air forces: velocity of the air over the ground, along frame 2
(m/s)."""
WITHOUT_EFFECT = ("x", "y", "yaw")
"""States on which nothing depends on a level road. Height acts only through tire compression."""
TYPICAL = {
    "z": 0.01,
    "roll": 0.1,
    "pitch": 0.01,
    "u": 1.0,
    "v": 1.0,
    "w": 0.1,
    "roll_rate": 0.1,
    "pitch_rate": 0.1,
    "yaw_rate": 0.1,
    "unsprung_velocity": 0.1,
    "suspension_compression": 0.01,
    "tire_compression": 0.01,
    "wheel_speed": 1.0,
    "longitudinal_slip": 0.01,
    "lateral_slip": 0.01,
    "steering": 0.02,
    "rear_steering": 0.02,
    "wheel_torque": 100.0,
    "normal_force": 1000.0,
    "wind_x": 1.0,
    "wind_y": 1.0,
}
"""Changes of comparable significance (SI units, rad): they scale the unknowns, the rates (per
second) and the finite-difference steps."""
ROLL_ON_TIRES = 0.01
"""rad: typical change of the roll angle where it acts through the compression of the tires, as in
model 2; in the others that is a state of its own."""


def typical(names: tuple[str, ...], roll: float = TYPICAL["roll"]) -> np.ndarray:
    """The typical change of each element, by field name, possibly with a wheel; shape (n,)."""
    sizes = (
        TYPICAL
        | {"roll": roll}
        | {f"{name}_{wheel}": TYPICAL[name] for name in TYPICAL for wheel in WHEELS}
    )
    return np.array([sizes[name] for name in names])


class LevelRoadModel:
    """The rates of a model on a level road at any state.

    state_names: the states on which the motion depends, without tire compressions, which follow
    from height, attitude and suspension compression. places: their indices in the state vector.
    input_names: INPUT_NAMES, and WIND_NAMES for a vehicle with air forces. typical_roll: typical
    change of the roll angle (rad).
    Raises InputError for model 1c-iii, whose tire compressions do not follow from these: its turns
    are not steady.
    """

    def __init__(self, vehicle: Vehicle, options: Options):
        if "rates_not_rotated" in MODELS[options.model]:
            allowed = "a model in which height and attitude determine the tire compression"
            raise InputError("model", options.model, allowed)
        self.vehicle, self.options = vehicle, options.for_vehicle(vehicle)
        plant = Plant.of(with_linear_dampers(vehicle), self.options)
        self.record, self.tires = plant.vehicle, plant.tires
        self._plant = plant.arguments()
        car = self.record[0]  # whose fields numpy takes long to find
        self._geometry = SimpleNamespace(**{name: car[name] for name in GEOMETRY})
        self._outputs = np.full(1, np.nan, OUTPUTS)
        left_out = (*WITHOUT_EFFECT, "tire_compression")
        self.state_names = element_names(tuple(s for s in options.states if s not in left_out))
        self.input_names = INPUT_NAMES + (WIND_NAMES if has_air_forces(vehicle) else ())
        self.typical_roll = ROLL_ON_TIRES if options.is_kinematic else TYPICAL["roll"]
        self.places = np.array([STATE_NAMES.index(name) for name in self.state_names])

    @property
    def outputs(self) -> np.record:
        """The OUTPUTS record of the last call of `rates`; a view that the next call overwrites."""
        return self._outputs[0]

    def rates(self, state: np.ndarray, inputs: np.ndarray) -> np.ndarray:
        """Time derivative of a flat state vector, shape (STATE_SIZE,); also updates `outputs`.

        In model 2 also the compression of the tires in `state`, which follows from the others.
        inputs: named by `input_names` (rad, N m, N, m/s). Rates of states that the model does not
        have are nan.
        """
        command, rates = np.zeros(1, COMMAND), np.full(STATE_SIZE, np.nan)
        command.view(np.float64)[INPUT_PLACES] = inputs[: len(INPUT_NAMES)]
        if len(wind := inputs[len(INPUT_NAMES) :]):
            command["wind"] = yawed_to_ground(heading_of(state[YAW]), *wind)
        records = kernel_argument(command), self._plant, kernel_argument(self._outputs)
        with silently():
            derivatives_at(state, *records, rates, True)
        return rates

    def on_flat_road(self, state: np.ndarray) -> np.ndarray:
        """Compression of the tires at the body's height and attitude, shape (4,) (m).

        r0 minus the height of the wheel centre, z + (Ry(pitch) Rx(roll) (x, y, -ls))z.
        """
        car, roll, pitch = self._geometry, state[ROLL], state[PITCH]
        compressed = state[SUSPENSION_COMPRESSION] - car.static_suspension_compression
        strut = car.static_strut_length - compressed
        upward = car.y * np.sin(roll) - strut * np.cos(roll)
        rise = np.cos(pitch) * upward - car.x * np.sin(pitch)
        return car.tire_radius - (state[Z] + rise)
