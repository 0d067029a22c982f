"""How SIGINT and SIGTERM end a command: statuses 130 and 143, and nothing half-written.

A signal that whoever started the command has it ignore, as a shell does for SIGINT in the
background of a script, stays ignored.
"""

import contextlib
import importlib
import signal
import sys
from collections.abc import Callable, Iterator

from vehicle_roll_sim.early_signals import PROGRAM, SHELLS_SIGNAL, SIGNALS, end_command


@contextlib.contextmanager
def whole_process() -> Iterator[None]:
    """Within is all that the process does: a signal ends it at once, and afterwards does nothing.

    Not even in the end may Python's own handler of SIGINT, with its traceback, be reached.
    """
    _handle(end_command)
    try:
        yield
    finally:
        _handle(signal.SIG_IGN)


@contextlib.contextmanager
def at_once() -> Iterator[None]:
    """Within, a signal ends the process as it is: for as long as there is nothing to lose.

    The compiler reads and makes code with callbacks that lose an exception, and then breaks; so
    do some of the large libraries while they are imported.
    """
    with _handled_by(end_command):
        yield


def import_at_once(*modules: str) -> None:
    """Import modules of this package, whose libraries take long or are optional, `at_once`."""
    with at_once():
        for name in modules:
            importlib.import_module(f"{PROGRAM}.{name}")


@contextlib.contextmanager
def by_exceptions() -> Iterator[None]:
    """Within, SIGINT raises KeyboardInterrupt and SIGTERM SystemExit: half-written files go."""
    with _handled_by(_raise):
        yield


@contextlib.contextmanager
def _handled_by(handler: Callable) -> Iterator[None]:
    before = _handle(handler)
    try:
        yield
    finally:
        for signum, earlier in before.items():
            signal.signal(signum, earlier)


def _handle(handler: Callable | signal.Handlers) -> dict:
    """Set the handler of all signals but those that are ignored; the handlers before, by signal."""
    heeded = [each for each in SIGNALS if signal.getsignal(each) is not signal.SIG_IGN]
    return {signum: signal.signal(signum, handler) for signum in heeded}


def _raise(signum, frame) -> None:
    if signum == signal.SIGINT:
        raise KeyboardInterrupt
    sys.exit(SHELLS_SIGNAL + signum)
