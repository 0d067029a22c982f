"""The shift of the contact patch lowers the speed of a rollover (docs/model.md)."""

import dataclasses

import pytest

from vehicle_roll_sim import Condition, Options, preset, run

STIFFNESS = {"front_tire_lateral_stiffness": 275e3, "rear_tire_lateral_stiffness": 275e3}
LESS_FRICTION = {"LMUX": 0.95, "LMUY": 0.95}


def j_turn(speed, factors, **options):
    """A J-turn of the reference vehicle at a speed (km/h), with scaling factors of the tire."""
    tire = preset().tire.with_coefficients(**factors)
    vehicle = dataclasses.replace(preset(), tire=tire).with_values(STIFFNESS)
    return run("j_turn", vehicle, options=Options(**options), speed=speed / 3.6)


@pytest.mark.parametrize(("factors", "speed"), [({}, 46.0), (LESS_FRICTION, 61.0)])
def test_a_shift_of_the_contact_patch_lowers_the_speed_of_a_rollover(factors, speed):
    fixed, shifting = (
        j_turn(speed, factors, contact_patch_shift=each).condition for each in ("off", "on")
    )
    assert (fixed, shifting) == (Condition.RUNNING, Condition.ROLLED_OVER)


@pytest.mark.parametrize(
    ("options", "end"),
    [
        ({}, Condition.RUNNING),
        ({"euler_terms": True}, Condition.ROLLED_OVER),
        ({"no_roll_centre": True}, Condition.ROLLED_OVER),
        ({"link_load_transfer": "asymmetric"}, Condition.ROLLED_OVER),
    ],
)
def test_close_to_sliding_the_choice_of_the_model_decides(options, end):
    result = j_turn(57.0, LESS_FRICTION, contact_patch_shift="on", **options)
    loads = result.wheels("normal_force")
    assert ((loads[:, 0] == 0.0) & (loads[:, 2] == 0.0)).any()  # two wheels are off in any case
    assert result.condition is end
