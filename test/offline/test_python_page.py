"""docs/python.md: fields, columns, names and signatures; its tables are generated."""

import ast
import inspect
import re

import pytest

import vehicle_roll_sim
from vehicle_roll_sim.model.records import OUTPUTS, STATE
from vehicle_roll_sim.runs.columns import COLUMNS, UNITS
from vehicle_roll_sim.simulation.signals import OUTPUT_SIGNALS, STATE_SIGNALS

TERMS = ("strut_length", "road_terms")


@pytest.fixture(scope="module")
def page(pytestconfig) -> str:
    return (pytestconfig.rootpath / "docs" / "python.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(("signals", "dtype"), [(STATE_SIGNALS, STATE), (OUTPUT_SIGNALS, OUTPUTS)])
def test_every_field_is_explained_in_order(signals, dtype):
    assert tuple(signals) == dtype.names


def test_terms_of_the_equations_are_where_the_page_says(page):
    first, last = TERMS
    assert (
        f"The fields from `{first}` to `{last}`, and the last two, are intermediate terms" in page
    )
    names = OUTPUTS.names
    assert set(names[: names.index(first)]) >= {"normal_force", "slip_angle", "steering"}
    outside = ("body_load", "acceleration", "specific_force", "slope_gravity")
    assert names[names.index(last) + 1 : -2] == outside


@pytest.mark.parametrize("name", ["run", "series", "linearize", "replay"])
def test_a_signature_has_the_parameters_in_order_with_their_defaults(page, name):
    shown = re.search(rf"`{name}\(([^)`]+, [^)`]+)\)`", page)[1]
    written = [part.partition("=")[::2] for part in " ".join(shown.split()).split(", ")]
    written.remove(("*", ""))
    declared = inspect.signature(getattr(vehicle_roll_sim, name)).parameters.values()
    for (shown_name, default), each in zip(written, declared, strict=True):
        assert shown_name.lstrip("*") == each.name
        if default and default != "…":
            value = each.default
            is_rounded = isinstance(value, float)
            expected = pytest.approx(value, rel=1e-3) if is_rounded else value
            assert ast.literal_eval(default) == expected


def test_every_column_has_its_unit():
    assert tuple(UNITS) == COLUMNS


def test_every_name_of_the_package_is_there():
    for name in vehicle_roll_sim.__all__:
        assert getattr(vehicle_roll_sim, name) is not None
    assert {"run", "series", "linearize", "replay"} <= set(vehicle_roll_sim.__all__)
