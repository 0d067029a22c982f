"""The topics `NAME_stamped`: messages without a header, published again with one."""

from collections.abc import Callable

from vehicle_roll_sim.messages.message_template import MARK, STAMP_MARK, Encode, MessageTemplate
from vehicle_roll_sim.messages.sets import EMPTY_LIST, Messages
from vehicle_roll_sim.messages.topics import STAMPED, STAMPED_ENDING, Topic


def builder(messages: Messages, encode: Encode, topic: Topic) -> Callable[[], bytes]:
    """The function that updates the message of a topic of the set and returns its bytes."""
    if topic not in STAMPED:
        return messages.builder(topic.name)
    name = topic.name.removesuffix(STAMPED_ENDING)
    bring_up_to_date, (names, numbers) = messages.builder(name), messages.named[name]
    positions = [MARK, *[0.0] * (len(names) - 1)]
    fields = {"header": {"stamp": STAMP_MARK}, "name": names, "position": positions}
    stamped = MessageTemplate(encode(topic.type, fields), len(names), tail=2 * EMPTY_LIST)

    def build() -> bytes:
        bring_up_to_date()
        stamped.numbers[:] = numbers
        stamped.stamp(*messages.stamp)
        return bytes(stamped)

    return build
