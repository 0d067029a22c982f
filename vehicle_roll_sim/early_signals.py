"""SIGINT and SIGTERM while a program is starting: it ends at once, without a traceback.

Entry points call this before they import anything else. Only modules that Python has loaded by then
are imported: `signal` itself would bring `enum`, which takes longer than everything here.
"""

import _signal
import os

PROGRAM = "vehicle_roll_sim"
SIGNALS = (_signal.SIGINT, _signal.SIGTERM)
SHELLS_SIGNAL = 128
"""Added to a signal's number it is an exit status, as shells have it."""


def end_command_at_once() -> None:
    """From now on a signal ends the command: `end_command`."""
    _install(end_command)


def end_command(signum, frame) -> None:
    """The handler of the command: status 130 or 143, with a line about SIGINT."""
    if signum == _signal.SIGINT:
        _say(f"{PROGRAM}: interrupted\n")
    os._exit(SHELLS_SIGNAL + signum)


def end_node_at_once(status: int = 0, even_ignored: bool = True) -> None:
    """From now on a signal ends the process with this status, for as long as nothing can be lost.

    A node is ended by SIGINT even where it was started to ignore it, as in the background of a
    script: that is how launch ends nodes. A command (status not 0, not `even_ignored`) is not.
    """

    def end(signum, frame) -> None:
        if status and signum == _signal.SIGINT:
            _say("interrupted\n")
        os._exit(status)

    _install(end, even_ignored)


def _install(handler, even_ignored: bool = False) -> None:
    for signum in SIGNALS:
        if even_ignored or _signal.getsignal(signum) != _signal.SIG_IGN:
            _signal.signal(signum, handler)


def _say(line: str) -> None:
    try:  # noqa: SIM105  contextlib is not imported yet; sys.stderr may be writing just now
        os.write(2, line.encode())
    except OSError:
        pass
