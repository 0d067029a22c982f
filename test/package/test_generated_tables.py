"""Tables in the documentation agree with the declarations, and the claims as measured."""

import importlib
import re

import pytest

from vehicle_roll_sim.paper.report import CLAIMS, as_markdown, check_claims

pytestmark = pytest.mark.unmeasured

SHOWN = 0.01
"""Relative tolerance: numbers are rounded to three digits."""
ROUNDING_ERRORS = 22
"""The claim whose numbers are rounding errors, which differ from machine to machine."""
MEASURED = re.compile(r"(?P<name>.+): (?P<value>\S+)( (?P<unit>[^\s(]+))?( \((?P<criterion>.+)\))?")


def rows_of(text: str, header: str) -> dict[int, list[str]]:
    """Cells of the rows of the table with this header, by the number in the first cell."""
    table = text.partition(f"{header}\n")[2].partition("\n\n")[0]
    rows = [line.strip("| ").split(" | ") for line in table.splitlines()[1:]]
    return {int(row[0]): row for row in rows}


@pytest.fixture(scope="module")
def tables(root):
    """The module that makes the tables of topics, services and parameters."""
    pytest.importorskip("rclpy", reason="what the node declares needs ROS 2")
    pytest.importorskip("gymnasium", reason="what its environment declares needs gymnasium")
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(root / "docs" / "_extensions")
        return importlib.import_module("tables")


@pytest.fixture(scope="module")
def pages(root) -> dict[str, str]:
    """Every page of docs/, by its path from there."""
    docs = root / "docs"
    return {
        path.relative_to(docs).as_posix(): path.read_text(encoding="utf-8")
        for path in docs.glob("**/*.md")
    }


def test_every_table_of_declarations_is_on_one_page_and_up_to_date(tables, pages):
    """`make tables` writes them."""
    shown = [found["name"] for text in pages.values() for found in tables.MARKED.finditer(text)]
    assert sorted(shown) == sorted(tables.TABLES)
    for page, text in pages.items():
        assert text == tables.up_to_date(text), page


def test_they_have_every_parameter_of_the_simulator(tables, pages):
    from vehicle_roll_sim.ros.simulator import parameters as declared

    shown = pages["reference/node.md"] + pages["parameters.md"]
    of_files = {*declared.TIRE_PARAMETERS, declared.VEHICLE_PREFIX + declared.LONGITUDINAL}
    for name in of_files:  # in the text above the table
        assert f"`{name}`" in shown
    for name in declared.PARAMETERS.keys() - of_files:
        assert f"| `{name.removeprefix(declared.VEHICLE_PREFIX)}` |" in shown


def test_a_table_that_is_not_up_to_date_is_replaced_and_nothing_else(tables):
    text = "before\n\n<!-- table: services -->\n| name |\n| --- |\n| x |\n\nafter\n"
    expected = text.replace("| name |\n| --- |\n| x |", tables.service_table())
    assert tables.up_to_date(text) == expected != text


@pytest.fixture(scope="module")
def claims(root, study) -> dict[int, tuple[list[str], list[str]]]:
    """Each claim's row in docs/claims.md and in the table that the program writes."""
    if not study.has_engine:
        pytest.skip("the multibody engine is not installed")
    written = as_markdown(check_claims(study))
    header = written.splitlines()[0]
    shown = rows_of((root / "docs" / "claims.md").read_text(encoding="utf-8"), header)
    found = rows_of(written, header)
    assert list(shown) == list(found) == [claim.number for claim in CLAIMS]
    return {number: (shown[number], found[number]) for number in found}


def test_the_page_has_every_claim_with_place_text_and_verdict(claims):
    for shown, found in claims.values():
        assert len(shown) == len(found) == 5
        assert (shown[:3], shown[4]) == (found[:3], found[4])


@pytest.mark.parametrize("number", [claim.number for claim in CLAIMS])
def test_its_numbers_and_criteria_are_those_that_are_measured(claims, number):
    shown, found = (row[3].split("; ") for row in claims[number])
    for one, other in zip(shown, found, strict=True):
        one, other = MEASURED.fullmatch(one), MEASURED.fullmatch(other)
        assert one is not None
        for part in ("name", "unit", "criterion"):
            assert one[part] == other[part]
        value = float(one["value"])
        if number == ROUNDING_ERRORS and one["criterion"]:
            assert 0.0 <= value < float(one["criterion"].removeprefix("< "))
        else:
            assert value == pytest.approx(float(other["value"]), rel=SHOWN)
