"""Heights and friction of a commanded road from a command file: the same as commands in Python."""

import numpy as np
import pytest
from road_kinds import FEATURES, road
from vehicle_files import refused, write

from vehicle_roll_sim import WHEELS, Command, Simulation, preset, run
from vehicle_roll_sim.batch.case import Case
from vehicle_roll_sim.batch.evaluate import outcome_of
from vehicle_roll_sim.manoeuvres.command_file import command_table, load_commands
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.runs import run as stepwise

POSTS = road({"kind": "commanded"})
PERIOD, END, SPEED = 0.01, 0.6, 20.0
"""s, s, m/s"""
TIMES = np.round(PERIOD * np.arange(round(END / PERIOD) + 1), 9)
AFTER_STEP = TIMES >= 0.1
HEIGHTS = 0.02 * AFTER_STEP[:, None] + 0.005 * np.sin(
    2 * np.pi * 3.0 * TIMES[:, None] + np.arange(4)
)
FRICTIONS = 1.0 - 0.7 * AFTER_STEP[:, None] * np.array([1.0, 0.0, 1.0, 0.1])
NAMES = [f"{field}_{wheel}" for field in ("road_height", "road_friction") for wheel in WHEELS]
STEERING = 0.03


def text_of(values: np.ndarray) -> str:
    rows = np.column_stack([TIMES, values]).tolist()
    header = ",".join(["time", "steering", *NAMES])
    lines = [f"{row[0]!r},{STEERING},{','.join(map(repr, row[1:]))}" for row in rows]
    return "\n".join([header, *lines]) + "\n"


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    values = np.column_stack([HEIGHTS, FRICTIONS])
    return write(tmp_path_factory.mktemp("commands"), "posts.csv", text_of(values))


def on_posts() -> Simulation:
    simulation = Simulation(preset(), road=POSTS)
    simulation.reset(SPEED)
    return simulation


def test_a_step_and_a_sine_from_a_file_are_held_commands_to_the_bit(file):
    driven, held = on_posts(), on_posts()
    stepwise.run(driven, load_commands(file), END, command_period=PERIOD)
    for heights, frictions in zip(HEIGHTS[:-1].tolist(), FRICTIONS[:-1].tolist(), strict=True):
        held.step(Command(STEERING, road_height=heights, road_friction=frictions), PERIOD)
    assert driven.state_vector.tolist() == held.state_vector.tolist()
    assert driven.output_vector.tobytes() == held.output_vector.tobytes()
    assert np.abs(held.state.roll) > 1e-3  # rad: they shook it


def test_between_its_rows_a_file_is_the_same_function_of_time_to_the_bit(file):
    def programme(times: np.ndarray) -> np.ndarray:
        records = np.zeros(len(times), COMMAND)
        records["steering"] = STEERING
        for i in range(4):
            records["road_height"][:, i] = np.interp(times, TIMES, HEIGHTS[:, i])
            frictions = np.interp(times, TIMES, FRICTIONS[:, i])
            records["road_friction_change"][:, i] = frictions - 1.0
        return records

    chosen = {"road": POSTS, "speed": SPEED, "duration": END}
    one, two = run(str(file), **chosen), run(programme, **chosen)
    assert one.history.rows.tobytes() == two.history.rows.tobytes()
    case = Case(vehicle=preset(), manoeuvre=load_commands(file), speed=SPEED, road=POSTS)
    outcome = outcome_of(case, history=True)
    assert outcome.history.rows.tobytes() == one.history.rows.tobytes()


def test_two_rows_of_one_time_are_a_step_of_the_posts():
    table = command_table({"time": [0, 0.2, 0.2, 1], "road_height_lf": [0, 0, 0.03, 0.03]})
    driven, held = on_posts(), on_posts()
    stepwise.run(driven, table, 0.4)
    held.step(Command(), 0.2)
    held.step(Command(road_height=(0.03, 0.0, 0.0, 0.0)), 0.2)
    assert driven.state_vector.tolist() == held.state_vector.tolist()


@pytest.mark.parametrize("name", ["road_height_rf", "road_friction_lr"])
def test_other_roads_refuse_the_columns_before_the_run(tmp_path, name):
    """Even where they say what the road is anyway."""
    neutral = 0 if name.startswith("road_height") else 1
    file = write(tmp_path, "c.csv", f"time,{name}\n0,{neutral}\n1,{neutral}\n")
    for other in (None, road(FEATURES["ramp"])):
        with refused(f"c.csv: column: {name!r}", "the road has no feature `commanded`"):
            run(str(file), road=other)
    outcome = outcome_of(Case(vehicle=preset(), manoeuvre=load_commands(file)))
    assert outcome.failure.startswith("refused: ")
    assert "no feature `commanded`" in outcome.failure


def test_values_that_no_road_has_are_refused_by_file_and_line(tmp_path):
    for name, value, said in (
        ("road_friction_lf", "-0.1", "a number from 0 to 10"),
        ("road_friction_rr", "11", "a number from 0 to 10"),
        ("road_height_lr", "1e9", "a number from -1000 to 1000 m"),
        ("road_height_lr", "high", "a finite number"),
    ):
        file = write(tmp_path, "c.csv", f"time,{name}\n0,0\n1,{value}\n")
        with refused(f"c.csv: line 3: {name}: ", said):
            load_commands(file)
    with refused("commands: road_friction_lf: -1", "from 0 to 10"):
        command_table({"time": [0, 1], "road_friction_lf": [1, -1]})
