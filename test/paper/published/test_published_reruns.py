"""Reruns against closed forms of the single-track model, statics, and the published numbers."""

import dataclasses
import math

import pytest

from vehicle_roll_sim.paper.published.comparison import (
    AGREES,
    DIFFERS,
    NOT_JUDGED,
    Compared,
    compare,
)
from vehicle_roll_sim.paper.published.source import numbers

GRAVITY = 9.81
AHEAD, BEHIND = 0.996, 1.624
"""m: whole c.g. of the Honda to its axles."""
FRONT, REAR = math.radians(9.6), math.radians(4.1)
"""rad per g: its cornering compliances."""
WHEELBASE = AHEAD + BEHIND
HONDA = {
    "understeer_gradient": math.degrees(FRONT - REAR),
    "steering_gradient": math.degrees(FRONT - REAR + WHEELBASE * GRAVITY / (30 / 3.6) ** 2),
    "characteristic_speed": 3.6 * math.sqrt(GRAVITY * WHEELBASE / (FRONT - REAR)),
    "tangent_speed": 3.6 * math.sqrt(GRAVITY * BEHIND / REAR),
}
"""Single-track model, in the published units."""
NOT_JUDGEABLE = {
    "T/2h, on the tilt table with springs and tires of the vehicle suv": 2,
    "static stability factor T/2h": 3,
    "road-wheel angle over lateral acceleration, at 30 km/h": 1,
    "sideslip angle after 1 s of steering at 0.15 rad/s from 15 m/s": 3,
}
"""Quantities and how many of their numbers have no tolerance, for the reasons that they give."""


def test_what_is_judged_agrees_and_what_is_not_is_known(compared):
    """CommonRoad's multi-body model is another engine; the SSF is T/2h by its definition."""
    verdicts = {}
    for one in compared:
        verdicts.setdefault(one.verdict, []).append(one.number.quantity)
    assert not verdicts.get(DIFFERS)
    unjudged = verdicts[NOT_JUDGED]
    assert {quantity: unjudged.count(quantity) for quantity in unjudged} == NOT_JUDGEABLE
    assert len(verdicts[AGREES]) == len(compared) - len(unjudged)


def test_gentle_turns_are_those_of_the_single_track_model(compared):
    """To 0.5 %: steering is finite, and slip of the driven wheels and pitch are there besides."""
    found = {
        one.number.rerun: one.computed
        for one in compared
        if one.number.name == "Honda Civic Si Coupe 2012"
    }
    assert found == pytest.approx(HONDA, rel=5e-3)


def test_on_stiff_springs_both_wheels_leave_the_tilt_table_at_the_static_stability_factor(compared):
    computed = {(one.number.quantity, one.number.name): one.computed for one in compared}
    tilted = {key: value for key, value in computed.items() if "stiff" in key[0]}
    assert len(tilted) == 2
    for (_, name), value in tilted.items():
        factor = computed["static stability factor T/2h", name]
        assert value == pytest.approx(factor, abs=1e-3)  # 0.01 deg of the table are 4e-4
        on_springs = next(v for (q, n), v in computed.items() if n == name and "suv" in q)
        assert on_springs < 0.95 * factor


def test_a_vehicle_that_is_another_differs():
    (number,) = (
        one
        for one in numbers()
        if one.rerun == "static_stability_factor" and one.name.startswith("Subaru")
    )
    higher = number.vehicle.with_values({"total_cg_height": 0.6})
    (one,) = compare([dataclasses.replace(number, vehicle=higher)])
    assert one.verdict == DIFFERS
    assert one.difference == pytest.approx((58.2 + 58.0) / 4 * 0.0254 / 0.6 - 1.264, abs=1e-9)
    assert Compared(number, math.nan).verdict == DIFFERS
    assert Compared(dataclasses.replace(number, tolerance=None), 5.0).verdict == NOT_JUDGED
