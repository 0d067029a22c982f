"""Design of the gains of active roll bars: a linear-quadratic regulator from the linear model.

The 14 DOF model is linearized about driving straight ahead. There its lateral motion, in which left
and right wheels move oppositely, is independent of all others: dx/dt = A x + B M, where M is the
roll moment of the bars. The regulator minimizes the integral of

    (roll / roll_scale)^2 + (roll_rate / roll_rate_scale)^2 + (M / moment_scale)^2

over time: M = -K x with K = B' P moment_scale^2, where P solves the algebraic Riccati equation.
Lateral velocity and yaw rate get gains too, though they are not in the cost: together they tell the
lateral tire force before the body has rolled.

Struts, wheels and slips cannot be measured in a vehicle. They are much faster than the body, so
their gains are replaced by gains on FED_BACK that give the same moment once they have settled. With
the states s fed back, the fast ones f, and df/dt = 0,

    f = -Aff^-1 (Afs s + Bf M)   and   M = -(Ks - Kf Aff^-1 Afs) s / (1 - Kf Aff^-1 Bf).
"""

import dataclasses

import numpy as np
from scipy import linalg

from vehicle_roll_sim.analysis.linear_model import LinearModel, linearize
from vehicle_roll_sim.analysis.trim import find_trim
from vehicle_roll_sim.control_laws.lqr_roll_bar import FED_BACK, GAINS, LqrRollBar
from vehicle_roll_sim.declaration import InputError, keep_validated, parameter
from vehicle_roll_sim.model.records import LF, LR, RF, RR, WHEELS
from vehicle_roll_sim.simulation.limits import MAXIMUM_SPEED
from vehicle_roll_sim.simulation.options import Options, options_for
from vehicle_roll_sim.vehicle.parameters import Vehicle

OPPOSITE = ("suspension_compression", "unsprung_velocity", "wheel_speed", "longitudinal_slip")
"""Fields whose left and right values are opposite in a lateral motion."""
EQUAL = ("lateral_slip",)
"""Fields whose left and right values are equal in a lateral motion."""
AXLES = (WHEELS[:2], WHEELS[2:])
SYMMETRIC = 1e-6
"""Coupling of the lateral motion with others, over the largest element of A, that is rounding."""


@dataclasses.dataclass(frozen=True)
class RollBarCriteria:
    """What the regulator weighs against each other, at which speed, and for which bars."""

    speed: float = parameter(
        "speed of the straight driving about which the model is linearized",
        "m/s",
        1.0,
        MAXIMUM_SPEED,
        default=20.0,
    )
    roll_scale: float = parameter("roll angle that counts 1", "rad", 1e-6, 10.0, default=0.04)
    roll_rate_scale: float = parameter("roll rate that counts 1", "rad/s", 1e-6, 100.0, default=0.4)
    moment_scale: float = parameter("roll moment that counts 1", "N m", 1e-3, 1e9, default=9000.0)
    front_share: float = parameter(
        "share of the roll moment at the front axle", "", 0.0, 1.0, default=0.55
    )
    largest_force: float = parameter("largest force at a corner", "N", 0.0, 1e6, default=3000.0)

    def __post_init__(self):
        keep_validated(self)


@dataclasses.dataclass(frozen=True)
class RollBarDesign:
    """A designed regulator.

    law: has the designed gains. model: linear, with its trim. a (n, n), b (n,): of the lateral
    motion; FED_BACK are its first states. weights (n, n), weight: of states and moment in the cost.
    cost (n, n): P. optimal_gain (n,): K. gain (4,): of FED_BACK alone. poles_without, poles: of
    the lateral motion without and with `gain` (1/s).
    """

    law: LqrRollBar
    model: LinearModel
    a: np.ndarray
    b: np.ndarray
    weights: np.ndarray
    weight: float
    cost: np.ndarray
    optimal_gain: np.ndarray
    gain: np.ndarray
    poles_without: np.ndarray
    poles: np.ndarray


