"""Models that are driven together do what each does alone, bit for bit."""

import numpy as np
import pytest

from benchmarks.hidden_vehicles import log_of_run
from vehicle_roll_sim import Options, Simulation, preset
from vehicle_roll_sim.comparison import fleet_driving
from vehicle_roll_sim.comparison.driving import Driven, Driving, driven_of, noted
from vehicle_roll_sim.comparison.fleet_driving import drive_all
from vehicle_roll_sim.comparison.log_commands import LogCommands, Plan
from vehicle_roll_sim.model.integration.events import Condition
from vehicle_roll_sim.simulation.command import Command


def drive(log, simulation, driving) -> Driven:
    """One simulation driven by a log, a Command for each period."""
    plan = Plan.of(log, driving.run_up, simulation.step_ns)
    given = LogCommands(log, simulation.vehicle, driving.holds_speed, plan)
    simulation.reset(float(given.speeds[0]))

    def row() -> np.ndarray:
        velocity = np.array(simulation.cg_motion[3:])
        return noted(simulation.state_vector, simulation.output_vector, velocity)

    columns = [row()]
    for k in range(plan.periods):
        if simulation.condition is not Condition.RUNNING:
            break
        wheels = given.wheel_torques[k].tolist(), given.brake_torques[k].tolist()
        command = Command(float(given.steering[k]), float(given.rear_steering[k]), *wheels)
        if given.is_held[k]:
            slope = float(simulation.outputs["slope_gravity"][0])
            target, speed = float(given.speeds[k]), float(simulation.state["u"])
            free = Command(command.steering, command.rear_steering)
            command = given.controller.drive(free, target, speed, plan.period, slope)
        simulation.step(command, plan.period)
        columns.append(row())
    return driven_of(log, plan, given, np.array(columns).T, simulation.condition)


@pytest.mark.parametrize("driving", [Driving(run_up=0.3), Driving(drive_by="torques", run_up=0.2)])
def test_each_model_does_what_it_does_alone(driving, monkeypatch):
    monkeypatch.setattr(fleet_driving, "WORTH_A_THREAD", 1)  # so that there are two
    logs = [log_of_run(preset(), duration=1.0), log_of_run(preset(), duration=1.4)]

    def pairs():
        heavier = preset().with_values({"sprung_mass": 1600.0, "front_drive_share": 0.4})
        return [
            (logs[0], Simulation(preset())),
            (logs[1], Simulation(heavier)),
            (logs[1], Simulation(preset(), Options(model="8dof"))),
        ]

    together = drive_all(pairs(), driving, workers=2)
    for found, (log, simulation) in zip(together, pairs(), strict=True):
        alone = drive(log, simulation, driving)
        assert found.signals.keys() == alone.signals.keys()
        for name, values in alone.signals.items():
            np.testing.assert_array_equal(found.signals[name], values, err_msg=name)
        np.testing.assert_array_equal(found.steering, alone.steering)
        assert found.unused == alone.unused


def test_a_model_that_rolls_over_stops_and_the_others_go_on():
    log = log_of_run(preset(), "overturning", duration=2.5, end=1.9)
    tall = preset().with_values({"cg_height": 1.6})
    pairs = [(log, Simulation(tall)), (log, Simulation(preset()))]
    fallen, other = drive_all(pairs, Driving(run_up=0.2), workers=1)
    alone = drive(log, Simulation(tall), Driving(run_up=0.2))
    assert fallen.condition is Condition.ROLLED_OVER
    np.testing.assert_array_equal(fallen.signals["roll"], alone.signals["roll"])
    assert len(fallen.steering) < len(other.steering) == len(log.time)
