"""Numbers accepted from Python callers, and refusals in one line that names the field."""

import dataclasses
import math

import numpy as np
import pytest

from vehicle_roll_sim import Command, InputError, Options, Simulation, Vehicle, preset
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.simulation.command import held_command
from vehicle_roll_sim.simulation.road import Road

NUMBERS = {
    "float32": np.float32(0.5),
    "float64": np.float64(0.5),
    "integer": np.int64(0),
    "array of no dimensions": np.array(0.5),
}
NO_NUMBERS = {"bool": True, "numpy bool": np.True_, "text": "0.5", "list": [0.5], "none": None}
WHEEL_FIELDS = ("wheel_torque", "brake_torque", "normal_force")
NOT_FOUR = {
    "a number": 100.0,
    "one": (100.0,),
    "two": [1.0, 2.0],
    "five": np.ones(5),
    "two dimensions": np.ones((4, 1)),
    "text": "abcd",
    "bytes": b"abcd",
    "none": None,
    "a mapping": {1: 1.0, 2: 1.0, 3: 1.0, 4: 1.0},
}
VEHICLE = preset()
TAKING = {
    "step": lambda value: Simulation(VEHICLE, step=value),
    "rollover_angle": lambda value: Simulation(VEHICLE, rollover_angle=value),
    "speed": lambda value: Simulation(VEHICLE).reset(value),
    "duration": lambda value: Simulation(VEHICLE).step(Command(), value),
    "drag_area": lambda value: VEHICLE.with_values({"drag_area": value}),
    "grade": lambda value: Road(grade=value),
    "start": lambda value: dataclasses.replace(STANDARD["j_turn"], start=value),
    "steering": lambda value: Command(steering=value),
    "normal_force": lambda value: Command(normal_force=(0.0, 0.0, value, 0.0)),
}


@pytest.mark.parametrize("field", TAKING)
@pytest.mark.parametrize("value", NO_NUMBERS.values(), ids=NO_NUMBERS)
def test_what_is_no_number_is_refused_in_one_line(field, value):
    with pytest.raises(InputError) as refusal:
        TAKING[field](value)
    assert refusal.value.field == field
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("value", NUMBERS.values(), ids=NUMBERS)
def test_numbers_of_numpy_are_numbers_and_kept_as_floats(value):
    command = Command(steering=value, wheel_torque=np.full(4, value))
    vehicle = VEHICLE.with_values({"drag_area": value})
    manoeuvre = dataclasses.replace(STANDARD["j_turn"], start=value)
    for kept in (command.steering, vehicle.drag_area, Road(grade=value).grade, manoeuvre.start):
        assert type(kept) is float
        assert kept == float(value)
    assert command == Command(steering=float(value), wheel_torque=(float(value),) * 4)
    assert hash(command) == hash(Command(steering=float(value), wheel_torque=[float(value)] * 4))


@pytest.mark.parametrize("kind", [np.float32, np.float64, np.int64])
def test_a_simulation_takes_numbers_of_numpy(kind):
    simulation = Simulation(VEHICLE, step=np.float64(0.001), rollover_angle=np.float32(1.0))
    simulation.reset(kind(20))
    simulation.step(Command(), kind(1))
    assert simulation.time == 1.0


def test_an_integer_beyond_all_floats_is_refused():
    with pytest.raises(InputError, match="sprung_mass"):
        VEHICLE.with_values({"sprung_mass": 10**400})


@pytest.mark.parametrize("field", WHEEL_FIELDS)
@pytest.mark.parametrize("value", NOT_FOUR.values(), ids=NOT_FOUR)
def test_wheels_want_four_numbers(field, value):
    with pytest.raises(InputError, match="four numbers, for lf, rf, lr and rr") as refusal:
        Command(**{field: value})
    assert refusal.value.field == field


@pytest.mark.parametrize("field", WHEEL_FIELDS)
@pytest.mark.parametrize("wrong", [math.nan, math.inf, "x", None, True])
def test_a_wheel_that_gets_no_finite_number_is_named(field, wrong):
    with pytest.raises(InputError) as refusal:
        Command(**{field: (0.0, wrong, 0.0, 0.0)})
    assert refusal.value.field == field


def test_floats_are_kept_as_they_are_even_where_their_sum_is_none():
    """As is most often: a tuple of finite floats is not made anew, and is one if its sum is."""
    usual, huge = (1.0, -2.0, 0.5, 0.0), (1e308,) * 4
    assert Command(wheel_torque=usual).wheel_torque is usual
    assert Command(wheel_torque=huge).wheel_torque == huge
    for wrong in ((math.inf, -math.inf, 0.0, 0.0), (1e308, 1e308, math.nan, 0.0)):
        with pytest.raises(InputError, match="a finite number"):
            Command(wheel_torque=wrong)


