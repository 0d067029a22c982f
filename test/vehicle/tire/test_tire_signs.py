"""Signs: a tire whose forces push with the slip is refused, and other conventions are converted.

What the conversions do is compared with the oracle: the formula with the coefficients as they stand
in a file gives forces in the axes of that file, and with the converted ones those in ISO axes.
"""

from pathlib import Path

import magic_formula
import numpy as np
import pytest
from tire_texts import BASE, BASE_6_1, changed
from vehicle_files import line_of, refused

from vehicle_roll_sim import load_tire
from vehicle_roll_sim.vehicle.tire import curves
from vehicle_roll_sim.vehicle.tire.signs import ASYMMETRIC, CONVENTIONS

DATA = Path(magic_formula.__file__).parents[1] / "tire" / "data"
FILES = ("mf52_full", "mf61", "mf62")
"""Files in which every coefficient of their version counts."""
SAE = {"PKY1": "PKY1 = 18", "PHY1": "PHY1 = 0.002"}


def points(seed: int = 1, count: int = 60) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(seed)
    return {
        "load": rng.uniform(500, 9000, count),
        "kappa": rng.uniform(-0.3, 0.3, count),
        "alpha": rng.uniform(-0.5, 0.5, count),
        "camber": rng.uniform(-0.15, 0.15, count),
    }


def forces(coefficients, version, sign_of_alpha=1.0, **options):
    """Rows Fx, Fy, Mx, My, Mz and, but for 5.2, the loaded radius."""
    p = magic_formula.Coefficients(coefficients, version)
    at = points()
    at["alpha"] = sign_of_alpha * at["alpha"]
    rows = magic_formula.evaluate(p, **at, **options)
    return np.array([rows[k] for k in range(5)] + [rows.loaded_radius] * (version != "5.2"))


AXES = {
    "ADAPTED_ISO": (-1.0, (1, 1, 1, 1, 1, 1)),
    "ADAPTED_SAE": (1.0, (1, -1, 1, 1, -1, 1)),
    "SAE": (-1.0, (1, -1, 1, 1, -1, 1)),
}
"""Signs of the slip angle, and of Fx, Fy, Mx, My, Mz and the radius, in ISO over those there."""


@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("convention", CONVENTIONS)
def test_converted_coefficients_give_the_forces_of_the_file_in_iso_axes(convention, name):
    tire = load_tire(DATA / f"{name}.tir")
    c = tire.coefficients
    there = {n: -v if n in CONVENTIONS[convention] else v for n, v in c.items()}
    sign_of_alpha, signs = AXES[convention]
    iso = forces(c, tire.version)
    in_file = forces(there, tire.version, sign_of_alpha)
    turned = in_file * np.array(signs)[: len(iso), None]
    scale = np.abs(iso).max(axis=1, keepdims=True)
    assert (np.abs(turned - iso) / scale).max() < 1e-12  # rounding


@pytest.mark.parametrize("name", FILES)
def test_a_symmetric_tire_is_its_own_mirror_image(name):
    tire = load_tire(DATA / f"{name}.tir")
    symmetric = tire.coefficients | dict.fromkeys(ASYMMETRIC, 0.0)
    one = forces(symmetric, tire.version)
    other = forces(symmetric, tire.version, mirrored=True)
    scale = np.abs(one).max(axis=1, keepdims=True)
    assert (np.abs(one - other) / scale).max() < 1e-12  # rounding
    assert any(tire.coefficients[each] for each in ASYMMETRIC)


@pytest.mark.parametrize(
    "lines",
    [{"PKY1": "PKY1 = 18"}, {"PKY1": "PKY1 = 0"}, {"PKY2": "PKY2 = -1.8"}],
    ids=["SAE", "none", "a fit with negative PKY2"],
)
@pytest.mark.parametrize("start", [BASE, BASE_6_1], ids=["5.2", "6.1"])
def test_a_side_force_that_pushes_with_the_slip_is_refused(read, start, lines):
    if "PKY1" in lines and start == BASE_6_1:
        lines = {"PKY1": lines["PKY1"]}
    text = changed(lines, start)
    with refused(line_of(text, "PKY1"), "PKY1", "cornering stiffness", "SIGN_CONVENTION"):
        read(text)


def test_two_negative_factors_of_the_cornering_stiffness_make_a_right_one(read):
    tire = read(changed({"PKY1": "PKY1 = 18", "PKY2": "PKY2 = -1.8"}))
    assert tire.coefficients["PKY2"] == -1.8


@pytest.mark.parametrize("value", [-21, 0])
def test_a_brake_force_that_pushes_with_the_slip_is_refused(read, value):
    text = changed({"PKX1": f"PKX1 = {value}"})
    with refused(line_of(text, "PKX1"), "PKX1", "slip stiffness", "brake slip"):
        read(text)


