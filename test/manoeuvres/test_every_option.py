"""Every option of every manoeuvre changes what is driven or reported, or is refused by name."""

import dataclasses

import numpy as np
import pytest

from vehicle_roll_sim import InputError, preset
from vehicle_roll_sim.declaration import parameters_of
from vehicle_roll_sim.manoeuvres.catalogue import MANOEUVRES
from vehicle_roll_sim.manoeuvres.on_roads.own_road import OnOwnRoad
from vehicle_roll_sim.runs.columns import COLUMNS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.command import Feedback
from vehicle_roll_sim.simulation.options import Options

VEHICLE, OPTIONS = preset().with_values({"side_force_area": 3.0}), Options()
REFUSED = {
    ("tilt_table", "speed"): "0: the vehicle is parked",
    ("curb_trip", "speed"): "give sliding_speed",
    ("soil_trip", "speed"): "give sliding_speed",
    ("wind_gust", "ramp_time"): "only with shape trapezoid",
}
"""Options that say why they have no effect beside the defaults of the others."""
TURNING_IN = ("iso_step_steer", "braking_in_a_turn")


def winding_drive() -> History:
    """Samples that are no run: they sway widely enough to bring every driver to its limits."""
    time = np.arange(0.0, 40.0, 0.1)
    swaying = np.sin(1.3 * time)
    rows = np.zeros((len(time), len(COLUMNS)))
    for name, values in {
        "time": time,
        "x": 4.0 * time,
        "y": 8.0 * swaying,
        "yaw": 0.5 * swaying,
        "u": 12.0 + swaying,
        "yaw_rate": 0.2 * swaying,
        "roll_rate": 0.03 * swaying,
        "lateral_acceleration": 0.08 * time,
        "steering": 0.002 * time,
        "normal_force_lf": 4e3 + 1e3 * swaying,
    }.items():
        rows[:, COLUMNS.index(name)] = values
    return History(rows)


DRIVE = winding_drive()


def other_value(declared, value):
    """Another value than `value`, which most drivers notice."""
    if declared.choices:
        return next(choice for choice in declared.choices if choice != value)
    if value is None:
        return 0.3
    if value in (0.0, 1.0):
        return min(2.0, declared.maximum)
    return value / 2


def driven(manoeuvre) -> list:
    """Speed, duration, commands along the drive, road, and report of a manoeuvre."""
    ready = manoeuvre.for_vehicle(VEHICLE, OPTIONS)
    driver = ready.driver()
    if isinstance(driver, Feedback):
        states = (dict(zip(COLUMNS, row, strict=True)) for row in DRIVE.rows.tolist())
        commands = [driver.command(state["time"], state).tobytes() for state in states]
    else:
        commands = [driver(DRIVE["time"]).tobytes()]
    road = ready.own_road() if isinstance(ready, OnOwnRoad) else None
    shape = (road.grade, road.bank, road.ground().tobytes()) if road else None
    report = ready.report(DRIVE, driver)
    return [manoeuvre.speed, manoeuvre.duration, commands, shape, report]


def test_every_option_of_every_manoeuvre_has_an_effect_or_is_refused_by_name():
    refused = {}
    for name, manoeuvre in MANOEUVRES.items():
        usual = driven(manoeuvre)
        for option, declared in parameters_of(manoeuvre).items():
            value = other_value(declared, getattr(manoeuvre, option))
            try:
                changed = driven(dataclasses.replace(manoeuvre, **{option: value}))
            except InputError as error:
                refused[name, option] = error
                continue
            assert changed != usual, (name, option, value)
    assert refused.keys() == REFUSED.keys()
    for case, why in REFUSED.items():
        assert refused[case].field == case[1]
        assert why in refused[case].allowed


DRIVER = ("preview_time", "driver_delay", "handwheel_rate", "handwheel_limit")
WITHOUT_EFFECT = (
    *((name, "lateral_acceleration", {"handwheel_angle": 30.0}) for name in TURNING_IN),
    *(("side_slope", option, {"steered_by": "fixed"}) for option in DRIVER),
)
"""Options that the value of another one leaves without effect."""


@pytest.mark.parametrize(("name", "option", "beside"), WITHOUT_EFFECT)
def test_an_option_that_another_one_leaves_without_effect_is_refused(name, option, beside):
    manoeuvre = MANOEUVRES[name].with_values(beside)
    value = other_value(parameters_of(manoeuvre)[option], getattr(manoeuvre, option))
    assert driven(dataclasses.replace(manoeuvre, **{option: value})) == driven(manoeuvre)
    with pytest.raises(InputError) as raised:
        MANOEUVRES[name].with_values({option: value, **beside})
    assert raised.value.field == option
    assert next(iter(beside)) in raised.value.allowed
