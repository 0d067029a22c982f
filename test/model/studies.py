"""The runs behind the figures and claims of the paper, shared by the tests of all folders."""

import functools
from collections.abc import Callable

from vehicle_roll_sim import preset
from vehicle_roll_sim.paper.study import Response, Study


@functools.cache
def reference_study() -> Study:
    """That of the reference vehicle; each run is made once, when first asked for: 10 s in all."""
    return Study(preset())


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
