"""Tire files: read correctly, or refused with one line."""

import pytest
from vehicle_files import REFERENCE_TIR, edited, line_of, refused, write

from vehicle_roll_sim import InputError, load_tire
from vehicle_roll_sim.files.text_file import LARGEST_FILE
from vehicle_roll_sim.vehicle.tire.keys import REQUIRED

PUBLISHED = {
    "FNOMIN": 4000.0,
    "PCX1": 1.685,
    "PDX1": 1.210,
    "PKX1": 21.51,
    "RBX1": 12.35,
    "PCY1": 1.193,
    "PDY1": -0.990,
    "PKY1": -14.95,
    "PKY2": 2.130,
    "RBY1": 6.461,
}
"""Coefficients from Pacejka (2002), table A3.1."""


@pytest.fixture
def tire_from(tmp_path):
    """Load a tire file with the given content."""
    return lambda content: load_tire(write(tmp_path, "some.tir", content))


@pytest.fixture
def path(tmp_path):
    return tmp_path / "some.tir"


def test_the_reference_tire_has_its_published_coefficients(tire_from):
    tire = tire_from(REFERENCE_TIR)
    assert {name: tire.coefficients[name] for name in PUBLISHED} == PUBLISHED
    assert tire.side == "left"
    assert tire.coefficients["LMUX"] == tire.coefficients["LMUY"] == 1.15
    assert [tire.coefficients[n] for n in ("LHX", "LHY", "LVX", "LVY", "LVYKA")] == [0.0] * 5


@pytest.mark.parametrize("line", ["PCX1 = 1.5 $ a comment", "PCX1 = 1.5 ! a comment", "pcx1=1.5"])
def test_comments_spaces_and_small_letters_do_not_change_a_value(tire_from, line):
    assert tire_from(edited(REFERENCE_TIR, "PCX1", line)).coefficients["PCX1"] == 1.5


@pytest.mark.parametrize("mark", ["$", "!"])
def test_a_line_that_is_a_comment_is_no_entry(tire_from, mark):
    tire = tire_from(edited(REFERENCE_TIR, "LMUX", f"{mark}LMUX = 0.3"))
    assert tire.coefficients["LMUX"] == 1.0  # a factor that is not given


@pytest.mark.parametrize("name", REQUIRED)
def test_a_coefficient_without_which_there_is_no_tire_may_not_be_missing(tire_from, path, name):
    with refused(path, name):
        tire_from(edited(REFERENCE_TIR, name, ""))


def test_all_that_is_missing_is_named_at_once(tire_from, path):
    with refused(path, *REQUIRED, "PROPERTY_FILE_FORMAT", "template --tire"):
        tire_from("[UNITS]\nLENGTH = 'meter'\n")


@pytest.mark.parametrize("value", ["many", "1,5", "", "nan", "inf", "1e999", "1.2.3", "1_4"])
def test_a_coefficient_that_is_no_finite_number_is_refused(tire_from, path, value):
    text = edited(REFERENCE_TIR, "PKY1", f"PKY1 = {value}")
    with refused(path, line_of(text, "PKY1"), "PKY1", repr(value)):
        tire_from(text)


@pytest.mark.parametrize(
    ("name", "value"),
    [("FNOMIN", -1), ("FNOMIN", 0), ("LFZO", 0), ("PCX1", 0), ("PCY1", 0), ("PKY2", 0)],
)
def test_a_number_that_the_formula_would_divide_by_is_not_zero(tire_from, path, name, value):
    text = edited(REFERENCE_TIR, name, f"{name} = {value}")
    with refused(path, line_of(text, name), name, f"{value:.1f} is not allowed"):
        tire_from(text)


@pytest.mark.parametrize(
    ("lowest", "highest", "value"),
    [("FZMIN", "FZMAX", 15_001), ("KPUMIN", "KPUMAX", 1.5), ("ALPMIN", "ALPMAX", 2)],
)
def test_a_range_that_ends_before_it_begins_is_refused(tire_from, path, lowest, highest, value):
    with refused(path, lowest, highest):
        tire_from(edited(REFERENCE_TIR, lowest, f"{lowest} = {value}"))


@pytest.mark.parametrize(
    "content",
    [
        pytest.param("", id="empty"),
        pytest.param("\n\n$ nothing but a comment\n", id="a comment"),
        pytest.param("FNOMIN = 4000\n", id="no section"),
        pytest.param("[UNITS]\n= 3\n", id="no key"),
        pytest.param(b"\x89PNG\r\n\x1a\n\x00\xff\xfe", id="binary"),
        pytest.param(b"\x00" * 1000, id="zeros"),
        pytest.param("$" * (LARGEST_FILE + 1), id="too large"),
        pytest.param("[A]\nx = 1\n[A]\n", id="a section twice"),
        pytest.param("sprung_mass: 1440.0\ntire: reference.tir\n", id="a vehicle file"),
    ],
)
def test_what_is_no_tire_file_is_refused_by_name(tire_from, path, content):
    with refused(path):
        tire_from(content)


def test_a_tire_file_that_is_not_there_is_refused_by_name(tmp_path):
    with refused(tmp_path / "none.tir"):
        load_tire(tmp_path / "none.tir")
    with refused(tmp_path):
        load_tire(tmp_path)  # a folder


def test_what_is_refused_can_be_told_from_other_errors():
    assert issubclass(InputError, ValueError)
