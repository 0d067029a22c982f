"""How SIGINT and SIGTERM end a node: status 0 and no traceback, from its first moment to its last.

rclpy's own handlers come late, with `rclpy.init`; SIGINT then raises KeyboardInterrupt wherever the
main thread is, also half-way through writing a message or destroying a node, and a handler that
runs while an executor is made reads a list that is just being replaced, which has crashed. Here a
signal shuts the context down, and a node ends when it notices.
"""

import contextlib
import os
import signal
import threading
from collections.abc import Callable, Iterable, Iterator

from vehicle_roll_sim.early_signals import SIGNALS


def heeded(signals: Iterable[int] = SIGNALS) -> list[int]:
    """Those of `signals` that this process was not started to ignore."""
    return [each for each in signals if signal.getsignal(each) is not signal.SIG_IGN]


def shutting_down(shut_down: Callable[[], None]) -> None:
    """From now on a signal has a thread call `shut_down`, whatever the main thread waits for.

    The last one that was told is called.
    """
    noted, waker = os.pipe()
    os.set_blocking(waker, False)

    def watch() -> None:
        os.read(noted, 1)
        shut_down()

    threading.Thread(target=watch, name="signals", daemon=True).start()
    signal.set_wakeup_fd(waker, warn_on_full_buffer=False)
    _handle(_nothing)


def over() -> None:
    """From now on signals change nothing: Python itself ends, without its handlers."""
    _handle(signal.SIG_IGN)


@contextlib.contextmanager
def interruptible() -> Iterator[None]:
    """Within, a signal also raises KeyboardInterrupt: for long computations, which see nothing."""
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
    """The wake-up that Python gives its file is enough."""
