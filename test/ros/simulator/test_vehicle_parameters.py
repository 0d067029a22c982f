"""A simulator's vehicle from its parameters: roll centres and implausible values."""

import pytest
import rclpy
from rclpy.context import Context

from vehicle_roll_sim import InputError
from vehicle_roll_sim.ros.clients.simulated_vehicle import simulated_vehicle
from vehicle_roll_sim.ros.simulator.node import Simulator

HEIGHT, DEPTH = "vehicle.front_roll_centre_height", "vehicle.front_roll_centre_depth"


@pytest.fixture
def simulator(domain):
    """simulator(*assignments): a simulator with these parameters."""
    context, nodes = Context(), []
    rclpy.init(context=context, domain_id=domain)

    def make(*assignments: str) -> Simulator:
        words = [word for each in assignments for word in ("-p", each)]
        nodes.append(Simulator(context=context, cli_args=["--ros-args", *words]))
        return nodes[-1]

    yield make
    for node in nodes:
        node.destroy_node()
    rclpy.shutdown(context=context)


def test_a_roll_centre_is_the_parameter_that_was_given_alone(simulator):
    """So that a dump of the parameters can be loaded."""
    node = simulator(f"{HEIGHT}:=0.2")
    assert node.get_parameter(HEIGHT).value == 0.2
    assert not node.has_parameter(DEPTH)
    assert node.get_parameter("vehicle.rear_roll_centre_depth").value == 0.6
    assert node.session.simulation.vehicle.roll_centre_depth[0] == 0.75 - 0.2
    with pytest.raises(
        InputError, match=f"^{DEPTH}: 0.65 together with front_roll_centre_height 0.1"
    ):
        simulator(f"{HEIGHT}:=0.1", f"{DEPTH}:=0.65")


def test_another_node_reads_the_same_vehicle(simulator):
    node = simulator(f"{HEIGHT}:=0.2", "vehicle.cg_height:=0.7")

    def ask(names) -> list:
        """As the service answers: nothing where one of the names is not there."""
        there = all(node.has_parameter(name) for name in names)
        return [parameter.value for parameter in node.get_parameters(names)] if there else []

    vehicle, _ = simulated_vehicle(ask)
    assert vehicle.given == node.session.simulation.vehicle.given
    assert vehicle.record().tobytes() == node.session.simulation.vehicle.record().tobytes()


def test_strict_refuses_what_is_not_plausible(simulator):
    told = "strict: the vehicle is not plausible: vehicle.rear_damping: 0 N s/m gives a damping"
    with pytest.raises(InputError, match=f"^{told}"):
        simulator("vehicle.rear_damping:=0.0", "strict:=true")
    simulator("strict:=true")


def test_else_the_log_has_it_once_and_stderr_nothing_more(start, peer):
    node = start("simulator", "--ros-args", "-p", "vehicle.cg_height:=0.6")
    peer.listen("state")
    peer.newest("state")
    _, _, err = node.finish(2)
    told = "vehicle.front_roll_centre_depth: 0.65 m below a c.g. at 0.6 m puts the roll centre"
    assert err.count(told) == err.count("0.05 m below the road") == 1
    assert "[WARN]" in next(line for line in err.splitlines() if told in line)
