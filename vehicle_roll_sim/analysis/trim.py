"""Trim: steady driving straight ahead or in a turn.

The unknowns are the state, the torque at both rear wheels that holds the speed, and the steering if
a lateral acceleration is given. They are the root of the rates of all states on which the motion
depends. Position, heading and wheel angles keep changing without affecting the rest. Height is
included, because it determines the tire compressions.
"""

import dataclasses
import math

import numpy as np
from scipy import optimize

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.compiled.jit import kernel_argument, silently
from vehicle_roll_sim.model.equilibrium import equilibrium
from vehicle_roll_sim.model.integration.derivatives import derivatives
from vehicle_roll_sim.model.integration.events import MINIMUM_SPEED
from vehicle_roll_sim.model.kinematic.contact import note_tire_compression
from vehicle_roll_sim.model.records import (
    COMMAND,
    OUTPUTS,
    STATE,
    STATE_NAMES,
    STATE_SIZE,
    TIRE_COMPRESSION,
    WHEELS,
    U,
    element_names,
)
from vehicle_roll_sim.model.tire.transient_slip import LOW_SPEED
from vehicle_roll_sim.model.wheel import note_turning
from vehicle_roll_sim.simulation.options import MODELS, Options, options_for
from vehicle_roll_sim.simulation.plant import Plant
from vehicle_roll_sim.simulation.simulation import MAXIMUM_SPEED
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.suspension_details import with_linear_dampers

