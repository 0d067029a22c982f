"""Unusual files, and values that trip a parser: read correctly, or refused."""

import pytest
from vehicle_files import REFERENCE_TIR, REFERENCE_YAML, edited, line_of, refused, write

from vehicle_roll_sim import InputError, load_tire, load_vehicle


@pytest.fixture
def tire_of(tmp_path):
    return lambda text: load_tire(write(tmp_path, "a.tir", text)).coefficients


@pytest.mark.parametrize(
    "added",
    [
        "[SHAPE]\n{radial width}\n 1.0 0.0\n 1.0 0.4\n 1.0 0.4\n 0.9 1.0\n",
        "[INERTIA]\nMASS = 9.3\nIXX = 0.391\n",
        "[MODEL_2]\nTIME = 'never'\n",
    ],
    ids=["a table", "a mass that is no unit", "a time that is no unit"],
)
def test_sections_that_say_nothing_of_the_formula_change_nothing(tire_of, added):
    assert tire_of(REFERENCE_TIR + added) == tire_of(REFERENCE_TIR)


def test_a_byte_order_mark_is_passed_over(tire_of):
    assert tire_of("\ufeff" + REFERENCE_TIR) == tire_of(REFERENCE_TIR)


@pytest.mark.parametrize("load", [load_tire, load_vehicle])
def test_what_never_ends_is_refused(load):
    with refused("/dev/zero", "at most 1000000 bytes"):
        load("/dev/zero")


def test_a_comment_may_touch_the_value(tire_of):
    assert tire_of(edited(REFERENCE_TIR, "PCX1", "PCX1 = 1.5$comment"))["PCX1"] == 1.5


def test_a_coefficient_in_two_sections_is_refused(tire_of):
    text = REFERENCE_TIR + "[SECOND]\nPCX1 = 1.7\n"
    with refused(line_of(text, "PCX1"), "PCX1", "[SECOND]", "twice"):
        tire_of(text)


@pytest.mark.parametrize("line", ["KPUMIN = nan", "FNOMIN = 1e308"])
def test_a_number_that_is_none_or_grows_out_of_range_is_refused(tire_of, line):
    name = line.split()[0]
    in_kilonewtons = edited(REFERENCE_TIR, "FORCE", "FORCE = 'kN'")
    with refused(name):
        tire_of(edited(in_kilonewtons, name, line))


def test_a_line_of_no_kind_is_refused_by_its_number(tire_of):
    with refused("line 1", "what is this"):
        tire_of("what is this\n" + REFERENCE_TIR)


ODD_VALUES = [
    "9" * 400,
    "9" * 5000,
    "2020-13-45",
    "0b_",
    "!!int abc",
    "!!float abc",
    "!!bool abc",
    "!!map abc",
    "!!timestamp abc",
    "\x01",
    r'"\UFFFFFFFF"',
    "!!python/object/apply:os.getcwd []",
]


@pytest.mark.parametrize("value", ODD_VALUES, ids=lambda value: value[:20])
def test_a_value_that_trips_the_parser_is_refused_in_one_line(tmp_path, value):
    text = edited(REFERENCE_YAML, "sprung_mass", f"sprung_mass: {value}")
    with refused("a.yaml", line_of(text, "sprung_mass")):
        load_vehicle(write(tmp_path, "a.yaml", text))


@pytest.mark.parametrize("value", ["01440", "0x5a0", "0b1", "24:00", "20:30.5", "1_440", "1_0.5"])
def test_a_number_that_is_no_decimal_one_is_refused(tmp_path, value):
    """YAML 1.1 takes 01440 for 800 and 24:00 for 1440."""
    text = edited(REFERENCE_YAML, "sprung_mass", f"sprung_mass: {value}")
    with refused("a.yaml", f"{value} is not a decimal number", line_of(text, "sprung_mass")):
        load_vehicle(write(tmp_path, "a.yaml", text))


@pytest.mark.parametrize("value", ["1440", "1440.", "+1440.0", "1.44e3", "1.44E+3", "144e1"])
def test_a_decimal_number_may_be_written_in_any_way(tmp_path, value):
    text = edited(REFERENCE_YAML, "sprung_mass", f"sprung_mass: {value}")
    write(tmp_path, "reference.tir", REFERENCE_TIR)
    assert load_vehicle(write(tmp_path, "a.yaml", text)).sprung_mass == 1440.0


def test_a_tire_name_that_no_file_can_have_is_refused(tmp_path):
    text = edited(REFERENCE_YAML, "tire", r'tire: "a\0b"')
    with refused("null"):
        load_vehicle(write(tmp_path, "a.yaml", text))


NESTED = "".join(f", &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 6))
SMALL_FILES_OF_MUCH = {
    "nested aliases": f"sprung_mass: [&a0 [{', '.join('1' * 10)}]{NESTED}]\n",
    "merged keys": "a: &b0 {x: 1}\n"
    + "".join(f"b{n}: &b{n} {{<<: [*b{n - 1}, *b{n - 1}]}}\n" for n in range(1, 16)),
    "a merge of itself": "sprung_mass: 1\n<<: {roll_inertia: 1}\n",
    "a number in parts of 60": "sprung_mass: 1" + ":1" * 30_000,
}


@pytest.mark.parametrize("case", SMALL_FILES_OF_MUCH)
def test_a_small_file_that_would_take_much_time_or_memory_is_refused_by_its_line(tmp_path, case):
    """Of more levels none would end: each has ten times, or twice, what the one before has."""
    line = {"merged keys": 2, "a merge of itself": 2}.get(case, 1)
    with refused("a.yaml", f"in line {line}:"):
        load_vehicle(write(tmp_path, "a.yaml", SMALL_FILES_OF_MUCH[case]))


class Counted:
    """Something that counts how often it is written out."""

    times = 0

    def __repr__(self):
        Counted.times += 1
        return "something"


def test_of_a_large_value_no_more_is_written_out_than_is_shown():
    value = Counted()
    for _ in range(5):
        value = [value] * 10
    for wrong in (value, {"a": value}, (value,), [Counted()] * 100_000, "x" * 10**6, 16**5000):
        assert len(str(InputError("name", wrong, "a number"))) < 120
    assert Counted.times < 100
    assert "[1, 'a', {'b': None}] is not" in str(InputError("name", [1, "a", {"b": None}], ""))
