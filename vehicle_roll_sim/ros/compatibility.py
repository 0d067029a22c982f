"""Partners on a topic: who they are, and which can never be connected.

Those are of another type, or want too high a quality of service. The middleware would tell, by
events that every wait of the node had to watch.
"""

from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSCompatibility, qos_check_compatible
from rclpy.topic_endpoint_info import TopicEndpointInfo

from vehicle_roll_sim.messages.topics import COMMANDS, Topic

UNNAMED = "_NODE_NAME_UNKNOWN_"
"""Node of an endpoint that was discovered before its node was, or that is not of ROS."""

NAMELESS = "a node whose name is not known"


def incompatible_partners(node: Node) -> list[str]:
    """One line for each publisher and subscription elsewhere that does not fit one of the node.

    Those whose node is not known yet are left to the next look, so that none is told twice.
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
    """Full names of the nodes that publish a topic, once for each publisher but that of `node`.

    Two nodes may have one name, so the name alone does not tell whose a publisher is. Those whose
    node is not known yet are left to the next look.
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
    """`other_publishers` of every command, by topic."""
    return {topic.name: other_publishers(node, topic) for topic in COMMANDS}


def publishers_of(node: Node, topic: str) -> list[str]:
    """Full names of the nodes that publish a topic, given by its full name."""
    return sorted(map(_full_name, node.get_publishers_info_by_topic(topic)))


def fitting_listeners(node: Node, publisher: Publisher) -> int:
    """How many subscriptions there are, as far as is known, that a publisher of `node` fits."""
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
    """Why two endpoints cannot be connected, or '' (also where one has no node yet)."""
    if UNNAMED in (publisher.node_name, listener.node_name):
        return ""
    if publisher.topic_type != listener.topic_type:
        return f"{publisher.topic_type} is published, {listener.topic_type} listened to"
    verdict, reason = qos_check_compatible(publisher.qos_profile, listener.qos_profile)
    return reason.rstrip(";") if verdict == QoSCompatibility.ERROR else ""
