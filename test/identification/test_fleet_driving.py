"""Models that are driven together do what each does alone, bit for bit."""

import numpy as np
import pytest

from benchmarks.hidden_vehicles import log_of_run
from vehicle_roll_sim import Options, Simulation, preset
from vehicle_roll_sim.comparison.driving import Driving, drive
from vehicle_roll_sim.identification.fleet_driving import drive_all
from vehicle_roll_sim.model.integration.events import Condition


@pytest.mark.parametrize("driving", [Driving(run_up=0.3), Driving(drive_by="torques", run_up=0.2)])
def test_each_model_does_what_it_does_alone(driving):
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
