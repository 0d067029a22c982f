"""A vehicle on four posts that move together is four quarter cars: scipy integrates one of them."""

import numpy as np
import pytest
from road_kinds import road
from scipy.integrate import solve_ivp

from vehicle_roll_sim import Options, Simulation
from vehicle_roll_sim.model.records import COMMAND

STEP, END = 2.5e-4, 1.5
"""s"""
WITHIN = 1e-6
"""Of the largest change. Seen: 1e-8, the error of the integration with this step."""
HEIGHT = 1e-3
"""m: the wheels stay on the road."""
SPRING, DAMPING = 32_000.0, 2200.0


def posts(times: np.ndarray) -> np.ndarray:
    """A step after 0.1 s, and a sine of 3 Hz on top of it from 0.6 s on."""
    sine = 0.3 * np.sin(2 * np.pi * 3.0 * (times - 0.6))
    return HEIGHT * (np.where(times > 0.1, 1.0, 0.0) + np.where(times > 0.6, sine, 0.0))


def commands(times: np.ndarray) -> np.ndarray:
    """Of steps from the first of the times on, which a step of the heights may precede."""
    records = np.zeros(len(times), COMMAND)
    records["road_height"] = posts(np.maximum(times, np.nextafter(times[0], END)))[:, None]
    return records


@pytest.fixture(scope="module")
def symmetric(reference):
    """All four corners alike, the c.g. in their middle, the wheel paths of model 2 vertical."""
    alike = {"cg_to_front_axle": 1.27, "cg_to_rear_axle": 1.27}
    for axle in ("front", "rear"):
        alike |= {f"{axle}_spring_stiffness": SPRING, f"{axle}_damping": DAMPING}
        alike[f"{axle}_roll_centre_depth"] = reference.cg_height
    return reference.with_values(alike)


@pytest.mark.parametrize("model", ["1", "2"])
def test_four_posts_excite_a_quarter_car(symmetric, model):
    rig = road({"kind": "commanded"})
    simulation = Simulation(symmetric, Options(model), step=STEP, road=rig)
    simulation.reset(0.0)
    start = simulation.state.copy()
    mass, wheel = symmetric.sprung_mass / 4, symmetric.front_unsprung_mass
    tire, rows = symmetric.front_tire_stiffness, []

    def rates(time, values):
        body, body_rate, centre, centre_rate = values
        strut = SPRING * (centre - body) + DAMPING * (centre_rate - body_rate)
        road_force = tire * (float(posts(np.array([time]))[0]) - centre)
        return [body_rate, strut / mass, centre_rate, (road_force - strut) / wheel]

    solutions, begin, values = [], 0.0, np.zeros(4)
    for end in (0.1, 0.6, END):
        inside = (np.nextafter(begin, END), end)
        solution = solve_ivp(rates, inside, values, "DOP853", rtol=1e-12, atol=1e-15)
        begin, values = end, solution.y[:, -1]
        solutions.append(values)
        simulation.step(commands, round(end - simulation.time, 9))
        rows.append(
            [
                simulation.state.z - start.z,
                simulation.state.w,
                start.tire_compression[0] - simulation.state.tire_compression[0],
                simulation.state.unsprung_velocity[0],
            ]
        )
        pushed = simulation.outputs["normal_force"]
        assert pushed == pytest.approx(np.full(4, pushed[0]), rel=1e-9)
    size = np.abs(solutions).max(axis=0)
    assert np.array(rows) == pytest.approx(np.array(solutions), abs=WITHIN * size.max())
