"""The node takes commands of other packages' types; what it cannot use is told of and dropped."""

import pytest
from geometry_msgs.msg import TwistStamped
from rclpy.parameter import Parameter
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

from vehicle_roll_sim import InputError
from vehicle_roll_sim.messages.command_topics import WAYS_IN
from vehicle_roll_sim.ros.simulator.node import Simulator
from vehicle_roll_sim.ros.topics import is_installed

ACKERMANN = WAYS_IN[0]


@pytest.fixture
def simulator(context):
    """A simulator that nothing spins, after its first set; `warned` has what it logs."""
    node = Simulator(context=context)
    node.begin()
    yield node
    node.destroy_node()


@pytest.fixture
def warned(simulator, monkeypatch):
    said = []

    class Logger:
        warning = said.append

    monkeypatch.setattr(simulator, "get_logger", Logger)
    return said


def send(simulator, topic: str, message) -> None:
    (found,) = (s for s in simulator.subscriptions if s.topic_name == f"/{topic}")
    assert isinstance(message, found.msg_type)
    found.callback(message)


def twist(speed: float, rate: float, across: float = 0.0) -> TwistStamped:
    message = TwistStamped()
    message.twist.linear.x, message.twist.linear.y = speed, across
    message.twist.angular.z = rate
    return message


def test_a_twist_and_joints_drive_the_vehicle(simulator, warned):
    wheelbase = simulator.session.simulation.vehicle.wheelbase
    forces = JointState(name=["lf_suspension_joint"], effort=[-100.0])
    send(simulator, "cmd_vel", twist(20.0, 0.2))
    send(simulator, "joint_commands", forces)
    simulator.run_period()
    applied = simulator.session.applied
    assert applied.steering == pytest.approx(wheelbase * 0.2 / 20.0, rel=1e-3)
    assert applied.normal_force == (100.0, 0.0, 0.0, 0.0)
    assert min(applied.wheel_torque) > 0.0  # towards 20 m/s
    assert warned == []


def test_a_message_that_cannot_be_used_is_told_of_with_its_field(simulator, warned):
    send(simulator, "cmd_vel", twist(20.0, 0.2, across=0.5))
    send(simulator, "joint_commands", JointState(name=["boom"], position=[0.1]))
    assert [line.partition(": message dropped: ")[0] for line in warned] == [
        "cmd_vel",
        "joint_commands",
    ]
    assert "linear.y: 0.5" in warned[0]
    assert "'boom'" in warned[1]
    assert simulator.session.inbox.ways["cmd_vel"].dropped == 1


def test_a_second_way_in_is_refused_with_a_warning_that_names_both(simulator, warned):
    send(simulator, "steering_cmd", Float64(data=0.02))
    send(simulator, "cmd_vel", twist(20.0, 0.2))
    expected = "message dropped: steering: cmd_vel is refused while steering_cmd commands steering"
    assert warned == [f"cmd_vel: {expected}"]
    simulator.run_period()
    assert simulator.session.applied.steering == 0.02


def test_lockstep_waits_for_a_way_in_as_for_any_command(context):
    overrides = [
        Parameter("mode", value="lockstep"),
        Parameter("lockstep_topics", value=["cmd_vel"]),
    ]
    node = Simulator(context=context, parameter_overrides=overrides)
    node.begin()
    inbox = node.session.inbox
    assert inbox.unanswered(node.driver.topics) == ["cmd_vel"]
    assert node.missing_partners(["cmd_vel"], []) == ["a publisher on cmd_vel"]
    send(node, "cmd_vel", twist(10.0, 0.0, across=1.0))  # a malformed answer is one
    assert inbox.unanswered(node.driver.topics) == []
    node.destroy_node()


@pytest.mark.skipif(is_installed(ACKERMANN), reason="ackermann_msgs is installed")
def test_without_ackermann_msgs_nothing_listens_and_lockstep_on_it_is_refused(simulator, context):
    assert not [s for s in simulator.subscriptions if s.topic_name.endswith(ACKERMANN.name)]
    overrides = [Parameter("lockstep_topics", value=[ACKERMANN.name])]
    with pytest.raises(InputError, match="ackermann_cmd needs ackermann_msgs"):
        Simulator(context=context, parameter_overrides=overrides)


@pytest.mark.skipif(not is_installed(ACKERMANN), reason="ackermann_msgs is not installed")
def test_an_ackermann_drive_drives_the_vehicle(simulator):
    from ackermann_msgs.msg import AckermannDriveStamped

    message = AckermannDriveStamped()
    message.drive.steering_angle, message.drive.speed = 0.05, 20.0
    send(simulator, ACKERMANN.name, message)
    simulator.run_period()
    assert simulator.session.applied.steering == pytest.approx(0.05)
