"""A vehicle whose wheels hang on real hinges, in the multibody engine.

The engine has the bodies and the hinges and computes all of the mechanics. Forces act on its bodies
at the places that it gives: the tires' at the contact points, the struts' along the body's z axis
between body and wheel centre.
"""

import mujoco
import numpy as np
from swing_axles import FIRST_WHEELS, PIVOTS, arm

from vehicle_roll_sim import Vehicle
from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.contact import steady_state_slip
from vehicle_roll_sim.model.records import OUTPUTS
from vehicle_roll_sim.model.tire.coefficients import as_one
from vehicle_roll_sim.model.tire.magic_formula import tire_forces
from vehicle_roll_sim.paper.engine_model import MASSLESS, with_body

ARM = """
      <body pos="{x} {y} {z}">
        <joint type="hinge" axis="1 0 0" pos="0 {pivot_y} {pivot_z}"/>
        <inertial pos="0 0 0" mass="{mass}" diaginertia="{inertia} {inertia} {inertia}"/>
      </body>"""
POSE, TWIST = 7, 6
PLACES, SPEEDS, SPINS = slice(0, 11), slice(11, 21), slice(21, 25)
"""Parts of the vector of coordinates: the engine's positions and velocities, and wheel spins."""
UP = np.array([0.0, 0.0, 1.0])


class SwingAxleEngine:
    """The engine's vehicle, rolling straight ahead in equilibrium; steady-state slip.

    wheels: indices of the bodies that carry the wheels.
    """

    wheels = (2, 3, 4, 5)

    def __init__(self, vehicle: Vehicle, speed: float):
        self.vehicle, (self.car,) = vehicle, vehicle.record()
        self._tires = kernel_argument(as_one(vehicle.tires()))
        self.heights = self.car.static_wheel_height - vehicle.cg_height
        self.engine = mujoco.MjModel.from_xml_string(self._bodies())
        self.data = mujoco.MjData(self.engine)
        self._outputs = np.full(1, 0.0, OUTPUTS)
        self._outputs["road_friction"] = 1.0
        self.outputs = self._outputs[0]
        self.coordinates = np.zeros(25)
        self.coordinates[[2, 3]] = vehicle.cg_height, 1.0
        self.coordinates[SPEEDS.start] = speed
        self.coordinates[SPINS] = speed / self.car.static_loaded_radius

    def _bodies(self) -> str:
        car, wheels = self.car, ""
        for i in range(4):
            axle = "front" if i < FIRST_WHEELS["rear"] else "rear"
            left, up = arm(self.vehicle, axle)
            wheels += ARM.format(
                x=car.x[i],
                y=car.y[i],
                z=self.heights[i],
                pivot_y=-left * np.sign(car.y[i]),
                pivot_z=PIVOTS[axle][1] - self.heights[i],
                mass=car.unsprung_mass[i],
                inertia=MASSLESS,
            )
            assert up == self.heights[i] - PIVOTS[axle][1]
        return with_body(car, wheels)

    @property
    def rotation(self) -> np.ndarray:
        """Body to ground."""
        return self.data.xmat[1].reshape(3, 3)

    def step(self, programme, time: float, step: float) -> None:
        """One Runge-Kutta step from `time` (s) on, under a programme of commands."""
        commands = programme(time + step * np.array([0.0, 0.5, 1.0]))["steering"]
        start = self.coordinates
        first = self.rates(start, commands[0])
        second = self.rates(start + step / 2 * first, commands[1])
        third = self.rates(start + step / 2 * second, commands[1])
        fourth = self.rates(start + step * third, commands[2])
        self.coordinates = start + step / 6 * (first + 2 * (second + third) + fourth)
        mujoco.mju_normalize4(self.coordinates[3:POSE])
        self.rates(self.coordinates, commands[2])

    def rates(self, coordinates: np.ndarray, steering: float) -> np.ndarray:
        """Time derivative of the coordinates at a front road-wheel angle (rad)."""
        engine, data, rates = self.engine, self.data, np.empty_like(coordinates)
        data.qpos[:], data.qvel[:] = coordinates[PLACES], coordinates[SPEEDS]
        mujoco.mj_fwdPosition(engine, data)
        mujoco.mj_fwdVelocity(engine, data)
        data.qfrc_applied[:] = 0.0
        self._apply_strut_forces()
        rates[SPINS] = self._apply_contact_forces(coordinates[SPINS], steering)
        mujoco.mj_fwdAcceleration(engine, data)
        rates[:3], rates[POSE : PLACES.stop] = data.qvel[:3], data.qvel[TWIST:]
        half_turning = np.array([0.0, *data.qvel[3:TWIST] / 2])
        mujoco.mju_mulQuat(rates[3:POSE], coordinates[3:POSE], half_turning)
        rates[SPEEDS] = data.qacc_smooth
        return rates

    def _apply_strut_forces(self) -> None:
        """Spring and damper on the wheel's travel, as a torque about its hinge."""
        car, data = self.car, self.data
        in_body = (data.xpos[2:] - data.xpos[1]) @ self.rotation
        from_pivot = in_body[:, 1] - np.sign(car.y) * np.repeat(
            [PIVOTS["front"][0], PIVOTS["rear"][0]], 2
        )
        rates = from_pivot * data.qvel[TWIST:]
        compression = car.static_suspension_compression + in_body[:, 2] - self.heights
        force = car.spring_stiffness * compression + car.damping * rates
        data.qfrc_applied[TWIST:] -= force * from_pivot

    def _apply_contact_forces(self, spins: np.ndarray, steering: float) -> np.ndarray:
        """Apply the contact forces to the bodies; returns the spin accelerations (rad/s^2)."""
        car, data, outputs = self.car, self.data, self.outputs
        jacobians, axes = np.zeros((4, 3, self.engine.nv)), np.empty((4, 2, 3))
        for i in range(4):
            angle = steering if i < 2 else 0.0
            body = self.wheels[i]
            axis = data.xmat[body].reshape(3, 3) @ [-np.sin(angle), np.cos(angle), 0.0]
            cosine = np.hypot(axis[0], axis[1])
            ahead = np.cross(axis, UP) / cosine
            axes[i] = ahead, np.cross(UP, ahead)
            radius = data.xpos[body][2] / cosine
            support = car.tire_stiffness[i] * (car.tire_radius[i] - radius) / cosine
            outputs["normal_force"][i] = max(support, 0.0)
            outputs["loaded_radius"][i] = radius = min(radius, car.tire_radius[i])
            outputs["inclination"][i] = np.arctan2(axis[2], cosine)
            contact = data.xpos[body] + radius * (axis[2] * axis - UP) / cosine
            mujoco.mj_jac(self.engine, data, jacobians[i], None, contact, body)
            velocity = jacobians[i] @ data.qvel
            outputs["rolling"][i], outputs["sliding"][i] = axes[i] @ velocity
        outputs["rolling_radius"] = outputs["loaded_radius"]
        outputs["tread"] = outputs["loaded_radius"] * spins
        tires, seen = self._tires[0], kernel_argument(self._outputs)
        outputs["side"] = np.concatenate([tires.front.side[:2], tires.rear.side[2:]])
        steady_state_slip(seen[0])
        tire_forces(self._tires, seen)
        along, across = outputs["tire_longitudinal"], outputs["tire_lateral"]
        for i in range(4):
            force = along[i] * axes[i, 0] + across[i] * axes[i, 1] + outputs["normal_force"][i] * UP
            data.qfrc_applied += force @ jacobians[i]
        return -outputs["loaded_radius"] * along / car.wheel_inertia
