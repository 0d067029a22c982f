"""The runs on which the figures and claims of the paper are based."""

import sys

import pytest
from studies import Rerun

from vehicle_roll_sim.paper.claim import Finding
from vehicle_roll_sim.paper.report import check_claims


@pytest.fixture(scope="session")
def findings(study) -> list[Finding]:
    return check_claims(study)


@pytest.fixture
def without_engine(study, monkeypatch) -> Rerun:
    """The study without the multibody engine."""
    monkeypatch.setitem(sys.modules, "mujoco", None)
    return Rerun(study)
