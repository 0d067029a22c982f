"""A tire file that is accepted, whatever it says: forces oppose slip and stay within friction.

What that means for a formula with shifts, at every load and slip within the ranges of the file and
without inclination: the force of pure slip less its vertical shift opposes the slip plus its
horizontal shift, and is at most the peak D of that load. The weights of combined slip lie between 0
and 1 over their value at the shift; the force that slip ratio induces across is at most its own
peak. Each component is therefore bounded, and so is the total.
"""

import magic_formula
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from magic_formula import lateral, longitudinal
from tire_files import NAMES, changed, numbers_of, text_of

from vehicle_roll_sim import InputError
from vehicle_roll_sim.vehicle.tire_evaluation import evaluate
from vehicle_roll_sim.vehicle.tire_file import load_tire

pytestmark = [pytest.mark.slow, pytest.mark.unmeasured]

ROUNDING = 1e-9
"""Of the load."""
FACTORS = (-1.0, 0.0, 0.1, 0.5, 2.0, 10.0)
"""A coefficient that is changed is multiplied by one of these: signs turned, units mistaken."""
FEW = st.lists(st.tuples(st.integers(0, 1000), st.sampled_from(FACTORS)), min_size=1, max_size=3)


def coefficients(name: str) -> list[str]:
    """Keys of forces: coefficients and scaling factors."""
    return [key for key in numbers_of(name) if key[0] in "LPRQS" and key != "LONGVL"]


def grid(p, tire) -> tuple[np.ndarray, ...]:
    """Loads, slip ratios and slip angles within the ranges of the file: pure and combined slip."""
    loads = np.linspace(
        tire.coefficients["FZMIN"], min(tire.coefficients["FZMAX"], 2.5 * p["FNOMIN"]), 4
    )
    ratios = np.linspace(max(p["KPUMIN"], -1.0), p["KPUMAX"], 8)
    angles = np.linspace(p["ALPMIN"], p["ALPMAX"], 8)
    return tuple(axis.ravel() for axis in np.meshgrid(loads, ratios, angles))


def check(path, tire) -> None:
    """Assert that forces oppose slip and stay within what the file states."""
    p, _ = magic_formula.read(path)
    load, kappa, alpha = grid(p, tire)
    dp = 0.0 if p.version == "5.2" else p["INFLPRES"] / p["NOMPRES"] - 1.0
    at = {"side": tire.side}
    pure_x = evaluate(tire, load, kappa, 0.0 * alpha, **at).longitudinal_force
    pure_y = evaluate(tire, load, 0.0 * kappa, alpha, **at).lateral_force
    both = evaluate(tire, load, kappa, alpha, **at)
    with np.errstate(all="ignore"):
        along, across = magic_formula.limits(p, kappa, alpha, load, dp)
        ahead = kappa + longitudinal.horizontal_shift(p, load)
        aside = alpha + lateral.horizontal_shift(p, load, 0.0, dp)
        pushed = (pure_x - longitudinal.vertical_shift(p, load)) * np.sign(ahead)
        pulled = (pure_y - lateral.vertical_shift(p, load)) * np.sign(aside)
    little = ROUNDING * load
    assert (pushed >= -little).all()
    assert (pulled <= little).all()
    assert (np.abs(both.longitudinal_force) <= along + little).all()
    assert (np.abs(both.lateral_force) <= across + little).all()
    total = np.hypot(both.longitudinal_force, both.lateral_force)
    assert (total <= np.hypot(along, across) + little).all()


@pytest.mark.parametrize("name", NAMES)
def test_the_files_as_they_are_do(name, tmp_path):
    path = tmp_path / "tire.tir"
    path.write_text(text_of(name), encoding="utf-8")
    check(path, load_tire(path))


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=25)
@given(changes=FEW)
def test_a_file_with_a_few_wrong_numbers_is_refused_or_does(name, changes, tmp_path_factory):
    keys, given_ = coefficients(name), numbers_of(name)
    values = {keys[i % len(keys)]: given_[keys[i % len(keys)]] * factor for i, factor in changes}
    path = tmp_path_factory.mktemp("tire") / "wrong.tir"
    path.write_text(changed(text_of(name), values), encoding="utf-8")
    try:
        tire = load_tire(path)
    except InputError:
        return
    check(path, tire)


@pytest.mark.parametrize("key", ["PKY1", "PKX1", "LKY", "LKX"])
@pytest.mark.parametrize("name", NAMES)
def test_a_stiffness_of_the_other_sign_is_refused_by_name(name, key, tmp_path):
    path = tmp_path / "turned.tir"
    values = {key: -numbers_of(name)[key]}
    path.write_text(changed(text_of(name), values), encoding="utf-8")
    with pytest.raises(InputError, match=key if key[0] == "P" else key[2]) as error:
        load_tire(path)
    assert str(error.value).isprintable()


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("RCX1", 11.0, "at most 3"),
        ("RCY1", -4.0, "at most 3"),
        ("RHX1", 2.0, "leaves no Fx in pure slip"),
        ("RHY1", -3.0, "leaves no Fy in pure slip"),
    ],
)
@pytest.mark.parametrize("name", NAMES)
def test_a_weight_that_comes_back_or_is_used_up_without_other_slip_is_refused(
    name, key, value, words, tmp_path
):
    path, given_ = tmp_path / "weights.tir", {key: value}
    if key.startswith("RH"):
        given_["RC" + key[2] + "1"] = 1.5  # below 1, a weight never ends
    path.write_text(changed(text_of(name), given_), encoding="utf-8")
    with pytest.raises(InputError, match=f"{key}: .*{words}"):
        load_tire(path)
