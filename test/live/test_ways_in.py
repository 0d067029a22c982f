"""Messages of standard types as commands, and two ways in for one quantity at once."""

import math
from types import SimpleNamespace as Fields

import pytest

from vehicle_roll_sim import Command, InputError, Simulation, preset
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.live.status import command_troubles, command_values
from vehicle_roll_sim.live.ways_in import JOINTS, PARTS, ackermann_parts, joint_parts, twist_parts
from vehicle_roll_sim.messages.joints import SUSPENSION, WHEEL, joint_motion, joint_names
from vehicle_roll_sim.model.records import WHEELS

WHEELBASE = preset().wheelbase
NAN = math.nan
PERIOD_NS = 10_000_000
TIMEOUT_NS = 500_000_000


def ackermann(angle=0.0, speed=0.0, **others):
    drive = {"steering_angle_velocity": 0.0, "acceleration": 0.0, "jerk": 0.0}
    return Fields(drive=Fields(steering_angle=angle, speed=speed, **drive | others))


def twist(x=0.0, y=0.0, z=0.0, roll=0.0, pitch=0.0, yaw=0.0):
    linear, angular = Fields(x=x, y=y, z=z), Fields(x=roll, y=pitch, z=yaw)
    return Fields(twist=Fields(linear=linear, angular=angular))


def joints(name=(), position=(), velocity=(), effort=()):
    return Fields(name=name, position=position, velocity=velocity, effort=effort)


def session_of(speed: float = 10.0, timeout: float = 0.5) -> Session:
    return Session(Simulation(preset()), CommandInbox(timeout), PERIOD_NS, speed)


def test_an_ackermann_drive_is_an_angle_and_a_speed():
    parts = ackermann_parts(ackermann(0.1, 12.0), WHEELBASE)
    assert parts == {"steering_cmd": (0.1,), "speed_cmd": (12.0,)}


@pytest.mark.parametrize("field", ["steering_angle_velocity", "acceleration", "jerk"])
@pytest.mark.parametrize("value", [1.0, NAN])
def test_what_an_ackermann_drive_asks_beyond_that_is_refused_by_its_name(field, value):
    with pytest.raises(InputError, match=f"drive.{field}: {value} is not allowed"):
        ackermann_parts(ackermann(0.1, 12.0, **{field: value}), WHEELBASE)


@pytest.mark.parametrize("speed", [8.0, 0.5, -3.0])
@pytest.mark.parametrize("rate", [0.3, 0.0, -0.2])
def test_a_twist_is_the_angle_of_the_kinematic_bicycle(speed, rate):
    """Which turns about the point on the line of the rear axle, at v / r from its middle."""
    parts = twist_parts(twist(x=speed, yaw=rate), WHEELBASE)
    (angle,) = parts["steering_cmd"]
    assert parts["speed_cmd"] == (speed,)
    assert speed * math.tan(angle) / WHEELBASE == pytest.approx(rate)
    assert abs(angle) < math.pi / 2


def test_a_vehicle_that_is_driven_by_a_twist_takes_that_yaw_rate():
    """At 3 m/s, where the tires hardly slip: by 2 % at an acceleration of 0.45 m/s^2."""
    session = session_of(speed=3.0, timeout=0.0)
    session.inbox.receive_parts("cmd_vel", twist_parts(twist(x=3.0, yaw=0.15), WHEELBASE), 0)
    for _ in range(600):
        session.run_period()
    assert session.simulation.state["u"] == pytest.approx(3.0, abs=0.02)
    assert session.simulation.state["yaw_rate"] == pytest.approx(0.15, rel=0.02)


@pytest.mark.parametrize(
    "message",
    [
        twist(x=1.0, y=0.1),
        twist(z=0.1),
        twist(x=1.0, roll=0.1),
        twist(x=1.0, pitch=NAN),
        twist(yaw=0.1),
        twist(yaw=NAN),
    ],
)
def test_what_no_car_can_do_is_refused(message):
    with pytest.raises(InputError, match=r"linear\.|angular\."):
        twist_parts(message, WHEELBASE)


