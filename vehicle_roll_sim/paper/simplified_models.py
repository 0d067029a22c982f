"""Claims 1 to 13 of the paper: the effect of each simplification of model 1."""

import math

import numpy as np

from vehicle_roll_sim.paper.claim import (
    Claim,
    Measured,
    driven_to_the_end,
    largest,
    percent_more,
)
from vehicle_roll_sim.paper.study import Response, Study


def difference(one: Response, other: Response) -> np.ndarray:
    """Magnitude of the difference of the roll angles (deg), over the common samples."""
    both = min(len(one.roll), len(other.roll))
    return np.abs(one.roll[:both] - other.roll[:both])


def peak_load_transfer(response: Response) -> np.ndarray:
    """Peak load transfer, front and rear (N), shape (2,)."""
    return response.load_transfer.max(axis=0)


def small_angles_in_step(study: Study) -> list[Measured]:
    apart = difference(study.step("1a"), study.step("1")).max()
    return [Measured("roll difference", apart, "deg", below=0.05)]


def small_angles_in_ramp(study: Study) -> list[Measured]:
    roll, apart = study.ramp("1").roll, difference(study.ramp("1a"), study.ramp("1"))
    over_8, over_15 = (np.logical_or.accumulate(roll[: len(apart)] > angle) for angle in (8, 15))
    at_15 = apart[over_15][0] if over_15.any() else math.nan
    return [
        Measured("roll difference up to 8°", largest(apart[~over_8]), "deg", below=0.1),
        Measured("at 15°", at_15, "deg", above=0.5),
    ]


def unsprung_inertia_in_step(study: Study) -> list[Measured]:
    one, other = study.step("1b"), study.step("1a")
    roll = percent_more(one.peak_roll, other.peak_roll)
    transfer = percent_more(peak_load_transfer(one)[0], peak_load_transfer(other)[0])
    return [
        Measured("peak roll above 1a", roll, "%", 1.0, 10.0),
        Measured("peak front load transfer", transfer, "%", 0.0, 3.0),
    ]


def unsprung_inertia_in_ramp(study: Study) -> list[Measured]:
    one, other = study.ramp("1b").rollover, study.ramp("1").rollover
    return [
        Measured("85° against model 1", percent_more(one, other), "%", -5.0, 5.0),
        Measured("1b", one, "s"),
        Measured("1", other, "s"),
    ]


def turning_kept(study: Study) -> list[Measured]:
    sooner = study.ramp("1b").rollover - study.ramp("1b-turning-kept").rollover
    return [Measured("85° earlier than 1b", sooner, "s", above=0.2)]


def mass_lumped(study: Study) -> list[Measured]:
    more = percent_more(study.step("1b-mass-lumped").peak_roll, study.step("1b").peak_roll)
    return [Measured("peak roll above 1b", more, "%", above=10.0)]


def contact_forces_in_step(study: Study) -> list[Measured]:
    one, other = study.step("1c-i"), study.step("1b")
    peaks = peak_load_transfer(one) / peak_load_transfer(other) - 1
    held = one.steady(one.load_transfer) / other.steady(other.load_transfer) - 1
    over = {
        "peak roll above 1b": percent_more(one.peak_roll, other.peak_roll),
        "steady roll": percent_more(one.steady_roll, other.steady_roll),
        "peak load transfer": 100 * peaks.max(),
        "steady load transfer": 100 * held.max(),
    }
    return [Measured(name, value, "%", below=0.0) for name, value in over.items()]


def contact_forces_in_ramp(study: Study) -> list[Measured]:
    one = study.ramp("1c-i")
    return [
        Measured("85° of 1b", study.ramp("1b").rollover, "s", above=0.0),
        Measured("peak roll of 1c-i", one.peak_roll, "deg", below=15.0),
        driven_to_the_end(one),
    ]


def unsprung_forces(study: Study) -> list[Measured]:
    one, other = study.step("1c-ii"), study.step("1b")
    missing = -percent_more(one.steady(one.loads).sum(), study.weight)
    roll = abs(percent_more(one.steady_roll, other.steady_roll))
    return [
        Measured("steady loads below the weight", missing, "%", above=2.0),
        Measured("steady roll changed by", roll, "%", below=missing),
    ]


