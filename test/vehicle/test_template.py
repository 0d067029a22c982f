"""The template files: the reference vehicle, bit for bit, with a comment on every value."""

from vehicle_files import REFERENCE_TIR, refused, write

from vehicle_roll_sim import Simulation, Vehicle, load_tire, load_vehicle, preset
from vehicle_roll_sim.declaration import parameters_of
from vehicle_roll_sim.vehicle.template import tire_template, vehicle_template
from vehicle_roll_sim.vehicle.tire.keys import COEFFICIENTS, KEYS, REQUIRED

PARAMETERS = parameters_of(Vehicle)


def lines_of(text: str, mark: str) -> dict[str, str]:
    """The comment behind each key; `mark` begins it."""
    lines = [line.partition(f" {mark} ") for line in text.splitlines()]
    return {line.split()[0].strip(":"): comment for line, _, comment in lines if line.strip()}


def test_the_vehicle_file_is_the_reference_vehicle_to_the_bit(tmp_path):
    loaded = load_vehicle(write(tmp_path, "car.yaml", vehicle_template()))
    assert loaded == preset()
    assert loaded.record().tobytes() == preset().record().tobytes()


def test_the_tire_file_is_the_reference_tire_to_the_bit(tmp_path):
    tire = load_tire(write(tmp_path, "tire.tir", tire_template()))
    assert tire.coefficients == preset().tire.coefficients
    assert tire.record().tobytes() == preset().tire.record().tobytes()


def test_every_parameter_stands_there_with_unit_range_and_meaning():
    lines = vehicle_template().splitlines()
    for name, declared in PARAMETERS.items():
        line = next(line for line in lines if f"{name}:" in line)
        low_to_high = f"{declared.minimum:g} to {declared.maximum:g}"
        assert f"# {declared.unit or '-'}, {low_to_high}: {declared.description}" in line


def test_optional_parameters_stand_below_the_line_that_says_so(tmp_path):
    must, _, may = vehicle_template().partition("# These are optional")
    for name in ("drag_area", "minimum_relaxation_length", "rolling_resistance_coefficient"):
        assert f"\n{name}: " in may
    shortened = must + "tire: reference\n"
    loaded = load_vehicle(write(tmp_path, "car.yaml", shortened))
    assert loaded.record().tobytes() == preset().record().tobytes()
    assert (loaded.tire_moments, loaded.contact_patch_shift) == (True, True)


def test_every_coefficient_that_counts_has_its_meaning():
    comments = lines_of(tire_template(), "$")
    there = [key for key in COEFFICIENTS["5.2"] if key in comments]
    assert len(there) >= 90
    for key in there:
        comment = comments[key]
        assert comment.startswith(KEYS[key].meaning)
        assert ("required" in comment) == (key in REQUIRED)
        assert "not used" not in comment


def test_what_does_not_count_is_marked_so_and_changes_nothing(tmp_path):
    comments = lines_of(tire_template(), "$")
    unused = [key for key, comment in comments.items() if comment.endswith("not used")]
    assert {"RIM_RADIUS", "VERTICAL_DAMPING", "VXLOW", "FILE_TYPE"} <= set(unused)
    kept = [line for line in tire_template().splitlines() if line.split()[0] not in unused]
    tire = load_tire(write(tmp_path, "tire.tir", "\n".join(kept)))
    assert len(kept) < len(tire_template().splitlines())
    assert tire.coefficients == preset().tire.coefficients


def test_the_shipped_tire_needs_no_file_and_a_file_beside_is_another(tmp_path):
    text = vehicle_template()
    write(tmp_path, "mine.tir", REFERENCE_TIR.replace("= 1.685", "= 1.5"))
    named = text.replace("\ntire: reference\n", "\ntire: mine.tir\n")
    assert load_vehicle(write(tmp_path, "own.yaml", named)).tire.coefficients["PCX1"] == 1.5
    Simulation(load_vehicle(write(tmp_path, "car.yaml", text)))
    with refused("own.yaml", "a .tir file, or reference"):
        load_vehicle(write(tmp_path, "own.yaml", text.replace("\ntire: reference", "\ntire: 3")))
