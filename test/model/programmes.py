"""Commands, runs and single evaluations shared by the tests of the model."""

import dataclasses

import numpy as np

from vehicle_roll_sim import Condition, Options, Simulation, Tire, Vehicle
from vehicle_roll_sim.model.compiled.jit import kernel_argument, silently
from vehicle_roll_sim.model.integration.advance import NANOSECONDS, advance
from vehicle_roll_sim.model.integration.derivatives import derivatives_at
from vehicle_roll_sim.model.records import COMMAND, OUTPUTS, STATE, STATE_SIZE
from vehicle_roll_sim.simulation.command import Programme, records_of
from vehicle_roll_sim.simulation.plant import Plant
from vehicle_roll_sim.simulation.road import Road

SOURCE = Options(steady_state_slip=True)
"""The equations of the source, slip included."""
LEVEL = Road()
SHIFTS = dict.fromkeys(("LHX", "LHY", "LVX", "LVY", "LVYKA"), 1.0)
"""Scaling factors that switch on all that makes a left and a right tire differ."""

INCLINED = {"LGAX": 1.0, "LGAY": 1.0, "PDX3": 1.2, "PKY3": 0.4, "PDY3": 1.9, "PVY3": -0.16}
ROLLING = {"LONGVL": 16.7, "QSY1": 0.0067, "QSY2": 0.0042, "QSY3": 0.0015, "QSY4": 9e-5}
ALIGNING = {
    "QBZ1": 10.6,
    "QBZ2": -1.2,
    "QBZ4": 0.18,
    "QBZ9": 32.0,
    "QCZ1": 1.24,
    "QDZ1": 0.087,
    "QDZ2": -0.006,
    "QDZ4": 2.4,
    "QDZ6": 0.0017,
    "QDZ8": -0.13,
    "QEZ1": -2.3,
    "QHZ1": 0.0014,
    "QHZ3": 0.22,
    "SSZ1": 0.01,
    "SSZ2": 0.035,
    "SSZ3": 0.23,
}
OVERTURNING = {"QSX1": 0.012, "QSX2": 0.64, "QSX3": 0.032}
"""Made-up coefficients of the size of a car tire's: of inclination and of the three moments."""
OWN_RADIUS = {
    "UNLOADED_RADIUS": 0.3,
    "VERTICAL_STIFFNESS": 2e5,
    "BREFF": 8.0,
    "DREFF": 0.27,
    "FREFF": 0.07,
}
"""With these a tire rolls on a radius between the loaded and the free one."""


def with_moments(vehicle: Vehicle) -> Vehicle:
    """The vehicle on leaning wheels whose tires have moments.

    The rear tires have no overturning moment: their contact patches shift instead.
    """
    rear = vehicle.tire.with_coefficients(**INCLINED, **ROLLING, **ALIGNING, **OWN_RADIUS)
    camber = {"front_camber": -0.03, "rear_camber": 0.02}
    return dataclasses.replace(
        vehicle.with_values(camber),
        tire=None,
        front_tire=rear.with_coefficients(**OVERTURNING),
        rear_tire=rear,
        tire_moments=True,
        contact_patch_shift=True,
    )


def ramp_and_hold(start: float, rate: float, amplitude: float, **held) -> Programme:
    """Road-wheel angle from 0 at `start` (s) at `rate` (deg/s, signed) up to `amplitude` (deg).

    held: further fields of the command, constant.
    """

    def programme(times: np.ndarray) -> np.ndarray:
        commands = np.zeros(len(times), COMMAND)
        for name, value in held.items():
            commands[name] = value
        travelled = np.clip((times - start) * abs(rate), 0.0, amplitude)
        commands["steering"] = np.radians(np.copysign(travelled, rate))
        return commands

    return programme


def j_turn(**held) -> Programme:
    """10 degrees in 0.25 s: the vehicle lifts its inner wheels and rolls over."""
    return ramp_and_hold(1.0, 40.0, 10.0, **held)


