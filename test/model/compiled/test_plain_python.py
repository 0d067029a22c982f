"""Compiled code and plain Python share one source and give identical numbers."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from patience import PATIENCE
from plain_run import A_FEW, OPTIONS, diverging, run, run_variants
from programmes import largest_difference

import vehicle_roll_sim
from vehicle_roll_sim import LF, LR
from vehicle_roll_sim.model.compiled import jit
from vehicle_roll_sim.model.records import OUTPUTS, STATE

HERE = Path(__file__).parents[1]
ROOT = Path(vehicle_roll_sim.__file__).parent.parent
TO_ROLLOVER = 1000
"""Steps of 4 ms: more than it takes, the run stops by itself."""
A_SWERVE = 20
"""Steps of 4 ms: into it, for each variant. Every kernel has its turn, which coverage needs."""
SHARE_OF_PEAK = 1e-9
"""The compiler may order a sum differently: 1e-15, grown by the fall to the side. Seen: 0."""
compiled_only = pytest.mark.skipif(
    not jit.COMPILED, reason="numba is absent or off: there is nothing compiled to compare with"
)


def in_another_process(folder: Path, steps: int, *arguments: str, **environment: str):
    """What plain_run.py saves, run in a process with further environment variables."""
    result = folder / "run.npz"
    paths = os.pathsep.join(map(str, (ROOT, HERE)))
    environment = os.environ | {"PYTHONPATH": paths} | environment
    command = [sys.executable, str(HERE / "plain_run.py"), str(steps), str(result), *arguments]
    subprocess.run(command, env=environment, check=True, timeout=PATIENCE)
    return np.load(result)


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """The J-turn to rollover, and its beginning with other options, without compilation."""
    folder = tmp_path_factory.mktemp("plain")
    return in_another_process(folder, TO_ROLLOVER, NUMBA_DISABLE_JIT="1")


@pytest.fixture(scope="module")
def plain_variants(tmp_path_factory):
    """The swerve of every variant, in a process that is measured."""
    folder = tmp_path_factory.mktemp("variants")
    return in_another_process(folder, A_SWERVE, "variants", NUMBA_DISABLE_JIT="1")


@pytest.fixture(scope="module")
def compiled():
    return run(TO_ROLLOVER)


@pytest.fixture(scope="module")
def without_numba(tmp_path_factory):
    folder = tmp_path_factory.mktemp("without")
    return in_another_process(folder, A_FEW, "without-numba")


@pytest.mark.unmeasured
@compiled_only
def test_plain_python_follows_compiled_code_through_lift_off_to_rollover(plain, compiled):
    assert len(plain["state"]) == len(compiled.state)
    assert compiled.state["roll"][-1] >= np.radians(85.0)
    assert (compiled.outputs["normal_force"][:, [LF, LR]].min(axis=0) == 0.0).all()
    shares = largest_difference(plain["state"], compiled.state, STATE.names)
    assert all(share < SHARE_OF_PEAK for share in shares.values()), shares


@pytest.mark.unmeasured
@compiled_only
def test_all_outputs_are_those_of_compiled_code_too(plain, compiled):
    shares = largest_difference(plain["outputs"], compiled.outputs, OUTPUTS.names)
    assert all(share < SHARE_OF_PEAK for share in shares.values()), shares


@pytest.mark.unmeasured
@compiled_only
@pytest.mark.parametrize("name", OPTIONS)
def test_the_8_dof_model_and_steady_state_slip_are_one_source_too(plain, name):
    compiled = run(A_FEW, OPTIONS[name])
    for part, dtype in (("state", STATE), ("outputs", OUTPUTS)):
        shares = largest_difference(plain[f"{name}_{part}"], getattr(compiled, part), dtype.names)
        assert all(share < SHARE_OF_PEAK for share in shares.values()), shares


@pytest.mark.slow
@compiled_only
def test_every_variant_is_one_source_too(plain_variants):
    compiled = run_variants(A_SWERVE)
    assert plain_variants["readings"].tobytes() == compiled["readings"].tobytes()
    for part, dtype in (("state", STATE), ("outputs", OUTPUTS)):
        shares = largest_difference(plain_variants[part], compiled[part], dtype.names)
        assert all(share < SHARE_OF_PEAK for share in shares.values()), shares


@pytest.mark.unmeasured
@compiled_only
def test_the_model_runs_the_same_where_numba_is_not_installed(without_numba, compiled):
    shares = largest_difference(without_numba["state"], compiled.state[: A_FEW + 1], STATE.names)
    assert all(share < SHARE_OF_PEAK for share in shares.values()), shares


@pytest.mark.unmeasured
def test_without_numba_and_with_it_switched_off_the_same_bytes_come_out(without_numba, plain):
    """Both are plain Python, so not even rounding differs."""
    assert without_numba["state"].tobytes() == plain["state"][: A_FEW + 1].tobytes()


@pytest.mark.unmeasured
def test_the_reason_for_running_slowly_is_told(without_numba, plain):
    assert "numba is not installed" in str(without_numba["how"])
    assert "NUMBA_DISABLE_JIT" in str(plain["how"])


def test_plain_python_finds_a_run_that_diverges_instead_of_raising(plain_variants):
    """Where the math module raises, compiled code goes on with nan; so must plain Python."""
    assert str(plain_variants["diverging"]) == diverging() == "DIVERGED"
