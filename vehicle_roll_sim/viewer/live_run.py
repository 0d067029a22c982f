"""The page of a running simulator: a window of its samples, and what is new in it."""

import dataclasses
import json
import math
import secrets
import threading
from collections.abc import Iterator

import numpy as np

from vehicle_roll_sim.analysis.panels import COMMANDS, Signal, signals_of
from vehicle_roll_sim.runs.columns import FURTHER
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.runs.sampled_events import events_of
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.road_mesh import has_mesh, road_mesh
from vehicle_roll_sim.viewer.page import Feed, page
from vehicle_roll_sim.viewer.recording import ViewedRun, events_in, recording
from vehicle_roll_sim.viewer.road import path_of, values_of_mesh

WINDOW = 30.0
"""s: how much of the run a page shows."""
EVERY = 0.1
"""Wall time (s) after which there is an update, with or without new samples."""
MESH_EVERY, MESH_AHEAD = 25.0, 60.0
"""m: distance after which the road is sent again, and how far ahead it is sent in detail."""
MESH_CELLS = 1500
NOTE = f"The last {WINDOW:g} s of a running simulator; this address works on this machine only."


@dataclasses.dataclass(frozen=True)
class Window:
    """The newest samples.

    run: another after each reset. page: as in `Feed`. road: as `values_of_mesh`.
    """

    run: int
    page: str
    viewed: ViewedRun
    signals: tuple[Signal, ...]
    road: dict | None


class LiveRun:
    """The run of a simulator; samples come from one thread, updates go to several.

    label, scene, rollover_angle: of the vehicle, as for a ViewedRun and `events_of` (rad). road:
    under it.
    """

    def __init__(self, label: str, scene: dict, rollover_angle: float, road: Road | None = None):
        self._label, self._scene, self._angle = label, scene, rollover_angle
        self._road, self._meshed, self._mesh = road, None, None
        self._changed = threading.Condition()
        self._run, self._is_closed, self._rollover = 0, False, math.nan
        self._name = secrets.token_hex(8)
        self.window: Window | None = None

    def add(self, history: History) -> None:
        """Add samples, at least one; an earlier time than the last begins another run.

        A stopped simulator repeats its last time, which is nothing new.
        """
        before = self.window
        known = before and before.viewed.history
        if known is None or history["time"][0] < known["time"][-1]:
            self._run, self._rollover = self._run + 1, math.nan
        else:
            history = _joined(known, history)
        history = history.part(np.diff(history["time"], prepend=-math.inf) > 0)
        if known is not None and history["time"][-1] == known["time"][-1]:
            return
        history = history.part(history["time"] > history["time"][-1] - WINDOW)
        events = events_of(history, self._angle)
        if math.isnan(self._rollover):
            self._rollover = float(events["rollover_time"][0])
        events["rollover_time"][0] = self._rollover  # it may have left the window
        signals = tuple(signals_of([history], before.signals if before else ()))
        given = "".join(str(int(each in signals)) for each in COMMANDS)
        viewed = ViewedRun(history, events, self._label, self._scene, self._road)
        mesh = self._mesh_around(history)
        with self._changed:
            self.window = Window(self._run, f"{self._name}-{given}", viewed, signals, mesh)
            self._changed.notify_all()

    def _mesh_around(self, history: History) -> dict | None:
        """The road around the window and ahead of it, renewed as the vehicle moves on."""
        path, heading = path_of(history), float(history["yaw"][-1])
        here = path[-1]
        if not has_mesh(self._road) or not np.isfinite((*here, heading)).all():
            return self._mesh
        if self._meshed is None or math.dist(here, self._meshed) > MESH_EVERY:
            way = np.array((math.cos(heading), math.sin(heading)))
            ahead = here + np.arange(MESH_AHEAD)[:, np.newaxis] * way
            found = road_mesh(self._road, np.concatenate((path, ahead)), MESH_CELLS)
            self._meshed, self._mesh = here, values_of_mesh(found)
        return self._mesh

    def close(self) -> None:
        """End all updates."""
        with self._changed:
            self._is_closed = True
            self._changed.notify_all()

    def page(self, address: str) -> str:
        """The page that shows the window, and follows the updates at an address on its server."""
        window = self.window
        feed = Feed(address, window.page, window.signals)
        return page([window.viewed], self._label, notes=[NOTE], feed=feed, meshes=[window.road])

    def updates(self) -> Iterator[str]:
        """JSON for a page, until `close`: the whole window, then what is added to it.

        Each is a `recording`, with run, page and begin, the first time (s) in the window, and with
        the road if that is another. What is added begins with the last sample before it. Without
        anything new: "".
        """
        last = None
        while not self._is_closed:
            with self._changed:
                self._changed.wait_for(lambda: self._is_closed or self.window is not last, EVERY)  # noqa: B023
                window = self.window
            yield "" if window is last else _told(window, last)
            last = window


def _told(window: Window, last: Window | None) -> str:
    """The JSON for a page that knows `last`."""
    viewed, begin = window.viewed, -math.inf
    times = viewed.history["time"]
    if last and last.run == window.run:
        begin = last.viewed.history["time"][-1]
    added = dataclasses.replace(viewed, history=viewed.history.part(times >= begin))
    told = recording(added, window.signals, are_apart=True)
    told |= {"events": events_in(viewed), "begin": float(times[0])}
    told |= {"run": window.run, "page": window.page}
    if not last or last.road is not window.road:
        told["road"] = window.road
    return json.dumps(told, allow_nan=False, separators=(",", ":"))


def _joined(first: History, second: History) -> History:
    """One after the other; what only one of them knows is nan in the other."""

    def joined(name: str) -> np.ndarray | None:
        parts = [getattr(each, name) for each in (first, second)]
        widths = {part.shape[1] for part in parts if part is not None}
        if not widths:
            return None
        unknown = [np.full((len(each.rows), *widths), np.nan) for each in (first, second)]
        return np.vstack([u if p is None else p for u, p in zip(unknown, parts, strict=True)])

    return History(joined("rows"), **{name: joined(name) for name in FURTHER.values()})