@dataclasses.dataclass(frozen=True)
class Run:
    """A recorded run: time (s), STATE and OUTPUTS records, one per step and one at the start."""

    time: np.ndarray
    state: np.ndarray
    outputs: np.ndarray


def record_run(simulation: Simulation, command, duration: float) -> Run:
    """Step until `duration` (s) or the run stops, keeping everything after every step.

    Bit for bit what a call of `Simulation.step` for each step gives, in less than half of the time:
    only the first step is such a call, and the commands of all steps are found at once. The vehicle
    must have neither actuators nor sensors, of which only `Simulation.step` takes care.
    """
    assert not simulation.has_actuators
    assert not simulation.has_sensors
    step_ns, begin_ns = simulation.step_ns, simulation.time_ns
    steps = round((duration * NANOSECONDS - begin_ns) / step_ns)
    times = simulation.stage_times(steps)
    commands = records_of(command, lambda: times, *simulation.takes)
    state, *others = simulation.parts()
    states = np.empty((steps + 1, STATE_SIZE))
    outputs = np.empty((steps + 1, OUTPUTS.itemsize // 8))
    states[0], outputs[0] = state, simulation.output_vector
    time, taken = [simulation.time], 0
    while taken < steps and simulation.condition is Condition.RUNNING:
        if taken:
            held = commands if len(commands) == 1 else commands[2 * taken : 2 * taken + 3]
            now = simulation.time_ns
            with silently():
                moved, *ended = advance(state, held, 1, now, step_ns, *others)
            simulation.note_moved(now + moved * step_ns, *ended)
        else:
            simulation.step(command, step_ns / NANOSECONDS)
        taken += 1
        time.append(simulation.time)
        states[taken], outputs[taken] = state, simulation.output_vector
    kept = slice(taken + 1)
    return Run(np.array(time), states[kept].view(STATE)[:, 0], outputs[kept].view(OUTPUTS)[:, 0])


def with_tire(vehicle: Vehicle, side: str | None = None, **coefficients: float) -> Vehicle:
    """The vehicle on its tire with other coefficients, and from the other side if given."""
    tire: Tire = vehicle.tire.with_coefficients(**coefficients)
    tire = dataclasses.replace(tire, side=side or tire.side)
    return dataclasses.replace(vehicle, tire=tire)


class Evaluation:
    """Derivatives and outputs of the model at any state: those of the source, unless told."""

    def __init__(self, vehicle: Vehicle, options: Options = SOURCE, road: Road = LEVEL):
        plant = Plant.of(vehicle, options, road)
        self._plant = plant.arguments()
        self._outputs = np.zeros(1, OUTPUTS)
        self.outputs = self._outputs[0]

    def rates(self, state: np.ndarray, command: np.ndarray) -> np.ndarray:
        """Time derivative, a STATE record, at one STATE record under one COMMAND record."""
        result = np.zeros(STATE_SIZE)
        commands, outputs = np.atleast_1d(command), kernel_argument(self._outputs)
        derivatives_at(_flat(state), commands, self._plant, outputs, result, False)
        return result.view(STATE)[0]


def _flat(state: np.ndarray) -> np.ndarray:
    return np.atleast_1d(np.asarray(state)).view(np.float64).copy()


def largest_difference(mine: np.ndarray, other: np.ndarray, names) -> dict[str, float]:
    """Per signal, the largest difference as a share of the signal's peak over all wheels.

    What both do not have, nan, does not differ.
    """
    differences = {}
    for name in names:
        if inner := mine[name].dtype.names:
            parts = largest_difference(mine[name], other[name], inner)
            differences |= {f"{name}.{part}": most for part, most in parts.items()}
            continue
        known = ~(np.isnan(mine[name]) & np.isnan(other[name]))
        one, two = mine[name][known], other[name][known]
        peak = np.abs(two).max(initial=np.finfo(float).tiny)
        differences[name] = float(np.abs(one - two).max(initial=0.0) / peak)
    return differences
