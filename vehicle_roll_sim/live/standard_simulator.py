"""What `simulation_interfaces` asks of a simulator, in terms of a session. No ROS."""

import re
import threading
from typing import NamedTuple, Protocol

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.live.entity_state import EntityState, entity_state, put, set_going
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.live.simulation_interfaces import INVALID_POSE, Code, Feature, Scope, State
from vehicle_roll_sim.model.integration.advance import NANOSECONDS
from vehicle_roll_sim.version import __version__

VEHICLE = "vehicle"
"""The name of the one entity."""
FEATURES = tuple(Feature)


class Control(Protocol):
    """The requests that a simulator fulfils; each answers with success and a message."""

    def reset(self) -> tuple[bool, str]:
        """Return to static equilibrium at time 0."""

    def pause(self, wanted: bool) -> tuple[bool, str]:
        """Pause, or go on."""

    def step(self) -> tuple[bool, str]:
        """Run one period while paused."""


class Verdict(NamedTuple):
    """The result of a request: its code, and what is to be said about it."""

    code: int
    message: str = ""


FINE = Verdict(Code.OK)


class StandardSimulator:
    """Fulfils requests of the standard. lock: guards the session."""

    def __init__(self, session: Session, control: Control, lock: threading.Lock):
        self._session, self._control, self._lock = session, control, lock
        self._was_stopped = False

    @property
    def about(self) -> str:
        """What else a caller may want to know of this simulator."""
        period = self._session.period_ns / NANOSECONDS
        step = f"a step is a publish period, {period:g} s"
        return f"vehicle_roll_sim {__version__}; {step}; the entity is {VEHICLE}"

    def state(self) -> State:
        """STOPPED from the request to stop until the simulation is played, paused or stepped."""
        if not self._session.paused:
            return State.PLAYING
        is_at_start = self._session.simulation.time_ns == 0
        return State.STOPPED if self._was_stopped and is_at_start else State.PAUSED

    def set_state(self, wanted: int) -> Verdict:
        """Play, pause, or stop, which is to pause and reset."""
        if wanted == State.QUITTING:
            end = "end the process with a signal, such as by Ctrl-C"
            return Verdict(Code.STATE_TRANSITION_ERROR, end)
        if wanted not in (State.STOPPED, State.PLAYING, State.PAUSED):
            return Verdict(Code.INCORRECT_TRANSITION, f"no state {wanted}: there are no worlds")
        if wanted == self.state():
            return Verdict(Code.ALREADY_IN_TARGET_STATE, State(wanted).name.lower())
        self._control.pause(wanted != State.PLAYING)
        if wanted == State.STOPPED:
            is_reset, message = self._control.reset()
            if not is_reset:
                return Verdict(Code.STATE_TRANSITION_ERROR, message)
        self._was_stopped = wanted == State.STOPPED
        return FINE

    def reset(self, scope: int) -> Verdict:
        """Reset time and state, which begin together; nothing is ever spawned."""
        wanted = Scope(scope) or Scope.ALL
        whole = Scope.TIME | Scope.STATE
        if wanted & whole == whole:
            is_reset, message = self._control.reset()
            return FINE if is_reset else Verdict(Code.OPERATION_FAILED, message)
        if wanted == Scope.SPAWNED:
            return Verdict(Code.OK, "nothing has been spawned")
        only = "time and state begin together: reset both, or everything"
        return Verdict(Code.FEATURE_UNSUPPORTED, only)

    def step(self) -> Verdict:
        """One step; the simulation must be paused."""
        is_done, message = self._control.step()
        return FINE if is_done else Verdict(Code.OPERATION_FAILED, message)

    def entities(self, pattern: str, has_other_filters: bool) -> tuple[Verdict, list[str]]:
        """The entities whose names contain a match of a regular expression."""
        if has_other_filters:
            only = "entities can be filtered by name alone"
            return Verdict(Code.FEATURE_UNSUPPORTED, only), []
        try:
            is_found = re.search(pattern, VEHICLE)
        except (re.error, RecursionError, OverflowError) as error:
            return Verdict(Code.OPERATION_FAILED, f"filter: no regular expression: {error}"), []
        return FINE, [VEHICLE] if is_found else []

    def entity_state(self, entity: str) -> tuple[Verdict, EntityState | None]:
        """The state of an entity."""
        if entity != VEHICLE:
            return _not_found(entity), None
        with self._lock:
            return FINE, entity_state(self._session.simulation)

    def set_entity_state(
        self, entity: str, pose: tuple | None, twist: tuple | None, acceleration: bool
    ) -> Verdict:
        """Set what is given: pose (position, orientation) and twist (velocity, turning)."""
        if entity != VEHICLE:
            return _not_found(entity)
        if acceleration:
            return Verdict(Code.FEATURE_UNSUPPORTED, "acceleration: it follows from the forces")
        with self._lock:
            kept = self._session.snapshot()
            if self._session.stopped and not twist:
                return Verdict(Code.INCORRECT_STATE, "the model has stopped: reset first")
            try:
                if pose:
                    put(self._session, *pose)
            except InputError as error:
                return Verdict(INVALID_POSE, str(error))
            try:
                if twist:
                    set_going(self._session, *twist)
            except InputError as error:
                self._session.restore(kept)
                return Verdict(Code.OPERATION_FAILED, str(error))
        return FINE

    def spawn(self) -> Verdict:
        """Refused: there is one vehicle, and its parameters are those of the node."""
        only = "spawning: start another simulator in a namespace of its own"
        return Verdict(Code.FEATURE_UNSUPPORTED, only)


def _not_found(entity: str) -> Verdict:
    return Verdict(Code.NOT_FOUND, f"no entity {entity[:60]!a}: there is {VEHICLE}")
