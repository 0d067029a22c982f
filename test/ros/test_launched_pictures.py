"""What the launch file of RViz has shown, and by which clock."""

from pathlib import Path

import launch_files
import pytest
from launch_files import actions_of

from vehicle_roll_sim import preset
from vehicle_roll_sim.messages.urdf import urdf


@pytest.mark.parametrize(("model", "suspended"), [("", True), ("1a", True), ("8dof", False)])
def test_rviz_is_shown_the_vehicle_that_is_simulated(launching, model, suspended):
    actions = actions_of("rviz", model=model)
    (parameters,) = actions["robot_state_publisher"].parameters
    description = parameters["robot_description"]
    assert description.value == urdf(preset(), suspended)
    assert description.value_type is str
    (shown,) = (Path(word) for word in actions["rviz2"].cmd if word.endswith(".rviz"))
    assert shown.samefile(launch_files.PACKAGE / "config" / "vehicle.rviz")


@pytest.mark.parametrize(
    ("given", "simulated"),
    [({}, False), ({"lockstep": "true"}, True), ({"real_time_factor": "0.5"}, True)],
)
def test_pictures_go_by_the_clock_of_the_simulator(launching, given, simulated):
    actions = actions_of("rviz", **given)
    for name in ("robot_state_publisher", "rviz2"):
        assert actions[name].parameters[0]["use_sim_time"] is simulated


def test_pictures_can_do_without_rviz(launching):
    assert "rviz2" not in actions_of("rviz", rviz="false")
