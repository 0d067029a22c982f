"""Model 2 with tables taken from double wishbones against the linkages themselves."""

import numpy as np
import pytest
from turns import differences
from wishbones import Linkage, on_wishbones

from vehicle_roll_sim import Options, Simulation, Vehicle, preset

pytest.importorskip("mujoco", reason="the multibody engine is not installed")
from wishbone_engine import WishboneEngine

pytestmark = pytest.mark.unmeasured

STEP, END, SPEED = 3e-3, 0.9, 50 / 3.6
"""s, s, m/s"""
DEGREES, NEWTONS, METRES = 1e-6, 1e-3, 1e-4
"""Of roll and loads, and of roll centres: seen are 5e-8, 4e-4 and 1e-7. With a step of 1 ms the
loads agree within 9e-5; the rest comes from the interpolation of the tables."""


@pytest.fixture(scope="module")
def vehicle() -> Vehicle:
    return on_wishbones(preset())


def at_roll_centre(vehicle: Vehicle, simulation: Simulation, axle: str) -> tuple[float, float]:
    """Height above the road and place to the left of the c.g., from the instant centres (m).

    Each wheel's force line goes through its contact point and the instant centre of its carrier.
    """
    linkage, outputs, state = Linkage.of(vehicle, axle), simulation.outputs, simulation.state
    first = {"front": 0, "rear": 2}[axle]
    terms, lines, aims = outputs["suspension_terms"], [], []
    travels = state["suspension_compression"] - vehicle.static_suspension_compression
    for i, side in ((first, 1.0), (first + 1, -1.0)):
        contact = (terms["wheel"][:, i] + terms["arm"][:, i])[1:]
        centre = linkage.centre_at(linkage.arm_turn(float(travels[i]))) * [side, 1.0]
        across = np.array([centre[1] - contact[1], contact[0] - centre[0]])
        lines.append(across)
        aims.append(across @ contact)
    left, up = np.linalg.solve(lines, aims)
    ahead = (terms["wheel"][0] + terms["arm"][0])[first : first + 2].mean()
    roll, pitch = float(state["roll"]), float(state["pitch"])
    height = state["z"] - np.sin(pitch) * ahead
    height += np.cos(pitch) * (np.sin(roll) * left + np.cos(roll) * up)
    return float(height), float(left)


def test_a_turn_that_lifts_both_inner_wheels_is_that_of_the_engine(vehicle):
    simulation = Simulation(vehicle, Options(model="2", steady_state_slip=True), step=STEP)
    engine = WishboneEngine(vehicle, SPEED)
    worst = {"roll": 0.0, "loads": 0.0, "roll centres": 0.0}
    for k, (roll, loads) in enumerate(differences(simulation, engine, STEP, END)):
        worst["roll"], worst["loads"] = max(worst["roll"], roll), max(worst["loads"], loads)
        if k % 25 == 0:
            for place, axle in enumerate(("front", "rear")):
                found = [simulation.outputs[f"roll_centre_{n}"][place] for n in ("height", "place")]
                apart = np.abs(np.subtract(found, at_roll_centre(vehicle, simulation, axle)))
                worst["roll centres"] = max(worst["roll centres"], apart.max())
    assert worst["roll"] < DEGREES, worst
    assert worst["loads"] < NEWTONS, worst
    assert worst["roll centres"] < METRES, worst
    assert np.ptp([simulation.outputs["roll_centre_height"][0], 0.1976]) > 0.01  # m: it has moved
