"""The vehicle in an independent multibody engine (MuJoCo), for verification.

One free body and four point masses that slide along its z axis. The engine has the masses and
joints and computes all of the mechanics. Only the forces come from this module, evaluated at every
stage of the integration from the engine's own state: springs and dampers along the struts, and at
the contact points the normal loads and the forces of the Magic Formula. The wheel spins are
integrated along with the engine's state, without brakes or rolling resistance; there is no drag.
"""

import math
from types import SimpleNamespace

import mujoco
import numpy as np

from vehicle_roll_sim.model.compiled.jit import kernel, kernel_argument
from vehicle_roll_sim.model.contact import steady_state_slip
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.model.integration.events import (
    Condition,
    condition_of,
    note_lift_offs,
    note_peaks,
    note_rollover,
)
from vehicle_roll_sim.model.records import LF, LR, RF, RR, WHEEL_COUNT
from vehicle_roll_sim.model.tire.coefficients import as_one
from vehicle_roll_sim.model.tire.loads import terms_of_loads
from vehicle_roll_sim.model.tire.magic_formula import forces_at_slips
from vehicle_roll_sim.model.tire.radii import rolling_radii
from vehicle_roll_sim.paper.engine_model import engine_model
from vehicle_roll_sim.simulation.limits import DEFAULT_ROLLOVER_ANGLE, DEFAULT_STEP
from vehicle_roll_sim.simulation.options import MULTIBODY
from vehicle_roll_sim.simulation.plant import Plant
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.actuator_parameters import refuse_actuators
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.plausibility import unwarned

POSE = 7
"""Number of coordinates of the body: position, then quaternion; those of the slides follow."""
TWIST = 6
"""Number of velocities of the body: linear (ground frame), then body rates; then the slides."""
PLACES = slice(0, POSE + WHEEL_COUNT)
SPEEDS = slice(PLACES.stop, PLACES.stop + TWIST + WHEEL_COUNT)
SPINS = slice(SPEEDS.stop, SPEEDS.stop + WHEEL_COUNT)
"""Parts of the integrated vector: the engine's positions and velocities, and the wheel spins
(rad/s)."""
OTHER_SIDE = [RF, LF, RR, LR]
"""The wheel on the other side of each wheel's axle."""
BODY, FIRST_WHEEL = 1, 2
"""Indices of the bodies in the engine."""


@kernel
def _roll_on_tires(spins, tires, outputs):
    """Slip, forces and moments of the wheels that spin at `spins` (rad/s), without lag.

    tires: an array of one TIRES record. outputs: an array of one OUTPUTS record with normal loads,
    loaded radii, inclinations and velocities. It takes 20 us to pass a record to compiled code, and
    far less to pass an array.
    """
    both, seen = tires[0], outputs[0]
    terms_of_loads(both, seen)
    rolling_radii(spins, both, seen)
    for i in range(WHEEL_COUNT):
        seen.tread[i] = seen.rolling_radius[i] * spins[i]
    steady_state_slip(seen)
    forces_at_slips(both, seen)


