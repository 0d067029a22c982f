"""Steady driving: the state in which nothing changes, straight ahead or in a turn.

Searched for are the state, the torque that both rear wheels need to hold the speed and, where a
lateral acceleration is asked for, the steering: the roots of the rates of all states on which the
motion depends. Position, height, heading and the angles of the wheels go on changing without an
effect on the rest; height is found nevertheless, since it says how far the tires are compressed.
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
from vehicle_roll_sim.simulation.options import MODELS, Options
from vehicle_roll_sim.simulation.plant import Plant
from vehicle_roll_sim.simulation.simulation import MAXIMUM_SPEED
from vehicle_roll_sim.vehicle.parameters import Vehicle

INPUT_FIELDS = ("steering", "rear_steering", "wheel_torque", "normal_force")
INPUT_NAMES = tuple(
    f"{name}_{wheel}" if COMMAND[name].shape else name
    for name in INPUT_FIELDS
    for wheel in (WHEELS if COMMAND[name].shape else ("",))
)
"""What drives the model smoothly: brakes are dry friction, which has no slope at rest."""
STEERING, REAR_TORQUES = 0, slice(4, 6)
"""Places among the inputs."""
WITHOUT_EFFECT = ("x", "y", "yaw")
"""States that nothing depends on, on a level road. Nor does anything on the height but the tires,
whose compression follows from it."""
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
"""Changes that matter about as much as each other (SI units, rad): the scale of every unknown, of
every rate in a second, and of the steps of a difference."""
LARGEST_STEERING, LARGEST_ACCELERATION = math.radians(1.0), 0.5
"""rad and m/s^2: the turn is tightened in steps no larger than this, so that the steady state that
is found is the one that a driver reaches from driving straight ahead."""
STEP = 1e-4
"""Step of the slopes that lead there, in typical changes; with its own the root finder gets lost in
rounding."""
STEADY = 1e-8
"""Largest rate of a steady state, in typical changes per second: rounding leaves some 1e-10."""


def typical(names: tuple[str, ...]) -> np.ndarray:
    """The typical change of each element, given by the name of a field and, maybe, of a wheel."""
    sizes = TYPICAL | {f"{name}_{wheel}": TYPICAL[name] for name in TYPICAL for wheel in WHEELS}
    return np.array([sizes[name] for name in names])


class LevelRoadModel:
    """The rates of a model on a level road at any state, and what its equations need.

    state_names: the states on which the motion depends, tire compressions not among them where
    height, attitude and suspension give these; places: where they lie in the flat state vector.
    Raises InputError for model 1c-iii, in which nothing gives them: its turns are not steady.
    """

    def __init__(self, vehicle: Vehicle, options: Options):
        if "rates_not_rotated" in MODELS[options.model]:
            allowed = "one in which height and attitude say how far the tires are compressed"
            raise InputError("model", options.model, allowed)
        self.vehicle, self.options = vehicle, options
        plant = Plant.of(vehicle, options)
        self.record = plant.vehicle
        self._plant = tuple(record for (record,) in plant.arguments())
        self._outputs = np.full(1, np.nan, OUTPUTS)
        left_out = (*WITHOUT_EFFECT, "tire_compression")
        self.state_names = element_names(tuple(s for s in options.states if s not in left_out))
        self.places = np.array([STATE_NAMES.index(name) for name in self.state_names])

    @property
    def outputs(self) -> np.record:
        """The OUTPUTS record of the last rates: a view of memory that the next ones change."""
        return self._outputs[0]

    def rates(self, state: np.ndarray, inputs: np.ndarray) -> np.ndarray:
        """Time derivative of a flat state vector; `outputs` are then those of this state.

        inputs: elements INPUT_NAMES. Rates that the model does not have are nan.
        """
        command, rates = np.zeros(1, COMMAND), np.full(STATE_SIZE, np.nan)
        for name, value in zip(INPUT_FIELDS, np.split(inputs, (1, 2, 6)), strict=True):
            command[name] = value if COMMAND[name].shape else value[0]
        outputs = kernel_argument(self._outputs)[0]
        with silently():
            note_turning(state, outputs)
            derivatives(state, kernel_argument(command)[0], *self._plant, outputs, rates)
        return rates

    def on_flat_road(self, state: np.ndarray) -> np.ndarray:
        """Compression of the four tires where the body has this height and attitude (m).

        r0 less the height of the wheel centre, z + (Ry(pitch) Rx(roll) (x, y, -ls))z.
        """
        now, car = state.view(STATE)[0], self.record[0]
        compressed = now.suspension_compression - car.static_suspension_compression
        strut = car.static_strut_length - compressed
        upward = car.y * np.sin(now.roll) - strut * np.cos(now.roll)
        rise = np.cos(now.pitch) * upward - car.x * np.sin(now.pitch)
        return car.tire_radius - (now.z + rise)


@dataclasses.dataclass(frozen=True)
class Trim:
    """A steady state: flat state vector (elements STATE_NAMES; position and heading 0, what the
    model does not have nan), inputs (INPUT_NAMES), and the OUTPUTS record that belongs to them."""

    model: LevelRoadModel
    state: np.ndarray
    inputs: np.ndarray
    outputs: np.record

    @property
    def drive_torque(self) -> float:
        """At each rear wheel, to hold the speed (N m)."""
        return float(self.inputs[REAR_TORQUES][0])


def find_trim(
    vehicle: Vehicle,
    options: Options | None = None,
    *,
    speed: float,
    steering: float = 0.0,
    lateral_acceleration: float | None = None,
) -> Trim:
    """Steady driving at a forward speed u (m/s), held by equal torques at the rear wheels.

    steering: road-wheel angle (rad); with `lateral_acceleration` (m/s^2, of the sprung c.g.) it is
    found instead. Raises InputError where there is no such steady state with four wheels on the
    ground, or where it is too slow for the tires to be smooth.
    """
    model = LevelRoadModel(vehicle, options or Options())
    slowest = MINIMUM_SPEED if model.options.steady_state_slip else LOW_SPEED
    if not slowest <= speed <= MAXIMUM_SPEED:
        raise InputError("speed", speed, f"from {slowest:g} to {MAXIMUM_SPEED:g} m/s")
    is_turn_given = lateral_acceleration is not None
    field = "lateral_acceleration" if is_turn_given else "steering"
    wanted = lateral_acceleration if is_turn_given else steering
    if not math.isfinite(wanted):
        raise InputError(field, wanted, "a finite number")
    standing = equilibrium(model.record, speed).view(np.float64)
    trim = _solution(model, standing, np.zeros(len(INPUT_NAMES)), "steering", 0.0)
    if trim is None:
        raise InputError("speed", speed, "one that the rear wheels can hold straight ahead")
    _check_rolls(trim)
    for target in _targets(wanted, LARGEST_ACCELERATION if is_turn_given else LARGEST_STEERING):
        within = _in_words(trim, field)
        trim = _solution(model, trim.state, trim.inputs, field, target)
        if trim is None:
            beyond = "further on a wheel lifts or slides in every turn"
            raise InputError(field, wanted, f"at most {within}, {beyond}")
        _check_rolls(trim)
    return trim


def _targets(wanted: float, largest: float) -> np.ndarray:
    """From 0, straight ahead, which is left out, to a value in equal steps."""
    return np.linspace(0.0, wanted, math.ceil(abs(wanted) / largest) + 1)[1:]


def _solution(
    model: LevelRoadModel, state: np.ndarray, inputs: np.ndarray, field: str, target: float
) -> Trim | None:
    """The steady state near a flat state vector, at the speed that this has; None without one.

    Nor with a wheel off the ground: nothing says how fast it turns, and a driven one ever faster.
    field, target: what is given, the steering (rad) or the lateral acceleration (m/s^2).
    """
    state, inputs = state.copy(), inputs.copy()
    free = model.places[model.places != U]
    states = typical(model.state_names)
    torque, angle = TYPICAL["wheel_torque"], TYPICAL["steering"]
    scale = np.array([*states[model.places != U], torque, angle])

    def put(unknowns: np.ndarray) -> np.ndarray:
        """Have state and inputs be these unknowns; returns the rates of all states."""
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
    """How far the turn of a trim goes, in the quantity that is given."""
    if field == "steering":
        angle = float(trim.inputs[STEERING])
        return f"{angle:.3f} rad ({math.degrees(angle):.1f} deg)"
    return f"{float(trim.outputs.acceleration[1]):.2f} m/s^2"


def _check_rolls(trim: Trim) -> None:
    """Raise InputError where a wheel is too slow for its tire to be that of a rolling wheel."""
    if trim.outputs.rolling.min() < LOW_SPEED:
        allowed = f"{LOW_SPEED:g} m/s or more at every wheel, tires do not roll smoothly below"
        raise InputError("speed", float(trim.state[U]), allowed)
