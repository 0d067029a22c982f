"""The topics of `publish_stamped`: numbers with a header and their names."""

from collections.abc import Callable

import numpy as np

from vehicle_roll_sim.messages.message_template import MARK, STAMP_MARK, Encode, MessageTemplate
from vehicle_roll_sim.messages.set_templates import EMPTY_LIST
from vehicle_roll_sim.messages.sets import Messages
from vehicle_roll_sim.messages.topic import Topic
from vehicle_roll_sim.messages.topics import SIGNALS, STAMPED, STAMPED_ENDING
from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.records import WHEELS
from vehicle_roll_sim.runs import columns, derived_signals
from vehicle_roll_sim.runs.derived_signals import signals_of, wheel_lifts_of
from vehicle_roll_sim.simulation.simulation import Simulation

SIGNAL_UNITS = {
    name: (columns.UNITS | derived_signals.SIGNALS)[name]
    for name in (
        *("u", "roll", "roll_rate", "yaw_rate", "lateral_acceleration"),
        *(f"normal_force_{wheel}" for wheel in WHEELS),
        *derived_signals.SIGNALS,
    )
}
"""Unit of each of `signals_stamped`, in order. The names mean the same as in the CSV."""


def builder(messages: Messages, encode: Encode, topic: Topic) -> Callable[[], bytes]:
    """The function that updates the message of a topic of the set and returns its bytes."""
    if topic not in STAMPED:
        return messages.builder(topic.name)
    if topic == SIGNALS:
        names, values = tuple(SIGNAL_UNITS), lambda: _signals(messages.simulation)
    else:
        name = topic.name.removesuffix(STAMPED_ENDING)
        bring_up_to_date, (names, numbers) = messages.builder(name), messages.named[name]

        def values() -> np.ndarray:
            bring_up_to_date()
            return numbers

    positions = [MARK, *[0.0] * (len(names) - 1)]
    fields = {"header": {"stamp": STAMP_MARK}, "name": names, "position": positions}
    stamped = MessageTemplate(encode(topic.type, fields), len(names), tail=2 * EMPTY_LIST)

    def build() -> bytes:
        stamped.numbers[:] = values()
        stamped.stamp(*messages.stamp)
        return bytes(stamped)

    return build


def _signals(simulation: Simulation) -> np.ndarray:
    """The values named by SIGNAL_UNITS, at the present simulated time."""
    state, outputs = simulation.state_vector, simulation.outputs
    loads = outputs["normal_force"]
    velocity, attitude = state[[at.U, at.V, at.W]], state[[at.ROLL, at.PITCH]]
    return np.concatenate(
        (
            state[[at.U, at.ROLL, at.ROLL_RATE, at.YAW_RATE]],
            outputs["acceleration"][1:2],
            loads,
            signals_of(velocity, *attitude, loads, wheel_lifts_of(simulation)),
        )
    )
