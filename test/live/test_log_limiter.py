"""Each message is logged once per interval, regardless of other messages."""

from vehicle_roll_sim.live.log_limiter import LogLimiter


def test_each_kind_is_let_through_once_an_interval():
    now = [100.0]
    limiter = LogLimiter(1.0, clock=lambda: now[0])
    assert limiter.allows(("steering_cmd", "dropped"))
    assert not limiter.allows(("steering_cmd", "dropped"))
    assert limiter.allows(("steering_cmd", "clamped"))
    assert limiter.allows(("speed_cmd", "dropped"))
    now[0] += 0.999
    assert not limiter.allows(("steering_cmd", "dropped"))
    now[0] += 0.001
    assert limiter.allows(("steering_cmd", "dropped"))


def test_a_flood_is_one_line_a_second():
    now = [0.0]
    limiter = LogLimiter(1.0, clock=lambda: now[0])
    said = 0
    for n in range(100_000):  # ten seconds of 10 kHz
        now[0] = n * 1e-4
        said += limiter.allows("flood")
    assert said == 10
