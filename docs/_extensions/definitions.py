"""Sentences around numbers of the package: definitions of the manoeuvres, and usual values."""

import dataclasses
import math
from collections.abc import Iterable

from vehicle_roll_sim.manoeuvres.catalogue import MANOEUVRES, PAPER
from vehicle_roll_sim.manoeuvres.nhtsa import METRES_PER_SECOND_OF_A_MPH
from vehicle_roll_sim.vehicle import combinations as together
from vehicle_roll_sim.vehicle import plausibility as usual

DEFINITIONS = {
    "slowly_increasing_steer": "NHTSA: {mph:g} mph held, handwheel at {handwheel_rate:g}°/s to at "
    "most {handwheel_angle:g}° (see below for low steering ratios)",
    "nhtsa_j_turn": "NHTSA: handwheel to {scalar:.1f} δ at {handwheel_rate:g}°/s, held for "
    "{hold:g} s, back to 0 in {back:g} s; throttle dropped; {mph:g} mph",
    "nhtsa_fishhook": "NHTSA 1b: handwheel to {scalar:g} δ at {handwheel_rate:g}°/s, held until "
    "the roll rate has fallen to {reversal_roll_rate:g}°/s, then to the opposite angle at "
    "{handwheel_rate:g}°/s, held for {hold:g} s, back to 0 in {back:g} s; throttle dropped; "
    "{mph:g} mph",
    "sine_with_dwell": "FMVSS 126: one sine of {frequency:g} Hz with a dwell of {dwell:g} s after "
    "its third quarter; throttle dropped; {km_per_h:g} km/h, {scalar:g} δ",
    "iso_step_steer": "ISO 7401: {km_per_h:g} km/h held, handwheel turned in {rise:g} s (10 to "
    "90 % in {main_rise:g} s) to the angle for a steady {lateral_acceleration:g} m/s²",
    "iso_severe_double_lane_change": "ISO 3888-2, obstacle avoidance: between cones into an "
    "adjacent lane and back, by a driver who follows a path; throttle released 2 m into the first "
    "lane; {km_per_h:g} km/h",
    "iso_double_lane_change": "ISO 3888-1: the same with longer lanes that are 3.5 m apart; speed "
    "held; {km_per_h:g} km/h",
    "steady_state_circle": "after ISO 4138, constant speed: {km_per_h:g} km/h held, handwheel at "
    "{handwheel_rate:g}°/s to at most {handwheel_angle:g}°",
    "constant_radius_circle": "after ISO 4138, constant radius: a driver follows a circle of "
    "{radius:g} m while the speed rises from {speed:g} m/s at {acceleration:g} m/s²",
    "constant_handwheel_circle": "after ISO 4138, constant handwheel angle: {handwheel_angle:g}°, "
    "while the speed rises from {speed:g} m/s at {acceleration:g} m/s²",
    "tilt_table": "after SAE J2180, on its own road: parked on a table whose {side} side is raised "
    "at {rate:g}°/s to at most {steepest:g}°",
    "braking_in_a_turn": "after ISO 7975: {km_per_h:g} km/h held, handwheel turned to the angle "
    "for a steady {lateral_acceleration:g} m/s²; from {brakes_from:g} s on, brake torques for "
    "{deceleration:g} m/s² with the handwheel held and the throttle dropped",
    "wind_gust": "a gust of {wind_speed:g} m/s from the side for {gust_time:g} s, with the "
    "handwheel held straight ahead; {km_per_h:g} km/h held; for vehicles with air forces",
    "soil_trip": "on its own road: slides sideways from ice into soft soil, at {sliding_speed:g} "
    "m/s",
    "corkscrew_ramp": "on its own road: the {side} wheels drive up a ramp {ramp_height:g} m high "
    "and {ramp_length:g} m long, and drop from its end; {km_per_h:g} km/h held",
    "side_slope": "on its own road: along a slope of {slope:g}° that rises to the {side}, with a "
    "driver who keeps to the course; {km_per_h:g} km/h held",
    "random_road": "on its own road: straight ahead on a random road of class {roughness} after "
    "ISO 8608; {km_per_h:g} km/h held",
    "curb_trip": "on its own road: slides sideways on ice, at {sliding_speed:g} m/s, against a "
    "curb {curb_height:g} m high",
    "split_friction_braking": "on its own road: braking from {km_per_h:g} km/h on a straight road "
    "whose {side} side is slippery (friction times {low_friction:g}), with a driver who follows it",
}


