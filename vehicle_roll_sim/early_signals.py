"""SIGINT and SIGTERM while a program is starting: it ends at once, without a traceback.

Entry points use this module before they import anything else. It imports only modules that Python
has already loaded: even `signal` would import `enum`, which takes longer than everything here.
"""

import _signal
import os

PROGRAM = "vehicle_roll_sim"
SIGNALS = (_signal.SIGINT, _signal.SIGTERM)
SHELLS_SIGNAL = 128
"""Added to a signal's number, this gives the exit status that shells use."""


def end_command_at_once() -> None:
    """From now on, a signal ends the command (see `end_command`)."""
    _install(end_command)


def end_command(signum, frame) -> None:
    """Signal handler of the command: exit with status 130 or 143; print a line for SIGINT."""
    if signum == _signal.SIGINT:
        _say(f"{PROGRAM}: interrupted\n")
    os._exit(SHELLS_SIGNAL + signum)


def end_node_at_once(status: int = 0, even_ignored: bool = True) -> None:
    """From now on, a signal ends the process with this status: only while nothing can be lost.

    With `even_ignored`, SIGINT ends a node even if it was started with SIGINT ignored, as a
    background job of a script is: launch ends nodes by SIGINT. A command continues to ignore it.
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
    try:  # noqa: SIM105  contextlib is not imported yet; sys.stderr may be mid-write
        os.write(2, line.encode())
    except OSError:
        pass
