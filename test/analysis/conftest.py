"""The runs that the source's figures and claims are made of."""

import pytest
from studies import reference_study

from vehicle_roll_sim.analysis.paper.study import Study


@pytest.fixture(scope="session")
def study() -> Study:
    """That of the reference vehicle; each of its runs is made once."""
    return reference_study()
