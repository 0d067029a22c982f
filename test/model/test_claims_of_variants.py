"""What the source says of its simplified models and options, at the reference conditions.

The numbers asserted are the criteria; those seen are beside them.
"""

import numpy as np
import pytest
from responses import RAMP_STEER, STEP_STEER, difference, more, responder, steady

from vehicle_roll_sim import RF, RR


@pytest.fixture(scope="module")
def respond(reference):
    return responder(reference)


@pytest.fixture(scope="module")
def step(respond):
    return lambda name: respond(name, STEP_STEER)


@pytest.fixture(scope="module")
def ramp(respond):
    return lambda name: respond(name, RAMP_STEER)


def test_claim_1_small_angles_make_no_difference_in_the_step_steer(step):
    assert difference(step("1a"), step("1")).max() < 0.05  # deg; 0.02


def test_claim_2_small_angles_matter_in_the_ramp_steer_once_the_roll_is_large(ramp):
    roll, apart = ramp("1").roll, difference(ramp("1a"), ramp("1"))
    assert apart[: np.argmax(roll > 8.0)].max() < 0.1  # deg; 0.05
    assert apart[np.argmax(roll > 15.0)] > 0.5  # deg; 0.9


def test_claim_3_unsprung_inertia_dropped_raises_the_peaks_slightly(step):
    one, other = step("1b"), step("1a")
    assert 0.01 <= more(one.peak_roll, other.peak_roll) <= 0.10  # 0.046
    peaks = one.front_load_transfer.max(), other.front_load_transfer.max()
    assert 0.0 < more(*peaks) <= 0.03  # 0.005


def test_claim_4_unsprung_inertia_dropped_hardly_changes_the_rollover(ramp):
    assert ramp("1b").rollover == pytest.approx(ramp("1").rollover, rel=0.05)  # 5.41, 5.22 s


def test_claim_5_inertia_dropped_of_the_links_only_rolls_over_sooner(ramp):
    assert ramp("1b-turning-kept").rollover <= ramp("1b").rollover - 0.2  # s; 0.36


def test_claim_6_unsprung_mass_lumped_into_the_body_rolls_too_far(step):
    assert more(step("1b-mass-lumped").peak_roll, step("1b").peak_roll) > 0.10  # 0.16


def test_claim_7_contact_forces_not_rotated_lower_roll_and_load_transfer(step):
    one, other = step("1c-i"), step("1b")
    assert one.peak_roll < other.peak_roll
    assert one.steady_roll < other.steady_roll
    for summary in (np.max, steady):
        assert summary(one.front_load_transfer) < summary(other.front_load_transfer)
        assert summary(one.rear_load_transfer) < summary(other.rear_load_transfer)


def test_claim_8_contact_forces_not_rotated_keep_the_ramp_steer_from_rolling_over(ramp):
    assert ramp("1b").peak_roll > 85.0
    assert ramp("1c-i").peak_roll < 15.0  # deg; 11.1


def test_claim_9_unsprung_forces_not_rotated_lose_load_more_than_roll(reference, step):
    one, other = step("1c-ii"), step("1b")
    lost = -more(steady(one.load).sum(), weight(reference))
    assert lost >= 0.02  # 0.034
    assert abs(more(one.steady_roll, other.steady_roll)) < lost  # 0.009


def weight(vehicle) -> float:
    return 9.81 * (vehicle.sprung_mass + vehicle.per_wheel("unsprung_mass").sum())


def test_claim_10_rates_not_rotated_add_load_and_prevent_the_rollover(reference, step, ramp):
    assert more(steady(step("1c-iii").load).sum(), weight(reference)) >= 0.02  # 0.035
    assert ramp("1c-iii").peak_roll < 20.0  # deg; 14.2


def test_claim_10_lift_off_is_predicted_against_what_the_source_says(ramp):
    assert np.isfinite(ramp("1c-iii").lift_off).tolist() == [False, False, True, False]


def test_claim_11_contact_moving_with_the_corner_changes_the_frequency_only(step):
    one, other = step("1c-iv"), step("1b")
    assert more(one.frequency, other.frequency) >= 0.20  # 0.43 of the first period
    assert one.steady_roll == pytest.approx(other.steady_roll, rel=0.005)
    np.testing.assert_allclose(steady(one.load), steady(other.load), rtol=0.005)


@pytest.mark.parametrize(
    ("number", "model", "limit"), [(12, "1c-iv", 0.3), (13, "1b-static-strut", 0.1)]
)
def test_claims_12_and_13_the_ramp_steer_is_that_of_1b_until_lift_off(ramp, number, model, limit):
    one, other = ramp(model), ramp("1b")
    apart = difference(one, other)
    until = max(one.first_lift_off, other.first_lift_off)
    assert apart[one.time[: len(apart)] <= until].max() < limit  # deg; 0.23, 0.06


def test_claim_13_struts_without_length_make_a_small_frequency_error(step):
    one, other = step("1b-no-strut"), step("1b")
    assert one.frequency == pytest.approx(other.frequency, rel=0.03)  # 0.025


def test_claim_14_no_roll_centre_changes_roll_and_peaks_but_hardly_the_steady_loads(step):
    one, other = step("no roll centre"), step("1")
    assert more(one.steady_roll, other.steady_roll) > 0.15  # 0.21
    outer = [RF, RR]
    np.testing.assert_allclose(steady(one.load)[outer], steady(other.load)[outer], rtol=0.02)
    excess, usual = (s.load[:, RF].max() - steady(s.load)[RF] for s in (one, other))
    assert more(excess, usual) > 0.20  # 0.38


def test_claim_15_no_roll_centre_hardly_changes_the_frequency(step):
    assert step("no roll centre").frequency == pytest.approx(step("1").frequency, rel=0.03)


def test_claim_16_no_roll_centre_lifts_a_wheel_earlier_yet_rolls_over_later(ramp):
    one, other = ramp("no roll centre"), ramp("1")
    assert one.first_lift_off < other.first_lift_off  # 2.99, 3.02 s
    assert one.rollover > other.rollover  # 5.60, 5.22 s


def test_claim_17_upright_tires_change_the_frequency_but_not_the_steady_roll(step):
    one, other = step("upright"), step("1")
    assert more(one.frequency, other.frequency) >= 0.10  # 0.18
    assert one.steady_roll == pytest.approx(other.steady_roll, rel=0.015)  # 0.009
    assert steady(one.front_load_transfer) < steady(other.front_load_transfer)
    assert steady(one.rear_load_transfer) < steady(other.rear_load_transfer)


def test_claim_18_upright_tires_delay_every_lift_off_and_the_rollover(ramp):
    one, other = ramp("upright"), ramp("1")
    never = np.inf
    assert (np.nan_to_num(one.lift_off, nan=never) > other.lift_off).all()  # rr: never
    assert one.rollover > other.rollover  # 6.33, 5.22 s


def test_claim_19_link_load_transfer_by_axle_or_side_makes_no_difference(step, ramp):
    one, other = step("each side"), step("1")
    assert one.peak_roll == pytest.approx(other.peak_roll, rel=0.005)
    assert one.steady_roll == pytest.approx(other.steady_roll, rel=0.005)
    assert ramp("each side").rollover == pytest.approx(ramp("1").rollover, rel=0.05)  # 5.10 s
