"""The vehicle once more, in an independent multibody engine (MuJoCo): an oracle of the equations.

One free body and four point masses that slide along the body's z axis. The engine knows the masses
and joints and does all of the mechanics; from here come the forces only, evaluated at every stage
of the integration from the engine's own state: springs and dampers along the struts, and at the
contact points the tires' vertical and lateral forces. The tires have no longitudinal force, so
that the spin of the wheels does not enter.
"""

import math

import magic_formula
import mujoco
import numpy as np
from random_states import attitude, wheel_positions

from vehicle_roll_sim import Vehicle

GRAVITY = 9.81
"""m/s^2"""
MASSLESS = 1e-9
"""kg m^2, of the point masses: the engine wants something, and this is 1e-12 of the body's."""
BODY_DOFS = 6
"""Speeds of a free joint: linear ones over the ground, then body rates; the struts' follow."""
POSE = 7
"""Places of a free joint: position, then quaternion; the struts' follow."""

MODEL = """
<mujoco>
  <option gravity="0 0 -{gravity}"/>
  <compiler angle="radian"/>
  <worldbody>
    <body name="body">
      <freejoint/>
      <inertial pos="0 0 0" mass="{mass}" diaginertia="{inertia}"/>
      {wheels}
    </body>
  </worldbody>
</mujoco>"""
WHEEL = """
      <body name="wheel{index}" pos="{x} {y} {z}">
        <joint type="slide" axis="0 0 1"/>
        <inertial pos="0 0 0" mass="{mass}" diaginertia="{inertia}"/>
      </body>"""


def engine_model(vehicle: Vehicle) -> mujoco.MjModel:
    """Struts at their static length where the slides are at 0."""
    wheels = ""
    masses = vehicle.per_wheel("unsprung_mass")
    for index, (x, y) in enumerate(wheel_positions(vehicle)):
        z = -float(vehicle.static_strut_length[index])
        inertia = f"{MASSLESS} {MASSLESS} {MASSLESS}"
        mass = repr(float(masses[index]))
        wheels += WHEEL.format(index=index, x=float(x), y=float(y), z=z, mass=mass, inertia=inertia)
    inertia = f"{vehicle.roll_inertia} {vehicle.pitch_inertia} {vehicle.yaw_inertia}"
    text = MODEL.format(gravity=GRAVITY, mass=vehicle.sprung_mass, inertia=inertia, wheels=wheels)
    return mujoco.MjModel.from_xml_string(text)


