"""Claims 14 to 22: roll centre, tires, link load transfer, 8 degrees of freedom, multibody."""

import math

import numpy as np

from vehicle_roll_sim.model.records import RF, RR, WHEELS
from vehicle_roll_sim.paper.claim import Claim, Measured, driven_to_the_end, percent_more
from vehicle_roll_sim.paper.study import (
    ASYMMETRIC_LINKS,
    ENGINE,
    NO_ROLL_CENTRE,
    SAME_AS_ENGINE,
    UPRIGHT_TIRES,
    Response,
    Study,
)
from vehicle_roll_sim.runs import metrics
from vehicle_roll_sim.simulation.limits import DEFAULT_ROLLOVER_DEGREES


def transient_excess(response: Response, wheel: int) -> float:
    """Peak of a tire load over its steady value (N)."""
    load = response.loads[:, wheel]
    return load.max() - response.steady(load)


def no_roll_centre_in_step(study: Study) -> list[Measured]:
    one, other = study.step(NO_ROLL_CENTRE), study.step("1")
    roll = percent_more(one.steady_roll, other.steady_roll)
    changes = one.steady(one.loads) / other.steady(other.loads) - 1
    outer = 100 * np.abs(changes[[RF, RR]]).max()
    excess = percent_more(transient_excess(one, RF), transient_excess(other, RF))
    return [
        Measured("steady roll", roll, "%", above=15.0),
        Measured("a steady outer load changed by", outer, "%", below=2.0),
        Measured("overshoot of rf's load", excess, "%", above=20.0),
    ]


def no_roll_centre_frequency(study: Study) -> list[Measured]:
    change = percent_more(study.step(NO_ROLL_CENTRE).frequency, study.step("1").frequency)
    return [Measured("frequency", change, "%", -3.0, 3.0)]


def no_roll_centre_in_ramp(study: Study) -> list[Measured]:
    one, other = study.ramp(NO_ROLL_CENTRE), study.ramp("1")
    return [
        Measured("first lift-off earlier", other.first_lift_off - one.first_lift_off, "s", 0.0),
        Measured("85° later", one.rollover - other.rollover, "s", 0.0),
    ]


def upright_tires_in_step(study: Study) -> list[Measured]:
    one, other = study.step(UPRIGHT_TIRES), study.step("1")
    transfer = one.steady(one.load_transfer) / other.steady(other.load_transfer) - 1
    return [
        Measured("frequency", percent_more(one.frequency, other.frequency), "%", above=10.0),
        Measured("steady roll", percent_more(one.steady_roll, other.steady_roll), "%", -1.5, 1.5),
        Measured("steady load transfer", 100 * transfer.max(), "%", below=0.0),
    ]


def upright_tires_in_ramp(study: Study) -> list[Measured]:
    """An event that occurs in model 1 but not here counts as infinitely late."""
    one, other = study.ramp(UPRIGHT_TIRES), study.ramp("1")
    lift_offs = np.nan_to_num(one.lift_offs, nan=math.inf) - other.lift_offs
    rollover = np.nan_to_num(one.rollover, nan=math.inf) - other.rollover
    return [
        Measured("each lift-off later by at least", float(lift_offs.min()), "s", above=0.0),
        Measured("85° later", float(rollover), "s", above=0.0),
    ]


def link_load_transfer(study: Study) -> list[Measured]:
    one, other = study.step(ASYMMETRIC_LINKS), study.step("1")
    rollovers = study.ramp(ASYMMETRIC_LINKS).rollover, study.ramp("1").rollover
    return [
        Measured("peak roll", percent_more(one.peak_roll, other.peak_roll), "%", -0.5, 0.5),
        Measured("steady roll", percent_more(one.steady_roll, other.steady_roll), "%", -0.5, 0.5),
        Measured("85° in the ramp", percent_more(*rollovers), "%", -5.0, 5.0),
    ]


def deviation(one: Response, other: Response, column: str) -> float:
    """RMS difference of a column, in percent of the peak of `other`.

    nan if the runs do not end at the same time.
    """
    if len(one.time) != len(other.time):
        return math.nan
    values = other.history[column]
    peak = abs(metrics.peak(other.time, values)[0])
    return float(100 * metrics.rms(one.history[column] - values) / peak)


def eight_dof_in_step(study: Study) -> list[Measured]:
    one, other = study.step("8dof"), study.step("1")
    loads = [deviation(one, other, f"normal_force_{wheel}") for wheel in WHEELS]
    springs = deviation(study.step("8dof-rigid-tires"), other, "roll")
    return [
        Measured("rms of roll", deviation(one, other, "roll"), "%", below=4.0),
        Measured("of yaw rate", deviation(one, other, "yaw_rate"), "%", below=1.0),
        Measured("of a tire load", max(loads), "%", below=3.0),
        Measured("of roll without tires in series", springs, "%"),
    ]


def eight_dof_in_ramp(study: Study) -> list[Measured]:
    one = study.ramp("8dof")
    return [
        Measured("peak roll of 8dof", one.peak_roll, "deg", below=DEFAULT_ROLLOVER_DEGREES),
        driven_to_the_end(one),
        Measured("85° of model 1", study.ramp("1").rollover, "s", above=0.0),
    ]


def multibody(study: Study) -> list[Measured]:
    one, other, full = (study.j_turn(case) for case in (SAME_AS_ENGINE, ENGINE, "1"))

    def apart(column: str) -> float:
        rows = min(len(one.time), len(other.time))
        return float(np.abs(one.history[column][:rows] - other.history[column][:rows]).max())

    return [
        Measured("roll difference", np.degrees(apart("roll")), "deg", below=1e-6),
        Measured("yaw rate", np.degrees(apart("yaw_rate")), "deg/s", below=1e-4),
        Measured("lateral acceleration", apart("lateral_acceleration"), "m/s²", below=1e-4),
        Measured("a load", max(apart(f"normal_force_{w}") for w in WHEELS), "N", below=1e-3),
        Measured("85°", abs(one.rollover - other.rollover), "s", below=1e-6),
        Measured("effect of the roll centre: 85° later by", full.rollover - one.rollover, "s"),
    ]


CLAIMS = (
    Claim(
        14,
        "7.1, fig. 14",
        "no roll centre: roll and transient loads differ considerably, steady loads hardly",
        no_roll_centre_in_step,
    ),
    Claim(
        15,
        "7.1, fig. 14",
        "no roll centre: the roll frequency hardly changes",
        no_roll_centre_frequency,
    ),
    Claim(
        16,
        "7.1, fig. 15",
        "no roll centre: lifts a wheel slightly earlier, rolls over later",
        no_roll_centre_in_ramp,
    ),
    Claim(
        17,
        "7.2, fig. 14",
        "tire normal to the ground: frequency changes, steady roll does not, less load transfer",
        upright_tires_in_step,
    ),
    Claim(
        18,
        "7.2, fig. 15",
        "tire normal to the ground: lift-off and rollover come later",
        upright_tires_in_ramp,
    ),
    Claim(
        19,
        "7.3",
        "link load transfer symmetric or asymmetric: no significant difference",
        link_load_transfer,
    ),
    Claim(
        20,
        "8, fig. 17",
        "8 DOF: follows model 1 closely in the step steer",
        eight_dof_in_step,
    ),
    Claim(
        21,
        "8, fig. 18",
        "8 DOF: cannot follow model 1 beyond lift-off",
        eight_dof_in_ramp,
    ),
    Claim(
        22,
        "3, figs. 6, 7",
        "J-turn: an independent multibody engine agrees, also after lift-off",
        multibody,
        needs_engine=True,
    ),
)
