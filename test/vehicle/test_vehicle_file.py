"""Vehicle files: every invalid value of every parameter is refused in one line that names it."""

from dataclasses import MISSING

import pytest
from bodies import BOX
from vehicle_files import REFERENCE_TIR, REFERENCE_YAML, edited, line_of, refused, write

from vehicle_roll_sim import Vehicle, load_tire, load_vehicle, preset
from vehicle_roll_sim.declaration import parameters_of
from vehicle_roll_sim.files.text_file import LARGEST_FILE
from vehicle_roll_sim.vehicle.actuator_parameters import OF_ACTUATORS
from vehicle_roll_sim.vehicle.sensor_parameters import OF_DEVICE, SEED

SOURCE = {
    "sprung_mass": 1440.0,
    "roll_inertia": 900.0,
    "pitch_inertia": 2000.0,
    "yaw_inertia": 2000.0,
    "cg_to_front_axle": 1.016,
    "cg_to_rear_axle": 1.524,
    "cg_height": 0.75,
    "front_track": 1.5,
    "rear_track": 1.5,
    "front_spring_stiffness": 35_000.0,
    "rear_spring_stiffness": 30_000.0,
    "front_damping": 2500.0,
    "rear_damping": 2000.0,
    "front_unsprung_mass": 80.0,
    "rear_unsprung_mass": 80.0,
    "front_tire_stiffness": 200_000.0,
    "rear_tire_stiffness": 200_000.0,
    "tire_radius": 0.285,
    "wheel_inertia": 1.0,
    "front_roll_centre_depth": 0.65,
    "rear_roll_centre_depth": 0.60,
}
"""The table of Shim and Ghike (2007)."""
PARAMETERS = parameters_of(Vehicle)
OPTIONAL = {
    "minimum_relaxation_length": 0.1,
    "rolling_resistance_coefficient": 0.0,
    "drag_area": 0.0,
    "front_camber": 0.0,
    "rear_camber": 0.0,
}
"""What a vehicle file may leave out, and what counts then: the source has none of them."""
HEIGHTS = {"front_roll_centre_height": 0.1, "rear_roll_centre_height": 0.15}
"""What a vehicle file may have in place of the depths."""
OF_TIRE_FILE = ("front_tire_stiffness", "rear_tire_stiffness", "tire_radius")
"""What the reference file has, and would take from its tire file otherwise."""
STOPS = {
    f"{stop}_stop_{name}": value
    for stop in ("bump", "rebound")
    for name, value in (("clearance", 0.06), ("stiffness", 5e4), ("progression", 1e6))
}
DETAILS = {
    "rebound_damping": 3000.0,
    "spring_motion_ratio": 0.8,
    "damper_motion_ratio": 0.7,
    **STOPS,
    "toe": 0.002,
    "roll_steer": -0.05,
    "lateral_force_steer": -1e-6,
    "aligning_moment_steer": 1e-5,
    "lateral_force_camber": 1e-6,
}
"""Of each axle."""
ACTUATOR = {
    "time_constant": 0.1,
    "frequency": 8.0,
    "damping": 0.7,
    "dead_time": 0.02,
    "rate_limit": 1.0,
    "range": 0.9,
    "resolution": 0.001,
}
ABSENT = {
    "front_tire_radius": 0.3,
    "rear_tire_radius": 0.31,
    "tire_pressure": 2.2e5,
    "front_tire_pressure": 2.3e5,
    "rear_tire_pressure": 2.4e5,
    "front_tire_progression": 3.0,
    "rear_tire_progression": 4.0,
    "front_tire_lateral_stiffness": 1.2e5,
    "rear_tire_lateral_stiffness": 1.3e5,
    "front_anti_roll_bar_stiffness": 2e4,
    "front_anti_roll_bar_rate": 9e3,
    "rear_anti_roll_bar_stiffness": 1e4,
    "rear_anti_roll_bar_rate": 5e3,
    "front_half_track_change": 0.2,
    "front_longitudinal_change": -0.05,
    "front_camber_change": -0.4,
    "front_toe_change": 0.1,
    "front_carrier_pitch_change": 0.3,
    "rear_half_track_change": 0.3,
    "rear_longitudinal_change": 0.1,
    "rear_camber_change": -0.5,
    "rear_toe_change": 0.05,
    "rear_carrier_pitch_change": -0.2,
    **{f"{axle}_{name}": value for axle in ("front", "rear") for name, value in DETAILS.items()},
    "ackermann_percentage": 70.0,
    "engine_drag": 2.0,
    "cg_offset": 0.05,
    "total_cg_offset": 0.05,
    "roll_yaw_product": 40.0,
    "total_roll_yaw_product": 40.0,
    "roll_pitch_product": 20.0,
    "pitch_yaw_product": 10.0,
    "air_density": 1.1,
    "side_force_area": 4.0,
    "pressure_centre_ahead": 0.3,
    "pressure_centre_height": -0.1,
    "front_lift_area": 0.2,
    "rear_lift_area": -0.1,
    "front_drive_share": 0.4,
    "front_brake_share": 0.7,
    "front_differential_damping": 20.0,
    "rear_differential_damping": 50.0,
    "front_differential_preload": 40.0,
    "rear_differential_preload": 60.0,
    "front_differential_locking": 0.2,
    "rear_differential_locking": 0.4,
    **BOX,
    **{name: ACTUATOR[name.partition("_actuator_")[-1]] for name in OF_ACTUATORS},
    **{name: 0.01 for names in OF_DEVICE.values() for name in names},
    SEED: 100.0,
}
"""What the reference vehicle does not have."""
TABLES = {"steering_gear": ("steering_ratio", "[[0, 0], [1, 0.1], [6, 0.5]]")} | {
    f"{axle}_{name}": (f"{axle}_{other}", table)
    for axle in ("front", "rear")
    for name, other, table in (
        ("spring_force", "spring_stiffness", "[[0, 0], [0.2, 6000]]"),
        ("damper_force", "damping", "[[-1, -3000], [0, 0], [1, 1500]]"),
    )
}
"""What a vehicle file may have in place of numbers."""
TOTALS = {
    "total_mass": 1760.0,
    "total_roll_inertia": 1142.0,
    "total_pitch_inertia": 2595.0,
    "total_yaw_inertia": 2713.0,
    "total_cg_to_front_axle": 1.062,
    "total_cg_to_rear_axle": 1.478,
    "total_cg_height": 0.66,
}
"""What a vehicle file may have in place of the sprung mass's."""
WHOLE_YAML = REFERENCE_YAML + "".join(f"{name}: {value}\n" for name, value in OPTIONAL.items())
"""A file that leaves nothing out."""


