"""Every use of the session holds the simulator's lock, also by messages and services."""

import pytest
import rclpy
from rclpy.parameter import Parameter
from std_msgs.msg import Float64
from std_srvs.srv import SetBool, Trigger

from vehicle_roll_sim.ros.simulator.node import Simulator
from vehicle_roll_sim.ros.simulator.settings import Settings


@pytest.fixture
def simulator(domain):
    """A simulator that nothing spins."""
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain)
    node = Simulator(context=context)
    yield node
    node.destroy_node()
    rclpy.shutdown(context=context)


@pytest.fixture
def held(simulator, monkeypatch):
    """What has been done to the session or its settings, and whether the lock was held for it."""
    seen = {}

    def watch(owner, name):
        done = getattr(owner, name)

        def watched(*arguments):
            seen[name] = simulator.lock.locked()
            return done(*arguments)

        monkeypatch.setattr(owner, name, watched)

    watch(simulator.session.inbox, "receive")
    watch(simulator.session, "reset")
    watch(simulator.session, "run_period")
    watch(simulator.session, "snapshot")
    watch(simulator.session, "restore")
    watch(Settings, "__setattr__")
    return seen


def service(simulator, name: str):
    """The callback of a service of the node."""
    (found,) = (each for each in simulator.services if each.srv_name.endswith(f"/{name}"))
    return found.callback


def test_messages_and_requests_wait_for_the_lock(simulator, held):
    steering, *_ = (s for s in simulator.subscriptions if s.topic_name.endswith("/steering_cmd"))
    steering.callback(Float64(data=0.1))
    simulator.begin()
    service(simulator, "pause")(SetBool.Request(data=True), SetBool.Response())
    assert service(simulator, "step")(Trigger.Request(), Trigger.Response()).success
    for name in ("reset", "save", "restore"):
        assert service(simulator, name)(Trigger.Request(), Trigger.Response()).success
    done = ("receive", "run_period", "reset", "snapshot", "restore", "__setattr__")
    assert held == dict.fromkeys(done, True)
    assert not simulator.lock.locked()


def test_changes_of_parameters_wait_for_the_lock(simulator, held):
    (result,) = simulator.set_parameters([Parameter("command_timeout", value=0.1)])
    assert result.successful
    assert held == {"__setattr__": True}
    assert not simulator.lock.locked()
