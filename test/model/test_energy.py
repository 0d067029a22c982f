"""Where the energy of a stop goes: nothing is gained or lost but to dampers, slip, brakes, torques.

In the model that is exact mechanics: no roll centre, Euler terms. Powers are integrated over the
run by the trapezoidal rule.
"""

import numpy as np
import pytest
from mechanics import energy, powers
from programmes import Run, record_run

from vehicle_roll_sim import Options, Simulation
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.simulation.road import Road

EXACT = Options(no_roll_centre=True, euler_terms=True)
STEP, END = 1e-3, 6.0
"""s"""
SHARE = 1e-6
"""Of the kinetic energy at the start; seen 3e-8."""
SECOND_ORDER = 4.0
"""Error of the rule with one step over that with half of it."""


def stop(times: np.ndarray) -> np.ndarray:
    """Some drive, then brakes, on a bend; the vehicle stands after some 5 s."""
    commands = np.zeros(len(times), COMMAND)
    commands["steering"] = 0.03 * np.sin(times)
    commands["wheel_torque"] = np.interp(times, [0.2, 0.4, 0.8, 1.0], [0, 100, 100, 0])[:, None]
    brakes = np.interp(times, [1.0, 1.2], [0.0, 700.0])[:, None]
    commands["brake_torque"] = brakes * [1.0, 1.0, 0.6, 0.6]
    return commands


def audit(vehicle, road: Road, step: float) -> tuple[Run, float, dict[str, float]]:
    """A stop; the energy that is unaccounted for (J), and the work of everything (J)."""
    simulation = Simulation(vehicle, EXACT, step=step, road=road)
    run = record_run(simulation, stop, END)
    samples = [
        powers(vehicle, state, outputs, command)
        for state, outputs, command in zip(run.state, run.outputs, stop(run.time), strict=True)
    ]
    work = {name: float(np.trapezoid([s[name] for s in samples], run.time)) for name in samples[0]}
    gained = energy(vehicle, road, run.state[-1]) - energy(vehicle, road, run.state[0])
    return run, gained - sum(work.values()), work


@pytest.mark.parametrize("road", [Road(), Road(grade=0.05, bank=-0.03)], ids=["flat", "slope"])
def test_energy_changes_by_the_work_of_dampers_slip_brakes_and_torques(vehicle, road):
    run, missing, work = audit(vehicle, road, STEP)
    kinetic = vehicle.sprung_mass * run.state["u"][0] ** 2 / 2
    assert (run.state["wheel_speed"][-1] == 0.0).all()  # it has stopped
    assert all(work[name] < 0.0 for name in ("dampers", "slip", "brakes"))
    assert work["torques"] > 0.0
    assert -work["brakes"] > 0.5 * kinetic
    assert abs(missing) < SHARE * kinetic


def test_what_is_unaccounted_for_is_the_error_of_the_rule(reference):
    coarse, fine = (abs(audit(reference, Road(), step)[1]) for step in (2 * STEP, STEP))
    assert coarse / fine == pytest.approx(SECOND_ORDER, rel=0.1)