def of_sprung_mass(name: str) -> str:
    """The parameter in whose place that of the whole vehicle stands."""
    return "sprung_mass" if name == "total_mass" else name.removeprefix("total_")


def needed_by(name: str) -> list[str]:
    """Parameters without which this one is refused."""
    if name.startswith("pressure_centre"):
        return ["side_force_area"]
    if name == SEED:
        return ["imu_x"]
    if name.endswith("_actuator_damping"):
        return [name.replace("damping", "frequency")]
    axle, _, of = name.partition("_differential_")
    needed = {"preload": ["damping"], "locking": ["damping", "preload"]}.get(of, [])
    return [f"{axle}_differential_{each}" for each in needed]


def whole_with(name: str) -> str:
    """A file that leaves nothing out, with the parameter of that name."""
    if name in TOTALS:
        text = WHOLE_YAML
        for each in TOTALS if "axle" in name else [name]:
            if each == name or "axle" in each:
                text = edited(text, of_sprung_mass(each), f"{each}: {TOTALS[each]}")
        return text
    if name in TABLES:
        other, table = TABLES[name]
        return edited(WHOLE_YAML, other, f"{name}: {table}")
    if "_stop_" in name:
        axle = name.partition("_")[0]
        return WHOLE_YAML + "".join(f"{axle}_{of}: {value}\n" for of, value in STOPS.items())
    if name in ABSENT:
        text = "".join(f"{each}: {ABSENT[each]}\n" for each in (*needed_by(name), name))
        text = WHOLE_YAML + text
        return edited(text, "tire_radius", "") if "_tire_radius" in name else text
    if name not in HEIGHTS:
        return WHOLE_YAML
    return edited(WHOLE_YAML, name.replace("height", "depth"), f"{name}: {HEIGHTS[name]}")


REQUIRED = [*(n for n in PARAMETERS if n not in {*OPTIONAL, *ABSENT, *OF_TIRE_FILE}), "tire"]
"""With the alternatives of some of them."""


def beyond(limit: float, direction: float) -> float:
    """The next number beyond a limit that a decimal shows."""
    return limit + direction * max(abs(limit), 1.0) * 1e-6


DECLARED = [
    name
    for name in PARAMETERS
    if name.removeprefix("rear_") not in DETAILS  # declared with that of the front axle
    and (name not in OF_ACTUATORS or name.startswith("steering_"))  # likewise
]


