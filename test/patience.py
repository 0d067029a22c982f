"""How long a test waits for an event before it fails.

No measure of speed: tests wait for the event itself, and a busy machine may take its time.
"""

import time

PATIENCE = 300.0
"""s: over ten times the slowest on a quiet machine, which is to compile the model in 20 s."""
POLL = 0.02
"""s between two looks."""


def wait_until(done, what: str):
    """Look until `done()` is true; returns its value. Fails, naming `what`, if that never comes."""
    until = time.monotonic() + PATIENCE
    while not (value := done()):
        assert time.monotonic() < until, f"waited {PATIENCE:g} s in vain for {what}"
        time.sleep(POLL)
    return value
