"""Energy balance of a run: it changes only by known powers, landings included.

In the model that is exact mechanics: no roll centre, Euler terms. Powers are integrated over the
run by the trapezoidal rule.
"""

import numpy as np
import pytest
from mechanics import energy, powers
from programmes import Run, record_run, with_moments

from vehicle_roll_sim import LF, LR, Options, Simulation
from vehicle_roll_sim.model.records import COMMAND
from vehicle_roll_sim.simulation.command import Programme
from vehicle_roll_sim.simulation.limits import DEFAULT_SPEED
from vehicle_roll_sim.simulation.road import Road

pytestmark = [pytest.mark.slow, pytest.mark.unmeasured]

EXACT = Options(no_roll_centre=True, euler_terms=True)
STEP, END = 1e-3, 6.0
"""s"""
WHILE_ROLLING = 3.0
"""s: the end of runs in which it need not stop."""
NEARLY_OVER, NOT_OVER_WITH_MOMENTS = 18.0, 14.0
"""m/s"""
SHARE = 1e-6
"""Of the kinetic energy at the start; seen 3e-8 in the stops, 1e-7 in the landings, where the slope
of a tire's force jumps within a step."""
SECOND_ORDER = 4.0
"""Error of the rule with one step over that with half of it."""
DROP = 0.1
"""m"""


def stop(times: np.ndarray) -> np.ndarray:
    """Some drive, then brakes, on a bend; the vehicle stands after some 5 s."""
    commands = np.zeros(len(times), COMMAND)
    commands["steering"] = 0.03 * np.sin(times)
    commands["wheel_torque"] = np.interp(times, [0.2, 0.4, 0.8, 1.0], [0, 100, 100, 0])[:, None]
    brakes = np.interp(times, [1.0, 1.2], [0.0, 700.0])[:, None]
    commands["brake_torque"] = brakes * [1.0, 1.0, 0.6, 0.6]
    return commands


def swerve(times: np.ndarray) -> np.ndarray:
    """9 degrees to the left for 0.3 s: the reference vehicle nearly goes over, and comes back."""
    commands = np.zeros(len(times), COMMAND)
    commands["steering"] = np.radians(np.interp(times, [0.2, 0.4, 0.7, 0.9], [0.0, 9.0, 9.0, 0.0]))
    return commands


def coast(times: np.ndarray) -> np.ndarray:
    return np.zeros(len(times), COMMAND)


def audit(
    simulation: Simulation, vehicle, programme: Programme, end: float = END
) -> tuple[Run, float, dict[str, float]]:
    """A run; the energy that is unaccounted for (J), and the work of everything (J)."""
    run, road = record_run(simulation, programme, end), simulation.road
    of_all = powers(vehicle, run.state, run.outputs, programme(run.time))
    work = {name: float(np.trapezoid(power, run.time)) for name, power in of_all.items()}
    gained = energy(vehicle, road, run.state[-1]) - energy(vehicle, road, run.state[0])
    return run, gained - sum(work.values()), work


def kinetic(vehicle, speed: float = DEFAULT_SPEED) -> float:
    return vehicle.sprung_mass * speed**2 / 2


@pytest.mark.parametrize("road", [Road(), Road(grade=0.05, bank=-0.03)], ids=["flat", "slope"])
def test_energy_changes_by_the_work_of_dampers_slip_brakes_and_torques(vehicle, road):
    simulation = Simulation(vehicle, EXACT, step=STEP, road=road)
    run, missing, work = audit(simulation, vehicle, stop)
    assert (run.state["wheel_speed"][-1] == 0.0).all()  # it has stopped
    assert all(work[name] < 0.0 for name in ("dampers", "slip", "brakes"))
    assert work["torques"] > 0.0
    assert -work["brakes"] > 0.5 * kinetic(vehicle)
    assert abs(missing) < SHARE * kinetic(vehicle)


def test_with_contact_moments_their_work_is_all_that_is_added(reference):
    vehicle = with_moments(reference)
    simulation = Simulation(vehicle, EXACT, step=STEP)
    simulation.reset(NOT_OVER_WITH_MOMENTS)
    _, missing, work = audit(simulation, vehicle, swerve)
    assert abs(work["contact moments"]) > 100 * SHARE * kinetic(vehicle, NOT_OVER_WITH_MOMENTS)
    assert abs(missing) < SHARE * kinetic(vehicle, NOT_OVER_WITH_MOMENTS)


def test_what_is_unaccounted_for_is_the_error_of_the_rule(reference):
    def missing(step: float) -> float:
        simulation = Simulation(reference, EXACT, step=step)
        return abs(audit(simulation, reference, stop, WHILE_ROLLING)[1])

    assert missing(2 * STEP) / missing(STEP) == pytest.approx(SECOND_ORDER, rel=0.1)


def test_two_wheels_that_land_after_a_near_rollover_bring_no_energy(reference):
    simulation = Simulation(reference, EXACT, step=STEP)
    simulation.reset(NEARLY_OVER)
    run, missing, work = audit(simulation, reference, swerve)
    off = run.outputs["normal_force"] == 0.0
    assert (off[:, LF] & off[:, LR]).sum() * STEP > 1.0
    assert np.degrees(np.abs(run.state["roll"]).max()) > 25.0
    assert not off[-1].any()
    assert work["dampers"] < 0.0
    assert abs(missing) < SHARE * kinetic(reference, NEARLY_OVER)


def test_a_vehicle_that_is_dropped_bounces_with_the_energy_of_its_fall_less_the_dampers(vehicle):
    simulation = Simulation(vehicle, EXACT, step=STEP)
    simulation.state["z"] += DROP
    simulation.state["tire_compression"] -= DROP
    run, missing, work = audit(simulation, vehicle, coast, WHILE_ROLLING)
    falls = run.outputs["normal_force"] == 0.0
    assert falls[1].all()
    assert not falls[-1].any()
    fall = (vehicle.sprung_mass + vehicle.per_wheel("unsprung_mass").sum()) * 9.81 * DROP
    assert work["dampers"] + work["slip"] < -0.9 * fall
    assert abs(missing) < SHARE * kinetic(vehicle)
