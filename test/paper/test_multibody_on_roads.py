"""Model 1 on a bumpy road against the multibody engine, which gets the same heights, in a jump.

Slopes are below 0.2, so that no edges are looked for. The engine knows bodies and forces only. The
contact is written here a second time, with vectors over the ground in place of components in
frames: the same point in the same plane.
"""

import math

import numpy as np
import pytest
from road_kinds import FEATURES, road

from vehicle_roll_sim import Simulation, preset
from vehicle_roll_sim.model.records import COMMAND, LR, WHEEL_COUNT
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.options import MULTIBODY
from vehicle_roll_sim.simulation.road import Road

pytest.importorskip("mujoco", reason="the multibody engine is not installed")
import mujoco

from vehicle_roll_sim.paper.multibody import FIRST_WHEEL, Multibody

STEP, END = 2e-3, 2.0
"""s"""
ROUGH = road(
    {"kind": "wave", "start": 8.0, "length": 9.0, "height": 0.4},
    FEATURES["corkscrew ramp"] | {"start": 18.0, "height": 0.4, "width": 3.0, "top": 60.0},
    {"kind": "random_profile", "start": 4.0, "roughness": "C", "length": 200.0},
)
AGREEMENT = {
    **dict.fromkeys(("x", "y", "z"), 1e-5),
    **dict.fromkeys(("roll", "pitch", "yaw"), 2e-6),
    **dict.fromkeys(("u", "v", "w"), 1e-4),
}
"""m, rad, m/s. Both are integrated to fourth order, in different coordinates: 6e-10, 3e-10 and 4e-9
up to the landing, 1.4e-6, 2e-7 and 1e-5 after it, since the force of a tire has a kink there."""
LOADS = 0.5
"""N, at the end; for the same reason. Seen: 0.06."""


class OnRoad(Multibody):
    """The engine on a road with heights."""

    def __init__(self, vehicle, road: Road):
        self._surface = road.surface
        super().__init__(vehicle, step=STEP)

    def _apply_contact_forces(self, spins, command):
        car, data, rotation = self._car, self._data, self._rotation
        forward, left, _ = self._frame_2()
        steering = np.repeat((command["steering"], command["rear_steering"]), 2)
        self.outputs["steering"] = steering
        ahead, across, normals = (np.zeros((WHEEL_COUNT, 3)) for _ in range(3))
        radius, velocities = np.zeros(WHEEL_COUNT), np.zeros((WHEEL_COUNT, 3))
        for i, centre in enumerate(self._wheel_centres):
            height, along, aside, _ = self._surface(*centre[:2])
            normal = np.array([-along, -aside, 1.0]) / math.hypot(along, aside, 1.0)
            compression = car.tire_radius[i] - (centre[2] - height) * normal[2]
            self.outputs["support"][i] = car.tire_stiffness[i] * compression
            s, c = math.sin(steering[i]), math.cos(steering[i])
            sine = -normal @ (c * forward + s * left)
            down = sine * (rotation @ [c, s, 0.0]) - math.sqrt(1.0 - sine**2) * rotation[:, 2]
            radius[i] = car.tire_radius[i] - max(compression, 0.0) / -(down @ normal)
            wheel, jacobians = FIRST_WHEEL + i, (self._jacobian[i], self._turning[i])
            mujoco.mj_jac(self._engine, data, *jacobians, centre + radius[i] * down, wheel)
            ahead[i] = np.cross(left, normal) / np.linalg.norm(np.cross(left, normal))
            across[i], normals[i] = np.cross(normal, ahead[i]), normal
            velocity = self._jacobian[i] @ data.qvel
            velocities[i, :2] = ahead[i] @ velocity, across[i] @ velocity
        self.outputs["normal_force"] = np.maximum(self.outputs["support"], 0.0)
        along, forces = self._tire_forces(velocities, spins, radius)
        for i, (x, y, load) in enumerate(forces):
            force = x * ahead[i] + y * across[i] + load * normals[i]
            data.qfrc_applied += force @ self._jacobian[i]
        torques = command["wheel_torque"] - radius * along
        missing = command["speed_hold_target"] - rotation[:, 0] @ data.qvel[:3]
        torques[LR:] += command["speed_hold_gain"] * missing
        return torques / car.wheel_inertia


def steer(times: np.ndarray) -> np.ndarray:
    """To the left, and back while the vehicle is in the air."""
    commands = np.zeros(len(times), COMMAND)
    commands["steering"] = np.radians(np.interp(times, [0.2, 0.4, 1.0, 1.2], [0.0, 1.5, 1.5, 0.0]))
    return commands


def test_model_1_follows_the_engine_over_a_bumpy_road_and_through_a_jump():
    ours, engine = Simulation(preset(), MULTIBODY, step=STEP, road=ROUGH), OnRoad(preset(), ROUGH)
    rows = []
    for each in (ours, engine):
        each.reset(14.0)
        rows.append(run(each, steer, END))
    first, second = rows
    loads = first.wheels("normal_force")
    assert (loads.max(axis=1) == 0.0).sum() > 5  # rows of 10 ms in the air
    assert np.ptp(first["roll"]) > math.radians(3.0)
    for name, most in AGREEMENT.items():
        assert np.abs(first[name] - second[name]).max() < most, name
    assert np.abs(ours.outputs["support"] - engine.outputs["support"]).max() < LOADS
