"""QoS overrides as parameters, such as `qos_overrides./TOPIC.publisher.depth`.

Names and values are those of rclpy, which declares and applies them. They are checked here first,
so that no override is silently ignored and a wrong one is reported in one line.
"""

import copy
from collections.abc import Iterable, Mapping

from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSPolicyKind, QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.subscription import Subscription

from vehicle_roll_sim.declaration import InputError, unknown_name

PREFIX = "qos_overrides."
"""Prefix of the names of these parameters."""
PUBLISHER, SUBSCRIPTION = "publisher", "subscription"
CHOICES = {
    "history": ("keep_last", "keep_all", "system_default"),
    "reliability": ("reliable", "best_effort", "system_default", "best_available"),
    "durability": ("volatile", "transient_local", "system_default", "best_available"),
    "liveliness": ("automatic", "manual_by_topic", "system_default", "best_available"),
}
LEAST = {"depth": 1, "deadline": 0, "lifespan": 0, "liveliness_lease_duration": 0}
"""Smallest value of each integer policy: `depth` in messages, the others in ns (0: no limit)."""
POLICIES = {
    PUBLISHER: (*CHOICES, *LEAST),
    SUBSCRIPTION: (*CHOICES, *(name for name in LEAST if name != "lifespan")),
}
LOSSLESS = {"reliability": "reliable", "lifespan": 0}
"""Required values of these policies if no message may be lost."""


def refuse_wrong_overrides(
    node: Node,
    *,
    publishers: Iterable[str] = (),
    subscriptions: Iterable[str] = (),
    lossless: bool = False,
) -> None:
    """Raise InputError unless every override is one of a topic that `node` publishes or hears.

    lossless: also refuse overrides with which messages may be lost.
    """
    kinds: dict[str, list[str]] = {}
    for kind, names in ((PUBLISHER, publishers), (SUBSCRIPTION, subscriptions)):
        for name in names:
            kinds.setdefault(node.resolve_topic_name(name), []).append(kind)
    for name, parameter in node._parameter_overrides.items():  # no public access
        if name.startswith(PREFIX):
            policy = _checked_policy(name, kinds)
            _check_value(name, policy, parameter.value)
            if lossless and parameter.value != LOSSLESS.get(policy, parameter.value):
                allowed = f"{LOSSLESS[policy]}, because lockstep must not lose messages"
                raise InputError(name, parameter.value, allowed)


def _checked_policy(name: str, kinds: Mapping[str, list[str]]) -> str:
    """The policy that a parameter sets; raises InputError unless all parts of its name are known.

    kinds: the kinds of endpoint (publisher, subscription) that the node has, by full topic name.
    """
    parts = name.removeprefix(PREFIX).rsplit(".", 2)
    if len(parts) < 3:
        allowed = f"a name such as {PREFIX}/TOPIC.{PUBLISHER}.depth"
        raise InputError(name, "", allowed, "incomplete name")
    topic, kind, policy = parts
    if topic not in kinds:
        raise unknown_name(topic, sorted(kinds), name)
    if kind not in kinds[topic]:
        raise unknown_name(kind, kinds[topic], name)
    if policy not in POLICIES[kind]:
        raise unknown_name(policy, POLICIES[kind], name)
    return policy


def _check_value(name: str, policy: str, value) -> None:
    if policy in CHOICES:
        if value not in CHOICES[policy]:
            raise InputError(name, value, "one of " + ", ".join(CHOICES[policy]))
    elif type(value) is not int or value < LEAST[policy]:
        unit = "" if policy == "depth" else " ns, 0 for no limit"
        raise InputError(name, value, f"a whole number from {LEAST[policy]}{unit}")


def make_publisher(node: Node, kind: type, name: str, qos: QoSProfile, **options) -> Publisher:
    """A publisher of messages of a class; parameters may override its QoS."""
    overrides = _given(node, name, PUBLISHER)
    return node.create_publisher(
        kind, name, copy.copy(qos), qos_overriding_options=overrides, **options
    )


def make_subscription(
    node: Node, kind: type, name: str, callback, qos: QoSProfile, **options
) -> Subscription:
    """A subscription to messages of a class; parameters may override its QoS."""
    overrides = _given(node, name, SUBSCRIPTION)
    return node.create_subscription(
        kind, name, callback, copy.copy(qos), qos_overriding_options=overrides, **options
    )


def _given(node: Node, topic: str, kind: str) -> QoSOverridingOptions:
    """The overrides given for an endpoint, for rclpy to declare and apply.

    If a node has two endpoints of a kind on a topic, the overrides apply to both.
    """
    prefix = f"{PREFIX}{node.resolve_topic_name(topic)}.{kind}."
    policies = [name for name in POLICIES[kind] if prefix + name in node._parameter_overrides]
    for policy in policies:
        _check_value(prefix + policy, policy, node._parameter_overrides[prefix + policy].value)
    return QoSOverridingOptions([QoSPolicyKind[name.upper()] for name in policies])