class Multibody:
    """The vehicle in the engine. `tire_load` (N) belongs to the latest evaluation."""

    def __init__(self, vehicle: Vehicle):
        self.vehicle = vehicle
        self.model = engine_model(vehicle)
        self.data = mujoco.MjData(self.model)
        self.tire_load = np.zeros(4)
        self._wheels = [self.model.body(f"wheel{i}").id for i in range(4)]
        self._static = GRAVITY * vehicle.sprung_mass * vehicle.axle_load_share
        self._springs = vehicle.per_wheel("spring_stiffness")
        self._dampers = vehicle.per_wheel("damping")
        self._tires = vehicle.per_wheel("tire_stiffness")

    def place(self, state: np.ndarray) -> None:
        """Take over a STATE record; what the tires do follows from the height of the wheels."""
        qpos, qvel = self.data.qpos, self.data.qvel
        rotation = attitude(state["roll"], state["pitch"], state["yaw"])
        rates = np.array([state["roll_rate"], state["pitch_rate"], state["yaw_rate"]])
        qpos[:3] = state["x"], state["y"], state["z"]
        mujoco.mju_mat2Quat(qpos[3:POSE], rotation.ravel())
        qpos[POSE:] = state["suspension_compression"] - self._static / self._springs
        qvel[:3] = rotation @ (state["u"], state["v"], state["w"])
        qvel[3:BODY_DOFS] = rates
        x, y = wheel_positions(self.vehicle).T
        at_strut = state["w"] + y * state["roll_rate"] - x * state["pitch_rate"]
        qvel[BODY_DOFS:] = state["unsprung_velocity"] - at_strut

    def accelerate(self, steering: float, active_force=(0.0,) * 4) -> np.ndarray:
        """Accelerations (qacc) at the engine's present state, front wheels at `steering` (rad)."""
        data = self.data
        mujoco.mj_kinematics(self.model, data)
        mujoco.mj_comPos(self.model, data)
        slide, speed = data.qpos[POSE:], data.qvel[BODY_DOFS:]
        strut = self._static + self._springs * slide + self._dampers * speed
        data.qfrc_applied[:] = 0.0
        data.qfrc_applied[BODY_DOFS:] = -strut - active_force
        for i in range(4):
            data.qfrc_applied += self._tire(i, steering if i < 2 else 0.0)
        mujoco.mj_forward(self.model, data)
        return data.qacc.copy()

    def _tire(self, i: int, steering: float) -> np.ndarray:
        """Generalised force of tire i, by the Jacobian of its contact point."""
        body, radius = self._wheels[i], self.vehicle.tire_radius
        rotation = self.data.xmat[body].reshape(3, 3)
        centre = self.data.xpos[body]
        compression = radius - centre[2]
        load = max(self._tires[i] * compression, 0.0)
        self.tire_load[i] = load
        if load == 0.0:
            return np.zeros(self.model.nv)
        contact = centre - (radius - compression / rotation[2, 2]) * rotation[:, 2]  # (15)
        jacobian = np.zeros((3, self.model.nv))
        mujoco.mj_jac(self.model, self.data, jacobian, None, contact, body)
        heading = math.atan2(rotation[1, 0], rotation[0, 0]) + steering
        ahead = np.array([math.cos(heading), math.sin(heading), 0.0])
        left = np.array([-math.sin(heading), math.cos(heading), 0.0])
        velocity = jacobian @ self.data.qvel
        alpha = math.atan2(left @ velocity, abs(ahead @ velocity))
        side = -1.0 if i % 2 else 1.0  # the file is of a left-hand tire
        lateral = side * magic_formula.pure_lateral(
            self.vehicle.tire.coefficients, side * alpha, load
        )
        return jacobian.T @ (lateral * left + [0.0, 0.0, load])

    def step(self, time: float, step: float, steering) -> None:
        """Classical Runge-Kutta of fourth order; steering(time) gives the front wheels' angle."""
        qpos, qvel = self.data.qpos.copy(), self.data.qvel.copy()
        slopes = []
        for part in (0.0, 0.5, 0.5, 1.0):
            if slopes:
                places, speeds = slopes[-1]
                self.data.qpos[:] = qpos + part * step * places
                self.data.qvel[:] = qvel + part * step * speeds
            places = self._place_rates()
            slopes.append((places, self.accelerate(steering(time + part * step))))
        weights = (step / 6, step / 3, step / 3, step / 6)
        self.data.qpos[:] = qpos + sum(w * p for w, (p, _) in zip(weights, slopes, strict=True))
        self.data.qvel[:] = qvel + sum(w * v for w, (_, v) in zip(weights, slopes, strict=True))
        mujoco.mju_normalize4(self.data.qpos[3:POSE])

    def _place_rates(self) -> np.ndarray:
        """Rates of position, quaternion and slides at the present speeds."""
        rates = np.empty(self.model.nq)
        rates[:3], rates[POSE:] = self.data.qvel[:3], self.data.qvel[BODY_DOFS:]
        turning = np.concatenate([[0.0], self.data.qvel[3:BODY_DOFS] / 2])
        mujoco.mju_mulQuat(rates[3:POSE], self.data.qpos[3:POSE], turning)
        return rates

    @property
    def roll(self) -> float:
        """Roll angle (rad)."""
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, self.data.qpos[3:POSE])
        return math.atan2(rotation[7], rotation[8])