def test_a_held_command_has_the_torque_of_the_speed_hold_and_leaves_the_record():
    given = {"wheel_torque": (1.0, 2.0, 3.0, 4.0), "wind": (5.0, 6.0)}
    records = Command(0.1, 0.2, **given, speed_hold_gain=10.0, speed_hold_target=7.0).records()
    before = records.copy()
    held = held_command(records[0], np.float64(6.5))
    assert held == Command(0.1, 0.2, (1.0, 2.0, 8.0, 9.0), wind=(5.0, 6.0))
    assert records == before


@pytest.mark.parametrize("sequence", [list, tuple, np.array])
def test_four_numbers_may_come_in_any_sequence(sequence):
    command = Command(brake_torque=sequence([1, 2, 3, 4]))
    assert command.brake_torque == (1.0, 2.0, 3.0, 4.0)
    assert command.records()["brake_torque"].tolist() == [[1.0, 2.0, 3.0, 4.0]]


NO_COMMANDS = {
    "number": 0.1,
    "none": None,
    "a function that gives nothing": lambda times: None,
    "a list": lambda times: [0.0] * len(times),
    "a Command for all times": lambda times: Command(),
    "too few": lambda times: np.zeros(2, COMMAND),
    "floats": lambda times: np.zeros(len(times)),
}


@pytest.mark.parametrize("command", NO_COMMANDS.values(), ids=NO_COMMANDS)
def test_what_is_no_command_is_refused_and_nothing_moves(command):
    simulation = Simulation(VEHICLE)
    with pytest.raises(InputError) as refusal:
        simulation.step(command, 0.1)
    assert refusal.value.field == "command"
    assert simulation.time == 0.0


@pytest.mark.parametrize(
    ("field", "build"),
    [
        ("vehicle", lambda: Simulation("car.yaml")),
        ("options", lambda: Simulation(VEHICLE, "8dof")),
        ("road", lambda: Simulation(VEHICLE, road=0.1)),
        ("tire", lambda: dataclasses.replace(VEHICLE, tire="tire.tir")),
        ("model", lambda: Options(model=9)),
        ("euler_terms", lambda: Options(euler_terms="yes")),
    ],
)
def test_an_argument_of_another_kind_is_refused(field, build):
    with pytest.raises(InputError) as refusal:
        build()
    assert refusal.value.field == field


def test_flags_of_numpy_are_flags():
    assert Options(euler_terms=np.True_).euler_terms is True


def test_a_vehicle_is_told_by_name_in_its_refusals():
    values = {field.name: getattr(VEHICLE, field.name) for field in dataclasses.fields(VEHICLE)}
    with pytest.raises(InputError, match="wheel_inertia"):
        Vehicle(**values | {"wheel_inertia": "1"})


@pytest.mark.parametrize(
    ("field", "build"),
    [
        ("coefficient", lambda: VEHICLE.tire.with_coefficients(PDY9=1.0)),
        ("PDY1", lambda: VEHICLE.tire.with_coefficients(PDY1="1")),
        ("PDY1", lambda: VEHICLE.tire.with_coefficients(PDY1=True)),
        ("side", lambda: dataclasses.replace(VEHICLE.tire, side="middle")),
        ("brake_torque", lambda: Simulation(VEHICLE).step(braked(math.nan), 0.01)),
        ("brake_torque", lambda: Simulation(VEHICLE).step(braked(-1.0), 0.01)),
        ("brake_torque", lambda: Simulation(VEHICLE).step(braked(math.inf), 0.01)),
    ],
)
def test_of_tires_and_brakes_nothing_wrong_is_taken_in_silence(field, build):
    with pytest.raises(InputError) as refusal:
        build()
    assert refusal.value.field == field


def braked(torque: float):
    """A programme with this brake torque at a wheel, in the last of its records."""

    def programme(times: np.ndarray) -> np.ndarray:
        commands = np.zeros(len(times), COMMAND)
        commands["brake_torque"][-1, 2] = torque
        return commands

    return programme


def test_coefficients_of_numpy_are_kept_as_floats():
    tire = VEHICLE.tire.with_coefficients(PDY1=np.float32(0.5))
    assert type(tire.coefficients["PDY1"]) is float
