"""For all tests: the model is compiled before the first of them; the profiles of random cases."""

import pytest
from hypothesis import settings

from vehicle_roll_sim.simulation.simulation import compile_model

settings.register_profile(
    "suite", derandomize=True, database=None, deadline=None, max_examples=200, print_blob=False
)
settings.register_profile(
    "soak", derandomize=False, database=None, deadline=None, max_examples=4000, print_blob=True
)
settings.load_profile("suite")


@pytest.fixture(scope="session", autouse=True)
def compiled_model():
    """On a fresh machine this takes some 15 s, and says so; no test should meet that by chance."""
    compile_model()
