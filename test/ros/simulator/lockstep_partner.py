"""A simulator in lockstep, and a peer that answers it."""

LOCKSTEP = ("simulator", "--ros-args", "-p", "mode:=lockstep")


def answered(peer, value=0.01):
    """The next state after an answer."""
    before = len(peer.received["state"])
    peer.publish("steering_cmd", value)
    peer.wait(lambda: len(peer.received["state"]) > before, "the next state")
    return peer.received["state"][-1][1]


def begin(start, peer, *words):
    """A simulator in lockstep that has published its first set."""
    simulator = start(*LOCKSTEP, *words)
    peer.listen("state", "imu")
    peer.publisher("steering_cmd")
    peer.wait(lambda: peer.received["state"], "the first set")
    return simulator
