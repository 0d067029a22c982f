"""For all tests: the model is compiled before the first of them."""

import pytest

from vehicle_roll_sim.simulation.simulation import compile_model


@pytest.fixture(scope="session", autouse=True)
def compiled_model():
    """On a fresh machine this takes some 15 s, and says so; no test should meet that by chance."""
    compile_model()
