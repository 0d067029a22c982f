"""ROS domains that nobody else on this machine uses: for tests and benchmarks.

People are on 0, or on another one up to 101. Above 214 there are some more whose ports Linux does
not hand out to others. One of these is taken here while it is free, and kept from other takers.
"""

import contextlib
import errno
import itertools
import os
import socket
import time
from collections.abc import Iterator

DOMAINS = range(215, 232)
FIRST_PORT, PORTS_OF_A_DOMAIN = 7400, 250
"""Of the middleware (RTPS 9.6.1.1): the first one is where those beyond this machine are heard."""
OF_PARTICIPANTS = range(10, 60, 2)
"""Ports, from the first one of a domain, at which its participants are met, in their order."""
KEPT = 248
"""The port that is held by whoever has taken a domain; that of a 120th participant."""
PATIENCE = 120.0
"""s to wait while all are in use."""
LOOK_AGAIN = 0.1
"""s"""
_numbers = itertools.count(os.getpid())
"""Where the next search begins, so that a domain rests before it is used again."""


@contextlib.contextmanager
def own_domain() -> Iterator[int]:
    """The number of a domain that is this process's own within.

    Raises TimeoutError if there is none for too long.
    """
    until, first = time.monotonic() + PATIENCE, next(_numbers)
    for turn in itertools.count(first):
        number = DOMAINS[turn % len(DOMAINS)]
        if holder := _take(number):
            break
        if (turn - first + 1) % len(DOMAINS) == 0:
            if time.monotonic() > until:
                raise TimeoutError(f"all ROS domains from {DOMAINS[0]} to {DOMAINS[-1]} are in use")
            time.sleep(LOOK_AGAIN)
    with holder:
        yield number


def _take(domain: int) -> socket.socket | None:
    """What keeps others from a domain, None if it is in use."""
    port = FIRST_PORT + PORTS_OF_A_DOMAIN * domain
    holder = _bound(port + KEPT)
    if holder is None:
        return None
    for offset in (0, *OF_PARTICIPANTS):
        probe = _bound(port + offset)
        if probe is None:
            holder.close()
            return None
        probe.close()
    return holder


def _bound(port: int) -> socket.socket | None:
    """A socket that has a UDP port of all interfaces for itself, None if somebody else is there."""
    made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        made.bind(("", port))
    except OSError as error:
        made.close()
        if error.errno != errno.EADDRINUSE:
            raise
        return None
    return made
