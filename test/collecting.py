"""Tests are collected while the model is being compiled: without it, and one process at a time."""

import contextlib
import fcntl
from pathlib import Path

import pytest

from vehicle_roll_sim.model.compiled import jit


@contextlib.contextmanager
def without_kernels():
    """Context in which the first call of a kernel raises: its code may not be there yet."""

    def refused(kernel, _):
        raise RuntimeError(f"{kernel.__name__} is called as tests are collected: use a fixture")

    with pytest.MonkeyPatch.context() as patched:
        if jit.COMPILED:
            patched.setattr(jit.whole_program.KernelDispatcher, "compile", refused)
        yield


@contextlib.contextmanager
def one_at_a_time(path: Path):
    """Context that one process is in at a time, as long as the model is being compiled.

    All together would slow down the compiler, which the tests then wait for, and each would rewrite
    the assertions of all test files. So the first process does that and the others load the result.
    path: a file to lock.
    """
    with path.open() as lock:
        if jit.CACHE and jit.is_to_be_compiled():
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield
