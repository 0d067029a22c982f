"""The curb trip against a rigid block."""

import pytest

from vehicle_roll_sim import Condition, InputError, Options, run


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("model", ["1", "2"])
def test_it_rolls_over_at_the_critical_speed_of_a_block_but_not_below_its_energy(model, side):
    """The springs have energy of their own at rest, a sixth of that of the least speed."""
    upright = run("curb_trip", options=Options(model), sliding_speed=2.3, side=side)
    assert 0.92 * upright.manoeuvre.least > 2.3
    assert upright.condition is Condition.RUNNING
    assert abs(upright.metrics["peak_roll"]) > 0.1  # it has met the curb
    critical = upright.manoeuvre.critical
    over = run("curb_trip", options=Options(model), sliding_speed=critical, side=side)
    assert over.condition is Condition.ROLLED_OVER
    assert over.metrics["peak_roll"] * (1 if side == "right" else -1) > 1.4


@pytest.mark.parametrize("speed", [0.5, 4.0, 15.0])
def test_it_slides_at_the_speed_asked_for(speed):
    result = run("curb_trip", sliding_speed=speed, duration=3.05)
    assert abs(result["v"][-1]) == pytest.approx(speed, rel=1e-6)  # the last step of the table
    assert abs(result["roll"]).max() < 1e-6
    assert result.report["sliding speed"] == f"{speed:.3f} m/s"


def test_a_vehicle_that_is_driven_is_refused():
    with pytest.raises(InputError, match=r"^speed: 1.0 .*slides"):
        run("curb_trip", speed=1.0)
