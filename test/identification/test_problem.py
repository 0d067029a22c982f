"""Derivatives of the residuals against differences written out here."""

import numpy as np

from benchmarks.hidden_vehicles import STEP as INTEGRATION
from benchmarks.hidden_vehicles import Faults, log_of_run
from vehicle_roll_sim import Simulation, preset
from vehicle_roll_sim.comparison.driving import TORQUES_APPLIED, Driving
from vehicle_roll_sim.identification.free import free_of
from vehicle_roll_sim.identification.problem import STEP, Problem


def test_central_differences_go_to_both_sides_of_every_value_and_back_at_an_upper_bound():
    log = log_of_run(preset(), faults=Faults(1.0))
    free = free_of(["yaw_rate_delay"], preset(), log.compared)
    driving = Driving(drive_by=TORQUES_APPLIED, run_up=0.3)
    problem = Problem([log], Simulation(preset(), step=INTEGRATION), free, driving, {}, workers=1)
    # values of which some grow by less than the step, by rounding
    for value in np.random.default_rng(1).uniform(0.1, 2.0, (20, 1)):
        ahead, behind = problem.residuals(value + STEP), problem.residuals(value - STEP)
        found = problem.jacobian(value, is_central=True)[:, 0]
        # differences to one side are away by 1e-3 of the largest, rounding by far less
        expected = (ahead - behind) / (2.0 * STEP)
        np.testing.assert_allclose(found, expected, atol=1e-6 * np.abs(expected).max())
    upper = problem.bounds[1]
    back = (problem.residuals(upper) - problem.residuals(upper - STEP)) / STEP
    found = problem.jacobian(upper, is_central=True)[:, 0]
    np.testing.assert_allclose(found, back, atol=1e-6 * np.abs(back).max())
