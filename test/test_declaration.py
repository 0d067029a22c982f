"""Declared whole numbers: their range holds, and what is no whole number is refused."""

import argparse
import dataclasses

import pytest

from vehicle_roll_sim import InputError, parameter
from vehicle_roll_sim.arguments import add_declared, declared_values
from vehicle_roll_sim.declaration import keep_validated, parameters_of

ALLOWED = "a whole number from 1 to 5"


@dataclasses.dataclass(frozen=True)
class Counted:
    count: int = parameter("number of blocks", "", 1, 5, default=4)

    def __post_init__(self):
        keep_validated(self)


@pytest.mark.parametrize("value", [1, 5, 3.0])
def test_a_whole_number_in_its_range_is_kept_as_one(value):
    kept = Counted(value).count
    assert (kept, type(kept)) == (value, int)


@pytest.mark.parametrize("value", [0, 6, 2.5, True, "3", None, float("nan"), float("inf"), 10**400])
def test_what_is_none_or_out_of_range_is_refused_in_one_line(value):
    with pytest.raises(InputError, match=rf"^count: .*: {ALLOWED}$"):
        Counted(value)
    assert parameters_of(Counted)["count"].allowed == ALLOWED


def test_it_is_an_option_of_the_command_line():
    parser = argparse.ArgumentParser()
    add_declared(parser, Counted, "counts")
    assert "(default 4)" in parser.format_help()
    assert declared_values(parser.parse_args(["--count", "2"]), Counted) == {"count": 2}
    for text in ("0", "1.5", "two"):
        with pytest.raises(InputError, match=rf"^--count: .*: {ALLOWED}$"):
            declared_values(parser.parse_args(["--count", text]), Counted)