INPUT_FIELDS = ("steering", "rear_steering", "wheel_torque", "normal_force")
INPUT_NAMES = tuple(
    f"{name}_{wheel}" if COMMAND[name].shape else name
    for name in INPUT_FIELDS
    for wheel in (WHEELS if COMMAND[name].shape else ("",))
)
"""The smooth inputs of the model; brakes are dry friction, which cannot be linearized at rest."""
STEERING, REAR_TORQUES = 0, slice(4, 6)
"""Indices among the inputs."""
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
}
"""Changes of comparable significance (SI units, rad): they scale the unknowns, the rates (per
second) and the finite-difference steps."""
LARGEST_STEERING, LARGEST_ACCELERATION = math.radians(1.0), 0.5
"""rad and m/s^2: the turn is tightened in steps of at most this size, so that the steady state
found is the one that a driver reaches from straight ahead."""
STEP = 1e-4
"""Finite-difference step of the Jacobian, in typical changes; the root finder's own step is so
small that rounding prevails."""
STEADY = 1e-8
"""Largest rate that counts as steady, in typical changes per second; rounding is about 1e-10."""


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
    typical_roll: typical change of the roll angle (rad).
    Raises InputError for model 1c-iii, in which they do not follow: its turns are not steady.
    """

    def __init__(self, vehicle: Vehicle, options: Options):
        if "rates_not_rotated" in MODELS[options.model]:
            allowed = "a model in which height and attitude determine the tire compression"
            raise InputError("model", options.model, allowed)
        self.vehicle, self.options = vehicle, options.for_vehicle(vehicle)
        plant = Plant.of(with_linear_dampers(vehicle), self.options)
        self.record, self.tires = plant.vehicle, plant.tires
        self._plant = plant.parts()
        self._outputs = np.full(1, np.nan, OUTPUTS)
        left_out = (*WITHOUT_EFFECT, "tire_compression")
        self.state_names = element_names(tuple(s for s in options.states if s not in left_out))
        self.typical_roll = ROLL_ON_TIRES if options.is_kinematic else TYPICAL["roll"]
        self.places = np.array([STATE_NAMES.index(name) for name in self.state_names])

    @property
    def outputs(self) -> np.record:
        """The OUTPUTS record of the last call of `rates`; a view that the next call overwrites."""
        return self._outputs[0]

    def rates(self, state: np.ndarray, inputs: np.ndarray) -> np.ndarray:
        """Time derivative of a flat state vector, shape (STATE_SIZE,); also updates `outputs`.

        In model 2 also the compression of the tires in `state`, which follows from the others.
        inputs: named by INPUT_NAMES, shape (10,) (rad, N m, N). Rates of states that the model does
        not have are nan.
        """
        command, rates = np.zeros(1, COMMAND), np.full(STATE_SIZE, np.nan)
        for name, value in zip(INPUT_FIELDS, np.split(inputs, (1, 2, 6)), strict=True):
            command[name] = value if COMMAND[name].shape else value[0]
        outputs = kernel_argument(self._outputs)[0]
        with silently():
            note_turning(state, outputs)
            derivatives(state, kernel_argument(command)[0], *self._plant, outputs, rates)
            note_tire_compression(state, self._plant[-1], outputs)
        return rates

    def on_flat_road(self, state: np.ndarray) -> np.ndarray:
        """Compression of the tires at the body's height and attitude, shape (4,) (m).

        r0 minus the height of the wheel centre, z + (Ry(pitch) Rx(roll) (x, y, -ls))z.
        """
        now, car = state.view(STATE)[0], self.record[0]
        compressed = now.suspension_compression - car.static_suspension_compression
        strut = car.static_strut_length - compressed
        upward = car.y * np.sin(now.roll) - strut * np.cos(now.roll)
        rise = np.cos(now.pitch) * upward - car.x * np.sin(now.pitch)
        return car.tire_radius - (now.z + rise)


@dataclasses.dataclass(frozen=True)
class Trim:
    """A steady state, in SI units and radians.

    state: flat vector named by STATE_NAMES; position and heading are 0, states that the model does
    not have nan. inputs: named by INPUT_NAMES, shape (10,). outputs: the corresponding OUTPUTS
    record.
    """

    plant: LevelRoadModel
    state: np.ndarray
    inputs: np.ndarray
    outputs: np.record

    @property
    def drive_torque(self) -> float:
        """Torque at each rear wheel that holds the speed (N m)."""
        return float(self.inputs[REAR_TORQUES][0])


def find_trim(
    vehicle: Vehicle,
    options: Options | None = None,
    *,
    speed: float,
    steering: float = 0.0,
    lateral_acceleration: float | None = None,
) -> Trim:
    """Find steady driving at a forward speed u (m/s), held by equal torques at the rear wheels.

    steering: road-wheel angle (rad). lateral_acceleration: of the sprung c.g. (m/s^2); if it is
    given, the steering is determined. Raises InputError if there is no such steady state with four
    wheels on the ground, or if it is too slow for the tire model to be smooth.
    """
    model = LevelRoadModel(vehicle, options or options_for(vehicle))
    slowest = MINIMUM_SPEED if model.options.steady_state_slip else LOW_SPEED
    if not slowest <= speed <= MAXIMUM_SPEED:
        raise InputError("speed", speed, f"from {slowest:g} to {MAXIMUM_SPEED:g} m/s")
    is_turn_given = lateral_acceleration is not None
    field = "lateral_acceleration" if is_turn_given else "steering"
    wanted = lateral_acceleration if is_turn_given else steering
    if not math.isfinite(wanted):
        raise InputError(field, wanted, "a finite number")
    standing = equilibrium(model.record, model.tires, speed).view(np.float64)
    trim = _solution(model, standing, np.zeros(len(INPUT_NAMES)), "steering", 0.0)
    if trim is None:
        raise InputError("speed", speed, "a speed that the rear wheels can hold straight ahead")
    _check_rolls(trim)
    for target in _targets(wanted, LARGEST_ACCELERATION if is_turn_given else LARGEST_STEERING):
        within = _in_words(trim, field)
        trim = _solution(model, trim.state, trim.inputs, field, target)
        if trim is None:
            beyond = "in tighter turns a wheel lifts or slides"
            raise InputError(field, wanted, f"at most {within}, {beyond}")
        _check_rolls(trim)
    return trim


def _targets(wanted: float, largest: float) -> np.ndarray:
    """Equal steps from straight ahead (0, excluded) to a value, none larger than `largest`."""
    return np.linspace(0.0, wanted, math.ceil(abs(wanted) / largest) + 1)[1:]


def _solution(
    model: LevelRoadModel, state: np.ndarray, inputs: np.ndarray, field: str, target: float
) -> Trim | None:
    """The steady state near a flat state vector, at its speed; None if there is none.

    Also None with a wheel off the ground: its spin is undetermined, or grows if it is driven.
    field, target: the given quantity, steering (rad) or lateral acceleration (m/s^2).
    """
    state, inputs = state.copy(), inputs.copy()
    free = model.places[model.places != U]
    states = typical(model.state_names, model.typical_roll)
    torque, angle = TYPICAL["wheel_torque"], TYPICAL["steering"]
    scale = np.array([*states[model.places != U], torque, angle])

    def put(unknowns: np.ndarray) -> np.ndarray:
        """Set state and inputs from the unknowns; returns the rates of all states."""
        *values, inputs[REAR_TORQUES], inputs[STEERING] = unknowns * scale
        state[free] = values
        if not model.options.has_eight_dof:
            state[TIRE_COMPRESSION] = model.on_flat_road(state)
        return model.rates(state, inputs)

    def residual(unknowns: np.ndarray) -> np.ndarray:
        rates = put(unknowns)
        given = model.outputs.acceleration[1] if field == "lateral_acceleration" else None
        off = (inputs[STEERING] - target) / angle if given is None else given - target
        return np.append(rates[model.places] / states, off)

    def slopes(unknowns: np.ndarray) -> np.ndarray:
        changes = STEP * np.eye(len(unknowns))
        across = [residual(unknowns + one) - residual(unknowns - one) for one in changes]
        return np.transpose(across) / (2 * STEP)

    start = np.array([*state[free], inputs[REAR_TORQUES][0], inputs[STEERING]]) / scale
    with np.errstate(all="ignore"):
        found = optimize.root(residual, start, jac=slopes, options={"xtol": 1e-13})
        worst = np.abs(residual(found.x)).max()
    if not worst < STEADY or not model.outputs.normal_force.all():
        return None
    return Trim(model, state, inputs, model.outputs.copy())


def _in_words(trim: Trim, field: str) -> str:
    """How tight the turn of a trim is, in terms of the given quantity, in words."""
    if field == "steering":
        angle = float(trim.inputs[STEERING])
        return f"{angle:.3f} rad ({math.degrees(angle):.1f} deg)"
    return f"{float(trim.outputs.acceleration[1]):.2f} m/s^2"


def _check_rolls(trim: Trim) -> None:
    """Raise InputError if a wheel rolls so slowly that the standstill terms of its tire act."""
    if trim.outputs.rolling.min() < LOW_SPEED:
        allowed = f"at least {LOW_SPEED:g} m/s at every wheel; below, the tires are not smooth"
        raise InputError("speed", float(trim.state[U]), allowed)
