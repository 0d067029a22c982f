"""Every topic of the package: name, type and QoS. Nodes and bags take them from here."""

import dataclasses

from vehicle_roll_sim.live.command_inbox import channels
from vehicle_roll_sim.model.records import WHEELS


@dataclasses.dataclass(frozen=True)
class Topic:
    """A topic: reliable, keep last `depth`; transient local if latched, else volatile."""

    name: str
    type: str
    latched: bool = False
    depth: int = 10


FLOAT, ARRAY = "std_msgs/msg/Float64", "std_msgs/msg/Float64MultiArray"
FLAGS, TEXT = "std_msgs/msg/UInt8MultiArray", "std_msgs/msg/String"
JOINTS = "sensor_msgs/msg/JointState"
WRENCH = "geometry_msgs/msg/WrenchStamped"


def _latched(name: str, kind: str) -> Topic:
    return Topic(name, kind, latched=True, depth=1)


COMMANDS = tuple(
    Topic(name, FLOAT if channel.size == 1 else ARRAY, depth=1)
    for name, channel in channels().items()
)
"""What the simulator subscribes to; the depth is that of publishers in this package."""
STATE_SET = (
    Topic("state", ARRAY),
    Topic("applied_command", ARRAY),
    Topic("odom", "nav_msgs/msg/Odometry"),
    Topic("imu", "sensor_msgs/msg/Imu"),
    Topic("joint_states", JOINTS),
    Topic("tire_normal_forces", ARRAY),
    *(Topic(f"tire_forces/{wheel}", WRENCH) for wheel in WHEELS),
    Topic("lift_off", FLAGS),
    Topic("load_transfer_ratio", FLOAT),
    Topic("motion", ARRAY),
)
"""The topics of a set, which is published every period in this order, beginning with `state`."""
STAMPED_ENDING = "_stamped"
STAMPED = tuple(
    Topic(topic.name + STAMPED_ENDING, JOINTS)
    for topic in STATE_SET
    if topic.type in (FLOAT, ARRAY, FLAGS)
)
"""Also part of the set with `publish_stamped`: topics without a header, with a header and names.

JointState is the only standard message with a header and named numbers, and plotting and bag tools
show the numbers by these names."""
TRANSFORMS = Topic("/tf", "tf2_msgs/msg/TFMessage")
"""Also part of the set, if its type is installed."""
CLOCK = Topic("/clock", "rosgraph_msgs/msg/Clock")
"""Published before each set, if stamps are simulated time."""
ROLLOVER = _latched("rollover", "std_msgs/msg/Bool")
ROBOT_DESCRIPTION = _latched("robot_description", TEXT)
SIMULATION_DESCRIPTION = _latched("simulation_description", TEXT)
DIAGNOSTICS = Topic("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray")
PUBLISHED = (
    *STATE_SET,
    ROLLOVER,
    ROBOT_DESCRIPTION,
    SIMULATION_DESCRIPTION,
    DIAGNOSTICS,
    CLOCK,
    TRANSFORMS,
)
