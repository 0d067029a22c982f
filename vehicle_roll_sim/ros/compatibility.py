"""Partners on a topic that can never be connected: another type, or a quality of service too high.

The middleware would tell, by events that every wait of the node had to watch.
"""

from collections.abc import Iterator

from rclpy.node import Node
from rclpy.qos import QoSCompatibility, QoSProfile, qos_check_compatible
from rclpy.topic_endpoint_info import TopicEndpointInfo


def incompatible_partners(node: Node) -> list[str]:
    """One line for each subscription and publisher elsewhere that does not fit one of the node."""
    return [*_listeners(node), *_publishers(node)]


def _listeners(node: Node) -> Iterator[str]:
    for own in node.publishers:
        for other in node.get_subscriptions_info_by_topic(own.topic_name):
            reason = _mismatch(own.msg_type, other, own.qos_profile, other.qos_profile)
            if reason:
                yield f"{own.topic_name}: the subscription of {other.node_name}: {reason}"


def _publishers(node: Node) -> Iterator[str]:
    for own in node.subscriptions:
        for other in node.get_publishers_info_by_topic(own.topic_name):
            reason = _mismatch(own.msg_type, other, other.qos_profile, own.qos_profile)
            if reason:
                yield f"{own.topic_name}: the publisher of {other.node_name}: {reason}"


def _mismatch(kind: type, other: TopicEndpointInfo, offered: QoSProfile, wanted: QoSProfile) -> str:
    """Why two endpoints cannot be connected, or ''."""
    own_type = f"{kind.__module__.partition('.')[0]}/msg/{kind.__name__}"
    if other.topic_type != own_type:
        return f"{other.topic_type} is not {own_type}"
    verdict, reason = qos_check_compatible(offered, wanted)
    return reason if verdict == QoSCompatibility.ERROR else ""
