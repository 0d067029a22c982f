"""The other endpoints on a topic: which nodes own them, and which can never be connected.

Endpoints cannot be connected if their types differ or their QoS is incompatible. The middleware
could report this through events, but these would add to the cost of every wait.
"""

from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSCompatibility, qos_check_compatible
from rclpy.topic_endpoint_info import TopicEndpointInfo

from vehicle_roll_sim.messages.topic import Topic
from vehicle_roll_sim.ros.topics import heard_commands

UNNAMED = "_NODE_NAME_UNKNOWN_"
"""Node name of an endpoint that was discovered before its node, or that is not a ROS endpoint."""

NAMELESS = "a node of unknown name"


def incompatible_partners(node: Node) -> list[str]:
    """One line for each remote publisher or subscription that is incompatible with one of `node`.

    Endpoints whose node is not known yet are left to the next call, so that none is reported twice.
    """
    topics = {own.topic_name for own in (*node.publishers, *node.subscriptions)}
    misfits = []
    for topic in sorted(topics):
        listeners = node.get_subscriptions_info_by_topic(topic)
        for publisher in node.get_publishers_info_by_topic(topic):
            for listener in listeners:
                reason = _mismatch(publisher, listener)
                if reason and _is_of(node, publisher):
                    misfits.append(f"{topic}: the subscription of {listener.node_name}: {reason}")
                elif reason and _is_of(node, listener):
                    misfits.append(f"{topic}: the publisher of {publisher.node_name}: {reason}")
    return misfits


def other_publishers(node: Node, topic: Topic) -> list[str]:
    """Full names of the nodes that publish a topic, one for each publisher except that of `node`.

    Two nodes may have the same name, so a name alone does not identify a publisher's owner.
    Publishers whose node is not known yet are left to the next call.
    """
    name = node.resolve_topic_name(topic.name)
    found = node.get_publishers_info_by_topic(name)
    names = [
        _full_name(each)
        for each in found
        if each.topic_type == topic.type and each.node_name != UNNAMED
    ]
    if any(own.topic_name == name for own in node.publishers):
        own_name = node.get_fully_qualified_name()
        if own_name in names:
            names.remove(own_name)
    return sorted(names)


def command_publishers(node: Node) -> dict[str, list[str]]:
    """`other_publishers` of every command topic, by topic name."""
    return {topic.name: other_publishers(node, topic) for topic in heard_commands()}


def publishers_of(node: Node, topic: str) -> list[str]:
    """Full names of the nodes that publish `topic`, which is a full name as well."""
    return sorted(map(_full_name, node.get_publishers_info_by_topic(topic)))


def fitting_listeners(node: Node, publisher: Publisher) -> int:
    """The number of known subscriptions that are compatible with a publisher of `node`."""
    topic = publisher.topic_name
    own = [each for each in node.get_publishers_info_by_topic(topic) if _is_of(node, each)]
    listeners = node.get_subscriptions_info_by_topic(topic)
    return sum(not any(_mismatch(each, listener) for each in own) for listener in listeners)


def _full_name(endpoint: TopicEndpointInfo) -> str:
    if endpoint.node_name == UNNAMED:
        return NAMELESS
    return f"{endpoint.node_namespace.rstrip('/')}/{endpoint.node_name}"


def _is_of(node: Node, endpoint: TopicEndpointInfo) -> bool:
    name, namespace = endpoint.node_name, endpoint.node_namespace
    return (name, namespace) == (node.get_name(), node.get_namespace())


def _mismatch(publisher: TopicEndpointInfo, listener: TopicEndpointInfo) -> str:
    """Why two endpoints cannot be connected, or '' (also while the node of one is not known)."""
    if UNNAMED in (publisher.node_name, listener.node_name):
        return ""
    if publisher.topic_type != listener.topic_type:
        return f"published as {publisher.topic_type}, subscribed as {listener.topic_type}"
    verdict, reason = qos_check_compatible(publisher.qos_profile, listener.qos_profile)
    return reason.rstrip(";") if verdict == QoSCompatibility.ERROR else ""
