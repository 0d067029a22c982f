"""Every topic of the package: name, type and quality of service. Nodes and bags read it here."""

import dataclasses

from vehicle_roll_sim.live.command_inbox import channels
from vehicle_roll_sim.model.records import WHEELS


@dataclasses.dataclass(frozen=True)
class Topic:
    """A topic: reliable, keep last `depth`; latched ones are transient local, others volatile."""

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
"""What the simulator listens to; the depth is that of a publisher of this package."""
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
"""What is published every period, in this order: a set begins with its `state`."""
STAMPED_ENDING = "_stamped"
STAMPED = tuple(
    Topic(topic.name + STAMPED_ENDING, JOINTS)
    for topic in STATE_SET
    if topic.type in (FLOAT, ARRAY, FLAGS)
)
"""Of the set too, where they are asked for: what has no header, with one, every number by name.

A JointState is the one message of ROS with a header and numbers that bear names, and tools to plot
and to read bags show it by them."""
TRANSFORMS = Topic("/tf", "tf2_msgs/msg/TFMessage")
"""Of the set too, where its type is installed."""
CLOCK = Topic("/clock", "rosgraph_msgs/msg/Clock")
"""Before each set, where stamps are simulated time."""
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
