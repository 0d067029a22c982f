"""What the last bits of results depend on apart from the study: program, libraries, arithmetic."""

import dataclasses
import functools
import hashlib
import importlib.metadata
import sys
from pathlib import Path

from vehicle_roll_sim.batch.case import Case
from vehicle_roll_sim.batch.evaluate import outcome_of
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.model.compiled.jit import COMPILED
from vehicle_roll_sim.model.variants import MODELS
from vehicle_roll_sim.simulation.compilation import compile_model
from vehicle_roll_sim.vehicle.vehicle_file import preset
from vehicle_roll_sim.version import __version__

PROGRAM = "vehicle_roll_sim"
LIBRARIES = ("numpy", "scipy", "numba")
TEST_RUN = dataclasses.replace(STANDARD["j_turn"], duration=3.0)
"""Runs with wheel lift-off, in which differences in the last bit grow."""


@functools.cache
def fingerprint() -> dict[str, str]:
    """What two processes must have in common to give the same bytes, by name.

    Compiles the model if necessary, so that the processes of a machine compile it once.
    """
    compile_model()
    versions = {name: importlib.metadata.version(name) for name in LIBRARIES[:2]}
    return {
        PROGRAM: f"{__version__}, sources {_sources()}",
        "Python": "{}.{}".format(*sys.version_info),
        **versions,
        "numba": importlib.metadata.version("numba") if COMPILED else "not used",
        "results of test runs": _test_runs(),
    }


def _sources() -> str:
    """Hash of all Python files of the package: a version number alone says too little."""
    digest, folder = hashlib.sha256(), Path(__file__).parents[1]
    for path in sorted(folder.rglob("*.py")):
        digest.update(f"{path.relative_to(folder)} ".encode() + path.read_bytes())
    return digest.hexdigest()[:12]


def _test_runs() -> str:
    """Hash of the final states of a run with each model.

    It tells processors and C libraries apart that round differently.
    """
    digest, vehicle = hashlib.sha256(), preset()
    for model in MODELS:
        case = Case(vehicle=vehicle, manoeuvre=TEST_RUN, model=model)
        digest.update(outcome_of(case).final_state.tobytes())
    return digest.hexdigest()[:12]
