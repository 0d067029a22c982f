"""A topic: its name, type, QoS, unit and meaning; the types that several topics have."""

import dataclasses


@dataclasses.dataclass(frozen=True)
class Topic:
    """A topic: reliable, keep last `depth`, and more in lockstep (`ros.topics.offered_qos`);
    transient local if latched, else volatile.

    unit: that of its values, '' if they have none or several. meaning: what it carries, in one
    phrase; a value for each wheel is in the order lf, rf, lr, rr.
    """

    name: str
    type: str
    latched: bool = False
    depth: int = 10
    unit: str = dataclasses.field(default="", compare=False)
    meaning: str = dataclasses.field(default="", compare=False)


FLOAT, ARRAY = "std_msgs/msg/Float64", "std_msgs/msg/Float64MultiArray"
FLAGS, TEXT = "std_msgs/msg/UInt8MultiArray", "std_msgs/msg/String"
JOINTS = "sensor_msgs/msg/JointState"
WRENCH = "geometry_msgs/msg/WrenchStamped"
