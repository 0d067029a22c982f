"""The runs that the source's figures and claims are made of."""

import sys

import pytest
from studies import Rerun, reference_study

from vehicle_roll_sim.paper.claim import Finding
from vehicle_roll_sim.paper.report import check_claims
from vehicle_roll_sim.paper.study import Study


@pytest.fixture(scope="session")
def study() -> Study:
    """That of the reference vehicle; each of its runs is made once."""
    return reference_study()


@pytest.fixture(scope="session")
def findings(study) -> list[Finding]:
    return check_claims(study)


@pytest.fixture
def without_engine(study, monkeypatch) -> Rerun:
    """The study where the multibody engine is not installed."""
    monkeypatch.setitem(sys.modules, "mujoco", None)
    return Rerun(study)