@pytest.mark.parametrize(
    ("start", "lines", "low", "high"),
    [
        (BASE, {"PKX2": "PKX2 = -20"}, 200, 7750),  # (1 + 21 / 20) FNOMIN = 7790
        (BASE, {"PKX2": "PKX2 = 30"}, 1150, 9000),  # (1 - 21 / 30) FNOMIN = 1140
        (BASE, {"LFZO": "LFZO = 0.37", "PKX2": "PKX2 = -5"}, 200, 7300),  # 5.2 LFZO FNOMIN = 7311
        (BASE_6_1, {"PKX2": "PKX2 = -20", "FZMAX": ""}, 380, 7750),
    ],
)
def test_a_fit_that_fails_at_the_ends_of_its_range_is_read_for_the_rest(
    read, start, lines, low, high
):
    """With a warning; a load beyond the range is reported when it occurs."""
    tire = read(changed(lines, start))
    c = tire.coefficients
    step = (9000 if "FZMAX" not in lines else 3 * 3800) / 40
    assert (max(c["FZMIN"], low), c["FZMAX"]) == pytest.approx((low, high), abs=step)
    for load in (max(c["FZMIN"], low), c["FZMAX"]):
        assert curves.slip_stiffness(c, load) > 0.0
    assert any("warning: FZM" in note and "PKX2" in note for note in tire.notes)


def test_a_fit_that_fails_beyond_its_range_is_read_as_it_is(read):
    tire = read(changed({"PKX2": "PKX2 = -20", "FZMAX": "FZMAX = 7000"}))
    assert tire.coefficients["FZMAX"] == 7000.0
    assert not any("warning" in note for note in tire.notes)


@pytest.mark.parametrize("key", ["PKY4", "PPY2"])
def test_a_side_force_that_fails_at_the_ends_of_its_range_is_refused(read, key):
    """With PKY4 = 5 the cornering stiffness is 0 at PKY2 tan(36 deg) FNOMIN, 4970 N, and above."""
    lines = {"PKY4": "PKY4 = 5"} if key == "PKY4" else {"PPY2": "PPY2 = -11"}
    text = changed(lines, BASE_6_1)
    remedy = "FZMAX; see PKY2, PKY4" if key == "PKY4" else "SIGN_CONVENTION"
    with refused(line_of(text, "PKY1"), "PKY1", "cornering stiffness", remedy):
        read(text)


def test_a_nominal_load_beyond_the_range_is_no_fault(read):
    assert read(changed({"FZMAX": "FZMAX = 2000"})).coefficients["FZMAX"] == 2000.0


@pytest.mark.parametrize(("key", "value"), [("PCX1", 3.4), ("PCY1", 3.2), ("PCY1", -3.2)])
def test_a_curve_that_turns_round_is_refused(read, key, value):
    text = changed({key: f"{key} = {value}", "PEY1": "PEY1 = 0", "PEX1": "PEX1 = 0"})
    with refused(line_of(text, key), key, str(value), "reverses", "at most 2"):
        read(text)


STATED = {
    "key": ("SIGN_CONVENTION = 'ADAPTED_SAE'", SAE),
    "other key": ("COORDINATE_SYSTEM = 'Adapted SAE'", SAE),
    "axis key": ("AXIS_SYSTEM = SAE", SAE),
    "Adams": ("SIGN_CONVENTION = 'Adams'", SAE),
    "comment": ("! : COORDINATE_SYSTEM : Adapted SAE", SAE),
    "SAE in earnest": ("SIGN_CONVENTION = 'SAE J670e'", {"PHY1": "PHY1 = -0.002"}),
    "slip angle alone": (
        "SIGN_CONVENTION = 'adapted iso'",
        {"PKY1": "PKY1 = 18", "PHY1": "PHY1 = -0.002"},
    ),
}


@pytest.mark.parametrize("kind", STATED)
def test_a_file_that_says_its_signs_is_converted(read, base, kind):
    line, lines = STATED[kind]
    tire = read(changed(lines | {"VXLOW": f"VXLOW = 1\n{line}"}))
    expected = base.coefficients
    for name in ("PKY1", "PHY1", "PKX1", "PCY1", "FNOMIN"):
        assert tire.coefficients[name] == expected[name]
    assert any("to ISO signs" in note for note in tire.notes)
    flipped = kind in ("SAE in earnest", "slip angle alone")
    ranges = (tire.coefficients["ALPMIN"], tire.coefficients["ALPMAX"])
    assert ranges == ((-1.5, 1.25) if flipped else (-1.25, 1.5))


@pytest.mark.parametrize("name", ["ISO", "ISO-W", "TYDEX W", "tydex"])
def test_a_file_that_says_iso_is_read_as_it_is(read, base, name):
    tire = read(changed({"VXLOW": f"VXLOW = 1\nSIGN_CONVENTION = '{name}'"}))
    assert tire.coefficients == base.coefficients


def test_signs_that_are_not_those_that_a_file_says_are_refused(read):
    text = changed({"PKY1": "PKY1 = 18", "VXLOW": "SIGN_CONVENTION = 'ISO'"})
    with refused(line_of(text, "PKY1"), "PKY1"):
        read(text)
    text = changed({"VXLOW": "SIGN_CONVENTION = 'ADAPTED_SAE'"})
    with refused(line_of(text, "PKY1"), "PKY1", "states other signs: SIGN_CONVENTION"):
        read(text)
    text = changed({"VXLOW": "SIGN_CONVENTION = 'left-handed'"})
    with refused(line_of(text, "SIGN_CONVENTION"), "left-handed", "ADAPTED_SAE"):
        read(text)
