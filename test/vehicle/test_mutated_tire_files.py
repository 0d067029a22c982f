"""A mutated tire file is refused, or gives what the oracle gives that takes the file at its word.

What must not happen is a file that is accepted with other forces than those it states.
"""

import functools
import random
import re

import magic_formula
import numpy as np
import pytest
from tire_files import (
    DATA,
    NAMES,
    TOLERANCE,
    changed,
    evaluated,
    numbers_of,
    of_the_oracle,
    points_for,
    text_of,
    worst,
)

from vehicle_roll_sim import InputError
from vehicle_roll_sim.vehicle.tire_file import Tire, load_tire

pytestmark = [pytest.mark.slow, pytest.mark.unmeasured]

LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
SMALLEST = 0.01
"""m: a tire given in metres by a file in millimetres is smaller."""
REFUSED, EQUAL = "refused", "equal"
PRESSURE_OR_LARGE_CAMBER = re.compile(r"PP[XYZM]+\d|PKY[4-7]|PEY5|RB[XY][34]|QDZ1[01]|PHY3")
"""Keys that not every version has, and of which none is without effect."""


@pytest.fixture
def fate(tmp_path):
    """fate(name, text): refused, equal to the oracle, or by what it differs."""
    path, known = tmp_path / "mutated.tir", {}

    def decide(name: str, text: str) -> str:
        path.write_text(text, encoding="utf-8")
        try:
            tire = load_tire(path)
            taken = repr((tire, *magic_formula.read(path)))
            if taken not in known:
                known[taken] = compared(name, tire)
        except InputError as error:
            return REFUSED if str(error).isprintable() else "refused in several lines"
        return known[taken]

    def compared(name: str, tire: Tire) -> str:
        points = points_for(magic_formula.read(DATA / f"{name}.tir")[0], 5, 24)
        mine = evaluated(tire, points)
        if not np.isfinite([mine.longitudinal_force, mine.lateral_force]).all():
            return "a force is no number"
        differences = worst(mine, of_the_oracle(path, points))
        if tire.coefficients["UNLOADED_RADIUS"] < SMALLEST:  # of which radii mean nothing
            differences = {q: v for q, v in differences.items() if "radius" not in q}
        quantity, largest = max(differences.items(), key=lambda pair: pair[1])
        return EQUAL if largest < TOLERANCE else f"{quantity} differs by {largest:.1e}"

    return decide


@functools.cache
def matters(name: str) -> set[str]:
    """Keys of a file of which a change changes what the oracle gives."""
    p, _ = magic_formula.read(DATA / f"{name}.tir")
    points = points_for(p, 5)
    others = {k: points[k] for k in ("slip_ratio", "slip_angle", "inclination")}
    arguments = points["normal_force"], *others.values(), points.get("pressure"), points["speed"]
    plain = magic_formula.evaluate(p, *arguments)
    found = set()
    for key, value in numbers_of(name).items():
        other = magic_formula.Coefficients(p | {key: 1.01 * value}, p.version)
        with np.errstate(all="ignore"):
            forces = magic_formula.evaluate(other, *arguments)
        if not all(map(np.array_equal, plain[:5], forces[:5])):
            found.add(key)
    return found


def without(text: str, key: str) -> str:
    return re.sub(rf"(?m)^{key} *=.*\n", "", text)


def with_line(text: str, line: str, before: str) -> str:
    """The text with another line in front of that of a key."""
    return re.sub(rf"(?m)^(?={before} *=)", f"{line}\n", text)


def misspelt(key: str) -> str:
    """The key with a letter doubled, dropped, exchanged or swapped: for a key always the same."""
    rng = random.Random(key)
    place = rng.randrange(len(key))
    before, letter, after = key[:place], key[place], key[place + 1 :]
    ways = {
        before + 2 * letter + after,
        before + after,
        before + rng.choice(LETTERS) + after,
        before + after[:1] + letter + after[1:],
    }
    return rng.choice(sorted(ways - {key}))


