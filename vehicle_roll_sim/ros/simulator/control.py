"""What a simulator does on request: reset, pause, step, save and restore."""

import time
from collections.abc import Callable
from typing import NamedTuple

from std_srvs.srv import SetBool, Trigger

from vehicle_roll_sim.input_errors import InputError
from vehicle_roll_sim.live.session_snapshot import SessionSnapshot
from vehicle_roll_sim.ros.services import PAUSE, RESET, RESTORE, SAVE, STEP
from vehicle_roll_sim.ros.simulator.snapshot_store import SnapshotStore

NOT_STARTED = "not started yet: waiting for the lockstep partners"


class Answer(NamedTuple):
    """Whether a request was fulfilled, and a message in one line."""

    success: bool
    message: str


class Control:
    """Fulfils the requests to a simulator; each holds its lock while the session changes.

    simulator: the node. follow: called without the lock after parameters have changed with a
    snapshot.
    """

    def __init__(self, simulator, follow: Callable[[], None]):
        self._simulator, self._follow = simulator, follow
        self._store = SnapshotStore(simulator.settings.snapshot_folder)
        self._restored: SessionSnapshot | None = None
        simulator.session.parts["settings"] = simulator.settings  # `begin` may come with another

    def serve(self) -> None:
        """Offer the requests as services of the node."""
        simple = {RESET: self.reset, STEP: self.step, SAVE: self.save, RESTORE: self.restore}
        for service, fulfil in simple.items():
            self._offer(service, lambda _, fulfil=fulfil: fulfil())
        self._offer(PAUSE, lambda request: self.pause(request.data))

    def _offer(self, service, fulfil: Callable[[object], Answer]) -> None:
        def answer(
            request: Trigger.Request | SetBool.Request,
            response: Trigger.Response | SetBool.Response,
        ) -> Trigger.Response | SetBool.Response:
            response.success, response.message = fulfil(request)
            return response

        self._simulator.create_service(service.kind, f"~/{service.name}", answer)

    def begin(self) -> None:
        """Begin with what was restored before, or without commands. Call with the lock held."""
        session = self._simulator.session
        session.parts["settings"] = self._simulator.settings
        if self._restored:
            session.restore(self._restored)
            session.inbox.await_answers()
        else:
            session.inbox.clear()

    def reset(self) -> Answer:
        """Return to static equilibrium at time 0."""
        simulator = self._simulator
        speed = simulator.settings.initial_speed
        with simulator.lock:
            try:
                simulator.session.reset(speed)
            except InputError as error:  # the step is too large for that speed
                return Answer(False, str(error))
            self._restored = None
            simulator.show()
        return Answer(True, f"static equilibrium at {speed:g} m/s")

    def pause(self, wanted: bool) -> Answer:
        """Pause, or go on."""
        simulator = self._simulator
        with simulator.lock:
            simulator.session.paused = wanted
            simulator.restart()
        return Answer(True, "paused" if wanted else "running")

    def step(self) -> Answer:
        """Run one period while paused."""
        simulator = self._simulator
        with simulator.lock:
            session = simulator.session
            if not simulator.has_begun:
                return Answer(False, NOT_STARTED)
            if session.stopped:
                return Answer(False, "the model has stopped: reset first")
            if not session.paused:
                return Answer(False, "running: pause first")
            simulator.run_period(time.monotonic_ns())
            return Answer(True, f"{session.simulation.time:.9g} s")

    def save(self) -> Answer:
        """Keep a snapshot; the message is its token."""
        with self._simulator.lock:
            snapshot = self._simulator.session.snapshot()
        try:
            return Answer(True, self._store.save(snapshot))
        except InputError as error:
            return Answer(False, str(error))

    def restore(self) -> Answer:
        """Go on from the snapshot that the parameter `snapshot` names."""
        simulator = self._simulator
        try:
            snapshot = self._store.find(simulator.settings.snapshot)
            with simulator.lock:
                simulator.session.restore(snapshot)
                simulator.session.inbox.await_answers()
                self._restored = None if simulator.has_begun else snapshot
                simulator.show()
        except InputError as error:
            return Answer(False, str(error))
        self._follow()
        return Answer(True, f"{snapshot.token} at {snapshot.simulation.time:.9g} s")