class Multibody(Simulation):
    """A Simulation, usable in `run`, with the engine in place of the model's equations.

    It has the states of the model and the outputs that a history contains. Tire compressions follow
    from the heights of the wheels, whatever `state` contained before; the wheel angles are nan.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        *,
        step: float = DEFAULT_STEP,
        rollover_angle: float = DEFAULT_ROLLOVER_ANGLE,
    ):
        refuse_actuators(vehicle, "no value with the multibody engine, which has no actuators")
        with unwarned():  # Simulation warns
            plant = Plant.of(vehicle, MULTIBODY)
        (car,), self._seen_tires = plant.vehicle, kernel_argument(as_one(plant.tires))
        self._car = SimpleNamespace(**{name: car[name] for name in car.dtype.names})
        front, rear = plant.tires["side"]
        self._side = np.concatenate((front[:LR], rear[LR:]))
        self._engine = engine_model(car)
        self._data = mujoco.MjData(self._engine)
        self._rotation = self._data.xmat[BODY].reshape(3, 3)
        self._wheel_centres = self._data.xpos[FIRST_WHEEL:]
        self._jacobian = np.zeros((WHEEL_COUNT, 3, self._engine.nv))
        self._turning = np.zeros((WHEEL_COUNT, 3, self._engine.nv))
        super().__init__(vehicle, MULTIBODY, step=step, rollover_angle=rollover_angle)
        self._built = set(vars(self))

    def _build(self, arguments: dict) -> None:
        Multibody.__init__(self, **arguments)

    def _arguments(self) -> dict:
        kept = ("vehicle", "step", "rollover_angle")
        return {name: value for name, value in super()._arguments().items() if name in kept}

    def _advance(self, commands: np.ndarray, steps: int) -> None:
        """Advance as in Simulation: 2 * steps + 1 COMMAND records, or one that is held."""
        commands = np.broadcast_to(commands, 2 * steps + 1)
        coordinates, step = self.coordinates(), self.step_ns / NANOSECONDS
        slope = self._arrive(coordinates, commands[0], 0.0)
        for first in range(0, 2 * steps, 2):
            midway, after = commands[first + 1 : first + 3]
            coordinates = self._stepped(coordinates, slope, midway, after, step)
            self.time_ns += self.step_ns
            slope = self._arrive(coordinates, after, step)
            self.condition = Condition(condition_of(self.state_vector, self._limits[0]))
            if not np.isfinite(coordinates).all():
                self.condition = Condition.DIVERGED
            if self.condition is not Condition.RUNNING:
                break

    def _stepped(self, start, first, midway, after, step: float) -> np.ndarray:
        """Coordinates after one Runge-Kutta step (s); `first` is the slope at the start.

        midway, after: COMMAND records of the middle and the end of the step.
        """
        second = self.rates(start + step / 2 * first, midway)
        third = self.rates(start + step / 2 * second, midway)
        fourth = self.rates(start + step * third, after)
        coordinates = start + step / 6 * (first + 2 * (second + third) + fourth)
        mujoco.mju_normalize4(coordinates[3:POSE])
        return coordinates

    def _arrive(self, coordinates: np.ndarray, command: np.record, step: float) -> np.ndarray:
        """Update state, outputs and events after a step (s); returns the slope there."""
        start, roll_before = self.time - step, float(self.state["roll"])
        slope = self.rates(coordinates, command)
        self._show(coordinates)
        (events,), limit = kernel_argument(self._events), self._limits[0]["rollover_angle"]
        note_lift_offs(start, step, self.outputs["support"], events)
        note_rollover(start, step, roll_before, self.state["roll"], limit, events)
        note_peaks(self.time, self.state_vector, self._seen_tires[0], self.outputs, events)
        return slope

    def coordinates(self) -> np.ndarray:
        """The vector of PLACES, SPEEDS and SPINS that corresponds to `state`."""
        car, state, coordinates = self._car, self.state, np.zeros(SPINS.stop)
        places, speeds, rotation = coordinates[PLACES], coordinates[SPEEDS], np.zeros(9)
        places[:3] = state.x, state.y, state.z
        mujoco.mju_euler2Quat(places[3:POSE], (state.yaw, state.pitch, state.roll), "zyx")
        mujoco.mju_quat2Mat(rotation, places[3:POSE])
        places[POSE:] = state.suspension_compression - car.static_suspension_compression
        speeds[:3] = rotation.reshape(3, 3) @ (state.u, state.v, state.w)
        speeds[3:TWIST] = state.roll_rate, state.pitch_rate, state.yaw_rate
        strut_top = state.w + car.y * state.roll_rate - car.x * state.pitch_rate
        speeds[TWIST:] = state.unsprung_velocity - strut_top
        coordinates[SPINS] = state.wheel_speed
        return coordinates

    def _show(self, coordinates: np.ndarray) -> None:
        """Set `state` from the coordinates, which the engine must have been evaluated at."""
        rotation, state, velocity = self._rotation, self.state, np.zeros(6)
        places, speeds = coordinates[PLACES], coordinates[SPEEDS]
        state["x"], state["y"], state["z"] = places[:3]
        state["roll"] = math.atan2(rotation[2, 1], rotation[2, 2])
        state["pitch"] = math.atan2(-rotation[2, 0], math.hypot(*rotation[2, 1:]))
        state["yaw"] = math.atan2(rotation[1, 0], rotation[0, 0])
        state["u"], state["v"], state["w"] = speeds[:3] @ rotation
        state["roll_rate"], state["pitch_rate"], state["yaw_rate"] = speeds[3:TWIST]
        state["suspension_compression"] = places[POSE:] + self._car.static_suspension_compression
        state["tire_compression"] = self._car.tire_radius - self._wheel_centres[:, 2]
        for i in range(WHEEL_COUNT):
            kind, wheel = mujoco.mjtObj.mjOBJ_XBODY, FIRST_WHEEL + i
            mujoco.mj_objectVelocity(self._engine, self._data, kind, wheel, velocity, True)
            state["unsprung_velocity"][i] = velocity[-1]
        state["wheel_speed"], state["wheel_angle"] = coordinates[SPINS], math.nan

    def rates(self, coordinates: np.ndarray, command: np.record) -> np.ndarray:
        """Time derivative of coordinates under a COMMAND record; also updates `outputs`."""
        engine, data, rates = self._engine, self._data, np.empty_like(coordinates)
        data.qpos[:], data.qvel[:] = coordinates[PLACES], coordinates[SPEEDS]
        mujoco.mj_fwdPosition(engine, data)
        mujoco.mj_fwdVelocity(engine, data)
        data.qfrc_applied[:TWIST], data.qfrc_applied[TWIST:] = 0.0, -self._strut_forces(command)
        rates[SPINS] = self._apply_contact_forces(coordinates[SPINS], command)
        mujoco.mj_fwdAcceleration(engine, data)
        rates[:3], rates[POSE : PLACES.stop] = data.qvel[:3], data.qvel[TWIST:]
        half_turning = np.array([0.0, *data.qvel[3:TWIST] / 2])
        mujoco.mju_mulQuat(rates[3:POSE], coordinates[3:POSE], half_turning)
        rates[SPEEDS] = data.qacc_smooth
        self.outputs["acceleration"] = self._frame_2() @ data.qacc_smooth[:3]
        return rates

    def _strut_forces(self, command: np.record) -> np.ndarray:
        """Spring, damper, bar and active force, positive in compression (N; eq. 23)."""
        car, slides, speeds = self._car, self._data.qpos[POSE:], self._data.qvel[TWIST:]
        compression = car.static_suspension_compression + slides
        bars = car.bar_rate * (slides - slides[OTHER_SIDE])
        passive = car.spring_stiffness * compression + car.damping * speeds + bars
        return passive + command["normal_force"]

    def _apply_contact_forces(self, spins: np.ndarray, command: np.record) -> np.ndarray:
        """Apply the contact forces to the bodies; returns the spin accelerations (rad/s^2)."""
        car, data, rotation, frame_2 = self._car, self._data, self._rotation, self._frame_2()
        compression = car.tire_radius - self._wheel_centres[:, 2]
        support = car.tire_stiffness * compression
        support *= 1.0 + car.tire_progression * np.maximum(compression, 0.0)
        self.outputs["support"] = support
        self.outputs["normal_force"] = np.maximum(support, 0.0)
        radius = car.tire_radius - np.maximum(compression, 0.0) / rotation[2, 2]  # (15, 16)
        for i, point in enumerate(self._wheel_centres - radius[:, None] * rotation[:, 2]):
            wheel = FIRST_WHEEL + i
            jacobians = self._jacobian[i], self._turning[i]
            mujoco.mj_jac(self._engine, data, *jacobians, point, wheel)
        velocities = self._jacobian @ data.qvel @ frame_2.T
        self.outputs["commanded_steering"] = command["steering"], command["rear_steering"]
        self.outputs["steering"] = np.repeat(self.outputs["commanded_steering"], 2)
        along, forces = self._tire_forces(velocities, spins, radius)
        data.qfrc_applied += (forces @ frame_2).ravel() @ self._jacobian.reshape(forces.size, -1)
        moments, about_axes = self._contact_moments()
        data.qfrc_applied += (moments @ frame_2).ravel() @ self._turning.reshape(moments.size, -1)
        torques = command["wheel_torque"] - radius * along + about_axes
        missing = command["speed_hold_target"] - rotation[:, 0] @ data.qvel[:3]
        torques[LR:] += command["speed_hold_gain"] * missing
        return torques / car.wheel_inertia

    def _tire_forces(self, velocities, spins, radius) -> tuple[np.ndarray, np.ndarray]:
        """Fxt of the wheels (4,), and the contact forces in frame 2 (4, 3) (N)."""
        outputs = self.outputs
        s, c = np.sin(outputs["steering"]), np.cos(outputs["steering"])
        ug, vg = velocities[:, 0], velocities[:, 1]
        outputs["rolling"], outputs["sliding"] = ug * c + vg * s, vg * c - ug * s
        outputs["loaded_radius"], outputs["side"] = radius, self._side
        outputs["road_friction"] = 1.0
        outputs["inclination"] = self._inclinations(s, c)
        _roll_on_tires(spins, self._seen_tires, kernel_argument(self._outputs))
        along, across = outputs["tire_longitudinal"], outputs["tire_lateral"]
        outputs["longitudinal_force"] = ahead = along * c - across * s  # (3)
        outputs["lateral_force"] = left = across * c + along * s  # (4)
        return along, np.column_stack((ahead, left, outputs["normal_force"]))

    def _inclinations(self, s: np.ndarray, c: np.ndarray) -> np.ndarray:
        """Inclination of the wheels to the road (rad), at sine and cosine of their steering."""
        spin_axes = np.column_stack((-s, c, np.zeros(WHEEL_COUNT))) @ self._rotation.T
        return np.arcsin(spin_axes[:, 2]) + self._car.camber

    def _contact_moments(self) -> tuple[np.ndarray, np.ndarray]:
        """Moments at the contact points in frame 2 (4, 3), and about the spin axes (4,) (N m)."""
        outputs = self.outputs
        shift = self._car.tire_lateral_compliance * outputs["tire_lateral"]
        about_x = outputs["overturning_moment"] + shift * outputs["normal_force"]
        about_y = outputs["rolling_resistance_moment"]
        about_z = outputs["aligning_moment"] - shift * outputs["tire_longitudinal"]
        s, c = np.sin(outputs["steering"]), np.cos(outputs["steering"])
        moments = np.column_stack((about_x * c - about_y * s, about_y * c + about_x * s, about_z))
        inclination = outputs["inclination"]
        return moments, about_y * np.cos(inclination) + about_z * np.sin(inclination)

    def _frame_2(self) -> np.ndarray:
        """The axes of frame 2 (forward, left, up) in the ground frame as rows, shape (3, 3)."""
        yaw = math.atan2(self._rotation[1, 0], self._rotation[0, 0])
        s, c = math.sin(yaw), math.cos(yaw)
        return np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
