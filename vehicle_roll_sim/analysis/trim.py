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

from vehicle_roll_sim.analysis.level_road_model import TYPICAL, LevelRoadModel, typical
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.equilibrium import equilibrium
from vehicle_roll_sim.model.integration.events import MINIMUM_SPEED
from vehicle_roll_sim.model.records import TIRE_COMPRESSION, U
from vehicle_roll_sim.model.tire.transient_slip import LOW_SPEED
from vehicle_roll_sim.simulation.limits import MAXIMUM_SPEED
from vehicle_roll_sim.simulation.options import Options, options_for
from vehicle_roll_sim.vehicle.parameters import Vehicle

STEERING, REAR_TORQUES = 0, slice(4, 6)
"""Indices among the inputs."""
LARGEST_STEERING, LARGEST_ACCELERATION = math.radians(1.0), 0.5
"""rad and m/s^2: the turn is tightened in steps of at most this size, so that the steady state
found is the one that a driver reaches from straight ahead."""
STEP = 1e-4
"""Finite-difference step of the Jacobian, in typical changes; the root finder's own step is so
small that rounding prevails."""
STEADY = 1e-8
"""Largest rate that counts as steady, in typical changes per second; rounding is about 1e-10."""


@dataclasses.dataclass(frozen=True)
class Trim:
    """A steady state, in SI units and radians.

    state: flat vector named by STATE_NAMES; position and heading are 0, states that the model does
    not have nan. inputs: named by the input_names of `plant`. outputs: the corresponding OUTPUTS
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
    is_kinematic = model.options.is_kinematic
    standing = equilibrium(model.record, model.tires, speed, is_kinematic=is_kinematic)
    trim = _solution(
        model, standing.view(np.float64), np.zeros(len(model.input_names)), "steering", 0.0
    )
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
        values = unknowns * scale
        state[free], inputs[REAR_TORQUES], inputs[STEERING] = values[:-2], values[-2], values[-1]
        if not model.options.has_eight_dof:
            state[TIRE_COMPRESSION] = model.on_flat_road(state)
        return model.rates(state, inputs)

    def residual(unknowns: np.ndarray) -> np.ndarray:
        found = np.empty(len(states) + 1)
        found[:-1] = put(unknowns)[model.places] / states
        if field == "lateral_acceleration":
            found[-1] = model.outputs["acceleration"][1] - target
        else:
            found[-1] = (inputs[STEERING] - target) / angle
        return found

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
