"""Collection calls no kernel, and processes take turns while the model is being compiled."""

import fcntl

import pytest
from collecting import one_at_a_time, without_kernels

from vehicle_roll_sim.model.compiled import jit

pytestmark = pytest.mark.skipif(jit.CACHE is None, reason="only compiled code is cached")


def test_a_kernel_that_is_called_as_tests_are_collected_is_an_error_that_names_it():
    @jit.kernel
    def doubled(x):
        return 2.0 * x

    with without_kernels(), pytest.raises(RuntimeError, match=r"^doubled is called as tests are"):
        doubled(1.0)
    assert doubled.py_func(1.0) == 2.0


def is_free(path) -> bool:
    """Whether another one may lock the file now."""
    with path.open() as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
    return True


@pytest.mark.parametrize("is_to_be_compiled", [True, False])
def test_processes_take_turns_only_while_the_model_is_compiled(
    is_to_be_compiled, tmp_path, monkeypatch
):
    monkeypatch.setattr(jit, "is_to_be_compiled", lambda: is_to_be_compiled)
    (path := tmp_path / "lock").touch()
    with one_at_a_time(path):
        assert is_free(path) != is_to_be_compiled
    assert is_free(path)
