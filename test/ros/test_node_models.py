"""The node takes the same models as the command line."""

import pytest
from std_srvs.srv import Trigger

from vehicle_roll_sim import Options, Simulation, preset
from vehicle_roll_sim.ros.topics import STATE_SET


@pytest.mark.parametrize("model", ["1", "1c-iii"])
def test_the_chosen_model_publishes_every_topic(start, peer, model):
    start("simulator", "--ros-args", "-p", f"model:={model}", "-p", "command_timeout:=0.0")
    names = [topic.name for topic in STATE_SET]
    peer.listen(*names)
    for name in names:
        peer.newest(name)
    peer.call(Trigger, "simulator/reset")
    start_of_run = Simulation(preset(), Options(model=model)).state_vector[:28]
    states = peer.received["state"]
    peer.wait(
        lambda: any(list(m.data[1:]) == list(start_of_run) for _, m in states), "the initial state"
    )


def test_a_combination_that_is_not_defined_ends_it_with_one_line(start):
    words = ("-p", "model:=1a", "-p", "euler_terms:=true")
    status, _, err = start("simulator", "--ros-args", *words).finish()
    assert status == 2
    assert len(err.splitlines()) == 1
    assert "euler_terms" in err
