"""The published numbers with what is computed for them, once."""

import pytest

from vehicle_roll_sim.paper.published.comparison import Compared, compare


@pytest.fixture(scope="session")
def compared() -> list[Compared]:
    return compare()