def test_a_twist_of_0_is_a_stop_straight_ahead():
    parts = twist_parts(twist(), WHEELBASE)
    assert parts == {"steering_cmd": (0.0,), "speed_cmd": (0.0,)}


STEERING_JOINTS = ("lf_steering_joint", "rf_steering_joint", "lr_steering_joint")
MIXED = ("lf_steering_joint", "rf_steering_joint", "rr_wheel_joint", "lf_suspension_joint")


@pytest.mark.parametrize(
    ("message", "parts"),
    [
        (
            joints(STEERING_JOINTS, (0.1, 0.2, -0.05)),
            {"steering_cmd": (pytest.approx(0.15),), "rear_steering_cmd": (-0.05,)},
        ),
        (
            joints(STEERING_JOINTS, (NAN, 0.2, NAN)),
            {"steering_cmd": (0.2,)},
        ),
        (
            joints(("lr_wheel_joint", "rr_wheel_joint"), effort=(30.0, 40.0)),
            {"wheel_torque_cmd": (0.0, 0.0, 30.0, 40.0)},
        ),
        (
            joints(("lf_suspension_joint",), effort=(500.0,)),
            {"normal_force_cmd": (-500.0, 0.0, 0.0, 0.0)},
        ),
        (
            joints(MIXED, (0.1, 0.1, NAN, NAN), (NAN,) * 4, (NAN, NAN, 7.0, 9.0)),
            {
                "steering_cmd": (0.1,),
                "wheel_torque_cmd": (0.0, 0.0, 0.0, 7.0),
                "normal_force_cmd": (-9.0, 0.0, 0.0, 0.0),
            },
        ),
        (
            joints(MIXED, (0.1, 0.1), (), (7.0, 9.0)),
            {
                "steering_cmd": (0.1,),
                "wheel_torque_cmd": (0.0, 0.0, 0.0, 7.0),
                "normal_force_cmd": (-9.0, 0.0, 0.0, 0.0),
            },
        ),
    ],
)
def test_joints_are_commanded_as_hardware_of_ros2_control_sends_them(message, parts):
    """With nan where a joint takes no such command, or without these values."""
    assert joint_parts(message, WHEELBASE) == parts


@pytest.mark.parametrize(
    ("message", "words"),
    [
        (joints(), "nothing is commanded"),
        (joints(("lf_steering_joint",)), "nothing is commanded"),
        (joints(("lf_steering_joint",), (NAN,)), "nothing is commanded"),
        (joints(("boom_joint",), (0.1,)), "name: 'boom_joint'"),
        (joints(("lf_camber_joint",), (0.1,)), "name: 'lf_camber_joint'"),
        (joints(("lf_wheel_joint",) * 2, effort=(1.0, 2.0)), "each once"),
        (joints(("lf_wheel_joint",), effort=(1.0, 2.0)), "effort: 2 values"),
        (joints(("lf_wheel_joint",), velocity=(1.0,), effort=(1.0,)), "velocity: 1.0"),
        (joints(("lf_wheel_joint",), (0.5,), effort=(1.0,)), "position of lf_wheel_joint"),
        (joints(("lf_steering_joint",), (0.5,), effort=(1.0,)), "effort of lf_steering_joint"),
    ],
)
def test_joints_that_cannot_be_commanded_so_are_refused_in_one_line(message, words):
    with pytest.raises(InputError) as refusal:
        joint_parts(message, WHEELBASE)
    assert words in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_the_joints_are_those_of_joint_states():
    assert set(JOINTS) == set(joint_names(("suspension", "steering", "wheel")))


