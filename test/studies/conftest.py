"""Studies whose runs are a formula, so that thousands take no time."""

import pytest
from formula_runs import SMALL, formula

from vehicle_roll_sim.studies import chunks, folder
from vehicle_roll_sim.studies.source import Source
from vehicle_roll_sim.studies.study_file import study_of


@pytest.fixture
def by_formula(monkeypatch, request):
    """Runs are computed by `formula`; the list of the numbers of cases computed at a time."""
    sizes = []

    def evaluate(cases, workers):
        sizes.append(len(cases))
        return formula(cases)

    monkeypatch.setattr(chunks, "evaluate", evaluate)
    if "figures" not in request.fixturenames:
        monkeypatch.setattr(folder, "draw", lambda results, path: [])
    return sizes


@pytest.fixture
def figures():
    """Of a test that draws figures: half a second each time."""


@pytest.fixture
def study():
    """study(**changes): the small study with some keys replaced."""
    return lambda **changes: study_of(Source({**SMALL, **changes}))
