"""The runs behind the figures and claims of the paper, each simulated once."""

import dataclasses
import functools
import importlib.util
from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.model.roll_plane import RollPlane
from vehicle_roll_sim.runs import metrics
from vehicle_roll_sim.runs.compiled_run import compiled_run
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.simulation.options import ASYMMETRIC, MULTIBODY, Options
from vehicle_roll_sim.simulation.simulation import Simulation
from vehicle_roll_sim.vehicle.parameters import Vehicle

STEP_STEER, RAMP_STEER, J_TURN = "step_steer", "ramp_steer", "j_turn"
NO_ROLL_CENTRE = "no roll centre"
UPRIGHT_TIRES = "tire normal to the ground"
ASYMMETRIC_LINKS = "asymmetric link load transfer"
SAME_AS_ENGINE = "no roll centre, Euler terms"
ENGINE = "multibody engine"
TRANSIENT = "model 1 with transient slip"
OPTIONS = {
    NO_ROLL_CENTRE: Options(no_roll_centre=True, steady_state_slip=True),
    UPRIGHT_TIRES: Options(tire_normal_to_ground=True, steady_state_slip=True),
    ASYMMETRIC_LINKS: Options(link_load_transfer=ASYMMETRIC, steady_state_slip=True),
    SAME_AS_ENGINE: MULTIBODY,
    TRANSIENT: Options(),
}
"""Variants of model 1; every other case, except the engine, is named after its model."""
VARIANTS = (NO_ROLL_CENTRE, UPRIGHT_TIRES, ASYMMETRIC_LINKS, "8dof")
SIMPLIFIED = ("1", "1a", "1b", "1c-i", "1c-ii", "1c-iii", "1c-iv")
RUNS = (
    *((STEP_STEER, case) for case in SIMPLIFIED),
    *((RAMP_STEER, case) for case in SIMPLIFIED),
    *((RAMP_STEER, case) for case in ("1b-turning-kept", "1b-static-strut")),
    *((STEP_STEER, case) for case in ("1b-mass-lumped", "1b-no-strut", "8dof-rigid-tires")),
    *((STEP_STEER, case) for case in VARIANTS),
    *((RAMP_STEER, case) for case in VARIANTS),
    (STEP_STEER, TRANSIENT),
    *((J_TURN, case) for case in ("1", SAME_AS_ENGINE, ENGINE)),
)
"""(manoeuvre, case) of every run."""
SAMPLE = 0.001
"""s: every integration step, for exact peaks and event times."""
_STEP = STANDARD[STEP_STEER]
STEERING_HELD = _STEP.start + _STEP.amplitude / _STEP.rate
"""s: time from which the steering angle of the step steer is constant."""


@dataclasses.dataclass(frozen=True)
class Response:
    """A run: its history with one row per step, its EVENTS record, and how it ended."""

    history: History
    events: np.record
    condition: Condition

    @property
    def time(self) -> np.ndarray:
        return self.history["time"]

    @functools.cached_property
    def roll(self) -> np.ndarray:
        """Roll angle (deg), shape (rows,)."""
        return np.degrees(self.history["roll"])

    @functools.cached_property
    def loads(self) -> np.ndarray:
        """Normal loads (N), shape (rows, 4)."""
        return self.history.wheels("normal_force")

    @functools.cached_property
    def load_transfer(self) -> np.ndarray:
        """Load transfer from left to right (N), shape (rows, 2): front, rear."""
        return metrics.load_transfer(self.loads)

    @property
    def peak_roll(self) -> float:
        """Largest roll angle to either side (deg)."""
        return abs(metrics.peak(self.time, self.roll)[0])

    @property
    def is_complete(self) -> bool:
        """Whether the manoeuvre was driven to its end, without rollover or divergence."""
        return self.condition is Condition.RUNNING

    def steady(self, values: np.ndarray):
        """Mean of a signal of this run over the last 0.5 s."""
        return metrics.steady(self.time, values)

    @property
    def steady_roll(self) -> float:
        return self.steady(self.roll)

    @property
    def frequency(self) -> float:
        """Damped roll frequency after the step steer (Hz)."""
        return metrics.damped_frequency(self.time, self.history["roll_rate"], STEERING_HELD)

    @property
    def lift_offs(self) -> np.ndarray:
        """Lift-off times of lf, rf, lr, rr (s), shape (4,); nan for a wheel that does not lift."""
        return self.events["lift_off_time"]

    @property
    def first_lift_off(self) -> float:
        lifted = self.lift_offs[np.isfinite(self.lift_offs)]
        return float(lifted.min()) if len(lifted) else np.nan

    @property
    def rollover(self) -> float:
        """Time at which the roll angle passes 85 degrees (s); nan if it does not."""
        return float(self.events["rollover_time"][0])


class Study:
    """All runs of one vehicle; `done` is called after each simulated run."""

    def __init__(self, vehicle: Vehicle, done: Callable[[], None] = lambda: None):
        self.vehicle, self._done = vehicle, done
        self._responses: dict[tuple[str, str], Response] = {}
        self.has_engine = importlib.util.find_spec("mujoco") is not None

    @property
    def runs(self) -> list[tuple[str, str]]:
        """RUNS, without those of the multibody engine if it is not installed."""
        return [(name, case) for name, case in RUNS if case != ENGINE or self.has_engine]

    @property
    def weight(self) -> float:
        """Weight of the whole vehicle (N)."""
        return RollPlane(self.vehicle.record()).weight

    def response(self, manoeuvre: str, case: str) -> Response:
        """The run of a case in a manoeuvre of the paper, simulated on first access."""
        key = (manoeuvre, case)
        if key not in self._responses:
            self._responses[key] = self._run(manoeuvre, case)
            self._done()
        return self._responses[key]

    def step(self, case: str) -> Response:
        return self.response(STEP_STEER, case)

    def ramp(self, case: str) -> Response:
        return self.response(RAMP_STEER, case)

    def j_turn(self, case: str) -> Response:
        return self.response(J_TURN, case)

    def _run(self, name: str, case: str) -> Response:
        simulation = self._simulation(case)
        manoeuvre = STANDARD[name].for_vehicle(self.vehicle, simulation.options)
        simulation.reset(manoeuvre.speed)
        drive = run if case == ENGINE else compiled_run  # the same history, in a third of the time
        history = drive(simulation, manoeuvre, manoeuvre.duration, sample=SAMPLE)
        return Response(history, simulation.events, simulation.condition)

    def _simulation(self, case: str) -> Simulation:
        if case == ENGINE:
            from vehicle_roll_sim.paper.multibody import Multibody  # needs mujoco

            return Multibody(self.vehicle)
        of_a_model = Options(model=case, steady_state_slip=True) if case not in OPTIONS else None
        return Simulation(self.vehicle, OPTIONS.get(case, of_a_model))
