"""The deliberate faults fit the sources; `make mutations` checks that tests catch them."""

import sys

import pytest

from vehicle_roll_sim.declaration import InputError


@pytest.fixture(scope="module")
def benchmarks(root):
    """The modules of the benchmarks, which are not installed."""
    sys.path.insert(0, str(root))
    from benchmarks import faults, mutations

    yield faults, mutations
    sys.path.remove(str(root))


def test_every_original_is_in_its_file_once_and_its_fault_is_another_text(root, benchmarks):
    faults, mutations = benchmarks
    assert len(faults.FAULTS) >= 12
    for fault in faults.FAULTS:
        text = (root / "vehicle_roll_sim" / fault.file).read_text(encoding="utf-8")
        changed = mutations.faulty_text(fault, text)
        assert changed != text
        compile(changed, fault.file, "exec")


def test_every_test_that_shall_notice_exists(root, benchmarks):
    faults, _ = benchmarks
    for fault in faults.FAULTS:
        file, _, name = fault.test.partition("::")
        assert f"def {name}" in (root / file).read_text(encoding="utf-8"), fault.test


def test_an_original_that_is_gone_or_there_twice_is_refused(benchmarks):
    faults, mutations = benchmarks
    for text in ("nothing of it", faults.FAULTS[0].original * 2):
        with pytest.raises(InputError):
            mutations.faulty_text(faults.FAULTS[0], text)