def wrong_values(name: str) -> list[str]:
    """What a file may not have as the value of a parameter."""
    declared = PARAMETERS[name]
    return [
        *(".nan", ".inf", "-.inf", "many", "'1440'", "true", "[1, 2]", "{a: 1}", "", "1e99"),
        repr(beyond(declared.minimum, -1.0)),
        repr(beyond(declared.maximum, 1.0)),
    ]


@pytest.fixture
def vehicle_from(tmp_path):
    """Loads a vehicle file with that content, the reference tire beside it."""
    write(tmp_path, "reference.tir", REFERENCE_TIR)
    return lambda content: load_vehicle(write(tmp_path, "some.yaml", content))


@pytest.fixture
def path(tmp_path):
    return tmp_path / "some.yaml"


def assert_refused(load, path, name: str, value: str) -> None:
    """A file is refused, in the line of the parameter, that has this value of it."""
    text = edited(whole_with(name), name, f"{name}: {value}")
    with refused(path, line_of(text, name), name):
        load(text)


def test_the_reference_vehicle_is_that_of_the_source():
    vehicle = preset("reference")
    assert {name: getattr(vehicle, name) for name in SOURCE} == SOURCE
    assert {*PARAMETERS} - {*SOURCE} == {
        *("steering_ratio", *OPTIONAL, *HEIGHTS, *TABLES, *TOTALS, *ABSENT)
    }


def test_what_the_source_does_not_have_is_optional_and_nothing_else_is(vehicle_from):
    optional = {
        name: p.default for name, p in PARAMETERS.items() if p.default not in (MISSING, None)
    }
    assert optional == OPTIONAL
    named, unnamed = vehicle_from(WHOLE_YAML), vehicle_from(REFERENCE_YAML)
    for name, value in OPTIONAL.items():
        assert name not in REFERENCE_YAML
        assert getattr(named, name) == getattr(unnamed, name) == value


def test_every_value_of_the_file_arrives_under_its_name(vehicle_from):
    for name in (n for n in PARAMETERS if "pressure" not in n and n not in TABLES):
        value = (preset("reference").given | HEIGHTS | TOTALS | ABSENT)[name] * 1.01 or 0.5
        loaded = vehicle_from(edited(whole_with(name), name, f"{name}: {value!r}"))
        assert getattr(loaded, name) == value, name
        assert type(getattr(loaded, name)) is float, name


@pytest.mark.parametrize("name", DECLARED)
def test_a_value_that_is_not_allowed_is_refused(vehicle_from, path, name):
    for value in wrong_values(name):
        assert_refused(vehicle_from, path, name, value)


def test_zero_is_refused_where_nothing_is_not_allowed(vehicle_from, path):
    for name in (n for n, p in PARAMETERS.items() if p.minimum > 0):
        assert_refused(vehicle_from, path, name, "0")


@pytest.mark.parametrize("name", [n for n in REQUIRED if n not in {*HEIGHTS, *TABLES, *TOTALS}])
def test_a_missing_key_is_named(vehicle_from, path, name):
    with refused(path, name):
        vehicle_from(edited(REFERENCE_YAML, name, ""))


def test_all_that_is_missing_is_named_at_once(vehicle_from, path):
    missing = [name for name in REQUIRED if name not in ("sprung_mass", "total_mass", "tire")]
    with refused(path, *missing, "tire: missing", "vehicle_roll_sim template"):
        vehicle_from("sprung_mass: 1440\n")


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("none.tir", ("No such file or directory", "the name of an existing file")),
        (".", ("Is a directory", "the name of a file, not of a folder")),
        ("a.tir/b.tir", ("Not a directory", "the name of an existing file")),
    ],
)
def test_what_cannot_be_read_says_what_the_name_should_be(tmp_path, name, words):
    write(tmp_path, "a.tir", REFERENCE_TIR)
    for load in (load_vehicle, load_tire):
        with refused(tmp_path / name, *words):
            load(tmp_path / name)


def test_a_key_that_stands_twice_is_named(vehicle_from, path):
    for name in (*PARAMETERS, "tire"):
        text = whole_with(name) + f"{name}: 1.0\n"
        with refused(path, line_of(text, name), name):
            vehicle_from(text)


@pytest.mark.parametrize(
    ("text", "value"), [("35000", 35e3), ("35e3", 35e3), ("35E3", 35e3), ("+3.5e+4", 35e3)]
)
def test_whole_numbers_and_powers_of_ten_are_numbers(vehicle_from, text, value):
    line = f"front_spring_stiffness: {text}"
    loaded = vehicle_from(edited(REFERENCE_YAML, "front_spring_stiffness", line))
    assert loaded.front_spring_stiffness == value


