"""A vehicle that tumbles over its corners, against the multibody engine with forces of its own.

The forces on the corners are written down a second time; the engine has the places and velocities
of the corners, and what the forces do.
"""

import mujoco
import numpy as np
import pytest
from bodies import BOX, EXACT, corners

from vehicle_roll_sim import Command, Condition, Simulation, preset
from vehicle_roll_sim.paper.multibody import BODY, Multibody

pytestmark = pytest.mark.unmeasured

STICKING_SPEED = 0.1
"""m/s"""
DURATION = 0.8
"""s"""
PART = 0.01
"""s: interval of the comparison."""


class OnItsBody(Multibody):
    """The engine, with the ground at the corners of the body."""

    def _apply_contact_forces(self, spins, command):
        found = super()._apply_contact_forces(spins, command)
        vehicle, data, jacobian = self.vehicle, self._data, np.zeros((3, self._engine.nv))
        self.loads = np.zeros(8)
        for k, arm in enumerate(corners(vehicle)):
            point = data.xpos[BODY] + self._rotation @ arm
            mujoco.mj_jac(self._engine, data, jacobian, None, point, BODY)
            velocity = jacobian @ data.qvel
            if point[2] >= 0.0:
                continue
            pressed = -vehicle.body_stiffness * point[2] - vehicle.body_damping * velocity[2]
            self.loads[k] = max(pressed, 0.0)
            rubbing = vehicle.body_friction * self.loads[k]
            rubbing /= max(np.hypot(*velocity[:2]), STICKING_SPEED)
            force = np.array([*(-rubbing * velocity[:2]), self.loads[k]])
            data.qfrc_applied += force @ jacobian
        return found


def tumbling(simulation: Simulation) -> Simulation:
    """Sliding sideways at 9 m/s, the left side over the right one, about to fall on the roof."""
    simulation.reset(10.0)
    state = simulation.state
    state["roll"], state["pitch"], state["yaw"], state["z"] = 1.9, 0.06, 0.4, 1.5
    state["v"], state["w"], state["roll_rate"], state["pitch_rate"] = 3.0, 8.5, 3.0, 0.3
    state["unsprung_velocity"] = state["w"]
    return simulation


def test_a_roll_over_side_and_roof_is_that_of_the_engine():
    """Within the error of integration, whose slope jumps where a corner meets the ground within a
    step: some 10 impacts of 1e5 N on 1.4e3 kg, each within 1e-3 s."""
    vehicle = preset().with_values(BOX)
    model = tumbling(Simulation(vehicle, EXACT))
    engine = tumbling(OnItsBody(vehicle))
    engine._limits["stop_angle"] = np.inf
    hardest, touched = 0.0, set()
    for _ in range(round(DURATION / PART)):
        for each in (model, engine):
            assert each.step(Command(), PART) is Condition.RUNNING
        turned = np.angle(np.exp(1j * (model.state["roll"] - engine.state["roll"])))
        assert abs(turned) < 1e-6
        for name in ("x", "y", "z", "pitch", "yaw"):
            assert model.state[name] == pytest.approx(engine.state[name], abs=1e-6), name
        scale = 1e-4 * max(engine.loads.max(), 1e3)
        np.testing.assert_allclose(model.outputs["body_load"], engine.loads, rtol=0, atol=scale)
        hardest = max(hardest, float(engine.loads.sum()))
        touched |= {*np.flatnonzero(engine.loads)}
    assert hardest > vehicle.mass * 9.81
    assert {4, 5, 6, 7} & touched  # of the roof
    assert abs(model.state["roll"]) > np.pi
