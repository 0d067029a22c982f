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

SIGNALS = (signal.SIGINT, signal.SIGTERM)


def at_once(status: int = 0) -> None:
    """From now on, a signal ends the process immediately: only while there is nothing to lose.

    SIGINT ends a node (status 0) even if it was started with SIGINT ignored, as a background job
    of a script is: launch ends nodes by SIGINT. A command (other status) goes on ignoring it.
    """

    def end(signum, _) -> None:
        if status and signum == signal.SIGINT:
            with contextlib.suppress(OSError):  # not through sys.stderr, which may be mid-write
                os.write(2, b"interrupted\n")
        os._exit(status)

    _handle(end, heeded() if status else SIGNALS)


def heeded(signals: Iterable[int] = SIGNALS) -> list[int]:
    """Those of `signals` that this process was not started with as ignored."""
    return [each for each in signals if signal.getsignal(each) is not signal.SIG_IGN]


def shutting_down(shut_down: Callable[[], None]) -> None:
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


def over() -> None:
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


def _handle(handler: Callable | signal.Handlers, signals: Iterable[int] = SIGNALS) -> None:
    for signum in signals:
        signal.signal(signum, handler)


def _nothing(*_) -> None:
    """Do nothing: Python has already written to the wake-up file descriptor."""
