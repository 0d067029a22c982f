"""How SIGINT and SIGTERM end a node: exit status 0 and no traceback, at any time.

rclpy installs its own handlers late, in `rclpy.init`. SIGINT then raises KeyboardInterrupt wherever
the main thread happens to be, even while it writes a message or destroys a node. And a handler that
runs while an executor is being constructed reads a list that is being replaced; this has crashed.
Here, a signal only shuts the context down, and the node ends when it notices.
"""

import contextlib
import os
import signal
import threading
from collections.abc import Callable, Iterable, Iterator

from vehicle_roll_sim.early_signals import SIGNALS


def not_ignored(signals: Iterable[int] = SIGNALS) -> list[int]:
    """Those of `signals` that this process was not started with as ignored."""
    return [each for each in signals if signal.getsignal(each) is not signal.SIG_IGN]


def shut_down_on_signal(shut_down: Callable[[], None]) -> None:
    """From now on, a signal makes a thread call `shut_down`, whatever the main thread is doing.

    Only the most recently registered callback is called.
    """
    noted, waker = os.pipe()
    os.set_blocking(waker, False)

    def watch() -> None:
        os.read(noted, 1)
        shut_down()

    threading.Thread(target=watch, name="signals", daemon=True).start()
    signal.set_wakeup_fd(waker, warn_on_full_buffer=False)
    _handle(_nothing)


def ignore_signals() -> None:
    """From now on, signals are ignored, so that interpreter exit is not interrupted."""
    _handle(signal.SIG_IGN)


@contextlib.contextmanager
def interruptible() -> Iterator[None]:
    """Within the block, a signal raises KeyboardInterrupt, to interrupt long computations."""
    before = {signum: signal.signal(signum, signal.default_int_handler) for signum in SIGNALS}
    try:
        yield
    finally:
        for signum, handler in before.items():
            signal.signal(signum, handler)


def _handle(handler: Callable | signal.Handlers) -> None:
    for signum in SIGNALS:
        signal.signal(signum, handler)


def _nothing(*_) -> None:
    """Do nothing: Python has already written to the wake-up file descriptor."""
