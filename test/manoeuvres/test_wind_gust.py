"""A gust against its shape, the impulse of the side force on ice, and its mirror image."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from vehicle_roll_sim import InputError, Road, preset, run
from vehicle_roll_sim.manoeuvres.catalogue import MANOEUVRES

AREA = 3.0
SPEED, WIND = 30.0, 15.0
ICE = Road.from_values({"features": [{"kind": "patch", "start": -1000.0, "friction": 0.0}]})
GUST = MANOEUVRES["wind_gust"]


@pytest.fixture(scope="module")
def vehicle():
    return preset().with_values({"side_force_area": AREA})


def one_minus_cosine(t: float) -> float:
    return WIND / 2 * (1 - math.cos(math.pi * (t - 1.0))) if 1.0 <= t <= 3.0 else 0.0


def trapezoid(t: float) -> float:
    """Ramps of 0.5 s from 1 to 3 s."""
    return WIND * min(max(min(t - 1.0, 3.0 - t) / 0.5, 0.0), 1.0)


SHAPES = {"one_minus_cosine": one_minus_cosine, "trapezoid": trapezoid}
SHORT = {"ramp_time": 0.2}
RAMPS = {"one_minus_cosine": {}, "trapezoid": {"ramp_time": 0.5}}


@pytest.mark.parametrize("shape", SHAPES)
def test_the_wind_is_that_of_the_definition_at_every_time(vehicle, shape):
    gust = dataclasses.replace(GUST, shape=shape, wind_speed=WIND, **RAMPS[shape])
    times = np.linspace(0.0, 5.0, 1001)
    commands = gust.for_vehicle(vehicle, None)(times)
    wanted = [SHAPES[shape](t) for t in times.tolist()]
    np.testing.assert_allclose(commands["wind"][:, 1], wanted, rtol=0, atol=1e-12 * WIND)
    assert not commands["wind"][:, 0].any()
    assert not commands["steering"].any()


def test_without_a_ramp_time_the_ramps_of_a_trapezoid_take_a_fifth_of_a_second():
    gust, given = (dataclasses.replace(GUST, shape="trapezoid", **each) for each in ({}, SHORT))
    times = np.linspace(0.0, 5.0, 1001)
    assert gust.wind(times).tobytes() == given.wind(times).tobytes()


@pytest.mark.parametrize("shape", SHAPES)
def test_on_ice_the_impulse_of_the_side_force_is_the_change_of_momentum(vehicle, shape):
    """M dv/dt = rho/2 A C |V| (w - v) with the air from ahead and from the side. The c.g. of the
    body is that of the vehicle, so it does not yaw. It swings on its suspension: its own velocity
    is compared when it has come to rest, within 0.5 %."""

    def rates(t, v):
        across = SHAPES[shape](t) - v[0]
        return [1.225 / 2 * AREA * math.hypot(SPEED, across) * across / vehicle.mass]

    even = vehicle.with_values({"cg_to_front_axle": 1.27, "cg_to_rear_axle": 1.27})
    values = {"shape": shape, "wind_speed": WIND, **RAMPS[shape], "speed": SPEED}
    result = run("wind_gust", even, road=ICE, speed_hold=0.0, duration=8.0, **values)
    last = result["time"][-200:]
    accuracy = {"max_step": 0.05, "rtol": 1e-9, "atol": 1e-12}
    wanted = float(np.mean(solve_ivp(rates, (0.0, 8.0), [0.0], t_eval=last, **accuracy).y[0]))
    assert abs(result["yaw"]).max() < 1e-6  # rad: rounding of equal moments
    assert wanted > 0.3
    assert float(np.mean(result["v"][-200:])) == pytest.approx(wanted, rel=5e-3)


def test_from_the_other_side_it_is_the_mirror_image_and_figures_are_those_of_the_rows(vehicle):
    left, right = (run("wind_gust", vehicle, wind_speed=side * 20.0) for side in (1.0, -1.0))
    np.testing.assert_allclose(left["y"], -right["y"], rtol=0, atol=1e-9)
    at_end, later = (float(left["y"][round(t * 100)]) for t in (3.0, 4.0))
    assert left.report["deviation at its end"] == f"{at_end:.3f} m"
    assert left.report["deviation 1 s later"] == f"{later:.3f} m"
    assert 0.0 < at_end < later
    after = left["time"] >= 3.0
    largest = max(np.degrees(left["yaw_rate"][after]), key=abs)
    assert left.report["peak yaw rate after it"] == f"{largest:.3f} deg/s"
    halved = run("wind_gust", vehicle, step=5e-4)
    assert halved["y"][400] == pytest.approx(later, rel=0.01)


def test_a_pressure_centre_ahead_turns_it_out_of_the_wind():
    ahead = preset().with_values({"side_force_area": AREA, "pressure_centre_ahead": 0.5})
    rates = [run("wind_gust", each, duration=3.0)["yaw_rate"].max() for each in (ahead, at_cg())]
    assert rates[0] > 1.5 * rates[1]


def at_cg():
    return preset().with_values({"side_force_area": AREA})


def test_what_the_wind_does_not_act_on_is_refused_and_a_short_run_says_so(vehicle):
    with pytest.raises(InputError, match=r"^wind_speed: 20.0 .*side_force_area"):
        run("wind_gust")
    with pytest.raises(InputError, match=r"^ramp_time: 1.5 .*at most half the gust_time, 1 s"):
        dataclasses.replace(GUST, shape="trapezoid", ramp_time=1.5)
    with pytest.raises(InputError, match=r"^ramp_time: 0.5 .*: only with shape trapezoid$"):
        dataclasses.replace(GUST, ramp_time=0.5)
    short = run("wind_gust", vehicle, duration=2.0)
    assert short.report["deviation 1 s later"] == "unknown: the run is too short"
    assert short.report["peak yaw rate after it"] == "unknown: the run is too short"
