"""How SIGINT and SIGTERM end a command: statuses 130 and 143, and nothing half-written."""

import contextlib
import os
import signal
import sys
from collections.abc import Iterator

PROGRAM = "vehicle_roll_sim"
SIGNALS = (signal.SIGINT, signal.SIGTERM)
SHELLS_SIGNAL = 128
"""Added to a signal's number it is an exit status, as shells have it."""


def cleanly(signum, frame) -> None:
    """End as the signal would have, but clear away what is half-written."""
    sys.exit(SHELLS_SIGNAL + signum)


@contextlib.contextmanager
def at_once() -> Iterator[None]:
    """Within, a signal ends the process as it is: for as long as there is nothing to lose.

    The compiler reads and makes code with callbacks that lose an exception, and then breaks.
    """
    heeded = [each for each in SIGNALS if signal.getsignal(each) is not signal.SIG_IGN]
    before = {signum: signal.signal(signum, _end) for signum in heeded}
    try:
        yield
    finally:
        for signum, handler in before.items():
            signal.signal(signum, handler)


def _end(signum, frame) -> None:
    if signum == signal.SIGINT:
        print(f"{PROGRAM}: interrupted", file=sys.stderr, flush=True)
    os._exit(SHELLS_SIGNAL + signum)