@pytest.mark.parametrize(("kind", "effort"), [(SUSPENSION, 400.0), (WHEEL, 100.0)])
def test_a_positive_effort_moves_its_joint_forward(kind, effort):
    """As an effort does by definition: from rest, its joint gains velocity along it."""
    simulation = Simulation(preset())
    names = joint_names(("suspension", "steering", "wheel"))
    inbox = CommandInbox()
    name = f"lr_{kind}_joint"
    inbox.receive_parts("joint_commands", joint_parts(joints((name,), effort=(effort,)), 0.0), 0)
    simulation.step(inbox.command(0), 0.01)
    free = Simulation(preset())
    free.step(Command(), 0.01)
    gained = joint_motion(simulation)[1] - joint_motion(free)[1]
    assert gained[names.index(name)] > 1e-3
    assert abs(gained).argmax() == names.index(name)


WAYS = {
    "ackermann_cmd": ackermann(0.05, 11.0),
    "cmd_vel": twist(x=11.0, yaw=0.1),
    "joint_commands": joints(("lf_steering_joint", "lr_wheel_joint"), (0.05,), (), (20.0,)),
}
OWN = {
    "steering_cmd": (0.02,),
    "speed_cmd": (9.0,),
    "wheel_torque_cmd": (1.0, 2.0, 3.0, 4.0),
}
SHARED = {
    ("steering_cmd", "ackermann_cmd"): "steering",
    ("speed_cmd", "ackermann_cmd"): "speed",
    ("steering_cmd", "cmd_vel"): "steering",
    ("speed_cmd", "cmd_vel"): "speed",
    ("steering_cmd", "joint_commands"): "steering",
    ("wheel_torque_cmd", "joint_commands"): "wheel_torque",
    ("ackermann_cmd", "cmd_vel"): "steering",
    ("ackermann_cmd", "joint_commands"): "steering",
    ("cmd_vel", "joint_commands"): "steering",
}
"""Two ways in, and the first quantity that they have in common."""
BOTH_WAYS = [pair for first in SHARED for pair in (first, first[::-1])]


def receive(inbox: CommandInbox, topic: str, now_ns: int) -> str:
    if topic in WAYS:
        return inbox.receive_parts(topic, PARTS[topic](WAYS[topic], WHEELBASE), now_ns)
    return inbox.receive(topic, OWN[topic], now_ns)


@pytest.mark.parametrize(("first", "second"), BOTH_WAYS)
def test_of_two_ways_in_the_second_is_refused_by_name_until_the_first_has_expired(first, second):
    inbox = CommandInbox(timeout=0.5)
    assert receive(inbox, first, 0) == ""
    command, total = inbox.command(0), inbox.total("speed_cmd", 0)
    problem = receive(inbox, second, TIMEOUT_NS)
    quantity = SHARED.get((first, second)) or SHARED[second, first]
    assert f"{second} is refused while {first} commands {quantity}" in problem
    traffic = inbox.topics[second]
    assert (traffic.received, traffic.dropped, traffic.answered) == (1, 1, True)
    assert (inbox.command(0), inbox.total("speed_cmd", 0)) == (command, total)
    assert receive(inbox, first, TIMEOUT_NS) == ""
    assert receive(inbox, second, 2 * TIMEOUT_NS + 1) == ""
    assert receive(inbox, first, 2 * TIMEOUT_NS + 1).startswith("message dropped")


def test_ways_in_for_different_quantities_go_together():
    inbox = CommandInbox()
    forces = joints(("lf_suspension_joint",), effort=(-300.0,))
    assert receive(inbox, "ackermann_cmd", 0) == ""
    assert inbox.receive_parts("joint_commands", joint_parts(forces, WHEELBASE), 0) == ""
    assert inbox.receive("rear_steering_cmd", [0.01], 0) == ""
    expected = Command(0.05, 0.01, normal_force=(300.0, 0.0, 0.0, 0.0))
    assert inbox.command(0) == expected
    assert inbox.total("speed_cmd", 0) == 11.0


