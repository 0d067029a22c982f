"""The simulated vehicle: reset it, step it, read its state. Everything else builds on this."""

import functools

import numpy as np

from vehicle_roll_sim.input_errors import given
from vehicle_roll_sim.model.compiled.jit import interruptible, kernel_argument, silently
from vehicle_roll_sim.model.equilibrium import equilibrium
from vehicle_roll_sim.model.integration.actuated import advance_actuated
from vehicle_roll_sim.model.integration.advance import NANOSECONDS, advance
from vehicle_roll_sim.model.integration.events import Condition, no_events, plausible_magnitudes
from vehicle_roll_sim.model.integration.integrator import KEPT, STAGE_VECTORS
from vehicle_roll_sim.model.records import OUTPUTS, STATE, STATE_NAMES, STATE_SIZE, element_names
from vehicle_roll_sim.model.roll_axis import roll_axis_depth
from vehicle_roll_sim.simulation.actuators import Actuation
from vehicle_roll_sim.simulation.advance_address import address_of_advance
from vehicle_roll_sim.simulation.body_modes import check_step_on_body
from vehicle_roll_sim.simulation.command import IDLE, Command, Programme, records_of
from vehicle_roll_sim.simulation.limits import (
    DEFAULT_ROLLOVER_ANGLE,
    DEFAULT_SPEED,
    DEFAULT_STEP,
    MAXIMUM_SPEED,
    ROLLOVER_ANGLES,
    SHORTEST_STEP,
    absent_states,
    limits_of,
    slowest,
    whole_steps,
    within,
)
from vehicle_roll_sim.simulation.options import Options, options_for
from vehicle_roll_sim.simulation.plant import Plant
from vehicle_roll_sim.simulation.readable import LONGEST_STEP, Readable
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.sensors import Sensors
from vehicle_roll_sim.simulation.snapshot import identity
from vehicle_roll_sim.simulation.stability import Modes
from vehicle_roll_sim.vehicle.air_parameters import has_air_forces
from vehicle_roll_sim.vehicle.parameters import Vehicle


