"""The runs behind the figures and claims of the paper, shared by the tests of all folders."""

import fcntl
import pickle
from collections.abc import Callable
from pathlib import Path

from vehicle_roll_sim import preset
from vehicle_roll_sim.paper.study import Response, Study


class Kept(Study):
    """A study whose runs are made already."""

    def __init__(self, responses: dict[tuple[str, str], Response]):
        super().__init__(preset())
        self._responses = responses


def shared_study(path: Path) -> Study:
    """That of the reference vehicle. Who asks first makes all its runs, 10 s, and keeps them."""
    with path.open("a+b") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        file.seek(0)
        if kept := file.read():
            return Kept(pickle.loads(kept))
        study = Study(preset())
        pickle.dump({each: study.response(*each) for each in study.runs}, file)
    return study


class Rerun(Study):
    """A study with the runs of another, in which a case may be taken for another.

    instead: the case whose runs are given in place of a case's own. `asked` is what it was asked.
    """

    def __init__(
        self,
        study: Study,
        instead: dict[str, str] | None = None,
        done: Callable[[], None] = lambda: None,
    ):
        super().__init__(study.vehicle, done)
        self._study, self._instead = study, instead or {}
        self.asked: set[tuple[str, str]] = set()

    def response(self, manoeuvre: str, case: str) -> Response:
        if (manoeuvre, case) not in self.asked:
            self.asked.add((manoeuvre, case))
            self._done()
        return self._study.response(manoeuvre, self._instead.get(case, case))