def test_after_a_reset_any_way_in_may_be_the_first():
    session = session_of()
    receive(session.inbox, "ackermann_cmd", 0)
    session.reset(10.0)
    assert receive(session.inbox, "cmd_vel", 0) == ""


def test_a_message_is_taken_as_a_whole_or_not_at_all():
    inbox = CommandInbox()
    inbox.receive("speed_cmd", (9.0,), 0)
    assert "commands speed" in receive(inbox, "ackermann_cmd", 0)
    assert inbox.command(0) == Command()
    flaw = inbox.receive_parts("cmd_vel", {"steering_cmd": (0.1,), "speed_cmd": (math.inf,)}, 0)
    assert "speed: [inf]: every value must be finite" in flaw
    assert inbox.command(0) == Command()


def test_limits_and_timeouts_are_those_of_the_commands():
    session = session_of()
    session.inbox.limits.steering_limit, session.inbox.limits.speed_limit = 0.1, 15.0
    parts = ackermann_parts(ackermann(0.5, 30.0), WHEELBASE)
    problem = session.inbox.receive_parts("ackermann_cmd", parts, 0)
    assert problem == "clamped: 0.5 is beyond steering_limit, 0.1 rad"
    assert session.inbox.ways["ackermann_cmd"].clamped == 1
    session.run_period()
    assert session.applied.steering == 0.1
    assert session.inbox.total("speed_cmd", PERIOD_NS) == 15.0
    for _ in range(60):
        session.run_period()
    assert session.inbox.total("speed_cmd", session.simulation.time_ns) is None
    assert session.applied.steering == 0.1  # the policy holds it
    troubles = command_troubles(session, {})
    assert troubles == [
        "ackermann_cmd: no message within 0.5 s of simulation: steering follows the policy hold",
        "ackermann_cmd: no message within 0.5 s of simulation: no speed is held",
    ]


def test_wheel_efforts_have_priority_over_a_speed_like_wheel_torques():
    session = session_of()
    session.inbox.receive("speed_cmd", (9.0,), 0)
    receive(session.inbox, "joint_commands", 0)
    assert session.inbox.total("speed_cmd", 0) is None
    expected = "speed_cmd: ignored while joint_commands is commanded"
    assert command_troubles(session, {}) == [expected]


def test_a_way_in_can_be_awaited_and_has_its_counts_in_the_diagnostics():
    session = session_of()
    topics = ["cmd_vel", "normal_force_cmd"]
    assert session.inbox.unanswered(topics) == topics
    session.inbox.drop("cmd_vel", "linear.y: 1.0 is not allowed: 0")
    assert session.inbox.unanswered(topics) == ["normal_force_cmd"]
    told = command_values(session, {"cmd_vel": ["/teleop"]})
    assert told["cmd_vel dropped"] == "1"
    assert told["cmd_vel last problem"] == "message dropped: linear.y: 1.0 is not allowed: 0"
    assert told["cmd_vel age (s)"] == "none"
    assert told["cmd_vel publisher names"] == "/teleop"
    assert "ackermann_cmd received" not in told  # nothing subscribes to it
    session.run_period()
    receive(session.inbox, "cmd_vel", session.simulation.time_ns)
    session.run_period()
    told = command_values(session, {"cmd_vel": []})
    assert told["cmd_vel age (s)"] == "0.010"
    assert told["steering_cmd age (s)"] == "none"  # nothing has come on that topic


def test_the_way_that_a_quantity_was_commanded_in_is_part_of_a_snapshot():
    session, other = session_of(), session_of()
    receive(session.inbox, "ackermann_cmd", 0)
    other.restore(session.snapshot())
    for each in (session, other):
        assert "ackermann_cmd commands steering" in receive(each.inbox, "cmd_vel", 0)
    assert other.snapshot() == session.snapshot()


def test_every_wheel_is_an_end_of_some_joint():
    assert {wheel for wheel, _ in JOINTS.values()} == set(WHEELS)
