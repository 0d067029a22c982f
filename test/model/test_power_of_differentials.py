"""The power of the drive: what goes in comes out at the wheels, or is lost in a coupling.

The torque of a drive shaft is taken from the spin acceleration of its wheel: how much the drive and
the differentials change it, in states in which nothing else does.
"""

import dataclasses

import numpy as np
import pytest
from programmes import Evaluation
from random_states import random_command, random_state

from vehicle_roll_sim import InputError, Options, Simulation, preset
from vehicle_roll_sim.vehicle.parameters import Vehicle

INERTIA = 1.3
"""kg m^2: of each wheel."""
VISCOUS, STIFF, PRELOAD = 60.0, 1e4, 80.0
"""N m s/rad, N m s/rad, N m"""
DRAWN, ROUNDING = 5, 1e-9


@dataclasses.dataclass(frozen=True)
class Coupling:
    """Closed form of the coupling of an axle: damping (N m s/rad), preload (N m), locking value."""

    damping: float
    preload: float | None = None
    locking: float | None = None

    def torque(self, difference: float, of_axle: float) -> float:
        """From the faster to the slower wheel (N m), by the difference of their speeds (rad/s)."""
        if self.preload is None:
            return self.damping * difference
        largest = self.preload + (self.locking or 0.0) * abs(of_axle) / 2
        return largest * np.tanh(self.damping * difference / largest)

    def of(self, axle: str) -> dict[str, float]:
        given = {name: value for name, value in vars(self).items() if value is not None}
        return {f"{axle}_differential_{name}": value for name, value in given.items()}


OPEN = Coupling(0.0)
COUPLINGS = {
    "open": (OPEN, OPEN),
    "viscous in front": (Coupling(VISCOUS), OPEN),
    "stiff": (Coupling(STIFF), Coupling(STIFF)),
    "limited slip": (Coupling(VISCOUS, PRELOAD), Coupling(STIFF, PRELOAD, 0.4)),
}
"""Of the front and the rear axle."""


def vehicle_with(front: Coupling, rear: Coupling, share: float = 0.0) -> Vehicle:
    wheels = {"wheel_inertia": INERTIA, "front_drive_share": share}
    return preset().with_values(wheels | front.of("front") | rear.of("rear"))


@pytest.mark.parametrize("model", ["1", "2", "8dof"])
@pytest.mark.parametrize("name", COUPLINGS)
def test_drive_power_is_that_of_the_wheels_and_of_the_losses(name, model):
    """The centre differential turns with share w_front + (1 - share) w_rear, where the w are the
    means of the wheels of an axle, with which its differential turns."""
    rng, share, options = np.random.default_rng(11), 0.35, Options(model=model)
    vehicle = vehicle_with(*COUPLINGS[name], share)
    driven, bare = (
        Evaluation(each, options) for each in (vehicle, vehicle_with(OPEN, OPEN, share))
    )
    for _ in range(DRAWN):
        state, command = random_state(vehicle, rng), random_command(rng)
        command["wheel_torque"] = 0.0
        without = bare.rates(state, command)["wheel_speed"].copy()
        total = rng.uniform(-4000.0, 4000.0)
        command["wheel_torque"] = total * vehicle.drive_shares
        torques = INERTIA * (driven.rates(state, command)["wheel_speed"] - without)
        spin = state["wheel_speed"]
        means, differences = spin.reshape(2, 2).mean(axis=1), -np.diff(spin)[::2]
        of_axles = total * np.array([share, 1.0 - share])
        losses = [
            coupling.torque(*each) * each[0]
            for coupling, each in zip(
                COUPLINGS[name], np.column_stack((differences, of_axles)), strict=True
            )
        ]
        assert min(losses) >= 0.0
        scale = ROUNDING * (np.abs(torques * spin).sum() + 1e5)
        assert torques.reshape(2, 2).sum(axis=1) == pytest.approx(of_axles, abs=scale)
        put_in = total * (share * means[0] + (1.0 - share) * means[1])
        assert torques @ spin + sum(losses) == pytest.approx(put_in, abs=scale)


def torques_of_wheels(coupling: Coupling, of_axle: float, faster: float) -> np.ndarray:
    """Torques (N m) of the rear wheels, of which the left one is faster by that much (rad/s)."""
    rng = np.random.default_rng(1)
    vehicle, bare = (vehicle_with(OPEN, each) for each in (coupling, OPEN))
    state, command = random_state(vehicle, rng), random_command(rng)
    state["wheel_speed"][2] = state["wheel_speed"][3] + faster
    command["wheel_torque"] = 0.0
    without = Evaluation(bare).rates(state, command)["wheel_speed"].copy()
    command["wheel_torque"][2:] = of_axle / 2
    return INERTIA * (Evaluation(vehicle).rates(state, command)["wheel_speed"] - without)[2:]


@pytest.mark.parametrize("of_axle", [0.0, 600.0, -600.0])
@pytest.mark.parametrize("faster", [3.0, -3.0])
def test_the_locking_value_is_the_share_by_which_torques_differ(of_axle, faster):
    """With a stiff slope: |T_slow - T_fast| = 2 preload + locking |T_slow + T_fast|."""
    left, right = torques_of_wheels(Coupling(1e3, PRELOAD, 0.4), of_axle, faster)
    assert (right - left) * np.sign(faster) == pytest.approx(2 * PRELOAD + 0.4 * abs(of_axle))
    assert left + right == pytest.approx(of_axle, abs=1e-6)


def test_near_equal_speeds_it_is_the_viscous_coupling():
    small = 1e-4
    limited, viscous = (
        torques_of_wheels(each, 500.0, small)
        for each in (Coupling(VISCOUS, PRELOAD, 0.4), Coupling(VISCOUS))
    )
    assert limited == pytest.approx(viscous, abs=1e-6 * VISCOUS * small)


@pytest.mark.parametrize(
    ("given", "needed"),
    [
        ({"rear_differential_preload": 50.0}, "rear_differential_damping"),
        ({"front_differential_preload": 50.0, "front_differential_damping": 0.0}, "damping"),
        ({"front_differential_locking": 0.3, "front_differential_damping": 9.0}, "preload"),
    ],
)
def test_values_of_a_limited_slip_differential_need_one_another(given, needed):
    with pytest.raises(InputError, match=needed):
        preset().with_values(given)


def test_a_slope_too_steep_for_the_step_is_refused_at_the_start():
    steep = Coupling(3000.0, 10.0, 0.4)
    with pytest.raises(InputError, match="step: "):
        Simulation(vehicle_with(OPEN, steep)).reset(20.0)
