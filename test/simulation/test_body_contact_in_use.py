"""The option `body_contact` where people meet it: runs, columns, bags, descriptions, refusals."""

import dataclasses
import math

import numpy as np
import pytest

from vehicle_roll_sim import Command, Condition, InputError, Options, Simulation, preset, run
from vehicle_roll_sim.messages.urdf import urdf
from vehicle_roll_sim.runs.columns import BODY_LOADS, COLUMNS
from vehicle_roll_sim.runs.history import History
from vehicle_roll_sim.simulation.body_modes import largest_step_on_body
from vehicle_roll_sim.simulation.description import describe, described
from vehicle_roll_sim.simulation.options import MODELS

ON = Options(body_contact=True)
SPEED = 25.0
"""m/s: of a J-turn that ends in a rollover."""


@pytest.fixture(scope="module")
def rolled():
    """The same run without and with the option."""
    return tuple(
        run("j_turn", options=options, speed=SPEED, duration=5.0) for options in (None, ON)
    )


def test_a_run_goes_on_after_the_rollover_which_remains_an_event(rolled):
    off, on = rolled
    assert off.condition is Condition.ROLLED_OVER
    assert off.history["time"][-1] < 3.0
    assert on.condition is Condition.RUNNING
    assert on.history["time"][-1] == 5.0
    (time,) = on.events.rollover_time
    over = np.degrees(np.abs(on.history["roll"])) >= 85.0
    assert on.history["time"][over.argmax() - 1] <= time <= on.history["time"][over.argmax()]
    assert time == pytest.approx(off.events.rollover_time[0], abs=0.2)  # s: leaning tires, sills
    assert on.metrics["rollover_time"] == time
    assert f"{time:.3f} s" in on.summary
    assert on.summary.endswith("complete")


def test_until_tires_lean_and_the_floor_touches_it_is_the_same_run_to_the_bit(rolled):
    off, on = (each.history for each in rolled)
    before = np.degrees(np.abs(off["roll"])) < 15.0
    count = int(np.argmin(before))
    assert count > 100
    assert off.rows[:count].tobytes() == on.rows[:count].tobytes()
    assert not on.body_loads[:count].any()


def test_the_loads_on_the_corners_are_columns_only_with_the_option(rolled, tmp_path):
    off, on = (each.history for each in rolled)
    off.write_csv(tmp_path / "off.csv")
    on.write_csv(tmp_path / "on.csv")
    first = (tmp_path / "off.csv").read_text().partition("\n")[0]
    assert first.split(",") == [*COLUMNS]
    assert off.body_loads is None
    first = (tmp_path / "on.csv").read_text().partition("\n")[0]
    assert first.split(",") == [*COLUMNS, *BODY_LOADS]
    read = History.read_csv(tmp_path / "on.csv")
    np.testing.assert_array_equal(read.body_loads, on.body_loads)
    assert on.body_loads.max() > 1e4
    assert len(on.part(on["time"] > 3.0).body_loads) == (on["time"] > 3.0).sum()


def test_a_description_says_the_option_only_if_it_is_on():
    for options in (Options(), ON):
        text = describe(Simulation(preset(), options), 10_000_000)
        assert ("body_contact" in text) == options.body_contact
        assert described(text).simulation.options == options.for_vehicle(preset())


def test_models_for_wheels_on_the_road_refuse_it():
    for model in set(MODELS) - {"1", "2"}:
        refusal = rf"^body_contact: model {model} does not have it: an option of models 1 and 2$"
        with pytest.raises(InputError, match=refusal):
            Options(model=model, body_contact=True)
    for name in ("tire_normal_to_ground", "steady_state_slip"):
        with pytest.raises(
            InputError, match=rf"^{name}: not possible together with body_contact: an option for"
        ):
            Options(body_contact=True, **{name: True})


def test_the_box_follows_from_the_vehicle_or_is_given():
    vehicle = preset()
    body = vehicle.record()["body"][0]
    assert (body["ahead"], body["behind"]) == (1.016 + 0.8, 1.524 + 0.9)
    assert body["left"] == body["right"] == pytest.approx((1.5 + 0.205) / 2)
    assert body["top"] == pytest.approx(1.5 * 0.75)
    assert body["bottom"] == pytest.approx(0.5)
    sunk = vehicle.mass * 9.81 / (4 * body["stiffness"])
    assert sunk == pytest.approx(0.01 * (body["top"] + body["bottom"]))
    critical = 2 * math.sqrt(4 * body["stiffness"] * vehicle.mass)
    assert 4 * body["damping"] == pytest.approx(0.5 * critical)
    small = preset("tenth_scale")
    body = small.record()["body"][0]
    assert body["ahead"] == pytest.approx(small.cg_to_front_axle + 0.4 * small.wheelbase)
    given = {"body_roof_height": 1.2, "body_width": 2.0, "cg_offset": 0.1, "body_friction": 0.0}
    body = vehicle.with_values(given).record()["body"][0]
    assert (body["left"], body["right"], body["friction"]) == (0.9, 1.1, 0.0)
    assert body["top"] == pytest.approx(1.2 - 0.75)
    for name, value, allowed in (
        ("body_roof_height", 0.2, "more than the height of the floor, 0.25 m"),
        ("body_floor_height", 2.0, "less than the height of the roof, 1.875 m"),
    ):
        with pytest.raises(InputError, match=rf"^{name}: {value} is not allowed: {allowed}"):
            vehicle.with_values({name: value})


def test_a_step_that_is_too_long_for_the_corners_is_refused():
    """The limit is that of the modes of a body that lies on its roof, from the equations."""
    smooth = {"body_stiffness": 1e9, "body_damping": 1e5, "body_friction": 0.0}
    stiff = preset().with_values(smooth)
    record = stiff.record()[0]
    largest = largest_step_on_body(record, 0.1)
    simulation = Simulation(stiff, ON, check_step=False)
    simulation.reset(0.0)
    state = simulation.state
    state["roll"], state["z"] = math.pi, record.body.top - 1e-3
    state["tire_compression"] = -1.0
    on_roof = simulation.largest_stable_step()
    assert largest <= 1.001 * on_roof  # it is the least of all ways to lie
    assert largest > 0.3 * on_roof
    with pytest.raises(
        InputError, match=r"^step: 0.001 is not allowed: at most 0.0\d+ s with body_"
    ):
        Simulation(stiff, ON).reset(10.0)
    rough = preset().with_values({"body_friction": 10.0})
    with pytest.raises(InputError, match=r"^step: 0.001 .* s with .*, body_friction 10 \(-\)$"):
        Simulation(rough, ON).reset(10.0)
    Simulation(stiff, dataclasses.replace(ON, body_contact=False)).reset(10.0)


def test_the_roll_angle_may_exceed_half_a_turn_and_the_pitch_angle_ends_a_run():
    ends = {"roll": (9.0, Condition.RUNNING), "pitch": (1.56, Condition.DIVERGED)}
    for name, (angle, expected) in ends.items():
        simulation = Simulation(preset(), ON)
        simulation.reset(10.0)
        simulation.state["z"], simulation.state[name] = 5.0, angle
        simulation.state["tire_compression"] = -3.0
        assert simulation.step(Command(), 0.01) is expected
    assert simulation.implausible == "pitch"


def test_the_robot_description_has_the_box_only_with_the_option():
    vehicle = preset().with_values({"body_width": 2.0})
    assert urdf(vehicle) == urdf(preset())
    assert 'size="4.24 2 1.625"' in urdf(vehicle, ON)
