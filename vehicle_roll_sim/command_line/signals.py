"""How SIGINT and SIGTERM end a command: exit status 130 or 143, and no partial files.

A signal that the parent process told the command to ignore stays ignored; a shell does this with
SIGINT for background jobs of a script.
"""

import contextlib
import importlib
import signal
import sys
from collections.abc import Callable, Iterator

from vehicle_roll_sim.early_signals import PROGRAM, SHELLS_SIGNAL, SIGNALS, end_command


@contextlib.contextmanager
def exit_on_signal_throughout() -> Iterator[None]:
    """Enclose all that the process does: signals end it at once, and are ignored afterwards.

    So Python's own SIGINT handler, with its traceback, is never reached, not even at exit.
    """
    _handle(end_command)
    try:
        yield
    finally:
        _handle(signal.SIG_IGN)


@contextlib.contextmanager
def exit_on_signal() -> Iterator[None]:
    """Within the block, a signal ends the process immediately: only while there is nothing to lose.

    An exception raised inside a callback of the compiler gets lost and leaves it broken. The same
    is true of some large libraries while they are being imported.
    """
    with _handled_by(end_command):
        yield


def import_interruptibly(*modules: str) -> None:
    """Import modules of the package, which take long or are optional: a signal ends the process."""
    with exit_on_signal():
        for name in modules:
            importlib.import_module(f"{PROGRAM}.{name}")


@contextlib.contextmanager
def raise_on_signal() -> Iterator[None]:
    """Within the block, SIGINT raises KeyboardInterrupt and SIGTERM raises SystemExit.

    Context managers can then remove partial files.
    """
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
    """Set the handler of every signal that is not ignored; return the previous ones by signal."""
    handled = [each for each in SIGNALS if signal.getsignal(each) is not signal.SIG_IGN]
    return {signum: signal.signal(signum, handler) for signum in handled}


def _raise(signum, frame) -> None:
    if signum == signal.SIGINT:
        raise KeyboardInterrupt
    sys.exit(SHELLS_SIGNAL + signum)
