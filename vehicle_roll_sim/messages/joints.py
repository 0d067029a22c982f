"""The joints of a vehicle, by which the robot description and `joint_states` agree.

Each wheel has a suspension, a steering and a wheel joint. With model 2 the joints of a guided wheel
lie between the first two: displacements of the wheel centre forward and to the left, and the turns
of its carrier about the body's z, x and y axes, in this order from the body outwards.
"""

import numpy as np

from vehicle_roll_sim.model.kinematic.guidance import LEAN, NOD, TURN
from vehicle_roll_sim.model.records import WHEEL_COUNT, WHEELS
from vehicle_roll_sim.simulation.simulation import Simulation

X, Y, Z = "1 0 0", "0 1 0", "0 0 1"
GUIDED = {
    "longitudinal": ("prismatic", X),
    "lateral": ("prismatic", Y),
    "toe": ("revolute", Z),
    "camber": ("revolute", X),
    "carrier_pitch": ("revolute", Y),
}
"""Type and axis of the further joints of a guided wheel, from the body outwards."""
SUSPENSION, STEERING, WHEEL = "suspension", "steering", "wheel"


def joint_kinds(simulation: Simulation) -> tuple[str, ...]:
    """The joints of each wheel that move, in the order of `joint_states`."""
    options = simulation.options
    moving = (STEERING, WHEEL) if options.has_eight_dof else (SUSPENSION, STEERING, WHEEL)
    return (*moving, *(GUIDED if options.is_kinematic else ()))


def joint_names(kinds: tuple[str, ...]) -> list[str]:
    """Names of some joints of all wheels; those of the same kind stand together."""
    return [f"{wheel}_{kind}_joint" for kind in kinds for wheel in WHEELS]


def joint_motion(simulation: Simulation) -> tuple[np.ndarray, np.ndarray]:
    """Positions and velocities of all joints, in the order of their names (m, rad; per s)."""
    state, outputs = simulation.state, simulation.outputs
    position = [outputs["steering"], state["wheel_angle"]]
    velocity = [np.zeros(WHEEL_COUNT), state["wheel_speed"]]
    if not simulation.options.has_eight_dof:
        at_rest = simulation.static_suspension_compression
        position.insert(0, state["suspension_compression"] - at_rest)
        velocity.insert(0, outputs["suspension_rate"])
    if simulation.options.is_kinematic:
        moved, moving = _guided_motion(simulation)
        position += moved
        velocity += moving
    return np.concatenate(position), np.concatenate(velocity)


def _guided_motion(simulation: Simulation) -> tuple[list, list]:
    """Positions of the joints GUIDED of all wheels, and their velocities."""
    terms, rate = simulation.outputs["suspension_terms"], simulation.outputs["suspension_rate"]
    places = simulation.vehicle.record()[0]
    offsets = [terms["wheel"][0] - places["x"], terms["wheel"][1] - places["y"]]
    angles = [terms["carrier_angle"][k : k + WHEEL_COUNT] for k in (TURN, LEAN, NOD)]
    slopes = [*terms["path"], terms["turning_in"], terms["leaning"], terms["nodding"]]
    return [*offsets, *angles], [slope * rate for slope in slopes]
