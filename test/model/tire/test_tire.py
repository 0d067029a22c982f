"""The tire: Magic Formula against closed forms and a second implementation."""

import functools
import math

import magic_formula
import numpy as np
import pytest
from programmes import SHIFTS, with_tire

from vehicle_roll_sim.model.compiled.jit import kernel_argument
from vehicle_roll_sim.model.records import LF, OUTPUTS
from vehicle_roll_sim.model.tire.coefficients import OPTIONAL, REQUIRED, SCALING, as_one, on_axles
from vehicle_roll_sim.model.tire.magic_formula import tire_forces
from vehicle_roll_sim.vehicle.tire_evaluation import evaluate

LEFT, RIGHT = 1.0, -1.0
LOADS = (500.0, 2000.0, 6000.0, 12_000.0)
"""N"""
CASES = 500
ROUNDING = 1e-12
"""Relative to the load: a few functions of double precision."""


def forces_of(tire, kappa: float, alpha: float, load: float, side: float = LEFT):
    """Longitudinal and lateral force (N) of a wheel with that slip, slip angle (rad) and load."""
    outputs = np.zeros(1, OUTPUTS)
    outputs["slip_ratio"], outputs["slip_tangent"] = kappa, math.tan(alpha)
    outputs["normal_force"], outputs["side"], outputs["road_friction"] = load, side, 1.0
    tires = on_axles(tire.record(), tire.record())
    tire_forces(kernel_argument(as_one(tires)), kernel_argument(outputs))
    return outputs[0]["tire_longitudinal"][LF], outputs[0]["tire_lateral"][LF]


@pytest.fixture(scope="session")
def tire(reference):
    return reference.tire


@pytest.fixture(scope="session")
def odd_tire(tire):
    """A tire of which every coefficient counts: all shifts on, no factor 1, none of the rest 0."""
    rng = np.random.default_rng(7)
    scaling = {name: rng.uniform(0.8, 1.2) for name in SCALING}
    filled = {name: tire.coefficients[name] or rng.uniform(-0.1, 0.1) for name in OPTIONAL}
    given = {name: tire.coefficients[name] * rng.uniform(0.9, 1.1) for name in REQUIRED}
    return tire.with_coefficients(**given, **filled, **scaling)


@pytest.mark.parametrize("name", ["tire", "odd_tire"])
def test_forces_are_those_of_a_second_evaluation_of_the_formula(name, request):
    tire = request.getfixturevalue(name)
    rng = np.random.default_rng(8)
    kappa, alpha = rng.uniform(-1.5, 1.5, CASES), rng.uniform(-1.57, 1.57, CASES)
    load = rng.uniform(1.0, 60_000.0, CASES)  # N, to where friction is used up
    fx, fy = magic_formula.combined(tire.coefficients, kappa, alpha, load)
    mine = np.array([forces_of(tire, *case) for case in zip(kappa, alpha, load, strict=True)])
    assert np.abs(mine[:, 0] - fx).max() < ROUNDING * load.max()
    assert np.abs(mine[:, 1] - fy).max() < ROUNDING * load.max()


@pytest.mark.parametrize("load", LOADS)
def test_slopes_at_zero_slip_are_the_stiffnesses(tire, load):
    slip = 1e-7  # the next term of the series is below 1e-10 of the slope
    fx, _ = forces_of(tire, slip, 0.0, load)
    _, fy = forces_of(tire, 0.0, slip, load)
    kx = magic_formula.longitudinal_stiffness(tire.coefficients, load)
    ky = magic_formula.cornering_stiffness(tire.coefficients, load)
    assert fx / slip == pytest.approx(kx, rel=1e-9)
    assert fy / slip == pytest.approx(ky, rel=1e-9)
    assert kx > 0 > ky  # ISO: sliding to the left pulls to the right


@pytest.mark.parametrize("load", LOADS)
def test_the_largest_force_of_pure_slip_is_the_friction_of_that_load(tire, load):
    slips = np.linspace(0.0, 1.0, 1001)
    fx = evaluate(tire, load, slips, 0.0).longitudinal_force.max()
    fy = evaluate(tire, load, 0.0, slips).lateral_force.min()
    # a grid misses the top by less than 1e-4 of it
    assert fx == pytest.approx(magic_formula.longitudinal_peak(tire.coefficients, load), rel=1e-4)
    assert fy == pytest.approx(magic_formula.lateral_peak(tire.coefficients, load), rel=1e-4)