class Simulation(Readable):
    """A simulation of one vehicle, by default with the 14-degree-of-freedom model.

    vehicle: the vehicle to simulate. options: model and variants of the equations. step:
    integration step (s), rounded to whole nanoseconds. rollover_angle: roll angle that counts as a
    rollover (rad), at which a run stops without `body_contact`. road: slope and features of the
    road. check_step: whether `reset`, or a first `step` without `reset`, refuses an unstable step.
    Raises InputError for invalid arguments.

    It starts in static equilibrium at 50 km/h. Attributes, all at the present simulated time:

    - `time` (s) and `time_ns` (ns): since the last reset, an exact multiple of the step
    - `state`: a STATE record: `.roll`, `.u`, `.wheel_speed[LF]`, ... (model.records)
    - `outputs`: an OUTPUTS record: `.normal_force`, `.slip_angle`, `.acceleration`, ...
    - `model_state`, `state_names`: the states of the chosen model and their names
    - `events`: an EVENTS record: lift-off and rollover times, peaks (model.integration.events)
    - `feels_wind`: whether the vehicle has air forces; commands of a wind are refused otherwise
    - `takes`: the same, and whether the road takes heights and frictions as commands
    - `has_actuators`, `actuation`: whether commands pass through actuators, and their state
    - `has_sensors`, `sensors`: whether quantities are measured, and `sensors["gyro"]` ...
    - `ground`: the features of the road, an array of numbers (model.road.layout)
    - `condition`: RUNNING, or why the run has stopped; `implausible`: the state that diverged

    Units are SI and radians. The records are views of memory that the next step overwrites: copy
    values to keep them, or take a `snapshot`. A copied or pickled simulation is independent of the
    original and continues bit for bit like it. States and outputs that the model does not have are
    nan. In the 8 DOF model x, y, u and v are those of the point of the roll axis below the c.g.;
    `cg_motion` gives the c.g. itself in every model.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        options: Options | None = None,
        *,
        step: float = DEFAULT_STEP,
        rollover_angle: float = DEFAULT_ROLLOVER_ANGLE,
        road: Road | None = None,
        check_step: bool = True,
    ):
        before = set(vars(self))
        self.vehicle = given("vehicle", vehicle, Vehicle)
        self.options = given("options", options or options_for(vehicle), Options).for_vehicle(
            vehicle
        )
        self.road = given("road", road or Road(), Road)
        self.feels_wind = has_air_forces(vehicle)
        self.takes = (self.feels_wind, self.road.is_commanded)
        step = within("step", step, SHORTEST_STEP, LONGEST_STEP, "s")
        self.step_ns = round(step * NANOSECONDS)
        self.rollover_angle = within("rollover_angle", rollover_angle, *ROLLOVER_ANGLES, "rad")
        plant = Plant.of(vehicle, self.options, self.road)
        self._vehicle, self._tires = plant.vehicle, plant.tires
        self._limits = limits_of(self.options, self.rollover_angle)
        self.state_names = element_names(self.options.states)
        self._places = np.array([STATE_NAMES.index(name) for name in self.state_names])
        depth = roll_axis_depth(kernel_argument(self._vehicle)[0])
        self._axis_depth = depth if self.options.has_eight_dof else None
        self._absent = absent_states(self.options)
        self._records = (*plant[:-1], self._limits)
        self.ground = plant.ground
        self._plant = plant.arguments(self._limits, IDLE.records())
        self.actuation = Actuation(vehicle, self.step_ns)
        self.has_actuators = self.actuation.is_present
        self.sensors = Sensors(vehicle, self.step_ns, self._axis_depth)
        self.has_sensors = self.sensors.is_present
        self._state = np.zeros(1, STATE)
        self._vector = self._state.view(np.float64)
        self._outputs = np.full(1, np.nan, OUTPUTS)
        self._output_vector = self._outputs.view(np.float64)
        self._events = no_events()
        self._stages = np.zeros((STAGE_VECTORS, STATE_SIZE))
        self._own = (self._state, self._outputs, self._events, self._stages)
        self._memory = (*self._own, self.actuation.memory, *self.sensors.memory)
        self.state, self.outputs, self.events = self._state[0], self._outputs[0], self._events[0]
        self._modes = Modes(plant, self._places)
        self._checks_step, self._checked_speed = check_step, None
        self._start(self._equilibrium(DEFAULT_SPEED))
        self._built = {"_built", "_identity", *vars(self)} - before

    @functools.cached_property
    def _identity(self) -> str:
        described = (*self._records, self.ground, self.actuation.actuators)
        described = (*described, *self.sensors.described)
        return identity(type(self).__name__, described, self.step_ns)

    def reset(self, speed: float = DEFAULT_SPEED) -> None:
        """Reset to time 0 and static equilibrium, rolling freely straight ahead at `speed` (m/s).

        Raises InputError for an invalid speed, and for a step that is unstable at this speed.
        """
        speed = within("speed", speed, slowest(self.options), MAXIMUM_SPEED, "m/s")
        start = self._equilibrium(speed)
        self._check_start(speed, start)
        self._start(start)

    def _equilibrium(self, speed: float) -> np.ndarray:
        start = equilibrium(
            self._vehicle, self._tires, speed, is_kinematic=self.options.is_kinematic
        )
        for name in self._absent:
            start[name] = np.nan
        return start

    def _check_start(self, speed: float, start: np.ndarray) -> None:
        """Raise InputError if a run cannot start on the road, or with the integration step.

        start: a STATE record, shape (1,), the equilibrium at this speed (m/s).
        """
        if speed != self._checked_speed:
            self.road.check_start(self._vehicle[0])
        if self._checks_step and speed != self._checked_speed:
            if self.options.body_contact:
                check_step_on_body(self._vehicle[0], self.step_ns / NANOSECONDS)
            self._modes.check_start(start.view(np.float64), self.step_ns / NANOSECONDS)
        self._checked_speed = speed

    def place(self, x: float, y: float, yaw: float, command: Command | None = None) -> None:
        """Move the c.g. to x, y (m) and turn the heading to `yaw` (rad); all else stays as it is.

        Velocities turn with the vehicle. The height is kept over the road, that below the c.g.
        command: the one applied last, for the outputs. Raises InputError for a number that is not
        finite, or one that no vehicle reaches.
        """
        for name, value in {"x": x, "y": y, "yaw": yaw}.items():
            most = float(plausible_magnitudes()[0][name])
            within(name, value, -most, most, "m" if name != "yaw" else "rad")
        state = self.state
        if self.road.features:
            rise = self.road.surface(x, y)[0] - self.road.surface(*self.cg_motion[:2])[0]
            state["z"] += rise
            state["tire_compression"] -= rise
        state["x"], state["y"], state["yaw"] = 0.0, 0.0, yaw
        ahead, left, *_ = self.cg_motion  # of the c.g. from the point that the states describe
        state["x"], state["y"] = x - ahead, y - left
        self._stages[KEPT] = self.state_vector
        before = self.condition
        self._advance(self.acting(command or Command()).records(), 0)
        if before is not Condition.RUNNING:
            self.condition = before

    def roll_freely(self, speed: float) -> None:
        """Bring the vehicle to static equilibrium at `speed` (m/s) where it is, as it heads.

        Time goes on; all else is as after a reset. Raises InputError like `reset`.
        """
        (x, y, *_), yaw, time_ns = self.cg_motion, float(self.state["yaw"]), self.time_ns
        self.reset(speed)
        self.time_ns = time_ns
        self.place(x, y, yaw)

    def _start(self, state: np.ndarray) -> None:
        self._state[:], self._events[:] = state, no_events()
        self._stages[KEPT] = self.state_vector
        self.actuation.rest()
        self.sensors.rest()
        self.time_ns = 0
        self.condition, self.implausible = Condition.RUNNING, None
        self._advance(IDLE.records(), 0)
        self.sense()

    def step(self, command: Command | Programme, duration: float) -> Condition:
        """Advance by `duration` (s, a multiple of the step), or until the run must stop.

        A Command is held. A Programme is evaluated at every stage of the integration, with times
        since the reset (s); if it returns a single record, that is held. A run that has stopped
        remains as it is until a reset. Returns the condition. Raises InputError, also for a wind
        that would have no effect.
        """
        steps = whole_steps(duration, self.step_ns, "duration")
        if self._checked_speed is None:
            self._check_start(DEFAULT_SPEED, self._equilibrium(DEFAULT_SPEED))
        end = self.time_ns + steps * self.step_ns
        while self.condition is Condition.RUNNING and self.time_ns < end:
            if self.has_sensors:
                until = min(end, self.sensors.until(self.time_ns))
                steps = (until - self.time_ns) // self.step_ns
            records = records_of(command, functools.partial(self.stage_times, steps), *self.takes)
            self._advance(records, steps)
            if self.has_sensors:
                self.sense()
        return self.condition

    def _build(self, arguments: dict) -> None:
        Simulation.__init__(self, **arguments)

    def _arguments(self) -> dict:
        """Constructor arguments of a simulation that accepts snapshots of this one."""
        return {
            "vehicle": self.vehicle,
            "options": self.options,
            "step": self.step_ns / NANOSECONDS,
            "rollover_angle": self.rollover_angle,
            "road": self.road,
            "check_step": self._checks_step,
        }

    def _advance(self, commands: np.ndarray, steps: int) -> None:
        state, *others = self.parts()
        arguments = (state, commands, steps, self.time_ns, self.step_ns, *others)
        kernel = advance
        if self.has_actuators and steps:
            kernel = advance_actuated
            arguments = (address_of_advance(), arguments, self.actuation.arguments)
        with silently():  # divergence is detected from the result
            taken, condition, culprit = interruptible(kernel, arguments)
        self.note_moved(self.time_ns + taken * self.step_ns, condition, culprit)
