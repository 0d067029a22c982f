"""Drive the multi-body model of CommonRoad, another engine, for vehicle_roll_sim/paper/published.

It prints the numbers of data/althoff_2020.yaml that are not in the document itself. It needs
`pip install commonroad-vehicle-models==3.0.2` and takes half a minute:
`python benchmarks/commonroad.py`.
"""

import importlib
import importlib.util
import math

import numpy as np
from scipy.integrate import solve_ivp

VEHICLES = {"Ford Escort": 1, "BMW 320i": 2, "VW Vanagon": 3}
SPEED = 15.0
"""m/s"""
STEERING_RATE = 0.15
"""rad/s"""
GENTLE = 0.015
"""rad: road-wheel angle that is held."""
SETTLED = 4.0
"""s"""
SIDE_FORCES = ("p_hy1", "p_hy3", "p_vy1", "p_vy3", "p_dy3")
"""Of the tire: side forces at no slip, which jump with the sign of the camber angle, and camber."""
GRAVITY = 9.81
STEERING, U, YAW_RATE, ROLL, V, Y = 2, 3, 5, 6, 10, 1
"""Places of states."""


def parameters(number: int, *, is_plain: bool):
    """The parameters of a vehicle; is_plain: without what camber does to its tires."""
    name = f"parameters_vehicle{number}"
    found = getattr(importlib.import_module(f"vehiclemodels.{name}"), name)()
    if is_plain:
        found.D_f = found.D_r = 0.0
        for coefficient in SIDE_FORCES:
            setattr(found.tire, coefficient, 0.0)
    return found


def state(parameters, steered: float, until: float) -> np.ndarray:
    """The state after coasting straight ahead and steering for `steered` s, at a time (s)."""
    from vehiclemodels.init_mb import init_mb
    from vehiclemodels.vehicle_dynamics_mb import vehicle_dynamics_mb

    now = np.array(init_mb([0.0, 0.0, 0.0, SPEED, 0.0, 0.0, 0.0], parameters))
    for rate, start, end in ((STEERING_RATE, 0.0, steered), (0.0, steered, until)):
        if end > start:
            solved = solve_ivp(
                lambda _, x, rate=rate: vehicle_dynamics_mb(list(x), [rate, 0.0], parameters),
                (start, end),
                now,
                rtol=1e-8,
                atol=1e-9,
                max_step=0.01,
            )
            now = solved.y[:, -1]
    return now


def main() -> None:
    if importlib.util.find_spec("vehiclemodels") is None:
        raise SystemExit("not installed: pip install commonroad-vehicle-models==3.0.2")
    for name, number in VEHICLES.items():
        bend = state(parameters(number, is_plain=False), 1.0, 1.0)
        turn = state(parameters(number, is_plain=True), GENTLE / STEERING_RATE, SETTLED)
        acceleration = turn[YAW_RATE] * turn[U]
        numbers = {
            "yaw rate (deg/s)": math.degrees(bend[YAW_RATE]),
            "roll angle (deg)": -math.degrees(bend[ROLL]),
            "lateral displacement (m)": bend[Y],
            "sideslip angle (deg)": math.degrees(math.atan2(bend[V], bend[U])),
            "curvature gain (1/m)": turn[YAW_RATE] / turn[U] / turn[STEERING],
            "roll gradient (deg/g)": -math.degrees(turn[ROLL]) / acceleration * GRAVITY,
        }
        print(f"{name}:", ", ".join(f"{what} {value:.4g}" for what, value in numbers.items()))


if __name__ == "__main__":
    main()