def design(
    vehicle: Vehicle, options: Options | None = None, criteria: RollBarCriteria | None = None
) -> RollBarDesign:
    """Design the regulator for a vehicle.

    Raises InputError if there is no such linear model, or if the vehicle is not symmetric.
    """
    criteria = criteria or RollBarCriteria()
    options = options or options_for(vehicle)
    if "suspension_compression" not in options.states:
        raise InputError("model", options.model, "a model with 14 degrees of freedom")
    model = linearize(find_trim(vehicle, options, speed=criteria.speed))
    places = vehicle.record()["y"][0]
    tracks = (float(places[LF] - places[RF]), float(places[LR] - places[RR]))
    a, b = lateral_part(model, bar_column(model, criteria.front_share, tracks))
    weights = np.zeros_like(a)
    for name, scale in (("roll", criteria.roll_scale), ("roll_rate", criteria.roll_rate_scale)):
        weights[FED_BACK.index(name), FED_BACK.index(name)] = scale**-2
    weight = criteria.moment_scale**-2
    cost = linalg.solve_continuous_are(a, b[:, np.newaxis], weights, [[weight]])
    optimal = b @ cost / weight
    gain = once_settled(a, b, optimal)
    fed_back = np.append(gain, np.zeros(len(b) - len(gain)))
    poles = linalg.eigvals(a), linalg.eigvals(a - np.outer(b, fed_back))
    bars = {"front_share": criteria.front_share, "largest_force": criteria.largest_force}
    bars |= {"front_track": tracks[0], "rear_track": tracks[1]}
    law = LqrRollBar(**dict(zip(GAINS, (-gain).tolist(), strict=True)), **bars)
    return RollBarDesign(law, model, a, b, weights, weight, cost, optimal, gain, *poles)


def lateral_part(model: LinearModel, bars: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A (n, n) of the lateral motion, and B (n,) of bars that act on the whole model as `bars`.

    Raises InputError if the lateral motion is not independent of the others.
    """
    lift = lateral_motion(model.state_names)
    along = lift / (lift**2).sum(axis=0)  # columns are orthogonal: this is the pseudo-inverse
    a = along.T @ model.a @ lift
    if not np.abs(model.a @ lift - lift @ a).max() < SYMMETRIC * np.abs(model.a).max():
        problem = "its lateral motion also heaves, pitches or slows it down"
        raise InputError("vehicle", "", "left and right the same", problem)
    return a, along.T @ bars


def bar_column(model: LinearModel, front_share: float, tracks: tuple[float, float]) -> np.ndarray:
    """dx/dt per roll moment of the bars, shape (n,): at each axle opposite forces M / track."""
    column = np.zeros(len(model.state_names))
    for wheels, share, track in zip(AXLES, (front_share, 1.0 - front_share), tracks, strict=True):
        for wheel, side in zip(wheels, (-1.0, 1.0), strict=True):
            place = model.input_names.index(f"normal_force_{wheel}")
            column += side * share / track * model.b[:, place]
    return column


def once_settled(a: np.ndarray, b: np.ndarray, gain: np.ndarray) -> np.ndarray:
    """Gains (4,) on the first states that equal `gain` (n,) once the other states have settled."""
    slow, fast = slice(len(FED_BACK)), slice(len(FED_BACK), None)
    settled = np.linalg.solve(a[fast, fast], np.column_stack((a[fast, slow], b[fast])))
    by_state, by_moment = settled[:, :-1], settled[:, -1]
    return (gain[slow] - gain[fast] @ by_state) / (1.0 - gain[fast] @ by_moment)


def lateral_motion(state_names: tuple[str, ...]) -> np.ndarray:
    """Columns of all states, shape (n, m), one for each lateral motion; FED_BACK come first."""
    columns = [dict.fromkeys([name], 1.0) for name in FED_BACK]
    for left, right in AXLES:
        columns += [{f"{name}_{left}": 1.0, f"{name}_{right}": -1.0} for name in OPPOSITE]
        columns += [{f"{name}_{left}": 1.0, f"{name}_{right}": 1.0} for name in EQUAL]
    there = [column for column in columns if column.keys() <= set(state_names)]
    return np.array([[column.get(name, 0.0) for column in there] for name in state_names])
