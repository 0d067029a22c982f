"""ROS domains that nobody else on this machine uses, for `compare`, tests and benchmarks.

People use domain 0, or another one up to 101. From 215 on there are a few more whose ports Linux
does not hand out as ephemeral ports. One of these that is free is reserved here.
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
"""UDP ports of the middleware (RTPS 9.6.1.1); a domain's first is for multicast discovery."""
OF_PARTICIPANTS = range(10, 60, 2)
"""Offsets of the discovery unicast ports of a domain's participants, in order."""
KEPT = 248
"""Offset of the port that reserves a domain; it would belong to a 120th participant."""
PATIENCE = 120.0
"""Time (s) to wait while all are in use."""
LOOK_AGAIN = 0.1
"""s"""
_numbers = itertools.count(os.getpid())
"""Where the next search begins, so that a domain is not reused at once."""


@contextlib.contextmanager
def own_domain() -> Iterator[int]:
    """The ID of a domain reserved for this process within the block.

    Raises TimeoutError if none becomes free in time.
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
    """The socket that reserves a domain, None if the domain is in use."""
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
    """A socket bound to a UDP port on all interfaces, None if the port is in use."""
    made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        made.bind(("", port))
    except OSError as error:
        made.close()
        if error.errno != errno.EADDRINUSE:
            raise
        return None
    return made
