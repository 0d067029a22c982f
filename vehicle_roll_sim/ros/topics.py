"""Every topic of the package: name, type and quality of service. The nodes read it from here."""

import dataclasses
import importlib.util

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Bool, Float64, Float64MultiArray, String, UInt8MultiArray

from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.simulation.command_inbox import channels

SENT = QoSProfile(depth=10)
"""Of what the simulator publishes: reliable, volatile."""
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
NEWEST_ONLY = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
"""Of the command subscriptions: any publisher connects, and only its newest message counts."""
EVERY_ANSWER = QoSProfile(depth=1)
"""Of the command subscriptions in lockstep: reliable, so that no answer is lost."""
COMMANDING = QoSProfile(depth=1)
"""Of what publishes commands."""


@dataclasses.dataclass(frozen=True)
class Topic:
    name: str
    type: type
    latched: bool = False

    @property
    def publisher_qos(self) -> QoSProfile:
        return LATCHED if self.latched else SENT


COMMANDS = tuple(
    Topic(name, Float64 if channel.size == 1 else Float64MultiArray)
    for name, channel in channels().items()
)
STATE_SET = (
    Topic("state", Float64MultiArray),
    Topic("applied_command", Float64MultiArray),
    Topic("odom", Odometry),
    Topic("imu", Imu),
    Topic("joint_states", JointState),
    Topic("tire_normal_forces", Float64MultiArray),
    *(Topic(f"tire_forces/{wheel}", WrenchStamped) for wheel in WHEELS),
    Topic("lift_off", UInt8MultiArray),
    Topic("load_transfer_ratio", Float64),
)
"""What is published every period, in this order: a set begins with its `state`."""
ROLLOVER = Topic("rollover", Bool, latched=True)
ROBOT_DESCRIPTION = Topic("robot_description", String, latched=True)
DIAGNOSTICS = Topic("/diagnostics", DiagnosticArray)
CLOCK = Topic("/clock", Clock)


def _transforms() -> tuple[Topic, ...]:
    """/tf, where tf2_msgs is installed."""
    if importlib.util.find_spec("tf2_msgs") is None:
        return ()
    from tf2_msgs.msg import TFMessage  # only with a full ROS installation

    return (Topic("/tf", TFMessage),)


TRANSFORMS = _transforms()
PUBLISHED = (*STATE_SET, ROLLOVER, ROBOT_DESCRIPTION, DIAGNOSTICS, CLOCK, *TRANSFORMS)


def recording_qos(topic: Topic) -> QoSProfile:
    """For a subscription that wants every message of any publisher of the topic."""
    is_command = topic in COMMANDS
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=1000,
        reliability=ReliabilityPolicy.BEST_EFFORT if is_command else ReliabilityPolicy.RELIABLE,
        durability=topic.publisher_qos.durability,
    )