@pytest.mark.parametrize("load", LOADS)
def test_slip_in_one_direction_takes_force_from_the_other(tire, load):
    for slip in (0.05, 0.1, 0.3, 1.0):
        pure_x, pure_y = forces_of(tire, slip, 0.0, load)[0], forces_of(tire, 0.0, slip, load)[1]
        for other in (0.03, 0.1, 0.5):
            assert 0.0 < forces_of(tire, slip, other, load)[0] < pure_x
            assert 0.0 > forces_of(tire, other, slip, load)[1] > pure_y


@pytest.mark.parametrize("load", [0.0, -1.0, -5000.0])
def test_a_tire_without_load_makes_no_force_not_even_by_its_shifts(odd_tire, load):
    assert forces_of(odd_tire, 0.3, -0.2, load) == (0.0, 0.0)


def test_friction_never_turns_round_however_large_the_load(tire):
    for load in np.geomspace(1e3, 1e9, 50):
        fx, fy = forces_of(tire, 0.1, 0.0, load)[0], forces_of(tire, 0.0, 0.1, load)[1]
        assert fx >= 0.0 >= fy
    assert forces_of(tire, 0.1, 0.1, 1e9) == (0.0, 0.0)  # N: both coefficients are used up


def test_forces_are_odd_in_their_slip_without_shifts(tire):
    rng = np.random.default_rng(9)
    for kappa, alpha, load in rng.uniform((-1, -1, 100), (1, 1, 15_000), (100, 3)):
        fx, fy = forces_of(tire, kappa, alpha, load)
        assert forces_of(tire, -kappa, alpha, load)[0] == -fx
        assert forces_of(tire, kappa, -alpha, load)[1] == -fy


def test_a_mirrored_tire_makes_the_mirrored_force(odd_tire):
    rng = np.random.default_rng(10)
    for kappa, alpha, load in rng.uniform((-1, -1, 100), (1, 1, 15_000), (100, 3)):
        fx, fy = forces_of(odd_tire, kappa, alpha, load, LEFT)
        assert forces_of(odd_tire, kappa, -alpha, load, RIGHT) == (fx, -fy)


def test_a_left_hand_tire_is_mirrored_on_the_right_and_the_reverse(reference):
    assert with_tire(reference, "left").tire.record()["side"].tolist() == [[1, -1, 1, -1]]
    assert with_tire(reference, "right").tire.record()["side"].tolist() == [[-1, 1, -1, 1]]


@pytest.mark.parametrize(
    ("factor", "coefficients", "slip_ratio"),
    [
        ("LHX", {"PHX1": 0.02}, 0.0),
        ("LVX", {"PVX1": 0.05}, 0.0),
        ("LHY", {"PHY1": 0.02}, 0.0),
        ("LVY", {"PVY1": 0.05}, 0.0),
        ("LVYKA", {"RVY1": 0.05}, 0.1),
    ],
)
def test_a_shift_is_on_exactly_where_its_factor_is_not_zero(tire, factor, coefficients, slip_ratio):
    off = dict.fromkeys(SHIFTS, 0.0)
    none = {name: 0.0 for name in OPTIONAL if "H" in name or "V" in name}
    keeps_curve = {"RVY4": 1.0, "RVY5": 1.9, "RVY6": -10.0}
    bare = tire.with_coefficients(**none | keeps_curve | off)
    forces = functools.partial(forces_of, kappa=slip_ratio, alpha=0.0, load=4000.0)
    unshifted = forces(bare)
    assert forces(bare.with_coefficients(**coefficients)) == unshifted
    assert forces(bare.with_coefficients(**coefficients, **{factor: 1.0})) != unshifted
    half = forces(bare.with_coefficients(**coefficients, **{factor: 0.5}))
    assert half not in (unshifted, forces(bare.with_coefficients(**coefficients, **{factor: 1.0})))


@pytest.mark.parametrize(("name", "axis"), [("PEX1", 0), ("PEY1", 1)])
def test_a_curvature_factor_beyond_one_counts_as_one(tire, name, axis):
    """Above 1 the curve would turn back before its peak."""
    flat = dict.fromkeys(("PEX2", "PEX3", "PEX4", "PEY2", "PEY3"), 0.0)
    slips = [(0.4, 0.0), (0.0, 0.4)][axis]
    one, beyond = (
        forces_of(tire.with_coefficients(**flat | {name: value}), *slips, 4000.0)[axis]
        for value in (1.0, 7.0)
    )
    assert one == beyond
    assert math.isfinite(one)
    assert one != forces_of(tire.with_coefficients(**flat | {name: 0.9}), *slips, 4000.0)[axis]
