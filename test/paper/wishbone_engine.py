"""A vehicle on double wishbones in the multibody engine: arms and carriers on real hinges.

Of each linkage the engine has the lower arm and, hinged to it, the carrier with the wheel. The
upper arm, which has no mass, closes the loop: it gives the turn of the carrier as a function of
that of the lower arm. The engine's equations of both hinges are projected onto that function, so
that the loop is closed to rounding at any time.
"""

import mujoco
import numpy as np
from swing_axle_engine import POSE, TWIST, SwingAxleEngine
from wishbones import Linkage

from vehicle_roll_sim import Vehicle
from vehicle_roll_sim.paper.engine_model import MASSLESS, with_body

LINKAGE = """
      <body pos="{x} {arm_y} {arm_z}">
        <joint type="hinge" axis="1 0 0"/>
        <inertial pos="0 0 0" mass="{massless}" diaginertia="{massless} {massless} {massless}"/>
        <body pos="0 {y} {z}">
          <joint type="hinge" axis="1 0 0" pos="0 {ball_y} {ball_z}"/>
          <inertial pos="0 0 0" mass="{mass}" diaginertia="{massless} {massless} {massless}"/>
        </body>
      </body>"""
SIDES = np.array([1.0, -1.0, 1.0, -1.0])
ARMS, CARRIERS = slice(TWIST, TWIST + 8, 2), slice(TWIST + 1, TWIST + 8, 2)
"""Velocities of the hinges of lower arms and carriers, the latter relative to the former."""
BODY = slice(0, TWIST)


class WishboneEngine(SwingAxleEngine):
    """Its coordinates are those of a vehicle on swing axles: the hinges are those of the arms."""

    wheels = (3, 5, 7, 9)

    def __init__(self, vehicle: Vehicle, speed: float):
        of_axles = [Linkage.of(vehicle, axle) for axle in ("front", "front", "rear", "rear")]
        self.linkages = of_axles
        super().__init__(vehicle, speed)

    def _bodies(self) -> str:
        car, wheels = self.car, ""
        for i, (linkage, side) in enumerate(zip(self.linkages, SIDES, strict=True)):
            arm, to_ball = linkage.wheel - linkage.lower, linkage.ball - linkage.wheel
            wheels += LINKAGE.format(
                x=car.x[i],
                arm_y=side * linkage.lower[0],
                arm_z=linkage.lower[1],
                y=side * arm[0],
                z=arm[1],
                ball_y=side * to_ball[0],
                ball_z=to_ball[1],
                mass=car.unsprung_mass[i],
                massless=MASSLESS,
            )
        return with_body(car, wheels)

    def rates(self, coordinates: np.ndarray, steering: float) -> np.ndarray:
        """Time derivative of the coordinates at a front road-wheel angle (rad)."""
        engine, data, rates = self.engine, self.data, np.zeros_like(coordinates)
        places, speeds, spins = coordinates[:11], coordinates[11:21], coordinates[21:]
        arms, turning = places[POSE:], speeds[TWIST:]
        closed = [each.ratio(s * a) for each, s, a in zip(self.linkages, SIDES, arms, strict=True)]
        first = np.array([one for one, _ in closed])
        second = SIDES * [two for _, two in closed]
        carriers = SIDES * [
            each.carrier_turn(s * a) for each, s, a in zip(self.linkages, SIDES, arms, strict=True)
        ]
        data.qpos[:POSE], data.qvel[BODY] = places[:POSE], speeds[BODY]
        data.qpos[POSE::2], data.qpos[POSE + 1 :: 2] = arms, carriers - arms
        data.qvel[ARMS], data.qvel[CARRIERS] = turning, (first - 1) * turning
        mujoco.mj_fwdPosition(engine, data)
        mujoco.mj_fwdVelocity(engine, data)
        data.qfrc_applied[:] = 0.0
        self._apply_strut_forces()
        rates[21:] = self._apply_contact_forces(spins, steering)
        rates[:3], rates[POSE:11] = data.qvel[:3], turning
        mujoco.mju_mulQuat(rates[3:POSE], places[3:POSE], np.array([0.0, *data.qvel[3:TWIST] / 2]))
        rates[11:21] = self._projected(first - 1, second * turning**2)
        return rates

    def _projected(self, ratio: np.ndarray, bend: np.ndarray) -> np.ndarray:
        """Accelerations of body and arms, with carriers that turn by `ratio` times the arms.

        bend: part of the carriers' accelerations that is not that of the arms (rad/s^2).
        """
        engine, data = self.engine, self.data
        mass = np.zeros((engine.nv, engine.nv))
        for column, one in zip(mass, np.eye(engine.nv), strict=True):
            mujoco.mj_mulM(engine, data, column, one)
        onto = np.zeros((engine.nv, TWIST + 4))
        onto[BODY, BODY] = np.eye(TWIST)
        onto[ARMS, TWIST:] = np.eye(4)
        onto[CARRIERS, TWIST:] = np.diag(ratio)
        along = np.zeros(engine.nv)
        along[CARRIERS] = bend
        force = data.qfrc_applied - data.qfrc_bias - mass @ along
        return np.linalg.solve(onto.T @ mass @ onto, onto.T @ force)

    def _apply_strut_forces(self) -> None:
        """Spring and damper on the travel of each wheel, as torques about its two hinges."""
        car, data = self.car, self.data
        place = (data.xpos[list(self.wheels)] - data.xpos[1]) @ self.rotation
        pivots = (data.xanchor[1:] - data.xpos[1]) @ self.rotation
        from_arm, from_ball = (place[:, 1] - pivots[k::2, 1] for k in (0, 1))
        rates = from_arm * data.qvel[ARMS] + from_ball * data.qvel[CARRIERS]
        compression = car.static_suspension_compression + place[:, 2] - self.heights
        force = car.spring_stiffness * compression + car.damping * rates
        data.qfrc_applied[ARMS] -= force * from_arm
        data.qfrc_applied[CARRIERS] -= force * from_ball
