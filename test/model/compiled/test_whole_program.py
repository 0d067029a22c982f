"""Machine code is made of kernels that Python calls, with all that they call, and of no others."""

import pytest

from vehicle_roll_sim.model.compiled import jit

pytestmark = pytest.mark.skipif(not jit.COMPILED, reason="without numba nothing is compiled")


@pytest.fixture
def folder(monkeypatch, tmp_path):
    """A cache of its own."""
    monkeypatch.setattr(jit, "CACHE", tmp_path)
    return tmp_path


@pytest.fixture
def kernels(folder):
    """halved, less (halves, and takes 1 away), and both (the sum of what they give)."""

    @jit.kernel
    def halved(x):
        return x / 2.0

    @jit.kernel
    def less(x):
        return halved(x) - 1.0

    @jit.kernel
    def both(x):
        return halved(x) + less(x)

    return halved, less, both


def stored(folder) -> set[str]:
    """Names of the kernels of which there is machine code on disk."""
    return {file.name.partition("-")[0].rpartition(".")[2] for file in folder.rglob("*.nbc")}


def test_only_what_python_calls_is_made_into_machine_code(kernels, folder):
    assert kernels[-1](6.0) == 5.0
    assert stored(folder) == {"both"}


def test_what_was_a_part_can_be_called_from_python_afterwards(kernels, folder):
    halved, less, both = kernels
    assert (both(6.0), less(6.0), halved(6.0)) == (5.0, 2.0, 3.0)
    assert stored(folder) == {"both", "less", "halved"}
    assert (both(8.0), less(8.0), halved(8.0)) == (7.0, 3.0, 4.0)


def test_what_is_compiled_already_can_become_a_part(kernels):
    halved, less, both = kernels
    assert (halved(6.0), less(6.0), both(6.0)) == (3.0, 2.0, 5.0)


def test_a_function_that_is_no_kernel_can_call_a_part(kernels):
    _, less, both = kernels
    both(6.0)
    assert jit.numba.njit(lambda x: less(x))(6.0) == 2.0


def test_a_part_that_one_caller_never_reaches_is_there_for_the_next(kernels):
    """The compiler sees that `first` calls nothing before it has linked `last`."""
    halved, less, _ = kernels

    @jit.kernel
    def first(x):
        count = 3
        return halved(x) if count > 4 else x

    @jit.kernel
    def last(x):
        return less(x)

    @jit.kernel
    def top(x):
        return first(x) + last(x)

    assert top(6.0) == 8.0


def test_a_kernel_that_cannot_be_compiled_leaves_the_others_as_they_are(kernels, folder):
    @jit.kernel
    def wrong(x):
        return x.nothing

    @jit.kernel
    def caller(x):
        return wrong(x)

    with pytest.raises(jit.numba.TypingError):
        caller(1.0)
    assert kernels[-1](6.0) == 5.0
    assert stored(folder) == {"both"}
