"""`python -m benchmarks.soak`: send random messages to sessions and check what must always hold."""

import gc
import math
import os
import sys
import time
from pathlib import Path

import numpy as np

from benchmarks.random_session import BrokenPromiseError, Driven, Found
from vehicle_roll_sim.arguments import OneLineParser, exit_status
from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.vehicle.plausibility import unwarned

PROGRAM = "soak"
PERIODS_OF_A_SESSION = 500
"""Each session has another model, period and timeout."""


def soak(most_messages: int, seed: int) -> Found:
    """Run random sessions until so many messages have been sent; raises BrokenPromiseError."""
    rng, found, begun = np.random.default_rng(seed), Found(), time.monotonic()
    settled = None
    while found.messages < most_messages:
        driven = Driven(rng, found)
        driven.run(PERIODS_OF_A_SESSION, most_messages)
        channels = driven.inbox.channels.values()
        found.dropped += sum(channel.dropped for channel in channels)
        found.clamped += sum(getattr(channel, "clamped", 0) for channel in channels)
        if settled is None and found.messages >= most_messages / 10:
            settled = resident()
    gc.collect()
    found.growth = resident() - (settled or 0.0)
    found.seconds = time.monotonic() - begun
    return found


def resident() -> float:
    """Resident memory of this process (MiB)."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20


def as_text(found: Found) -> str:
    """The results, one figure per line."""
    ends = ", ".join(f"{name.lower()} {n}" for name, n in sorted(found.conditions.items()))
    lines = {
        "messages": f"{found.messages}, of which dropped {found.dropped}, clamped {found.clamped}",
        "periods": f"{found.periods}, in {found.sessions} sessions",
        "seconds": f"{found.seconds:.1f}",
        "ends of runs": ends or "none",
        "resets": found.resets,
        "pauses": found.pauses,
        "largest load of a tire (N)": f"{found.largest_load:.6g}",
        "lifted wheels seen": found.lifted,
        "largest roll (deg)": f"{math.degrees(found.largest_roll):.4g}",
        "quaternion norm off 1 by": f"{found.quaternion_error:.2g}",
        "memory growth (MiB)": f"{found.growth:.2f}",
    }
    return "\n".join(f"{name}: {value}" for name, value in lines.items())


def main(words: list[str] | None = None) -> int:
    about = "Send random messages to simulated sessions and check what must always hold."
    parser = OneLineParser(prog=PROGRAM, description=about)
    parser.add_argument(
        "--messages", metavar="COUNT", default="1000000", help="messages to send (%(default)s)"
    )
    parser.add_argument(
        "--seed", metavar="NUMBER", default="1", help="seed of the random numbers (%(default)s)"
    )

    def command() -> int:
        arguments = parser.parse_args(words)
        with unwarned():  # implausible commands are intended here
            found = soak(_whole(arguments.messages, "--messages"), _whole(arguments.seed, "--seed"))
        print(as_text(found))
        return 0

    try:
        return exit_status(command, PROGRAM)
    except BrokenPromiseError as broken:
        print(f"{PROGRAM}: {broken}", file=sys.stderr)
        return 1


def _whole(text: str, option: str) -> int:
    if not text.isdecimal():
        raise InputError(option, text, "a whole number")
    return int(text)


if __name__ == "__main__":
    sys.exit(main())
