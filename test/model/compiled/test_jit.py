"""How kernels are compiled."""

import pytest

from vehicle_roll_sim import Simulation, preset
from vehicle_roll_sim.model.compiled import jit


@pytest.mark.skipif(not jit.CACHE, reason="without numba or a folder, no compiled code is stored")
def test_no_kernel_counts_references_to_arrays():
    """The stored code names every function that it calls."""
    Simulation(preset())
    stored = {file.name: file.read_bytes() for file in jit.CACHE.rglob("*.nbc")}
    assert any("advance" in name and b"solve_in_place" in code for name, code in stored.items())
    assert [name for name, code in stored.items() if b"NRT_incref" in code] == []