def test_a_misspelt_key_is_named_with_the_one_that_was_meant(vehicle_from, path):
    text = REFERENCE_YAML + "sprung_mas: 1000.0\n"
    with refused(path, line_of(text, "sprung_mas:"), "sprung_mas", "sprung_mass"):
        vehicle_from(text)


def test_a_misspelt_name_among_replaced_values_is_named_with_the_one_that_was_meant():
    with refused("rol_inertia", "roll_inertia"):
        preset().with_values({"rol_inertia": 900.0})
    with refused("colour", *PARAMETERS):  # nothing is near: all are listed
        preset().with_values({"colour": 1.0})


def test_replacing_values_leaves_the_others_and_the_old_vehicle_as_they_are():
    old = preset()
    new = old.with_values({"front_track": 1.6, "rear_damping": 0})
    assert (new.front_track, new.rear_damping, old.front_track) == (1.6, 0.0, 1.5)
    assert new.with_values({"front_track": 1.5, "rear_damping": 2000.0}) == old


@pytest.mark.parametrize("name", ["roll_inertia", "pitch_inertia", "yaw_inertia"])
def test_moments_of_inertia_that_no_body_has_are_refused(vehicle_from, path, name):
    others = sum(SOURCE[n] for n in SOURCE if n.endswith("_inertia") and n != "wheel_inertia")
    limit = others - SOURCE[name]
    vehicle_from(edited(REFERENCE_YAML, name, f"{name}: {limit}"))  # a flat body
    text = edited(REFERENCE_YAML, name, f"{name}: {limit + 0.1}")
    with refused(path, line_of(text, name), name):
        vehicle_from(text)


@pytest.mark.parametrize(
    ("name", "value"),
    [("tire_radius", 0.02), ("rear_tire_stiffness", 10_000.0)],
)
def test_a_vehicle_that_does_not_stand_on_its_wheels_is_refused(vehicle_from, path, name, value):
    with refused(path):
        vehicle_from(edited(REFERENCE_YAML, name, f"{name}: {value}"))


@pytest.mark.parametrize("given", ["3", "", "[a.tir]", "true"])
def test_a_tire_that_is_no_name_of_a_file_is_refused(vehicle_from, path, given):
    text = edited(REFERENCE_YAML, "tire", f"tire: {given}")
    with refused(path, line_of(text, "tire:"), "tire"):
        vehicle_from(text)


def test_a_tire_file_that_is_missing_or_wrong_is_named(vehicle_from, tmp_path):
    missing = edited(REFERENCE_YAML, "tire", "tire: none.tir")
    said = (line_of(missing, "tire:"), "tire", "does not exist", "relative to the vehicle file")
    with refused(tmp_path / "some.yaml", tmp_path / "none.tir", *said):
        vehicle_from(missing)
    with refused(tmp_path / "some.yaml"):  # itself
        vehicle_from(edited(REFERENCE_YAML, "tire", "tire: some.yaml"))


@pytest.mark.parametrize(
    "content",
    [
        pytest.param("", id="empty"),
        pytest.param("- 1\n- 2\n", id="list"),
        pytest.param("a: b: c\n", id="not YAML"),
        pytest.param("a: [1, 2\n", id="unclosed"),
        pytest.param("1: 2\n", id="number for a name"),
        pytest.param("? [a]\n: 1\n", id="list for a name"),
        pytest.param("a: !!python/object:os.system x\n", id="code"),
        pytest.param("a: *nothing\n", id="unknown alias"),
        pytest.param("{}\n---\n{}\n", id="two documents"),
        pytest.param(b"\xff\xfe\x00\x01", id="binary"),
        pytest.param(b"\x00" * 100, id="zeros"),
        pytest.param("# " + "x" * LARGEST_FILE, id="too large"),
        pytest.param(REFERENCE_TIR, id="a tire file"),
    ],
)
def test_what_is_no_vehicle_file_is_refused_by_name(vehicle_from, path, content):
    with refused(path):
        vehicle_from(content)


def test_a_vehicle_file_that_is_not_there_is_refused_by_name(tmp_path):
    with refused(tmp_path / "none.yaml"):
        load_vehicle(tmp_path / "none.yaml")


@pytest.mark.parametrize("axle", ["front", "rear"])
def test_springs_that_its_weight_compresses_out_of_all_bounds_are_refused(axle):
    name, load = f"{axle}_spring_stiffness", 9.81 * 1440.0 * {"front": 0.3, "rear": 0.2}[axle]
    softest = load / 100.0  # N/m: a state of more than 100 m is divergence
    preset().with_values({name: softest * (1 + 1e-9)})
    with refused(name, "to carry the sprung mass"):
        preset().with_values({name: softest * (1 - 1e-9)})
