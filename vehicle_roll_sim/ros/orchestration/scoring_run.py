"""Drives the runs of a score that are not there yet, controller by controller."""

import tempfile
import threading
from collections.abc import Callable, Sequence
from pathlib import Path

from vehicle_roll_sim.ros.orchestration.bench import Bench
from vehicle_roll_sim.ros.orchestration.controller_processes import (
    Controller,
    ControllerFailedError,
    Processes,
)
from vehicle_roll_sim.scoring.driven import Driven, Outcome, drive_again, drive_alone
from vehicle_roll_sim.scoring.plan import Ladder, Setup
from vehicle_roll_sim.scoring.report import slug
from vehicle_roll_sim.scoring.results import Climb, Result, Score, result_alone, result_controlled
from vehicle_roll_sim.scoring.store import Store

AGAIN = "again"
"""The name of the run that is the first one driven again."""
NO_RESET = (
    "driven again, its first run differs: it keeps its state; reset it when the time of the set is "
    "0 again, or score with --restart"
)


class Scoring:
    """The score of one controller. Its processes run only while there are runs to drive.

    restarts: whether they are started again for each run. interrupted: set by a signal, which ends
    everything with KeyboardInterrupt. progress: called after each run, with its name.
    """

    def __init__(
        self,
        bench: Bench,
        controller: Controller,
        store: Store,
        setup: Setup,
        *,
        restarts: bool,
        interrupted: threading.Event,
        progress: Callable[[str], None],
    ):
        self._bench, self._controller, self._store = bench, controller, store
        self._setup, self._restarts = setup, restarts
        self._interrupted, self._progress = interrupted, progress
        self._folder_name = slug(controller.name)
        self._runs: list[tuple[Ladder, float]] = []

    def score(self, ladders: Sequence[Ladder]) -> Score:
        """Drive the controller through all ladders; a controller that fails has a score saying so.

        No process outlives the call.
        """
        name = self._controller.name
        with tempfile.TemporaryDirectory() as folder:
            self._processes = Processes(self._controller, Path(folder))
            self._bench.check = self._check
            try:
                climbs = tuple(self._climb(ladder) for ladder in ladders)
                self._check_reset()
            except ControllerFailedError as error:
                return Score(name, (), str(error))
            finally:
                self._processes.stop()
                self._bench.disconnect()
        return Score(name, climbs)

    def _check(self) -> None:
        if self._interrupted.is_set():
            raise KeyboardInterrupt
        self._processes.check()

    def _climb(self, ladder: Ladder) -> Climb:
        alone = {level: drive_alone(ladder, level, self._setup) for level in ladder.levels}
        controlled = {}
        for level in ladder.levels:
            self._check()
            controlled[level] = self._result(ladder, level, alone[level])
            self._progress(f"{self._controller.name}: {ladder.name(level)}")
            if controlled[level].has_failed:
                break
        results = {level: result_alone(level, each) for level, each in alone.items()}
        return Climb(ladder, results, controlled)

    def _result(self, ladder: Ladder, level: float, alone: Outcome) -> Result:
        """A run with the controller, compared with the one without it."""
        name = ladder.name(level)
        driven = self._store.load(self._folder_name, name)
        self._runs.append((ladder, level))
        if driven is None:
            self._store.forget(self._folder_name, AGAIN)
            driven = self._drive(ladder, level)
            self._store.save(self._folder_name, name, driven)
        found = drive_again(ladder, level, self._setup, driven)
        return result_controlled(level, alone, found, driven)

    def _drive(self, ladder: Ladder, level: float) -> Driven:
        """A run with the controller, which is started if it is not running."""
        is_first = self._restarts or not self._processes.are_running
        if is_first and self._processes.are_running:
            self._processes.stop()
            self._bench.disconnect()
        manoeuvre = ladder.manoeuvre(self._setup, level)
        if is_first:
            self._processes.start()
            self._bench.connect()
        vehicle, road = self._setup.variant(ladder.variant), ladder.road(self._setup)
        return self._bench.drive(manoeuvre, vehicle, is_first, road)

    def _check_reset(self) -> None:
        """Drive the first run again, after others; raises ControllerFailedError if it differs.

        In a process that was started only for this, the last run comes before it. Nothing to do for
        runs that have been checked before.
        """
        checked = self._store.load(self._folder_name, AGAIN)
        if self._restarts or len(self._runs) < 2 or checked:
            return
        again = [self._runs[0]] if self._processes.are_running else [self._runs[-1], self._runs[0]]
        for ladder, level in again:
            driven = self._drive(ladder, level)
            if driven != self._store.load(self._folder_name, ladder.name(level)):
                for each, its_level in self._runs:
                    self._store.forget(self._folder_name, each.name(its_level))
                raise ControllerFailedError(NO_RESET)
        self._store.save(self._folder_name, AGAIN, driven)