def rates(study: Study) -> list[Measured]:
    step, ramp = study.step("1c-iii"), study.ramp("1c-iii")
    excess = percent_more(step.steady(step.loads).sum(), study.weight)
    return [
        Measured("steady loads above the weight", excess, "%", above=2.0),
        Measured("peak roll in the ramp", ramp.peak_roll, "deg", below=20.0),
        driven_to_the_end(ramp),
        Measured("lift-off of lr", float(ramp.lift_offs[2]), "s"),
    ]


def contact_velocity_in_step(study: Study) -> list[Measured]:
    one, other = study.step("1c-iv"), study.step("1b")
    loads = np.abs(one.steady(one.loads) / other.steady(other.loads) - 1).max()
    return [
        Measured("frequency", percent_more(one.frequency, other.frequency), "%", above=20.0),
        Measured("steady roll", percent_more(one.steady_roll, other.steady_roll), "%", -0.5, 0.5),
        Measured("a steady load changed by", 100 * loads, "%", below=0.5),
    ]


def until_lift_off(study: Study, case: str) -> float:
    """Largest difference of a case's roll from 1b's in the ramp steer until a wheel lifts (deg)."""
    one, other = study.ramp(case), study.ramp("1b")
    apart, until = difference(one, other), max(one.first_lift_off, other.first_lift_off)
    return largest(apart[one.time[: len(apart)] <= until])


def contact_velocity_in_ramp(study: Study) -> list[Measured]:
    apart = until_lift_off(study, "1c-iv")
    return [Measured("roll difference from 1b until lift-off", apart, "deg", below=0.3)]


def struts_without_length(study: Study) -> list[Measured]:
    frequency = percent_more(study.step("1b-no-strut").frequency, study.step("1b").frequency)
    apart = until_lift_off(study, "1b-static-strut")
    return [
        Measured("roll difference from 1b until lift-off", apart, "deg", below=0.1),
        Measured("frequency of the second step", frequency, "%", -3.0, 3.0),
    ]


CLAIMS = (
    Claim(
        1,
        "4, fig. 8",
        "1a: small angles make no difference in the step steer",
        small_angles_in_step,
    ),
    Claim(
        2,
        "4, fig. 9",
        "1a: in the ramp steer they matter once the roll exceeds 8 to 10°",
        small_angles_in_ramp,
    ),
    Claim(
        3,
        "5, fig. 8",
        "1b: without unsprung inertia peak roll and load transfer are slightly higher",
        unsprung_inertia_in_step,
    ),
    Claim(
        4,
        "5, fig. 9",
        "1b: in the ramp steer rolls over at almost the same time as model 1",
        unsprung_inertia_in_ramp,
    ),
    Claim(5, "5", "equations 56 and 57 without 58: rolls over sooner", turning_kept),
    Claim(6, "5", "unsprung mass lumped into m in 48, 49: responses deviate", mass_lumped),
    Claim(
        7,
        "6.1, fig. 10",
        "1c-i: roll and load transfer are lower in the step steer",
        contact_forces_in_step,
    ),
    Claim(
        8,
        "6.1, fig. 11",
        "1c-i: stays upright in the ramp steer instead of rolling over",
        contact_forces_in_ramp,
    ),
    Claim(
        9,
        "6.2, figs. 10, 11",
        "1c-ii: tire loads too low, more so than the roll angle",
        unsprung_forces,
    ),
    Claim(
        10,
        "6.3, figs. 12, 13",
        "1c-iii: tire loads too high, no rollover in the ramp steer",
        rates,
    ),
    Claim(
        11,
        "6.4, fig. 12",
        "1c-iv: different roll frequency; steady roll and loads unchanged",
        contact_velocity_in_step,
    ),
    Claim(
        12,
        "6.4, fig. 13",
        "1c-iv: same as 1b in the ramp steer up to lift-off",
        contact_velocity_in_ramp,
    ),
    Claim(
        13,
        "6.4",
        "static strut lengths: no error before lift-off; no strut: a small error in frequency",
        struts_without_length,
    ),
)