def definitions() -> dict[str, str]:
    """Every manoeuvre, those of the paper together, and what it is."""
    paper = "`, `".join(PAPER)
    of_paper = "those of Shim and Ghike (2007), the source of the model; road-wheel angles"
    assert DEFINITIONS.keys() == MANOEUVRES.keys() - PAPER.keys()
    return {paper: of_paper} | {
        name: text.format(**_numbers(MANOEUVRES[name])) for name, text in DEFINITIONS.items()
    }


def _numbers(manoeuvre) -> dict[str, float]:
    numbers = dataclasses.asdict(manoeuvre)
    speeds = {
        "mph": round(manoeuvre.speed / METRES_PER_SECOND_OF_A_MPH, 6),
        "km_per_h": round(manoeuvre.speed * 3.6, 6),
    }
    main_rise = {"main_rise": 0.8 * numbers["rise"]} if "rise" in numbers else {}
    return numbers | speeds | main_rise


def usual_values() -> tuple[tuple[str, str], ...]:
    """The quantities that vehicle.plausibility looks at, and what is usual."""
    return (
        ("static deflection of a spring", f"at most {usual.LARGEST_SAG:g} m"),
        ("static compression of a tire", f"at most {usual.LARGEST_FLATTENING:g} of its radius"),
        (
            "ride frequency of an axle, tires included",
            f"{_between(usual.RIDE_FREQUENCY)} Hz",
        ),
        ("damping ratio of an axle, tires not included", _between(usual.DAMPING_RATIO)),
        *(
            (f"radius of gyration for `{name}`", f"{_between(range_)} of the {length}")
            for name, (length, *range_) in usual.RADIUS_OF_GYRATION.items()
        ),
        (
            "radius of gyration for `wheel_inertia`, with the unsprung mass",
            f"{_between(usual.WHEELS_RADIUS_OF_GYRATION)} of the tire radius",
        ),
        (
            "roll centre given by its depth",
            "not below the road; given by its height, it may be anywhere",
        ),
        ("tire pressure", "PRESMIN to PRESMAX of the tire file"),
        ("roll centre", "not above the sprung c.g."),
        (
            "height of the sprung c.g.",
            f"at least {usual.LOWEST_CENTRE:g} of that of the wheel centres",
        ),
        (
            "steering angle of the road wheels",
            f"at most {usual.LARGEST_STEERING:.4f} rad, {math.degrees(usual.LARGEST_STEERING):g}°",
        ),
    )


def usual_combinations() -> tuple[tuple[str, str], ...]:
    """The quantities that vehicle.combinations looks at, and what is usual."""
    return (
        ("static stability factor", _between(together.STATIC_STABILITY)),
        (
            "roll gradient on a fixed roll axis, tires included",
            f"at most {together.LARGEST_ROLL_GRADIENT:g} deg/g",
        ),
        ("share of the front axle in the roll stiffness", _between(together.FRONT_SHARE)),
        ("share of the front axle in the weight", _between(together.FRONT_LOAD)),
        (
            "static load of a tire",
            f"{_between(together.LOAD_OF_TIRE)} times LFZO FNOMIN of its file",
        ),
        (
            "tire radius, if the tire file gives the effective rolling radius",
            f"{_between(together.RADIUS_OF_TIRE)} times UNLOADED_RADIUS",
        ),
    )


def _between(limits: Iterable[float]) -> str:
    return "{:g} to {:g}".format(*limits)