@pytest.mark.parametrize("name", NAMES)
def test_files_that_are_not_mutated_are_equal(name, fate):
    assert fate(name, text_of(name)) == EQUAL


@pytest.mark.parametrize("name", NAMES)
def test_a_dropped_key_has_the_default_or_is_refused(name, fate):
    fates = {key: fate(name, without(text_of(name), key)) for key in numbers_of(name)}
    assert set(fates.values()) <= {REFUSED, EQUAL}, fates
    for key in ("FNOMIN", "PCX1", "PCY1", "PDX1", "PDY1", "PKX1", "PKY1", "PKY2"):
        assert fates[key] == REFUSED, key


@pytest.mark.parametrize("name", NAMES)
def test_a_misspelt_key_that_matters_is_refused(name, fate):
    known = {key for each in NAMES for key in numbers_of(each)}
    fates = {}
    for key in sorted(matters(name)):
        if (wrong := misspelt(key)) not in known:
            fates[key, wrong] = fate(name, re.sub(rf"(?m)^{key}(?= *=)", wrong, text_of(name)))
    assert len(fates) > 60
    assert set(fates.values()) == {REFUSED}, fates


@pytest.mark.parametrize("name", NAMES)
def test_a_key_given_twice_counts_only_if_both_say_the_same(name, fate):
    text, fates = text_of(name), {}
    for key, value in numbers_of(name).items():
        same = with_line(text, f"{key} = {value!r}", before=key)
        assert fate(name, same) in (REFUSED, EQUAL), key
        fates[key] = fate(name, with_line(text, f"{key} = {value + 0.01!r}", before=key))
    assert {fates[key] for key in matters(name)} == {REFUSED}, fates
    assert set(fates.values()) <= {REFUSED, EQUAL}


@pytest.mark.parametrize("name", NAMES)
def test_a_key_of_another_version_is_refused_or_without_effect(name, fate):
    foreign = {
        key: value for other in NAMES for key, value in numbers_of(other).items() if value != 0.0
    }
    fates = {}
    for key in sorted(foreign.keys() - numbers_of(name).keys()):
        fates[key] = fate(name, with_line(text_of(name), f"{key} = {foreign[key]}", "PCX1"))
    assert set(fates.values()) <= {REFUSED, EQUAL}, fates
    for key in fates:
        assert fates[key] == REFUSED or not PRESSURE_OR_LARGE_CAMBER.fullmatch(key), key


@pytest.mark.parametrize("name", NAMES)
def test_units_are_converted_or_refused(name, fate):
    lengths = ("UNLOADED_RADIUS", "WIDTH", "RIM_RADIUS", "RIM_WIDTH")
    given = numbers_of(name)
    units = {"LENGTH": "'mm'", "FORCE": "'kN'", "TIME": "'millisecond'", "ANGLE": "'degree'"}
    for quantity, unit in units.items():
        outcome = fate(name, changed(text_of(name), {quantity: unit}))
        assert outcome in (REFUSED, EQUAL), (quantity, outcome)
    converted = {"LENGTH": "'mm'"} | {key: repr(1e3 * given[key]) for key in lengths}
    for key in ("VERTICAL_STIFFNESS", "LATERAL_STIFFNESS", "LONGITUDINAL_STIFFNESS"):
        if key in given:
            converted[key] = repr(given[key] / 1e3)
    converted["LONGVL"] = repr(given["LONGVL"] * 1e3)
    assert fate(name, changed(text_of(name), converted)) == EQUAL


@pytest.mark.parametrize("name", NAMES)
def test_a_file_of_one_version_that_says_it_is_of_another_is_refused(name, fate):
    for version in ("5", "6", "51", "52", "61", "62"):
        outcome = fate(name, changed(text_of(name), {"FITTYP": version}))
        assert outcome in (REFUSED, EQUAL), (version, outcome)
